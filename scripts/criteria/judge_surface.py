"""Verdict for every material on one surface: the limits, the thresholds and what to tell models."""

import json

from common.conventions import logarithmic_grid
from common.job import start
from stickiness import __version__, datasets
from stickiness.criteria.pair import WORDS
from stickiness.verdicts.judgement import DECIDED_BY, judge
from stickiness.verdicts.material import Material
from stickiness.verdicts.rough_surface import Surface
from stickiness.verdicts.verdict import describe_contact_law, find_larger, find_limited


def main(job):
    name = job.wildcards.real_surface
    params = job.params

    # The surface, and those of materials that are rough themselves.
    surface = Surface.open(job.input.surface)
    material_surfaces = {
        other: Surface.open(path)
        for other, path in zip(params.material_surfaces, job.input.material_surfaces, strict=True)
    }
    materials = {
        key: Material.from_entry(entry, material_surfaces)
        for key, entry in params.materials.items()
    }

    verdicts = judge(materials, {name: surface}, frequencies=logarithmic_grid(params.frequencies))
    datasets.write(
        verdicts,
        job.output.verdicts,
        title=f"verdicts of the stickiness criteria: {params.labels[name]}",
        parameters={"materials": params.materials, "labels": params.labels},
    )
    write_contact_laws(verdicts.sel(surface=name), materials, params.labels[name], job.output)


def write_contact_laws(verdicts, materials, label, output):
    """Write the verdict and the effective attraction of every material, for DEM and FE models."""
    laws = []
    for key, material in materials.items():
        cell = verdicts.sel(material=key)
        contact_law = describe_contact_law(
            word=WORDS[int(cell.verdict)],
            material=material,
            remaining=find_limited(cell, "remaining"),
            pull_off=find_limited(cell, "pull_off"),
            modulus_threshold=find_limited(cell, "modulus_threshold"),
            energy_ratio=float(cell.energy_ratio.max()),
            decided_by=DECIDED_BY[int(cell.decided_by)],
            contact=float(cell.contact),
            larger=find_larger(cell),
        )
        laws.append({"material": material.label, **contact_law})
    with datasets.whole_file(output.contact_laws) as path:
        contents = {"version": __version__, "surface": label, "pairs": laws}
        path.write_text(json.dumps(contents, indent=1, ensure_ascii=False, allow_nan=False))


if __name__ == "__main__":
    main(start(globals()))
