"""What the adhesion that remains, and every criterion, say of an observation."""

from dataclasses import dataclass, replace
from functools import cache

import numpy as np
from numpy.typing import NDArray

from experiments.entries import MIDDLE, SHAPE, Observation
from stickiness.criteria.a_v_table import SurfaceAv
from stickiness.criteria.pair import Pair
from stickiness.criteria.registry import CRITERIA
from stickiness.criteria.verdict import BROAD_A_V, describe_surface, surface_a_v
from stickiness.remaining import sphere
from stickiness.remaining.prediction import HYSTERESIS, LATE
from stickiness.spectrum.kinds import SelfAffine

SIGNS = (-1, 0, 1)  # low limit, value, high limit
ROUGHNESS = np.geomspace(1e-11, 1e-3, 121)  # rms heights [m] along which adhesion is followed
# Margins are nearly powers of the rms height: between points as far apart as these they are read
# off to better than 1 %.
COARSE = ROUGHNESS[::4]


@dataclass(frozen=True)
class Shape:
    """Spectrum of unit rms height, and its a_V."""

    q0: float
    rms_slope: float
    rms_curvature: float
    elastic_energy: float
    a_v: SurfaceAv


@dataclass(frozen=True)
class Predicted:
    """Predictions for every combination of the inputs, arrays ``(sign, combination)``.

    `curve` is the adhesion along `ROUGHNESS`, ``(sign, combination, roughness)``: the pull-off of a
    sphere over that from a smooth surface, or the share of the work of adhesion that remains
    between flats. `limit` is the rms height [m] at which it falls to the level of the observation,
    NaN beyond these heights.
    """

    values: dict[str, NDArray]
    curve: NDArray
    limit: NDArray
    waves_in_contact: NDArray  # longest waves across what holds a sphere at pull-off
    energy_ratio: NDArray


@cache
def describe_shape(hurst: float, longest: float, rolloff: float | None, shortest: float) -> Shape:
    """`Shape` of a self-affine spectrum from its wavelengths [m]."""
    spectrum = SelfAffine(
        hurst=hurst,
        q0=2 * np.pi / longest,
        q1=2 * np.pi / shortest,
        h_rms=1.0,
        q_rolloff=None if rolloff is None else 2 * np.pi / rolloff,
    )
    known = describe_surface(spectrum)
    names = ("q0", "rms_slope", "rms_curvature", "elastic_energy")
    return Shape(**{n: known[n] for n in names}, a_v=surface_a_v(spectrum, known))


def shapes_of(observation: Observation) -> list[Shape]:
    """`Shape` of the surface for every combination."""
    inputs = observation.inputs
    absent = np.full(len(inputs["hurst"]), None)
    return [
        describe_shape(*row) for row in zip(*(inputs.get(k, absent) for k in SHAPE), strict=True)
    ]


def make_pair(observation: Observation, shapes: list[Shape], h_rms: NDArray) -> Pair:
    """`Pair` for every combination, at rms heights ``(combination, n)``."""
    names = ("q0", "rms_slope", "rms_curvature", "elastic_energy")
    column = {name: np.array([getattr(s, name) for s in shapes])[:, None] for name in names}
    modulus, work, reach = (
        observation.inputs[name][:, None] for name in ("modulus", "work_of_adhesion", "range")
    )
    a_v = [s.a_v.at(ratios) for s, ratios in zip(shapes, reach / h_rms, strict=True)]
    value, low, high = np.swapaxes(a_v, 0, 1)
    return Pair(
        h_rms=h_rms,
        q0=column["q0"],
        rms_slope=column["rms_slope"] * h_rms,
        rms_curvature=column["rms_curvature"] * h_rms,
        elastic_energy=column["elastic_energy"] * h_rms**2,
        modulus=modulus,
        work_of_adhesion=work,
        range=reach,
        a_v=value,
        a_v_low=low,
        a_v_high=high,
        constant_a_v=BROAD_A_V,
    )


def predict_observation(observation: Observation) -> Predicted:
    """Works of approach and separation and pull-off, with limits, for every combination.

    ValueError if a limiting roughness was observed and none is predicted among `ROUGHNESS`.
    """
    shapes = shapes_of(observation)
    rough = make_pair(observation, shapes, repeat(ROUGHNESS, shapes))
    follow = relative_pull_off if "radius" in observation.inputs else find_share
    curve = np.array([follow(observation, rough, sign) for sign in SIGNS])
    level = observation.level
    limit = np.array([[find_fall(ROUGHNESS, row, level) for row in rows] for rows in curve])
    if observation.quantity == "limiting_roughness" and np.isnan(limit).any():
        raise ValueError(
            f"{observation.experiment}.cases.{observation.name}: adhesion falls to {level:g} at no "
            f"rms height from {ROUGHNESS[0]:g} to {ROUGHNESS[-1]:g} m; correct the level or inputs"
        )
    pair = make_pair(observation, shapes, heights_of(observation, limit[1]))
    work = pair.work_of_adhesion[:, 0]
    share, separation, relative = (
        np.array([find(observation, pair, sign)[:, 0] for sign in SIGNS])
        for find in (find_share, find_separation, relative_pull_off)
    )
    return Predicted(
        values={
            "remaining": share,
            "relative_pull_off": relative,
            "work_of_approach": share / np.array([[LATE], [1], [1]]) * work,
            "work_of_separation": separation * work,
        },
        curve=curve,
        limit=limit,
        waves_in_contact=count_waves(observation, pair),
        energy_ratio=(pair.adhesion_length / pair.elastic_energy)[:, 0],
    )


def heights_of(observation: Observation, limit: NDArray) -> NDArray:
    """Rms heights ``(combination, 1)``: as given, or where adhesion falls to the level."""
    return observation.inputs.get("h_rms", limit)[:, None]


def find_share(observation: Observation, pair: Pair, sign: int) -> NDArray:
    """Share of the work of adhesion that remains."""
    return np.asarray(pair.remaining(sign))


def find_separation(observation: Observation, pair: Pair, sign: int) -> NDArray:
    """Work of separation over the work of adhesion, of a sphere or of flats."""
    if "radius" in observation.inputs:
        at = pair.roughness, pair.adhesion_length, pair.range
        return sphere.work_of_separation(*at, sign)
    share = find_share(observation, pair, sign)
    return np.minimum(share * HYSTERESIS, 1.0) if sign > 0 else share


def relative_pull_off(observation: Observation, pair: Pair, sign: int) -> NDArray:
    """Pull-off over that from a smooth surface, of a sphere or of flats."""
    if "radius" in observation.inputs:
        radius = observation.inputs["radius"][:, None]
        at = radius, pair.adhesion_length, pair.range
        return np.asarray(sphere.pull_off(pair.roughness, *at, sign).relative)
    stress = np.asarray(pair.pull_off()[(0, 2, 1)[sign]])
    return np.minimum(stress * pair.range / pair.adhesion_length, 1.0)


def repeat(heights: NDArray, shapes: list[Shape]) -> NDArray:
    """The same rms heights for every combination, ``(combination, n)``."""
    return np.broadcast_to(heights, (len(shapes), len(heights)))


def find_fall(heights: NDArray, values: NDArray, level: float) -> float:
    """Rms height [m] at which values fall to a level for good; NaN if that is not among them."""
    above = np.flatnonzero(values > level)
    if not above.size or above[-1] == values.size - 1:
        return float("nan")
    here = slice(above[-1], above[-1] + 2)
    ends = values[here] if values[here].min() == 0 else np.log(values[here] / level)
    start, end = ends - level if values[here].min() == 0 else ends
    low, high = np.log(heights[here])
    return float(np.exp(low + start / (start - end) * (high - low)))


def count_waves(observation: Observation, pair: Pair) -> NDArray:
    """Longest waves across what holds a sphere at pull-off; NaN for flats."""
    if "radius" not in observation.inputs:
        return np.full(len(pair.h_rms), np.nan)
    at = observation.inputs["radius"][:, None], pair.adhesion_length, pair.range
    zone = np.asarray(sphere.pull_off(pair.roughness, *at).zone_radius)
    return (2 * zone * pair.q0 / (2 * np.pi))[:, 0]


def find_observed(observation: Observation, pair: Pair) -> tuple[NDArray, NDArray]:
    """Limits ``(combination,)`` of what was observed, by its relation if it is one."""
    factors = np.array([[observation.low], [observation.high]]) * np.ones(len(pair.h_rms))
    if observation.relation is None:
        return factors[0], factors[1]
    work, energy = pair.work_of_adhesion[:, 0], (pair.elastic_energy * pair.modulus)[:, 0]
    if observation.relation == "energy_ratio":
        h_rms = pair.h_rms[:, 0] * np.sqrt(work / (factors * energy))
        return h_rms[1], h_rms[0]
    times = 2 if observation.relation == "cycle_loss" else 1
    found = times * factors * work - energy
    low, high = found + np.array([[-1], [1]]) * observation.error
    return np.maximum(low, 0.0), np.maximum(high, 0.0)


def find_margins(observation: Observation, limit: NDArray) -> dict[str, NDArray]:
    """Margin ``(combination,)`` of every criterion; sticky above 1."""
    pair = make_pair(observation, shapes_of(observation), heights_of(observation, limit))
    return {
        name: (c.margin(pair) * np.ones(pair.h_rms.shape))[:, 0] for name, c in CRITERIA.items()
    }


def find_lengths(observation: Observation, heights: NDArray) -> dict[str, NDArray]:
    """Adhesion length that a criterion asks for over the actual one, at heights ``(comb., n)``.

    Criteria that know no adhesion length are left out.
    """
    pair = make_pair(observation, shapes_of(observation), heights)
    return {
        name: criterion.adhesion_length_threshold(pair) / pair.adhesion_length
        for name, criterion in CRITERIA.items()
        if criterion.has_length
    }


def find_roughness(observation: Observation) -> dict[str, float]:
    """Rms height [m] up to which every criterion says sticky, every input in the middle.

    NaN for a criterion that looks at no roughness.
    """
    middle = select(observation, [MIDDLE])
    shapes = shapes_of(middle)
    rough = make_pair(middle, shapes, repeat(COARSE, shapes))
    return {
        name: find_fall(COARSE, criterion.margin(rough)[0], 1.0)
        if criterion.has_length
        else float("nan")
        for name, criterion in CRITERIA.items()
    }


def select(observation: Observation, combinations: list[int]) -> Observation:
    """The observation with some of its combinations alone."""
    inputs = {name: values[combinations] for name, values in observation.inputs.items()}
    return replace(observation, inputs=inputs)
