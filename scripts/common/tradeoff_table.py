"""The committed table of errors and costs: medians over surfaces and loads of every setting.

It also holds what verdicts cost and leave open, by what they rest on.
"""

import numpy as np

from common import committed

KEYS = ["problem", "quantity", "setting", "value"]
COMMENT = """\
# Error and cost of each setting and each model, from the target tradeoff: medians over surfaces and
# loads, one setting varied at a time. Errors are relative and cover 90 %. Cost: pairs of Fourier
# transforms of 1024 x 1024 doubles, per solution (seeds: per mean) at one load. A new measurement
# is taken over by copying it here. Of a verdict, by what it rests on (setting) on how many points a
# side (value), over pairs of maps and works of adhesion, whose number is that of `pairs`: median
# error of the share that remains and median width of its limits, both in shares of w; shares of the
# pairs outside the limits, undecided at 10 % of w, and decided wrongly. Cost of a verdict: median
# processor time in seconds.
"""
VERDICT = "verdict"  # problem of the rows of verdicts
VERDICT_QUANTITIES = ("pairs", "share", "width", "outside", "undecided", "wrong")


def write(path, medians):
    text = medians.to_csv(index=False, float_format="%.6g", lineterminator="\n")
    path.write_text(COMMENT + text, encoding="utf-8")


def read(path):
    """Read the table of medians; errors as of `committed.read`."""
    return committed.read(path, (*KEYS, "error", "cost"), "tradeoff", dtype={"value": str})


def tables(medians):
    """Head and lines of a table for every problem and setting but verdicts, as texts."""
    medians = medians[medians.problem != VERDICT]
    for (problem, setting), part in medians.groupby(["problem", "setting"], sort=False):
        errors = part.pivot_table("error", "value", "quantity", sort=False).map(percent)
        cost = part.groupby("value", sort=False).cost.median().map("{:.3g}".format)
        yield [f"{problem}: {setting}", *errors, "cost"], errors.assign(cost=cost).itertuples()


def list_verdicts(medians):
    """List ways and grids of verdicts, with `VERDICT_QUANTITIES`, `points` and `seconds`."""
    rows = medians[medians.problem == VERDICT]
    return [
        {"way": way, "points": int(points), "seconds": part.cost.iloc[0]}
        | dict(zip(part.quantity, part.error, strict=True))
        for (way, points), part in rows.groupby(["setting", "value"], sort=False)
    ]


def percent(value):
    return f"{100 * value:.2g} %" if np.isfinite(value) else "–"
