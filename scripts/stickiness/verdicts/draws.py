"""Verdicts on the draws of a measured surface: distributions over what the surface may be.

Every draw has its own roughness and its own error of the model, so that quantiles over the draws
contain both. Quantiles are values of draws: the limits of a share, its margin, its threshold and
the number of draws that stick then agree with each other.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from stickiness.criteria.pair import Pair
from stickiness.statistics import COVERS

QUANTILES = (0.05, 0.5, 0.95)
#: Quantities whose quantiles over the draws are computed.
DRAWN = ("margin", "modulus_threshold", "remaining", "pull_off")
SEED = 2  #: of the errors of the model


def find_quantiles(values: NDArray, withstands: NDArray) -> NDArray:
    """`QUANTILES` of values over the draws, along a new last axis.

    For the low one, nothing remains in draws whose heights a layer does not withstand.
    """
    low, *others = QUANTILES
    least = np.quantile(values * withstands, [low], axis=-1, method="inverted_cdf")
    rest = np.quantile(values, others, axis=-1, method="inverted_cdf")
    return np.moveaxis(np.concatenate([least, rest]), 0, -1)


def draw_model_errors(draws: Pair) -> NDArray:
    """Errors of the model for every draw, in units of its limits, which cover 90 %."""
    count = np.shape(draws.h_rms)[-1]
    return np.random.default_rng(SEED).normal(size=count) / COVERS


def find_share_quantiles(draws: Pair) -> NDArray:
    """`QUANTILES` of the share that remains over the draws, along a last axis."""
    shares = draws.share(
        adhesion_length=draws.adhesion_length, range=draws.range, sign=draw_model_errors(draws)
    )
    return find_quantiles(shares, draws.withstands)


def judge_draws(draws: Pair | None) -> dict[str, NDArray | float]:
    """Distributions over the draws of a surface; NaN for one that was not measured.

    Returns quantiles of the quantities in `DRAWN` as `<name>_quantile`, the share of draws that
    stick, and standard deviations by the spectrum and by the model.
    """
    if draws is None:
        unknown = dict.fromkeys((f"{name}_quantile" for name in DRAWN), np.full(3, np.nan))
        return unknown | dict.fromkeys(DRAW_STATISTICS, np.nan)
    length = draws.adhesion_length
    errors = draw_model_errors(draws)

    # Margins by the model as it is, which scatter with the spectrum, and with its errors.
    margins_by_spectrum = length / draws.threshold(
        range=draws.range, share=draws.wanted_share, adhesion_length=length
    )
    margins = length / draws.threshold(
        range=draws.range, share=draws.wanted_share, sign=errors, adhesion_length=length
    )
    drawn = {
        "margin": margins,
        "modulus_threshold": margins * draws.modulus,
        "remaining": draws.share(length, draws.range, errors),
        "pull_off": draws.modulus
        * draws.tension(length, draws.range, errors, draws.pressed / draws.modulus),
    }
    withstands = draws.withstands
    return {f"{name}_quantile": find_quantiles(drawn[name], withstands) for name in DRAWN} | {
        "probability": np.mean(margins > 1),
        "probability_low": np.mean((margins > 1) & withstands),
        "error_of_spectrum": np.std(np.log(margins_by_spectrum)),
        "error_of_model": np.std(np.log(margins / margins_by_spectrum)),
    }


#: Statistics over the draws, beside the quantiles.
DRAW_STATISTICS = (
    "probability",
    "probability_low",
    "error_of_spectrum",
    "error_of_model",
)
