"""Verdict for every material on every surface, the same as a page, and all pairs side by side."""

from itertools import product

import numpy as np
import pandas as pd

from common.formatting import percent
from common.job import start
from common.materials import find_doubts
from common.templates import write_page
from common.verdicts import KPA, MPA, SHARES, find_limits, find_value
from criteria.verdicts import judge_materials, read_surfaces
from report.table_rows import arrange_pairs
from stickiness import datasets
from stickiness.criteria.a_v_table import THEORY_ERROR
from stickiness.criteria.pair import FULL_SHARE
from stickiness.criteria.registry import CRITERIA, REMAINING
from stickiness.remaining.prediction import DEFAULT_SHARE, PULL_OFF_UNKNOWN

# Head, unit and its size of the quantities that are tabulated with their limits.
TABULATED = {
    "remaining": ("remains", "%", 0.01),
    "pull_off": ("pull-off", "kPa", KPA),
    "modulus_threshold": ("E* threshold", "MPa", MPA),
}
WIDTH = 26  # of a column, in characters


def main(job):
    materials, labels, output = job.params.materials, job.params.labels, job.output
    surfaces = read_surfaces(labels, job.input.surfaces)
    material_surfaces = {name: surfaces[name] for name in job.params.material_surfaces}
    dataset = judge_materials(surfaces, material_surfaces, job.params)
    title = "verdicts of the stickiness criteria"
    parameters = {"materials": materials, "labels": labels}
    datasets.write(dataset, output.dataset, title=title, parameters=parameters)
    shown = describe_page(dataset, materials, labels)
    write_page(job.input.template, output.table, **shown)
    write_page(job.input.page, output.page, files=dict(output.items()), **shown)
    frame = tabulate_pairs(shown["pairs"])
    with datasets.whole_file(output.csv) as path:
        frame.to_csv(path, index=False, float_format="%.6g")
    with datasets.whole_file(output.workbook) as path, pd.ExcelWriter(path) as writer:
        frame.to_excel(
            writer, sheet_name="pairs", index=False, freeze_panes=(1, 2), autofilter=True
        )
        writer.sheets["pairs"].sheet_format.defaultColWidth = WIDTH


def describe_page(dataset, materials, labels):
    """What the pages show; `labels` are those of the surfaces."""
    others = [c for c in CRITERIA.values() if c.has_length and c.name != REMAINING]
    rows = arrange_pairs(dataset, materials, labels)
    rows.sort(key=lambda row: (not row["mine"], -row["sort"]["energy_ratio"]))
    return {
        "wanted": DEFAULT_SHARE,
        "full": FULL_SHARE,
        "theory_error": THEORY_ERROR,
        "doubts": [doubt for entry in materials.values() for doubt in find_doubts(entry)],
        "shares": SHARES,
        "pairs": [row | {"keeps": list_kept(row["pair"])} for row in rows],
        "criteria": CRITERIA,
        "others": [criterion.label for criterion in others],
        "thresholds": compare_thresholds(dataset, others, labels),
    }


def list_kept(pair):
    """Whether a pair keeps shares, by its value and by its limits; empty if it is not judged."""
    by = {"value": 2 * [find_value(pair)], "limits": find_limits(pair)}
    words = ("no", "depends", "yes") if find_value(pair).notnull() else ("",) * 3
    return {
        f"keeps {percent(share)} by {kind}": words[sum(int(x >= share) for x in found)]
        for share, (kind, found) in product(SHARES, by.items())
    }


def tabulate_pairs(rows):
    """A row of numbers for every row of texts, with units in the heads; NaN where not known."""
    found = []
    for row in rows:
        pair = row["pair"]
        cells = {"material": row["material"], "material key": row["key"]}
        cells |= {"surface": row["surface"], "surface key": row["name"]}
        cells |= {"entry": "yours" if row["mine"] else "other", "verdict": row["word"]}
        cells |= {"judged": row["moment"], "E* [MPa]": float(pair.modulus_quoted) / MPA}
        cells["w/U_full"] = float(find_value(pair, "energy_ratio"))
        for name, (head, unit, size) in TABULATED.items():
            numbers = np.array([find_value(pair, name), *find_limits(pair, name)]) / size
            if name == "pull_off" and pair.energy_ratio.max() > PULL_OFF_UNKNOWN:
                numbers[[0, 2]] = np.nan
            parts = zip(("", ", low limit", ", high limit"), numbers, strict=True)
            cells |= {f"{head}{part} [{unit}]": number for part, number in parts}
        found.append(cells | row["keeps"])
    return pd.DataFrame(found)


def compare_thresholds(dataset, others, labels):
    """Label of every surface, and by criterion its thresholds over all materials and both ends."""
    by = dataset.threshold_by_criterion
    ours = by.sel(criterion=REMAINING)
    length = dataset.work_of_adhesion / ours * 1e9
    columns = [length, *(by.sel(criterion=criterion.name) / ours for criterion in others)]
    return [
        (labels[surface], [column.sel(surface=surface) for column in columns])
        for surface in by.surface.values
        if ours.sel(surface=surface).notnull().any()  # else it is not judged
    ]


if __name__ == "__main__":
    main(start(globals(), "judge"))
