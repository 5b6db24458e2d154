"""Rows of the table of the trade: what each setting errs by and costs, knob by knob."""

import itertools

import numpy as np

from pipeline.conventions import cell_size, model_spectrum
from pipeline.theory import contact_of
from pipeline.tradeoff.fit_laws import by_knob, estimates
from pipeline.tradeoff.measuring import COVERED, derived, rms, timed
from pipeline.tradeoff.seed_pool import FEWEST_FINE, Draws, stacked
from stickiness.accuracy.error_models import COARSE, FULL, Settings, Surface
from stickiness.accuracy.extrapolation import CARRIED_TIMES
from stickiness.core import datasets
from stickiness.core.statistics import COVERS
from stickiness.persson.theory import Persson
from stickiness.surfaces.synthesis import lattice_spectrum

REPETITIONS = 60  # of means that are drawn
MEANS = ((4, 0), (8, 0), (16, 0), (32, 0), (2, 64), (4, 64), (8, 64), (4, 256), (8, 256))


def row(knob, setting, case, quantity, error, bias, seconds, unit, memory=np.nan):
    """One row of the table; `unit` is the time of a pair of transforms."""
    return (
        knob,
        str(setting),
        case,
        quantity,
        float(error),
        float(bias),
        seconds / unit,
        seconds,
        memory,
    )


def grid_rows(name, measured):
    """Rows of the grid with every way to evaluate it, of tolerance and of precision."""
    rows, grids = [], by_knob(measured, "pixels")
    unit = float(measured.pair_time.median())
    reference = None
    for way, quantities, needed in reversed(list(estimates(grids))):
        reference = reference or {q: v.isel(setting=-1) for q, v in quantities.items()}
        seconds = (grids.solution_time + grids.evaluation_time).mean("seed")
        if needed > 1:
            seconds = seconds + seconds.shift(setting=1, fill_value=0.0)
        for k in range(grids.sizes["setting"] - 1):
            setting = f"{int(grids.pixels[k])} {way}"
            rows += compared(
                "pixels", setting, name, grids, quantities, reference, k, seconds, unit
            )
    for knob in ("tolerance", "precision"):
        chosen = by_knob(measured, knob)
        exact = by_knob(measured, "tolerance")
        tight = {q: v.isel(setting=-1) for q, v in derived(exact).items()}
        seconds = (chosen.solution_time + chosen.evaluation_time).mean("seed")
        count = chosen.sizes["setting"] - (knob == "tolerance")
        for k in range(count):
            text = "single" if knob == "precision" else f"{float(chosen.tolerance[k]):g}"
            rows += compared(knob, text, name, chosen, derived(chosen), tight, k, seconds, unit)
    return rows


def compared(knob, setting, name, measured, quantities, reference, k, seconds, unit):
    """Rows of one setting against a reference, seed by seed."""
    rows = []
    for quantity, values in quantities.items():
        error = values.isel(setting=k) / reference[quantity] - 1
        single, mean = rms(error).quantile(COVERED, "seed"), rms(error.mean("seed"))
        for load in error.pressure.values:
            at = {"pressure": load}
            cost = float(seconds.isel(setting=k).sel(at))
            rows.append(
                row(
                    knob,
                    setting,
                    f"{name}, p = {load:g}",
                    quantity,
                    single.sel(at),
                    mean.sel(at),
                    cost,
                    unit,
                    float(measured.memory[k]) if "memory" in measured else np.nan,
                )
            )
    return rows


def seed_rows(name, measured, bank):
    """Rows of the number and kind of seeds, on the finest grid that has many."""
    rows, draws = [], Draws(bank, REPETITIONS, 2048)
    pixels = max(p for p, fine in bank.fine.items() if len(fine) >= FEWEST_FINE)
    loads, unit = measured.sizes["pressure"], float(measured.pair_time)
    grids = sorted({pixels, pixels // 2, COARSE})
    one = float(measured.seconds.mean("seed").sel(pixels=grids).sum()) / loads
    coarse = float(measured.coarse_seconds.mean()) / loads
    describe = float(measured.describing_seconds) * 2048 / loads
    for seeds, more in MEANS:
        errors = bank.by_quantity(draws(Settings(pixels, FULL, seeds, more))[0])
        seconds = seeds * one + more * coarse + (describe if more else 0.0)
        text = f"{seeds} + {more}" if more else f"{seeds} plain"
        for (quantity, load), error in errors.items():
            rows.append(
                row(
                    "seeds",
                    text,
                    f"{name}, p = {load:g}",
                    quantity,
                    np.quantile(error, COVERED),
                    np.nan,
                    seconds,
                    unit,
                )
            )
    if len(bank.fixed) < FEWEST_FINE:
        return rows
    mean = bank.by_quantity(bank.fixed.mean(0) / bank.truth - 1)
    scatter = bank.by_quantity(bank.fixed.std(0, ddof=1) / bank.truth)
    seconds = float(measured.fixed_seconds.mean()) / loads
    for seeds in (4, 8):
        for (quantity, load), bias in mean.items():
            error = np.hypot(bias, COVERS * scatter[quantity, load] / np.sqrt(seeds))
            rows.append(
                row(
                    "seeds",
                    f"{seeds} fixed",
                    f"{name}, p = {load:g}",
                    quantity,
                    error,
                    bias,
                    seeds * seconds,
                    unit,
                )
            )
    return rows


def theory_rows(name, measured, bank, points):
    """Rows of theory in place of simulation: its error is that of the model."""
    asked = datasets.parameters(measured)
    surface, loads = Surface.of(asked), measured.pressure.values
    lattice = lattice_spectrum(model_spectrum(asked), cell_size(asked))
    state, seconds = timed(lambda: contact_of(Persson(lattice), loads, measured["range"].values))
    values, *_ = stacked(derived(state.expand_dims("seed")))
    rows, known = [], bank.by_quantity(bank.truth_error / bank.truth)
    for (quantity, load), error in bank.by_quantity(values[0] / bank.truth - 1).items():
        noise = known[quantity, load]
        points.add("theory", quantity, surface, float(error), load, noise=float(noise))
        rows.append(
            row(
                "model",
                "theory",
                f"{name}, p = {load:g}",
                quantity,
                error,
                error,
                seconds / len(loads),
                float(measured.pair_time),
            )
        )
    return rows


def band_rows(measured, points):
    """Rows of a spectrum that is cut, and of one that theory carries on from the cut."""
    rows, unit = [], float(measured.pair_time)
    hurst = datasets.parameters(measured)["hurst"]
    theory = measured[
        ["theory_area_fraction", "theory_mean_gap", "theory_attractive_area", "theory_rms_slope"]
    ]
    theory = theory.rename({name: name.removeprefix("theory_") for name in theory.data_vars})
    simulated, known = derived(measured), derived(theory)
    whole = {"magnification": int(measured.magnification[-1])}
    name = f"H{hurst:g}_zeta{whole['magnification']}"
    for cut in measured.magnification.values[:-1]:
        at = {"magnification": cut}
        seconds = float(measured.seconds.sel(at).mean()) / measured.sizes["pressure"]
        for quantity, values in simulated.items():
            theory_here, theory_whole = (known[quantity].sel(where) for where in (at, whole))
            mean, truth = (values.sel(where).mean("seed") for where in (at, whole))
            ways = {
                "cut": mean,
                "difference": mean + theory_whole - theory_here,
                "ratio": mean * theory_whole / theory_here,
            }
            for way, value in ways.items():
                error = rms(value / truth - 1)
                for load in error.pressure.values:
                    off, case = float(error.sel(pressure=load)), f"{name}, p = {load:g}"
                    rows.append(
                        row("band", f"{cut} {way}", case, quantity, off, off, seconds, unit)
                    )
    add_carrying(hurst, simulated, known, points)
    return rows


def add_carrying(hurst, simulated, theory, points):
    """Points of the law of theory's difference, between all spectra that it may be carried by.

    Relative to the value simulated, not to the broader one: that is the one at hand; and to what is
    beyond the cut, measured by what it takes of the area. The Hurst exponent alone is left to the
    law: laws in cut and load too foretell a Hurst exponent that they were not fitted to worse.
    """
    area, surface = theory["area"], Surface(hurst, 1)
    for cut, to in itertools.combinations(area.magnification.values.tolist(), 2):
        if to > CARRIED_TIMES * cut:
            continue
        at, whole = {"magnification": cut}, {"magnification": to}
        size = abs(area.sel(whole) / area.sel(at) - 1)
        for quantity, values in simulated.items():
            change = theory[quantity].sel(whole) - theory[quantity].sel(at)
            off = values.sel(at) + change - values.sel(whole)
            share = off / values.sel(at).mean("seed") / size
            noise = rms(share.std("seed", ddof=1)) / np.sqrt(share.sizes["seed"])
            for error, known in zip(rms(share.mean("seed")).values, noise.values, strict=True):
                points.add("carrying", quantity, surface, float(error), noise=float(known))


def node_rows(measured):
    """Rows of theory's quadrature, against its largest number of nodes."""
    rows, unit = [], float(measured.pair_time)
    for case in measured.case.values:
        quantities = derived(measured.sel(case=case))
        for nodes in measured.nodes.values[:-1]:
            seconds = float(measured.seconds.sel(case=case, nodes=nodes))
            for quantity, values in quantities.items():
                error = rms(values.sel(nodes=nodes) / values.isel(nodes=-1) - 1)
                for load in error.pressure.values:
                    off = float(error.sel(pressure=load))
                    rows.append(
                        row(
                            "nodes",
                            f"{nodes:g}",
                            f"{case}, p = {load:g}",
                            quantity,
                            off,
                            off,
                            seconds / measured.sizes["pressure"],
                            unit,
                            float(measured.memory.sel(case=case, nodes=nodes)),
                        )
                    )
    return rows
