"""Rows of the table and points of the error models for full adhesion and the pull-off."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
import xarray as xr

from stickiness import datasets
from stickiness.accuracy.error_models import COARSE, Surface
from stickiness.statistics import COVERS
from tradeoff.fit_models import Conditions, Points
from tradeoff.measuring import COVERED
from tradeoff.summary import list_rows

MEANS = (4, 8, 16, 32)  # seeds that rows are given for
LABELS = {"pixels": "points per wavelength", "tolerance": "tolerance"}


@dataclass(frozen=True)
class Measured:
    """A quantity of full adhesion (setting, seed, pressure) and its value in the DMT limit.

    `seconds` is the processor time of full adhesion. `modelled` says whether an error model is
    fitted to it: for 1/kappa_ad to the weakest adhesion of each range, which has the largest error.
    """

    name: str
    full: xr.DataArray
    limit: xr.DataArray
    seconds: xr.DataArray
    modelled: bool = True

    def drop_closed(self) -> Measured:
        """Leave out loads at which a window closes with some setting."""
        loads = {"pressure": self.full.notnull().any("seed").all("setting").values}
        full, limit, seconds = (x.sel(loads) for x in (self.full, self.limit, self.seconds))
        return replace(self, full=full, limit=limit, seconds=seconds)


def list_states(measured: xr.Dataset) -> Iterator[Measured]:
    """List 1/kappa_ad at every point, and the threshold of all points together."""
    measured = measured.where(measured.external_pressure.notnull())
    for k in range(measured.sizes["point"]):
        one = measured.isel(point=k)
        same_range = measured.range_over_h_rms == one.range_over_h_rms
        weakest = measured.adhesion_length_over_range.where(same_range).min()
        fall = one.external_pressure / one.repulsive_area * one.area_alone / one.pressure
        yield Measured(
            f"inverse_kappa_ad_{float(one.range_over_h_rms):g}",
            (1 - fall) / 2,
            one.attraction_dmt / one.pressure / 2,
            one.seconds,
            bool(one.adhesion_length_over_range == weakest),
        )
    left = measured.pressure - measured.attraction_dmt
    yield Measured(
        "threshold",
        find_threshold(measured.external_pressure),
        find_threshold(left),
        measured.seconds.mean("point"),
    )


def list_pull_offs(measured: xr.Dataset) -> Iterator[Measured]:
    """List the pull-off at every point, from the load at which separation starts."""
    measured = measured.expand_dims(pressure=[datasets.parameters(measured)["pressure"]])
    for k in range(measured.sizes["point"]):
        one = measured.isel(point=k)
        limit = one.pull_off_dmt.expand_dims(setting=measured.sizes["setting"])
        yield Measured("pull_off", one.pull_off, limit, one.seconds)


def find_threshold(external: xr.DataArray) -> xr.DataArray:
    """Find l_a/range at which an external pressure vanishes, NaN if it does so nowhere.

    There 1/kappa_ad is 1/2 whatever the area; E* at given work of adhesion and range is inversely
    proportional to it. Between the adhesion lengths of the range that has the most of them, along
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


def list_variations(measured: xr.Dataset) -> Iterator[tuple[str, int, int]]:
    """List what is varied, the setting with each value, and that of the finest value.

    The usual setting, among the grids, counts among the tolerances too.
    """
    knob, pixels, tolerance = (measured[x].values for x in ("knob", "pixels", "tolerance"))
    grids, tolerances = np.flatnonzero(knob == "pixels"), np.flatnonzero(knob == "tolerance")
    tolerances = np.append(grids[pixels[grids] == pixels[tolerances[0]]], tolerances)
    for name, group, finest in (
        ("pixels", grids, grids[pixels[grids].argmax()]),
        ("tolerance", tolerances, tolerances[tolerance[tolerances].argmin()]),
    ):
        for k in group:
            if k != finest:
                yield name, int(k), int(finest)


def tabulate_adhesion(
    name: str, measured: xr.Dataset, quantities: Iterator[Measured], problem: str, points: Points
) -> list[tuple]:
    """List rows of every setting, the DMT limit and numbers of seeds, and add points."""
    rows, unit = [], float(measured.pair_time)
    surface = Surface.of(datasets.parameters(measured))
    variations = list(list_variations(measured))
    usual = next(k for knob, k, _ in variations if knob == "tolerance")
    for one in (each.drop_closed() for each in quantities):
        if not one.seconds.size:
            continue
        seconds = one.seconds.mean("seed").mean("pressure")
        for knob, k, finest in variations:
            error = one.full.isel(setting=k) / one.full.isel(setting=finest) - 1
            where = problem, LABELS[knob], f"{float(measured[knob][k]):g}", name
            covering = cover_seeds(one.name, error)
            rows += list_rows(where, covering, float(seconds.isel(setting=k)), unit)
            if one.modelled and knob == "pixels" and measured.pixels[k] != COARSE:
                add_grid_points(points, surface, float(measured.pixels[k]), one.name, error)
            elif one.modelled and knob == "tolerance":
                # Next to nothing changes but where a pixel turns: all loads and seeds together.
                at = Conditions(surface, tolerance=float(measured.tolerance[k]))
                points.add("solver", one.name, at, float(abs(error).quantile(COVERED)))
        limit = one.limit.isel(setting=usual) / one.full.isel(setting=usual) - 1
        # The DMT limit costs nothing once the contact without adhesion is solved.
        rows += list_rows((problem, "model", "DMT", name), cover_seeds(one.name, limit), 0.0, unit)
        if problem == "adhesion":
            rows += tabulate_seeds(name, surface, one, usual, unit, points)
    if problem == "adhesion":
        for k in np.flatnonzero((measured.knob == "pixels") & (measured.pixels != COARSE)):
            at = Conditions(surface, pixels=float(measured.pixels[k]))
            points.add(
                "adhesive_cost", "", at, float(measured.seconds.isel(setting=k).mean()) / unit
            )
    return [row for row in rows if np.isfinite(row[6])]


def cover_seeds(quantity, error):
    """Error of single surfaces at every load that covers 90 %."""
    covering = abs(error).quantile(COVERED, "seed")
    return {(quantity, float(load)): covering.sel(pressure=load) for load in error.pressure.values}


def add_grid_points(points, surface, pixels, column, error):
    """Add errors of the grid, at loads at which windows stay open."""
    for load in error.pressure.values:
        off = error.sel(pressure=load).dropna("seed").values
        if not off.size:
            continue
        if column == "pull_off":  # of one surface; all others are means
            size, noise = np.sqrt(np.mean(off**2)), 0.0
        else:
            size, noise = off.mean(), off.std(ddof=1) / np.sqrt(off.size)
        points.add("discretisation", column, Conditions(surface, load, pixels), size, noise)


def tabulate_seeds(name, surface, one, usual, unit, points):
    """List rows of means, plain and with the DMT limit of the coarsest grid as control variate."""
    rows = []
    scatter, share = measure_scatter(one.full.isel(setting=usual), one.limit.isel(setting=0))
    seconds = one.seconds.isel(setting=usual).mean("seed")
    for load in one.full.pressure.values:
        spread, left, cost = (float(x.sel(pressure=load)) for x in (scatter, share, seconds))
        if not np.isfinite(spread * left):
            continue
        if one.modelled:
            points.add("scatter", one.name, Conditions(surface, load), spread)
            points.add("fine_share", one.name, Conditions(surface, load), left)
        kinds = {"plain": 1.0, "controlled": left}
        for seeds, (kind, rest) in itertools.product(MEANS, kinds.items()):
            error = {(one.name, float(load)): COVERS * spread * rest / np.sqrt(seeds)}
            where = "adhesion", "seeds", f"{seeds} {kind}", name
            rows += list_rows(where, error, seeds * cost, unit)
    return rows


def measure_scatter(full: xr.DataArray, twin: xr.DataArray) -> tuple[xr.DataArray, xr.DataArray]:
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
