"""Errors and costs of simulations, and the settings that an accuracy needs.

- `error_laws`: error models, and the cheapest settings for an accuracy
- `adhesion`: settings of adhesive contact for an accuracy
- `plan`: what each case of the configuration is solved with, and what cases share
- `multilevel`: means over random surfaces, with control variates on two levels
- `sequential`: when to stop drawing seeds
- `spectral_cut`: spectra cut where theory can extrapolate the tail
"""
