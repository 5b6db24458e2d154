"""What the schema of config.yaml cannot say: references, orders, keys that exclude each other."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from common.config.messages import grid_problems, unit_problem, unknown
from stickiness.accuracy.extrapolation import CARRIED_TIMES, CARRIED_TO

# What the figures and the claims ledger read; may be edited but not removed.
_PAPER = {
    "cases": ("H0.8_zeta32", "H0.8_zeta64", "H0.8_zeta128", "H0.8_zeta32_wide"),
    "theory.sweeps": ("fig1a", "fig1b", "fig3a", "fig3b", "fig3c", "fig3d"),
    "adhesion": ("fig2", "fig4b_rough", "fig4b_rough_near", "fig4b_smooth", "dmt_error"),
    "loops": ("fig4a",),
}
_CRITERIA_GRIDS = {
    "map": ("range_times_q0", "adhesion_length_over_range"),
    "compared": ("h_rms_over_range", "magnification"),
}


def config_problems(config: Mapping[str, Any]) -> Iterator[str]:
    """Yield what is wrong in a config.yaml that its schema lets pass, a line each."""
    fidelity = config["fidelity"]
    if fidelity not in config["fidelities"]:
        yield f"fidelity = {fidelity!r} is unknown; choose one of {', '.join(config['fidelities'])}"
    yield from grid_problems("gaps", config["gaps"])
    for find in (
        *(_paper_problems, _comparison_problems, _criteria_problems, _theory_problems),
        *(_case_problems, _window_problems, _adhesion_table_problems, _loop_problems),
        *(_preset_problems, _whole_problems, _remaining_problems),
    ):
        yield from find(config)


def _paper_problems(config: Mapping[str, Any]) -> Iterator[str]:
    """Entries that figures and claims read must be present."""
    tables = {"theory.sweeps": config["theory"]["sweeps"]}
    for table, names in _PAPER.items():
        for name in names:
            if name not in tables.get(table, config.get(table)):
                yield f"{table}: {name!r} is missing; the paper's figures and claims need it"


def _theory_problems(config: Mapping[str, Any]) -> Iterator[str]:
    table = config["theory"]["table"]
    for key in ("hurst", "magnification", "pressure"):
        if sorted(table[key]) != table[key]:
            yield f"theory.table.{key} = {table[key]!r} must be in increasing order"
    yield from grid_problems("theory.table.range", table["range"])


def _case_problems(config: Mapping[str, Any]) -> Iterator[str]:
    """Cases, the surfaces that they name, and the case that a_V is measured on."""
    surfaces = config["model_surfaces"]
    for key, case in config["cases"].items():
        if case["surface"] not in surfaces:
            yield unknown(f"cases.{key}.surface", case["surface"], surfaces)
        yield from _model_problems(f"cases.{key}", case, surfaces)
        for pressure in case.get("maps", []):
            if pressure not in case["pressures"]:
                yield f"cases.{key}.maps: {pressure!r} is not among the case's pressures"
    for key, surface in surfaces.items():
        rolloff, magnification = surface.get("rolloff"), surface["magnification"]
        if rolloff is not None and rolloff >= magnification:
            yield (
                f"model_surfaces.{key}.rolloff = {rolloff!r} must be below "
                f"magnification = {magnification!r}"
            )
    chosen = config["criteria"]["a_v"]
    if chosen["case"] not in config["cases"]:
        yield unknown("criteria.a_v.case", chosen["case"], config["cases"])
    elif chosen["pressure"] not in config["cases"][chosen["case"]]["pressures"]:
        yield (
            f"criteria.a_v.pressure = {chosen['pressure']!r} is not among the pressures of "
            f"cases.{chosen['case']}"
        )


def _window_problems(config: Mapping[str, Any]) -> Iterator[str]:
    gaps = config["gaps"]
    for key, window in enumerate(config["a_v"]["windows"]):
        if not window[0] < window[1]:
            yield f"a_v.windows[{key}] = {window!r} must be [low, high] with low < high"
        if window[0] < gaps["minimum"] or window[1] > gaps["maximum"]:
            yield f"a_v.windows[{key}] = {window!r} must lie within gaps.minimum … gaps.maximum"


def _adhesion_table_problems(config: Mapping[str, Any]) -> Iterator[str]:
    for key, adhesion in config["adhesion"].items():
        for problem in _adhesion_problems(adhesion, config):
            yield f"adhesion.{key}.{problem}"
    if "maps" not in config["adhesion"]["fig2"]:
        yield "adhesion.fig2.maps is missing; Figure 2 needs it: {pressures, ...}"
    if config["adhesion"]["dmt_error"]["model"] != "full":
        yield "adhesion.dmt_error.model must be full; the error of the DMT limit is measured there"


def _loop_problems(config: Mapping[str, Any]) -> Iterator[str]:
    for key, loop in config["loops"].items():
        if loop["surface"] not in config["model_surfaces"]:
            yield unknown(f"loops.{key}.surface", loop["surface"], config["model_surfaces"])
        for unit_key in ("window", "h_rms"):
            yield from unit_problem(f"loops.{key}.{unit_key}", loop.get(unit_key), "m")


def _criteria_problems(config: Mapping[str, Any]) -> Iterator[str]:
    """The maps of criteria must stay within the table of a_V."""
    criteria, table = config["criteria"], config["theory"]["table"]
    yield from grid_problems("criteria.frequencies", criteria["frequencies"])
    for part, grids in _CRITERIA_GRIDS.items():
        for key in grids:
            yield from grid_problems(f"criteria.{part}.{key}", criteria[part][key])
    compared = criteria["compared"]
    roughness = compared["h_rms_over_range"]
    asked = (
        ("a_v.pressure", "pressure", criteria["a_v"]["pressure"]),
        ("map.hurst", "hurst", criteria["map"]["hurst"]),
        ("compared.hurst", "hurst", compared["hurst"]),
        ("compared.quoted_magnification", "magnification", compared["quoted_magnification"]),
        *(
            (f"compared.magnification.{end}", "magnification", compared["magnification"][end])
            for end in ("minimum", "maximum")
        ),
    )
    for key, axis, value in asked:
        if not min(table[axis]) <= value <= max(table[axis]):
            yield (
                f"criteria.{key} = {value!r} must lie within theory.table.{axis}, "
                f"{min(table[axis])!r} … {max(table[axis])!r}"
            )
    largest = 1 / table["range"]["minimum"]
    smallest = 1 / table["range"]["maximum"]
    for key, value in (
        ("h_rms_over_range.minimum", roughness["minimum"]),
        ("h_rms_over_range.maximum", roughness["maximum"]),
        ("quoted_h_rms_over_range", compared["quoted_h_rms_over_range"]),
    ):
        if not smallest <= value <= largest:
            yield (
                f"criteria.compared.{key} = {value!r} must lie within the inverse of "
                f"theory.table.range, {smallest:g} … {largest:g}"
            )


def _comparison_problems(config: Mapping[str, Any]) -> Iterator[str]:
    """Comparisons must not take the names of cases, and presets must name comparisons."""
    surfaces = config["comparisons"]["surfaces"]
    for name in sorted(surfaces.keys() & config["cases"].keys()):
        yield f"comparisons.surfaces.{name} has the name of a case; give it another"
    for key, fidelity in config["fidelities"].items():
        for name in fidelity.get("comparisons", []):
            if name not in surfaces:
                yield unknown(f"fidelities.{key}.comparisons", name, surfaces)


def _adhesion_problems(adhesion: Mapping[str, Any], config: Mapping[str, Any]) -> Iterator[str]:
    """A set of adhesive contacts must fit its case, its model and the gaps."""
    if adhesion["case"] not in config["cases"]:
        yield unknown("case", adhesion["case"], config["cases"])
        return
    for key in ("window", "h_rms"):
        yield from unit_problem(key, adhesion.get(key), "m")
    for pressure in adhesion["pressures"]:
        if pressure not in config["cases"][adhesion["case"]]["pressures"]:
            yield f"pressures: {pressure!r} is not among those of cases.{adhesion['case']}"
    gaps, model = config["gaps"], adhesion["model"]
    for value in adhesion["range_over_h_rms"]:
        if not gaps["minimum"] <= value <= gaps["maximum"]:
            yield (
                f"range_over_h_rms: {value!r} must lie within gaps.minimum … gaps.maximum, "
                f"{gaps['minimum']:g} … {gaps['maximum']:g}"
            )
    if model == "auto" and "accuracy" not in adhesion:
        yield "accuracy is missing; model: auto chooses by it, relative in 1/kappa_ad"
    if model != "auto" and "accuracy" in adhesion:
        yield f"accuracy = {adhesion['accuracy']!r} needs model: auto, which chooses by it"
    for key in ("seeds", "refine", "maps"):
        if model == "dmt" and key in adhesion:
            yield f"{key} = {adhesion[key]!r} is of the full model; leave it out with model: dmt"


def _whole_problems(config: Mapping[str, Any]) -> Iterator[str]:
    """Cases that other parts need must be simulated for every quantity."""
    cases = dict.fromkeys(_PAPER["cases"], "the paper's figures and claims")
    cases |= {adhesion["case"]: f"adhesion.{key}" for key, adhesion in config["adhesion"].items()}
    cases[config["criteria"]["a_v"]["case"]] = "criteria.a_v"
    for name, user in cases.items():
        for key in ("quantities", "model"):
            case = config["cases"].get(name, {})
            if case.get(key, "simulation") != "simulation":
                yield (
                    f"cases.{name}.{key} = {case[key]!r}: leave it out, {user} needs every "
                    "quantity by simulation; or add a case"
                )


def _remaining_problems(config: Mapping[str, Any]) -> Iterator[str]:
    """Grids must hold the shortest waves, and a plateau must end before them."""
    for name, surface in config["remaining"]["sets"].items():
        key, magnification = f"remaining.sets.{name}", surface["magnification"]
        least = 2 * magnification * surface["window"]
        if surface["points"] < least:
            yield (
                f"{key}.points = {surface['points']!r} must be at least {least:g}, two per "
                "shortest wavelength"
            )
        if surface.get("rolloff", 1) >= magnification:
            yield f"{key}.rolloff = {surface['rolloff']!r} must be below magnification"


def _preset_problems(config: Mapping[str, Any]) -> Iterator[str]:
    """The rule of the presets and the settings measured must name existing entries."""
    rule = config["tradeoff"]["presets"]
    measured = config["tradeoff"]["cases"]["surfaces"]
    for name in config["tradeoff"]["settings"]["surfaces"]:
        if name not in measured:
            yield unknown("tradeoff.settings.surfaces", name, measured)
    if rule["surface"] not in config["model_surfaces"]:
        yield unknown("tradeoff.presets.surface", rule["surface"], config["model_surfaces"])
    for name in rule["accuracy"]:
        for table in (config["fidelities"], rule["adhesive"]["accuracy"]):
            if name not in table:
                yield unknown("tradeoff.presets.accuracy", name, table)


def _model_problems(key: str, case: Mapping[str, Any], surfaces: Mapping) -> Iterator[str]:
    """Keys of a case must suit its model; `carry_to` must be above what is simulated."""
    if case.get("model") == "theory":
        for unused in ("accuracy", "at_most", "seeds", "sampling", "maps"):
            if unused in case:
                yield (
                    f"{key}.{unused} = {case[unused]!r} is for simulations; leave it out with "
                    "model: theory"
                )
    magnification = surfaces.get(case["surface"], {}).get("magnification", 0)
    if case.get("carry_to", magnification + 1) <= magnification:
        yield (
            f"{key}.carry_to = {case['carry_to']!r} must be above the magnification simulated, "
            f"{magnification!r}"
        )
    most = min(CARRIED_TIMES * magnification, CARRIED_TO)
    if magnification < case.get("carry_to", 0) and case["carry_to"] > most:
        yield (
            f"{key}.carry_to = {case['carry_to']!r} is beyond what was measured: at most "
            f"{most:g}, {CARRIED_TIMES} times the magnification simulated and {CARRIED_TO} in all"
        )
    if "at_most" in case and "accuracy" not in case:
        yield f"{key}.at_most = {case['at_most']!r} needs accuracy; give seeds for a fixed number"
