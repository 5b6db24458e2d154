"""What the scripts of the stages share: results and figures; the physics is in `stickiness`."""
