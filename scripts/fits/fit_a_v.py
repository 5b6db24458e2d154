"""Fit a_V to the attractive areas of a simulated case."""

from common.a_v_fits import write_fits
from common.job import start


def main(job):
    write_fits(job.input.areas, job.output[0], job.params.windows, job.input.laws)


if __name__ == "__main__":
    main(start(globals(), "fit_a_v", case="H0.8_zeta64"))
