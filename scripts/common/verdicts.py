"""Verdicts on pairs: the limits that decide them, and their numbers as texts for readers."""

import numpy as np

from common.formatting import amount, duration, number, percent
from stickiness.remaining.prediction import PULL_OFF_UNKNOWN

LEAST_SHOWN = 1e-3  # share below which a text says 0 %
KPA, MPA = 1e3, 1e6  # Pa: of the pull-off, and of moduli
LEAST_STRESS, MOST_STRESS = 1.0, 1e13  # Pa, beyond which a text says so: nobody can use them
SHARES = (0.01, 0.1, 0.3)  # of the work of adhesion, that may be wanted


def find_limits(dataset, name="remaining"):
    """Low and high limit of what is known of a pair: of the share that remains, they decide.

    Over both ends of the surface and the limits of the model; on a measured surface quantiles of
    the spectra drawn within its errors, with errors of the model. `name` may be another quantity.
    Of margins and thresholds they are where the limits of the share are the wanted share.
    """
    low, high = dataset[f"{name}_low"].min("end"), dataset[f"{name}_high"].max("end")
    if f"{name}_quantile" in dataset:
        drawn = dataset[f"{name}_quantile"]
        low = drawn.isel(quantile=0, drop=True).fillna(low)
        high = drawn.isel(quantile=-1, drop=True).fillna(high)
    return low, high


def find_value(dataset, name="remaining"):
    """One value of a quantity, between its limits: the median of draws, or the mean of both ends.

    Of margins and moduli, which span decades, that is the geometric mean.
    """
    value = dataset[name].mean("end")
    if name not in ("remaining", "pull_off"):
        value = np.exp(np.log(dataset[name]).mean("end"))
    if f"{name}_quantile" in dataset:
        drawn = dataset[f"{name}_quantile"]
        value = drawn.isel(quantile=drawn.sizes["quantile"] // 2, drop=True).fillna(value)
    return value


def count_pairs(dataset):
    """Numbers of pairs that keep each of `SHARES` by their low and by their high limit."""
    limits = find_limits(dataset)
    return {share: [int((limit >= share).sum()) for limit in limits] for share in SHARES}


def describe_share(pair):
    """Share of the work of adhesion that remains, or a multiple, with the limits that decide."""
    low, high, value = map(round_share, (*find_limits(pair), find_value(pair)))
    show = percent if high <= 1 else lambda share: number(share, 2)
    limits = show_shares(low, high, " to ", show)
    text = show(value) if limits == show(value) else f"{show(value)} ({limits})"
    return text if high <= 1 else f"{text} times"


def describe_moment(judged):
    """Rate or dwell at which a pair or a `Material` is judged; empty of an elastic solid."""
    if not judged.depends_on_rate:
        return ""
    rate = amount(judged.broken_at, "Hz")
    if np.isnan(judged.dwell):
        return f"at {rate}"
    return f"after {duration(judged.dwell)} of dwell, broken at {rate}"


def round_share(share):
    """The share, or 0 where it is too small to be shown."""
    return float(share) if float(share) >= LEAST_SHOWN else 0.0


def show_shares(low, high, between=" … ", show=percent):
    """Two shares as percentages, or one where they agree."""
    texts = show(low), show(high)
    return texts[1] if texts[0] == texts[1] else f"{texts[0].removesuffix(' %')}{between}{texts[1]}"


def describe_pull_off(pair):
    """Pull-off stress [kPa] with its limits.

    Near full contact, which was not simulated, only a low limit is known.
    """
    low = float(find_limits(pair, "pull_off")[0])
    if float(pair.energy_ratio.max()) > PULL_OFF_UNKNOWN:
        return f"at least {show_stress(low, KPA)}" if low >= LEAST_STRESS else "not known"
    return describe_stress(pair, "pull_off", KPA)


def show_probability(pair):
    """Share of the draws that stick; of none or all of them a bound, for draws are few.

    An interval where a layer may not withstand all heights, which the draws do not know.
    """
    low, share = float(pair.probability_low), float(pair.probability)
    if low < share:
        return show_shares(low, share, " to ")
    if share not in (0, 1):
        return percent(share)
    error = float(pair.probability_total_error)
    return f"< {percent(error)}" if share == 0 else f"> {percent(1 - error)}"


def describe_threshold(pair):
    """E* [MPa] below which the wanted share remains, with its limits."""
    return describe_stress(pair, "modulus_threshold", MPA)


def describe_stress(pair, name, unit):
    """Value in a unit [Pa], with the limits of all that is unknown."""
    low, high = map(float, find_limits(pair, name))
    limits = show_stresses(low, high, unit, " to ")
    value = show_stress(float(find_value(pair, name)), unit)
    return value if high < LEAST_STRESS or limits == value else f"{value} ({limits})"


def show_stresses(low, high, unit, between=" … "):
    """Two stresses [Pa] in a unit [Pa], or one where they agree; outside of what matters, bounds.

    Examples
    --------
    >>> show_stresses(2e5, 3.14e6, MPA), show_stresses(0.5, 2.0, KPA, " to ")
    ('0.2 … 3.1', '< 0.001 to 0.002')
    """
    return between.join(dict.fromkeys(show_stress(x, unit) for x in (low, high)))


def show_stress(value, unit):
    """A stress [Pa] in a unit [Pa], or the bound that it is beyond."""
    if 0 < value < LEAST_STRESS:
        return f"< {number(LEAST_STRESS / unit)}"
    if value > MOST_STRESS:
        return f"> {number(MOST_STRESS / unit)}"
    return number(value / unit, 2)
