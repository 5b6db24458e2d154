"""What accuracy costs: presets by the error models, and medians of the committed measurement."""

from collections.abc import Mapping, Sequence

from pipeline.numbers import number, percent, table
from pipeline.pages.report import describe_presets
from pipeline.quoted.sources import Sources
from pipeline.tradeoff import summary
from stickiness.accuracy.adhesion import predicted_error
from stickiness.accuracy.error_models import Settings, Surface, read_models
from stickiness.accuracy.prediction import Problem

# Quantities of full adhesion in the table of presets; those without it are `MODELLED`.
ADHESIVE = ("inverse_kappa_ad_0.1", "pull_off")
HEADS = ("area", "mean gap", "attractive area", "P(u)", "a_V", "κ")
HEADS += ("1/κ_ad (range 0.1 h_rms)", "pull-off", "cost in FFT pairs of 1024²")
GRIDS = {f"{pixels} extrapolated": str(pixels) for pixels in (4, 8, 16)}
GRIDS |= {"8 counted": "8, counted in pixels (one grid)"}
QUANTITIES = {
    "area": "area",
    "attractive_area_0.01": "A_ad(0.01 h_rms)",
    "a_v": "a_V",
    "mean_gap": "mean gap",
    "gap_distribution": "P(u)",
    "cost": "FFT pairs of 1024² a solution",
}
ADHESIVE_GRIDS = {pixels: pixels for pixels in ("2", "4", "8", "16")}
RANGES = ("inverse_kappa_ad_0.0075", "inverse_kappa_ad_0.1", "inverse_kappa_ad_1")
OF_ADHESION = dict(zip(RANGES, ("1/κ_ad (range 0.0075 h_rms)", "(0.1)", "(1)"), strict=True))
OF_ADHESION |= {"area_with_adhesion": "A_rep", "threshold": "threshold of l_a/range (E\\*)"}


def quote_presets(sources: Sources) -> dict[str, str]:
    """Settings of the presets with their predicted errors and cost, as in the report."""
    config = sources.config
    asked = config["tradeoff"]["presets"]
    models = read_models(sources.root / config["tradeoff"]["table"])
    surface, controls = (
        config["model_surfaces"][asked["surface"]],
        config["sampling"]["descriptor_seeds"],
    )
    problem = Problem(models, Surface.of(surface), asked["pressures"], ADHESIVE, controls)
    rows = describe_presets(models, config["fidelities"], asked, surface, controls)
    heads = ("preset", "points per shortest wavelength", "seeds, fine + coarse", *HEADS)
    return {"presets": table(heads, (describe_preset(row, problem) for row in rows))}


def describe_preset(row: dict, problem: Problem) -> tuple[str, ...]:
    """One line: settings, errors without and with adhesion, cost."""
    settings = row["settings"]
    seeds = f"{settings['seeds']} + {settings['coarse_seeds']}"
    grid = str(settings["pixels_per_wavelength"])
    chosen = Settings(**settings)
    adhesive = (
        percent(max(predicted_error(problem, chosen, p, column) for p in problem.pressures))
        for column in ADHESIVE
    )
    return f"`{row['name']}`", grid, seeds, *row["errors"], *adhesive, row["cost"]


def quote_medians(sources: Sources) -> dict[str, str]:
    """Errors and cost of grids, without and with adhesion, medians over surfaces and loads."""
    knobs = read_knobs(sources)
    return {
        "grids": list_settings(knobs["pixels"], GRIDS, QUANTITIES),
        "adhesive_grids": list_settings(knobs["adhesive pixels"], ADHESIVE_GRIDS, OF_ADHESION),
    }


def read_knobs(sources: Sources) -> dict[str, dict[str, dict[str, str]]]:
    """Texts of the committed medians by knob, setting and quantity."""
    tables = summary.tables(summary.read(sources.root / sources.config["tradeoff"]["summary"]))
    return {
        head[0]: {line[0]: dict(zip(head, line, strict=True)) for line in lines}
        for head, lines in tables
    }


def list_settings(
    by_setting: Mapping[str, Mapping[str, str]],
    settings: Mapping[str, str],
    quantities: Mapping[str, str],
) -> str:
    """Table of some settings and quantities, with the names that readers see."""
    rows = [
        (label, *(by_setting[setting][name] for name in quantities))
        for setting, label in settings.items()
    ]
    return table(("grid points per shortest wavelength", *quantities.values()), rows)


def quote_choices(sources: Sources) -> dict[str, str]:
    """Errors of single settings, and cost of some over that of others."""
    knobs = read_knobs(sources)
    loose, tight = (knobs["tolerance"][one] for one in ("0.0001", "1e-08"))
    plain, controlled = (knobs["seeds"][one] for one in ("32 plain", "4 + 64"))
    theory, adhesive = knobs["model"]["theory"], knobs["adhesive seeds"]
    texts = {
        "tolerance.cost": share_cost(loose, tight),
        "tolerance.error": loose["area"],
        "seeds.plain": plain["a_v"],
        "seeds.controlled": controlled["a_v"],
        "seeds.cost": share_cost(controlled, plain),
        **{f"theory_alone.{name}": theory[name] for name in ("a_v", "mean_gap", "area")},
        "dmt_alone": join_errors(knobs["adhesive model"]["DMT"], RANGES),
        "dmt_alone.threshold": knobs["adhesive model"]["DMT"]["threshold"],
        "dmt_alone.pull_off": knobs["pull_off model"]["DMT"]["pull_off"],
        "maugis": join_errors(knobs["adhesive law"]["maugis"], RANGES),
    }
    for name in (*RANGES, "threshold"):
        plain, controlled = (adhesive[f"8 {kind}"][name] for kind in ("plain", "controlled"))
        texts[f"seeds.{name}"] = f"{controlled} (plain: {plain})"
    return texts


def share_cost(one: Mapping[str, str], other: Mapping[str, str]) -> str:
    """Cost of one setting over that of another."""
    return number(float(one["cost"]) / float(other["cost"]), 2)


def join_errors(errors: Mapping[str, str], names: Sequence[str]) -> str:
    """Errors of some quantities, ``88, 54 and 19 %``."""
    *first, last = (errors[name] for name in names)
    return f"{', '.join(text.removesuffix(' %') for text in first)} and {last}"


NUMBERS = (quote_presets, quote_medians, quote_choices)
