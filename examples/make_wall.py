"""Write synthetic heights of a painted wall, as a profilometer might export them.

The tutorial uses this file as its measurement. It covers 2 mm by 2 mm with the tilt of a stage. Its
wavelengths range from 1 mm to the pixel, the spectrum is flat above 0.2 mm, and the rms height is
about 10 um. In the environment of the project:
``PYTHONPATH=scripts python examples/make_wall.py wall.txt``.
"""

import sys

import numpy as np

from stickiness import spectrum, surface

SIDE, PIXELS = 2000.0, 256  # um


def heights() -> np.ndarray:
    """Heights [um]: a quarter of a periodic surface, tilted, and therefore not periodic."""
    step = SIDE / PIXELS
    wall = spectrum.SelfAffine(
        hurst=0.8,
        q0=2 * np.pi / 1000.0,
        q1=2 * np.pi / (2 * step),
        h_rms=10.0,
        q_rolloff=2 * np.pi / 200.0,
    )
    whole = surface.synthesise(wall, n=2 * PIXELS, length=2 * SIDE, seed=1)
    tilt = 0.01 * step * np.arange(PIXELS)
    return whole[:PIXELS, :PIXELS] + tilt


if __name__ == "__main__":
    np.savetxt(sys.argv[1], heights(), fmt="%.3f", delimiter="\t")
