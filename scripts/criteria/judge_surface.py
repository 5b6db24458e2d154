"""Verdict for every material on one surface: the limits, the thresholds and what to tell models."""

import json

import xarray as xr

from common.job import start
from stickiness import __version__, datasets
from stickiness.entries.material import Material
from stickiness.verdicts.judgement import judge
from stickiness.verdicts.rough_surface import Surface
from stickiness.verdicts.verdict import StickinessVerdict


def main(job):
    name = job.wildcards.real_surface
    params = job.params
    written = {
        "title": f"verdicts of the stickiness criteria: {params.label}",
        "parameters": {"materials": params.materials},
    }
    if reason := datasets.read(job.input.surface).attrs.get("unread"):
        record = xr.Dataset(attrs={"unread": reason})
        datasets.write(record, job.output.verdicts, **written)
        write_contact_laws({"not_judged": [reason]}, params.label, job.output.contact_laws)
        return

    # The surface, and those of materials that are rough themselves: maybe the same.
    paths = dict(zip(params.material_surfaces, job.input.material_surfaces, strict=True))
    opened = {path: Surface.open(path) for path in {job.input.surface, *paths.values()}}
    surface = opened[job.input.surface]
    material_surfaces = {other: opened[path] for other, path in paths.items()}
    materials = {
        key: Material.from_entry(entry, material_surfaces)
        for key, entry in params.materials.items()
    }

    verdicts = judge(materials, {name: surface})
    datasets.write(verdicts, job.output.verdicts, **written)
    pairs = {"pairs": list_contact_laws(verdicts.sel(surface=name))}
    write_contact_laws(pairs, params.label, job.output.contact_laws)


def list_contact_laws(verdicts):
    """Verdict and effective attraction of every material, for DEM and FE models."""
    laws = []
    for key in verdicts.material.values:
        cell = verdicts.sel(material=key)
        laws.append({"material": cell.material_label.item()} | StickinessVerdict(cell).to_dict())
    return laws


def write_contact_laws(contents, label, output):
    """Write what models need, or why there is nothing."""
    contents = {"version": __version__, "surface": label} | contents
    with datasets.whole_file(output) as path:
        text = json.dumps(contents, indent=1, ensure_ascii=False, allow_nan=False)
        path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main(start(globals()))
