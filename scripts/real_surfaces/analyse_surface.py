"""What is known of a real surface, from parameters, a drawing or measured topographies.

All kinds have the same variables, so that verdicts treat them alike, see `stickiness.Surface`.
"""

import logging

from common.job import start
from stickiness.verdicts.rough_surface import Surface


def main(job):
    name = job.wildcards.real_surface
    entry = job.params.surface
    surface = Surface.from_entry(entry)
    for doubt in surface.not_judged.splitlines():
        logging.warning("no verdict: %s", doubt)
    title = f"spectrum of the real surface {name}"
    surface.write(job.output[0], title=title, parameters={"surface": name, **entry})


if __name__ == "__main__":
    main(start(globals()))
