"""Energy of a rough contact with adhesion against the mean gap, in closed form.

Lengths are over the rms height h, energies per nominal area over U, the elastic energy of full
contact. ``energy_ratio`` is x = w/U, ``range_ratio`` e = range/h, ``zone`` q0 range^2/(adhesion
length), the width of the cohesive zone over the longest waves; ``load_scale`` U/(h h'), h' the rms
slope, says how finely the contact without adhesion is divided.

At a mean gap u the surfaces are in the deeper of two states, each of energy F(u) - x G(u):

- weak: attraction leaves the contact without adhesion as it is. F is the elastic energy of that
  contact, G the mean attraction over that of contact: exact to first order in w (Hellmann and
  Feynman). Attraction over gaps also flattens the roughness, which adds to G.
- tough: contact grows with w. G is the area in contact, and F follows from `tough_area`. Contact
  begins at the onset, which rises with the number of scales of the waves that the attraction does
  not bridge, see `find_onset`.

What remains is the depth of the lowest energy, the pull-off its steepest rise with the gap. On thin
layers `spring_share` adds to what remains.
"""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

import numpy as np
import scipy  # its parts are loaded when first used, which reading a configuration does not
from numpy.typing import ArrayLike, NDArray

from stickiness.arguments import plain, positive
from stickiness.traction_laws import EXPONENTIAL, LAWS, find_strength

# Fitted to what remains in simulations. The number of scales at which the onset is a half; the
# spread of onsets from place to place, see `_spread`; and the width of the cohesive zone times the
# wave number of the finest waves below which it no longer matters.
HALF_ONSET = 3.7
SPREAD = 0.74
SHARP = 0.25
FEWEST_SCALES = 1e-6  #: where all waves are bridged
EXPONENTS = (-0.999, 30.0)  #: between which that of the elastic energy is searched
# Mean gap of tough contact at zero load in simulations, over that of contact without adhesion of
# the same elastic energy: edges that attract lift the surfaces.
LIFT = 1.4
#: Mean gap over h_rms at which the highest summit of many waves touches; nothing is deformed yet.
FIRST_TOUCH = 4.0
#: Independent heights in a square one of the longest waves wide: the highest touches first.
INDEPENDENT_HEIGHTS = 20.0


def find_first_touch(
    waves: ArrayLike, independent_heights: float = INDEPENDENT_HEIGHTS
) -> float | NDArray:
    """Mean gap over h_rms at which the highest summit touches, by the longest waves along a side.

    The expected highest of n Gaussian heights is about sqrt(2 ln n) times h_rms. With 20 heights it
    is the median of realisations of 1 to 4 waves.
    """
    highest = np.sqrt(2 * np.log1p(independent_heights * np.square(waves)))
    return plain(np.minimum(highest, FIRST_TOUCH))


def decay_energy(gap: ArrayLike) -> tuple[NDArray, NDArray]:
    """-ln F of contact without adhesion at a mean gap, and its slope.

    Two power laws, fitted to simulations of H = 0.3 to 0.9 and magnifications 4 to 128, in cells of
    4 by 4 waves and more: -ln F scatters about them by 6 % at a gap of 0.1, 2 % at 1, 3 % at 1.5
    and 5 % at 2.5.
    """
    near = 2.19 * np.power(gap, 0.82)
    far = 0.18 * np.power(gap, 2.53)
    return near + far, (0.82 * near + 2.53 * far) / gap


# Contact without adhesion at the mean gaps over h_rms that are searched; full contact is a tough
# state.
_GAPS = np.arange(1, 201) / 20  # up to 10; 4, where contact begins, is one of them
_DECAY, _SLOPE = decay_energy(_GAPS)
_ENERGY = np.exp(-_DECAY)
# The inverse of -ln F, from full contact on.
_FINE_GAPS = np.geomspace(_GAPS[0], _GAPS[-1], 500)
_FINE_LOG_DECAY = np.log(decay_energy(_FINE_GAPS)[0])
# Search for the steepest rise of a tough contact's energy: by random contacts within 0.15 %.
_TRIALS = 12
_ZOOMS = 5


def find_narrowest_wave(zone: ArrayLike, magnification: ArrayLike) -> float | NDArray:
    """Wave number over q0 up to which attraction does not bridge the waves.

    Attraction bridges waves that are shorter than the cohesive zone, whose width times q0 is the
    `zone`. Where it is narrower than all waves, contact is that of Johnson, Kendall and Roberts at
    each of them, and the range no longer matters.
    """
    (zone,) = positive(zone=zone)
    return plain(1 + 1 / (zone + SHARP / np.asarray(magnification)))


def count_scales(narrowest_wave: ArrayLike, exponent: ArrayLike) -> float | NDArray:
    """Number of scales over which the elastic energy is spread, N, of waves that are not bridged.

    That is (int u dln q)^2/int u^2 dln q, u the energy per logarithm of the wave number: for a
    self-affine spectrum (2/a) tanh(a ln(zeta)/2) with a = 2 H - 1, so ln(zeta) at H = 1/2.

    Parameters
    ----------
    narrowest_wave : array
        Wave number of the narrowest wave that counts, over q0, as by `find_narrowest_wave`.
    exponent : array
        That of the elastic energy, a, as by `find_exponent`.

    Examples
    --------
    >>> from stickiness.spectrum import SelfAffine
    >>> rough = SelfAffine(hurst=0.5, q0=1.0, q1=1e4, h_rms=1.0)
    >>> exponent = find_exponent(1e4, mean_wave_number=4 * rough.elastic_energy())
    >>> print(f"{count_scales(100, exponent):.3f} {np.log(100):.3f}")
    4.605 4.605
    """
    slope = np.abs(np.asarray(exponent) / 2) + 1e-9  # at zero the quotient below has a limit
    return plain(np.tanh(slope * np.log(narrowest_wave)) / slope)


def find_exponent(magnification: ArrayLike, mean_wave_number: ArrayLike) -> NDArray:
    """Exponent a of heights whose wave numbers have this mean, by bisection.

    The variance of heights goes with q^(-2 - a) dq, so that the mean wave number over q0 is
    (1 + a)/a (1 - zeta^(-a))/(1 - zeta^(-1 - a)). It falls with a.

    Parameters
    ----------
    magnification : array
        Wave number of the finest waves of the surface over q0; infinite for very many decades.
    mean_wave_number : array
        Mean wave number of the heights over q0, 4 U/(E* h_rms^2 q0).
    """
    shape = np.broadcast_shapes(np.shape(magnification), np.shape(mean_wave_number))
    log_magnification = np.log(np.maximum(magnification, 1 + 1e-9))
    low = np.full(shape, EXPONENTS[0])
    high = np.full(shape, EXPONENTS[1])
    for _ in range(32):
        exponent = (low + high) / 2
        energy = np.expm1(-exponent * log_magnification) / exponent
        variance = np.expm1(-(1 + exponent) * log_magnification) / (1 + exponent)
        is_low = energy / variance > mean_wave_number
        low = np.where(is_low, exponent, low)
        high = np.where(is_low, high, exponent)
    return (low + high) / 2


def find_onset(scales: ArrayLike) -> float | NDArray:
    """Energy ratio at which tough contact begins, N/(N + `HALF_ONSET`) for N scales.

    With few scales contact picks the places that cost least. The more scales share the energy, the
    less the cost differs from place to place. With very many, each wave is followed or not by
    itself, and contact begins where full contact begins to pay, at 1.
    """
    scales = np.maximum(scales, FEWEST_SCALES)
    return plain(scales / (scales + HALF_ONSET))


def tough_share(energy_ratio: ArrayLike, onset: ArrayLike) -> float | NDArray:
    """Share that remains where contact is tough (JKR at the long waves).

    The energy gained per area, w S, grows with w by the area of contact: d(x S)/dx = `tough_area`.
    """
    x, onset = positive(energy_ratio=energy_ratio, onset=onset)
    return plain(np.maximum(_gain_of_tough(x, onset) / x, 0.0))


def tough_area(energy_ratio: ArrayLike, onset: ArrayLike) -> float | NDArray:
    """Area of tough contact at zero load; 1.0 to 1.7 times that simulated at an energy ratio of 1.

    At 0.5, where attraction over gaps stands in for contact, it is 1.2 to 2.4 times that. From the
    onset o on the area is 1 - exp(-(x - o)/(1 - o)), the simplest one by which S tends to 1 - 1/x,
    what full contact leaves. Onsets differ from place to place: this is the mean over `_spread` on
    both sides.
    """
    x, onset = positive(energy_ratio=energy_ratio, onset=onset)
    return plain(_area_of_tough(x, onset))


def _spread(onset: NDArray) -> NDArray:
    """Half the width of the range of onsets from place to place; none if very many scales add."""
    return SPREAD * onset * np.sqrt(1 - onset)


def _area_of_tough(x: NDArray, onset: NDArray) -> NDArray:
    """Mean area of tough contact over evenly distributed onsets."""
    spread = _spread(onset)

    def integrate(beyond: NDArray) -> NDArray:
        """Integral of the area over x, up to a distance beyond a single onset."""
        beyond = np.maximum(beyond, 0.0)
        return beyond + (1 - onset) * np.expm1(-beyond / (1 - onset))

    return (integrate(x - onset + spread) - integrate(x - onset - spread)) / (2 * spread)


def _gain_of_tough(x: NDArray, onset: NDArray) -> NDArray:
    """Energy gained by tough contact over U, the integral of its area over x."""
    spread = _spread(onset)

    def integrate_twice(beyond: NDArray) -> NDArray:
        """Integral of the gain over x, up to a distance beyond a single onset."""
        beyond = np.maximum(beyond, 0.0)
        width = 1 - onset
        return beyond**2 / 2 - width * beyond - width**2 * np.expm1(-beyond / width)

    both = integrate_twice(x - onset + spread) - integrate_twice(x - onset - spread)
    return both / (2 * spread)


def tough_tension(energy_ratio: ArrayLike, onset: ArrayLike) -> float | NDArray:
    """Largest tension of tough contact [U/h].

    A contact whose area is that of zero load at an energy ratio y stores F = y area - y S(y), by
    which the energy F - y area has its minimum there.
    """
    x, onset = positive(energy_ratio=energy_ratio, onset=onset)
    x, onset = np.broadcast_arrays(x, onset)
    # Contacts on the way from nearly no area to that of zero load, in the logarithm of y.
    low = np.log(np.minimum(onset - _spread(onset), x))
    high = np.log(x)
    for _ in range(_ZOOMS):
        # Between the neighbours of the steepest rise it is looked for again.
        trials = np.linspace(low, high, _TRIALS)
        rise = _find_tough_tension(np.exp(trials), x, onset)
        steepest = np.argmax(rise, axis=0)[None]
        low = np.take_along_axis(trials, np.maximum(steepest - 1, 0), axis=0)[0]
        high = np.take_along_axis(trials, np.minimum(steepest + 1, _TRIALS - 1), axis=0)[0]
    return plain(np.max(rise, axis=0, initial=0.0) / LIFT)


def _find_tough_tension(y: NDArray, x: NDArray, onset: NDArray) -> NDArray:
    """Tension [U/h] of contacts with the area of zero load at an energy ratio y, without lift."""
    stored = y * _area_of_tough(y, onset) - _gain_of_tough(y, onset)
    # The mean gap at which contact without adhesion stores the same energy. Nearer to full contact
    # than the least mean gap of the fit, its slope would grow without limit.
    decay = np.maximum(-np.log(np.clip(stored, 1e-300, 1.0)), _DECAY[0])
    gap = np.exp(np.interp(np.log(decay), _FINE_LOG_DECAY, np.log(_FINE_GAPS)))
    # d(F - x area)/du = dF/du (1 - x/y), where y is dF/d(area).
    return decay_energy(gap)[1] * np.exp(-decay) * (x / y - 1)


def weak_share(
    energy_ratio, range_ratio, load_scale=0.0, law=EXPONENTIAL, first_touch=FIRST_TOUCH
) -> float | NDArray:
    """Share that remains where attraction leaves the contact without adhesion as it is.

    `law` is a name of `LAWS`, or an array of names.
    """
    x, e = positive(energy_ratio=energy_ratio, range_ratio=range_ratio)
    columns = np.broadcast_arrays(x, e, load_scale, law, first_touch)
    flat = [column.ravel() for column in columns]
    share = np.empty(columns[0].size)
    # Blocks of 400 pairs at all mean gaps fit the cache. Sorted by range, a block has few of them.
    range_ratios = flat[1]
    for block in np.array_split(np.argsort(range_ratios), share.size // 400 + 1):
        states = _find_weak_states(*(column[block] for column in flat))
        share[block] = _gain_of(_flatten(states, range_ratios[block]))
    return plain(share.reshape(columns[0].shape))


class _WeakStates(NamedTuple):
    """Contact without adhesion at mean gaps of `_GAPS`, with attraction."""

    energy_ratio: NDArray  #: (..., 1)
    energy: NDArray  #: (..., gap), with attraction, over U
    area: NDArray  #: (..., gap), in contact
    elastic_energy: NDArray  #: (..., gap), over U


def _flatten(states: _WeakStates, range_ratio: NDArray) -> _WeakStates:
    """The same states where attraction over open gaps flattens the roughness, and gains by that.

    Its stiffness is w over the range squared, beside that of the heights, U over h_rms squared.
    Without a fitted constant, shares at ranges of a quarter to twice the rms height follow
    simulations: at half of it and more, theory is no longer low by up to a sixth.
    """
    attraction = (states.elastic_energy - states.energy) / states.energy_ratio
    over_gaps = attraction - states.area
    stiffness_ratio = states.energy_ratio * over_gaps / range_ratio[..., None] ** 2
    gained = over_gaps * (1 - attraction) * stiffness_ratio / (1 + stiffness_ratio)
    return states._replace(energy=states.energy - states.energy_ratio * gained)


def _gain_of(states: _WeakStates) -> NDArray:
    """Largest gain of energy over the work of adhesion."""
    return np.max(-states.energy / states.energy_ratio, axis=-1, initial=0.0)


def _find_weak_states(energy_ratio, range_ratio, load_scale, law, first_touch) -> _WeakStates:
    """States at mean gaps that rise, arrays ``(…, gap)``; arguments as of `weak_share`."""
    x, e = positive(energy_ratio=energy_ratio, range_ratio=range_ratio)
    x, e = np.broadcast_arrays(x, e)
    # Beyond the first touch there is no energy and no area, and attraction falls ever more slowly:
    # neither the deepest state nor the steepest rise is further away than the next two gaps.
    count = int(np.count_nonzero(np.max(first_touch) >= _GAPS)) + 3
    gaps = _GAPS[:count]
    energy = np.where(np.asarray(first_touch)[..., None] >= gaps, _ENERGY[:count], 0.0)
    # In contact without adhesion the area grows with the load p as erf(sqrt(pi) p/h').
    scale = np.sqrt(np.pi) * np.asarray(load_scale)[..., None]
    area = scipy.special.erf(scale * _SLOPE[:count] * energy)
    # Mean attraction is costly and depends on the range alone, of which grids of pairs have few.
    ranges, place = np.unique(e, return_inverse=True)
    attraction = _mean_attraction(ranges, gaps)[place.reshape(e.shape)]
    # Where undeformed heights overlap but do not touch, attraction falls short of contact. The
    # decay with the range was fitted to simulations.
    open_overlap = np.maximum(scipy.special.ndtr(-gaps) - area, 0.0)
    attraction = attraction - open_overlap * np.exp(-2.6 * e[..., None])
    # Other laws: what they attract beyond the exponential one.
    law = np.broadcast_to(law, e.shape)
    for name in set(np.unique(law).tolist()) - {EXPONENTIAL}:
        ranges, place = np.unique(e[law == name], return_inverse=True)
        attraction[law == name] += _mean_excess(ranges, name, count)[place]
    x = x[..., None]
    return _WeakStates(x, energy - x * np.maximum(attraction, area), area, energy)


@cache
def _open_gaps() -> tuple[NDArray, NDArray]:
    """Gaps over h_rms, even in the logarithm, and their weights in Gaussian heights by mean gap."""
    gaps = np.exp(np.linspace(-28.0, 3.0, 389))
    weights = np.exp(-((_GAPS - gaps[:, None]) ** 2) / 2) / np.sqrt(2 * np.pi)
    weights *= np.gradient(np.log(gaps))[:, None] * gaps[:, None]
    return gaps, weights


def _mean_excess(range_ratio: NDArray, law: str, count: int) -> NDArray:
    """Mean over open gaps of what a law attracts beyond the exponential, ``(range, count)``."""
    gaps, weights = _open_gaps()
    gaps_over_range = gaps / range_ratio[:, None]
    exponential = LAWS[EXPONENTIAL](1.0, 1.0).potential(gaps_over_range)
    return (exponential - LAWS[law](1.0, 1.0).potential(gaps_over_range)) @ weights[:, :count]


def _mean_attraction(range_ratio: NDArray, gaps: NDArray) -> NDArray:
    """Mean of exp(-gap/range) over undeformed heights, ``(range, gap)``; overlap counts as 1."""
    away = 1 / range_ratio[:, None] - gaps
    open_part = np.exp(-(gaps**2) / 2) * scipy.special.erfcx(np.maximum(away, 0) / np.sqrt(2)) / 2
    far = away <= 0  # nowhere if the range is short
    if far.any():
        of_far = np.broadcast_to(gaps, away.shape)[far]
        open_part[far] = np.exp((away[far] ** 2 - of_far**2) / 2) * scipy.special.ndtr(-away[far])
    return open_part + scipy.special.ndtr(-gaps)


def spring_share(energy_ratio: ArrayLike, range_ratio: ArrayLike) -> float | NDArray:
    """Share that remains on a bed of springs, as thin compressible layers are to long waves.

    A point whose undeformed surfaces are c apart is closed, ``c^2 - x``, or open at the gap g that
    balances the exponential law, ``(c - g)^2 - x exp(-g/e)``: y = (c - g)/e solves
    ``y exp(-y) = x/(2 e^2) exp(-c/e)``.
    """
    x, e = positive(energy_ratio=energy_ratio, range_ratio=range_ratio)
    x, e = np.broadcast_arrays(x, e)
    blocks = max(-(-x.size // 100), 1)  # of 100 pairs, which fit the cache
    x_blocks = np.array_split(x.ravel(), blocks)
    e_blocks = np.array_split(e.ravel(), blocks)
    gains = list(map(_gain_of_springs, x_blocks, e_blocks))
    return plain(np.clip(np.concatenate(gains).reshape(x.shape), 0.0, 1.0))


@cache
def _clearances() -> tuple[NDArray, NDArray]:
    """Clearances between undeformed surfaces over h_rms, and their weights by mean clearance."""
    clearances, step = np.linspace(-6.0, 12.0, 901, retstep=True)
    means = np.linspace(-0.5, 6.0, 66)
    weights = np.exp(-((means[:, None] - clearances) ** 2) / 2) * (step / np.sqrt(2 * np.pi))
    return clearances, weights


def _gain_of_springs(energy_ratio: NDArray, range_ratio: NDArray) -> NDArray:
    """Energy gained over the work of adhesion, ``(n,)``."""
    x = energy_ratio[:, None]
    e = range_ratio[:, None]
    clearances, weights = _clearances()
    closed = clearances**2 - x
    # Where this exceeds exp(-1) the balance has no solution: the point closes.
    pull = x / (2 * e**2) * np.exp(np.minimum(-clearances / e, 500.0))
    is_open = pull < np.exp(-1)
    pull = np.where(is_open, pull, 0.0)
    y = pull * (1 + pull)  # to rounding where it is tiny, which is nearly everywhere
    is_strong = pull > 1e-6
    y[is_strong] = -scipy.special.lambertw(-pull[is_strong]).real
    is_open &= e * y < clearances
    energy = np.where(is_open, np.minimum(closed, e**2 * (y**2 - 2 * y)), closed)
    return -np.min(energy @ weights.T, axis=-1) / x[:, 0]


def remaining_share(
    energy_ratio: ArrayLike,
    range_ratio: ArrayLike,
    onset: ArrayLike,
    relative_compliance: ArrayLike = 1.0,
    load_scale: ArrayLike = 0.0,
    law: ArrayLike = EXPONENTIAL,
    gain: ArrayLike = 1.0,
    first_touch: ArrayLike = FIRST_TOUCH,
) -> float | NDArray:
    """Share that remains in the deeper of both states, weak and tough.

    `onset` is that of tough contact, see `find_onset`.
    `relative_compliance` is the compliance to the longest waves over that of a half-space (S in
    `solids`, not the share S above). Below 1 the points of a layer are partly independent: springs
    count by its distance from 1 squared, which follows simulations at 0.1 to 0.5.
    Springs have the exponential law of equal strength, at the energy ratio times a `gain`, see
    `thin_layers`.
    """
    tough = np.asarray(tough_share(energy_ratio, onset))
    weak = weak_share(energy_ratio, range_ratio, load_scale, law, first_touch)
    share = np.maximum(tough, weak)
    independence = np.maximum(1 - np.asarray(relative_compliance), 0.0) ** 2
    if np.any(independence > 0):
        spring_ratio = np.asarray(energy_ratio) * gain
        springs = spring_share(spring_ratio, np.asarray(range_ratio) / find_strength(law))
        share = share + independence * np.maximum(springs - share, 0.0)
    return plain(np.minimum(share, 1.0))


class DeepestState(NamedTuple):
    """State of least energy, weak or tough."""

    share: NDArray  #: of the work of adhesion that remains
    tension: NDArray  #: the largest on separation [U/h]
    area: NDArray  #: of contact at zero load


def find_deepest_state(
    energy_ratio, range_ratio, onset, load_scale=0.0, law=EXPONENTIAL
) -> DeepestState:
    """Share that remains, largest tension, and area of contact at zero load."""
    states = _find_weak_states(energy_ratio, range_ratio, load_scale, law, FIRST_TOUCH)
    weak = _gain_of(states)
    tough = np.asarray(tough_share(energy_ratio, onset))
    share = np.maximum(tough, weak)
    is_tough = share > weak
    # The tension is the steepest rise of the energy beyond its minimum, up to the strength.
    lowest = np.argmin(states.energy, axis=-1)[..., None]
    count = states.energy.shape[-1]
    beyond = np.arange(count - 1) >= lowest
    slopes = np.diff(states.energy) / np.diff(_GAPS[:count])
    weak_tension = np.max(slopes, axis=-1, where=beyond, initial=0.0)
    tension = np.where(is_tough, tough_tension(energy_ratio, onset), weak_tension)
    strength = find_strength(law) * states.energy_ratio[..., 0] / range_ratio
    areas = np.broadcast_to(states.area, states.energy.shape)
    weak_area = np.take_along_axis(areas, lowest, axis=-1)[..., 0]
    area = np.where(is_tough, tough_area(energy_ratio, onset), weak_area)
    return DeepestState(share, np.minimum(tension, strength), area)
