"""Sizes of a real surface as texts, rounded to what is known of them; errors cover 90 %."""

import numpy as np
import xarray as xr

from common.formatting import amount, interval, percent, quantity, quantity_with_error, with_error
from stickiness.statistics import COVERS

MANY_MISSING = 0.05  # share of the points from which the reader is told at once
MOST_SLOPE = 1.0  # rms, up to which slopes are taken for small


def say_what_was_seen(surface: xr.Dataset) -> str:
    """What a measurement showed of the surface, and what it did not; empty where there is none."""
    if "q_cutoff" not in surface:
        return ""
    finest, longest = (
        amount(length, "m", 2)
        for length in (2 * np.pi / float(q) for q in (surface.q_cutoff, surface.wave_number.min()))
    )
    height = amount(float(surface.h_rms_measured), "m")
    said = [f"Measured: heights of {height} rms, and waves from {longest} down to {finest}."]
    if float(surface.q1) > float(surface.q_cutoff) * (1 + 1e-9):
        assumed = amount(2 * np.pi / float(surface.q1), "m", 2)
        said.append(f"Shorter waves, down to {assumed}, are assumed.")
    else:
        said.append("Shorter waves are not counted; they would lower what remains.")
    if "profile" in surface:
        said.append("It was measured along lines and is assumed to be alike in all directions.")
    missing = float(surface.missing_fraction)
    if missing > MANY_MISSING:
        said.append(f"{percent(missing)} of the points are missing.")
    return " ".join(said)


def describe_height(surface: xr.Dataset) -> str:
    """The height with its error, or its range for a surface that is given by one."""
    low, high = ends(surface.h_rms)
    if is_measured(surface):
        return quantity_with_error((low + high) / 2, COVERS * (high - low) / 2, "m")
    return quantity(low, high, "m")


def describe_slope(surface: xr.Dataset) -> str:
    """The slope, likewise."""
    low, high = ends(surface.rms_slope)
    if is_measured(surface):
        return with_error((low + high) / 2, COVERS * (high - low) / 2)
    return interval(low, high)


def warn_of_slope(surface: xr.Dataset) -> str:
    """That slopes are not small, if the rms slope may exceed `MOST_SLOPE`; else empty."""
    if max(ends(surface.rms_slope)) <= MOST_SLOPE:
        return ""
    return (
        f"The rms slope is {describe_slope(surface)}. Linear elasticity and small slopes are "
        "assumed, so what rests on waves this steep is an extrapolation."
    )


def describe_line(surface: xr.Dataset) -> str:
    """C0 of the line with H = 0.8: fitted, or the highest such line that the spectrum touches."""
    if "C0_reference" in surface:
        return with_error(float(surface.C0_reference), float(surface.C0_reference_total_error))
    bound = "" if np.isclose(float(surface.hurst), 0.8) else "≤ "
    return bound + interval(*ends(surface.C0_reference_upper), digits=2)


def is_measured(surface: xr.Dataset) -> bool:
    """Whether both ends are one standard error off, as those of a measured surface are."""
    return "draw" in surface.dims


def ends(values: xr.DataArray) -> tuple[float, float]:
    """Values at the smooth and at the rough end."""
    return float(values.sel(end="smooth")), float(values.sel(end="rough"))
