"""Spectra of random rough surfaces and their moments."""

from stickiness.spectrum.family import SpectrumFamily
from stickiness.spectrum.interface import Spectrum
from stickiness.spectrum.kinds import PowerLawSegments, SelfAffine, Shells, Sum, Tabulated, combine

__all__ = [
    "PowerLawSegments",
    "SelfAffine",
    "Shells",
    "Spectrum",
    "SpectrumFamily",
    "Sum",
    "Tabulated",
    "combine",
]
