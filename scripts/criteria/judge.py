"""All pairs side by side: the verdicts on every surface as one dataset, and the pages of it."""

from itertools import product
from pathlib import Path

import numpy as np
import pandas as pd

from common.job import start
from common.pairs import SHARES, arrange_pairs, list_doubts
from criteria.joined_pairs import join_pairs
from stickiness import datasets
from stickiness.criteria.a_v_theory import THEORY_ERROR
from stickiness.criteria.pair import FULL_SHARE
from stickiness.criteria.registry import CRITERIA, REMAINING
from stickiness.formatting import percent
from stickiness.pages.rendering import write_page
from stickiness.remaining.roughness import PULL_OFF_UNKNOWN
from stickiness.remaining.trial_states import DEFAULT_SHARE
from stickiness.verdicts.judgement import withhold
from stickiness.verdicts.limits import read_limited

KPA = 1e3  # [Pa]
MPA = 1e6
# Head, unit and its size of the quantities that are tabulated with their limits.
TABULATED = {
    "remaining": ("remains", "%", 0.01),
    "pull_off": ("pull-off", "kPa", KPA),
    "modulus_threshold": ("threshold of E", "MPa", MPA),
    "plane_strain_modulus_threshold": ("threshold of E*", "MPa", MPA),
}
LENGTHS = ("rms_height", "scan", "contact")  # of a surface
COLUMN_WIDTH = 26  # in characters


def main(job):
    labels = job.params.labels
    output = job.output
    paths = {Path(path).stem: path for path in job.input.verdicts}
    verdicts = join_unread({name: datasets.read(path) for name, path in paths.items()})
    dataset = join_pairs(verdicts, "surface")
    datasets.write(
        dataset,
        output.dataset,
        title="verdicts of the stickiness criteria",
        parameters={**datasets.parameters(verdicts[0]), "labels": labels},
    )
    shown = describe_page(dataset, labels)
    write_page(job.input.template, output.table, **shown)
    write_page(job.input.page, output.page, files=dict(output.items()), **shown)
    frame = tabulate_pairs(shown["pairs"])
    with datasets.whole_file(output.csv) as path:
        frame.to_csv(path, index=False, float_format="%.6g")
    with datasets.whole_file(output.workbook) as path, pd.ExcelWriter(path) as writer:
        frame.to_excel(
            writer, sheet_name="pairs", index=False, freeze_panes=(1, 2), autofilter=True
        )
        writer.sheets["pairs"].sheet_format.defaultColWidth = COLUMN_WIDTH


def join_unread(verdicts):
    """Verdicts on every surface; those of a surface that could not be read are withheld."""
    unread = {
        name: each.attrs["unread"] for name, each in verdicts.items() if "unread" in each.attrs
    }
    joined = [each for name, each in verdicts.items() if name not in unread]
    if not joined:
        raise ValueError("; ".join(unread.values()))
    for name, reason in unread.items():
        # Of another surface's row only what is given of materials stays.
        row = joined[0].assign_coords(surface=[name])
        for text in ("not_judged", "doubts"):
            row[text] = row[text].copy(data=np.full(row[text].shape, reason, dtype=object))
        for length in LENGTHS:
            row[length] = row[length].copy(data=[np.nan])
            row[length].attrs.setdefault("nan_means", "the surface could not be read")
        joined.append(withhold(row))
    if unread:
        joined[0] = joined[0].assign_attrs(unread=", ".join(unread))
    return joined


def describe_page(dataset, labels):
    """What the pages show; `labels` are those of the surfaces."""
    others = [c for c in CRITERIA.values() if c.has_length and c.name != REMAINING]
    rows = arrange_pairs(dataset, labels)
    rows.sort(key=lambda row: (not row["mine"], -row["sort"]["energy_ratio"]))
    return {
        "wanted": DEFAULT_SHARE,
        "full": FULL_SHARE,
        "theory_error": THEORY_ERROR,
        "doubts": list_doubts(dataset),
        "shares": SHARES,
        "pairs": [row | {"keeps": list_kept(row["pair"])} for row in rows],
        "criteria": CRITERIA,
        "others": [criterion.label for criterion in others],
        "thresholds": compare_thresholds(dataset, others, labels),
    }


def list_kept(pair):
    """Whether a pair keeps shares, by its value and by its limits; empty if it is not judged."""
    value, *limits = read_limited(pair.remaining)
    bounds = {"value": (value, value), "limits": limits}
    answers = ("", "", "") if np.isnan(value) else ("no", "depends", "yes")
    return {
        f"keeps {percent(share)} by {kind}": answers[int(low >= share) + int(high >= share)]
        for share, (kind, (low, high)) in product(SHARES, bounds.items())
    }


def tabulate_pairs(rows):
    """A row of numbers for every row of texts, with units in the heads; NaN where not known."""
    table = []
    for row in rows:
        pair = row["pair"]
        has_poisson = bool(np.isfinite(pair.poisson_ratio))
        cells = {
            "material": keep_text(row["material"]),
            "material key": row["key"],
            "surface": keep_text(row["surface"]),
            "surface key": row["name"],
            "entry": "yours" if row["mine"] else "other",
            "verdict": row["word"],
            "judged": row["moment"],
            "E [MPa]": float(pair.quoted_modulus) / MPA if has_poisson else np.nan,
            "E* [MPa]": float(pair.plane_strain_modulus) / MPA,
            "w/U_full": float(pair.energy_ratio.sel(end="rough")),
        }
        for name, (head, unit, size) in TABULATED.items():
            value, low, high = (number / size for number in read_limited(pair[name]))
            if name == "pull_off" and pair.energy_ratio.max() > PULL_OFF_UNKNOWN:
                value = np.nan
                high = np.nan
            if name == "modulus_threshold" and not has_poisson:
                value = low = high = np.nan
            cells[f"{head} [{unit}]"] = value
            cells[f"{head}, low limit [{unit}]"] = low
            cells[f"{head}, high limit [{unit}]"] = high
        table.append(cells | row["keeps"])
    return pd.DataFrame(table)


def keep_text(label):
    """A label that no program of tables takes for a formula."""
    return f"'{label}" if label.startswith(("=", "+", "-", "@")) else label


def compare_thresholds(dataset, others, labels):
    """Label of every surface, and by criterion its thresholds over all materials and both ends."""
    thresholds = dataset.threshold_by_criterion
    ours = thresholds.sel(criterion=REMAINING)
    length = dataset.work_of_adhesion / ours * 1e9
    ratios = [thresholds.sel(criterion=criterion.name) / ours for criterion in others]
    columns = [length, *ratios]
    return [
        (labels[surface], [column.sel(surface=surface) for column in columns])
        for surface in thresholds.surface.values
        if ours.sel(surface=surface).notnull().any()  # else it is not judged
    ]


if __name__ == "__main__":
    main(start(globals()))
