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
COLUMNS = [column for columns in error_laws.QUANTITIES.values() for column in columns]
ADHESIVE = list(adhesion.COLUMNS)


def main(job):
    laws, asked = error_laws.read_laws(job.input.laws), job.params.presets
    where = (
        error_laws.Surface.of(job.params.surface),
        asked["pressures"],
        job.params.descriptor_seeds,
    )
    given = job.params.surface, job.params.descriptor_seeds
    lines = []
    for name, error in asked["accuracy"].items():
        chosen = {
            f"{name}: below {error:.0%}": plan.preset_by_rule(laws, asked, name, *given),
            "in the configuration": plan.preset(job.params.fidelities[name]),
            "without full adhesion": plan.preset_by_rule(laws, asked, name, *given, free=True),
        }
        lines += [row(text, laws, settings, *where) for text, settings in chosen.items()]
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
            pressures=", ".join(map(str, where[1])),
            adhesive=" and ".join(asked["adhesive"]["quantities"]),
            errors=", ".join(
                f"{error:.3g} ({name})" for name, error in asked["adhesive"]["accuracy"].items()
            ),
        )
        path.write_text(text + table(head, lines), encoding="utf-8")


def errors(laws, chosen, surface, pressures, descriptor_seeds):
    """Largest predicted error of each column over the pressures."""
    return [
        max(
            model.predicted_error(laws, chosen, surface, p, column, descriptor_seeds)
            for p in pressures
        )
        for model, columns in ((error_laws, COLUMNS), (adhesion, ADHESIVE))
        for column in columns
    ]


def row(text, laws, chosen, surface, pressures, descriptor_seeds):
    cost = error_laws.predicted_cost(laws, chosen, surface, pressures, descriptor_seeds)
    found = errors(laws, chosen, surface, pressures, descriptor_seeds)
    return [
        text,
        chosen.pixels_per_wavelength,
        f"{chosen.tolerance:.0e}",
        chosen.seeds,
        chosen.coarse_seeds,
        f"{cost:.0f}",
        f"{adhesion.predicted_cost(laws, chosen, surface):.0f}",
        *(f"{100 * error:.2g} %" for error in found),
    ]


if __name__ == "__main__":
    main(start(globals(), "choose_presets"))
