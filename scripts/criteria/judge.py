"""Join the verdicts on all surfaces, and write them as a page."""

import xarray as xr

from pipeline.job import start
from pipeline.verdicts.markdown import write_markdown
from stickiness.core import datasets

NEEDED = ("remaining", "margin", "verdict", "probability")


def main(job):
    every = [datasets.read(path, NEEDED) for path in job.input]
    labels = {str(one.surface.item()): datasets.parameters(one)["label"] for one in every}
    dataset = xr.concat(every, "surface", data_vars="minimal", coords="minimal", join="exact")
    materials = datasets.parameters(every[0])["materials"]
    datasets.write(
        dataset,
        job.output.dataset,
        title="verdicts of the stickiness criteria",
        parameters={"materials": materials, "labels": labels},
    )
    with datasets.whole_file(job.output.table) as path:
        path.write_text(write_markdown(dataset, materials, labels), encoding="utf-8")


if __name__ == "__main__":
    main(start(globals(), "judge"))
