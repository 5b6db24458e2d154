"""Tabulate every measurement of error and cost, and fit the laws that settings are chosen by."""

from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

from common.formatting import table as markdown_table
from common.job import start
from stickiness import datasets
from stickiness.accuracy.error_models import Surface, write_models
from tradeoff import summary
from tradeoff.adhesion_rows import list_adhesion_rows, list_pull_offs, list_states
from tradeoff.contact_rows import (
    list_band_rows,
    list_grid_rows,
    list_node_rows,
    list_seed_rows,
    list_theory_rows,
)
from tradeoff.fit_laws import Points
from tradeoff.law_points import add_costs, add_grid_errors, add_sampling, add_tolerances
from tradeoff.seed_pool import make_pool

TEXTS = {
    "knob": "what is varied",
    "setting": "its value",
    "case": "surface and load",
    "quantity": "what the error is of",
    "error": "relative error that covers 90 % of single surfaces, or of means for seeds",
    "bias": "relative error of the mean over the surfaces measured",
    "cost": "cost over that of a pair of transforms of 1024 x 1024 doubles",
    "seconds": "processor time",
    "memory": "largest memory held at once",
}
NUMBERS = {"error": "1", "bias": "1", "cost": "1", "seconds": "s", "memory": "MB"}
COMMENT = """\
Error and cost models, fitted by the target tradeoff; scripts/stickiness/accuracy/ says how they
are read. To take a new measurement over, copy it here and set the presets that it gives."""
HEAD = """\
Relative errors that cover 90 % and what they cost, a summary of tradeoff.nc: medians over cases.
Cost: pairs of Fourier transforms of 1024 x 1024 doubles per solution (seeds: per mean at one load).

"""


def main(job):
    rows, points = [], Points()
    grids = {name: datasets.read(path) for name, path in name_files(job.input.grids).items()}
    for name, measured in grids.items():
        rows += list_grid_rows(name, measured)
        add_tolerances(points, surface_of(measured), measured)
    for name, path in name_files(job.input.seeds).items():
        measured = datasets.read(path)
        pool, surface = make_pool(measured, grids.get(name)), surface_of(measured)
        add_sampling(points, surface, pool)
        add_grid_errors(points, surface, pool)
        add_costs(points, surface, measured)
        rows += list_seed_rows(name, measured, pool)
        rows += list_theory_rows(name, measured, pool, points)
    for path in job.input.bands:
        rows += list_band_rows(datasets.read(path), points)
    rows += list_node_rows(datasets.read(job.input.theory))
    for what, files, list_quantities in (
        ("adhesive", job.input.adhesive, list_states),
        ("pull_off", job.input.pull_off, list_pull_offs),
    ):
        for name, path in name_files(files).items():
            measured = datasets.read(path)
            rows += list_adhesion_rows(name, measured, list_quantities(measured), points, what)
    table = pd.DataFrame(rows, columns=list(TEXTS))
    datasets.write(
        make_dataset(table),
        job.output.dataset,
        title="error and cost of every setting",
        parameters={"cases": list(grids)},
    )
    laws = points.fit()
    laws |= {
        # The control of full adhesion is its DMT limit, in proportion to an attractive area.
        ("coarse_share", column): laws["coarse_share", "attractive_area_0.1"]
        for part, column in [*laws]
        if part == "fine_share" and ("coarse_share", column) not in laws
    }
    with datasets.whole_file(job.output.laws) as path:
        write_models(path, laws, COMMENT)
    medians = take_medians(table)
    with datasets.whole_file(job.output.summary) as path:
        summary.write(path, medians)
    with datasets.whole_file(job.output.table) as path:
        tables = [markdown_table(*each) for each in summary.tables(medians)]
        path.write_text(HEAD + "\n".join(tables), encoding="utf-8")


def name_files(paths):
    """Files by the name of their surface."""
    return {Path(path).stem: path for path in paths}


def surface_of(measured):
    return Surface.of(datasets.parameters(measured))


def make_dataset(table):
    """Make a dataset with one row for every setting, case and quantity."""
    variables = {
        name: ("row", table[name].astype(float if name in NUMBERS else str).values)
        for name in TEXTS
    }
    texts = {name: (NUMBERS.get(name, "1"), text) for name, text in TEXTS.items()}
    for name in ("bias", "cost", "seconds", "memory"):
        texts[name] = (*texts[name], "not measured")
    dataset = xr.Dataset(variables, coords={"row": np.arange(len(table))})
    return datasets.annotate(dataset, row=("1", "number of the row"), **texts)


def take_medians(table):
    """Take medians over cases: one row for every setting of every knob and every quantity."""
    keys, values = ["knob", "setting", "quantity"], ["error", "cost", "memory"]
    return table.groupby(keys, sort=False)[values].median().reset_index()


if __name__ == "__main__":
    main(start(globals(), "tabulate_tradeoff"))
