"""Claims on the criterion and on what sticks: formulas, real surfaces, experiments, moments.

Claims from 19 on compare with the adhesion that remains.
"""

import numpy as np
import pandas as pd
from scipy.optimize import brentq

from claims.ledger import NOT, OPEN, QUALIFIED, REPRODUCED, Finding, claim, describe_cell, grade
from common.experiment_outcomes import COMPATIBLE, GRADES, MISSED, SILENT, SOME, describe
from common.model_surfaces import cell_size, model_spectrum
from common.paper import (
    C0_LINES,
    CRYSTAL,
    H_RMS_LIMITS,
    HURST,
    PRINTED_MODULUS,
    RANGE,
    WORK_OF_ADHESION,
)
from stickiness import adhesive, criteria, datasets
from stickiness import surface as synthesis
from stickiness.criteria import equivalent_sphere
from stickiness.criteria.formulas import JTB_CONSTANT
from stickiness.remaining.roughness import Roughness
from stickiness.remaining.trial_states import DEFAULT_SHARE
from stickiness.spectrum.kinds import SelfAffine
from stickiness.statistics import students_t

EXAMPLES = np.array([*H_RMS_LIMITS])  # range q0
PRINTED_LIMITS = np.array([*H_RMS_LIMITS.values()])  # h_rms/range of these
ANY_SHARE = 0.01  # that stands for any tension at all, which the paper means by sticking
SIGNS = 0, -1, 1  # value, low and high limit


@claim(12)
def slope_angle(map):
    """The area-load line turns vertical at the limit of stickiness."""
    sorted_map = map.sortby("slope_parameter")
    parameters = datasets.parameters(map)
    a_v = parameters["slope_a_v"]
    roughness = sorted_map.h_rms_over_range.values
    angles = sorted_map.slope_angle.transpose("slope_parameter", ...).values
    crossing = np.array([np.interp(-90, -angle, roughness) for angle in angles])
    expected = criteria.h_rms_threshold(sorted_map.slope_parameter.values, 1.0, 1.0, a_v)
    worst = float(np.max(np.abs(crossing / expected - 1)))
    by_edges = sorted_map.h_rms_threshold_edges.sel(limit="value")
    ratio = sorted_map.h_rms_threshold.sel(limit="value") / by_edges
    weak = by_edges > sorted_map.weak_limit
    return Finding(
        crossing[-1],
        grade(False, worst < 0.01),
        claimed=expected[-1],
        errors={"discretisation": worst * crossing[-1]},
        hurst=parameters["hurst"],
        parameter=sorted_map.slope_parameter[-1],
        worst=worst,
        a_v=a_v,
        largest_dmt=largest_dmt(a_v),
        shortest=parameters["shortest_over_range"],
        weak=weak.where(by_edges.notnull()).mean(),
        dmt_ratio=(ratio.min(), ratio.max()),
    )


def largest_dmt(a_v):
    """Largest h_rms/range that is sticky and within the DMT range, whatever the materials."""
    # The threshold (3/2 a_V x)^(3/5), x = (l_a/range)/(range q0), meets the JTB line (4/75) x.
    return (1.5 * a_v / JTB_CONSTANT) ** 1.5


@claim(13)
def roughness_limits(map):
    """Largest sticky roughness of the paper's examples."""
    limits = [criteria.h_rms_threshold(EXAMPLES, CRYSTAL, 1.0, a_v) for a_v in list_a_v(map)]
    printed, derived, low, high = limits
    close = np.abs(printed / PRINTED_LIMITS - 1) < 0.1
    return Finding(
        printed[1],
        grade(bool(close.all()), bool(close[:2].all())),
        claimed=PRINTED_LIMITS[1],
        printed=printed,
        a_v=map.a_v,
        derived=derived,
        changes=[limit[1] / derived[1] - 1 for limit in (low, high)],
    )


def list_a_v(map):
    """a_V of the printed criterion, and of the derived one with its low and high end."""
    a_v = float(map.a_v)
    error = float(map.a_v_total_error)
    return criteria.PRINTED_A_V, a_v, a_v - error, a_v + error


@claim(14)
def real_surfaces(asphalt, map, measured_surfaces, verdicts):
    """Moduli below which solids stick to real surfaces."""
    # Rms height of the example, by the power law down to no cutoff.
    rough = asphalt.sel(end="rough")
    q0 = float(rough.q0)
    c0 = float(rough.C0)
    hurst = float(rough.hurst)
    h_rms = float(np.sqrt(np.pi * c0 / hurst) * q0**-hurst)
    printed, *derived = (
        criteria.modulus_threshold(h_rms, q0, WORK_OF_ADHESION, RANGE, a_v) / 1e6
        for a_v in list_a_v(map)
    )
    upper_line = C0_LINES[0]
    # Only measured spectra can test the line, not parameters that somebody assumed.
    read = [data for data in measured_surfaces if "unread" not in data.attrs]
    heights = [float(data.C0_reference_upper.max()) / upper_line for data in read]
    names = [datasets.parameters(data)["surface"] for data in read]
    labels = [datasets.parameters(verdicts)["labels"][name] for name in names]
    close = abs(printed / PRINTED_MODULUS - 1) < 0.1
    return Finding(
        printed,
        grade(close, False),  # of the arithmetic alone
        claimed=PRINTED_MODULUS,
        line=grade(max(heights) <= 1, False) if heights else OPEN,
        rough=rough,
        a_v=map.a_v,
        derived=derived,
        measured=list(zip(labels, heights, strict=True)),
    )


@claim(15)
def polished_steel(verdicts, polished_steel):
    """Polished steel satisfies the condition for the DMT limit with all materials."""
    steel = polished_steel.sel(end="rough")
    h = float(steel.h_rms)
    q0 = float(steel.q0)
    margin = verdicts.jtb_margin.sel(surface="polished_steel", end="rough").sortby("material")
    satisfied = bool((margin > 1).all())
    margins = list(zip(margin.material.values, margin.values, strict=True))
    return Finding(
        margin.min(),
        grade(satisfied and abs(q0 * h / 0.1 - 1) < 0.1, satisfied),
        slope=q0 * h,
        crystal=h / criteria.jtb_limit(q0, CRYSTAL * RANGE, RANGE),
        ratio=CRYSTAL,
        range=RANGE,
        within=[pair for pair in margins if pair[1] > 1],
        outside=[pair for pair in margins if pair[1] <= 1],
    )


@claim(16)
def crystal_strength():
    """The adhesion length of a crystal on itself is a twentieth of the range."""
    law = adhesive.LennardJones(adhesion_length=1.0, range=1.0)
    gaps = np.linspace(0, 2, 200001)
    expected = 9 * np.sqrt(3) / 16
    ratio = law.maugis_stress / float(law.traction(gaps).max())
    return Finding(
        ratio,
        grade(abs(ratio / expected - 1) < 1e-6, False),
        claimed=expected,
        errors={"discretisation": float(gaps[1])},
        length=ratio / 20,  # l_a/range = sigma0/E*, since sigma_th is about E*/20
    )


@claim(17)
def pastewka_robbins():
    """Exponents of Pastewka and Robbins' criterion on fractal surfaces."""
    hursts = np.array([0.5, 0.6, 0.7, 0.8])
    errors = [fractal_exponent(h, pastewka_robbins_a_v) - (5 * h - 3) / 3 for h in hursts]
    tough = [fractal_exponent(h, threshold_by_moments) - (1 - 2 * h) for h in hursts]
    worst = float(np.abs(errors).max())
    return Finding(
        worst,
        grade(worst < 1e-3, worst < 0.05),
        claimed=0.0,
        constant=criteria.PR_CONSTANT,
        tough=np.abs(tough).max(),
    )


def fractal_exponent(hurst, quantity):
    """Exponent of a quantity in zeta, from two broad power-law spectra with exact moments."""
    low = quantity(SelfAffine(hurst=hurst, q0=1.0, q1=1e12, h_rms=1.0))
    high = quantity(SelfAffine(hurst=hurst, q0=1.0, q1=1e13, h_rms=1.0))
    return float(np.log10(high / low))


def pastewka_robbins_a_v(s):
    """a_V of a spectrum by Pastewka and Robbins' attractive area."""
    return criteria.pastewka_robbins_a_v(s.q0, s.h_rms, s.rms_slope, s.rms_curvature)


def threshold_by_moments(s, range_=1e-30):
    """Threshold in l_a with Pastewka and Robbins' a_V; at the default range edges are tough."""
    return equivalent_sphere.adhesion_length_threshold(
        s.h_rms, s.q0, s.rms_slope, range_, pastewka_robbins_a_v(s)
    )


@claim(18)
def spectral_moments(seeds, kappa_middle_band):
    """Moments of isotropic surfaces."""
    # Files may hold more surfaces than the case wants.
    wanted = datasets.parameters(kappa_middle_band)["seeds"]
    surfaces = [data.sel(seed=seed) for data in seeds for seed in data.seed if seed in wanted]
    ratios = np.array(
        [moment_ratios(data.height.values, float(data.window_length)) for data in surfaces]
    )
    expected = moment_ratios(*fixed_amplitudes(surfaces[0]))
    # From the scatter of the single ratios, since a few means of x and y may happen to lie close.
    single = np.sqrt(ratios.var(axis=0, ddof=1).mean(axis=1, keepdims=True) / len(surfaces))
    off = np.abs(ratios.mean(axis=0) - expected)  # x and y apart: a lay does not cancel
    # x and y are nearly independent for 3 m22/m4; for the others this overstates the error.
    error = single[:, 0] / np.sqrt(2)
    mean = ratios.mean(axis=(0, 2))
    lattice = expected.mean(axis=1)
    return Finding(
        mean[0],
        grade(bool(np.all(off < 3 * single)), bool(np.all(off < 0.05))),
        claimed=lattice[0],
        errors={"sampling": students_t(len(surfaces)) * float(error[0])},
        surfaces=len(surfaces),
        cell=describe_cell(surfaces[0]),
        mean=mean,
        error=error,
        lattice=lattice,
    )


def moment_ratios(heights, length):
    """Ratios of moments that are 1 on an isotropic surface, in rows; columns along x and y."""
    m = synthesis.moments(heights, length)
    m2 = np.array([m.m20, m.m02])
    m4 = np.array([m.m40, m.m04])
    return np.array(
        [3 * m.m22 / m4, m.rms_slope / np.sqrt(2 * m2), m.rms_curvature / np.sqrt(8 * m4 / 3)]
    )


def fixed_amplitudes(data):
    """Surface whose modes have exactly the variances expected of those of `data`, and its side."""
    surface = datasets.parameters(data)
    n = data.sizes["x"]
    length = cell_size(surface)
    return synthesis.synthesise(model_spectrum(surface), n, length, 1, "fixed"), length


@claim(19)
def sticky_roughness(map):
    """The paper's limits of roughness against the adhesion that remains."""
    shortest = datasets.parameters(map)["shortest_over_range"]
    value, low, high = find_limits(shortest, DEFAULT_SHARE)
    some, some_low, some_high = find_limits(shortest, ANY_SHARE)
    inside = (low <= PRINTED_LIMITS) & (some_high >= PRINTED_LIMITS)
    return Finding(
        value[1],
        grade(False, bool(inside.all())),
        claimed=PRINTED_LIMITS[1],
        errors={"model": float(max(high[1] - value[1], value[1] - low[1]))},
        wanted=(DEFAULT_SHARE, ANY_SHARE),
        hurst=HURST,
        shortest=shortest,
        limits=[(value, low, high), (some, some_low, some_high)],
        times=[PRINTED_LIMITS / value, PRINTED_LIMITS / some],
        jtb=criteria.jtb_limit(EXAMPLES, CRYSTAL, 1.0),
    )


def find_limits(shortest, share):
    """Values, low and high limits of h_rms/range at which a share remains, in all examples."""
    return np.array(
        [[find_roughness(q0, shortest, share, sign) for q0 in EXAMPLES] for sign in SIGNS]
    )


def find_roughness(range_times_q0, shortest, share, sign):
    """h_rms/range at which a share, or its low or high limit by `sign`, just remains."""
    q1 = 2 * np.pi / shortest
    unit = SelfAffine(hurst=HURST, q0=range_times_q0, q1=q1, h_rms=1.0).elastic_energy()

    def excess(log_h):
        h = np.exp(log_h)
        rough = Roughness(h_rms=h, q0=range_times_q0, elastic_energy=unit * h**2, q1=q1, eta=sign)
        return float(np.log(rough.threshold(1.0, share) / CRYSTAL))

    return float(np.exp(brentq(excess, np.log(2.0), np.log(1e9))))


@claim(20)
def sticky_asphalt(asphalt):
    """The paper's modulus on asphalt against the adhesion that remains."""
    rough = asphalt.sel(end="rough")
    smooth = asphalt.sel(end="smooth")
    value, low, high = (find_modulus(rough, DEFAULT_SHARE, sign) for sign in SIGNS)
    limits = low, find_modulus(smooth, ANY_SHARE, 1)
    inside = limits[0] <= PRINTED_MODULUS <= limits[1]
    length = WORK_OF_ADHESION / (PRINTED_MODULUS * 1e6)
    return Finding(
        value,
        OPEN if inside else NOT,
        claimed=PRINTED_MODULUS,
        errors={"model": max(value - low, high - value)},
        wanted=(DEFAULT_SHARE, ANY_SHARE),
        rough=rough,
        c0=[rough.C0, smooth.C0],
        some=find_modulus(rough, ANY_SHARE, 0),
        smooth=[find_modulus(smooth, share, 0) for share in (DEFAULT_SHARE, ANY_SHARE)],
        limits=limits,
        inside=inside,
        jtb=float(rough.h_rms) / criteria.jtb_limit(float(rough.q0), length, RANGE),
    )


def find_modulus(surface, share, sign):
    """Modulus [MPa] below which a share of the paper's example remains on a surface."""
    names = ("h_rms", "q0", "elastic_energy", "q1")
    rough = Roughness(**{name: float(surface[name]) for name in names}, eta=sign)
    return float(WORK_OF_ADHESION / rough.threshold(RANGE, share) / 1e6)


@claim(21)
def truncation(remaining):
    """Finer waves do not change the adhesion."""
    smooth, equal = follow_magnification(remaining, hurst=0.8)
    rough, _ = follow_magnification(remaining, hurst=0.5)
    number = smooth.count()
    finest = number[number == number.iloc[1:].max()].index[-1]  # of those that most surfaces have
    (before, last) = smooth.columns[-2:]
    ends = smooth.iloc[:, -2:].dropna().mean()
    # Change that the last step would make over a factor of ten in magnification.
    late = float((ends[last] / ends[before]) ** (1 / np.log10(last / before))) - 1
    ratios = smooth[finest].dropna()
    changed = [abs(1 - of.mean()).max() for of in (smooth, rough)]
    scatter = students_t(ratios.size) * ratios.std() / np.sqrt(ratios.size)
    negligible = 0.1  # relative change of the remaining share that does not count
    return Finding(
        ratios.mean(),
        # The paper means broader spectra than any that were simulated.
        REPRODUCED if max(changed) < negligible else OPEN,
        claimed=1.0,
        errors={"sampling": float(scatter)},
        coarse=smooth.columns[0],
        fine=finest,
        rough=(rough.columns[-1], rough.mean().iloc[-1]),
        surfaces=len(smooth) + len(rough),
        steps=(before, last),
        late=late,
        equal=list(equal.items()),
    )


def follow_magnification(table, hurst):
    """Follow how finer waves change the adhesion of the same long waves, by magnification.

    The energy gained at the work of adhesion that equals the energy of full contact with the fewest
    waves, over that with these, by surface; and the mean share where both energies are equal.
    """
    # The narrowest cohesive zone that was followed over the most magnifications.
    rows = table[(table.hurst == hurst) & (table.window == 2)]
    followed = rows.groupby("zone").magnification.nunique()
    rows = rows[rows.zone == followed[followed == followed.max()].index.min()]
    coarse = rows[rows.magnification == rows.magnification.min()]
    works = coarse.groupby("seed").full_contact_energy.first()
    rows = rows[rows.seed.isin(works.index)].sort_values("adhesion_length")
    at_one_work = {}
    at_equal_energies = {}
    for (seed, magnification), states in rows.groupby(["seed", "magnification"]):
        key = seed, magnification
        at_one_work[key] = interpolate_bound(states, works[seed])
        at_equal_energies[key] = interpolate_bound(states, states.full_contact_energy.iloc[0])
    at_one_work = pd.Series(at_one_work).unstack()
    equal = pd.Series(at_equal_energies).unstack()
    return at_one_work.div(at_one_work.iloc[:, 0], axis=0), equal.dropna().mean()


def interpolate_bound(states, work):
    """Share that is gained at a work of adhesion between those simulated; NaN beyond them."""
    return np.interp(work, states.adhesion_length, states.bound, left=np.nan, right=np.nan)


@claim(22)
def stickiness_of_experiments(experiments):
    """The paper's criterion against published experiments."""
    cases = describe(experiments)["cases"]
    names = [f"{case['experiment']} ({case['case']})" for case in cases]
    rubber_case = "fuller_tabor/one_MPa"
    position = experiments.case.values.tolist().index(rubber_case)
    rubber = experiments.sel(case=rubber_case)
    read = (experiments.tests == 1) & (experiments.observed_known == GRADES.index("read"))
    paper = "violano"  # the paper's criterion
    codes = experiments.criterion_outcome.sel(criterion=paper).where(read, SILENT)
    by_outcome = {
        code: [name for name, outcome in zip(names, codes.values, strict=True) if outcome == code]
        for code in (MISSED, SOME, COMPATIBLE)
    }
    # The worst outcome among the observations that were read from a publication.
    verdicts = {MISSED: NOT, SOME: QUALIFIED, COMPATIBLE: REPRODUCED}
    worst = next((verdicts[code] for code in verdicts if by_outcome[code]), OPEN)
    return Finding(
        float(rubber.criterion_roughness.sel(criterion=paper)) * 1e6,
        worst,
        errors={"model": np.nan},
        rubber=rubber,
        rubber_label=cases[position]["case"],
        paper=paper,
        missed=by_outcome[MISSED],
        some=by_outcome[SOME],
        compatible=by_outcome[COMPATIBLE],
        wanted=DEFAULT_SHARE,
    )
