"""Picture of contact: states of least energy at zero load, simulated on the measured heights."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from numpy.typing import NDArray

from stickiness.formatting import percent, unit_for
from stickiness.pages.plotting import RED
from stickiness.remaining.trial_states import SimulatedHeights
from stickiness.verdicts.limits import read_limited
from stickiness.verdicts.pair_variables import BY_BOUND, BY_SIMULATION
from stickiness.verdicts.wording import LEAST_STRESS, MOST_STRESS

MATERIALS = 3  # shown at most
MOST_SHOWN = 0.995  # quantile of the gaps up to which colours tell them apart


class State(NamedTuple):
    """A state of contact on the map."""

    title: str
    gap: NDArray  # [m], 0 in contact, ``(n0, n1)``

    @property
    def area(self) -> float:
        """Share of the map that is in contact."""
        return float((self.gap <= 0).mean())


class Contact(NamedTuple):
    """States of contact on the map of a surface."""

    states: list[State]
    sides: tuple[float, float]  # of the map [m]
    threshold_of: str  # the material in the last state with the modulus of its threshold, if any
    not_kept: list[str]  # materials on whose solid the surface keeps no states


class Simulated(NamedTuple):
    """States simulated on the heights, and the energy that they lack over that of full contact."""

    heights: SimulatedHeights
    lacking: NDArray | float


def find_contact(
    data: xr.Dataset, pairs: xr.Dataset, simulated: Mapping[str, Simulated] | None = None
) -> Contact | None:
    """Find the simulated states that decided on `pairs` of a surface; None if none did.

    The last state is that of the first material with the modulus at which the wanted share remains,
    if there is such a modulus. The `data` of the surface keep states of a half-space. Those that
    were `simulated` with other solids are given by the names of the materials.
    """
    names = pairs.material.values[pairs.decided_by.isin([BY_BOUND, BY_SIMULATION]).values]
    if not names.size:
        return None
    from stickiness.verdicts.rough_surface import Surface  # loads all that analyses heights

    at_hand = dict(simulated or {})
    surface = Surface(data)
    kept = surface.simulated
    if kept is not None and kept.whole.gap_bin is not None:
        on_half_space = [name for name in names if pairs.half_space.sel(material=name)]
        at_hand |= dict.fromkeys(on_half_space, Simulated(kept, surface.lacking))
    shown = [name for name in names if name in at_hand][:MATERIALS]
    not_kept = [name for name in names if name not in at_hand]

    def find(name: str, title: str, factor: float = 1.0) -> State:
        return _find_state(at_hand[name], pairs.sel(material=name), title, factor)

    labels = {name: pairs.material_label.sel(material=name).item() for name in names}
    states = [find(name, labels[name]) for name in shown]
    threshold_of = ""
    if shown:
        first_pair = pairs.sel(material=shown[0])
        threshold = read_limited(first_pair.modulus_threshold).value
        if LEAST_STRESS < threshold < MOST_STRESS:
            threshold_of = labels[shown[0]]
            title = f"{threshold_of} at its threshold"
            factor = threshold / float(first_pair.quoted_modulus)
            states.append(find(shown[0], title, factor))
    first, second = data.standard_sides.isel(part=0).values * float(data.standard_length_unit)
    return Contact(states, (first, second), threshold_of, [labels[name] for name in not_kept])


def _find_state(simulated: Simulated, pair: xr.Dataset, title: str, factor: float) -> State:
    """State of least energy of a pair at zero load, with a factor on its modulus."""
    adhesion_length = float(pair.work_of_adhesion / pair.plane_strain_modulus) / factor
    (index,) = simulated.heights.find_deepest(
        np.array([adhesion_length]),
        np.array([float(pair.range)]),
        pair.law.item(),
        np.array([np.median(simulated.lacking)]),
    )
    return State(title, simulated.heights.whole.find_gap(index))


def draw_state(ax: Axes, contact: Contact, state: State) -> None:
    """Draw one of the states: contact in orange, the gap from light to dark, alike in all."""
    widest = max(float(np.quantile(each.gap, MOST_SHOWN)) for each in contact.states)
    per_gap, gap_unit = unit_for(widest, "m")
    per_side, unit = unit_for(max(contact.sides), "m")
    width, height = (per_side * side for side in contact.sides)
    ax.set_facecolor(RED)  # seen where there is no gap
    image = ax.imshow(
        np.ma.masked_less_equal(state.gap.T * per_gap, 0),  # x runs to the right
        cmap="bone_r",
        vmin=0,
        vmax=widest * per_gap,
        extent=(0, width, height, 0),  # the first row is on top
        interpolation="nearest",
    )
    ax.set_title(f"{state.title}\nabout {percent(state.area)} in contact")
    ax.set(xlabel=f"x [{unit}]", ylabel=f"y [{unit}]")
    ax.figure.colorbar(image, ax=ax, label=f"gap [{gap_unit}]", fraction=0.046, pad=0.04)
