"""Tabulate how far the DMT sum is from the full solution, for the choice between them."""

import csv

import numpy as np

from common.job import start
from stickiness import datasets
from stickiness.accuracy.model_choice import COLUMNS


def main(job):
    with (
        datasets.whole_file(job.output[0]) as temporary,
        temporary.open("w", newline="", encoding="utf-8") as file,
    ):
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        for path in job.input.adhesive:
            data = datasets.read(path, ["dmt_ratio", "dmt_ratio_total_error", "q0_h_rms"])
            writer.writerows(list_rows(data, datasets.parameters(data)))


def list_rows(data, case):
    """List a row of the table for every point that the grid resolves."""
    ratios = data[["dmt_ratio", "dmt_ratio_total_error", "q0_h_rms"]]
    frame = ratios.to_dataframe(dim_order=data.dmt_ratio.dims).reset_index()
    for row in frame[np.isfinite(frame.dmt_ratio_total_error)].itertuples():
        yield (
            case["law"],
            case["hurst"],
            case["magnification"],
            f"{row.pressure:g}",
            f"{row.range_over_h_rms:g}",
            f"{row.adhesion_length_over_range / row.q0_h_rms:g}",
            f"{row.dmt_ratio:.4g}",
            f"{row.dmt_ratio_total_error:.2g}",
        )


if __name__ == "__main__":
    main(start(globals()))
