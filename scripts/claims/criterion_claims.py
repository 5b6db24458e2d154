"""Claims on the criterion and its predictions for real surfaces, and on spectral moments."""

import numpy as np

from claims.ledger import Finding, claim, describe_cell, grade
from common.model_surfaces import cell_size, model_spectrum
from stickiness import adhesive, criteria, datasets
from stickiness import surface as synthesis
from stickiness.criteria import equivalent_sphere
from stickiness.criteria.formulas import JTB_CONSTANT
from stickiness.spectrum.kinds import SelfAffine
from stickiness.statistics import students_t

# Numbers of the paper's examples.
RANGE, WORK_OF_ADHESION = 0.2e-9, 0.05  # m, J/m^2
CRYSTAL = 0.05  # l_a/range
EXAMPLES = np.array([1e-6, 1e-9, 1e-12])  # range q0
PRINTED_LIMITS = np.array([1000.0, 67000.0, 1e6])  # h_rms/range of these
PRINTED_MODULUS = 0.2  # MPa, of a block that sticks to asphalt
UPPER_LINE = 1e-3  # m^0.4, C0 of the line above real surfaces


@claim(12, "map")
def slope_angle(files):
    m = files["map"].sortby("slope_parameter")
    a_v = datasets.parameters(m)["slope_a_v"]
    crossing = []
    for parameter in m.slope_parameter.values:
        angle = m.slope_angle.sel(slope_parameter=parameter)
        crossing.append(float(np.interp(-90, -angle.values, m.h_rms_over_range.values)))
    expected = criteria.h_rms_limit(m.slope_parameter.values, 1.0, 1.0, a_v)
    worst = float(np.max(np.abs(np.array(crossing) / expected - 1)))
    found = m.h_rms_limit_edges.notnull()
    ratio = m.h_rms_limit / m.h_rms_limit_edges
    return Finding(
        value=crossing[-1],
        claimed=float(expected[-1]),
        verdict=grade(False, worst < 0.01),
        errors={"discretisation": worst * crossing[-1]},
        facts={
            "parameter": m.slope_parameter[-1],
            "worst": worst,
            "a_v": a_v,
            "largest_dmt": largest_dmt(a_v),
            "shortest": datasets.parameters(m)["shortest_over_range"],
            "weak": (m.h_rms_limit_edges > m.weak_limit).where(found).mean(),
            "dmt_ratio": (ratio.min(), ratio.max()),
        },
    )


def largest_dmt(a_v):
    """Largest h_rms/range that is sticky and within the DMT range, whatever the materials."""
    # The threshold (3/2 a_V x)^(3/5), x = (l_a/range)/(range q0), meets the JTB line (4/75) x.
    return (1.5 * a_v / JTB_CONSTANT) ** 1.5


@claim(13, "map")
def roughness_limits(files):
    a_v, low, high = measured_a_v(files["map"])
    printed, derived, low, high = (
        criteria.h_rms_limit(EXAMPLES, CRYSTAL, 1.0, value)
        for value in (criteria.PRINTED_A_V, a_v, low, high)
    )
    close = np.abs(printed / PRINTED_LIMITS - 1) < 0.1
    return Finding(
        value=float(printed[1]),
        claimed=PRINTED_LIMITS[1],
        verdict=grade(bool(close.all()), bool(close[:2].all())),
        facts={
            "printed": printed,
            "a_v": a_v,
            "derived": derived,
            "errors": [low[1] / derived[1] - 1, high[1] / derived[1] - 1],
        },
    )


def measured_a_v(m):
    """a_V of the derived criterion with its low and high end."""
    return tuple(float(m[name]) for name in ("a_v", "a_v_low", "a_v_high"))


@claim(14, "asphalt", "map", "measured_surfaces")
def real_surfaces(files):
    # Rms height of the example, by the power law down to no cutoff.
    rough = files["asphalt"].sel(end="rough")
    q0, c0, hurst = float(rough.q0), float(rough.C0), float(rough.hurst)
    h_rms = float(np.sqrt(np.pi * c0 / hurst) * q0**-hurst)
    a_v = measured_a_v(files["map"])
    printed, derived, low, high = (
        criteria.modulus_threshold(h_rms, q0, WORK_OF_ADHESION, RANGE, value) / 1e6
        for value in (criteria.PRINTED_A_V, *a_v)
    )
    # Only measured spectra can test the line, not parameters that somebody assumed.
    measured = files["measured_surfaces"]
    heights = [float(data.C0_reference_upper.max()) / UPPER_LINE for data in measured]
    under = [float(data.C0_reference_upper.max()) <= UPPER_LINE for data in measured]
    close = abs(printed / PRINTED_MODULUS - 1) < 0.1
    return Finding(
        value=printed,
        claimed=PRINTED_MODULUS,
        verdict=grade(close and bool(under) and all(under), close),
        facts={
            "a_v": a_v[0],
            "derived": (derived, low, high),
            "measured": [
                (datasets.parameters(data)["label"], height)
                for data, height in zip(measured, heights, strict=True)
            ],
        },
    )


@claim(15, "verdicts", "polished_steel")
def polished_steel(files):
    steel, verdicts = files["polished_steel"].sel(end="rough"), files["verdicts"]
    h, q0 = float(steel.h_rms), float(steel.q0)
    margin = verdicts.jtb_margin.sel(surface="polished_steel", end="rough").sortby("material")
    satisfied = bool((margin > 1).all())
    margins = list(zip(margin.material.values, margin.values, strict=True))
    return Finding(
        value=float(margin.min()),
        verdict=grade(satisfied and abs(q0 * h / 0.1 - 1) < 0.1, satisfied),
        facts={
            "slope": q0 * h,
            "crystal": h / criteria.jtb_limit(q0, CRYSTAL * RANGE, RANGE),
            "ratio": CRYSTAL,
            "range": RANGE,
            "within": [pair for pair in margins if pair[1] > 1],
            "outside": [pair for pair in margins if pair[1] <= 1],
        },
    )


@claim(16)
def crystal_strength(files):
    law = adhesive.LennardJones(adhesion_length=1.0, range=1.0)
    gaps = np.linspace(0, 2, 200001)
    strength = float(law.traction(gaps).max())
    ratio = law.maugis_stress / strength
    return Finding(
        value=float(ratio),
        claimed=9 * np.sqrt(3) / 16,
        verdict=grade(abs(ratio / (9 * np.sqrt(3) / 16) - 1) < 1e-6, False),
        errors={"discretisation": float(gaps[1])},
        # sigma_th is about E*/20, so that l_a/range = sigma0/E* = ratio/20.
        facts={"length": ratio / 20},
    )


@claim(17)
def pastewka_robbins(files):
    hursts = np.array([0.5, 0.6, 0.7, 0.8])
    errors = [fractal_exponent(h, pastewka_robbins_a_v) - (5 * h - 3) / 3 for h in hursts]
    tough = [fractal_exponent(h, threshold_by_moments) - (1 - 2 * h) for h in hursts]
    worst = float(np.abs(errors).max())
    return Finding(
        value=worst,
        claimed=0.0,
        verdict=grade(worst < 1e-3, worst < 0.05),
        facts={"constant": criteria.PR_CONSTANT, "tough": np.abs(tough).max()},
    )


def fractal_exponent(hurst, quantity):
    """Exponent of a quantity in zeta, from two broad power-law spectra with exact moments."""
    low, high = (
        quantity(SelfAffine(hurst=hurst, q0=1.0, q1=zeta, h_rms=1.0)) for zeta in (1e12, 1e13)
    )
    return float(np.log10(high / low))


def pastewka_robbins_a_v(s):
    return criteria.pastewka_robbins_a_v(s.q0, s.h_rms, s.rms_slope, s.rms_curvature)


def threshold_by_moments(s, range_=1e-30):
    """Threshold in l_a with Pastewka and Robbins' a_V; at the default range edges are tough."""
    return equivalent_sphere.adhesion_length_threshold(
        s.h_rms, s.q0, s.rms_slope, range_, pastewka_robbins_a_v(s)
    )


@claim(18, "seeds")
def spectral_moments(files):
    surfaces = [data.sel(seed=seed) for data in files["seeds"] for seed in data.seed]
    ratios = np.array(
        [moment_ratios(data.height.values, float(data.window_length)) for data in surfaces]
    )
    expected = moment_ratios(*fixed_amplitudes(surfaces[0]))
    # From the scatter of the single ratios, since a few means of x and y may happen to lie close.
    single = np.sqrt(ratios.var(axis=0, ddof=1).mean(axis=1, keepdims=True) / len(surfaces))
    off = np.abs(ratios.mean(axis=0) - expected)  # x and y apart: a lay does not cancel
    # x and y are nearly independent for 3 m22/m4; for the others this overstates the error.
    error = single[:, 0] / np.sqrt(2)
    mean, expected = ratios.mean(axis=(0, 2)), expected.mean(axis=1)
    return Finding(
        value=float(mean[0]),
        claimed=float(expected[0]),
        verdict=grade(bool(np.all(off < 3 * single)), bool(np.all(off < 0.05))),
        errors={"sampling": students_t(len(surfaces)) * float(error[0])},
        facts={
            "surfaces": len(surfaces),
            "hurst": datasets.parameters(surfaces[0])["hurst"],
            "cell": describe_cell(surfaces[0]),
            "mean": mean,
            "error": error,
            "lattice": expected,
        },
    )


def moment_ratios(heights, length):
    """Ratios that are 1 on an isotropic surface, in rows; columns along x and y."""
    m = synthesis.moments(heights, length)
    m2, m4 = np.array([m.m20, m.m02]), np.array([m.m40, m.m04])
    return np.array(
        [3 * m.m22 / m4, m.rms_slope / np.sqrt(2 * m2), m.rms_curvature / np.sqrt(8 * m4 / 3)]
    )


def fixed_amplitudes(data):
    """Surface whose modes have exactly the variances expected of those of `data`."""
    surface = datasets.parameters(data)
    length = cell_size(surface)
    return synthesis.synthesise(
        model_spectrum(surface), data.sizes["x"], length, 1, "fixed"
    ), length
