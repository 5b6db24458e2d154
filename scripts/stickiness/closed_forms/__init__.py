"""Closed-form solutions that the solvers are tested against.

- `contact`: elastic contact without adhesion
- `adhesion`: adhesive contact
- `wave`: adhesive contact with a one-dimensional wave
"""
