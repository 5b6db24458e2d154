"""Share of the work of adhesion that remains, as a function of three numbers.

``energy_ratio`` x = w/U_full, work of adhesion over the elastic energy of full contact;
``range_ratio`` e = range/h_rms; ``zone`` z = q0 range^2/(adhesion length), width of the cohesive
zone over the longest waves. Contact is tough (`tough_share`), or weak attraction acts over gaps
(`weak_share`): the deeper state has the larger share. On thin layers `spring_share` adds to it.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import lambertw, ndtr

from stickiness.arguments import plain, positive
from stickiness.traction_laws import EXPONENTIAL, LAWS, find_strength

# Fitted to simulations of H = 0.5 to 0.9 and magnifications 4 (predicted over simulated about 0.9)
# to 64 (1.15), and of zones from 0.05 on. Other forms fit as well, with onsets of 0.36 to 0.51.
ONSET, ADVANCE = 0.43, 1.3
SHARPNESS = 8.0  #: of the corner between tough and weak
# Exponents of the elastic energy of contact without adhesion against the mean gap over h_rms. Over
# simulations of whole surfaces it is 0.9 to 1.15 up to a gap of 1, 0.7 to 0.9 at 1.5, 0.5 to 0.9 at
# 2 and 0.4 to 0.9 at 2.3. No single pair of constants does for all of them.
ENERGY_DECAY, ENERGY_CURVATURE = 2.2, 0.2
# Mean gap over h_rms at which the highest summit touches and nothing is deformed yet: 3.4 to 4.15
# in cells of 16 to 256 of the longest waves. The largest of 10^6 independent heights is at 4.9.
FIRST_TOUCH = 4.0
_GAPS, _STEP_OF_GAPS = np.linspace(0.0, FIRST_TOUCH + 0.05, 82, retstep=True)  # mean, over h_rms
_CONTACT, _ENERGY = ndtr(-_GAPS), np.exp(-ENERGY_DECAY * _GAPS - ENERGY_CURVATURE * _GAPS**2)
_CONTACT[-2:] = _ENERGY[-2:] = 0.0
# Gaps over h_rms, even in the logarithm, and their weights in Gaussian heights by mean gap. Means
# of smooth laws agree with adaptive quadrature to 1e-5 for ranges from 1e-6 to 10.
_OPENINGS = np.exp(np.linspace(-28.0, 3.0, 389))
_OPEN = np.exp(-((_GAPS - _OPENINGS[:, None]) ** 2) / 2) / np.sqrt(2 * np.pi)
_OPEN *= np.gradient(np.log(_OPENINGS))[:, None] * _OPENINGS[:, None]
# Of springs over h_rms: clearances between undeformed surfaces, and their means.
_CLEARANCES, _STEP = np.linspace(-6.0, 12.0, 901, retstep=True)
_LEVELS = np.linspace(-0.5, 6.0, 66)
_BLOCK, _TINY = 100, 1e-6
_HEIGHTS = np.exp(-((_LEVELS[:, None] - _CLEARANCES) ** 2) / 2) * (_STEP / np.sqrt(2 * np.pi))


def tough_share(energy_ratio: ArrayLike, onset: ArrayLike = ONSET) -> float | NDArray:
    """Share that remains where contact is tough (JKR at the long waves).

    The energy gained per area, w S, grows with w by the area of contact: d(x S)/dx = `tough_area`,
    the simplest area that begins at the onset and lets S tend to 1 - 1/x, what full contact leaves.
    """
    (x,) = positive(energy_ratio=energy_ratio)
    rest = 1 - np.asarray(onset)
    reach = np.maximum(x - onset, 0) / rest
    return plain(np.where(x > onset, 1 - 1 / x + rest / x * np.exp(-reach), 0.0))


def tough_area(energy_ratio: ArrayLike, onset: ArrayLike = ONSET) -> float | NDArray:
    """Area of contact at zero load, where it is tough; an upper estimate.

    It is 1.0 to 1.7 times the area of simulations at an energy ratio of 1, and 1.2 to 2.4 times at
    0.5, where attraction over gaps stands in for contact.
    """
    (x,) = positive(energy_ratio=energy_ratio)
    return plain(-np.expm1(-np.maximum(x - onset, 0) / (1 - np.asarray(onset))))


def find_onset(zone: ArrayLike, onset: float = ONSET) -> float | NDArray:
    """Onset of contact for a width of the cohesive zone, which lets attraction reach over gaps."""
    (zone,) = positive(zone=zone)
    return plain(onset / (1 + ADVANCE * np.sqrt(zone)))


def weak_share(
    energy_ratio: ArrayLike, range_ratio: ArrayLike, law: ArrayLike = EXPONENTIAL
) -> float | NDArray:
    """Share that remains where attraction acts over the gaps of Gaussian heights.

    The largest of ``<attraction> - U(gap)/w`` over the mean gap, as in the bearing area model
    of Ciavarella (doi:10.1007/s11012-017-0701-6), where overlap of undeformed heights is contact.
    U is the elastic energy of contact without adhesion, none from `FIRST_TOUCH` on. It is too low
    at gaps of 1.3 to 2 rms heights, so that even a short range leaves 0.4 % at x = 0.3, 1.1 % at
    0.4 and 2 % at 0.5. `law` is a name of `LAWS`, or an array of names.
    """
    return plain(np.maximum(np.max(_follow(energy_ratio, range_ratio, law), axis=-1), 0.0))


def weak_distance(
    energy_ratio: ArrayLike, range_ratio: ArrayLike, law: ArrayLike = EXPONENTIAL
) -> float | NDArray:
    """`weak_share` over the largest slope of the energy from there outwards, over h_rms."""
    gained = _follow(energy_ratio, range_ratio, law)
    steps = np.delete(-np.diff(gained), -2, axis=-1)  # without that to first touch, a jump
    first = np.minimum(np.argmax(gained, axis=-1), _GAPS.size - 3)
    beyond = np.arange(_GAPS.size - 2) >= first[..., None]
    largest = np.max(steps, axis=-1, where=beyond, initial=0.0)
    return plain(np.max(gained, axis=-1) * _STEP_OF_GAPS / largest)


def _follow(energy_ratio, range_ratio, law):
    """Energy gained over the work of adhesion along mean gaps, the last axis."""
    x, e = np.broadcast_arrays(*positive(energy_ratio=energy_ratio, range_ratio=range_ratio))
    law, gained = np.broadcast_to(law, e.shape), np.empty((*e.shape, _GAPS.size))
    for name in np.unique(law):
        # The mean is dear and knows the range alone, of which grids of pairs have few.
        ranges, place = np.unique(e[law == name], return_inverse=True)
        mean = _CONTACT - LAWS[name](1.0, 1.0).potential(_OPENINGS / ranges[:, None]) @ _OPEN
        gained[law == name] = mean[place]
    return gained - _ENERGY / x[..., None]


def spring_share(energy_ratio: ArrayLike, range_ratio: ArrayLike) -> float | NDArray:
    """Share that remains on a bed of springs, as thin compressible layers are to long waves.

    A point whose undeformed surfaces are c apart is closed, ``c^2 - x``, or open at the gap g that
    balances the exponential law, ``(c - g)^2 - x exp(-g/e)``: y = (c - g)/e solves
    ``y exp(-y) = x/(2 e^2) exp(-c/e)``.
    """
    x, e = np.broadcast_arrays(*positive(energy_ratio=energy_ratio, range_ratio=range_ratio))
    blocks = -(-x.size // _BLOCK)  # arrays that fit the cache
    parts = (np.array_split(values.ravel(), max(blocks, 1)) for values in (x, e))
    gained = np.concatenate([_gain_of_springs(*part) for part in zip(*parts, strict=True)])
    return plain(np.clip(gained.reshape(x.shape), 0.0, 1.0))


def _gain_of_springs(energy_ratio: NDArray, range_ratio: NDArray) -> NDArray:
    """Energy gained over the work of adhesion, ``(n,)``."""
    x, e = energy_ratio[:, None], range_ratio[:, None]
    closed = _CLEARANCES**2 - x
    pull = x / (2 * e**2) * np.exp(np.minimum(-_CLEARANCES / e, 500.0))
    holds = pull < np.exp(-1)
    pull = np.where(holds, pull, 0.0)
    y = pull * (1 + pull)  # to rounding where it is tiny, which is nearly everywhere
    strong = pull > _TINY
    y[strong] = -lambertw(-pull[strong]).real
    holds &= e * y < _CLEARANCES
    energy = np.where(holds, np.minimum(closed, e**2 * (y**2 - 2 * y)), closed)
    return -np.min(energy @ _HEIGHTS.T, axis=-1) / x[:, 0]


def remaining_share(
    energy_ratio: ArrayLike,
    range_ratio: ArrayLike,
    zone: ArrayLike,
    onset: float = ONSET,
    relative_compliance: ArrayLike = 1.0,
    law: ArrayLike = EXPONENTIAL,
) -> float | NDArray:
    """Share that remains, from weak to tough: the larger of both, its corner rounded.

    `relative_compliance` is S of the longest waves on a layer. Below 1 its points are partly
    independent: springs count by (1 - S)^2, which follows simulations of S = 0.1 to 0.5.
    Springs have the exponential law of equal strength.
    """
    tough = np.asarray(tough_share(energy_ratio, find_onset(zone, onset)))
    weak = np.asarray(weak_share(energy_ratio, range_ratio, law))
    larger, smaller = np.maximum(tough, weak), np.minimum(tough, weak)
    ratio = smaller / np.where(larger > 0, larger, 1.0)
    share = np.minimum(larger * (1 + ratio**SHARPNESS) ** (1 / SHARPNESS), 1.0)
    alone = np.maximum(1 - np.asarray(relative_compliance), 0.0) ** 2
    if np.any(alone > 0):
        springs = spring_share(energy_ratio, np.asarray(range_ratio) / find_strength(law))
        share = share + alone * np.maximum(springs - share, 0.0)
    return plain(share)
