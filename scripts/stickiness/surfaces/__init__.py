"""Random rough surfaces: spectra, their moments, and heights with a given spectrum."""
