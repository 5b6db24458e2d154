"""Numbers of verdicts as texts for readers."""

import numpy as np

from stickiness.criteria.pair import WORDS
from stickiness.formatting import amount, duration, in_units_of, limited, number, percent
from stickiness.remaining.roughness import PULL_OFF_UNKNOWN
from stickiness.solids.moduli import REFERENCE_FREQUENCY
from stickiness.verdicts.limits import read_limited
from stickiness.verdicts.verdict import LEAST_STRESS, MOST_STRESS, tell_share

KPA = 1e3  #: [Pa], of the pull-off
MPA = 1e6  #: [Pa], of moduli
SHARES = (0.01, 0.1, 0.3)  #: of the work of adhesion, that may be wanted


def count_pairs(dataset):
    """Numbers of pairs that keep each of `SHARES` by their low and by their high limit."""
    _, *limits = read_limited(dataset.remaining)
    return {share: [int((limit >= share).sum()) for limit in limits] for share in SHARES}


def describe_share(pair):
    """Share of the work of adhesion that remains, or a multiple, with the limits that decide."""
    return tell_share(*read_limited(pair.remaining))


def describe_quantity(pair, name):
    """Value of a quantity in its unit, with the limits of all that is unknown."""
    return limited(*read_limited(pair[name]), in_units_of(UNITS[name]), **BOUNDS)


def describe_larger(pair):
    """Verdict and share for a contact larger than the scan, as texts; None where none is judged."""
    if np.isnan(pair.larger_contact):
        return None
    return {
        "contact": amount(float(pair.larger_contact), "m", 2),
        "word": WORDS[int(pair.larger_verdict)],
        "remaining": tell_share(*read_limited(pair.larger_remaining)),
    }


def describe_moment(judged):
    """Rate at which, or dwell after which, a pair is judged; empty of an elastic solid."""
    if not judged.depends_on_rate:
        return ""
    if judged.dwell is None or np.isnan(judged.dwell):
        return f"at {amount(REFERENCE_FREQUENCY, 'Hz')}"
    return f"after {duration(judged.dwell)} of dwell"


def join(low, high, between=" … "):
    """Two texts, or one where they agree; with one percent sign."""
    return high if low == high else f"{low.removesuffix(' %')}{between}{high}"


def describe_pull_off(pair):
    """Pull-off stress [kPa] with its limits.

    Near full contact, which was not simulated, only a low limit is known.
    """
    low = read_limited(pair.pull_off).low
    if float(pair.energy_ratio.max()) > PULL_OFF_UNKNOWN:
        return f"at least {number(low / KPA, 2)}" if low >= LEAST_STRESS else "not known"
    return describe_quantity(pair, "pull_off")


def show_probability(pair):
    """Share of the draws that stick.

    An interval where a layer may not withstand all heights, which the draws do not know.
    """
    low = float(pair.probability_low)
    share = float(pair.probability)
    return join(percent(low), percent(share), " to ")


BOUNDS = {"least": LEAST_STRESS, "most": MOST_STRESS}  #: of stresses, for `limited`
UNITS = {"pull_off": KPA, "modulus_threshold": MPA}  #: that head the columns of stresses
