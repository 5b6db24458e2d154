"""Tabulate how far the DMT limit is from the full solution, for the choice between them."""

import csv

import numpy as np

from common.job import start
from stickiness import datasets
from stickiness.accuracy.model_choice import COLUMNS


def main(job):
    needed = ["dmt_ratio", "dmt_ratio_total_error", "q0_h_rms"]
    with datasets.whole_file(job.output[0]) as temporary, temporary.open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        for path in job.input.adhesive:
            writer.writerows(list_rows(datasets.read(path, needed)))


def list_rows(data):
    """Rows of the table for every point that the grid resolves."""
    made = datasets.parameters(data)
    for index in np.ndindex(data.dmt_ratio.shape):
        point = data.isel(dict(zip(data.dmt_ratio.dims, index, strict=True)))
        spread = float(point.dmt_ratio_total_error)
        if np.isfinite(spread):
            yield (
                *(made[name] for name in ("law", "hurst", "magnification")),
                *(f"{float(point[name]):g}" for name in ("pressure", "range_over_h_rms")),
                f"{float(point.adhesion_length_over_range / point.q0_h_rms):g}",
                f"{float(point.dmt_ratio):.4g}",
                f"{spread:.2g}",
            )


if __name__ == "__main__":
    main(start(globals(), "tabulate_dmt_error"))
