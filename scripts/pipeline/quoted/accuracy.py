"""What accuracy costs: presets by the error models, and medians of the committed measurement."""

from pipeline.numbers import percent, table
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
SETTINGS = {"4 extrapolated": "4", "8 extrapolated": "8", "16 extrapolated": "16"}
SETTINGS |= {"8 counted": "8, counted in pixels (one grid)"}
QUANTITIES = {
    "area": "area",
    "attractive_area_0.01": "A_ad(0.01 h_rms)",
    "a_v": "a_V",
    "mean_gap": "mean gap",
    "gap_distribution": "P(u)",
    "cost": "FFT pairs of 1024² a solution",
}


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
    """Errors and cost of grids, medians over surfaces and loads."""
    tables = summary.tables(summary.read(sources.root / sources.config["tradeoff"]["summary"]))
    head, lines = next((head, lines) for head, lines in tables if head[0] == "pixels")
    by_setting = {line[0]: dict(zip(head, line, strict=True)) for line in lines}
    rows = [
        (label, *(by_setting[setting][name] for name in QUANTITIES))
        for setting, label in SETTINGS.items()
    ]
    heads = ("grid points per shortest wavelength", *QUANTITIES.values())
    return {"grids": table(heads, rows)}


NUMBERS = (quote_presets, quote_medians)
