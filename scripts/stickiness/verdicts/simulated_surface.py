"""Contact simulated on the heights of a measured surface, and how its file keeps it."""

from __future__ import annotations

import logging
from collections.abc import Sequence

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from stickiness.measured.instrument_spectrum import MeasuredSpectrum
from stickiness.measured.topography import Topography
from stickiness.remaining.trial_states import SimulatedHeights, TrialStates
from stickiness.verdicts.measured_surface import Measurement

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
    "simulated_distance": ("simulated_distance", ("part", "simulation")),
}


def simulate_surface(
    measurements: Sequence[Measurement], spectrum: MeasuredSpectrum
) -> xr.Dataset | None:
    """Simulate contact on the first of the measurements, if it can stand for the surface.

    Returns
    -------
    Dataset or None
        The variables of `STATE_VARIABLES`, for the whole map and its quarters. None of a profile,
        of a map that lacks long waves of another measurement or has too few points, and if the
        simulation does not converge.
    """
    heights = measurements[0].heights
    if not isinstance(heights, Topography) or not _has_long_waves(heights, spectrum):
        return None
    # The solvers are loaded with the first simulation.
    from stickiness.remaining.height_simulation import FEWEST_POINTS, simulate_heights
    from stickiness.repulsive.solver import ConvergenceError

    if min(heights.heights.shape) < FEWEST_POINTS:
        return None
    try:
        simulated = simulate_heights(heights.heights, heights.size, cutoff=spectrum.cutoff.q)
    except ConvergenceError as error:
        logging.warning("heights are not simulated: %s", error)
        return None
    return tabulate_simulated(simulated)


def tabulate_simulated(simulated: SimulatedHeights) -> xr.Dataset:
    """Variables of `simulate_surface`; `read_simulated` reads them."""
    parts = (simulated.whole, *simulated.quarters)
    dataset = xr.Dataset(
        {"resolved_energy": simulated.resolved_energy, "simulated_pixel": simulated.pixel}
    )
    for field, (name, dimensions) in STATE_VARIABLES.items():
        values = _stack([getattr(part, field) for part in parts])
        dataset[name] = dimensions, values.astype("i1") if values.dtype == bool else values
        dataset[name].encoding = {"zlib": True}
    return dataset


def _has_long_waves(heights: Topography, spectrum: MeasuredSpectrum) -> bool:
    """Whether the waves of a surface that store its energy fit into a map."""
    rings = spectrum.rings
    energy = spectrum.area * rings.q * rings.psd
    longest = 2 * np.pi / max(heights.size)
    return energy[rings.q < 0.7 * longest].sum() <= MOST_LONGER * energy.sum()


def _stack(values: list) -> NDArray:
    """One array of the values of all parts; the last state fills up those of a shorter part."""
    most = max(np.shape(value)[:1] for value in values)
    if not most:
        return np.array(values)
    return np.stack([value[np.minimum(np.arange(most[0]), len(value) - 1)] for value in values])


def read_simulated(data: xr.Dataset) -> SimulatedHeights | None:
    """Read what `simulate_surface` made from the dataset of a surface; None if it holds none."""
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
    return SimulatedHeights(
        whole=whole,
        quarters=tuple(quarters),
        resolved_energy=float(data.resolved_energy),
        pixel=float(data.simulated_pixel),
    )


def find_lacking(simulated: SimulatedHeights, beyond: ArrayLike) -> NDArray:
    """Energy of the waves that a simulation lacks over that of the others; at least 0.

    `beyond` is that of the waves beyond the instrument's resolution over that of those resolved.
    """
    energy = (1 + np.asarray(beyond)) * simulated.resolved_energy
    return np.maximum(energy / simulated.whole.full_contact_energy - 1, 0.0)
