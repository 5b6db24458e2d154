"""Verdicts of the derived criterion under all that is uncertain, and at other rates.

The spectrum enters by its draws (`stickiness.moments`), a_V by its limits, between which its
logarithm is drawn evenly: they bound what two variants of the theory, an independent estimate and
the simulation's errors leave open.
"""

from dataclasses import dataclass

import numpy as np

from stickiness import criteria

QUANTILES = (0.05, 0.5, 0.95)
SEED = 2
DRAWN = ("h_rms_draws", "q0_draws")


@dataclass(frozen=True)
class Uncertain:
    """Margin of the derived criterion as a distribution.

    Attributes
    ----------
    margins : (n,) array
        At the reference frequency, one for each draw.
    probability : float
        Share of the draws that stick.
    from_spectrum, from_a_v : float
        Standard deviations of ln(margin) that either alone would leave.
    """

    margins: np.ndarray
    probability: float
    from_spectrum: float
    from_a_v: float

    @property
    def quantiles(self):
        """Margins at `QUANTILES`."""
        return np.quantile(self.margins, QUANTILES)


def uncertain(material, surface, a_v):
    """`Uncertain` margin of a `Material` on a surface with draws, under a `SurfaceAv`."""
    h, q0 = (surface[name].values for name in DRAWN)
    length = material.work_of_adhesion / material.modulus
    value, low, high = np.transpose([a_v.at(material.range / x) for x in h])
    share = np.random.default_rng(SEED).random(len(h))
    drawn = low * (high / low) ** share
    margins = criteria.violano(h, q0, length, material.range, drawn).margin
    spectrum = criteria.violano(h, q0, length, material.range, value).margin
    a_v_alone = np.log(drawn / value) * 0.6  # margin ~ a_V^(3/5)
    return Uncertain(
        margins=np.asarray(margins),
        probability=float(np.mean(np.asarray(margins) > 1)),
        from_spectrum=float(np.std(np.log(spectrum))),
        from_a_v=float(np.std(a_v_alone)),
    )


def at_frequencies(material, margin, frequencies):
    """Margin at other frequencies: E* enters as E*^(-3/5), a_V does not depend on it."""
    moduli = np.asarray(material.plane_strain.storage(frequencies))
    return margin * (moduli / material.modulus) ** -0.6
