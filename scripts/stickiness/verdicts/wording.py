"""Words for a pair: what the terminal, pages and tables say of one cell of what `judge` returns.

A text is made here and nowhere else, so that one question has one answer wherever it is asked.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from stickiness.criteria.pair import NOT_JUDGED, WORDS
from stickiness.criteria.registry import REMAINING
from stickiness.formatting import (
    amount,
    duration,
    in_percent,
    in_unit,
    limited,
    number,
    percent,
)
from stickiness.plausibility import PLAUSIBLE
from stickiness.remaining.roughness import PULL_OFF_UNKNOWN
from stickiness.solids import Film, Layer, Skin
from stickiness.solids.moduli import REFERENCE_FREQUENCY, Prony, Table
from stickiness.verdicts.limits import read_limited

if TYPE_CHECKING:
    from stickiness.entries.material import Material

LEAST_STRESS = 1.0  #: [Pa]; beyond these two nobody can use a stress or a modulus
MOST_STRESS = 1e13
LEAST_SHOWN = 1e-3  #: share of the work of adhesion below which texts say 0 %
#: What widens limits most, where contact was simulated on a map, and elsewhere
_WIDEST_ON_MAP = {
    "spectrum": "The limits are wide mostly because of short wavelengths that the simulation "
    "lacks, since the instrument or its grid does not resolve them: a finer map of a smaller part "
    "would narrow them.",
    "map": "The limits are wide mostly because other places may differ, as the quarters of the map "
    "do: a larger map would narrow them if the simulation resolved it as well.",
    "model": "The limits are wide mostly because the simulation cannot resolve the range of the "
    "attraction: a better measurement would hardly narrow them.",
}
_WIDEST = {
    "spectrum": "The limits are wide mostly because of the errors of the spectrum: a larger or "
    "finer measurement would narrow them.",
    "range": "The limits are wide mostly because the surface is given by ranges: a measurement "
    "would narrow them.",
    "solid": "The limits are wide mostly because theory decides on such a solid: no measurement of "
    "the surface would narrow them.",
    "theory": "The limits are wide mostly because theory decides: a map, on which contact can be "
    "simulated, would narrow them.",
}
_DIGITS = 3  # of a threshold of the modulus


def tell_share(value: float, low: float, high: float) -> str:
    """Share of the work of adhesion that remains, with its limits; after a dwell beyond 100 %."""
    return limited(value, low, high, in_percent, least=LEAST_SHOWN)


def tell_remaining(cell: xr.Dataset) -> str:
    """How much of the work of adhesion remains, and how much must remain for the pair to stick."""
    share = tell_share(*read_limited(cell.remaining))
    return (
        f"{share} of the work of adhesion remains; at least {percent(cell.wanted_share)} is needed"
    )


def tell_pull_off(cell: xr.Dataset) -> str:
    """Pull-off stress with its limits; only a low limit where contact is nearly full."""
    pull_off = read_limited(cell.pull_off)
    if is_pull_off_known(cell):
        return limited(*pull_off, in_unit("Pa"), least=LEAST_STRESS)
    if pull_off.low < LEAST_STRESS:
        return "not known"
    return f"at least {amount(pull_off.low, 'Pa', 2)}"


def is_pull_off_known(cell: xr.Dataset) -> bool:
    """Whether the pull-off has a value and a high limit: near full contact it was not simulated."""
    return bool(cell.energy_ratio.max() <= PULL_OFF_UNKNOWN)


def name_modulus(cell: xr.Dataset) -> str:
    """Symbol of the modulus as it was given."""
    return "E*" if np.isnan(cell.poisson_ratio) else "E"


def tell_modulus(cell: xr.Dataset) -> str:
    """Modulus of the material, at the rate or after the dwell of the verdict."""
    return f"{name_modulus(cell)} = {amount(float(cell.quoted_modulus), 'Pa')}"


def tell_threshold(cell: xr.Dataset) -> str:
    """Modulus below which a pair sticks, with its limits; "any" or "none" where no number is."""
    threshold, _ = _tell_threshold(cell)
    return threshold


def tell_change(cell: xr.Dataset) -> str:
    """Modulus below which a pair sticks, beside its own, as the rest of a sentence."""
    _, where = _tell_threshold(cell)
    return f"sticks {where}; it is {amount(float(cell.quoted_modulus), 'Pa')}"


def _tell_threshold(cell: xr.Dataset) -> tuple[str, str]:
    """Modulus below which a pair sticks, alone and after "sticks"."""
    value, low, high = read_limited(cell.modulus_threshold)
    if low > MOST_STRESS:
        return "any", "at any modulus"
    if high < LEAST_STRESS:
        return "none", "at no modulus"
    symbol = name_modulus(cell)
    if value > MOST_STRESS:
        least = f"{symbol} = {amount(low, 'Pa')}"
        return f"{least} at least, probably any", f"below {least}, and probably at any modulus"
    if value < LEAST_STRESS:
        most = f"{symbol} = {amount(high, 'Pa')}"
        return f"none, or {most} at most", f"at no modulus, or below {most}"
    write = in_unit("Pa", _DIGITS)
    found = limited(value, low, high, write, least=LEAST_STRESS, most=MOST_STRESS)
    return f"{symbol} = {found}", f"below {symbol} = {found}"


def list_questions(cell: xr.Dataset) -> list[dict[str, Any]]:
    """Questions that decide, with their answers; see `questions.ask`."""
    asked = cell.questions.item()
    return json.loads(asked) if asked else []


def tell_answer(answer: Mapping[str, Any], cell: xr.Dataset) -> str:
    """What would be by one answer to a question: the option that gives it, verdict and numbers."""
    low, value, high = answer["remaining"]
    options = " and ".join(
        f"{key}: {choice if isinstance(choice, str) else json.dumps(choice)}"
        for key, choice in answer["give"].items()
    )
    told = f"{answer['answer']} (give {options})" if options else answer["answer"]
    by_it = {name: ("limit", answer[name]) for name in ("remaining", "modulus_threshold")}
    threshold = tell_threshold(cell.assign(by_it))
    return (
        f"{told}: {answer['verdict']}, "
        f"{tell_share(value, low, high)} remains, threshold {threshold}"
    )


def tell_contact(cell: xr.Dataset) -> str:
    """Size of the contact, and how to ask for another; empty of a surface that is described."""
    if np.isnan(cell.contact):
        return ""
    size = amount(float(cell.contact), "m")
    if float(cell.contact) > float(cell.scan) * (1 + 1e-9):
        return f"for a contact of {size}"
    return f"for a contact as large as the scan, {size}; give another size as contact"


def tell_dwell(cell: xr.Dataset) -> str:
    """What a dwell does, in one line; empty without one."""
    if np.isnan(cell.dwell):
        return ""
    return (
        f"after a dwell of {duration(float(cell.dwell))}: values are for slow separation, high "
        f"limits for up to {number(cell.instant_ratio, 2)} times the work and stress, the "
        "instantaneous modulus over the relaxed one"
    )


def tell_moment(judged: xr.Dataset | Material) -> str:
    """Rate at which, or dwell after which, a pair or a material is judged; empty if elastic."""
    if not judged.depends_on_rate:
        return ""
    if judged.dwell is None or np.isnan(judged.dwell):
        return f"at {amount(REFERENCE_FREQUENCY, 'Hz')}"
    return f"after {duration(float(judged.dwell))} of dwell"


def tell_rates(cell: xr.Dataset) -> str:
    """Frequencies at which a pair sticks, and may stick; empty where the rate does not matter."""
    if "rate_threshold" not in cell:
        return ""
    _, low, high = read_limited(cell.rate_threshold)
    if np.isnan(low) or np.isnan(high):
        return ""

    def below(highest: float) -> str:
        if highest == 0:
            return "at no frequency"
        if np.isinf(highest):
            return "at every frequency"
        return f"below {number(highest, 2)} Hz"

    surely, perhaps = below(low), below(high)
    if surely == perhaps:
        return f"sticks {surely}"
    return f"sticks {surely}, and may stick {perhaps}" if low > 0 else f"may stick {perhaps}"


def tell_improbable(cell: xr.Dataset) -> str:
    """Improbable values that decide, which make a verdict doubtful; empty if there are none."""
    improbable = []
    slope = float(cell.pair_rms_slope.sel(end="rough"))
    if slope > PLAUSIBLE["rms_slope"].usual:
        improbable.append(f"the rms slope is {number(slope, 2)}")
    work = float(cell.work_of_adhesion)
    if work > PLAUSIBLE["work_of_adhesion"].usual and not cell.work_on_smooth:
        improbable.append(f"the work of adhesion is {number(work, 2)} J/m^2")
    range_ = float(cell.range)
    if range_ > PLAUSIBLE["range"].usual:
        improbable.append(f"the range is {amount(range_, 'm', 2)}")
    return f"doubtful, for {' and '.join(improbable)}" if improbable else ""


def tell_widest(cell: xr.Dataset) -> str:
    """What widens the limits of a pair most, and what would narrow them; empty if nothing can."""
    if cell.questions.item():
        return ""  # which they tell
    _, low, high = read_limited(cell.margin)
    if low == 0:
        return ""  # a layer strains beyond linear elasticity, which a doubt tells
    if np.isnan(cell.error_of_spectrum):
        # A surface that was not measured is known between two ends.
        of_ends = np.ptp(np.log(cell.margin_by_criterion.sel(criterion=REMAINING).values))
        is_range = of_ends > np.log(high / low) - of_ends
        return _WIDEST["range" if is_range else "theory"]
    errors = {name: float(cell[f"error_of_{name}"]) for name in ("spectrum", "map", "model")}
    widest = max(errors, key=lambda name: errors[name])
    if errors["map"] > 0:
        return _WIDEST_ON_MAP[widest]
    if widest == "spectrum":
        return _WIDEST["spectrum"]
    return _WIDEST["theory" if cell.half_space else "solid"]


def tell_doubt(doubt: str) -> str:
    """A doubt as readers see it: names of quantities without underscores."""
    quantity, _, _ = doubt.partition(" = ")
    return (
        doubt.replace(quantity, quantity.replace("_", " "), 1) if quantity in PLAUSIBLE else doubt
    )


def tell_verdict(cell: xr.Dataset) -> str:
    """Word of the verdict on a pair."""
    return WORDS[int(cell.verdict)]


def is_judged(cell: xr.Dataset) -> bool:
    """Whether a pair has a verdict."""
    return int(cell.verdict) != NOT_JUDGED


def describe_material(material: Material) -> str:
    """Properties of a material for readers: modulus, layer, skin and roughness."""
    properties = [_describe_modulus(material)]
    if material.poisson_ratio is not None and not material.is_plane_strain:
        properties.append(f"ν = {number(material.poisson_ratio)}")
    solid = material.solid
    if isinstance(solid, Layer):
        slips = ", free to slip" if solid.backing == "slip" else ""
        backing = "on a rigid base"
        if isinstance(solid.backing, Film):
            modulus = solid.backing.modulus_ratio * material.quoted_modulus
            film = f"{amount(solid.backing.thickness, 'm')} and {amount(modulus, 'Pa')}"
            backing = f"on a film of {film}"
        properties.append(f"{amount(solid.thickness, 'm')} thick{slips} {backing}")
    if isinstance(solid, Skin):
        modulus = solid.modulus_ratio * material.quoted_modulus
        thickness = amount(solid.thickness, "m")
        properties.append(f"under a skin of {thickness} and {amount(modulus, 'Pa')}")
    if material.surface is not None:
        properties.append(f"rough itself, {amount(material.surface.rms_height, 'm')} rms")
    return ", ".join(properties)


def _describe_modulus(material: Material) -> str:
    """Modulus of a material as it was given: a number, a series or a table."""
    modulus = material.stated_modulus
    if isinstance(modulus, Table):
        table = list(zip(modulus.frequencies, modulus.moduli, strict=True))
        ends = [
            f"{amount(float(stiffness), 'Pa')} at {amount(float(frequency), 'Hz')}"
            for frequency, stiffness in (table[0], table[-1])
        ]
        return f"E′ = {' … '.join(ends)}"
    if isinstance(modulus, Prony):
        count = len(modulus.terms)
        terms = f"{count} Prony term{'s' if count > 1 else ''}"
        return f"E = {amount(modulus.equilibrium, 'Pa')} at rest, {terms}"
    symbol = "E*" if material.is_plane_strain else "E"
    return f"{symbol} = {amount(float(modulus), 'Pa')}"
