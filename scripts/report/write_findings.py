"""The findings: what a run says, with its numbers, as one page of Markdown."""

from pathlib import Path

import numpy as np
import pandas as pd

from common import remaining_table
from common.conventions import VARIANT, at_load
from common.job import start
from common.templates import make_environment
from figures.plot_fig10 import select_certain
from stickiness import datasets, error_budget
from stickiness.criteria import equivalent_sphere

WELL_KNOWN = 0.25  # relative error of a predicted work that counts as met
RESOLVED = 3.9  # pixels in the cohesive zone from which simulated works are taken as known
LEAST = 0.05  # remaining share from which predicted works are compared
LEAST_AREA = 0.2  # attractive over contact area from which the sphere is compared
ENERGY_RATIOS = (0.3, 0.4, 0.6, 0.8, 1.1, 1.5, 2.5)  # bins of w/U_full
SHOWN_SETTINGS = ("points per wavelength", "seeds", "model")  # of contact without adhesion


def main(job):
    files = {name: read_all(paths) for name, paths in job.input.items() if name != "template"}
    environment = make_environment(Path(job.input.template).parent)
    page = environment.get_template(Path(job.input.template).name).render(
        fidelity=job.params.fidelity,
        claims=list_claims(files["claims"][0]),
        cells=compare_cells(files["a_v"], files["lattices"]),
        gamma=list_gamma(files["gamma"][0]),
        dmt=compare_dmt(files["dmt_error"][0]),
        sphere=compare_sphere(files["edges"]),
        remaining=compare_remaining(files["remaining"][0]),
        verdicts=list_verdicts(files["verdicts"][0]),
        experiments=count_experiments(files["experiments"][0]),
        settings=list_settings(files["tradeoff"][0]),
    )
    with datasets.whole_file(job.output[0]) as path:
        path.write_text(page, encoding="utf-8")


def read_all(paths):
    """Datasets or tables of one or several files."""
    paths = [paths] if isinstance(paths, str) else paths
    return [
        pd.read_csv(path, comment="#") if path.endswith(".csv") else datasets.read(path)
        for path in paths
    ]


def list_claims(data):
    columns = ["statement", "verdict", "value", "value_total_error", "claimed"]
    return data[columns].to_dataframe().reset_index().to_dict("records")


def compare_cells(simulated, lattices):
    """a_V of every complete case beside theory on the spectrum of its cell, at the paper's load."""
    rows = []
    for found, lattice in zip(simulated, lattices, strict=True):
        made = datasets.parameters(found)
        at = at_load(found).isel(window=0)
        theory = at_load(lattice).isel(window=0).sel(variant=VARIANT)
        rows.append(
            {
                "hurst": made["hurst"],
                "zeta": made["magnification"],
                "waves": made.get("window", 1),
                "a_v": (float(at.a_v_mean), float(error_budget.total_error(at, "a_v_mean"))),
                "theory": float(theory.a_v),
            }
        )
    return sorted(rows, key=lambda row: (row["waves"], row["hurst"], row["zeta"]))


def list_gamma(gamma):
    """Best gamma of each quantity by correction, with its confidence interval."""
    names = ["gamma", "gamma_low", "gamma_high"]
    return {
        str(correction): {
            str(quantity): tuple(
                float(gamma[name].sel(correction=correction, quantity=quantity)) for name in names
            )
            for quantity in gamma["quantity"].values
            if str(quantity) != "all"
        }
        for correction in gamma.correction.values
    }


def compare_dmt(data):
    """1/kappa_ad of the weakest adhesion over its DMT limit, by range."""
    weak = at_load(data).isel(adhesion_length_over_range=0)
    error = error_budget.total_error(weak, "dmt_ratio")
    return [
        (float(range_), (float(ratio), float(spread)))
        for range_, ratio, spread in zip(weak.range_over_h_rms, weak.dmt_ratio, error, strict=True)
        if np.isfinite(ratio)
    ]


def compare_sphere(edges):
    """Simulated weak attraction over that of the equivalent sphere: mean, scatter and number."""
    area, strength, _, ratio, _ = select_certain(edges)
    ratio = ratio[(strength < equivalent_sphere.WEAK) & (area >= LEAST_AREA)]
    return {"ratio": (ratio.mean(), ratio.std(ddof=1)), "points": ratio.size}


def compare_remaining(table):
    """Share of predicted works near the simulated ones, and means by energy ratio."""
    table = table[remaining_table.is_wide(table)]
    fine = table[table.pixels_in_zone >= RESOLVED]
    ratios = [fine.predicted / fine[name] for name in ("approach", "separation")]
    remaining = [fine[name] > LEAST for name in ("approach", "separation")]
    works = pd.concat([ratio[more] for ratio, more in zip(ratios, remaining, strict=True)])
    tough = table[table.zone < 0.11]
    groups = tough.groupby(pd.cut(tough.energy_ratio, ENERGY_RATIOS), observed=True)
    columns = ["energy_ratio", "approach", "separation", "predicted", "pull_off"]
    return {
        "points": len(table),
        "resolved": len(fine),
        "works": len(works),
        "near": float((abs(works - 1) < WELL_KNOWN).mean()),
        "within": WELL_KNOWN,
        "least": LEAST,
        "means": groups[columns].mean().to_dict("records"),
    }


def list_verdicts(data):
    """Word of every pair by material and surface, and the number of pairs by word."""
    words = [word.replace("_", " ") for word in data.verdict.attrs["flag_meanings"].split()]
    codes = data.verdict.transpose("material", "surface").values
    counts = {word: int((codes == code).sum()) for code, word in enumerate(words)}
    return {
        "counts": {word: count for word, count in counts.items() if count},
        "pairs": codes.size,
        "surfaces": [str(name) for name in data.surface.values],
        "rows": [
            (str(material), [words[code] for code in row])
            for material, row in zip(data.material.values, codes, strict=True)
        ],
    }


def count_experiments(data):
    """Number of published observations that test the prediction, by outcome."""
    outcomes = data.outcome.attrs["flag_meanings"].split()
    codes = data.outcome.values[data.tests.values == 1]
    return {
        "tested": codes.size,
        "counts": {
            word.replace("_", " "): int((codes == code).sum())
            for code, word in zip(data.outcome.attrs["flag_values"], outcomes, strict=True)
            if (codes == code).any()
        },
    }


def list_settings(table):
    """Median error and cost of every value of a setting, one table for each setting."""
    shown = {}
    for setting in SHOWN_SETTINGS:
        part = table[(table.problem == "contact") & (table.setting == setting)]
        errors = part.pivot_table(index="value", columns="quantity", values="error", sort=False)
        costs = part.groupby("value", sort=False).cost.median()
        shown[setting] = {
            "quantities": [str(name).replace("_", " ") for name in errors.columns],
            "rows": [
                (name, list(row), costs[name])
                for name, row in zip(errors.index, errors.values, strict=True)
            ],
        }
    return shown


if __name__ == "__main__":
    main(start(globals(), "write_findings"))
