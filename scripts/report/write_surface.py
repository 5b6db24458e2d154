"""The page of one surface: verdicts and their reasons, curves, contact, parameters, spectrum."""

from common import provided
from common.job import start
from stickiness import datasets
from stickiness.pages.surface_page import write_surface_page


def main(job):
    inputs = job.input
    if reason := datasets.read(inputs.surface).attrs.get("unread"):
        raise ValueError(reason)
    verdicts = datasets.read(inputs.verdicts, ["verdict", "remaining"])
    names = map(str, verdicts.material.values)
    write_surface_page(
        job.output[0],
        entry=job.params.surface,
        surface=datasets.read(inputs.surface, ["h_rms", "rms_slope", "psd"]),
        verdicts=verdicts,
        files=dict(inputs.items()),
        own=[name for name in names if name not in provided.MATERIALS],
    )


if __name__ == "__main__":
    main(start(globals()))
