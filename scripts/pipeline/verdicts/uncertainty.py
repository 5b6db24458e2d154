"""Verdicts by the edges of contact under all that is uncertain.

The spectrum enters by its draws (`stickiness.moments`), a_V and the model's error by their limits,
between which logarithms are drawn evenly: they bound what two variants of the theory, an
independent estimate and the errors of simulation leave open.
"""

from dataclasses import dataclass

import numpy as np

from stickiness.adhesion import equivalent_sphere

QUANTILES = (0.05, 0.5, 0.95)
SEED = 2
DRAWN = ("h_rms_draws", "q0_draws", "rms_slope_draws")


@dataclass(frozen=True)
class Uncertain:
    """Margin, attraction over repulsion, as a distribution.

    Attributes
    ----------
    margins : (n,) array
        At the reference frequency, one for each draw.
    probability : float
        Share of the draws that stick.
    from_spectrum, from_model : float
        Standard deviations of ln(margin) that the spectrum, or a_V and model, alone would leave.
    """

    margins: np.ndarray
    probability: float
    from_spectrum: float
    from_model: float

    @property
    def quantiles(self):
        """Margins at `QUANTILES`."""
        return np.quantile(self.margins, QUANTILES)


def uncertain(material, surface, a_v):
    """`Uncertain` margin of a `Material` on a surface with draws, under a `SurfaceAv`."""
    h, q0, slope = (surface[name].values for name in DRAWN)
    length = material.work_of_adhesion / material.modulus
    value, low, high = np.transpose([a_v.at(material.range / x) for x in h])
    share, sign = np.random.default_rng(SEED).random((2, len(h)))
    at_value, drawn = (
        equivalent_sphere.attraction(h, q0, slope, length, material.range, found)
        for found in (value, low * (high / low) ** share)
    )
    margins = drawn.ratio * drawn.error_factor ** (2 * sign - 1)
    return Uncertain(
        margins=margins,
        probability=float(np.mean(margins > 1)),
        from_spectrum=float(np.std(np.log(at_value.ratio))),
        from_model=float(np.std(np.log(margins / at_value.ratio))),
    )
