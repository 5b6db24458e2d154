"""The verdict on every pair, and which criteria disagree with it."""

from pipeline.verdicts.probabilities import QUANTILES
from stickiness.criteria.pair import decide
from stickiness.criteria.registry import EDGES, FULL_CONTACT


def decide_pairs(dataset):
    """Code of the verdict over the whole range of the surface, the limits of a_V and of the model.

    On a measured surface the draws decide: sticky if at least 95 % of them stick, not sticky if at
    most 5 % do.
    """
    surely = (dataset.margin_low > 1).all("end")
    possibly = (dataset.margin_high > 1).any("end")
    if "probability" in dataset:
        drawn = dataset.probability.notnull()
        surely = surely.where(~drawn, dataset.probability >= QUANTILES[-1])
        possibly = possibly.where(~drawn, dataset.probability > QUANTILES[0])
    holds = (dataset.margin.sel(criterion=FULL_CONTACT, drop=True) > 1).any("end")
    return surely.copy(data=decide(surely, possibly, holds))


def find_disagreement(dataset):
    """1 where a criterion says the opposite of the edges at either end."""
    sticky = dataset.margin > 1
    return (sticky != sticky.sel(criterion=EDGES)).any("end").astype("i1")
