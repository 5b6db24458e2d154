"""Claims on contact without adhesion: area, gaps and a_V, from simulation and theory."""

import numpy as np

from claims.ledger import (
    OPEN,
    Finding,
    choose,
    claim,
    describe_cell,
    errors_by_source,
    grade,
    value_and_error,
)
from common.conventions import LINEAR_UP_TO, VARIANT
from common.paper import (
    A_V,
    HURST,
    HURST_3C,
    LOADS_OF_A_V,
    LOADS_OF_GAPS,
    ZETA_3B,
    ZETA_3D,
    ZETAS_3A,
    ZETAS_OF_A_V,
    at_load,
)
from stickiness import datasets
from stickiness.criteria import a_v_fit

SMALL_GAPS = (0.001, 0.003, 0.01, 0.03)  # over h_rms
MIDDLE_GAP = 2  # index of the gap at which exponents are quoted


@claim(1)
def area_slope(kappa_broad_band, kappa_middle_band, kappa_wide_cell, lattice_broad_band):
    """Contact area is linear in load, with a slope kappa of 2."""
    loaded = at_load(kappa_broad_band)
    simulations = []
    for data in (kappa_broad_band, kappa_middle_band, kappa_wide_cell):
        quoted = {"cell": describe_cell(data), "kappa": value_and_error(at_load(data), "kappa")}
        simulations.append(quoted | {"ends": kappa_ends(data)})
    (_, first), (_, last) = simulations[0]["ends"]
    close = abs(float(loaded.kappa) - 2) < 0.2
    return Finding(
        loaded.kappa,
        grade(close and abs(1 - last / first) < 0.1, close),
        claimed=2.0,
        errors=errors_by_source(loaded, "kappa"),
        pressure=loaded.pressure,
        simulations=simulations,
        fit=value_and_error(kappa_broad_band, "kappa_fit"),
        theory=at_load(lattice_broad_band).kappa.sel(variant=VARIANT),
    )


def kappa_ends(fit):
    """Area and kappa at the smallest load and at the last with an area up to `LINEAR_UP_TO`."""
    inside = np.flatnonzero(fit.area_fraction <= LINEAR_UP_TO)
    ends = fit.isel(pressure=inside[[0, -1]])
    return list(zip(ends.area_fraction.values, ends.kappa.values, strict=True))


@claim(2)
def density_converges(fig1b):
    """P(u) converges with the magnification."""
    theory = choose(fig1b.sel(variant=VARIANT), hurst=HURST).isel(load=0)
    sweep = theory.gap_density.sortby("magnification")
    last = sweep.isel(magnification=-1)
    before = choose(sweep, magnification=float(last.magnification) / 100)
    change = abs(last / before - 1).where(sweep.gap <= 2)
    settled = change.gap.values[np.flatnonzero(change.values > 0.05)]
    limit = float(settled.max(initial=sweep.gap.min()))
    spacing = float(np.diff(np.log(sweep.gap.values)).mean() * limit)
    far = float(last.magnification) > 10 * float(before.magnification)  # else P can hardly change
    return Finding(
        limit,
        grade(limit <= float(sweep.gap.min()), limit < 0.5) if far else OPEN,
        errors={"discretisation": spacing, "model": np.nan},
        hurst=theory.hurst,
        mean_gap=theory.mean_gap.isel(magnification=-1),
        zetas=(before.magnification, last.magnification),
        change=change.sel(gap=0.01, method="nearest"),
    )


@claim(3)
def small_gap_exponent(fig3a):
    """P(u) falls as u^(-1/3) at small gaps."""
    exponents = find_exponents(fig3a, "gap_density", "gap")
    _, at_largest_zeta = exponents[-1]
    return Finding(
        at_largest_zeta[MIDDLE_GAP],
        grade_power_law(fig3a),
        claimed=-1 / 3,
        errors={"model": float(np.ptp(at_largest_zeta)) / 2},
        gaps=SMALL_GAPS,
        exponents=exponents,
        made=choose_3a(fig3a),
    )


def choose_3a(fig3a):
    """Theory of Figure 3A at the paper's Hurst exponent, load and largest magnification."""
    theory = fig3a.sel(variant=VARIANT).isel(load=0)
    return choose(theory, hurst=HURST, magnification=ZETAS_3A[-1])


def find_exponents(fig3a, name, along):
    """Local exponents of P(u) or A_ad at the small gaps: magnification and exponents.

    First at the largest magnification at which the paper draws P(u), then at that of Figure 3A.
    """
    values = choose(fig3a[name].sel(variant=VARIANT).isel(load=0), hurst=HURST)
    values = values.sel({along: slice(None, 1)})
    x = values[along].values
    exponents = []
    shown = 1000.0  # magnification up to which the paper draws P(u)
    for magnification in (shown, ZETAS_3A[-1]):
        curve = choose(values, magnification=magnification)
        local = a_v_fit.local_exponent(x, curve.values)
        exponents.append((curve.magnification, np.interp(np.log(SMALL_GAPS), np.log(x), local)))
    return exponents


def grade_power_law(fig3a):
    """Verdict on P(u) ~ u^(-1/3) and on its integral A_ad ~ range^(2/3): one law, one grade."""
    density = find_exponents(fig3a, "gap_density", "gap")
    area = find_exponents(fig3a, "attractive_area", "range")
    deviations = [
        np.abs([of_density + 1 / 3, of_area - 2 / 3]).max()
        for (_, of_density), (_, of_area) in zip(density, area, strict=True)
    ]
    as_shown, at_largest_zeta = deviations
    return grade(max(as_shown, at_largest_zeta) < 0.05, as_shown < 0.1)


@claim(4)
def load_separation(fig3d, ensemble_wide_cell, lattice_wide_cell):
    """Load falls exponentially with the mean gap."""
    sweep = choose(fig3d.sel(variant=VARIANT), hurst=HURST, magnification=ZETA_3D)
    theory = over_exponential(sweep.pressure, sweep.mean_gap)
    ratio = over_exponential(ensemble_wide_cell.pressure, ensemble_wide_cell.mean_gap_mean)
    ratio = ratio.dropna("pressure")
    off = np.abs(np.log(ratio))
    worst = ratio.isel(pressure=int(off.values.argmax()))
    simulated = ensemble_wide_cell.sel(pressure=worst.pressure)
    lattice = lattice_wide_cell.sel(variant=VARIANT, pressure=worst.pressure)
    # Largest mean gap up to which simulation keeps to the law; 1 to 3 is claimed.
    until = float(ensemble_wide_cell.mean_gap_mean.where(off < np.log(1.25)).max().fillna(0))
    everywhere = max(off.max(), np.abs(np.log(theory)).max()) < np.log(1.25)
    errors = errors_by_source(simulated, "mean_gap_mean")
    return Finding(
        worst,
        grade(everywhere, until >= 2),
        claimed=1.0,
        errors={source: 2 * float(worst) * error for source, error in errors.items()},
        at=simulated,
        until=until,
        made=sweep,
        theory=(theory.min(), theory.max()),
        loads=LOADS_OF_GAPS,
        gaps=np.interp(
            LOADS_OF_GAPS, ensemble_wide_cell.pressure, ensemble_wide_cell.mean_gap_mean
        ),
        cell=describe_cell(ensemble_wide_cell),
        lattice=lattice.pressure * np.exp(2 * lattice.mean_gap),
    )


def over_exponential(pressure, mean_gap):
    """Ratio p/exp(-2 mean gap) where the mean gap is 1 to 3, NaN elsewhere."""
    return (pressure * np.exp(2 * mean_gap)).where((mean_gap >= 1) & (mean_gap <= 3))


@claim(6)
def area_against_range(fig3a, fit_fig3a):
    """Attractive area grows as the range to the power 2/3."""
    area = choose(fig3a.attractive_area.sel(variant=VARIANT).isel(load=0), hurst=HURST)
    last = choose(area, magnification=ZETAS_3A[-1])
    before = choose(area, magnification=1e4)
    ratio = last / before
    small = float(ratio.interp(range=0.01)) - 1
    large = float(ratio.interp(range=0.1)) - 1
    fit = choose_3a(fit_fig3a)
    exponents = find_exponents(fig3a, "attractive_area", "range")
    _, at_largest_zeta = exponents[-1]
    return Finding(
        at_largest_zeta[MIDDLE_GAP],
        grade_power_law(fig3a),
        claimed=2 / 3,
        errors={"model": float(np.ptp(at_largest_zeta)) / 2},
        ranges=SMALL_GAPS,
        exponents=exponents,
        made=choose_3a(fig3a),
        zetas=(before.magnification, last.magnification),
        slopes=list(zip(fit.a_v, fit.window_low, fit.window_high, strict=True)),
        growth={"small": small, "large": large},
    )


@claim(7)
def area_against_load(fig3b, ensemble_wide_cell, lattice_wide_cell):
    """Attractive area is linear in load."""
    sweep = choose(fig3b.sel(variant=VARIANT), hurst=HURST, magnification=ZETA_3B)
    loads = sweep.pressure.values
    theory = load_exponent(loads, sweep.attractive_area)
    bem = ensemble_wide_cell.sel(pressure=slice(loads[0] * (1 - 1e-9), None))
    measured = load_exponent(bem.pressure.values, bem.attractive_area_mean)
    lattice = lattice_wide_cell.sel(variant=VARIANT, pressure=bem.pressure)
    everywhere = np.abs(np.concatenate([theory, measured]) - 1).max() < 0.1
    return Finding(
        theory[0],
        grade(everywhere, max(abs(theory[0] - 1), abs(measured[0] - 1)) < 0.25),
        claimed=1.0,
        errors={"model": np.nan},
        made=sweep,
        loads=loads,
        theory=theory,
        cell=describe_cell(ensemble_wide_cell),
        simulated=measured,
        lattice=load_exponent(bem.pressure.values, lattice.attractive_area),
    )


def load_exponent(loads, area, at=0.03):
    """Local exponent d ln A_ad/d ln p at one range, load by load."""
    if len(loads) < 2:
        return np.array([np.nan])
    return np.gradient(np.log(area.interp(range=at).values), np.log(loads))


@claim(8)
def a_v_against_magnification(
    fit_fig3c, fit_bem_broad_band, fit_lattice_broad_band, fit_bem_wide_cell
):
    """a_V converges to about 3 with the magnification."""
    theory = fit_fig3c.sel(variant=VARIANT).isel(load=0).sortby("magnification")
    fit = choose(theory, hurst=HURST_3C)
    largest = choose(fit.isel(magnification=-1), hurst=HURST)
    first = fit.a_v.isel(window=0)
    last_two = first.isel(magnification=slice(-2, None))
    step = last_two.isel(magnification=-1) / last_two.isel(magnification=0) - 1
    value = float(largest.a_v[0])
    error = float(np.ptp(largest.a_v.values)) / 2
    grown = abs(value * float(choose(step, hurst=HURST)))
    curve = choose(first, hurst=HURST)
    inside = curve.sel(magnification=slice(*ZETAS_OF_A_V))
    middle = inside if inside.size else curve
    is_3 = abs(value - A_V) <= error < 0.5
    about = float(np.abs(middle / A_V - 1).max()) < 0.25
    steady = float(np.abs(step).max()) < 0.02
    errors = errors_by_source(largest.isel(window=0), "a_v")
    broad = at_load(fit_bem_broad_band).isel(window=0)
    wide = at_load(fit_bem_wide_cell).isel(window=0)
    return Finding(
        value,
        grade(is_3 and steady, about),
        claimed=A_V,
        errors=errors | {"bandwidth": grown, "model": np.hypot(errors["model"], error)},
        hurst=largest.hurst,
        zetas=last_two.magnification[[0, -1]],
        middle=(middle.min(), middle.max()),
        middle_zetas=middle.magnification[[0, -1]],
        about=grade(is_3, about),
        converges=grade(steady, False),
        growth=[(float(change.hurst), change) for change in step],
        intervals=(largest.a_v.min(), largest.a_v.max()),
        simulated=[
            (value_and_error(case, "a_v_mean"), describe_cell(case)) for case in (wide, broad)
        ],
        lattice=at_load(fit_lattice_broad_band).isel(window=0).a_v.sel(variant=VARIANT),
        continuous=interpolate_a_v(theory.a_v.isel(window=0), **datasets.parameters(broad)),
    )


def interpolate_a_v(a_v, hurst, magnification, **_):
    """a_V of theory at the Hurst exponent and magnification of a simulation; NaN if beyond it."""
    a_v = choose(a_v, hurst=hurst).sortby("magnification")
    if not np.isclose(a_v.hurst, hurst):
        return np.nan
    ends = {"left": np.nan, "right": np.nan}
    return float(np.interp(np.log(magnification), np.log(a_v.magnification), a_v, **ends))


@claim(9)
def a_v_against_load(fit_fig3d, fig3d, fit_bem_wide_cell, fit_bem_broad_band):
    """a_V hardly depends on the load."""
    paper = {"hurst": HURST, "magnification": ZETA_3D}
    fit = choose(fit_fig3d.sel(variant=VARIANT).isel(window=0), **paper)
    pressure = choose(fig3d.pressure.sel(variant=VARIANT), **paper)
    low, high = LOADS_OF_A_V
    between = (pressure >= low) & (pressure <= high)
    inside = fit.a_v.where(between)
    loads = pressure.where(between)
    value = float(inside.max() / inside.min())
    full = float(fit.a_v.max() / fit.a_v.min())
    simulated = []
    for data in (fit_bem_wide_cell, fit_bem_broad_band):
        case = data.isel(window=0).sel(pressure=slice(low, high))
        ratio = case.a_v_mean.max() / case.a_v_mean.min()
        simulated.append((ratio, case.pressure[[0, -1]], describe_cell(case)))
    return Finding(
        value,
        grade(full < 1.2, value < 1.5),
        claimed=1.0,
        errors={"model": np.nan},
        made=fit,
        loads=(loads.min(), loads.max()),
        largest=pressure.max(),
        full=full,
        simulated=simulated,
    )
