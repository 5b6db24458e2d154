"""Worked examples of the theory guide: the numbers of their tables, and how to write them anew.

    PYTHONPATH=scripts:tests python tests/helpers/worked_examples.py

A row of a table is found by its first cell. Every number is made as the guide says, from the
functions behind its equations; the last ones are also asked of the library as a user asks them.
"""

from __future__ import annotations

import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
from scipy import integrate, optimize

from stickiness import Material, Surface
from stickiness.persson import Persson
from stickiness.remaining import predict, sphere
from stickiness.remaining.errors import BALL, FIRST_TOUCH, SHARE, SUMMITS, find_work_error
from stickiness.remaining.roughness import EXTRAPOLATION_ERROR, FINEST_SIMULATED, Roughness
from stickiness.remaining.share import (
    find_first_touch,
    remaining_share,
    spring_share,
    tough_area,
    tough_share,
    weak_share,
)
from stickiness.remaining.thin_layers import find_gain
from stickiness.solids import HALF_SPACE, Layer
from stickiness.spectrum import SelfAffine
from stickiness.spectrum.family import SpectrumFamily
from stickiness.traction_laws import find_strength
from stickiness.verdicts.rough_ball import pull_off_of_ball

THEORY = Path(__file__).parents[2] / "docs/theory"
WALL = SelfAffine(hurst=0.8, q0=2 * np.pi / 100e-6, q1=2 * np.pi / 10e-9, h_rms=1e-6)
WAFER = SelfAffine(
    hurst=0.8, q0=2 * np.pi / 10e-6, q_rolloff=2 * np.pi / 1e-6, q1=2 * np.pi / 1e-9, h_rms=1.2e-9
)
SMOOTH = SelfAffine(hurst=0.8, q0=2 * np.pi / 100e-6, q1=2 * np.pi / 10e-9, h_rms=0.1e-6)
POLISHED = SelfAffine(
    hurst=0.8, q0=2 * np.pi / 1e-6, q_rolloff=2 * np.pi / 1e-7, q1=2 * np.pi / 1e-9, h_rms=0.5e-9
)
SOFT = WALL, "exponential", 0.3e-9  # spectrum, law and range [m]
SILICON = WAFER, "van_der_waals", 0.165e-9
WORK = 0.05  # [J/m²]
WANTED = 0.1  # share of the work
SUPERSCRIPTS = "⁰¹²³⁴⁵⁶⁷⁸⁹⁻"
RAISED = str.maketrans("0123456789-", SUPERSCRIPTS)
LOWERED = str.maketrans(SUPERSCRIPTS, "0123456789-")

SELF_AFFINE = (0.5, 64.0), (0.8, 64.0), (0.8, 1000.0)  # Hurst exponent and magnification
MEAN_GAPS = tuple(  # pressure over E* q0 h_rms, and the width of P(g)
    (load, variant)
    for variant in ("afferrante2018", "almqvist2011")
    for load in (0.0065, 0.065, 0.26)
)
HALF_SPACES = ((*SOFT, 0.27e6), (*SOFT, 2.7e6), (*SILICON, 85e9))  # and E* [Pa]
LAYERS = (  # thickness [m], Poisson's ratio and E* [Pa]
    (5e-6, 0.3, 50e6),
    (5e-6, 0.5, 50e6),
    (2e-6, 0.5, 10e6),
)
LIMITS = tuple(  # and E* [Pa], solid, longest waves along a side and eta
    (*example, eta)
    for example in (
        (*SOFT, 1.35e6, HALF_SPACE, np.inf),
        (SMOOTH, "exponential", 0.3e-9, 50e6, Layer(5e-6, 0.5), np.inf),
        (POLISHED, "van_der_waals", 0.165e-9, 570e9, HALF_SPACE, 2),
    )
    for eta in (-1, 1)
)
BALLS = ((*SOFT, 0.27e6, 1e-3), (*SOFT, 0.27e6, 1e-4), (*SILICON, 85e9, 1e-6))  # and radius [m]


def describe(spectrum, law, solid=HALF_SPACE):
    """Roughness of one spectrum, as `predict` has it."""
    family = SpectrumFamily.of(spectrum)
    q0 = np.array([spectrum.q_longest])
    return Roughness.of(family, solid, q0=q0, q1=spectrum.q1, law=law).take(0)


def compute_half_space(spectrum, law, range_, modulus):
    """Chapter 5."""
    length = WORK / modulus
    rough = describe(spectrum, law)
    ratio = length / spectrum.elastic_energy()
    onset = rough.onset(length, range_)
    found = predict(spectrum, adhesion_length=length, range=range_, law=law)
    distance = rough.distance(length, range_)
    return {
        r"$U_\mathrm{full}$ [J/m²]": modulus * spectrum.elastic_energy(),
        r"$h'_\mathrm{rms}$": spectrum.rms_slope,
        r"$x$": ratio,
        r"$z$": rough.zone(length, range_),
        r"$k_n$": rough.narrowest_wave(length, range_),
        r"$N$": 3.7 * onset / (1 - onset),
        r"$x_0$": onset,
        r"$s$": 0.74 * onset * np.sqrt(1 - onset),
        r"$A_\mathrm{t}$": tough_area(ratio, onset),
        r"$S_\mathrm{t}$": tough_share(ratio, onset),
        r"$S_\mathrm{w}$": weak_share(ratio, range_ / spectrum.h_rms, rough.load_scale, law),
        r"$S$": found.separation,
        r"$\mu$": found.tabor,
        r"$T$": spectrum.h_rms * ratio * found.separation / distance,
        r"$\ell$ [µm]": 1e6 * distance,
        r"$\sigma_\mathrm{po}$ [Pa]": modulus * found.pull_off,
        r"$E^\ast_\mathrm{th}$ [MPa]": 1e-6 * WORK / rough.threshold(range_, WANTED),
    }


def compute_layer(thickness, poisson, modulus):
    """Chapter 6."""
    spectrum, law, range_ = SMOOTH, "exponential", 0.3e-9
    solid = Layer(thickness, poisson)
    length = WORK / modulus
    rough = describe(spectrum, law, solid)
    ratio = length / rough.elastic_energy
    onset = rough.onset(length, range_)
    gain = find_gain(ratio, rough.relative_compliance, rough.flow)
    range_ratio = range_ / spectrum.h_rms
    tough = tough_share(ratio, onset)
    weak = weak_share(ratio, range_ratio, rough.load_scale)
    springs = spring_share(gain * ratio, range_ratio)
    deepest = max(tough, weak)
    independence = (1 - rough.relative_compliance) ** 2
    bound = predict(spectrum, length, range_).separation
    share = min(deepest + independence * max(springs - deepest, 0.0), bound)
    found = predict(spectrum, length, range_, solid=solid).separation
    np.testing.assert_allclose(share, found, rtol=1e-9)
    return {
        r"$c_0$": rough.relative_compliance,
        r"$f$": rough.flow,
        r"$U_\mathrm{full}$ [J/m²]": modulus * rough.elastic_energy,
        r"$U_\mathrm{full}$ of the half-space [J/m²]": modulus * spectrum.elastic_energy(),
        r"$x$": ratio,
        r"$z$": rough.zone(length, range_),
        r"$x_0$": onset,
        r"$S_\mathrm{t}$": tough,
        r"$S_\mathrm{w}$": weak,
        r"$x_\mathrm{s}/x$": gain,
        r"$x_\mathrm{s}$": gain * ratio,
        r"$S_\mathrm{spring}$": springs,
        r"$(1-c_0)_+^2$": independence,
        r"$S$ of the half-space": bound,
        r"$S$": share,
        r"$\epsilon_d$": solid.strain(spectrum.h_rms, spectrum.q0),
        r"$E^\ast_\mathrm{th}$ [MPa]": 1e-6 * WORK / rough.threshold(range_, WANTED),
    }


def compute_limit(spectrum, law, range_, modulus, solid, waves, eta):
    """Chapter 7."""
    length = WORK / modulus
    value = replace(describe(spectrum, law, solid), waves=waves)
    rough = value.deviating(eta)
    far = rough.onset(length, range_)
    near = rough.onset(length, range_, finest=FINEST_SIMULATED)
    extrapolated = EXTRAPOLATION_ERROR * np.log(far / near)
    error = float(find_work_error(rough, extrapolated))
    shifted = length * np.exp(eta * error)
    ratio = shifted / rough.elastic_energy
    touch = FIRST_TOUCH.spread
    first_touch = find_first_touch(waves) + (touch.high if eta < 0 else touch.low)
    unlimited = remaining_share(
        ratio,
        range_ / spectrum.h_rms,
        onset=rough.onset(shifted, range_),
        relative_compliance=rough.relative_compliance,
        load_scale=rough.load_scale,
        law=law,
        gain=find_gain(ratio, rough.relative_compliance, rough.flow),
        first_touch=first_touch,
    )
    return {
        r"$S$": value.share(length, range_),
        r"$n$": waves,
        r"$\eta$": eta,
        r"$\delta_x$": extrapolated,
        r"$\delta$": error,
        r"$x e^{\eta\delta}$": ratio,
        r"$v_t$": first_touch,
        r"$\tilde S$": unlimited,
        r"$S_\eta-\tilde S$, before its bounds": eta * SHARE.half_width(unlimited, waves),
        r"$1-1/x$, not below 0": max(1 - rough.elastic_energy / length, 0.0),
        r"$S_\eta$": rough.share(length, range_),
    }


def compute_ball(spectrum, law, range_, modulus, radius):
    """Chapter 5, of a ball."""
    length = WORK / modulus

    def cut(lowest):
        """Roughness of the waves from a wave number on."""
        if lowest <= spectrum.q0:
            return spectrum
        left = math.sqrt(spectrum.variance_above(lowest))
        rolloff = spectrum.q_rolloff
        keeps = rolloff is not None and rolloff > lowest
        return SelfAffine(
            hurst=spectrum.hurst,
            q0=lowest,
            q1=spectrum.q1,
            h_rms=left,
            q_rolloff=rolloff if keeps else None,
        )

    def press(waves_from, across, eta=0.0, curvature=0.0):
        """Pull-off with so many of the longest waves across the zone."""
        rough = sphere.narrow(describe(cut(waves_from), law), across, SUMMITS.spread.value)
        error = BALL.spread.high
        return sphere.pull_off(rough.deviating(eta), radius, length, range_, curvature, error)

    def excess(log_q):
        """Logarithm of the zone over the longest wave that counts."""
        zone = 2 * press(math.exp(log_q), 1.0).zone_radius
        return math.log(zone / (2 * np.pi)) + log_q

    lowest = spectrum.q0
    if excess(math.log(lowest)) < 0:
        ends = math.log(lowest), math.log(spectrum.q1) - 1e-3
        lowest = math.exp(optimize.brentq(excess, *ends, xtol=1e-6))
    counted = cut(lowest)
    rough = describe(counted, law)
    zone = 2 * press(lowest, 1.0).zone_radius
    across = zone * rough.q0 / (2 * np.pi)
    narrowed = sphere.narrow(rough, across, SUMMITS.spread.value)
    share = narrowed.share(length, range_)
    distance = rough.distance(length, range_)
    curvature = 0.5 * math.sqrt(max(spectrum.total_variance(4) - counted.total_variance(4), 0.0))
    value, low, high = (press(lowest, across, eta, curvature) for eta in (0.0, -1.0, 1.0))
    smooth_parameter = sphere.maugis_parameter(radius, length, range_ / find_strength(law))
    parameter = sphere.maugis_parameter(radius, share * length, distance)

    # As a user asks.
    material = Material(plane_strain_modulus=modulus, work_of_adhesion=WORK, range=range_, law=law)
    asked = pull_off_of_ball(Surface.from_spectrum(spectrum), material, radius)
    of_guide = [modulus * each.force for each in (value, low, high)]
    np.testing.assert_allclose(of_guide, [asked.force, *asked.force_limits], rtol=2e-3)
    return {
        r"longest wave that counts [µm]": 1e6 * 2 * np.pi / lowest,
        r"$h_\mathrm{rms}$ of the waves that count [nm]": 1e9 * counted.h_rms,
        r"$x$": length / rough.elastic_energy,
        r"zone $2a$ [µm]": 1e6 * zone,
        r"$n$": across,
        r"$v_t$": narrowed.first_touch,
        r"$S$": share,
        r"$\ell$ [nm]": 1e9 * distance,
        r"$\lambda_\mathrm{M}$": parameter,
        r"$\psi$": modulus * value.force / (np.pi * radius * share * WORK),
        r"$F$ [µN]": 1e6 * modulus * value.force,
        r"$\lambda_\mathrm{M}$ of the smooth ball": smooth_parameter,
        r"$F_0$ [µN]": 1e6 * modulus * value.smooth_force,
        r"$K_RR$": curvature * radius,
        r"low limit of $F$ [µN]": 1e6 * modulus * low.force,
        r"high limit of $F$ [µN]": 1e6 * modulus * high.force,
    }


def compute_mean_gap(load, variant):
    """Chapter 4: what the mean of P(g) exceeds the mean gap by [%]."""
    excess = {}
    for hurst, magnification in SELF_AFFINE:
        spectrum = SelfAffine(hurst=hurst, q0=1.0, q1=magnification, h_rms=1.0)
        theory = Persson(spectrum, variant=variant)
        # The mean is the integral of the share of the area with a larger gap.
        log_gap = np.linspace(-16.0, 4.0, 2001)
        gap = np.exp(log_gap)
        larger = 1 - theory.area_fraction(load) - theory.gap_cumulative(gap, load)
        mean = integrate.simpson(gap * larger, x=log_gap)
        name = rf"$H={hurst}$, $\zeta={magnification:.0f}$"
        excess[name] = 100 * (mean / theory.mean_gap(load) - 1)
    return excess


EXAMPLES = {  # chapter and heading of a table: what makes a column, and of what
    ("persson", "## Distribution of gaps"): (compute_mean_gap, MEAN_GAPS),
    ("adhesion", "## Worked example"): (compute_half_space, HALF_SPACES),
    ("layers", "## Worked example"): (compute_layer, LAYERS),
    ("limits", "## Worked example"): (compute_limit, LIMITS),
    ("adhesion", "### Worked example of a ball"): (compute_ball, BALLS),
}


def compute(place):
    """Columns of a table: numbers by the first cell of their row."""
    function, examples = EXAMPLES[place]
    return [
        {name: float(number) for name, number in function(*example).items()} for example in examples
    ]


def find_rows(place):
    """Lines of a table's rows of numbers, as the page has them."""
    chapter, heading = place
    text = (THEORY / f"{chapter}.md").read_text(encoding="utf-8")
    after = text.partition(f"\n{heading}\n")[2]
    section = re.split(r"^#", after, maxsplit=1, flags=re.M)[0]
    lines = [line for line in section.splitlines() if line.startswith("| ")]
    return lines[2:]  # without the head


def read_table(place):
    """Numbers of a table by the first cell of their row."""
    rows = [line.strip("| ").split(" | ") for line in find_rows(place)]
    return {name: [read_number(cell) for cell in cells] for name, _, *cells in rows}


def read_number(text):
    """A number as the page writes it, such as 3.054 × 10⁻⁸."""
    if text == "∞":
        return math.inf
    digits, _, power = text.partition(" × 10")
    return float(digits.replace("−", "-")) * 10.0 ** int(power.translate(LOWERED) or 0)


def write_number(number):
    """The same with four digits, or all before the point."""
    if math.isinf(number):
        return "∞"
    size = abs(number)
    if size < 1000 and math.isclose(number, round(number), rel_tol=1e-5):
        return str(round(number)).replace("-", "−")
    if not 1e-4 <= size < 1e6:
        digits, power = f"{number:.3e}".split("e")
        return f"{digits} × 10{str(int(power)).translate(RAISED)}"
    decimals = max(3 - math.floor(math.log10(size)), 0)
    return f"{number:.{decimals}f}".replace("-", "−")


def renew(place):
    """Write the numbers of a table into its chapter."""
    path = THEORY / f"{place[0]}.md"
    text = path.read_text(encoding="utf-8")
    columns = compute(place)
    for line in find_rows(place):
        name, by, *_ = line.strip("| ").split(" | ")
        cells = [write_number(column[name]) for column in columns]
        text = text.replace(line, "| " + " | ".join((name, by, *cells)) + " |", 1)
    path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    for each in EXAMPLES:
        renew(each)
