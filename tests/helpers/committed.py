"""The committed configuration, as rules and scripts get it."""

import copy
from functools import cache
from pathlib import Path

from common.config import load

ROOT = Path(__file__).parents[2]


def read_committed(monkeypatch):
    """Configuration, checked and in SI units, at standard fidelity, and the real surfaces."""
    monkeypatch.chdir(ROOT)
    return copy.deepcopy(_read())


@cache
def _read():
    campaigns = {name: load.load(path) for name, path in load.CAMPAIGNS.items()}
    given = load.load(load.USER)
    checked = load.check_all(load.defaults(".") | given, campaigns, given)
    return checked["config"], checked["surfaces"]["surfaces"]
