"""Simulated adhesion that remains, from the committed table, beside the theory of verdicts."""

import pandas as pd

from pipeline import remaining_table
from pipeline.claims import remaining as claims
from pipeline.numbers import percent
from pipeline.quoted.sources import Sources

GOAL, LEAST = 0.25, 0.05  # error that the theory may have where more than this remains
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
    """Share of energies that the limits of the theory hold."""
    frame = read(sources)
    inside = frame.bound.between(frame.predicted_low, frame.predicted_high)
    texts = {}
    for name, cells in (
        ("wide", remaining_table.is_wide(frame)),
        ("4x4", frame.window == 4),
        ("1x1", frame.window == 1),
    ):
        texts[f"remaining.held.{name}"] = percent(float(inside[cells].mean()))
        texts[f"remaining.energies.{name}"] = str(int(cells.sum()))
    return texts


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


NUMBERS = (quote_means, quote_accuracy, quote_limits, quote_truncation)
