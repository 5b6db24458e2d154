"""What is known of a real surface, from parameters, a drawing or measured topographies.

All kinds have the same variables, so that verdicts treat them alike, see `stickiness.Surface`.
"""

import logging

import xarray as xr

from common.job import start
from stickiness import datasets
from stickiness.verdicts.rough_surface import Surface


def main(job):
    name = job.wildcards.real_surface
    entry = job.params.surface
    title = f"spectrum of the real surface {name}"
    parameters = {"surface": name, **entry}
    try:
        surface = Surface.from_entry(entry)
    except ValueError as error:
        # Tables show the surface as not judged. Its page and the rule check_surfaces fail.
        logging.warning("not read: %s", error)
        record = xr.Dataset(attrs={"unread": str(error)})
        datasets.write(record, job.output[0], title=title, parameters=parameters)
        return
    for doubt in surface.not_judged.splitlines():
        logging.warning("no verdict: %s", doubt)
    surface.write(job.output[0], title=title, parameters=parameters)


if __name__ == "__main__":
    main(start(globals()))
