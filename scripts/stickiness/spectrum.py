"""Spectra of random rough surfaces and their moments."""

from stickiness.surfaces.spectrum import PowerLawSegments, SelfAffine, Shells, Spectrum, Tabulated

__all__ = ["PowerLawSegments", "SelfAffine", "Shells", "Spectrum", "Tabulated"]
