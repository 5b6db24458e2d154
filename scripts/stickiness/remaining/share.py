"""Energy of a rough contact with adhesion against the mean gap, in closed form.

Lengths are over the rms height h, energies per nominal area over U, the elastic energy of full
contact. ``energy_ratio`` is x = w/U, ``range_ratio`` e = range/h, ``zone`` q0 range^2/(adhesion
length), the width of the cohesive zone over the longest waves; ``load_scale`` U/(h h'), h' the rms
slope, says how finely the contact without adhesion is divided.

At a mean gap u the surfaces are in the deeper of two states, each of energy F(u) - x G(u):

- weak: attraction leaves the contact without adhesion as it is. F is the elastic energy of that,
  G the mean attraction over that of contact: exact to first order in w (Hellmann and Feynman).
- tough: contact grows with w. G is the area in contact, and F follows from `tough_area`.

What remains is the least energy, the pull-off its steepest rise with the gap. On thin layers
`spring_share` adds to what remains.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import erf, erfcx, lambertw, ndtr

from stickiness.arguments import plain, positive
from stickiness.traction_laws import EXPONENTIAL, LAWS, find_strength

# Of contact without adhesion, -ln F = a u^m + b u^n, with a, m, b, n. In simulations of H = 0.3 to
# 0.9 and magnifications 4 to 128, in cells of 4 by 4 waves and more, -ln F scatters about it by 6 %
# at a gap of 0.1, 2 % at 1, 3 % at 1.5 and 5 % at 2.5.
ENERGY_DECAY = (2.19, 0.82, 0.18, 2.53)
# Where undeformed heights overlap but do not touch, attraction falls short of contact by
# exp(-CLOSING e).
CLOSING = 2.6
# Fitted to what remains in simulations: the energy ratio from which tough contact grows at a short
# range, and how a wider cohesive zone advances that.
ONSET, ADVANCE = 0.4, 1.2
# Mean gap of tough contact at zero load in simulations, over that of contact without adhesion of
# the same elastic energy: edges that attract lift the surfaces.
LIFT = 1.4
_GAPS = np.linspace(0.05, 10.0, 200)  # mean gaps over h_rms; full contact is a tough state
# Mean gap over h_rms at which the highest summit touches and nothing is deformed yet: 3.2 to 4.6
# in cells of 16 to 256 of the longest waves. The largest of 10^6 independent heights is at 4.9.
FIRST_TOUCH = 4.0
# Gaps over h_rms, even in the logarithm, and their weights in Gaussian heights by mean gap.
_OPENINGS = np.exp(np.linspace(-28.0, 3.0, 389))
_OPEN = np.exp(-((_GAPS - _OPENINGS[:, None]) ** 2) / 2) / np.sqrt(2 * np.pi)
_OPEN *= np.gradient(np.log(_OPENINGS))[:, None] * _OPENINGS[:, None]
_FINE_GAPS, _LEAST_DECAY = np.geomspace(1e-9, _GAPS[-1], 1000), 1e-6  # of the inverse of F
_PARTS = np.linspace(0.0, 1.0, 60)[:, None]  # of the way to zero load, in logarithms
# Of springs over h_rms: clearances between undeformed surfaces, and their means.
_CLEARANCES, _STEP = np.linspace(-6.0, 12.0, 901, retstep=True)
_LEVELS = np.linspace(-0.5, 6.0, 66)
_BLOCK, _TINY = 100, 1e-6
_PAIRS = 400  # at all mean gaps in one block
_HEIGHTS = np.exp(-((_LEVELS[:, None] - _CLEARANCES) ** 2) / 2) * (_STEP / np.sqrt(2 * np.pi))


def decay_energy(gap: ArrayLike) -> tuple[NDArray, NDArray]:
    """-ln F of contact without adhesion at a mean gap, and its slope."""
    a, m, b, n = ENERGY_DECAY
    terms = a * np.power(gap, m), b * np.power(gap, n)
    return terms[0] + terms[1], (m * terms[0] + n * terms[1]) / gap


_DECAY, _SLOPE = decay_energy(_GAPS)
_ENERGY = np.where(_GAPS < FIRST_TOUCH, np.exp(-_DECAY), 0.0)
_TOUCHING = slice(np.count_nonzero(_GAPS < FIRST_TOUCH))  # mean gaps at which the area is not zero
_FINE_DECAY = np.log(decay_energy(_FINE_GAPS)[0])


def find_onset(zone: ArrayLike, onset: float = ONSET) -> float | NDArray:
    """Onset of contact for a width of the cohesive zone, which lets attraction reach over gaps."""
    (zone,) = positive(zone=zone)
    return plain(onset / (1 + ADVANCE * np.sqrt(zone)))


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
    """Area of tough contact at zero load; 1.0 to 1.7 times that simulated at an energy ratio of 1.

    At 0.5, where attraction over gaps stands in for contact, it is 1.2 to 2.4 times that.
    """
    (x,) = positive(energy_ratio=energy_ratio)
    return plain(-np.expm1(-np.maximum(x - onset, 0) / (1 - np.asarray(onset))))


def tough_tension(energy_ratio: ArrayLike, onset: ArrayLike = ONSET) -> float | NDArray:
    """Largest tension of tough contact [U/h].

    A contact of area 1 - exp(-t) stores F = 1 - (1 + (1 - onset) t) exp(-t): that is how the energy
    F - x area has its minimum, with the area of `tough_area`, at x = onset + (1 - onset) t.
    """
    x, onset = np.broadcast_arrays(*positive(energy_ratio=energy_ratio, onset=onset))
    start, rest = onset.ravel(), 1 - onset.ravel()
    full = np.maximum(x.ravel() - start, 1e-9) / rest
    least = 1e-3 * np.minimum(full, 1.0)
    t = least * (full / least) ** _PARTS
    decay = np.maximum(-np.log(-np.expm1(-t) - rest * t * np.exp(-t)), _LEAST_DECAY)
    gap = np.exp(np.interp(np.log(decay), _FINE_DECAY, np.log(_FINE_GAPS)))
    rise = decay_energy(gap)[1] * np.exp(-decay) * (x.ravel() / (start + rest * t) - 1)
    return plain(np.max(rise, axis=0, initial=0.0).reshape(x.shape) / LIFT)


def weak_share(energy_ratio, range_ratio, load_scale=0.0, law=EXPONENTIAL) -> float | NDArray:
    """Share that remains where attraction leaves the contact without adhesion as it is.

    `law` is a name of `LAWS`, or an array of names.
    """
    checked = positive(energy_ratio=energy_ratio, range_ratio=range_ratio)
    given = np.broadcast_arrays(*checked, load_scale, law)
    share, flat = np.empty(given[0].shape), [values.ravel() for values in given]
    # Blocks that fit the cache, by range: each needs the attraction of few ranges.
    for block in np.array_split(np.argsort(flat[1]), share.size // _PAIRS + 1):
        x, energy, _ = _weak_energy(*(values[block] for values in flat))
        share.flat[block] = np.max(-energy / x, axis=-1, initial=0.0)
    return plain(share)


def _weak_energy(energy_ratio, range_ratio, load_scale, law):
    """Energy ratios ``(..., 1)``; energies and contact areas at the mean gaps, ``(..., gap)``."""
    x, e = np.broadcast_arrays(*positive(energy_ratio=energy_ratio, range_ratio=range_ratio))
    # In contact without adhesion the area grows with the load p as erf(sqrt(pi) p/h').
    scale = np.sqrt(np.pi) * np.asarray(load_scale)[..., None]
    area = np.zeros((*np.shape(load_scale), _GAPS.size))
    area[..., _TOUCHING] = erf(scale * _SLOPE[_TOUCHING] * _ENERGY[_TOUCHING])
    # What attraction gains is dear and knows the range alone, of which grids of pairs have few.
    ranges, place = np.unique(e, return_inverse=True)
    gained = _mean_attraction(ranges)[place.reshape(e.shape)]
    open_overlap = np.maximum(ndtr(-_GAPS) - area, 0.0)
    gained = gained - open_overlap * np.exp(-CLOSING * e[..., None])
    law = np.broadcast_to(law, e.shape)
    for name in set(np.unique(law).tolist()) - {EXPONENTIAL}:
        ranges, place = np.unique(e[law == name], return_inverse=True)
        gained[law == name] += _mean_excess(ranges, name)[place]
    return x[..., None], _ENERGY - x[..., None] * np.maximum(gained, area), area


def _mean_excess(range_ratio: NDArray, law: str) -> NDArray:
    """Mean over open gaps of what a law attracts beyond the exponential, ``(range, gap)``."""
    gaps = _OPENINGS / range_ratio[:, None]
    kinds = LAWS[EXPONENTIAL](1.0, 1.0), LAWS[law](1.0, 1.0)
    return (kinds[0].potential(gaps) - kinds[1].potential(gaps)) @ _OPEN


def _mean_attraction(range_ratio: NDArray) -> NDArray:
    """Mean of exp(-gap/range) over undeformed heights, ``(range, gap)``; overlap counts as 1."""
    away = 1 / range_ratio[:, None] - _GAPS
    found = np.exp(-(_GAPS**2) / 2) * erfcx(np.maximum(away, 0) / np.sqrt(2)) / 2
    far = away <= 0  # nowhere if the range is short
    if far.any():
        gaps = np.broadcast_to(_GAPS, away.shape)[far]
        found[far] = np.exp((away[far] ** 2 - gaps**2) / 2) * ndtr(-away[far])
    return found + ndtr(-_GAPS)


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
    load_scale: ArrayLike = 0.0,
    law: ArrayLike = EXPONENTIAL,
) -> float | NDArray:
    """Share that remains in the deeper of both states, weak and tough.

    `relative_compliance` is S of the longest waves on a layer. Below 1 its points are partly
    independent: springs count by (1 - S)^2, which follows simulations of S = 0.1 to 0.5.
    Springs have the exponential law of equal strength.
    """
    tough = np.asarray(tough_share(energy_ratio, find_onset(zone, onset)))
    share = np.maximum(tough, weak_share(energy_ratio, range_ratio, load_scale, law))
    alone = np.maximum(1 - np.asarray(relative_compliance), 0.0) ** 2
    if np.any(alone > 0):
        springs = spring_share(energy_ratio, np.asarray(range_ratio) / find_strength(law))
        share = share + alone * np.maximum(springs - share, 0.0)
    return plain(np.minimum(share, 1.0))


def find_deepest_state(energy_ratio, range_ratio, zone, load_scale=0.0, law=EXPONENTIAL):
    """Share that remains, largest tension [U/h], and area of contact at zero load."""
    onset = find_onset(zone)
    x, energy, area = _weak_energy(energy_ratio, range_ratio, load_scale, law)
    weak, lowest = np.max(-energy / x, axis=-1, initial=0.0), np.argmin(energy, axis=-1)
    beyond = np.arange(_GAPS.size - 1) >= lowest[..., None]
    rise = np.max(np.diff(energy) / np.diff(_GAPS), axis=-1, where=beyond, initial=0.0)
    area = np.take_along_axis(np.broadcast_to(area, energy.shape), lowest[..., None], -1)[..., 0]
    share = np.maximum(tough_share(energy_ratio, onset), weak)
    tough = share > weak
    strength = find_strength(law) * x[..., 0] / range_ratio
    return (
        share,
        np.minimum(np.where(tough, tough_tension(energy_ratio, onset), rise), strength),
        np.where(tough, tough_area(energy_ratio, onset), area),
    )
