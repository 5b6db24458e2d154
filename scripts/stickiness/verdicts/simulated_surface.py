"""Contact simulated on the heights of a measured surface, and how its file keeps both."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from stickiness.measured.instrument_spectrum import MeasuredSpectrum
from stickiness.measured.measurement import Measurement
from stickiness.measured.topography import Topography
from stickiness.remaining.errors import find_limits
from stickiness.remaining.height_shape import HeightShape, keep_beyond_chance
from stickiness.remaining.pull_offs import PullOffs
from stickiness.remaining.roughness import Roughness
from stickiness.remaining.standard_heights import (
    FEWEST_POINTS,
    StandardHeights,
    StandardMap,
    standardise,
)
from stickiness.remaining.trial_states import DEFAULT_SHARE, SimulatedHeights, TrialStates
from stickiness.solids import HALF_SPACE, Solid
from stickiness.traction_laws import EXPONENTIAL

#: Share of the elastic energy in waves longer than the map, up to which the map stands for the
#: surface; of one measurement alone there are none.
MOST_LONGER = 0.1
#: Variables of a file by the fields of `TrialStates`, with their dimensions.
STATE_VARIABLES = {
    "elastic_energy": ("trial_energy", ("part", "trial")),
    "gap_share": ("trial_gap_share", ("part", "trial", "gap_bin")),
    "gap": ("trial_gap", ("part", "trial", "gap_bin")),
    "has_adhesion": ("trial_has_adhesion", ("part", "trial")),
    "full_contact_energy": ("simulated_full_contact", ("part",)),
    "simulated_length": ("simulated_length", ("part", "simulation")),
    "simulated_range": ("simulated_range", ("part", "simulation")),
    "simulated_share": ("simulated_share", ("part", "simulation")),
}
#: The same by the fields of `PullOffs`, of the whole map.
PULL_OFF_VARIABLES = {field: f"pulled_{field}" for field in ("length", "range", "tension", "area")}


def simulate_surface(
    measurements: Sequence[Measurement], spectrum: MeasuredSpectrum
) -> xr.Dataset | None:
    """Simulate contact on the first of the measurements, if it can stand for the surface.

    Returns
    -------
    Dataset or None
        The variables of `STATE_VARIABLES`, for the whole map and its quarters, those of
        `PULL_OFF_VARIABLES`, and the heights as
        they are simulated, so that other solids need no file of an instrument. None of a profile,
        of a map that lacks long waves of another measurement or has too few points, and if the
        simulation does not converge.
    """
    heights = measurements[0].heights
    if not isinstance(heights, Topography) or not _has_long_waves(heights, spectrum):
        return None
    if min(heights.heights.shape) < FEWEST_POINTS:
        return None
    standard = standardise(
        heights.heights,
        heights.size,
        cutoff=spectrum.held.q,
        is_noise_beyond=spectrum.held.is_noise_beyond,
    )
    simulated = _simulate(standard, HALF_SPACE)
    if simulated is None:
        return None
    dataset = tabulate_simulated(simulated).merge(_tabulate_standard(standard))
    gap_bin = simulated.whole.gap_bin
    if gap_bin is None:
        return dataset
    # A quarter may have more states, as in `_stack`.
    states = np.minimum(np.arange(dataset.sizes["trial"]), len(gap_bin) - 1)
    dataset["trial_gap_bin"] = ("trial", "standard_x", "standard_y"), gap_bin[states]
    dataset["trial_gap_bin"].encoding = {"zlib": True}
    return dataset


def simulate_on(data: xr.Dataset, solid: Solid) -> SimulatedHeights | None:
    """Simulate contact of another solid on the heights that `simulate_surface` has kept.

    None if the dataset of the surface holds none, or if the simulation does not converge.
    """
    return None if "standard_heights" not in data else _simulate(_read_standard(data), solid)


def _simulate(standard: StandardHeights, solid: Solid) -> SimulatedHeights | None:
    """States of contact; None if none converges."""
    # The solvers are loaded with the first simulation.
    from stickiness.remaining.height_simulation import simulate_standard
    from stickiness.repulsive.solver import ConvergenceError

    try:
        return simulate_standard(standard, solid)
    except ConvergenceError as error:
        logging.warning("heights are not simulated: %s", error)
        return None


def _tabulate_standard(standard: StandardHeights) -> xr.Dataset:
    """Variables of the heights as they are simulated; `_read_standard` reads them."""
    parts = (standard.whole, *standard.quarters)
    quarters = np.stack([quarter.heights for quarter in standard.quarters])
    dataset = xr.Dataset(
        {
            "standard_heights": (("standard_x", "standard_y"), standard.whole.heights),
            "standard_quarters": (("quarter", "quarter_x", "quarter_y"), quarters),
            "standard_sides": (("part", "axis"), [part.sides for part in parts]),
            "standard_height_unit": ("part", [part.height_unit for part in parts]),
            "standard_length_unit": standard.length_unit,
        }
    )
    for name in ("standard_heights", "standard_quarters"):
        dataset[name].encoding = {"zlib": True}
    return dataset


def _read_standard(data: xr.Dataset) -> StandardHeights:
    """Read what `_tabulate_standard` made."""
    heights = [data.standard_heights.values, *data.standard_quarters.values]
    sides = map(tuple, data.standard_sides.values.tolist())
    whole, *quarters = map(StandardMap, heights, sides, data.standard_height_unit.values.tolist())
    return StandardHeights(
        whole=whole,
        quarters=tuple(quarters),
        length_unit=float(data.standard_length_unit),
        resolved_energy=float(data.resolved_energy),
        pixel=float(data.simulated_pixel),
    )


def tabulate_simulated(simulated: SimulatedHeights) -> xr.Dataset:
    """Variables of states, of pull-offs and of the grid; `read_simulated` reads them."""
    parts = (simulated.whole, *simulated.quarters)
    dataset = xr.Dataset(
        {
            "resolved_energy": simulated.resolved_energy,
            "simulated_pixel": simulated.pixel,
            "independent_areas": simulated.independent_areas,
        }
    )
    for field, (name, dimensions) in STATE_VARIABLES.items():
        stacked = _stack([getattr(part, field) for part in parts])
        dataset[name] = dimensions, stacked.astype("i1") if stacked.dtype == bool else stacked
        dataset[name].encoding = {"zlib": True}
    for field, name in PULL_OFF_VARIABLES.items():
        dataset[name] = "pull", getattr(simulated.pull_offs, field)
    return dataset


def _has_long_waves(heights: Topography, spectrum: MeasuredSpectrum) -> bool:
    """Whether the waves of a surface that store its energy fit into a map."""
    rings = spectrum.rings
    energy = spectrum.area * rings.q * rings.psd
    longest = 2 * np.pi / max(heights.size)
    return energy[rings.q < 0.7 * longest].sum() <= MOST_LONGER * energy.sum()


def _stack(of_parts: list) -> NDArray:
    """One array of the numbers of all parts; the last state fills up those of a shorter part."""
    if np.ndim(of_parts[0]) == 0:
        return np.array(of_parts)
    states = np.arange(max(len(of_part) for of_part in of_parts))
    return np.stack([of_part[np.minimum(states, len(of_part) - 1)] for of_part in of_parts])


def read_simulated(data: xr.Dataset) -> SimulatedHeights | None:
    """Read what `simulate_surface` made from the dataset of a surface.

    None if it holds none.
    """
    if "trial_energy" not in data:
        return None
    whole, *quarters = (
        TrialStates(
            **{
                field: data[name].isel(part=part).values
                for field, (name, _) in STATE_VARIABLES.items()
            }
            | {"has_adhesion": data.trial_has_adhesion.isel(part=part).values == 1}
        )
        for part in range(data.sizes["part"])
    )
    if "trial_gap_bin" in data:
        whole = replace(whole, gap_bin=data.trial_gap_bin.values)
    return SimulatedHeights(
        whole=whole,
        quarters=tuple(quarters),
        pull_offs=PullOffs(
            **{field: data[name].values for field, name in PULL_OFF_VARIABLES.items()}
        ),
        resolved_energy=float(data.resolved_energy),
        pixel=float(data.simulated_pixel),
        independent_areas=float(data.independent_areas),
    )


def find_simulated_shape(data: xr.Dataset) -> HeightShape | None:
    """What the shape of the heights changes, by the states simulated on them.

    None without states with adhesion, and if the share wanted by default remains on them at any
    work of adhesion. The heights count as Gaussian ones which keep that share at the same work.
    What theory errs by in a contact of one of the longest waves is chance.
    """
    simulated = read_simulated(data)
    if simulated is None or not simulated.whole.has_adhesion.any():
        return None
    states = simulated.whole
    shares = np.maximum(states.simulated_share, np.finfo(float).tiny)
    nearest = np.argmin(np.abs(np.log(shares / DEFAULT_SHARE)))
    simulated_range = float(states.simulated_range[nearest])
    rough = Roughness(
        h_rms=float(data.h_rms_measured),
        q0=float(data.q0),
        q1=np.pi / simulated.pixel,
        elastic_energy=float(states.full_contact_energy),
    )

    def find_log_threshold(rough: Roughness) -> float:
        return float(np.log(rough.threshold(simulated_range)))

    by_theory = find_log_threshold(rough)
    by_states = states.find_threshold(simulated_range, EXPONENTIAL, DEFAULT_SHARE)
    if np.isnan(by_states):
        return None
    change = by_theory - by_states
    by_one_wave = find_limits(replace(rough, waves=1.0), find_log_threshold)
    chance = by_one_wave.low - by_one_wave.value
    return keep_beyond_chance(HeightShape(change, 0.0), change, chance)


def find_lacking(simulated: SimulatedHeights, whole: ArrayLike = 1.0) -> NDArray:
    """Energy of the waves that a simulation lacks over that of the others; at least 0.

    `whole` is the energy of all waves over that of the waves that the heights hold.
    """
    energy = np.asarray(whole) * simulated.resolved_energy
    return np.maximum(energy / simulated.whole.full_contact_energy - 1, 0.0)
