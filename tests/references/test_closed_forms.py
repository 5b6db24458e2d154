"""Closed forms against quadrature, published numbers and each other."""

import numpy as np
import pytest
from references.adhesion import AdhesiveWave, DMTSphere, JKRSphere, MaugisSphere, MaugisWave
from references.contact import Hertz, HertzEllipse, Westergaard, highest_summit
from scipy import special

from stickiness.remaining import sphere

R, W = 2.0, 3e-5  # any radius and adhesion length; the model is scaled by R^2 W only
AMPLITUDE, WAVELENGTH = 0.02, 1.5


# --- without adhesion -------------------------------------------------------------------------


def test_westergaard_balances_its_load():
    wave = Westergaard(0.02, 3.0, 0.007)
    x = (np.arange(200_000) + 0.5) / 200_000 * 3.0
    # midpoint rule, with a root at the edge: error of order n**-1.5
    assert wave.contact_pressure(x).mean() == pytest.approx(0.007, rel=1e-6)
    assert np.mean(wave.contact_pressure(x) > 0) == pytest.approx(wave.area_fraction, abs=1e-5)
    light = Westergaard(0.02, 3.0, 1e-9)
    np.testing.assert_allclose(light.gap(x), 0.02 - 0.02 * np.cos(2 * np.pi * x / 3), atol=1e-6)


def test_hertz_balances_its_load():
    hertz = Hertz(2.0, 1e-4)
    r = np.linspace(0, hertz.contact_radius, 100_001)
    force = np.trapezoid(2 * np.pi * r * hertz.contact_pressure(r), r)
    assert force == pytest.approx(1e-4, rel=1e-6)  # trapezoid with a root at the end: n**-1.5
    far = 1e3 * hertz.contact_radius
    # from afar the load is a point load: gap = r**2 / 2R - indentation + F / (pi r)
    expected = far**2 / 4 - hertz.indentation + 1e-4 / (np.pi * far)
    assert hertz.gap(far) == pytest.approx(expected, rel=1e-12)


def displace_by_ellipse(ellipse, x, y, points=400):
    """Displacement under Hertz's pressure by quadrature over rays from the point.

    Along a ray the integral of the root of a quadratic is elementary: none of the elliptic
    integrals of the closed form are used.
    """
    long, short = ellipse.semi_axes
    angle = (np.arange(points) + 0.5) * np.pi / points
    cosine, sine = np.cos(angle), np.sin(angle)
    # 1 - ((x + r cos)/long)^2 - ((y + r sin)/short)^2 = c - 2 b r - a r^2 along the ray
    a = (cosine / long) ** 2 + (sine / short) ** 2
    b = x * cosine / long**2 + y * sine / short**2
    c = 1 - (x / long) ** 2 - (y / short) ** 2
    chord = np.pi / 2 * (c + b**2 / a) / np.sqrt(a)  # half a circle, both ways of the ray
    return ellipse.largest_pressure / np.pi * np.sum(chord) * np.pi / points


@pytest.mark.parametrize("curvatures", [(1.0, 1.0), (2.0, 0.7), (0.05, 3.0)])
def test_ellipse_presses_the_paraboloid_flat(curvatures):
    ellipse = HertzEllipse(curvatures, 1e-4)
    long, short = ellipse.semi_axes
    low, high = min(curvatures), max(curvatures)
    for x, y in ((0.0, 0.0), (0.5 * long, 0.0), (0.0, 0.7 * short), (0.4 * long, -0.6 * short)):
        profile = low * x**2 / 2 + high * y**2 / 2
        found = displace_by_ellipse(ellipse, x, y)
        assert found == pytest.approx(ellipse.indentation - profile, rel=1e-9)
    volume = 2 / 3 * np.pi * long * short * ellipse.largest_pressure
    assert volume == pytest.approx(1e-4, rel=1e-12)


def test_highest_summit_of_a_wave_off_the_grid():
    n, length = 48, 3.0
    x = np.arange(n) / n * length
    k = 2 * np.pi / length
    heights = 0.1 * np.cos(k * (x - 1.23))[:, None] + 0.3 * np.cos(2 * k * (x - 0.41))[None, :]
    summit = highest_summit(heights, length)
    assert summit.height == pytest.approx(0.4, rel=1e-12)
    assert summit.position[0] == pytest.approx(1.23, abs=1e-9)
    assert summit.curvatures == pytest.approx((0.1 * k**2, 0.3 * (2 * k) ** 2), rel=1e-9)


# --- adhesive spheres -------------------------------------------------------------------------


def quadrature(breaks):
    """Radii and weights of Gauss' rule from zero over all breaks.

    The substitution takes square-root singularities and logarithms at the ends of each piece.
    """
    t, weight = np.polynomial.legendre.leggauss(300)
    t, weight = (t + 1) / 2, weight / 2
    low, high = (np.array(edges)[:, None] for edges in ([0.0, *breaks[:-1]], breaks))
    s = low + (high - low) * t**2 * (3 - 2 * t)
    return s.ravel(), ((high - low) * 6 * t * (1 - t) * weight).ravel()


def axial_gap(pressure, r, breaks, indentation):
    """Gap at r under an axisymmetric pressure: rings act through complete elliptic integrals."""
    s, weight = quadrature(sorted({*breaks, r} - {0.0} if r < max(breaks) else breaks))
    ring = 4 / np.pi * pressure(s) * s / (r + s) * special.ellipkm1(((r - s) / (r + s)) ** 2)
    return r**2 / (2 * R) - indentation + np.sum(ring * weight)


def total(pressure, breaks):
    s, weight = quadrature(breaks)
    return np.sum(2 * np.pi * pressure(s) * s * weight)


def test_jkr_published_numbers():
    # Johnson, Kendall & Roberts (1971): -3/2 pi R w at 0.63 of the radius at no load, which is
    # (6 pi R^2 w/K)^(1/3)
    jkr = JKRSphere(R, W)
    at_rest = (6 * np.pi * R**2 * W * 0.75) ** (1 / 3)
    assert jkr.contact_radius(0.0) == pytest.approx(at_rest, rel=1e-12)
    assert jkr.pull_off_radius / at_rest == pytest.approx(0.63, abs=0.005)
    assert jkr.force(jkr.pull_off_radius) == pytest.approx(-1.5 * np.pi * R * W, rel=1e-12)
    weak = JKRSphere(R, 1e-14)
    assert weak.contact_radius(0.01) == pytest.approx(Hertz(R, 0.01).contact_radius, rel=1e-5)


def maugis(parameter):
    """Sphere of a given Maugis parameter."""
    tabor = parameter / sphere.maugis_parameter(1.0, 1.0, 1.0)
    return MaugisSphere(R, W, np.cbrt(R * W**2) / tabor)


@pytest.mark.parametrize("parameter", [0.05, 0.1, 0.3, 0.5, 1.0, 2.0, 5.0])
def test_maugis_pull_off_published_fit(parameter):
    # Carpick, Ogletree & Salmeron, J. Colloid Interface Sci. 211, 395 (1999),
    # doi:10.1006/jcis.1998.6027; the fit is within 1.7 % of the solution, worst at 0.25
    x = 4.04 * parameter**1.4
    fitted = -7 / 4 + (x - 1) / (x + 1) / 4
    force = maugis(parameter).pull_off.force / (np.pi * R * W)
    assert force == pytest.approx(fitted, rel=0.018)
    assert -2 <= force <= -1.5


@pytest.mark.parametrize("parameter", [0.05, 1.0, 5.0])
@pytest.mark.parametrize("load", ["pull_off", 0.0, 20.0])
def test_maugis_fields_agree(parameter, load):
    sphere = maugis(parameter)
    state = sphere.pull_off if load == "pull_off" else sphere.at_force(load * R * W)
    a, c = state.contact_radius, state.cohesive_radius

    def pressure(r):
        return sphere.contact_pressure(r, state)

    breaks = [c] if a == 0 else [a, c]
    assert total(pressure, breaks) == pytest.approx(state.force, rel=1e-8, abs=1e-8 * R * W)
    scale = sphere.range
    assert axial_gap(pressure, c, breaks, state.indentation) == pytest.approx(scale, rel=1e-6)
    for r in (0.0, 0.5 * a, 0.95 * a):
        gap = axial_gap(pressure, r + 1e-9 * c, breaks, state.indentation)
        assert gap == pytest.approx(0, abs=1e-6 * scale)


@pytest.mark.parametrize("force", [-1.4, 0.0, 1e3])
def test_maugis_tends_to_dmt_and_jkr(force):
    force *= np.pi * R * W
    stiff, soft = maugis(1e-6), maugis(1e3)
    dmt, jkr = DMTSphere(R, W), JKRSphere(R, W)
    # the corrections are of the order of sqrt(lambda) and of 1/lambda
    state = stiff.at_force(force)
    assert state.contact_radius == pytest.approx(dmt.contact_radius(force), rel=5e-3)
    assert state.indentation == pytest.approx(dmt.indentation(force), rel=5e-3)
    state = soft.at_force(force)
    assert state.contact_radius == pytest.approx(jkr.contact_radius(force), rel=1e-4)
    radius = jkr.contact_radius(force)
    assert state.indentation == pytest.approx(jkr.indentation(radius), rel=1e-3)
    middle, inner = soft.contact_pressure([0.0, jkr.repulsive_radius(radius)], state)
    assert abs(inner) < 1e-6 * middle
    assert soft.pull_off.force == pytest.approx(jkr.pull_off_force, rel=1e-5)
    assert stiff.pull_off.force == pytest.approx(dmt.pull_off_force, rel=1e-3)


# --- adhesive waves ---------------------------------------------------------------------------


def wave_of(alpha):
    stress = np.pi * AMPLITUDE / WAVELENGTH
    return AdhesiveWave(AMPLITUDE, WAVELENGTH, alpha**2 * stress**2 * WAVELENGTH / 2)


def test_wave_published_numbers():
    # Johnson (1995): at alpha = 0.57 and above an unloaded contact spreads everywhere
    assert pytest.approx(0.57, abs=5e-4) == AdhesiveWave.CRITICAL_ALPHA
    wave = wave_of(AdhesiveWave.CRITICAL_ALPHA)
    _, (fraction, pressure) = wave.turning_points
    assert pressure == pytest.approx(0, abs=1e-12 * wave.full_contact_amplitude)
    assert fraction == pytest.approx(2 / 3)


@pytest.mark.parametrize("range_", [0.03, 3e-3, 3e-4])
@pytest.mark.parametrize("cohesive", [0.45, 0.99])
def test_maugis_wave_fields_agree(range_, cohesive):
    wave = MaugisWave(AMPLITUDE, WAVELENGTH, 5e-5, range_)
    state = wave.at_cohesive_fraction(cohesive)
    if state is None:  # even a point contact leaves less than the range at the edge
        assert 2 * AMPLITUDE * np.sin(np.pi / 2 * cohesive) ** 2 < range_
        return
    n = 2**15
    x = (np.arange(n) + 0.5) * WAVELENGTH / n
    pressure = wave.contact_pressure(x, state)
    share = np.minimum(x, WAVELENGTH - x) * 2 / WAVELENGTH
    # the jump at the edge of attraction is placed to half a pixel
    assert pressure.mean() == pytest.approx(state.pressure, abs=wave.strength / n)
    q = 2 * np.pi * np.fft.rfftfreq(n, WAVELENGTH / n)
    q[0] = np.inf
    gap = np.fft.irfft(2 * np.fft.rfft(pressure) / q, n)
    gap -= AMPLITUDE * np.cos(2 * np.pi * x / WAVELENGTH)
    contact = share < state.area_fraction
    gap -= gap[contact].mean()
    # the strength acts on up to half a pixel too many or too few, whose displacement is that
    # times the pixel and a logarithm (at most 1.5 in all)
    tolerance = 2 * wave.strength * WAVELENGTH / n
    assert np.abs(gap[contact]).max() < tolerance
    assert gap.min() > -tolerance
    at_edge = np.interp(cohesive, share[: n // 2], gap[: n // 2])
    assert at_edge == pytest.approx(range_, abs=tolerance)


@pytest.mark.slow
def test_maugis_wave_tends_to_johnson():
    johnson = AdhesiveWave(AMPLITUDE, WAVELENGTH, 5e-5)
    load = 0.2 * johnson.full_contact_amplitude
    limit = johnson.area_fraction(load)
    errors = []
    for range_ in (4e-4, 2e-4, 1e-4):
        states, stable = MaugisWave(AMPLITUDE, WAVELENGTH, 5e-5, range_).equilibria(load)
        errors.append(limit - states[stable.index(True)].area_fraction)
    # a smooth expansion in 1/strength, i.e. the range: the error halves or better
    assert np.all(np.divide(errors[:-1], errors[1:]) > 1.9)
    assert abs(errors[-1]) < 1e-3


def test_maugis_wave_under_full_attraction():
    # a range beyond the whole gap only shifts the load by the strength
    wave = MaugisWave(AMPLITUDE, WAVELENGTH, 5e-4, 2.5 * AMPLITUDE)
    load = 0.3 * wave.full_contact_amplitude
    states, stable = wave.equilibria(load)
    assert stable[-1]
    assert states[-1].cohesive_fraction == pytest.approx(1)
    shifted = Westergaard(AMPLITUDE, WAVELENGTH, load + wave.strength)
    assert states[-1].area_fraction == pytest.approx(shifted.area_fraction, rel=1e-9)
