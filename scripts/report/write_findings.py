"""The findings: what a run says, with its numbers, as one page of Markdown."""

import numpy as np
import pandas as pd

from common import remaining_table
from common import tradeoff_table as summary
from common.conventions import VARIANT, at_load
from common.edge_points import select_certain
from common.job import start
from common.templates import write_page
from stickiness import datasets, error_budget
from stickiness.criteria import equivalent_sphere
from stickiness.criteria.pair import WORDS

WELL_KNOWN = 0.25  # relative error of a predicted work that counts as met
LEAST = 0.05  # remaining share from which predicted works are compared
LEAST_AREA = 0.2  # attractive over contact area from which the sphere is compared
ENERGY_RATIOS = (0.3, 0.4, 0.6, 0.8, 1.1, 1.5, 2.5)  # bins of w/U_full
SHOWN_SETTINGS = ("points per wavelength", "seeds", "model")  # without adhesion


def main(job):
    read, inputs = datasets.read, job.input
    write_page(
        inputs.template,
        job.output[0],
        fidelity=job.params.fidelity,
        claims=read(inputs.claims).drop_dims("source").to_dataframe().reset_index(),
        cells=compare_cells(map(read, inputs.a_v), map(read, inputs.lattices)),
        gamma=read(inputs.gamma),
        dmt=compare_dmt(read(inputs.dmt_error)),
        sphere=compare_sphere(list(map(read, inputs.edges))),
        remaining=compare_remaining(remaining_table.read(inputs.remaining)),
        verdicts=count_words(read(inputs.verdicts)),
        experiments=count_experiments(read(inputs.experiments)),
        settings=[
            (head, lines)
            for head, lines in summary.tables(summary.read(inputs.tradeoff))
            if head[0] in [f"contact: {name}" for name in SHOWN_SETTINGS]
        ],
    )


def compare_cells(simulated, lattices):
    """a_V of every complete case beside theory on the spectrum of its cell, at the paper's load."""
    rows = []
    for found, lattice in zip(simulated, lattices, strict=True):
        made = datasets.parameters(found)
        at = at_load(found).isel(window=0)
        rows.append(
            {
                "hurst": made["hurst"],
                "zeta": made["magnification"],
                "waves": made.get("window", 1),
                "a_v": (at.a_v_mean, error_budget.total_error(at, "a_v_mean")),
                "theory": at_load(lattice).isel(window=0).sel(variant=VARIANT).a_v,
            }
        )
    return sorted(rows, key=lambda row: (row["waves"], row["hurst"], row["zeta"]))


def compare_dmt(data):
    """1/kappa_ad of the weakest adhesion over its DMT limit, by range."""
    weak = at_load(data).isel(adhesion_length_over_range=0)
    error = error_budget.total_error(weak, "dmt_ratio")
    rows = zip(weak.range_over_h_rms, weak.dmt_ratio, error, strict=True)
    return [(range_, (ratio, spread)) for range_, ratio, spread in rows if np.isfinite(ratio)]


def compare_sphere(edges):
    """Simulated weak attraction over that of the equivalent sphere: mean, scatter and number."""
    area, strength, _, ratio, _ = select_certain(edges)
    ratio = ratio[(strength < equivalent_sphere.WEAK) & (area >= LEAST_AREA)]
    return {"ratio": (ratio.mean(), ratio.std(ddof=1)), "points": ratio.size, "least": LEAST_AREA}


def compare_remaining(table):
    """Share of predicted works near the simulated ones, and means by energy ratio."""
    wide = remaining_table.is_wide(table)
    ratios = {
        name: pd.concat(
            [(rows.predicted / rows[n])[rows[n] > LEAST] for n in ("approach", "separation")]
        )
        for name, rows in (("wide", table[wide]), ("narrow", table[~wide]))
    }
    table = table[wide]
    tough = table[table.zone < 0.11]
    groups = tough.groupby(pd.cut(tough.energy_ratio, ENERGY_RATIOS), observed=True)
    columns = ["energy_ratio", "approach", "separation", "predicted", "pull_off"]
    return {
        "points": len(table),
        "works": {name: len(ratio) for name, ratio in ratios.items()},
        "near": {n: float((abs(ratio - 1) < WELL_KNOWN).mean()) for n, ratio in ratios.items()},
        "within": WELL_KNOWN,
        "least": LEAST,
        "means": groups[columns].mean(),
    }


def count_words(data):
    """Word of every pair by material and surface, and the number of pairs by word."""
    codes = data.verdict.transpose("material", "surface").to_pandas()
    table = codes.map(WORDS.__getitem__)
    return {"counts": table.stack().value_counts().to_dict(), "pairs": table.size, "table": table}


def count_experiments(data):
    """Number of published observations that test the prediction, by outcome."""
    words = dict(zip(data.outcome.flag_values, data.outcome.flag_meanings.split(), strict=True))
    codes = pd.Series(data.outcome.values[data.tests.values == 1])
    counts = codes.value_counts(sort=False).sort_index()
    return {
        "tested": codes.size,
        "counts": {words[code].replace("_", " "): count for code, count in counts.items()},
    }


if __name__ == "__main__":
    main(start(globals(), "write_findings"))
