"""Verdict for every material on one surface."""

from common.job import start
from criteria.verdicts import judge_materials, read_surfaces
from stickiness import datasets


def main(job):
    name = job.wildcards.real_surface
    surfaces = read_surfaces([name], [job.input.surface])
    material_surfaces = read_surfaces(job.params.material_surfaces, job.input.material_surfaces)
    label = datasets.parameters(surfaces[name])["label"]
    title = f"verdicts of the stickiness criteria: {label}"
    parameters = {"materials": job.params.materials, "label": label}
    verdicts = judge_materials(surfaces, material_surfaces, job.params)
    datasets.write(verdicts, job.output[0], title=title, parameters=parameters)


if __name__ == "__main__":
    main(start(globals(), "judge_surface", real_surface="jacksboro"))
