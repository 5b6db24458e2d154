"""Errors and costs of results, and the settings that an accuracy needs.

- `quantities`: the quantities that a case may ask for, in one table
- `error_models`: errors and costs as measured, as functions of surface, load and settings
- `prediction`: error and cost of settings, by these models
- `choice`: the cheapest settings for an accuracy
- `adhesion`: settings of adhesive contact for an accuracy
- `extrapolation`: the error of a spectrum that theory extrapolates
- `multilevel`: means over random surfaces, with control variates on two levels
- `plan`: what each case of the configuration is solved with, and what cases share
"""
