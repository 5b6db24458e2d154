"""What the scripts of the stages share. The physics is in `stickiness`."""
