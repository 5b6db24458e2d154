"""Claims on contact without adhesion: area, gaps and a_V, by simulation and theory."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from claims.ledger import Files, Finding, claim, grade
from claims.texts import describe_sample, errors_by_source, power_of_ten, quote
from common.conventions import LINEAR_UP_TO, VARIANT, at_load
from common.formatting import percent
from stickiness import datasets
from stickiness import error_budget as budget
from stickiness.criteria import a_v_fit

SHOWN = 1000.0  # magnification up to which the paper draws P(u)
SMALL_GAPS = (0.001, 0.003, 0.01, 0.03)  # over h_rms
MIDDLE = slice(1e3, 1e5)  # magnifications at which a_V is to be about 3
NOT_MEASURED = "the theory's error was measured up to zeta = 256 only (Figure 8)"


@claim(
    1,
    "kappa_rep = 2, area linear in load up to 30 %",
    files=("kappa_128", "kappa_64", "kappa_wide", "lattice_128"),
)
def area_slope(files: Files) -> Finding:
    k = files["kappa_128"]
    at, theory = at_load(k), at_load(files["lattice_128"]).kappa.sel(variant=VARIANT)
    value = float(at.kappa)
    (_, first), (_, last) = kappa_ends(k)
    close = abs(value - 2) < 0.2
    others = "; ".join(
        f"{describe_sample(other)}: {quote(at_load(other), 'kappa')}, {describe_kappa(other)}"
        for other in (files["kappa_64"], files["kappa_wide"])
    )
    return Finding(
        quantity=f"kappa_rep at p = {float(at.pressure):g}, {describe_sample(k)}",
        value=value,
        claimed=2.0,
        verdict=grade(close and abs(1 - last / first) < 0.1, close),
        remark=(
            f"kappa goes {describe_kappa(k)}. The fit with weight p^2 up to an area of 30 % gives "
            f"{quote(k, 'kappa_fit')}, theory on the spectrum of the simulated window "
            f"{float(theory):.2f}. Other simulations: {others}."
        ),
        errors=errors_by_source(at, "kappa"),
    )


def describe_kappa(fit: xr.Dataset) -> str:
    (small, first), (large, last) = kappa_ends(fit)
    return f"from {first:.2f} at an area of {percent(small)} to {last:.2f} at {percent(large)}"


def kappa_ends(fit: xr.Dataset, largest: float = LINEAR_UP_TO) -> list[tuple[float, float]]:
    """Area and kappa at the smallest load and at the last with an area of at most `largest`."""
    inside = np.flatnonzero(fit.area_fraction <= largest)
    return [(float(fit.area_fraction[i]), float(fit.kappa[i])) for i in inside[[0, -1]]]


@claim(2, "P(u) at fixed mean gap converges with magnification (Figs. 1A, 1B)", files=("fig1b",))
def density_converges(files: Files) -> Finding:
    sweep = files["fig1b"].gap_density.sel(variant=VARIANT).isel(hurst=0, load=0)
    last = sweep.isel(magnification=-1)
    before = sweep.sel(magnification=float(last.magnification) / 100, method="nearest")
    change = abs(last / before - 1).where(sweep.gap <= 2)
    settled = change.gap.values[np.flatnonzero(change.values > 0.05)]
    limit = float(settled.max()) if settled.size else float(sweep.gap.min())
    zetas = power_of_ten(before.magnification), power_of_ten(last.magnification)
    worst = float(change.sel(gap=0.01, method="nearest"))
    spacing = float(np.diff(np.log(sweep.gap.values)).mean() * limit)
    return Finding(
        quantity=f"u/h_rms above which P changes by < 5 % from zeta = {zetas[0]} to {zetas[1]}",
        value=limit,
        verdict=grade(limit <= float(sweep.gap.min()), limit < 0.5),
        remark="P converges above this gap only; at u/h_rms = 0.01 it changes by "
        f"{percent(worst)}.",
        errors={"discretisation": spacing, "model": np.nan},
        comment=f"discretisation: spacing of the gaps; model: {NOT_MEASURED}",
    )


@claim(3, "P(u) ~ u^(-1/3) at small gaps", files=("fig3a",))
def small_gap_exponent(files: Files) -> Finding:
    exponent = density_exponent(files["fig3a"])
    shown = exponent.sel(magnification=SHOWN, method="nearest")
    broad = exponent.isel(magnification=-1)
    at, beyond = (exponents_at(one, SMALL_GAPS) for one in (shown, broad))
    off, off_beyond = (float(np.abs(values + 1 / 3).max()) for values in (at, beyond))
    hurst = float(exponent.hurst)
    return Finding(
        quantity=f"d ln P/d ln u at u/h_rms = {SMALL_GAPS[2]:g}, theory, "
        f"zeta = {power_of_ten(shown.magnification)}",
        value=float(at[2]),
        claimed=-1 / 3,
        verdict=grade(max(off, off_beyond) < 0.05, off < 0.1),
        remark=(
            f"{describe_exponents(shown, at)}, about -1/3 as the edges of contact have it. "
            f"{describe_exponents(broad, beyond)}. So the power law is a crossover: in the fractal "
            f"limit the exponent tends to (1-2H)/H, {(1 - 2 * hurst) / hurst:.2f} here. "
            f"{describe_widest(exponent)}"
        ),
        errors={"model": float(np.ptp(at)) / 2},
        comment="model: of a power law, half the range of the exponent at these gaps; of the "
        f"theory, not included: {NOT_MEASURED}",
    )


def exponents_at(exponent: xr.DataArray, gaps: Sequence[float]) -> NDArray:
    """Exponent at one magnification between the gaps of its grid."""
    return np.interp(np.log(gaps), np.log(exponent.gap), exponent)


def describe_exponents(exponent: xr.DataArray, at: NDArray) -> str:
    values, gaps = (", ".join(f"{x:.2f}" for x in at), ", ".join(f"{u:g}" for u in SMALL_GAPS))
    zeta = power_of_ten(exponent.magnification)
    return f"At zeta = {zeta} the exponent is {values} at u/h_rms = {gaps}"


def density_exponent(sweep: xr.Dataset) -> xr.DataArray:
    """Local exponent d ln P/d ln u of the gap density below h_rms, by magnification."""
    density = sweep.gap_density.sel(variant=VARIANT, gap=slice(None, 1)).isel(hurst=0, load=0)
    return xr.apply_ufunc(
        lambda values: a_v_fit.local_exponent(density.gap.values, values),
        density,
        input_core_dims=[["gap"]],
        output_core_dims=[["gap"]],
        vectorize=True,
    )


def describe_widest(exponent: xr.DataArray) -> str:
    """The magnification with the widest range of gaps where the exponent is about -1/3."""
    spans = {
        float(z): close_to_third(exponent.sel(magnification=z)) for z in exponent.magnification
    }
    zeta = max(spans, key=lambda z: spans[z][1] / spans[z][0])
    widest = describe_range(*spans[zeta])
    return f"Over all magnifications the widest is at zeta = {power_of_ten(zeta)}: {widest}."


def describe_range(low: float, high: float) -> str:
    return f"u/h_rms = {low:.2g} … {high:.2g}" if high > low else "empty"


def close_to_third(exponent: xr.DataArray, within: float = 0.05) -> tuple[float, float]:
    """Ends of the longest unbroken range of gaps whose exponent is about -1/3; 1, 1 if none."""
    close = np.abs(exponent.values + 1 / 3) < within
    edges = np.flatnonzero(np.diff(np.concatenate([[0], close.astype(int), [0]])))
    if not edges.size:
        return 1.0, 1.0
    starts, ends = edges[::2], edges[1::2] - 1
    longest = int(np.argmax(ends - starts))
    return float(exponent.gap[starts[longest]]), float(exponent.gap[ends[longest]])


@claim(
    4,
    "p/(E* q0 h_rms) = exp(-2 u/h_rms); 1 to 3 h_rms of mean gap for loads 0.1 to 0.001",
    files=("fig3d", "ensemble_wide", "lattice_wide"),
)
def load_separation(files: Files) -> Finding:
    sweep = files["fig3d"].sel(variant=VARIANT).isel(hurst=0, magnification=0)
    ratio = over_exponential(sweep.pressure, sweep.mean_gap)
    bem = files["ensemble_wide"]
    measured = over_exponential(bem.pressure, bem.mean_gap_mean).dropna("pressure")
    lattice = files["lattice_wide"].sel(variant=VARIANT, pressure=measured.pressure)
    lattice = lattice.pressure * np.exp(2 * lattice.mean_gap)
    loads = measured.pressure.values[[-1, 0]]
    gaps = [float(np.interp(p, sweep.pressure, sweep.mean_gap)) for p in (0.1, 0.001)]
    holds, simulated = farthest(ratio) < 1.25, farthest(measured) < 1.25
    return Finding(
        quantity=(
            "p exp(2 u/h_rms)/(E* q0 h_rms), mean for u = 1 to 3 h_rms, theory, "
            f"zeta = {float(sweep.magnification):g}"
        ),
        value=float(ratio.mean()),
        claimed=1.0,
        verdict=grade(holds and simulated, holds),
        remark=(
            f"By theory the ratio is {float(ratio.min()):.2f} to {float(ratio.max()):.2f}, and the "
            f"mean gap {gaps[0]:.2f} and {gaps[1]:.2f} h_rms at loads 0.1 and 0.001. Simulation "
            f"({describe_sample(bem)}) {'agrees' if simulated else 'disagrees'}: "
            f"{float(measured[-1]):.2f} at p = {loads[0]:g}, {float(measured[0]):.2f} at "
            f"{loads[1]:g}. Theory on the spectrum of that window gives {float(lattice[-1]):.2f} "
            f"and {float(lattice[0]):.2f}, so the window explains only part of the difference."
        ),
        errors={"model": float(ratio.mean() * abs(lattice / measured - 1).max())},
        comment="model: largest difference of theory from simulation on the same spectrum, "
        + describe_sample(bem),
    )


def over_exponential(pressure: xr.DataArray, mean_gap: xr.DataArray) -> xr.DataArray:
    """Ratio p/exp(-2 mean gap) where the mean gap is 1 to 3, NaN elsewhere."""
    return (pressure * np.exp(2 * mean_gap)).where((mean_gap >= 1) & (mean_gap <= 3))


def farthest(ratio: xr.DataArray) -> float:
    """Largest factor, up or down, by which ratios differ from 1."""
    return float(np.exp(np.abs(np.log(ratio)).max()))


@claim(
    6,
    "A_ad against (range/h_rms)^(2/3) is linear and converges with magnification (Fig. 3A)",
    files=("fig3a", "fit_fig3a"),
)
def area_against_range(files: Files) -> Finding:
    area = files["fig3a"].attractive_area.sel(variant=VARIANT).isel(hurst=0, load=0)
    last, before = area.isel(magnification=-1), area.sel(magnification=1e4, method="nearest")
    zetas = power_of_ten(before.magnification), power_of_ten(last.magnification)
    small, large = (float((last / before).interp(range=e)) - 1 for e in (0.01, 0.1))
    fit = files["fit_fig3a"].sel(variant=VARIANT).isel(hurst=0, load=0, magnification=-1)
    intervals = [fit.isel(window=index) for index in range(fit.sizes["window"])]
    slopes = ", ".join(
        f"{float(one.a_v):.2f} ({float(one.window_low):g} to {float(one.window_high):g})"
        for one in intervals
    )
    ratio = float(fit.a_v.max() / fit.a_v.min())
    settled = max(small, large) < 0.02
    return Finding(
        quantity="largest over smallest slope of A_ad among the fit intervals of range/h_rms, "
        f"theory, zeta = {zetas[1]}",
        value=ratio,
        claimed=1.0,
        verdict=grade(settled and ratio < 1.05, large < 0.1 and ratio < 1.25),
        remark=(
            f"Slope a_V by fit interval: {slopes}. From zeta = {zetas[0]} to {zetas[1]} A_ad still "
            f"grows by {percent(large)} at range/h_rms = 0.1 and by {percent(small)} at 0.01."
        ),
        errors={"model": np.nan},
        comment=f"model: {NOT_MEASURED}",
    )


@claim(
    7,
    "A_ad grows in proportion to the load (Fig. 3B)",
    files=("fig3b", "ensemble_wide", "lattice_wide"),
)
def area_against_load(files: Files) -> Finding:
    sweep = files["fig3b"].sel(variant=VARIANT).isel(hurst=0, magnification=0)
    loads = sweep.pressure.values
    theory = load_exponent(loads, sweep.attractive_area)
    bem = files["ensemble_wide"].sel(pressure=slice(loads[0] * (1 - 1e-9), None))
    measured = load_exponent(bem.pressure.values, bem.attractive_area_mean)
    lattice = files["lattice_wide"].sel(variant=VARIANT, pressure=bem.pressure)
    lattice = load_exponent(bem.pressure.values, lattice.attractive_area)
    both = np.abs(np.array([theory[0], measured[0]]) - 1)
    return Finding(
        quantity=(
            f"d ln A_ad/d ln p at range/h_rms = 0.03, p = {loads[0]:g}, theory, "
            f"zeta = {float(sweep.magnification):g}"
        ),
        value=float(theory[0]),
        claimed=1.0,
        verdict=grade(
            np.abs(np.concatenate([theory, measured]) - 1).max() < 0.1, both.max() < 0.25
        ),
        remark=(
            f"The exponent is {theory[-1]:.2f} at p = {loads[-1]:g}. Simulation "
            f"({describe_sample(bem)}) gives {measured[0]:.2f} to {measured[-1]:.2f}, theory on "
            f"the spectrum of that window {lattice[0]:.2f} to {lattice[-1]:.2f}."
        ),
        errors={"model": np.nan},
        comment=f"model: {NOT_MEASURED}",
    )


def load_exponent(loads: np.ndarray, area: xr.DataArray, at: float = 0.03) -> np.ndarray:
    """Local exponent d ln A_ad/d ln p at one range, load by load."""
    return np.gradient(np.log(area.interp(range=at).values), np.log(loads))


@claim(
    8,
    "a_V converges to about 3 at high magnification (Fig. 3C)",
    files=("fit_fig3c", "fit_bem_128", "fit_lattice_128", "fit_bem_wide"),
)
def a_v_against_magnification(files: Files) -> Finding:
    fit = files["fit_fig3c"].sel(variant=VARIANT).isel(load=0)
    intervals = fit.a_v.isel(magnification=-1).sel(hurst=0.8, method="nearest")
    first = theory_a_v(files["fit_fig3c"])
    step = last_growth(first)
    zetas = [power_of_ten(zeta) for zeta in fit.magnification[-2:]]
    growth = ", ".join(f"{percent(float(g))} (H = {float(g.hurst):g})" for g in step)
    value, error = float(intervals[0]), float(np.ptp(intervals.values)) / 2
    grown = abs(value * float(step.sel(hurst=0.8, method="nearest")))
    fit = fit.isel(magnification=-1, window=0).sel(hurst=0.8, method="nearest")
    model = float(budget.part(fit, "a_v", "model"))
    steady = float(np.abs(step).max()) < 0.02
    near = abs(value - 3) <= error
    middle = first.sel(hurst=0.8, method="nearest").sortby("magnification")
    middle = middle.sel(magnification=MIDDLE)
    about = float(np.abs(middle / 3 - 1).max()) < 0.25
    ends = [power_of_ten(zeta) for zeta in middle.magnification[[0, -1]]]
    return Finding(
        quantity=f"a_V, theory, H = 0.8, zeta = {zetas[1]}",
        value=value,
        claimed=3.0,
        verdict=grade(near and steady and error < 0.5, about),
        remark=(
            f"a_V is {float(middle.min()):.2f} to {float(middle.max()):.2f} at zeta = {ends[0]} to "
            f"{ends[1]}, {'' if about else 'not '}about 3. It {'has' if steady else 'has not'} "
            f"converged: it grows by {growth} from zeta = {zetas[0]} to {zetas[1]}. There the fit "
            f"intervals give {float(intervals.min()):.2f} to {float(intervals.max()):.2f}. "
            f"{describe_simulated_a_v(files, first)}"
        ),
        errors=errors_by_source(fit, "a_v") | {"bandwidth": grown, "model": np.hypot(model, error)},
        comment=(
            "bandwidth: growth over the last step of magnification; model: measured error of the "
            "theory and half the range over the fit intervals"
        ),
    )


def theory_a_v(fit: xr.Dataset) -> xr.DataArray:
    """a_V by theory on the first fit interval, by Hurst exponent and magnification."""
    return fit.a_v.sel(variant=VARIANT).isel(load=0, window=0)


def last_growth(a_v: xr.DataArray) -> xr.DataArray:
    """Relative growth over the last step of magnification."""
    return a_v.isel(magnification=-1) / a_v.isel(magnification=-2) - 1


def describe_simulated_a_v(files: Files, continuous: xr.DataArray) -> str:
    """What simulation gives, and what of it is due to the window."""
    narrow, wide, lattice = (
        at_load(files[name]).isel(window=0)
        for name in ("fit_bem_128", "fit_bem_wide", "fit_lattice_128")
    )
    asked = datasets.parameters(narrow)
    theory = continuous.sel(hurst=asked["hurst"], method="nearest")
    theory = np.interp(np.log(asked["magnification"]), np.log(theory.magnification), theory)
    return (
        f"Simulation gives {quote(wide, 'a_v_mean')} ({describe_sample(wide)}) and "
        f"{quote(narrow, 'a_v_mean')} ({describe_sample(narrow)}). The latter is set by the few "
        "long waves of its window, not by the magnification: theory gives "
        f"{float(lattice.a_v.sel(variant=VARIANT)):.2f} on the spectrum of that window and "
        f"{theory:.2f} on the continuous one."
    )


@claim(
    9,
    "a_V depends weakly on the load (Fig. 3D)",
    files=("fit_fig3d", "fig3d", "fit_bem_wide", "fit_bem_128"),
)
def a_v_against_load(files: Files) -> Finding:
    fit = files["fit_fig3d"].sel(variant=VARIANT).isel(hurst=0, magnification=0, window=0)
    pressure = files["fig3d"].pressure.sel(variant=VARIANT).isel(hurst=0, magnification=0)
    inside = (pressure >= 1e-3) & (pressure <= 0.1)
    value = float(fit.a_v.where(inside).max() / fit.a_v.where(inside).min())
    full = float(fit.a_v.max() / fit.a_v.min())
    bem = [files[name].isel(window=0) for name in ("fit_bem_wide", "fit_bem_128")]
    bem = [one.where((one.pressure >= 1e-3) & (one.pressure <= 0.1)) for one in bem]
    simulated = " but ".join(
        f"{float(one.a_v_mean.max() / one.a_v_mean.min()):.2f} ({describe_sample(one)})"
        for one in bem
    )
    return Finding(
        quantity=(
            "largest over smallest a_V for loads 0.001 to 0.1, theory, "
            f"zeta = {float(fit.magnification):g}"
        ),
        value=value,
        claimed=1.0,
        verdict=grade(full < 1.2, value < 1.5),
        remark=(
            f"Up to p = {float(pressure.max()):g} the ratio is {full:.2f}. Simulation up to 0.1 "
            f"gives {simulated}. In the smaller window contact at small loads is confined to the "
            "summits of a few long waves."
        ),
        errors={"model": np.nan},
        comment=f"model: {NOT_MEASURED}",
    )
