"""Presets of accuracy from the measured laws, beside those of the configuration."""

from pipeline.job import start
from pipeline.tables import table
from stickiness.accuracy import adhesion, error_laws, plan
from stickiness.core import datasets

HEAD = """\
A preset is the cheapest settings whose predicted error, which covers 90 % of means, stays below
that of the preset in every quantity, on the model surface {surface} at the pressures {pressures}.
Of full adhesion on the same realisations {adhesive} may err by {errors};
without it other settings would do. A number behind a quantity is a range over h_rms. Cost: pairs of
Fourier transforms of 1024 x 1024 doubles for all these pressures, and for one adhesive state of
all seeds.

"""
MODELS = {  # the columns of contact and of full adhesion, by what predicts their errors
    error_laws: [name for names in error_laws.QUANTITIES.values() for name in names],
    adhesion: list(adhesion.COLUMNS),
}
SETTINGS = ("preset", "pixels", "tolerance", "seeds", "coarse seeds", "cost", "adhesive cost")


def main(job):
    laws, presets = error_laws.read_laws(job.input.laws), job.params.presets
    given = job.params.surface, job.params.descriptor_seeds
    lines = []
    for name, error in presets["accuracy"].items():
        chosen = {
            f"{name}: below {error:.0%}": plan.preset_by_rule(laws, presets, name, *given),
            "in the configuration": plan.preset(job.params.fidelities[name]),
            "without full adhesion": plan.preset_by_rule(laws, presets, name, *given, free=True),
        }
        for text, settings in chosen.items():
            lines.append([text, *describe(laws, settings, *given, presets["pressures"])])
    adhesive = presets["adhesive"]
    text = HEAD.format(
        surface=presets["surface"],
        pressures=", ".join(map(str, presets["pressures"])),
        adhesive=" and ".join(adhesive["quantities"]),
        errors=", ".join(f"{error:.3g} ({name})" for name, error in adhesive["accuracy"].items()),
    )
    head = [*SETTINGS, *(name for names in MODELS.values() for name in names)]
    with datasets.whole_file(job.output[0]) as path:
        path.write_text(text + table(head, lines), encoding="utf-8")


def describe(laws, settings, surface, descriptor_seeds, pressures):
    """Settings, their predicted costs, and the largest error of each column over the pressures."""
    on = error_laws.Surface.of(surface)
    cost = error_laws.predicted_cost(laws, settings, on, pressures, descriptor_seeds)
    errors = [
        max(
            model.predicted_error(laws, settings, on, p, column, descriptor_seeds)
            for p in pressures
        )
        for model, columns in MODELS.items()
        for column in columns
    ]
    return [
        settings.pixels_per_wavelength,
        f"{settings.tolerance:.0e}",
        settings.seeds,
        settings.coarse_seeds,
        f"{cost:.0f}",
        f"{adhesion.predicted_cost(laws, settings, on):.0f}",
        *(f"{100 * error:.2g} %" for error in errors),
    ]


if __name__ == "__main__":
    main(start(globals(), "choose_presets"))
