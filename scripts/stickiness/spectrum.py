"""Spectra of random rough surfaces and their moments."""

from stickiness.surfaces.interface import Spectrum
from stickiness.surfaces.spectrum import PowerLawSegments, SelfAffine, Shells, Tabulated
from stickiness.surfaces.sums import Sum, combine

__all__ = [
    "PowerLawSegments",
    "SelfAffine",
    "Shells",
    "Spectrum",
    "Sum",
    "Tabulated",
    "combine",
]
