"""Verdict for every material on every surface, and the same as a page."""

from common.job import start
from criteria.judging import judge, read_surfaces
from criteria.verdict_markdown import write_markdown
from stickiness import datasets


def main(job):
    surfaces, materials = read_surfaces(job.params.surfaces, job.input), job.params.materials
    labels = {name: datasets.parameters(surface)["label"] for name, surface in surfaces.items()}
    dataset = judge(surfaces, {name: surfaces[name] for name in job.params.own}, job.params)
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
