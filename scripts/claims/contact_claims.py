"""Claims on contact without adhesion: area, gaps and a_V, from simulation and theory."""

import numpy as np

from claims.ledger import Finding, claim, describe_cell, errors_by_source, grade, value_and_error
from common.conventions import LINEAR_UP_TO, VARIANT, at_load
from stickiness import datasets
from stickiness.criteria import a_v_fit

SHOWN = 1000.0  # magnification up to which the paper draws P(u)
SMALL_GAPS = (0.001, 0.003, 0.01, 0.03)  # over h_rms
MIDDLE = slice(1e3, 1e5)  # magnifications at which a_V should be about 3


@claim(1)
def area_slope(kappa_128, kappa_64, kappa_wide, lattice_128):
    at, simulations = at_load(kappa_128), []
    for data in (kappa_128, kappa_64, kappa_wide):
        quoted = {"cell": describe_cell(data), "kappa": value_and_error(at_load(data), "kappa")}
        simulations.append(quoted | {"ends": kappa_ends(data)})
    (_, first), (_, last) = simulations[0]["ends"]
    close = abs(float(at.kappa) - 2) < 0.2
    return Finding(
        at.kappa,
        grade(close and abs(1 - last / first) < 0.1, close),
        claimed=2.0,
        errors=errors_by_source(at, "kappa"),
        pressure=at.pressure,
        simulations=simulations,
        fit=value_and_error(kappa_128, "kappa_fit"),
        theory=at_load(lattice_128).kappa.sel(variant=VARIANT),
    )


def kappa_ends(fit):
    """Area and kappa at the smallest load and at the last with an area up to `LINEAR_UP_TO`."""
    inside = np.flatnonzero(fit.area_fraction <= LINEAR_UP_TO)
    ends = fit.isel(pressure=inside[[0, -1]])
    return list(zip(ends.area_fraction.values, ends.kappa.values, strict=True))


@claim(2)
def density_converges(fig1b):
    sweep = fig1b.gap_density.sel(variant=VARIANT).isel(hurst=0, load=0)
    last = sweep.isel(magnification=-1)
    before = sweep.sel(magnification=float(last.magnification) / 100, method="nearest")
    change = abs(last / before - 1).where(sweep.gap <= 2)
    settled = change.gap.values[np.flatnonzero(change.values > 0.05)]
    limit = float(settled.max(initial=sweep.gap.min()))
    spacing = float(np.diff(np.log(sweep.gap.values)).mean() * limit)
    return Finding(
        limit,
        grade(limit <= float(sweep.gap.min()), limit < 0.5),
        errors={"discretisation": spacing, "model": np.nan},
        zetas=(before.magnification, last.magnification),
        change=change.sel(gap=0.01, method="nearest"),
    )


@claim(3)
def small_gap_exponent(fig3a):
    found = find_exponents(fig3a, "gap_density", "gap")
    return Finding(
        found[-1][1][2],
        grade_power_law(fig3a),
        claimed=-1 / 3,
        errors={"model": float(np.ptp(found[-1][1])) / 2},
        gaps=SMALL_GAPS,
        exponents=found,
        hurst=float(fig3a.hurst[0]),
    )


def find_exponents(fig3a, name, along):
    """Local exponents of P(u) or A_ad at the small gaps, as shown and at the largest zeta."""
    values = fig3a[name].sel(variant=VARIANT).isel(hurst=0, load=0).sel({along: slice(None, 1)})
    ends, x = (values.sel(magnification=SHOWN, method="nearest"), values[-1]), values[along].values
    exponents = [a_v_fit.local_exponent(x, one.values) for one in ends]
    at = [np.interp(np.log(SMALL_GAPS), np.log(x), one) for one in exponents]
    return list(zip([one.magnification for one in ends], at, strict=True))


def grade_power_law(fig3a):
    """Verdict on P(u) ~ u^(-1/3) and on its integral A_ad ~ range^(2/3): one law, one grade."""
    density = find_exponents(fig3a, "gap_density", "gap")
    area = find_exponents(fig3a, "attractive_area", "range")
    off, off_beyond = (
        np.abs([of[1] + 1 / 3, integral[1] - 2 / 3]).max()
        for of, integral in zip(density, area, strict=True)
    )
    return grade(max(off, off_beyond) < 0.05, off < 0.1)


@claim(4)
def load_separation(fig3d, ensemble_wide, lattice_wide):
    sweep = fig3d.sel(variant=VARIANT).isel(hurst=0, magnification=0)
    theory = over_exponential(sweep.pressure, sweep.mean_gap)
    ratio = over_exponential(ensemble_wide.pressure, ensemble_wide.mean_gap_mean)
    ratio = ratio.dropna("pressure")
    off = np.abs(np.log(ratio))
    worst = ratio.isel(pressure=int(off.values.argmax()))
    at = ensemble_wide.sel(pressure=worst.pressure)
    lattice = lattice_wide.sel(variant=VARIANT, pressure=worst.pressure)
    # Largest mean gap up to which simulation keeps to the law; 1 to 3 is claimed.
    until = float(ensemble_wide.mean_gap_mean.where(off < np.log(1.25)).max().fillna(0))
    everywhere = max(off.max(), np.abs(np.log(theory)).max()) < np.log(1.25)
    errors = errors_by_source(at, "mean_gap_mean")
    return Finding(
        worst,
        grade(everywhere, until >= 2),
        claimed=1.0,
        errors={source: 2 * float(worst) * error for source, error in errors.items()},
        at=at,
        until=until,
        zeta=sweep.magnification,
        theory=(theory.min(), theory.max()),
        gaps=np.interp([0.1, 0.001], ensemble_wide.pressure, ensemble_wide.mean_gap_mean),
        cell=describe_cell(ensemble_wide),
        lattice=lattice.pressure * np.exp(2 * lattice.mean_gap),
    )


def over_exponential(pressure, mean_gap):
    """Ratio p/exp(-2 mean gap) where the mean gap is 1 to 3, NaN elsewhere."""
    return (pressure * np.exp(2 * mean_gap)).where((mean_gap >= 1) & (mean_gap <= 3))


@claim(6)
def area_against_range(fig3a, fit_fig3a):
    area = fig3a.attractive_area.sel(variant=VARIANT).isel(hurst=0, load=0)
    last, before = area.isel(magnification=-1), area.sel(magnification=1e4, method="nearest")
    small, large = (float((last / before).interp(range=e)) - 1 for e in (0.01, 0.1))
    fit = fit_fig3a.sel(variant=VARIANT).isel(hurst=0, load=0, magnification=-1)
    found = find_exponents(fig3a, "attractive_area", "range")
    return Finding(
        found[-1][1][2],
        grade_power_law(fig3a),
        claimed=2 / 3,
        errors={"model": float(np.ptp(found[-1][1])) / 2},
        ranges=SMALL_GAPS,
        exponents=found,
        zetas=(before.magnification, last.magnification),
        slopes=list(zip(fit.a_v, fit.window_low, fit.window_high, strict=True)),
        growth={"small": small, "large": large},
    )


@claim(7)
def area_against_load(fig3b, ensemble_wide, lattice_wide):
    sweep = fig3b.sel(variant=VARIANT).isel(hurst=0, magnification=0)
    loads = sweep.pressure.values
    theory = load_exponent(loads, sweep.attractive_area)
    bem = ensemble_wide.sel(pressure=slice(loads[0] * (1 - 1e-9), None))
    measured = load_exponent(bem.pressure.values, bem.attractive_area_mean)
    lattice = lattice_wide.sel(variant=VARIANT, pressure=bem.pressure)
    everywhere = np.abs(np.concatenate([theory, measured]) - 1).max() < 0.1
    return Finding(
        theory[0],
        grade(everywhere, max(abs(theory[0] - 1), abs(measured[0] - 1)) < 0.25),
        claimed=1.0,
        errors={"model": np.nan},
        zeta=sweep.magnification,
        loads=loads,
        theory=theory,
        cell=describe_cell(ensemble_wide),
        simulated=measured,
        lattice=load_exponent(bem.pressure.values, lattice.attractive_area),
    )


def load_exponent(loads, area, at=0.03):
    """Local exponent d ln A_ad/d ln p at one range, load by load."""
    return np.gradient(np.log(area.interp(range=at).values), np.log(loads))


@claim(8)
def a_v_against_magnification(fit_fig3c, fit_bem_128, fit_lattice_128, fit_bem_wide):
    fit = fit_fig3c.sel(variant=VARIANT).isel(load=0)
    largest = fit.isel(magnification=-1).sel(hurst=0.8, method="nearest")
    first = fit.a_v.isel(window=0)
    step = first.isel(magnification=-1) / first.isel(magnification=-2) - 1
    value, error = float(largest.a_v[0]), float(np.ptp(largest.a_v.values)) / 2
    grown = abs(value * float(step.sel(hurst=0.8, method="nearest")))
    middle = first.sel(hurst=0.8, method="nearest").sortby("magnification")
    middle = middle.sel(magnification=MIDDLE)
    is_3, about = abs(value - 3) <= error < 0.5, float(np.abs(middle / 3 - 1).max()) < 0.25
    steady = float(np.abs(step).max()) < 0.02
    errors = errors_by_source(largest.isel(window=0), "a_v")
    narrow, wide = (at_load(data).isel(window=0) for data in (fit_bem_128, fit_bem_wide))
    return Finding(
        value,
        grade(is_3 and steady, about),
        claimed=3.0,
        errors=errors | {"bandwidth": grown, "model": np.hypot(errors["model"], error)},
        zetas=fit.magnification[-2:],
        middle=(middle.min(), middle.max()),
        middle_zetas=middle.magnification[[0, -1]],
        about=grade(is_3, about),
        converges=grade(steady, False),
        growth=[(float(one.hurst), one) for one in step],
        intervals=(largest.a_v.min(), largest.a_v.max()),
        simulated=[
            (value_and_error(one, "a_v_mean"), describe_cell(one)) for one in (wide, narrow)
        ],
        lattice=at_load(fit_lattice_128).isel(window=0).a_v.sel(variant=VARIANT),
        continuous=interpolate_a_v(first, **datasets.parameters(narrow)),
    )


def interpolate_a_v(a_v, hurst, magnification, **_):
    """a_V of theory at the Hurst exponent and magnification of a simulation."""
    a_v = a_v.sel(hurst=hurst, method="nearest")
    return np.interp(np.log(magnification), np.log(a_v.magnification), a_v)


@claim(9)
def a_v_against_load(fit_fig3d, fig3d, fit_bem_wide, fit_bem_128):
    fit = fit_fig3d.sel(variant=VARIANT).isel(hurst=0, magnification=0, window=0)
    pressure = fig3d.pressure.sel(variant=VARIANT).isel(hurst=0, magnification=0)
    inside = fit.a_v.where((pressure >= 1e-3) & (pressure <= 0.1))
    value, full = (float(a_v.max() / a_v.min()) for a_v in (inside, fit.a_v))
    bem = [
        data.isel(window=0).sel(pressure=slice(1e-3, 0.1)) for data in (fit_bem_wide, fit_bem_128)
    ]
    return Finding(
        value,
        grade(full < 1.2, value < 1.5),
        claimed=1.0,
        errors={"model": np.nan},
        zeta=fit.magnification,
        largest=pressure.max(),
        full=full,
        simulated=[(one.a_v_mean.max() / one.a_v_mean.min(), describe_cell(one)) for one in bem],
    )
