"""Measured topographies: reading, levelling, spectra and what they say of the surface."""
