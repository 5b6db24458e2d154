"""Put every measurement of the trade into one table, and the laws that settings are chosen by."""

import numpy as np
import pandas as pd
import xarray as xr

from pipeline.job import start
from pipeline.numbers import table
from pipeline.tradeoff import summary
from pipeline.tradeoff.adhesion_rows import pull_offs, rows_and_laws, states
from pipeline.tradeoff.fit_laws import Points, add_costs, add_grids, add_offsets, add_sampling
from pipeline.tradeoff.rows import band_rows, grid_rows, node_rows, seed_rows, theory_rows
from pipeline.tradeoff.seed_pool import bank_of
from stickiness.accuracy.error_models import Surface, write_models
from stickiness.core import datasets

COLUMNS = {
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
UNITS = {"seconds": "s", "memory": "MB"}
COMMENT = """\
Laws of error and cost, fitted by the target tradeoff; scripts/stickiness/accuracy.py says how they
are read. To take a new measurement over, copy it here and set the presets that it gives."""
HEAD = """\
Relative errors that cover 90 % and what they cost, a summary of tradeoff.nc: medians over cases.
Cost: pairs of Fourier transforms of 1024 x 1024 doubles per solution (seeds: per mean at one load).

"""


def main(job):
    rows, points = [], Points()
    for name, path in named(job.input.grids).items():
        measured = datasets.read(path)
        rows += grid_rows(name, measured)
        add_grids(points, Surface.of(datasets.parameters(measured)), measured)
    for name, path in named(job.input.seeds).items():
        measured = datasets.read(path)
        grids = named(job.input.grids)
        bank = bank_of(measured, datasets.read(grids[name]) if name in grids else None)
        surface = Surface.of(datasets.parameters(measured))
        add_sampling(points, surface, bank)
        add_offsets(points, surface, bank)
        add_costs(points, surface, measured)
        rows += seed_rows(name, measured, bank)
        rows += theory_rows(name, measured, bank, points)
    for path in job.input.bands:
        rows += band_rows(datasets.read(path), points)
    rows += node_rows(datasets.read(job.input.theory))
    for what, files, quantities in (
        ("adhesive", job.input.adhesive, states),
        ("pull_off", job.input.pull_off, pull_offs),
    ):
        for name, path in named(files).items():
            measured = datasets.read(path)
            rows += rows_and_laws(name, measured, quantities(measured), points, what)
    found = pd.DataFrame(rows, columns=list(COLUMNS))
    datasets.write(
        dataset_of(found),
        job.output.dataset,
        title="error and cost of every setting",
        parameters={"cases": list(named(job.input.grids))},
    )
    laws = points.laws()
    laws |= {
        # The control of full adhesion is its DMT limit, in proportion to an attractive area.
        ("coarse_share", column): laws["coarse_share", "attractive_area_0.1"]
        for part, column in [*laws]
        if part == "fine_share" and ("coarse_share", column) not in laws
    }
    with datasets.whole_file(job.output.laws) as path:
        write_models(path, laws, COMMENT)
    medians = middle(found)
    with datasets.whole_file(job.output.summary) as path:
        summary.write(path, medians)
    with datasets.whole_file(job.output.table) as path:
        tables = summary.tables(medians)
        path.write_text(HEAD + "\n".join(table(*each) for each in tables), encoding="utf-8")


def named(paths):
    """Files by the name of their surface."""
    return {path.rsplit("/", 1)[1].removesuffix(".nc"): path for path in paths}


def dataset_of(found):
    """The table as a dataset with one row for every setting, case and quantity."""
    dataset = xr.Dataset(
        {
            name: ("row", found[name].astype(float if name in list(COLUMNS)[4:] else str).values)
            for name in COLUMNS
        },
        coords={"row": np.arange(len(found))},
    )
    missing = {"bias": "not measured", "memory": "not measured", "seconds": "not measured"}
    missing["cost"] = "not measured"
    texts = {
        name: (UNITS.get(name, "1"), text, *([missing[name]] if name in missing else []))
        for name, text in COLUMNS.items()
    }
    return datasets.annotate(dataset, row=("1", "number of the row"), **texts)


def middle(found):
    """Medians over cases, with one row for every setting of every knob and every quantity."""
    keys, values = ["knob", "setting", "quantity"], ["error", "cost", "memory"]
    return found.groupby(keys, sort=False)[values].median().reset_index()


if __name__ == "__main__":
    main(start(globals(), "tabulate_tradeoff"))
