"""Closed-form solutions that the solvers are tested against.

- `contact`: elastic contact without adhesion
- `adhesion`: adhesive contact; exports the two below, too
- `maugis_sphere`: a sphere at any range of attraction
- `wave`: adhesive contact with a one-dimensional wave
"""
