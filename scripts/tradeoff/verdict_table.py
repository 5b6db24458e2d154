"""Rows of the summary for verdicts: what every way of judging a map costs and leaves open."""

import numpy as np
import pandas as pd

from common import tradeoff_table as summary
from stickiness.remaining.trial_states import DEFAULT_SHARE

ROUNDING = 1e-4  # of shares: tolerance of simulations


def condense_verdicts(verdicts):
    """Condense verdicts on many maps into rows of the summary.

    Parameters
    ----------
    verdicts : DataFrame
        A row for every pair, way and grid, with the columns of the campaign `verdicts`.

    Returns
    -------
    DataFrame
        The columns of `tradeoff_table`: of every way (`setting`) and grid (`value`) the
        `tradeoff_table.VERDICT_QUANTITIES`, and the median processor time [s] as `cost`.
    """
    known = verdicts.dropna(subset="simulated")
    sticks = known.low >= DEFAULT_SHARE
    fails = known.high < DEFAULT_SHARE
    is_sticky = known.simulated >= DEFAULT_SHARE
    is_inside = known.simulated.between(known.low - ROUNDING, known.high + ROUNDING)
    known = known.assign(
        pairs=1,
        share=abs(known.remaining - known.simulated),
        width=known.high - known.low,
        outside=~is_inside,
        undecided=~(sticks | fails),
        wrong=(sticks & ~is_sticky) | (fails & is_sticky),
    )
    # Ways in their order, and of each the grids from coarse to fine.
    ways = known.way.unique()
    order = pd.Categorical(known.way, ways, ordered=True)
    rows = []
    for (way, grid), part in known.groupby([order, "grid"], observed=True):
        cost = part.seconds.median()
        for quantity, condense in QUANTITIES.items():
            error = float(condense(part[quantity]))
            rows.append((summary.VERDICT, quantity, way, str(grid), error, cost))
    return pd.DataFrame(rows, columns=[*summary.KEYS, "error", "cost"])


#: How the values of all pairs become one.
QUANTITIES = dict.fromkeys(summary.VERDICT_QUANTITIES, np.mean) | {
    "pairs": np.sum,
    "share": np.median,
    "width": np.median,
}
