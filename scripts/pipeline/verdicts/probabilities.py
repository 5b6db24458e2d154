"""Probability that a pair sticks by the edges of contact, on surfaces that were measured.

The spectrum enters by its draws (`stickiness.measured.spectrum_draws`). a_V and the model's error
enter by their limits, between which logarithms are drawn evenly. The limits cover two variants of
the theory, an independent estimate and the errors of simulation.
"""

from dataclasses import dataclass

import numpy as np

from pipeline.verdicts.pairs import DIMS
from stickiness.adhesion import equivalent_sphere

QUANTILES = (0.05, 0.5, 0.95)
SEED = 2
DRAWN = ("h_rms_draws", "q0_draws", "rms_slope_draws")


@dataclass(frozen=True)
class DrawnMargin:
    """Margin at the reference frequency, attraction over repulsion, as a distribution.

    `from_spectrum` and `from_model` are the standard deviations of ln(margin) that the spectrum
    alone, or a_V and the model alone, would leave.
    """

    margins: np.ndarray  # (n,), one for each draw
    probability: float  # share of the draws that stick
    from_spectrum: float
    from_model: float

    @property
    def quantiles(self):
        """Margins at `QUANTILES`."""
        return np.quantile(self.margins, QUANTILES)


def find_probabilities(materials, surfaces, a_v):
    """Distribution of the margin of every pair; NaN on surfaces that were not measured."""
    shape = (len(materials), len(surfaces))
    share, spectrum, from_model = (np.full(shape, np.nan) for _ in range(3))
    quantiles = np.full((*shape, len(QUANTILES)), np.nan)
    for i, solid in enumerate(materials.values()):
        for j, (name, surface) in enumerate(surfaces.items()):
            if all(drawn in surface for drawn in DRAWN):
                found = draw_margins(solid, surface, a_v[name])
                share[i, j], quantiles[i, j] = found.probability, found.quantiles
                spectrum[i, j], from_model[i, j] = found.from_spectrum, found.from_model
    return {
        "probability": (DIMS[:2], share),
        "quantile": ("quantile", list(QUANTILES)),
        "margin_quantile": ((*DIMS[:2], "quantile"), quantiles),
        "error_of_spectrum": (DIMS[:2], spectrum),
        "error_of_model": (DIMS[:2], from_model),
    }


def draw_margins(material, surface, a_v):
    """`DrawnMargin` of a `Material` on a surface with draws, under a `SurfaceAv`."""
    h, q0, slope = (surface[name].values for name in DRAWN)
    length = material.work_of_adhesion / material.modulus
    value, low, high = np.transpose([a_v.at(material.range / x) for x in h])
    share, sign = np.random.default_rng(SEED).random((2, len(h)))
    at_value, drawn = (
        equivalent_sphere.attraction(h, q0, slope, length, material.range, found)
        for found in (value, low * (high / low) ** share)
    )
    margins = drawn.ratio * drawn.error_factor ** (2 * sign - 1)
    return DrawnMargin(
        margins=margins,
        probability=float(np.mean(margins > 1)),
        from_spectrum=float(np.std(np.log(at_value.ratio))),
        from_model=float(np.std(np.log(margins / at_value.ratio))),
    )
