"""Rows of the table for contact without adhesion, knob by knob."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import xarray as xr

from common.model_surfaces import cell_size, model_spectrum
from common.theory import contact_of
from stickiness import datasets
from stickiness.accuracy.error_models import COARSE, FULL, Settings, Surface
from stickiness.persson.theory import Persson
from stickiness.statistics import COVERS
from stickiness.surface import lattice_spectrum
from tradeoff.fit_laws import Conditions, Points
from tradeoff.law_points import add_extrapolations
from tradeoff.measuring import COVERED, derived, rms, select_knob, time_task
from tradeoff.rows import Trial, by_load, select
from tradeoff.seed_pool import FEWEST_FINE, Resampling, SeedPool, extrapolate_area, flatten

REPETITIONS = 60  # of means that are drawn
DESCRIBED_SEEDS = 2048
MEANS = ((4, 0), (8, 0), (16, 0), (32, 0), (2, 64), (4, 64), (8, 64), (4, 256), (8, 256))
FIXED_MEANS = (4, 8)  # of seeds of fixed amplitudes


def list_grid_rows(name: str, measured: xr.Dataset) -> list[tuple]:
    """Rows of the grid with every way to evaluate it, of tolerance and of precision."""
    rows, grids = [], select_knob(measured, "pixels")
    unit, reference = float(measured.pair_time.median()), None
    for way, quantities, needed in reversed(list(evaluate_grids(grids))):
        reference = reference or select(quantities, setting=-1)
        seconds = time_settings(grids)
        if needed > 1:
            seconds = seconds + seconds.shift(setting=1, fill_value=0.0)
        for k in range(grids.sizes["setting"] - 1):
            setting, memory = f"{int(grids.pixels[k])} {way}", float(grids.memory[k])
            trial = Trial("pixels", setting, name, unit, memory)
            rows += trial.compare(select(quantities, setting=k), reference, seconds[k])
    reference = select(derived(select_knob(measured, "tolerance")), setting=-1)
    for knob in ("tolerance", "precision"):
        chosen = select_knob(measured, knob)
        quantities, seconds = derived(chosen), time_settings(chosen)
        for k in range(chosen.sizes["setting"] - (knob == "tolerance")):
            text = "single" if knob == "precision" else f"{float(chosen.tolerance[k]):g}"
            trial = Trial(knob, text, name, unit, float(chosen.memory[k]))
            rows += trial.compare(select(quantities, setting=k), reference, seconds[k])
    return rows


def time_settings(measured: xr.Dataset) -> xr.DataArray:
    """Processor time of solution and evaluation, ``(setting, pressure)``."""
    seconds = (measured.solution_time + measured.evaluation_time).mean("seed")
    return seconds.transpose("setting", ...)


def evaluate_grids(measured: xr.Dataset) -> Iterator[tuple[str, dict[str, xr.DataArray], int]]:
    """Ways from solutions to quantities: a name, values on all grids, and the grids they need."""
    counted = measured.assign(
        area_fraction=measured.pixel_area_fraction,
        attractive_area=measured.pixel_attractive_area,
    )
    yield "counted", derived(counted), 1
    yield "sub-pixel", derived(measured), 1
    order = np.argsort(measured.pixels.values)
    halves = np.clip(order - 1, 0, None)
    half = measured.isel(setting=halves).assign_coords(setting=measured.setting)
    area = xr.concat(
        [
            measured.attractive_area.isel(setting=k)
            if measured.pixels.values[k] == COARSE
            else extrapolate_area(half.isel(setting=k), measured.isel(setting=k))
            for k in range(measured.sizes["setting"])
        ],
        "setting",
    )
    yield "extrapolated", derived(measured.assign(attractive_area=area)), 2


def list_seed_rows(name: str, measured: xr.Dataset, pool: SeedPool) -> list[tuple]:
    """Rows of the number and kind of seeds, on the finest grid that has many."""
    rows, resampling = [], Resampling(pool, REPETITIONS, DESCRIBED_SEEDS)
    pixels = max(p for p, fine in pool.fine.items() if len(fine) >= FEWEST_FINE)
    loads, unit = measured.sizes["pressure"], float(measured.pair_time)
    grids = sorted({pixels, pixels // 2, COARSE})
    one = float(measured.seconds.mean("seed").sel(pixels=grids).sum()) / loads
    coarse = float(measured.coarse_seconds.mean()) / loads
    describe = float(measured.describing_seconds) * DESCRIBED_SEEDS / loads
    for seeds, more in MEANS:
        errors = pool.by_quantity(resampling.draw(Settings(pixels, FULL, seeds, more))[0])
        covering = {key: np.quantile(error, COVERED) for key, error in errors.items()}
        seconds = seeds * one + more * coarse + (describe if more else 0.0)
        text = f"{seeds} + {more}" if more else f"{seeds} plain"
        rows += Trial("seeds", text, name, unit).list_rows(covering, {}, seconds)
    if len(pool.fixed) < FEWEST_FINE:
        return rows
    bias = pool.by_quantity(pool.fixed.mean(0) / pool.truth - 1)
    scatter = pool.by_quantity(pool.fixed.std(0, ddof=1) / pool.truth)
    seconds = float(measured.fixed_seconds.mean()) / loads
    for seeds in FIXED_MEANS:
        errors = {
            key: np.hypot(value, COVERS * scatter[key] / np.sqrt(seeds))
            for key, value in bias.items()
        }
        trial = Trial("seeds", f"{seeds} fixed", name, unit)
        rows += trial.list_rows(errors, bias, seeds * seconds)
    return rows


def list_theory_rows(
    name: str, measured: xr.Dataset, pool: SeedPool, points: Points
) -> list[tuple]:
    """Rows of theory in place of simulation: its error is that of the model."""
    parameters = datasets.parameters(measured)
    surface, loads = Surface.of(parameters), measured.pressure.values
    lattice = lattice_spectrum(model_spectrum(parameters), cell_size(parameters))
    state, seconds = time_task(
        lambda: contact_of(Persson(lattice), loads, measured["range"].values)
    )
    values, *_ = flatten(derived(state.expand_dims("seed")))
    errors = pool.by_quantity(values[0] / pool.truth - 1)
    noise = pool.by_quantity(pool.truth_error / pool.truth)
    for (quantity, load), error in errors.items():
        at = Conditions(surface, load)
        points.add("theory", quantity, at, float(error), float(noise[quantity, load]))
    trial = Trial("model", "theory", name, float(measured.pair_time))
    return trial.list_rows(errors, errors, seconds / len(loads))


def list_band_rows(measured: xr.Dataset, points: Points) -> list[tuple]:
    """Rows of a spectrum that is cut, and of one that theory extrapolates from the cut."""
    rows, unit = [], float(measured.pair_time)
    hurst = datasets.parameters(measured)["hurst"]
    names = [name for name in measured.data_vars if name.startswith("theory_")]
    renamed = measured[names].rename({name: name.removeprefix("theory_") for name in names})
    simulated, theory = derived(measured), derived(renamed)
    whole = {"magnification": int(measured.magnification[-1])}
    name = f"H{hurst:g}_zeta{whole['magnification']}"
    for cut in measured.magnification.values[:-1]:
        at = {"magnification": cut}
        seconds = float(measured.seconds.sel(at).mean()) / measured.sizes["pressure"]
        for quantity, values in simulated.items():
            theory_here, theory_whole = (theory[quantity].sel(where) for where in (at, whole))
            mean, truth = (values.sel(where).mean("seed") for where in (at, whole))
            ways = {
                "cut": mean,
                "difference": mean + theory_whole - theory_here,
                "ratio": mean * theory_whole / theory_here,
            }
            for way, value in ways.items():
                errors = by_load(quantity, rms(value / truth - 1))
                trial = Trial("band", f"{cut} {way}", name, unit)
                rows += trial.list_rows(errors, errors, seconds)
    add_extrapolations(points, hurst, simulated, theory)
    return rows


def list_node_rows(measured: xr.Dataset) -> list[tuple]:
    """Rows of theory's quadrature, against its largest number of nodes."""
    rows, unit = [], float(measured.pair_time)
    for case in measured.case.values:
        quantities = derived(measured.sel(case=case))
        for nodes in measured.nodes.values[:-1]:
            one = measured.sel(case=case, nodes=nodes)
            trial = Trial("nodes", f"{nodes:g}", str(case), unit, float(one.memory))
            seconds = float(one.seconds) / measured.sizes["pressure"]
            for quantity, values in quantities.items():
                errors = by_load(quantity, rms(values.sel(nodes=nodes) / values.isel(nodes=-1) - 1))
                rows += trial.list_rows(errors, errors, seconds)
    return rows
