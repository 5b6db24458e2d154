"""Fit a_V to the attractive areas of a simulated case."""

from common.job import start
from common.quantities import write_a_v


def main(job):
    write_a_v(job.input.areas, job.output[0], job.params.windows, job.input.laws)


if __name__ == "__main__":
    main(start(globals(), "fit_a_v", case="H0.8_zeta64"))
