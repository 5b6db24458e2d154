"""What remains of adhesion on a pair, as texts with limits, rounded for readers."""

from __future__ import annotations

import numpy as np
import xarray as xr

from pipeline.numbers import NOTHING, interval, number, percent, quantity
from pipeline.verdicts.words import MOST_STRAIN, find_limits
from stickiness.criteria.pair import DEPENDS, NOT_JUDGED, TOUCHES, WORDS
from stickiness.remaining.prediction import DEFAULT_SHARE, PULL_OFF_UNKNOWN

LEAST_SHOWN = 1e-3  # share below which a text says 0 %
LEAST_STRESS = 1e-3  # Pa, of a pull-off that holds anything
LEAST_EFFECT = 0.05  # relative, of a layer's thickness on the energy of full contact


def describe_share(pair: xr.Dataset) -> str:
    """Share of the work of adhesion that remains, with the limits that decide the verdict."""
    low, high = (round_share(limit) for limit in find_limits(pair))
    value = show_shares(*sorted(map(round_share, pair.remaining.values)))
    return value if low == high else f"{value} ({show_shares(low, high, ' to ')})"


def round_share(share: float) -> float:
    """The share, or 0 where it is too small to be shown."""
    return float(share) if float(share) >= LEAST_SHOWN else 0.0


def show_shares(low: float, high: float, between: str = " … ") -> str:
    """Two shares as percentages, or one where they agree."""
    texts = percent(low), percent(high)
    return texts[1] if texts[0] == texts[1] else f"{texts[0].removesuffix(' %')}{between}{texts[1]}"


def describe_pull_off(pair: xr.Dataset) -> str:
    """Pull-off stress with its limits; a dash where nothing holds.

    Near full contact, which was not simulated, only a low limit is known.
    """
    if float(pair.pull_off_high.max()) < LEAST_STRESS:
        return NOTHING
    if float(pair.energy_ratio.max()) > PULL_OFF_UNKNOWN:
        least = float(pair.pull_off_low.min())
        return f"at least {quantity(least, least, 'Pa', digits=2)}"
    return describe_pressure(pair, "pull_off")


def describe_threshold(pair: xr.Dataset) -> str:
    """Modulus below which the wanted share remains, with its limits."""
    return describe_pressure(pair, "modulus_threshold")


def describe_pressure(pair: xr.Dataset, name: str) -> str:
    """Values [Pa] at both ends of the surface with the limits of the model."""
    low, high = pair[f"{name}_low"].min(), pair[f"{name}_high"].max()
    if np.isnan(low):
        return NOTHING
    value = quantity(*sorted(map(float, pair[name].values)), "Pa", digits=2)
    least, most = (quantity(float(x), float(x), "Pa", digits=2) for x in (low, high))
    if float(low) == 0 or least.split()[-1] == most.split()[-1]:
        least = least.split()[0]
    return f"{value} ({least} to {most})"


def describe_layer(pair: xr.Dataset) -> str:
    """What the thickness of a layer does to the pair; empty where it does nothing."""
    low, high = sorted(map(float, pair.stiffening.values))
    strain = float(pair.layer_strain.max())
    parts = []
    if max(high - 1, 1 - low) >= LEAST_EFFECT:
        parts.append(
            f"Full contact costs {interval(low, high, 2)} times what it costs a deep solid."
        )
    if strain > MOST_STRAIN:
        parts.append(
            f"Conforming would strain the layer by about {number(strain, 2)}, beyond what a linear "
            "layer can tell: all adhesion may be lost."
        )
    return " ".join(parts)


def say_verdict(material: str, pair: xr.Dataset) -> str:
    """The verdict on a pair as one sentence; a small first word gets its capital letter."""
    sentence = _say_verdict(material, pair)
    first = sentence.split(maxsplit=1)[0]
    return sentence[0].upper() + sentence[1:] if first.islower() else sentence


def _say_verdict(material: str, pair: xr.Dataset) -> str:
    code, remains = int(pair.verdict), describe_share(pair)
    if code == NOT_JUDGED:
        return f"{material}: not judged. {str(pair.not_judged.item()).replace(chr(10), '. ')}."
    layer = f" {text}" if (text := describe_layer(pair)) else ""
    if code == DEPENDS:
        return (
            f"For {material} it depends: {remains} of its work of adhesion remains, and "
            f"{percent(DEFAULT_SHARE)} is wanted.{layer}"
        )
    if round_share(find_limits(pair)[1]) == 0:
        remains = "nothing"
    remains += " of its work of adhesion remains"
    if code == TOUCHES:
        remains = f"contact grows by itself at the finest wave, but {remains}"
    return f"{material} {WORDS[code]}: {remains}.{layer}"
