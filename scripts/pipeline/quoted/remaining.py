"""Simulated adhesion that remains, from the committed table, beside the theory of verdicts."""

from collections.abc import Iterable

import pandas as pd
from scipy.stats import gmean

from pipeline import remaining_table
from pipeline.claims import remaining as claims
from pipeline.numbers import percent
from pipeline.quoted.sources import Sources, say_range
from stickiness.remaining.prediction import HYSTERESIS, LATE

GOAL, LEAST = 0.25, 0.05  # error that the theory may have where more than this remains
ONSET = 0.35  # w/U_full up to which little more than nothing remains
FINE = 12, 0.3  # magnification and w/U_full from which on the theory is compared there
SHORTER = "H0.8_zeta8_2x2"  # set with several ranges
KINDS = ("approach", "separation")


def quote_means(sources: Sources) -> dict[str, str]:
    frame = read(sources)
    return {
        "remaining.points": str(len(frame)),
        "remaining.means": remaining_table.summarise(frame),
    }


def read(sources: Sources) -> pd.DataFrame:
    return remaining_table.read(sources.root / sources.config["remaining"]["table"])


def quote_accuracy(sources: Sources) -> dict[str, str]:
    """How often the theory is within `GOAL` of the works of approach and separation."""
    frame = read(sources)
    texts = {}
    for name, cells, kinds in (
        ("4x4", frame.window == 4, KINDS),
        ("2x2", frame.window == 2, KINDS),
        ("2x2.approach", frame.window == 2, KINDS[:1]),
        ("2x2.separation", frame.window == 2, KINDS[1:]),
        ("1x1", frame.window == 1, KINDS),
        ("fresh", remaining_table.is_held(frame), KINDS),
    ):
        share, count = say_near(frame[cells], kinds)
        texts[f"remaining.near.{name}"] = f"{share} of {count}"
    return texts


def say_near(frame: pd.DataFrame, kinds: tuple[str, ...]) -> tuple[str, str]:
    """Share of works within `GOAL` of theory, and how many works there are."""
    ratios = pd.concat([frame.predicted / frame[k].where(frame[k] > LEAST) for k in kinds]).dropna()
    return percent(float((abs(ratios - 1) < GOAL).mean())), str(len(ratios))


def quote_limits(sources: Sources) -> dict[str, str]:
    """Share of energies and works that the limits of the theory hold."""
    frame = read(sources)
    low, high = frame.predicted_low, frame.predicted_high
    inside = {
        "": is_inside(frame),
        ".approach": frame.approach.between(low / LATE, high),
        ".separation": frame.separation.between(low, high * HYSTERESIS),
    }
    texts = {}
    for name, cells in (
        ("wide", remaining_table.is_wide(frame)),
        ("4x4", frame.window == 4),
        ("1x1", frame.window == 1),
    ):
        texts[f"remaining.energies.{name}"] = str(int(cells.sum()))
        for kind, held in inside.items():
            texts[f"remaining.held.{name}{kind}"] = percent(float(held[cells].mean()))
    return texts


def quote_onset(sources: Sources) -> dict[str, str]:
    """How often the limits hold energies near the onset, where they miss, and the theory's sign."""
    frame = read(sources)
    tough = frame[remaining_table.is_wide(frame) & ~remaining_table.is_weak(frame)]
    near, few = tough[tough.energy_ratio <= ONSET], tough[tough.predicted.between(0.02, LEAST)]
    fine = near[(near.magnification >= FINE[0]) & (near.energy_ratio >= FINE[1])]
    ratio = fine.predicted / fine.bound
    return {
        "remaining.onset": say_of(is_inside(near)),
        "remaining.onset.below": str(int((near.bound < near.predicted_low).sum())),
        "remaining.onset.above": str(int((near.bound > near.predicted_high).sum())),
        "remaining.onset.ratio": f"{gmean(ratio):.1f} ({say_range(ratio)})",
        "remaining.few.below": say_of(few.bound < few.predicted_low),
        "remaining.held.more": say_of(is_inside(tough[tough.predicted > LEAST])),
    }


def is_inside(frame: pd.DataFrame) -> pd.Series:
    """Whether the limits of the theory hold the energy gained."""
    return frame.bound.between(frame.predicted_low, frame.predicted_high)


def say_of(held: pd.Series) -> str:
    """How many of how many, ``20 of 31``."""
    return f"{int(held.sum())} of {len(held)}"


def quote_pull_off(sources: Sources) -> dict[str, str]:
    """Pull-off by theory over simulation: median, and limits of 90 % of the points."""
    frame = read(sources)
    frame = frame[frame.separation > LEAST]
    ratio = frame.predicted_pull_off / frame.pull_off
    texts = {}
    for name, cells in (
        ("4x4", frame.window == 4),
        ("2x2", frame.window == 2),
        ("fresh", remaining_table.is_held(frame)),
    ):
        low, median, high = ratio[cells].quantile([0.05, 0.5, 0.95])
        texts[f"pull_off.{name}"] = f"{median:.2f} ({low:.2f} to {high:.2f})"
    return texts


def quote_ranks(sources: Sources) -> dict[str, str]:
    """Rank correlation of criteria with the energy gained, tough points of wide cells."""
    frame = read(sources)
    tough = frame[remaining_table.is_wide(frame) & ~remaining_table.is_weak(frame)]
    finest, local, ratio = (
        float(tough[name].corr(tough.bound, method="spearman"))
        for name in ("finest_margin", "local_margin", "energy_ratio")
    )
    return {
        "rank.points": str(len(tough)),
        "rank.finest": f"{finest:.2f}",
        "rank.local": f"{local:.2f}",
        "rank.energy_ratio": f"{ratio:.3f}",
        "rank.margin": say_range(tough.finest_margin[tough.bound.between(0.08, 0.13)]),
    }


def quote_ranges(sources: Sources) -> dict[str, str]:
    """What the range does to energy and hysteresis on one surface, and jumps on all."""
    frame = read(sources)
    one = frame[frame["set"] == SHORTER]
    ends = one.pivot(index="energy_ratio", columns="zone", values="bound")
    fall = (1 - ends[min(ends)] / ends[max(ends)]).sort_index()
    lost = ((one.separation - one.approach) / one.bound).groupby(one.zone).median()
    enough = frame[remaining_table.is_wide(frame) & (frame.bound > LEAST)]
    return {
        "range.fall": join_shares(fall),
        "hysteresis": join_shares(lost.sort_index(ascending=False)),
        "jumps.late": f"{(enough.bound / enough.approach).max():.2f}",
        "jumps.hysteresis": f"{(enough.separation / enough.bound).max():.2f}",
    }


def join_shares(shares: Iterable[float]) -> str:
    """Shares in a row, ``34, 22 and 8 %``."""
    *first, last = (f"{100 * share:.0f}" for share in shares)
    return f"{', '.join(first)} and {last} %"


def quote_truncation(sources: Sources) -> dict[str, str]:
    """Energy gained with finer waves over that without, as in claim 21."""
    frame = read(sources)
    texts = {}
    for hurst in (0.8, 0.5):
        ratios = [f"{ratio:.2f}" for ratio in claims.compare(frame, hurst)]
        texts[f"truncation.{hurst:g}"] = " and ".join(ratios)
        texts[f"truncation.{hurst:g}.late"] = f"{100 * (claims.extend(hurst) - 1):+.0f} %".replace(
            "-", "−"
        )
    return texts


NUMBERS = (
    *(quote_means, quote_accuracy, quote_limits, quote_onset, quote_pull_off),
    *(quote_ranks, quote_ranges, quote_truncation),
)
