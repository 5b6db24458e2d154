"""Rows of the table, and points of the laws, for full adhesion and the pull-off."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd
import xarray as xr

from stickiness import datasets
from stickiness.accuracy.error_models import COARSE, Surface
from stickiness.statistics import COVERS
from tradeoff.fit_laws import Conditions, Points
from tradeoff.measuring import COVERED
from tradeoff.rows import Trial, select

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

    def drop_closed(self) -> Measured:
        """Leave out loads at which a window closes with some setting."""
        value = next(iter(self.full.values()))
        loads = {"pressure": value.notnull().any("seed").all("setting").values}
        full, limit = (
            {quantity: values.sel(loads) for quantity, values in one.items()}
            for one in (self.full, self.limit)
        )
        return replace(self, full=full, limit=limit, seconds=self.seconds.sel(loads))


def list_states(measured: xr.Dataset) -> Iterator[Measured]:
    """List 1/kappa_ad and the area at every point, and the threshold of all points together."""
    measured = measured.where(measured.external_pressure.notnull())
    strengths = measured.adhesion_length_over_range
    for label, one in split_points(measured):
        range_, strength = one.range_over_h_rms, one.adhesion_length_over_range
        others = strengths.where((strengths >= WEAK) & (measured.range_over_h_rms == range_))
        column = (
            f"inverse_kappa_ad_{float(range_):g}" if strength >= WEAK else "inverse_kappa_ad_weak"
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


def list_pull_offs(measured: xr.Dataset) -> Iterator[Measured]:
    """List the pull-off at every point, from the load at which separation starts."""
    load = datasets.parameters(measured)["pressure"]
    for label, one in split_points(measured.expand_dims(pressure=[load])):
        limit = one.pull_off_dmt.expand_dims(setting=measured.sizes["setting"])
        yield Measured(label, {"pull_off": one.pull_off}, {"pull_off": limit}, one.seconds)


def split_points(measured):
    """Split pairs of range and adhesion length: the label and the values of each."""
    for k in range(measured.sizes["point"]):
        one = measured.isel(point=k)
        range_, strength = float(one.range_over_h_rms), float(one.adhesion_length_over_range)
        yield f"range {range_:g}, l_a {strength:g} range", one


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


def find_usual(measured: xr.Dataset) -> tuple[pd.DataFrame, int]:
    """Find all settings, and the one that is varied: grids share all else, tolerances its grid."""
    keys = [key for key in ("pixels", "tolerance", "law", "balance") if key in measured]
    frame, knob = pd.DataFrame({key: measured[key].values for key in keys}), measured.knob.values
    pixels = frame.pixels[knob == "tolerance"].iloc[0]
    return frame, int(frame.index[(knob == "pixels") & (frame.pixels == pixels)][0])


def varied(measured: xr.Dataset) -> Iterator[tuple[str, str, int, int]]:
    """What is varied, its value, the setting with it and that of its reference.

    The reference is the finest of all, for the law the usual one.
    """
    frame, usual = find_usual(measured)
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


def list_adhesion_rows(
    name: str, measured: xr.Dataset, quantities: Iterator[Measured], points: Points, what: str
) -> list[tuple]:
    """List rows of every setting, the DMT limit and numbers of seeds; add points of the laws."""
    rows, unit = [], float(measured.pair_time)
    surface, usual = Surface.of(datasets.parameters(measured)), find_usual(measured)[1]
    for one in (each.drop_closed() for each in quantities):
        if not one.seconds.size:
            continue
        place, seconds = f"{name}, {one.label}", one.seconds.mean("seed")
        ways = {"": (one.full, seconds), " extrapolated": extrapolate(one.full, seconds)}
        for (way, (values, cost)), each in itertools.product(ways.items(), varied(measured)):
            knob, text, k, reference = each
            if way and (knob != "pixels" or k == 0):
                continue
            trial = Trial(f"{what} {knob}", text + way, place, unit, memory_of(measured, k))
            exact = select(one.full, setting=reference)
            rows += trial.compare(select(values, setting=k), exact, cost.isel(setting=k))
        trial = Trial(f"{what} model", "DMT", place, unit, memory_of(measured, usual))
        limit, exact = (select(each, setting=usual) for each in (one.limit, one.full))
        rows += trial.compare(limit, exact, seconds.isel(setting=usual) * 0)
        if one.law:
            add_setting_points(points, surface, measured, *next(iter(one.full.items())))
        if what == "adhesive":
            rows += list_seed_rows(points, surface, one, usual, Trial(what, "", place, unit))
    if what == "adhesive":
        add_costs(points, surface, measured)
    return [row for row in rows if np.isfinite(row[4])]


def memory_of(measured: xr.Dataset, k: int) -> float:
    """Largest memory [MB] of a setting; NaN where it was not measured."""
    return float(measured.memory[k]) if "memory" in measured else np.nan


def extrapolate(full, seconds):
    """Extrapolate to no pixels at all from each grid and the one before it; the time of both."""
    limit = {quantity: 2 * value - value.shift(setting=1) for quantity, value in full.items()}
    return limit, seconds + seconds.shift(setting=1)


def add_setting_points(points, surface, measured, column, value):
    """Add points of the laws of the grid and of the tolerance."""
    for knob, _, k, reference in varied(measured):
        error = value.isel(setting=k) / value.isel(setting=reference) - 1
        if knob == "pixels" and measured.pixels[k] != COARSE:
            add_grid_points(points, surface, float(measured.pixels[k]), column, error)
        elif knob == "tolerance":
            # Next to nothing changes but where a pixel turns: all loads and seeds together.
            size = float(abs(error).quantile(COVERED))
            at = Conditions(surface, tolerance=float(measured.tolerance[k]))
            points.add("solver", column, at, size)


def add_grid_points(points, surface, pixels, column, error):
    """Add points of the law of the grid, at loads at which windows stay open."""
    for load in error.pressure.values:
        off = error.sel(pressure=load).dropna("seed").values
        if not off.size:
            continue
        if column == "pull_off":  # that of one surface, all others are means
            size, noise = np.sqrt(np.mean(off**2)), 0.0
        else:
            size, noise = off.mean(), off.std(ddof=1) / np.sqrt(off.size)
        points.add("discretisation", column, Conditions(surface, load, pixels), size, noise)


def add_costs(points, surface, measured):
    """Add the cost of an adhesive state on every grid but the coarsest."""
    for k in np.flatnonzero(measured.knob == "pixels"):
        if measured.pixels[k] != COARSE:
            cost = float(measured.seconds.isel(setting=k).mean()) / float(measured.pair_time)
            at = Conditions(surface, pixels=float(measured.pixels[k]))
            points.add("adhesive_cost", "", at, cost)


def list_seed_rows(points, surface, one, usual, trial):
    """List rows of means, plain and with the DMT limit of the coarsest grid as control variate."""
    rows, (column, value) = [], next(iter(one.full.items()))
    scatter, share = scattered(value.isel(setting=usual), one.limit[column].isel(setting=0))
    seconds = one.seconds.isel(setting=usual).mean("seed")
    for load in value.pressure.values:
        spread, left, cost = (float(x.sel(pressure=load)) for x in (scatter, share, seconds))
        if not np.isfinite(spread * left):
            continue
        if one.law:
            points.add("scatter", column, Conditions(surface, load), spread)
            points.add("fine_share", column, Conditions(surface, load), left)
        kinds = {"plain": 1.0, "controlled": left}
        for seeds, (kind, rest) in itertools.product(MEANS, kinds.items()):
            error = COVERS * spread * rest / np.sqrt(seeds)
            chosen = replace(trial, knob="adhesive seeds", setting=f"{seeds} {kind}")
            rows += chosen.list_rows({(column, load): error}, {}, seeds * cost)
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
