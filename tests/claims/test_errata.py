"""Each erratum proved by algebra or by recomputing the printed number."""

import numpy as np
import pytest
import sympy as sp

from claims import errata
from stickiness import criteria
from stickiness.pages.rendering import make_environment

NUMBERS = {int(number): found for number, found in errata.recompute().items()}


def test_1_fuller_tabor_dimension():
    # Scale every length by s at fixed modulus: work of adhesion per area scales as E* times length.
    s = 7.0
    h, radius, length = 0.5, 3.0, 0.01

    def printed(h, radius, length):
        return length * h**1.5 / radius**0.5

    grown = np.log(printed(s * h, s * radius, s * length) / printed(h, radius, length)) / np.log(s)
    assert NUMBERS[1]["length_exponent_printed"] == pytest.approx(grown, abs=1e-12) == 2
    right = criteria.fuller_tabor(h, 2 / radius, length).margin
    scaled = criteria.fuller_tabor(s * h, 2 / (s * radius), s * length).margin
    assert scaled == pytest.approx(right, rel=1e-12)
    assert NUMBERS[1]["length_exponent_correct"] == 0


def test_2_coefficient_by_balancing_tractions():
    a_v, p, q0, h, eps, length, u = sp.symbols("a_V p q_0 h epsilon l_a u", positive=True)
    density = a_v * p / (q0 * h) * (u / h) ** sp.Rational(-1, 3) / h
    attraction = length / eps * sp.integrate(density, (u, 0, eps))
    # Sticky when attraction/p > 1, that is (h/eps)^(5/3) < coefficient (l_a/eps)/(eps q0).
    form = length / eps / (eps * q0) * (eps / h) ** sp.Rational(5, 3)
    coefficient = sp.simplify(attraction / p / form)
    assert coefficient == sp.Rational(3, 2) * a_v
    assert float(coefficient.subs(a_v, 3)) == NUMBERS[2]["coefficient_derived"] == 4.5
    assert float(coefficient.subs(a_v, 1.5)) == NUMBERS[2]["coefficient_printed"] == 2.25


def test_2_printed_consequences_use_nine_quarters():
    numbers = NUMBERS[2]
    # Three digits by hand: (2.25 * 0.05/(eps q0))^0.6 and with 4.5.
    for exponent, printed, derived in ((6, 1073, 1626), (9, 6.77e4, 1.026e5), (12, 4.27e6, 6.47e6)):
        for name, value in (("printed", printed), ("derived", derived)):
            found = numbers[f"h_over_range_limit_{name}_1e-{exponent}"]
            assert found == pytest.approx(value, rel=2e-3)
    # The paper prints 1000, 67000 and 0.2 MPa, each within its rounding of 9/4 and not of 9/2.
    assert numbers["h_over_range_limit_printed_1e-9"] == pytest.approx(67000, rel=0.015)
    assert numbers["asphalt_modulus_Pa_printed"] == pytest.approx(0.1945e6, rel=1e-3)
    assert numbers["asphalt_modulus_Pa_derived"] == pytest.approx(0.389e6, rel=1e-3)


def _closed_form():
    """Return a_V derived symbolically, with the symbols it holds."""
    x, u, b, modulus, h, p, v, q0 = sp.symbols("x u B E h p V q_0", positive=True)
    pressure, gap = sp.symbols("s g", positive=True)
    third = sp.Rational(1, 3)
    # Persson's distribution of contact pressure; its slope at zero pressure counts the edges.
    distribution = (
        sp.exp(-((pressure - p) ** 2) / (2 * v)) - sp.exp(-((pressure + p) ** 2) / (2 * v))
    ) / sp.sqrt(2 * sp.pi * v)
    slope = sp.simplify(sp.diff(distribution, pressure).subs(pressure, 0))
    # Beside an edge s = B x^(1/2): an edge of length Pi per area holds Pi dx/ds of pressure s.
    perimeter = slope * pressure / sp.diff((pressure / b) ** 2, pressure)
    # Outside u = C x^(3/2): density of gaps Pi dx/du.
    c = 4 * b / (3 * modulus)
    strip = (gap / c) ** (2 * third)
    density = sp.simplify(perimeter) * sp.diff(strip, gap)
    a_v = sp.powsimp(
        sp.simplify(h * density / (p / (modulus * q0 * h) * (gap / h) ** (-third))), force=True
    )
    return sp.simplify(a_v), sp.simplify(perimeter), (b, modulus, h, p, v, q0, gap)


def test_3_closed_form_of_a_v():
    a_v, perimeter, (b, modulus, h, p, v, q0, gap) = _closed_form()
    assert gap not in a_v.free_symbols  # P(u) ~ u^(-1/3) exactly
    # Beta multiplies B: its exponent is that of B.
    exponent = sp.simplify(b * sp.diff(sp.log(a_v), b))
    assert exponent == sp.Rational(4, 3)
    assert NUMBERS[3]["beta_exponent_correct"] == pytest.approx(float(exponent), abs=1e-14)
    # What is left beside perimeter, C and the definition's own factors is 2/3.
    c = 4 * b / (3 * modulus)
    bare = perimeter * c ** sp.Rational(-2, 3) * h ** sp.Rational(2, 3) * modulus * q0 * h / p
    values = {b: 0.7, modulus: 1.3, h: 0.4, p: 0.1, v: 0.02, q0: 1.7}
    factor = float((a_v / bare).subs(values))
    assert factor == pytest.approx(2 / 3, rel=1e-12)
    assert NUMBERS[3]["edge_factor_correct"] == pytest.approx(factor, rel=1e-12)
    assert NUMBERS[3]["edge_factor_printed"] == pytest.approx((4 / 9) ** (1 / 3), rel=1e-14)
    # And the attractive area, the integral of P, brings the 3/2 once.
    eps = sp.symbols("epsilon", positive=True)
    area = sp.integrate(gap ** sp.Rational(-1, 3), (gap, 0, eps))
    assert sp.simplify(area / eps ** sp.Rational(2, 3)) == sp.Rational(3, 2)
    assert NUMBERS[3]["printed_over_correct_at_beta_1"] == pytest.approx(
        1.5 * (4 / 9) ** (1 / 3) / (2 / 3), rel=1e-12
    )


def test_4_perimeter():
    _, perimeter, (b, _, _, p, v, _, _) = _closed_form()
    expected = b**2 / 2 * p * sp.sqrt(2 / (sp.pi * v**3)) * sp.exp(-(p**2) / (2 * v))
    assert sp.simplify(perimeter / expected) == 1
    # Units: scale all pressures by s, the perimeter must not move; with V^(3/2) it does.
    s = sp.symbols("s", positive=True)
    scale = {b: s * b, p: s * p, v: s**2 * v}
    assert sp.simplify(perimeter.subs(scale, simultaneous=True) / perimeter) == 1
    assert NUMBERS[4]["pressure_exponent_correct"] == 0
    printed = b**2 / 2 * p * sp.sqrt(2 / (sp.pi * v ** sp.Rational(3, 2)))
    grown = sp.simplify(printed.subs(scale, simultaneous=True) / printed)
    assert grown == s ** sp.Rational(3, 2)
    assert NUMBERS[4]["pressure_exponent_printed"] == 1.5


def test_5_kilometres():
    found = NUMBERS[5]["h_over_range_limit_1e-12"]
    assert found == pytest.approx((2.25 * 0.05e12) ** 0.6, rel=1e-12)
    assert f"{found:.1e}" == "4.3e+06"


def test_6_pastewka_robbins_constants():
    # From the inequality: its right side over its left is p_ad/p_rep, and the area behind that is
    # p_ad over the stress l/D.
    slope, curvature, d, length, eps, q0, h, a_v = sp.symbols("m k D l e q_0 h a", positive=True)
    two = sp.Rational(2, 3)
    left = slope * d / (2 * length) * (slope * (4 * slope / curvature) / (4 * d)) ** two
    balance = sp.pi * sp.Rational(3, 16) ** two / left
    # A_ad/p = balance/(l/D) against (3/2) a_V (eps/h)^(2/3)/(q0 h)
    (solved,) = sp.solve(
        sp.Eq(balance * d / length, sp.Rational(3, 2) * a_v * (eps / h) ** two / (q0 * h)), a_v
    )
    unit = {slope: 1, curvature: 1, q0: 1, h: 1, length: 0.3, eps: 1}
    numbers = NUMBERS[6]
    for name, ratio in (("ratio_exact", np.sqrt(1.2)), ("ratio_1.1", 1.1), ("ratio_1", 1.0)):
        assert numbers[f"prefactor_{name}"] == pytest.approx(
            float(solved.subs({**unit, d: ratio})), rel=1e-12
        )
        # Moments of a broad power law with H = 0.8: h'^2 = 4, h''^2 = 2/3 at zeta = 1.
        power_law = float(solved.subs({**unit, slope: 2.0, curvature: np.sqrt(2 / 3), d: ratio}))
        assert numbers[f"power_law_{name}"] == pytest.approx(power_law, rel=1e-12)


def test_6_statement_quotes_the_recomputed_digits():
    errata = make_environment("report").get_template("errata.j2").module.errata
    assert [entry["number"] for entry in errata] == list(NUMBERS)
    numbers, text = NUMBERS[6], errata[5]
    quoted = [f"{numbers['prefactor_ratio_exact']:.3f}"]
    quoted += [f"{numbers[f'power_law_{ratio}']:.4f}" for ratio in ("ratio_exact", "ratio_1.1")]
    assert all(digits in text["correct"] for digits in quoted)
    quoted = f"{numbers['prefactor_ratio_1']:.3f}", f"{numbers['power_law_ratio_1']:.4f}"
    assert all(digits in text["proof"] for digits in quoted)
    # Delta_r = 1.1 range gives the printed constant to its last digit but one.
    assert numbers["prefactor_ratio_1.1"] == pytest.approx(1.4622, abs=1e-4)
    assert text["printed"].startswith("1.4622")
