"""Campaigns as the committed configuration has them, and their committed tables."""

import importlib
from pathlib import Path

from helpers.entries import complete

from common import committed
from common.config import load
from common.config.campaigns import HeightCampaign, LimitCampaign, Remaining

ROOT = Path(__file__).parents[2]


def _load(model, name):
    return complete(model, **load.load(ROOT / load.CAMPAIGNS[name]))


_LIMITS = _load(LimitCampaign, "limits")
#: What is common to all sets of a campaign, and its sets.
CAMPAIGNS = {
    "heights": _load(HeightCampaign, "heights"),
    "remaining": _load(Remaining, "remaining"),
    **{
        name: {"law": _LIMITS["law"], **entry}
        for name, entry in _LIMITS.items()
        if isinstance(entry, dict)
    },
}


def read(name):
    """Committed table of a campaign, with all columns."""
    columns = importlib.import_module(f"campaigns.{name}").COLUMNS
    return committed.read(ROOT / f"config/{name}.csv", columns, "its campaign")
