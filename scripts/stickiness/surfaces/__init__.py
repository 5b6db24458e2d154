"""Random rough surfaces: spectra, their moments, and heights with a given spectrum.

- `spectrum`: isotropic power spectral densities and their moments
- `band_integral`: integrals over a spectrum that have no closed form
- `synthesis`: heights on a periodic square, and the spectrum that they hold
"""
