"""What the scripts of the stages share. It knows results and figures; the physics is in `stickiness`."""
