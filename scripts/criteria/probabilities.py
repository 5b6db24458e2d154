"""Probability that a pair sticks, on surfaces that were measured.

The spectrum enters by its draws (`stickiness.measured.stitching`), the model of the adhesion
that remains by its error, drawn from a normal distribution of which the limits cover 90 %.
"""

from dataclasses import dataclass

import numpy as np

from criteria.pairs import DIMS, is_scalable
from stickiness.statistics import COVERS

QUANTILES = (0.05, 0.5, 0.95)
SEED = 2


@dataclass(frozen=True)
class Drawn:
    """Margin and share that remains at the reference frequency, as distributions.

    `from_spectrum` and `from_model` are the standard deviations of ln(margin) that the spectrum
    alone, or the model alone, would leave; `share_from_spectrum` is that of the share by the
    spectrum alone.
    """

    margins: np.ndarray  # (n,), one for each draw
    remaining: np.ndarray  # (n,), share of the work of adhesion
    pull_off: np.ndarray  # (n,), stress [Pa]
    from_spectrum: float
    from_model: float
    share_from_spectrum: float

    @property
    def probability(self):
        """Share of the draws that stick."""
        return float(np.mean(self.margins > 1))


def find_probabilities(materials, joints):
    """Distribution of the margin of every pair; NaN on surfaces that were not measured."""
    shape = (len(materials), len(joints[0]))
    probability, spectrum, from_model, of_share = (np.full(shape, np.nan) for _ in range(4))
    margins, remaining, thresholds, pull_off = np.full((4, *shape, len(QUANTILES)), np.nan)
    for i, solid in enumerate(materials.values()):
        for j, joint in enumerate(joints[i]):
            if joint.drawn is not None:
                found = draw_pair(solid, joint.drawn)
                probability[i, j] = found.probability
                margins[i, j] = np.quantile(found.margins, QUANTILES)
                remaining[i, j] = np.quantile(found.remaining, QUANTILES)
                pull_off[i, j] = np.quantile(found.pull_off, QUANTILES)
                if is_scalable(solid):
                    thresholds[i, j] = solid.modulus * margins[i, j]
                spectrum[i, j], from_model[i, j] = found.from_spectrum, found.from_model
                of_share[i, j] = found.share_from_spectrum
    return {
        "probability": (DIMS[:2], probability),
        "quantile": ("quantile", list(QUANTILES)),
        "margin_quantile": ((*DIMS[:2], "quantile"), margins),
        "remaining_quantile": ((*DIMS[:2], "quantile"), remaining),
        "modulus_threshold_quantile": ((*DIMS[:2], "quantile"), thresholds),
        "pull_off_quantile": ((*DIMS[:2], "quantile"), pull_off),
        "error_of_spectrum": (DIMS[:2], spectrum),
        "error_of_model": (DIMS[:2], from_model),
        "share_error_of_spectrum": (DIMS[:2], of_share),
    }


def draw_pair(material, rough):
    """`Drawn` of a `Material` on the draws of a surface."""
    length = material.work_of_adhesion / material.modulus
    sign = draw_signs(rough)
    at_value = length / rough.threshold(material.range)
    margins = length / rough.threshold(material.range, sign=sign)
    return Drawn(
        margins=margins,
        remaining=rough.share(length, material.range, sign),
        pull_off=material.modulus * rough.tension(length, material.range, sign),
        from_spectrum=float(np.std(np.log(at_value))),
        from_model=float(np.std(np.log(margins / at_value))),
        share_from_spectrum=float(np.std(rough.share(length, material.range))),
    )


def draw_signs(rough):
    """Errors of the model for every draw, in units of its limits."""
    return np.random.default_rng(SEED).normal(size=len(rough.h_rms)) / COVERS
