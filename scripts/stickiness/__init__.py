"""Stickiness of multiscale randomly rough surfaces: surfaces, contact, theory and criteria.

The library knows nothing of Snakemake or of files (but for `datasets` and `topography`, which
read and write them). Lengths are in one unit of the caller's choice, pressures in units of the
plane-strain modulus E*; arrays of heights, gaps and pressures are ``(n, n)`` float64.
"""

__version__ = "0.1.0"
