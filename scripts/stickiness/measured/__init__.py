"""Measured topographies, from the file to a spectrum with its errors.

- `topography`: maps and line profiles: the public `read`
- `readers`: file formats
- `raw`: what a file holds, before anything is done to it
- `instruments`: files as instruments wrote them
- `text_matrix`: heights exported as text
- `text_header`: what a text file says of itself
- `text_points`: lists of points x y z
- `levelling`: levelling, missing points
- `spikes`: points far off their neighbours
- `plausibility`: doubts about a measurement
- `psd`: power spectral density of a map, averages over rings
- `profiles`: spectra of line profiles, and the isotropic ones behind them
- `cutoff`: where an instrument stops resolving the surface
- `self_affine_fit`: Hurst exponent, prefactor and roll-off of a spectrum
- `whittle`: the likelihood of that fit
- `instrument_spectrum`: all of these for one measurement
- `stitching`: several measurements as one spectrum
- `spectrum_draws`: moments of a measured spectrum with their errors
- `periodic`: measured heights made periodic for the solver
"""
