"""Verdict for every material on one surface: the limits, the thresholds and what to tell models.

Verdicts of the last run are kept where material, surface and code are still the same.
"""

import hashlib
import json
import logging
from contextlib import suppress
from pathlib import Path

import numpy as np
import xarray as xr

from common.job import start
from criteria.joined_pairs import join_pairs
from stickiness import __version__, datasets
from stickiness.entries import without_texts
from stickiness.entries.material import Material
from stickiness.units import write_quantities
from stickiness.verdicts.judgement import judge
from stickiness.verdicts.rough_surface import Surface
from stickiness.verdicts.verdict import StickinessVerdict


def main(job):
    name = job.wildcards.real_surface
    params = job.params
    output = job.output
    judged_from = describe_origins(job)
    written = {
        "title": f"verdicts of the stickiness criteria: {params.label}",
        "parameters": {"materials": params.materials, "judged_from": judged_from},
    }
    if reason := datasets.read(job.input.surface).attrs.get("unread"):
        record = xr.Dataset(attrs={"unread": reason})
        written["parameters"] = {"materials": params.materials}
        datasets.write(record, output.verdicts, **written)
        write_contact_laws({"not_judged": [reason]}, params.label, output.contact_laws)
        return

    parts = read_kept(output.verdicts, judged_from)
    kept = {key for part in parts for key in part.material.values}
    new = [key for key in params.materials if key not in kept]
    logging.info("judges %s", ", ".join(new) or "no material anew")
    if new:
        parts.append(judge_materials(job, new))
    verdicts = join_pairs(parts, "material").sel(material=list(params.materials))
    # A label may be another one than at the time of the judgement.
    labels = np.array([entry["label"] for entry in params.materials.values()], dtype=object)
    verdicts["material_label"] = verdicts.material_label.copy(data=labels)
    datasets.write(verdicts, output.verdicts, **written)
    pairs = {"pairs": list_contact_laws(verdicts.sel(surface=name))}
    write_contact_laws(pairs, params.label, output.contact_laws)


def describe_origins(job):
    """Digest, by material, of all that its verdict is made from."""
    params = job.params
    files = {path: digest_file(path) for path in [job.input.surface, *job.input.material_surfaces]}
    paths = dict(zip(params.material_surfaces, job.input.material_surfaces, strict=True))
    common = [params.code, datasets.provenance(), files[job.input.surface]]
    origins = {}
    for key, entry in params.materials.items():
        own_surface = files.get(paths.get(entry["surface"]))
        origin = [*common, write_quantities(without_texts(entry)), own_surface]
        text = json.dumps(origin, sort_keys=True)
        origins[key] = hashlib.sha256(text.encode()).hexdigest()
    return origins


def digest_file(path):
    """Digest of the content of a file."""
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()


def read_kept(path, judged_from):
    """Verdicts of the last run on what is the same now, a list of one dataset or none."""
    with suppress(datasets.DatasetError):
        last = datasets.read(path)
        before = datasets.parameters(last).get("judged_from", {})
        kept = [key for key in judged_from if before.get(key) == judged_from[key]]
        return [last.sel(material=kept)] if kept else []
    return []


def judge_materials(job, names):
    """Verdicts on these materials, of which some may be rough themselves."""
    params = job.params
    # The surface, and those of materials: maybe the same.
    paths = dict(zip(params.material_surfaces, job.input.material_surfaces, strict=True))
    opened = {path: Surface.open(path) for path in {job.input.surface, *paths.values()}}
    material_surfaces = {other: opened[path] for other, path in paths.items()}
    materials = {
        key: Material.from_entry(params.materials[key], material_surfaces) for key in names
    }
    return judge(materials, {job.wildcards.real_surface: opened[job.input.surface]})


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
