"""Random rough surfaces: spectra, their moments, and heights with a given spectrum.

- `interface`: what every spectrum can tell
- `spectrum`: power spectral densities, isotropic or with a direction
- `sums`: spectra of independent roughness that adds up, as of two rough solids
- `direction`: elliptic norms of wave vectors, and averages over directions
- `band_integral`: integrals over a spectrum that have no closed form
- `power_laws`: adjoining power laws and their integrals
- `moments`: moments by direction
- `synthesis`: heights on a periodic square, and the spectrum that they hold
"""
