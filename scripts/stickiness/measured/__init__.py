"""Measured topographies, from the file to a spectrum with its errors.

`read` gives the heights of a file, `analyse` their spectrum, `draw` its moments with their errors,
`periodise` and `band_limited` heights that the solvers take. The modules:

- `topography`: maps and line profiles, read from files
- `readers`: content of a file: NetCDF, numpy, text, or by SurfaceTopography
- `levelling`: levelling, missing points, spikes
- `plausibility`: doubts about a measurement
- `psd`: power spectral density of a map or line profile, averages over rings
- `self_affine_fit`: Hurst exponent, prefactor and roll-off of a spectrum, by Whittle's likelihood
- `instrument_spectrum`: spectrum of one measurement, up to where the instrument resolves
- `stitching`: several measurements as one spectrum, moments with their errors
- `periodic`: measured heights made periodic for the solver
"""

from importlib import import_module

# Loaded when they are first used: checks of the configuration need two light modules alone.
_PLACES = {
    **dict.fromkeys(("Profile", "Topography", "jacksboro", "read"), "topography"),
    **dict.fromkeys(("Limits", "MeasuredSpectrum", "analyse"), "instrument_spectrum"),
    **dict.fromkeys(("Draws", "draw"), "stitching"),
    **dict.fromkeys(("band_limited", "periodise"), "periodic"),
}

__all__ = [*_PLACES]  # noqa: PLE0604


def __getattr__(name: str):
    if name not in _PLACES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_PLACES[name]}"), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
