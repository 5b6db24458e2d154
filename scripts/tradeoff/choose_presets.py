"""Presets of accuracy from the measured laws, beside those of the configuration."""

from common.formatting import table
from common.job import start
from stickiness import datasets
from stickiness.accuracy import adhesion, plan, prediction
from stickiness.accuracy.error_models import Surface, read_models
from stickiness.accuracy.prediction import Problem
from stickiness.accuracy.quantities import MODELLED, columns_of

HEAD = """\
A preset is the cheapest settings whose predicted error, which covers 90 % of means, stays below
that of the preset in every quantity, on the model surface {surface} at the pressures {pressures}.
Of full adhesion on the same realisations {adhesive} may err by {errors};
without it other settings would do. A number behind a quantity is a range over h_rms. Cost: pairs of
Fourier transforms of 1024 x 1024 doubles for all these pressures, and for one adhesive state of
all seeds.

"""
COLUMNS = columns_of(MODELLED)
ADHESIVE = adhesion.COLUMNS


def main(job):
    laws, asked = read_models(job.input.laws), job.params.presets
    where = laws, Surface.of(job.params.surface), asked["pressures"]
    problems = (
        (prediction, Problem(*where, COLUMNS, job.params.descriptor_seeds)),
        (adhesion, Problem(*where, ADHESIVE, job.params.descriptor_seeds)),
    )
    given = job.params.surface, job.params.descriptor_seeds
    lines = []
    for name, error in asked["accuracy"].items():
        chosen = {
            f"{name}: below {error:.0%}": plan.preset_by_rule(laws, asked, name, *given),
            "in the configuration": plan.preset(job.params.fidelities[name]),
            "without full adhesion": plan.preset_by_rule(laws, asked, name, *given, free=True),
        }
        lines += [row(text, problems, settings) for text, settings in chosen.items()]
    head = [
        "preset",
        "pixels",
        "tolerance",
        "seeds",
        "coarse seeds",
        "cost",
        "adhesive cost",
        *COLUMNS,
        *ADHESIVE,
    ]
    with datasets.whole_file(job.output[0]) as path:
        text = HEAD.format(
            surface=asked["surface"],
            pressures=", ".join(map(str, asked["pressures"])),
            adhesive=" and ".join(asked["adhesive"]["quantities"]),
            errors=", ".join(
                f"{error:.3g} ({name})" for name, error in asked["adhesive"]["accuracy"].items()
            ),
        )
        path.write_text(text + table(head, lines), encoding="utf-8")


def row(text, problems, chosen):
    """Settings, their costs, and the largest predicted error of each column over the pressures."""
    costs = [model.predicted_cost(problem, chosen) for model, problem in problems]
    errors = [
        max(model.predicted_error(problem, chosen, p, column) for p in problem.pressures)
        for model, problem in problems
        for column in problem.columns
    ]
    return [
        text,
        chosen.pixels_per_wavelength,
        f"{chosen.tolerance:.0e}",
        chosen.seeds,
        chosen.coarse_seeds,
        *(f"{cost:.0f}" for cost in costs),
        *(f"{100 * error:.2g} %" for error in errors),
    ]


if __name__ == "__main__":
    main(start(globals(), "choose_presets"))
