"""The claims of the paper, recomputed: one function a claim."""
