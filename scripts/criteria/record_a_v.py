"""Record the a_V that simulation gives at one load, for the criterion to use without simulating."""

import csv

from pipeline.job import start
from pipeline.verdicts.a_v import RECORDED
from stickiness.core import datasets

HEAD = """\
# a_V of {case} in every window of the fit, from the target a_v at fidelity of {pixels} points per
# shortest wavelength and {seeds} seeds. To take a new measurement over, copy it here.
"""


def main(job):
    fit = datasets.read(job.input.a_v, ["a_v_mean", "a_v_standard_error"])
    fit = fit.sel(pressure=job.params.pressure, method="nearest").fillna(0.0)
    made = datasets.parameters(fit)
    names = ("window_low", "window_high", "a_v_mean", "a_v_standard_error")
    columns = [fit[name].values for name in (*names, "a_v_discretisation_error")]
    with datasets.whole_file(job.output[0]) as path, path.open("w", encoding="utf-8") as file:
        file.write(
            HEAD.format(
                case=made["case"],
                pixels=made["pixels_per_wavelength"],
                seeds=len(made["seeds"]),
            )
        )
        table = csv.writer(file, lineterminator="\n")
        table.writerow(RECORDED)
        for row in zip(*columns, strict=True):
            table.writerow([f"{float(fit.pressure):g}", *(f"{value:.7g}" for value in row)])


if __name__ == "__main__":
    main(start(globals(), "record_a_v"))
