"""Measured topographies, from the file to a spectrum with its errors.

`read` gives the heights of a file, `from_array` cleans those of an array, `analyse` makes their
spectrum and `draw` its moments with their errors. `find_feature` tells whether one feature decides
the energy of a map. `periodise` and `filter_waves` make heights that the solvers take.
"""

from importlib import import_module

# Loaded when they are first used: checks of the configuration need one light module alone.
_PLACES = {
    **dict.fromkeys(("Profile", "Topography", "from_array", "read"), "topography"),
    **dict.fromkeys(("TrustedWaves", "MeasuredSpectrum", "analyse"), "instrument_spectrum"),
    **dict.fromkeys(("Draws", "draw"), "stitching"),
    **dict.fromkeys(("Feature", "find_feature"), "features"),
    **dict.fromkeys(("filter_waves", "periodise"), "periodic"),
}

__all__ = [*_PLACES]  # noqa: PLE0604


def __getattr__(name: str):
    if name not in _PLACES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_PLACES[name]}"), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
