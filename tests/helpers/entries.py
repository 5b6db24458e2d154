"""Complete entries of the configuration, made from the keys that matter to a test."""

from common.config.simulations import ModelSurface


def complete(model, /, **keys):
    """What rules and scripts get of an entry: every key, in SI units, with defaults."""
    return model.model_validate(keys).model_dump()


def model_surface(hurst=0.8, magnification=32.0, **keys):
    return complete(ModelSurface, hurst=hurst, magnification=magnification, **keys)
