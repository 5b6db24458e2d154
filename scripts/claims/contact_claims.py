"""Claims on contact without adhesion: area, gaps and a_V, from simulation and theory."""

import numpy as np
import xarray as xr

from claims.ledger import (
    Finding,
    claim,
    describe_cell,
    errors_by_source,
    grade,
    value_and_error,
)
from common.conventions import LINEAR_UP_TO, VARIANT, at_load
from stickiness import datasets, error_budget
from stickiness.criteria import a_v_fit

SHOWN = 1000.0  # magnification up to which the paper draws P(u)
SMALL_GAPS = (0.001, 0.003, 0.01, 0.03)  # over h_rms
MIDDLE = slice(1e3, 1e5)  # magnifications at which a_V should be about 3


@claim(1, "kappa_128", "kappa_64", "kappa_wide", "lattice_128")
def area_slope(files):
    k = files["kappa_128"]
    at, theory = at_load(k), at_load(files["lattice_128"]).kappa.sel(variant=VARIANT)
    value = float(at.kappa)
    ends = kappa_ends(k)
    (_, first), (_, last) = ends
    close = abs(value - 2) < 0.2
    others = [
        {
            "cell": describe_cell(other),
            "kappa": value_and_error(at_load(other), "kappa"),
            "ends": kappa_ends(other),
        }
        for other in (files["kappa_64"], files["kappa_wide"])
    ]
    return Finding(
        value=value,
        claimed=2.0,
        verdict=grade(close and abs(1 - last / first) < 0.1, close),
        errors=errors_by_source(at, "kappa"),
        facts={
            "pressure": at.pressure,
            "cell": describe_cell(k),
            "ends": ends,
            "fit": value_and_error(k, "kappa_fit"),
            "theory": theory,
            "others": others,
        },
    )


def kappa_ends(fit, largest=LINEAR_UP_TO):
    """Area and kappa at the smallest load and at the last with an area of at most `largest`."""
    inside = np.flatnonzero(fit.area_fraction <= largest)
    return [(float(fit.area_fraction[i]), float(fit.kappa[i])) for i in inside[[0, -1]]]


@claim(2, "fig1b")
def density_converges(files):
    sweep = files["fig1b"].gap_density.sel(variant=VARIANT).isel(hurst=0, load=0)
    last = sweep.isel(magnification=-1)
    before = sweep.sel(magnification=float(last.magnification) / 100, method="nearest")
    change = abs(last / before - 1).where(sweep.gap <= 2)
    settled = change.gap.values[np.flatnonzero(change.values > 0.05)]
    limit = float(settled.max()) if settled.size else float(sweep.gap.min())
    spacing = float(np.diff(np.log(sweep.gap.values)).mean() * limit)
    return Finding(
        value=limit,
        verdict=grade(limit <= float(sweep.gap.min()), limit < 0.5),
        errors={"discretisation": spacing, "model": np.nan},
        facts={
            "zetas": (before.magnification, last.magnification),
            "change": change.sel(gap=0.01, method="nearest"),
        },
    )


@claim(3, "fig3a")
def small_gap_exponent(files):
    sweep = files["fig3a"].gap_density.sel(variant=VARIANT, gap=slice(None, 1))
    density = sweep.isel(hurst=0, load=0)
    exponent = xr.apply_ufunc(
        lambda values: a_v_fit.local_exponent(density.gap.values, values),
        density,
        input_core_dims=[["gap"]],
        output_core_dims=[["gap"]],
        vectorize=True,
    )
    shown = exponent.sel(magnification=SHOWN, method="nearest")
    broad = exponent.isel(magnification=-1)
    at, beyond = (np.interp(np.log(SMALL_GAPS), np.log(one.gap), one) for one in (shown, broad))
    off, off_beyond = (float(np.abs(values + 1 / 3).max()) for values in (at, beyond))
    spans = {
        float(z): close_to_third(exponent.sel(magnification=z)) for z in exponent.magnification
    }
    widest = max(spans, key=lambda z: spans[z][1] / spans[z][0])
    return Finding(
        value=float(at[2]),
        claimed=-1 / 3,
        verdict=grade(max(off, off_beyond) < 0.05, off < 0.1),
        errors={"model": float(np.ptp(at)) / 2},
        facts={
            "gaps": SMALL_GAPS,
            "exponents": [(shown.magnification, at), (broad.magnification, beyond)],
            "hurst": float(exponent.hurst),
            "widest": (widest, spans[widest]),
        },
    )


def close_to_third(exponent, within=0.05):
    """Ends of the longest unbroken range of gaps whose exponent is about -1/3; 1, 1 if none."""
    close = np.abs(exponent.values + 1 / 3) < within
    edges = np.flatnonzero(np.diff(np.concatenate([[0], close.astype(int), [0]])))
    if not edges.size:
        return 1.0, 1.0
    starts, ends = edges[::2], edges[1::2] - 1
    longest = int(np.argmax(ends - starts))
    return float(exponent.gap[starts[longest]]), float(exponent.gap[ends[longest]])


@claim(4, "fig3d", "ensemble_wide", "lattice_wide")
def load_separation(files):
    sweep = files["fig3d"].sel(variant=VARIANT).isel(hurst=0, magnification=0)
    ratio = over_exponential(sweep.pressure, sweep.mean_gap)
    bem = files["ensemble_wide"]
    measured = over_exponential(bem.pressure, bem.mean_gap_mean).dropna("pressure")
    lattice = files["lattice_wide"].sel(variant=VARIANT, pressure=measured.pressure)
    lattice = lattice.pressure * np.exp(2 * lattice.mean_gap)
    theory_agrees, simulation_agrees = farthest(ratio) < 1.25, farthest(measured) < 1.25
    return Finding(
        value=float(ratio.mean()),
        claimed=1.0,
        verdict=grade(theory_agrees and simulation_agrees, theory_agrees),
        errors={"model": float(ratio.mean() * abs(lattice / measured - 1).max())},
        facts={
            "zeta": sweep.magnification,
            "ratio": (ratio.min(), ratio.max()),
            "gaps": [float(np.interp(p, sweep.pressure, sweep.mean_gap)) for p in (0.1, 0.001)],
            "cell": describe_cell(bem),
            "agrees": simulation_agrees,
            "loads": measured.pressure.values[[-1, 0]],
            "simulated": measured[[-1, 0]],
            "lattice": lattice[[-1, 0]],
        },
    )


def over_exponential(pressure, mean_gap):
    """Ratio p/exp(-2 mean gap) where the mean gap is 1 to 3, NaN elsewhere."""
    return (pressure * np.exp(2 * mean_gap)).where((mean_gap >= 1) & (mean_gap <= 3))


def farthest(ratio):
    """Largest factor, up or down, by which ratios differ from 1."""
    return float(np.exp(np.abs(np.log(ratio)).max()))


@claim(6, "fig3a", "fit_fig3a")
def area_against_range(files):
    area = files["fig3a"].attractive_area.sel(variant=VARIANT).isel(hurst=0, load=0)
    last, before = area.isel(magnification=-1), area.sel(magnification=1e4, method="nearest")
    small, large = (float((last / before).interp(range=e)) - 1 for e in (0.01, 0.1))
    fit = files["fit_fig3a"].sel(variant=VARIANT).isel(hurst=0, load=0, magnification=-1)
    intervals = [fit.isel(window=index) for index in range(fit.sizes["window"])]
    ratio = float(fit.a_v.max() / fit.a_v.min())
    settled = max(small, large) < 0.02
    return Finding(
        value=ratio,
        claimed=1.0,
        verdict=grade(settled and ratio < 1.05, large < 0.1 and ratio < 1.25),
        errors={"model": np.nan},
        facts={
            "zetas": (before.magnification, last.magnification),
            "slopes": [(one.a_v, one.window_low, one.window_high) for one in intervals],
            "growth": {"small": small, "large": large},
        },
    )


@claim(7, "fig3b", "ensemble_wide", "lattice_wide")
def area_against_load(files):
    sweep = files["fig3b"].sel(variant=VARIANT).isel(hurst=0, magnification=0)
    loads = sweep.pressure.values
    theory = load_exponent(loads, sweep.attractive_area)
    bem = files["ensemble_wide"].sel(pressure=slice(loads[0] * (1 - 1e-9), None))
    measured = load_exponent(bem.pressure.values, bem.attractive_area_mean)
    lattice = files["lattice_wide"].sel(variant=VARIANT, pressure=bem.pressure)
    lattice = load_exponent(bem.pressure.values, lattice.attractive_area)
    both = np.abs(np.array([theory[0], measured[0]]) - 1)
    everywhere = np.abs(np.concatenate([theory, measured]) - 1).max() < 0.1
    return Finding(
        value=float(theory[0]),
        claimed=1.0,
        verdict=grade(everywhere, both.max() < 0.25),
        errors={"model": np.nan},
        facts={
            "zeta": sweep.magnification,
            "loads": loads,
            "theory": theory,
            "cell": describe_cell(bem),
            "simulated": measured,
            "lattice": lattice,
        },
    )


def load_exponent(loads, area, at=0.03):
    """Local exponent d ln A_ad/d ln p at one range, load by load."""
    return np.gradient(np.log(area.interp(range=at).values), np.log(loads))


@claim(8, "fit_fig3c", "fit_bem_128", "fit_lattice_128", "fit_bem_wide")
def a_v_against_magnification(files):
    fit = files["fit_fig3c"].sel(variant=VARIANT).isel(load=0)
    intervals = fit.a_v.isel(magnification=-1).sel(hurst=0.8, method="nearest")
    first = fit.a_v.isel(window=0)
    step = first.isel(magnification=-1) / first.isel(magnification=-2) - 1
    value, error = float(intervals[0]), float(np.ptp(intervals.values)) / 2
    grown = abs(value * float(step.sel(hurst=0.8, method="nearest")))
    steady = float(np.abs(step).max()) < 0.02
    near = abs(value - 3) <= error
    middle = first.sel(hurst=0.8, method="nearest").sortby("magnification")
    middle = middle.sel(magnification=MIDDLE)
    about = float(np.abs(middle / 3 - 1).max()) < 0.25
    largest = fit.isel(magnification=-1, window=0).sel(hurst=0.8, method="nearest")
    model = float(error_budget.part(largest, "a_v", "model"))
    return Finding(
        value=value,
        claimed=3.0,
        verdict=grade(near and steady and error < 0.5, about),
        errors=errors_by_source(largest, "a_v")
        | {"bandwidth": grown, "model": np.hypot(model, error)},
        facts={
            "zetas": fit.magnification[-2:],
            "middle": (middle.min(), middle.max()),
            "middle_zetas": middle.magnification[[0, -1]],
            "about": about,
            "steady": steady,
            "growth": [(float(one.hurst), one) for one in step],
            "intervals": (intervals.min(), intervals.max()),
            **compare_simulated_a_v(files, first),
        },
    )


def compare_simulated_a_v(files, continuous):
    """a_V of two simulations, and of theory on the spectrum of the smaller cell and beyond it."""
    narrow, wide, lattice = (
        at_load(files[name]).isel(window=0)
        for name in ("fit_bem_128", "fit_bem_wide", "fit_lattice_128")
    )
    made = datasets.parameters(narrow)
    theory = continuous.sel(hurst=made["hurst"], method="nearest")
    return {
        "simulated": [
            (value_and_error(one, "a_v_mean"), describe_cell(one)) for one in (wide, narrow)
        ],
        "lattice": lattice.a_v.sel(variant=VARIANT),
        "continuous": np.interp(
            np.log(made["magnification"]), np.log(theory.magnification), theory
        ),
    }


@claim(9, "fit_fig3d", "fig3d", "fit_bem_wide", "fit_bem_128")
def a_v_against_load(files):
    fit = files["fit_fig3d"].sel(variant=VARIANT).isel(hurst=0, magnification=0, window=0)
    pressure = files["fig3d"].pressure.sel(variant=VARIANT).isel(hurst=0, magnification=0)
    inside = (pressure >= 1e-3) & (pressure <= 0.1)
    value = float(fit.a_v.where(inside).max() / fit.a_v.where(inside).min())
    full = float(fit.a_v.max() / fit.a_v.min())
    bem = [files[name].isel(window=0) for name in ("fit_bem_wide", "fit_bem_128")]
    bem = [one.where((one.pressure >= 1e-3) & (one.pressure <= 0.1)) for one in bem]
    return Finding(
        value=value,
        claimed=1.0,
        verdict=grade(full < 1.2, value < 1.5),
        errors={"model": np.nan},
        facts={
            "zeta": fit.magnification,
            "largest": pressure.max(),
            "full": full,
            "simulated": [
                (one.a_v_mean.max() / one.a_v_mean.min(), describe_cell(one)) for one in bem
            ],
        },
    )
