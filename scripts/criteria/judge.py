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
    for name in dataset:  # of the surfaces, one may lack numbers that others have
        missing = max((one[name].attrs.get("nan_means", "") for one in every), key=len)
        dataset[name].attrs |= {"nan_means": missing} if missing else {}
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
