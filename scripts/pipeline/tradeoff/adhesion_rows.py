"""Rows and laws of the table of the trade for full adhesion and the pull-off."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd
import xarray as xr

from pipeline.tradeoff.fit_laws import Points
from pipeline.tradeoff.measuring import COVERED
from pipeline.tradeoff.rows import compared, row
from stickiness.accuracy.error_models import COARSE, Surface
from stickiness.core import datasets
from stickiness.core.statistics import COVERS

MEANS = (4, 8, 16, 32)  # seeds that rows are given for
WEAK = 1e-4  # l_a/range below which an area changes by less than a few pixels
AREA = "area_with_adhesion"


@dataclass(frozen=True)
class Measured:
    """Quantities with the dimensions setting, seed and pressure, and the DMT limit's.

    Attributes
    ----------
    label : str
        Adhesion that they were measured at.
    full, limit : dict
        By name, of full adhesion and in the DMT limit; the first is the one that has laws.
    seconds : xarray.DataArray
        Processor time of full adhesion.
    law : bool
        Whether laws are fitted to it: of 1/kappa_ad to the weakest adhesion of each range that
        changes the area by more than a few pixels, which has the largest errors.
    """

    label: str
    full: dict[str, xr.DataArray]
    limit: dict[str, xr.DataArray]
    seconds: xr.DataArray
    law: bool = True

    def solved(self) -> Measured:
        """Leave out loads at which a window closes with some setting."""
        value = next(iter(self.full.values()))
        loads = {"pressure": value.notnull().any("seed").all("setting").values}
        full, limit = (
            {quantity: values.sel(loads) for quantity, values in one.items()}
            for one in (self.full, self.limit)
        )
        return replace(self, full=full, limit=limit, seconds=self.seconds.sel(loads))


def states(measured: xr.Dataset) -> Iterator[Measured]:
    """1/kappa_ad and the area at every point, and the threshold of all points together."""
    measured = measured.where(measured.external_pressure.notnull())
    strengths = measured.adhesion_length_over_range
    for label, one in by_point(measured):
        reach, strength = one.range_over_h_rms, one.adhesion_length_over_range
        others = strengths.where((strengths >= WEAK) & (measured.range_over_h_rms == reach))
        column = (
            f"inverse_kappa_ad_{float(reach):g}" if strength >= WEAK else "inverse_kappa_ad_weak"
        )
        fall = one.external_pressure / one.repulsive_area * one.area_alone / one.pressure
        dmt = one.attraction_dmt / one.pressure / 2
        yield Measured(
            label,
            {column: (1 - fall) / 2, AREA: one.repulsive_area},
            {column: dmt, AREA: one.area_alone},
            one.seconds,
            bool(strength == others.min()),
        )
    left = measured.pressure - measured.attraction_dmt
    yield Measured(
        "threshold",
        {"threshold": threshold(measured.external_pressure)},
        {"threshold": threshold(left)},
        measured.seconds.mean("point"),
    )


def pull_offs(measured: xr.Dataset) -> Iterator[Measured]:
    """The pull-off at every point, from the load at which separation starts."""
    load = datasets.parameters(measured)["pressure"]
    for label, one in by_point(measured.expand_dims(pressure=[load])):
        limit = one.pull_off_dmt.expand_dims(setting=measured.sizes["setting"])
        yield Measured(label, {"pull_off": one.pull_off}, {"pull_off": limit}, one.seconds)


def by_point(measured):
    """Every pair of range and adhesion length: what it is called, and its values."""
    for k in range(measured.sizes["point"]):
        one = measured.isel(point=k)
        reach, strength = float(one.range_over_h_rms), float(one.adhesion_length_over_range)
        yield f"range {reach:g}, l_a {strength:g} range", one


def threshold(external: xr.DataArray) -> xr.DataArray:
    """l_a/range at which an external pressure vanishes, NaN if it does so nowhere.

    There 1/kappa_ad is 1/2 whatever the area; E* at given work of adhesion and range is inversely
    in proportion. Between the adhesion lengths of the range that has the most of them, along
    their logarithm.
    """
    ranges, counts = np.unique(external.range_over_h_rms, return_counts=True)
    chosen = external.isel(
        point=np.flatnonzero(external.range_over_h_rms == ranges[counts.argmax()])
    ).sortby("adhesion_length_over_range")
    logs = np.log(chosen.adhesion_length_over_range.values)

    def crossing(values):
        known = np.isfinite(values)
        falling, at = -values[known], logs[known]
        if len(at) < 2 or falling[0] > 0 or falling[-1] < 0:
            return np.nan
        return np.exp(np.interp(0.0, falling, at))

    return xr.apply_ufunc(crossing, chosen, input_core_dims=[["point"]], vectorize=True)


def usual_of(measured: xr.Dataset) -> tuple[pd.DataFrame, int]:
    """All settings, and the one that is varied: grids share all else, tolerances its grid."""
    keys = [key for key in ("pixels", "tolerance", "law", "balance") if key in measured]
    frame, knob = pd.DataFrame({key: measured[key].values for key in keys}), measured.knob.values
    pixels = frame.pixels[knob == "tolerance"].iloc[0]
    return frame, int(frame.index[(knob == "pixels") & (frame.pixels == pixels)][0])


def varied(measured: xr.Dataset) -> Iterator[tuple[str, str, int, int]]:
    """What is varied, its value, the setting with it and that of its reference.

    The reference is the finest of all, for the law the usual one.
    """
    frame, usual = usual_of(measured)
    for knob in frame:
        # Steps of a path are varied on two grids, each of which has a reference of its own.
        free = [knob, "pixels"] if knob == "balance" else [knob]
        others = frame.drop(columns=free)
        part = frame[(others == others.loc[usual]).all(axis=1)]
        for pixels, group in part.groupby("pixels" if knob == "balance" else lambda _: 0):
            if len(group) == 1:
                continue
            finest = group.pixels.idxmax if knob == "pixels" else group[knob].idxmin
            reference = usual if knob == "law" else finest()
            for k, value in group[knob].drop(reference).items():
                text = str(value) if knob == "law" else f"{value:g}"
                yield knob, f"{text} on {pixels}" if pixels else text, k, reference


def rows_and_laws(
    name: str, measured: xr.Dataset, quantities: Iterator[Measured], points: Points, what: str
) -> list[tuple]:
    """Rows of every setting, of the DMT limit and of numbers of seeds; adds points of the laws."""
    rows, unit = [], float(measured.pair_time)
    surface, usual = Surface.of(datasets.parameters(measured)), usual_of(measured)[1]
    for one in (each.solved() for each in quantities):
        if not one.seconds.size:
            continue
        place, seconds = f"{name}, {one.label}", one.seconds.mean("seed")
        ways = {"": (one.full, seconds), " extrapolated": extrapolated(one.full, seconds)}
        for (way, (values, cost)), each in itertools.product(ways.items(), varied(measured)):
            knob, text, k, reference = each
            if way and (knob != "pixels" or k == 0):
                continue
            knob, text = f"{what} {knob}", text + way
            exact = {q: v.isel(setting=reference) for q, v in one.full.items()}
            rows += compared(knob, text, place, measured, values, exact, k, cost, unit)
        exact = {q: v.isel(setting=usual) for q, v in one.full.items()}
        free = f"{what} model", "DMT", place, measured
        rows += compared(*free, one.limit, exact, usual, seconds * 0, unit)
        column, value = next(iter(one.full.items()))
        for knob, _, k, reference in varied(measured):
            error = value.isel(setting=k) / value.isel(setting=reference) - 1
            if one.law and knob == "pixels" and measured.pixels[k] != COARSE:
                add_grid(points, column, surface, error, float(measured.pixels[k]))
            elif one.law and knob == "tolerance":
                # Next to nothing changes but where a pixel turns: all loads and seeds together.
                size, tolerance = abs(error).quantile(COVERED), float(measured.tolerance[k])
                points.add("solver", column, surface, float(size), tolerance=tolerance)
        if what == "adhesive":
            rows += seed_rows(points, surface, place, one, usual, unit)
    for k in np.flatnonzero(measured.knob == "pixels"):
        if what == "adhesive" and measured.pixels[k] != COARSE:
            cost = float(measured.seconds.isel(setting=k).mean()) / unit
            points.add("adhesive_cost", "", surface, cost, pixels=float(measured.pixels[k]))
    return [each for each in rows if np.isfinite(each[4])]


def extrapolated(full, seconds):
    """To no pixels at all, from each grid and the one before it, and the time of both."""
    to_nothing = {quantity: 2 * value - value.shift(setting=1) for quantity, value in full.items()}
    return to_nothing, seconds + seconds.shift(setting=1)


def add_grid(points, column, surface, error, pixels):
    """Points of the law of the grid, at loads at which windows stay open."""
    for load in error.pressure.values:
        off = error.sel(pressure=load).dropna("seed").values
        if not off.size:
            continue
        if column == "pull_off":  # that of one surface, all others are means
            size, noise = np.sqrt(np.mean(off**2)), 0.0
        else:
            size, noise = off.mean(), off.std(ddof=1) / np.sqrt(off.size)
        points.add("discretisation", column, surface, size, load, pixels, noise=noise)


def seed_rows(points, surface, place, one, usual, unit):
    """Rows of means, plain and with the DMT limit of the coarsest grid as control variate."""
    rows, (column, value) = [], next(iter(one.full.items()))
    scatter, share = scattered(value.isel(setting=usual), one.limit[column].isel(setting=0))
    seconds = one.seconds.isel(setting=usual).mean("seed")
    for load in value.pressure.values:
        at = {"pressure": load}
        spread, left = float(scatter.sel(at)), float(share.sel(at))
        if not np.isfinite(spread * left):
            continue
        if one.law:
            points.add("scatter", column, surface, spread, load)
            points.add("fine_share", column, surface, left, load)
        cost = float(seconds.sel(at))
        for seeds, (kind, rest) in itertools.product(
            MEANS, {"plain": 1.0, "controlled": left}.items()
        ):
            error, case = COVERS * spread * rest / np.sqrt(seeds), f"{place}, p = {load:g}"
            setting, cost_of_all = f"{seeds} {kind}", seeds * cost
            rows.append(
                row("adhesive seeds", setting, case, column, error, np.nan, cost_of_all, unit)
            )
    return rows


def scattered(full: xr.DataArray, twin: xr.DataArray) -> tuple[xr.DataArray, xr.DataArray]:
    """Standard deviation of single surfaces over the mean, and the share a control leaves of it.

    The control is the DMT limit of the same seeds on the coarsest grid, its mean taken as known;
    its coefficient is a slope over the seeds, which leaves two degrees of freedom less. NaN where
    a window closes with any seed.
    """
    off, of_twin = (x - x.mean("seed", skipna=False) for x in (full, twin))
    slope = (off * of_twin).sum("seed", skipna=False) / (of_twin**2).sum("seed", skipna=False)
    count = full.sizes["seed"]
    left = np.sqrt(((off - slope * of_twin) ** 2).sum("seed", skipna=False) / (count - 2))
    whole = full.std("seed", ddof=1, skipna=False)
    return whole / abs(full.mean("seed", skipna=False)), np.minimum(left / whole, 1.0)
