"""Random heights with a given spectrum on a periodic window, and what they really hold."""

from stickiness.surfaces.synthesis import (
    Moments,
    lattice_spectrum,
    moments,
    realised_spectrum,
    resample,
    synthesise,
)

__all__ = ["Moments", "lattice_spectrum", "moments", "realised_spectrum", "resample", "synthesise"]
