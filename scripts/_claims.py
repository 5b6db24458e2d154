"""The paper's claims, one function each: the measured value against what is claimed.

Every function takes the files of the ledger as datasets by name and returns a `Claim`; none
knows a number that it could have read from a file.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
import xarray as xr

from stickiness import adhesive, criteria, datasets
from stickiness.spectrum import SelfAffine

REPRODUCED = "reproduced"
QUALIFIED = "reproduced with a qualification"
NOT = "not reproduced"
WAITING = "waiting for the adhesive solver"

Files = Mapping[str, xr.Dataset]
VARIANT = "afferrante2018"


@dataclass(frozen=True)
class Claim:
    """One row of the ledger.

    Attributes
    ----------
    number : int
        Position in the ledger.
    statement : str
        What the paper claims.
    quantity : str
        What `value` is, with its unit.
    value, uncertainty, claimed : float
        Measured value, its uncertainty (NaN where the value is exact) and the paper's value (NaN
        where it gives none).
    verdict : str
        One of the verdicts above.
    remark : str
        The qualification or the reason, with its numbers.
    sources : tuple of str
        Names of the files that the value came from.
    """

    number: int
    statement: str
    quantity: str
    value: float
    uncertainty: float
    claimed: float
    verdict: str
    remark: str
    sources: tuple[str, ...]


def graded(fully: bool, partly: bool) -> str:
    """Verdict from whether the claim holds outright or within limits that the remark states."""
    return REPRODUCED if fully else QUALIFIED if partly else NOT


def area_slope(files: Files) -> Claim:
    """Claim 1: kappa_rep is about 2, area linear in load to about 30 %."""
    k = files["kappa_128"]
    value = float(k.kappa_fit)
    error = np.hypot(k.kappa_fit_standard_error, k.kappa_fit_discretisation_error)
    low, high = (float(k.kappa.sel(pressure=k.pressure[i])) for i in ends_up_to(k, 0.3))
    drop = 1 - high / low
    areas = [float(k.area_fraction[i]) for i in ends_up_to(k, 0.3)]
    small = float(files["kappa_64"].kappa_fit)
    close = abs(value - 2) < 0.2
    return Claim(
        1,
        "kappa_rep = 2, area linear in load up to 30 %",
        "kappa_rep fitted up to 30 % area, zeta = 128",
        value,
        float(error),
        2.0,
        graded(close and drop < 0.1, close),
        f"zeta = 64: {small:.2f}. Not straight: kappa falls by {drop:.0%} from {low:.2f} at "
        f"{areas[0]:.1%} area to {high:.2f} at {areas[1]:.1%}.",
        ("kappa_128", "kappa_64"),
    )


def ends_up_to(fit: xr.Dataset, largest: float, smallest: float = 0.01) -> tuple[int, int]:
    """Indices of the first and last load whose area lies between `smallest` and `largest`."""
    inside = np.flatnonzero((fit.area_fraction >= smallest) & (fit.area_fraction <= largest))
    return int(inside[0]), int(inside[-1])


def density_converges(files: Files) -> Claim:
    """Claim 2: P(u) converges with magnification."""
    sweep = files["fig1b"].gap_density.sel(variant=VARIANT).isel(hurst=0, load=0)
    last = sweep.isel(magnification=-1)
    before = sweep.sel(magnification=1e4, method="nearest")
    change = abs(last / before - 1).where(sweep.gap <= 2)
    settled = change.gap.values[np.flatnonzero(change.values > 0.05)]
    limit = float(settled.max()) if settled.size else float(sweep.gap.min())
    zetas = float(before.magnification), float(last.magnification)
    worst = float(change.sel(gap=0.01, method="nearest"))
    return Claim(
        2,
        "P(u) at fixed mean gap converges with magnification (Figs. 1A, 1B)",
        f"u/h_rms above which P changes by < 5 % from zeta = {zetas[0]:.0e} to {zetas[1]:.0e}",
        limit,
        float(np.diff(np.log(sweep.gap.values)).mean() * limit),
        np.nan,
        graded(limit <= float(sweep.gap.min()), limit < 0.5),
        f"Converged for larger gaps only; at u/h_rms = 0.01 P still changes by {worst:.0%}.",
        ("fig1b",),
    )


def small_gap_exponent(files: Files) -> Claim:
    """Claim 3: P(u) falls as u^(-1/3) at small u."""
    exponent = files["fit_fig3a"].exponent.sel(variant=VARIANT).isel(hurst=0, load=0) - 1
    broad = exponent.isel(magnification=-1)
    at = {u: float(broad.sel(range=u, method="nearest")) for u in (1e-3, 1e-2, 1e-1)}
    spans = {
        float(z): close_to_third(exponent.sel(magnification=z)) for z in exponent.magnification
    }
    widest = max(spans, key=lambda z: np.log(spans[z][1] / spans[z][0]))
    low, high = spans[widest]
    zeta = float(broad.magnification)
    return Claim(
        3,
        "P(u) ~ u^(-1/3) at small gaps",
        f"mean exponent of P up to u/h_rms = 0.01, theory, zeta = {zeta:.0e}",
        at[1e-2],
        abs(at[1e-3] - at[1e-1]) / 2,
        -1 / 3,
        graded(max(abs(value + 1 / 3) for value in at.values()) < 0.05, high / low > 10),
        f"At zeta = {zeta:.0e} the exponent is {at[1e-3]:.2f}, {at[1e-2]:.2f}, {at[1e-1]:.2f} at "
        f"u/h_rms = 0.001, 0.01, 0.1. Within 0.05 of -1/3 at best for u/h_rms = {low:.2g} … "
        f"{high:.2g}, at zeta = {widest:.0f}.",
        ("fit_fig3a",),
    )


def close_to_third(exponent: xr.DataArray, within: float = 0.05) -> tuple[float, float]:
    """Ends of the longest unbroken range of gaps whose exponent is about -1/3."""
    close = np.abs(exponent.values + 1 / 3) < within
    edges = np.flatnonzero(np.diff(np.concatenate([[0], close.astype(int), [0]])))
    if not edges.size:
        return 1.0, 1.0
    starts, ends = edges[::2], edges[1::2] - 1
    longest = int(np.argmax(ends - starts))
    return float(exponent.range[starts[longest]]), float(exponent.range[ends[longest]])


def load_separation(files: Files) -> Claim:
    """Claim 4: p = exp(-2 mean gap/h_rms) and the range of loads that goes with it."""
    sweep = files["fig3d"].sel(variant=VARIANT).isel(hurst=0, magnification=0)
    ratio = sweep.pressure / np.exp(-2 * sweep.mean_gap)
    inside = (sweep.mean_gap >= 1) & (sweep.mean_gap <= 3)
    bem = files["ensemble_wide"]
    measured = bem.pressure * np.exp(2 * bem.mean_gap_mean)
    measured = measured.where((bem.mean_gap_mean >= 1) & (bem.mean_gap_mean <= 3), drop=True)
    theory = float(ratio.where(inside).min()), float(ratio.where(inside).max())
    first, last = float(measured[0]), float(measured[-1])
    factor = max(theory[1], 1 / theory[0], 1 / float(measured.min()))
    return Claim(
        4,
        "p/(E* q0 h_rms) = exp(-2 u/h_rms); 1 to 3 h_rms of mean gap for loads 0.1 to 0.001",
        "p exp(2 u/h_rms)/(E* q0 h_rms), theory at zeta = 1000, u = 1 to 3 h_rms",
        float(ratio.where(inside).mean()),
        float(ratio.where(inside).std()),
        1.0,
        graded(factor < 1.25, max(theory[1], 1 / theory[0]) < 1.25),
        f"Theory {theory[0]:.2f} to {theory[1]:.2f}. Simulation (zeta = 32, window of four longest "
        f"wavelengths) {last:.2f} at p = {float(measured.pressure[-1]):g} and {first:.2f} at "
        f"{float(measured.pressure[0]):g}: it leaves the exponential at small loads, where a few "
        "summits of the window carry everything.",
        ("fig3d", "ensemble_wide"),
    )


def kappa_threshold(files: Files) -> Claim:
    """Claim 5: kappa turns negative above a threshold of l_a/range."""
    a = files["adhesion_fig2"].isel(range_over_h_rms=0)
    at = a.sel(pressure=0.065, method="nearest")
    # In the DMT limit 1/kappa falls in proportion to l_a/range, from 1/kappa_rep.
    line = np.polyfit(at.adhesion_length_over_range, at.inverse_kappa, 1)
    threshold = -line[1] / line[0]
    slope = at.inverse_kappa_ad / at.adhesion_length_over_range
    relative = [
        float((at[f"{name}_standard_error"] / at[name])[0])
        for name in ("inverse_kappa", "inverse_kappa_ad")
    ]
    error = float(np.linalg.norm(relative)) * threshold
    return Claim(
        5,
        "kappa grows with l_a/range and turns negative above a threshold (Figs. 2B, 2D-I)",
        "threshold l_a/range in the DMT limit, range/h_rms = 7.5e-3, zeta = 64",
        float(threshold),
        error,
        np.nan,
        WAITING,
        f"DMT limit, q0 h_rms = {float(a.q0_h_rms):g}: 1/kappa_ad = {float(slope[0]):.3g} "
        "l_a/range; maps drawn from the repulsive gaps.",
        ("adhesion_fig2",),
    )


def area_against_range(files: Files) -> Claim:
    """Claim 6: the attractive area converges with magnification (Fig. 3A)."""
    area = files["fig3a"].attractive_area.sel(variant=VARIANT).isel(hurst=0, load=0)
    last, before = area.isel(magnification=-1), area.sel(magnification=1e4)
    change = {e: float((last / before).interp(range=e)) - 1 for e in (0.01, 0.1)}
    return Claim(
        6,
        "A_ad against (range/h_rms)^(2/3) is linear and converges with magnification (Fig. 3A)",
        "growth of A_ad at range/h_rms = 0.1 from zeta = 1e4 to 5e4",
        change[0.1],
        np.nan,
        0.0,
        graded(max(change.values()) < 0.02, change[0.1] < 0.1),
        f"Still grows by {change[0.1]:.1%} at range/h_rms = 0.1 and by {change[0.01]:.1%} at 0.01.",
        ("fig3a",),
    )


def area_against_load(files: Files) -> Claim:
    """Claim 7: the attractive area is proportional to the load (Fig. 3B)."""
    sweep = files["fig3b"].sel(variant=VARIANT).isel(hurst=0, magnification=0)
    area = sweep.attractive_area.interp(range=0.03)
    exponent = np.gradient(np.log(area), np.log(sweep.pressure.values))
    return Claim(
        7,
        "A_ad grows in proportion to the load (Fig. 3B)",
        "exponent d ln A_ad/d ln p at range/h_rms = 0.03, smallest loads",
        float(exponent[0]),
        abs(float(exponent[1] - exponent[0])),
        1.0,
        graded(abs(exponent - 1).max() < 0.1, abs(exponent[0] - 1) < 0.1),
        f"The exponent falls to {exponent[-1]:.2f} at p = {float(sweep.pressure[-1]):g}.",
        ("fig3b",),
    )


def a_v_against_magnification(files: Files) -> Claim:
    """Claim 8: a_V converges to about 3 (Fig. 3C)."""
    fit = files["fit_fig3c"].sel(variant=VARIANT).isel(load=0)
    last = fit.isel(magnification=-1).sel(hurst=0.8)
    windows = last.a_v.values
    first = fit.a_v.isel(window=0)
    decade = first.isel(magnification=-1) / first.isel(magnification=-2) - 1
    growth = ", ".join(f"{float(g):.1%} (H = {float(g.hurst):g})" for g in decade)
    narrow, wide = (
        files[name].sel(pressure=0.065, method="nearest").isel(window=0)
        for name in ("fit_bem_128", "fit_bem_wide")
    )
    value = float(windows[0])
    steady = float(abs(decade).max())
    close = abs(value - 3) < 0.5
    return Claim(
        8,
        "a_V converges to about 3 at high magnification (Fig. 3C)",
        f"a_V, theory, H = 0.8, zeta = {float(last.magnification):.0e}",
        value,
        float(np.ptp(windows)) / 2,
        3.0,
        graded(close and steady < 0.02, close or steady < 0.02),
        f"Near 3, but not converged: it still grows by {growth} over the last decade of zeta, and "
        f"the windows of the fit give {windows.min():.2f} to {windows.max():.2f}. Simulation: "
        f"{described(narrow)} at zeta = 128 on a window of one longest wavelength, "
        f"{described(wide)} at zeta = 32 on a window of four.",
        ("fit_fig3c", "fit_bem_128", "fit_bem_wide"),
    )


def described(fit: xr.Dataset) -> str:
    return f"{float(fit.a_v_mean):.2f} ± {float(fit.a_v_standard_error):.2f}"


def a_v_against_load(files: Files) -> Claim:
    """Claim 9: a_V depends weakly on the load (Fig. 3D)."""
    fit = files["fit_fig3d"].sel(variant=VARIANT).isel(hurst=0, magnification=0, window=0)
    pressure = files["fig3d"].pressure.sel(variant=VARIANT).isel(hurst=0, magnification=0)
    inside = (pressure >= 1e-3) & (pressure <= 0.1)
    value = float(fit.a_v.where(inside).max() / fit.a_v.where(inside).min())
    full = float(fit.a_v.max() / fit.a_v.min())
    bem = [files[name].isel(window=0).a_v_mean for name in ("fit_bem_wide", "fit_bem_128")]
    bem = [a_v.where((a_v.pressure >= 1e-3) & (a_v.pressure <= 0.1)) for a_v in bem]
    wide, narrow = (float(a_v.max() / a_v.min()) for a_v in bem)
    return Claim(
        9,
        "a_V depends weakly on the load (Fig. 3D)",
        "largest over smallest a_V for loads 0.001 to 0.1, theory, zeta = 1000",
        value,
        np.nan,
        1.0,
        graded(full < 1.2, value < 1.5),
        f"Up to p = 0.5 the ratio is {full:.2f}. Simulation up to 0.1: {wide:.2f} on a window of "
        f"four longest wavelengths (zeta = 32) but {narrow:.2f} on a window of one (zeta = 128), "
        "whose four longest waves are no Gaussian surface.",
        ("fit_fig3d", "fig3d", "fit_bem_wide", "fit_bem_128"),
    )


def hysteresis(files: Files) -> Claim:
    """Claim 10: loading and unloading differ (Fig. 4A)."""
    a = files["adhesion_fig2"]
    tension = float((a.pressure - a.attraction).min())
    return Claim(
        10,
        "loading-unloading loop, jump-in and pull-off at non-zero area (Fig. 4A)",
        "smallest external pressure over E* q0 h_rms in the DMT limit, range/h_rms = 7.5e-3",
        tension,
        np.nan,
        np.nan,
        WAITING,
        "The DMT limit has no hysteresis; its area-load lines are drawn.",
        ("adhesion_fig2",),
    )


def inverse_kappa_ad(files: Files) -> Claim:
    """Claim 11: 1/kappa_ad of simulation against the formula with a_V = 2.8 (Fig. 4B)."""
    ratios, errors = [], []
    for name in ("adhesion_rough", "adhesion_smooth"):
        a = files[name].sel(pressure=0.065, method="nearest").isel(adhesion_length_over_range=0)
        formula = criteria.inverse_kappa_ad(
            float(a.q0_h_rms),
            1.0,
            (a.adhesion_length_over_range * a.range_over_h_rms * a.q0_h_rms).values,
            (a.range_over_h_rms * a.q0_h_rms).values,
            2.8,
        )
        ratios += list((a.inverse_kappa_ad / formula).values)
        errors += list((a.inverse_kappa_ad_standard_error / formula).values)
    return Claim(
        11,
        "1/kappa_ad follows the formula with a_V = 2.8 over six decades (Fig. 4B)",
        "mean of DMT simulation over formula, eight parameter sets, p = 0.065",
        float(np.mean(ratios)),
        float(np.mean(errors)),
        1.0,
        WAITING,
        f"DMT limit: ratios from {min(ratios):.2f} to {max(ratios):.2f}; the six decades come "
        "from l_a/range, in which the limit is linear.",
        ("adhesion_rough", "adhesion_smooth"),
    )


def slope_angle(files: Files) -> Claim:
    """Claim 12: the map with the JTB line and the slope angles (Fig. 5)."""
    m = files["map"].sortby("slope_parameter")
    crossing = []
    for parameter in m.slope_parameter.values:
        angle = m.slope_angle.sel(slope_parameter=parameter)
        crossing.append(float(np.interp(-90, -angle.values, m.h_rms_over_range.values)))
    expected = criteria.h_rms_limit(m.slope_parameter.values, 1.0, 1.0, 3.0)
    worst = float(np.max(np.abs(np.array(crossing) / expected - 1)))
    return Claim(
        12,
        "map of stickiness with the JTB line; slope angles through 90° at a_V = 3 (Fig. 5)",
        "h_rms/range at 90° for range q0/(l_a/range) = 1",
        crossing[-1],
        np.nan,
        float(expected[-1]),
        graded(worst < 0.01, worst < 0.05),
        "Crossings for 1/10 … 1: "
        + ", ".join(f"{c:.2f}" for c in crossing)
        + f", within {worst:.1g} of the closed form.",
        ("map",),
    )


def roughness_limits(files: Files) -> Claim:
    """Claim 13: largest h_rms/range at range q0 = 1e-6, 1e-9, 1e-12 for l_a/range = 0.05."""
    q0 = np.array([1e-6, 1e-9, 1e-12])
    printed = criteria.h_rms_limit(q0, 0.05, 1.0, criteria.PRINTED_A_V)
    a_v = float(files["map"].a_v)
    derived = criteria.h_rms_limit(q0, 0.05, 1.0, a_v)
    low, high = (
        criteria.h_rms_limit(1e-9, 0.05, 1.0, float(end))
        for end in (files["map"].a_v_low, files["map"].a_v_high)
    )
    jtb = criteria.jtb_limit(q0, 0.05, 1.0)
    return Claim(
        13,
        "h_rms/range up to 1000, 67000, 1e6 at range q0 = 1e-6, 1e-9, 1e-12, l_a/range = 0.05",
        "h_rms/range at range q0 = 1e-9 by the printed coefficient 9/4",
        float(printed[1]),
        np.nan,
        67000.0,
        graded(False, abs(printed[1] / 67000 - 1) < 0.02),
        f"By 9/4: {printed[0]:.3g}, {printed[1]:.3g}, {printed[2]:.3g} (the last is not 1e6). With "
        f"a_V = {a_v:.2f} as measured: {derived[0]:.3g}, {derived[1]:.3g}, {derived[2]:.3g} "
        f"({low / derived[1] - 1:+.0%}, {high / derived[1] - 1:+.0%}). All "
        "below the roughness from which the DMT limit holds (JTB): "
        f"{jtb[0]:.3g}, {jtb[1]:.3g}, {jtb[2]:.3g}.",
        ("map",),
    )


def real_surfaces(files: Files) -> Claim:
    """Claim 14: real spectra lie under the lines, and the modulus threshold on asphalt."""
    rough = files["asphalt"].sel(end="rough")
    q0, c0 = float(rough.q0), float(rough.C0)
    h_rms = np.sqrt(np.pi * c0 / float(rough.hurst)) * q0 ** -float(rough.hurst)
    printed = criteria.modulus_threshold(h_rms, q0, 0.05, 0.2e-9, criteria.PRINTED_A_V) / 1e6
    validity = criteria.dmt_validity(h_rms, q0, 0.05 / (printed * 1e6), 0.2e-9)
    a_v = [float(files["map"][name]) for name in ("a_v", "a_v_low", "a_v_high")]
    derived = [criteria.modulus_threshold(h_rms, q0, 0.05, 0.2e-9, a) / 1e6 for a in a_v]
    above = [
        datasets.parameters(surface)["label"]
        for name, surface in files.items()
        if name.startswith("surface:") and float(surface.C0_reference_upper.max()) > 1.001e-3
    ]
    return Claim(
        14,
        "real spectra lie under C0 = 1e-3 m^0.4; asphalt sticks below E* = 0.2 MPa (Fig. 6)",
        "E* threshold on asphalt [MPa], range 0.2 nm, 50 mJ/m^2, by the printed coefficient 9/4",
        float(printed),
        np.nan,
        0.2,
        graded(abs(printed / 0.2 - 1) < 0.1 and not above, abs(printed / 0.2 - 1) < 0.2),
        f"With a_V = {a_v[0]:.2f} as measured: {derived[0]:.3g} MPa ({derived[1]:.3g} to "
        f"{derived[2]:.3g}). Above the line: "
        f"{', '.join(above) or 'none of the surfaces'}. Dahlquist's 1 MPa is of the same order. At "
        f"the threshold h_rms is {validity.margin:.1g} of what the DMT limit asks (JTB).",
        ("surfaces", "map"),
    )


def polished_steel(files: Files) -> Claim:
    """Claim 15: q0 h_rms is about 0.1 for polished steel and the JTB condition holds."""
    steel = files["polished_steel"].sel(end="rough")
    h, q0 = float(steel.h_rms), float(steel.q0)
    range_ = 0.2e-9
    validity = criteria.dmt_validity(h, q0, 0.05 * range_, range_)
    return Claim(
        15,
        "polished steel, L = 0.1 mm, h_rms = 1 µm: q0 h_rms = 0.1 and the JTB condition holds",
        "q0 h_rms",
        q0 * h,
        np.nan,
        0.1,
        graded(abs(q0 * h / 0.1 - 1) < 0.1 and validity.valid, validity.valid),
        f"2π h_rms/L = {q0 * h:.3f}; h_rms exceeds the JTB limit {validity.margin:.3g} times at "
        "l_a/range = 0.05, range = 0.2 nm.",
        ("polished_steel",),
    )


def crystal_strength(files: Files) -> Claim:
    """Claim 16: theoretical strength, sigma0 = (9 sqrt3/16) sigma_th, l_a = 0.05 range."""
    law = adhesive.LennardJones(adhesion_length=1.0, range=1.0)
    gaps = np.linspace(0, 2, 200001)
    strength = float(law.traction(gaps).max())
    ratio = law.maugis_stress / strength
    # sigma_th about E*/20 makes l_a/range = sigma0/E* = ratio/20.
    return Claim(
        16,
        "sigma0 = (9√3/16) sigma_th, and l_a = 0.05 range for a crystal on itself",
        "sigma0/sigma_th of the Lennard-Jones law, by its numerical maximum",
        float(ratio),
        float(gaps[1]),
        9 * np.sqrt(3) / 16,
        graded(abs(ratio / (9 * np.sqrt(3) / 16) - 1) < 1e-6, False),
        f"With sigma_th = E*/20, l_a/range = {ratio / 20:.4f}.",
        (),
    )


def pastewka_robbins(files: Files) -> Claim:
    """Claim 17: by Pastewka and Robbins all surfaces with D < 2.4 stick in the fractal limit."""
    hursts = np.array([0.5, 0.6, 0.7, 0.8])
    errors = [pr_exponent(hurst) - (5 * hurst - 3) / 3 for hurst in hursts]
    worst = float(np.abs(errors).max())
    return Claim(
        17,
        "Pastewka-Robbins: a_V,PR ~ zeta^((5H-3)/3), sticky for D < 2.4; constant close to 1",
        "largest error of the exponent (5H-3)/3 at zeta = 1e12, spectra with H = 0.5 to 0.8",
        worst,
        np.nan,
        0.0,
        graded(worst < 1e-3, worst < 0.05),
        f"The exponent vanishes at H = 0.6, D = 2.4; π(3/16)^(2/3) = {criteria.PR_CONSTANT:.3f}. "
        "The nearer H is to 1, the later the limit is reached.",
        (),
    )


def pr_exponent(hurst: float, magnification: float = 1e12) -> float:
    """Exponent d ln a_V,PR/d ln zeta from the exact moments of two power-law spectra."""
    pair = [
        SelfAffine(hurst=hurst, q0=1.0, q1=zeta, h_rms=1.0)
        for zeta in (magnification, 10 * magnification)
    ]
    a_v = [criteria.pastewka_robbins_a_v(1.0, 1.0, s.rms_slope, s.rms_curvature) for s in pair]
    return float(np.log10(a_v[1] / a_v[0]))


def spectral_moments(files: Files) -> Claim:
    """Claim 18: relations between moments on generated surfaces."""
    surfaces = [data for name, data in files.items() if name.startswith("seed:")]
    ratios = np.array([[3 * float(s.m22 / s.m40), 3 * float(s.m22 / s.m04)] for s in surfaces])
    mean, error = ratios.mean(), ratios.mean(axis=1).std(ddof=1) / np.sqrt(len(surfaces))
    lattice = surfaces[0].sel(source="lattice")
    heights = [s.sel(source="heights") for s in surfaces]
    slope = np.mean([float(s.rms_slope / lattice.rms_slope) for s in heights])
    return Claim(
        18,
        "3 m22 = m40 = m04, h'_rms = √(2 m2), h''_rms = √(8 m4/3) on generated surfaces",
        f"3 m22/m40, mean over {len(surfaces)} surfaces, H = 0.8, zeta = 64",
        float(mean),
        float(error),
        1.0,
        graded(abs(mean - 1) < max(3 * error, 0.005), abs(mean - 1) < 0.05),
        f"Mean rms slope of the heights over that of the lattice spectrum: {slope:.3f} (each "
        "surface is scaled to h_rms, so the slope scatters with the longest waves).",
        ("seeds",),
    )


CLAIMS: tuple[Callable[[Files], Claim], ...] = (
    area_slope,
    density_converges,
    small_gap_exponent,
    load_separation,
    kappa_threshold,
    area_against_range,
    area_against_load,
    a_v_against_magnification,
    a_v_against_load,
    hysteresis,
    inverse_kappa_ad,
    slope_angle,
    roughness_limits,
    real_surfaces,
    polished_steel,
    crystal_strength,
    pastewka_robbins,
    spectral_moments,
)
