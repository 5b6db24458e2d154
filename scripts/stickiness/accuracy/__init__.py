"""Errors and costs of results, and the settings that an accuracy needs.

- `quantities`: the quantities that a case may ask for, in one table
- `error_models`: errors and costs as measured, as functions of surface, load and settings
- `settings`: error and cost of settings by these models, and the cheapest for an accuracy
- `plan`: the settings of each case of the configuration, and which cases share solutions
- `multilevel`: means over random surfaces, with control variates on two levels
- `model_choice`: whether the DMT sum is accurate enough, or full adhesion is needed
"""

__all__ = [
    "error_models",
    "model_choice",
    "multilevel",
    "plan",
    "quantities",
    "settings",
]
