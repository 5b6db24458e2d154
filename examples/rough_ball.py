"""Adhesion of rough balls for a DEM code: the work of adhesion of smooth balls that pull off alike.

The JKR model of a DEM code takes a work of adhesion. That of rough balls is lower, and follows from
their pull-off force, F = 3/2 pi w R. In the environment of the project:
``python examples/rough_ball.py``. The command gives the same force of a measured surface:
``python -m stickiness --example --material silicone_gel --radius "1 mm" --no-page --json``.
"""

import numpy as np

from stickiness import Material, Surface, spectrum
from stickiness.verdicts.rough_ball import pull_off_of_ball

RADIUS = 1e-3  # m

# Two equal balls meet as one of half the radius on a flat solid.
reduced_radius = RADIUS / 2
roughness = Surface.from_spectrum(spectrum.SelfAffine(hurst=0.8, q0=1e6, q1=1e9, h_rms=0.1e-6))
rubber = Material(youngs_modulus=1e6, work_of_adhesion=0.07, range=3e-10)

ball = pull_off_of_ball(roughness, rubber, reduced_radius)
forces = np.array([ball.force, *ball.force_limits])
works = forces / (1.5 * np.pi * reduced_radius)

print(ball)
print("work of adhesion for JKR [mJ/m^2], value and limits:", np.round(1e3 * works, 1))
