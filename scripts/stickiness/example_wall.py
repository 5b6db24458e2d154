"""Write synthetic heights of a painted wall, as a profilometer might export them.

The tutorial and ``python -m stickiness --example`` use this file as their measurement. It covers
2 mm by 2 mm with the tilt of a stage. Its wavelengths range from 1 mm to the pixel, the spectrum is
flat above 0.2 mm, and the rms height is about 10 um. In the environment of the project:
``python -m stickiness.example_wall wall.txt``.
"""

import sys
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from stickiness import spectrum, surface

__all__ = ["heights", "write"]

SIDE = 2000.0  # um
PIXELS = 256  # along a side


def heights() -> NDArray:
    """Heights [um], (256, 256): a quarter of a periodic surface, tilted, and not periodic."""
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


def write(path: str | Path) -> None:
    """Write the heights as a text of columns between tabs."""
    np.savetxt(path, heights(), fmt="%.3f", delimiter="\t")


if __name__ == "__main__":
    write(sys.argv[1])
