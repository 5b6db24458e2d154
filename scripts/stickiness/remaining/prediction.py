"""Adhesion that remains on a rough surface, predicted from its spectrum, with limits."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from stickiness.arguments import number
from stickiness.remaining.errors import PATH
from stickiness.remaining.roughness import Roughness, find_anisotropy_error_factor
from stickiness.solids import HALF_SPACE, Solid
from stickiness.spectrum.family import SpectrumFamily
from stickiness.spectrum.interface import Spectrum, check_spectrum
from stickiness.traction_laws import EXPONENTIAL, find_strength

MOST_RATIO = 1e30  #: of two lengths in one unit


@dataclass(frozen=True)
class Prediction:
    """What remains of the work of adhesion on a rough surface, predicted.

    Works are over the work of adhesion. The theory has no jumps: approach and separation are both
    the energy gained, and their limits allow for the jumps that were simulated. Limits (low, high)
    are calibrated, see `calibration`: they stand for 90 %.
    """

    approach: float  #: work at given mean gaps
    separation: float
    pull_off: float  #: largest mean tension on separation [E*]
    area_at_zero_load: float  #: share of the nominal area; an upper estimate, `share.tough_area`
    approach_limits: tuple[float, float]
    separation_limits: tuple[float, float]
    pull_off_limits: tuple[float, float]
    energy_ratio: float  #: work of adhesion over the elastic energy of full contact
    #: Tabor's parameter of the longest waves, (l_a^2/(q0^2 h_rms range^3))^(1/3): the range drops
    #: out where it is large. On a layer the longest waves see the modulus E*/S instead of E*.
    tabor: float
    #: Factor on the errors that limits stand for, see `find_anisotropy_error_factor`.
    anisotropy_error_factor: float = 1.0


def predict(
    spectrum: Spectrum,
    adhesion_length: float,
    range: float,
    q0: float | None = None,
    solid: Solid = HALF_SPACE,
    law: str = EXPONENTIAL,
    pressed: float = 0.0,
    simulated: Any = None,
) -> Prediction:
    """Predict what remains of adhesion on a rough surface.

    The limits are for surfaces with many of the longest waves. In a periodic cell of one wave,
    realisations scatter by a factor of two and keep more, far below the onset up to 24 times as
    much (van der Waals attraction, magnifications from 16 on). Compare with simulations in cells of
    four by four waves, and use the spectrum of those heights (`surface.realised_spectrum`).

    Parameters
    ----------
    spectrum : Spectrum
        Of the surface.
    adhesion_length : float
        Work of adhesion over E* [length].
    range : float
        Range of the attraction [length].
    q0 : float, optional
        Wave number of the longest waves that matter [1/length]; by default the roll-off,
        or the lowest of the spectrum, with a direction of its norm.
    solid : solids.HalfSpace, solids.Layer or solids.Skin
        Elastic solid; the thickness of a layer is in the unit of the spectrum.
    law : str
        Name in `traction_laws.LAWS`. The range of "van_der_waals" is the cut-off distance.
    pressed : float
        Mean pressure [E*] before separation. Only a pressure that makes contact full matters, and
        only to the high limit of the pull-off.
    simulated : SimulatedHeights, optional
        States of contact of a half-space, simulated on heights of this spectrum, which replace the
        theory of what remains; see `height_simulation.simulate_heights`.

    Examples
    --------
    >>> from stickiness.spectrum import SelfAffine
    >>> rough = SelfAffine(hurst=0.8, q0=1.0, q1=1e4, h_rms=1.0)
    >>> prediction = predict(rough, adhesion_length=1.0, range=0.01)
    >>> print(f"{prediction.separation:.2f} of the work of adhesion remains")
    0.39 of the work of adhesion remains
    """
    check_spectrum(spectrum)
    length = number("adhesion_length", adhesion_length)
    range = number("range", range)
    pressed = number("pressed", pressed, zero=True)
    q0 = number("q0", spectrum.q_longest if q0 is None else q0)
    lowest, highest = spectrum.band
    if not 0.1 * lowest <= q0 <= 10 * highest:  # heights of a cell may lack their longest waves
        raise ValueError(
            f"q0 = {q0:.3g} is far outside the wave numbers of the spectrum, {lowest:.3g} to "
            f"{highest:.3g}: give that of its longest waves"
        )
    rough = Roughness.of(
        SpectrumFamily.of(spectrum),
        solid,
        q0=np.array([q0]),
        q1=highest,
        anisotropy_error_factor=find_anisotropy_error_factor(spectrum.anisotropy),
        law=law,
        simulated=simulated,
    ).take(0)
    _check_proportions(rough, length, range)
    low = rough.deviating(-1)
    high = rough.deviating(1)
    share = float(rough.share(length, range))
    least_share = float(low.share(length, range))
    late = float(np.exp(PATH.spread.low))
    softened = length * rough.relative_compliance
    maugis_range = range / find_strength(law)
    return Prediction(
        approach=share,
        separation=share,
        pull_off=float(rough.tension(length, range, pressed)),
        area_at_zero_load=float(rough.area(length, range)),
        approach_limits=(least_share * late, float(high.share(length, range))),
        separation_limits=(least_share, float(high.separation(length, range))),
        pull_off_limits=(
            float(low.tension(length, range, pressed)),
            float(high.tension(length, range, pressed)),
        ),
        energy_ratio=float(length / rough.elastic_energy),
        tabor=float(np.cbrt(softened**2 / (q0**2 * rough.h_rms * maugis_range**3))),
        anisotropy_error_factor=float(rough.anisotropy_error_factor),
    )


def _check_proportions(rough: Roughness, adhesion_length: float, range: float) -> None:
    """Raise an error for lengths that are in another unit than the heights."""
    if not 1 / MOST_RATIO < range / rough.h_rms < MOST_RATIO:
        raise ValueError(
            f"range = {range:.3g} is out of proportion to the rms height, {rough.h_rms:.3g}: give "
            "both in one unit"
        )
    if not adhesion_length <= MOST_RATIO * rough.elastic_energy:
        raise ValueError(
            f"adhesion_length = {adhesion_length:.3g} is more than {MOST_RATIO:g} times the "
            f"elastic energy of full contact over E*, {rough.elastic_energy:.3g}: give the work of "
            "adhesion over E*, in the unit of the heights"
        )
