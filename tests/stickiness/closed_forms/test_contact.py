"""Closed forms of contact: balance of loads, limits, one asperity against Hertz's ellipse."""

import numpy as np
import pytest

from stickiness import repulsive, spectrum, surface
from stickiness.closed_forms import contact as reference
from stickiness.repulsive import subpixel


def displacement_under(ellipse, points=400):
    """Displacement under Hertz's pressure, by integrating its potential numerically.

    That of a semi-ellipsoid of pressure by quadrature over rays from the point, with none of the
    elliptic integrals of the closed form: ``u(x) = (1/pi) int p(x')/|x - x'| dA'`` in units
    of E*; along a ray from the point the integral of sqrt of a quadratic is elementary.
    """
    long, short = ellipse.semi_axes

    def displacement(x, y):
        angle = (np.arange(points) + 0.5) * np.pi / points
        cosine, sine = np.cos(angle), np.sin(angle)
        # 1 - ((x + r cos)/long)^2 - ((y + r sin)/short)^2 = c - 2 b r - a r^2 along the ray
        a = (cosine / long) ** 2 + (sine / short) ** 2
        b = x * cosine / long**2 + y * sine / short**2
        c = 1 - (x / long) ** 2 - (y / short) ** 2
        chord = np.pi / 2 * (c + b**2 / a) / np.sqrt(a)  # half a circle, both ways of the ray
        return ellipse.largest_pressure / np.pi * np.sum(chord) * np.pi / points

    return displacement


@pytest.mark.parametrize("curvatures", [(1.0, 1.0), (2.0, 0.7), (0.05, 3.0)])
def test_ellipse_presses_the_paraboloid_flat(curvatures):
    ellipse = reference.HertzEllipse(curvatures, 1e-4)
    long, short = ellipse.semi_axes
    displacement = displacement_under(ellipse)
    low, high = min(curvatures), max(curvatures)
    for x, y in ((0.0, 0.0), (0.5 * long, 0.0), (0.0, 0.7 * short), (0.4 * long, -0.6 * short)):
        profile = low * x**2 / 2 + high * y**2 / 2
        assert displacement(x, y) == pytest.approx(ellipse.indentation - profile, rel=1e-9)
    volume = 2 / 3 * np.pi * long * short * ellipse.largest_pressure
    assert volume == pytest.approx(1e-4, rel=1e-12)


def test_ellipse_of_equal_curvatures_is_a_circle():
    hertz = reference.Hertz(2.0, 1e-4)
    for low in (0.5, 0.5 * (1 - 1e-7), 0.5 * (1 - 1e-5)):
        ellipse = reference.HertzEllipse((low, 0.5), 1e-4)
        radius = hertz.contact_radius
        assert ellipse.semi_axes == pytest.approx((radius, radius), rel=1e-5)
        assert ellipse.indentation == pytest.approx(hertz.indentation, rel=1e-5)
        assert ellipse.largest_pressure == pytest.approx(hertz.largest_pressure, rel=1e-5)


def test_ellipse_ignores_the_order_of_curvatures_and_keeps_its_shape():
    one = reference.HertzEllipse((0.2, 3.0), 1e-4)
    turned = reference.HertzEllipse((3.0, 0.2), 1e-4)
    assert turned.semi_axes == one.semi_axes
    assert turned.indentation == one.indentation
    heavier = reference.HertzEllipse((0.2, 3.0), 8e-4)
    assert heavier.axis_ratio == one.axis_ratio
    assert np.divide(heavier.semi_axes, one.semi_axes) == pytest.approx(2, rel=1e-12)


def test_highest_summit_of_a_wave_off_the_grid():
    n, length = 48, 3.0
    x = np.arange(n) / n * length
    k = 2 * np.pi / length
    heights = 0.1 * np.cos(k * (x - 1.23))[:, None] + 0.3 * np.cos(2 * k * (x - 0.41))[None, :]
    summit = reference.highest_summit(heights, length)
    assert summit.height == pytest.approx(0.4, rel=1e-12)
    assert summit.position[0] == pytest.approx(1.23, abs=1e-9)
    assert summit.position[1] % (length / 2) == pytest.approx(0.41, abs=1e-9)
    assert summit.curvatures == pytest.approx((0.1 * k**2, 0.3 * (2 * k) ** 2), rel=1e-9)


def test_highest_summit_needs_a_resolved_surface():
    noise = np.random.default_rng(0).standard_normal((16, 16))
    noise[3, 4] = noise[3, 5] = 5.0
    noise[3, 6] = -5.0
    with pytest.raises(RuntimeError, match="not near the highest point"):
        reference.highest_summit(np.where(np.abs(noise) < 5, 0, noise), 1e-3)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_rough_surface_at_vanishing_load_touches_at_its_summit(seed):
    band = spectrum.SelfAffine(hurst=0.8, q0=1.0, q1=4.0, h_rms=0.1)
    length = 2 * np.pi
    heights = surface.synthesise(band, n=512, length=length, seed=seed)
    summit = reference.highest_summit(heights, length)
    departures = []
    for pressure in (1e-4, 1e-5):
        contact = repulsive.solve(heights, length, pressure)
        ellipse = reference.HertzEllipse(summit.curvatures, pressure * length**2)
        touching = contact.pressure > 0
        area = contact.area_fraction - subpixel.boundary_strip(touching)
        departures.append(
            np.abs(
                [
                    area * length**2 / ellipse.area - 1,
                    contact.pressure.max() / ellipse.largest_pressure - 1,
                    (summit.height - contact.shift) / ellipse.indentation - 1,
                ]
            )
        )
    # The spot is 7 to 20 points across and 1/10 of the shortest wavelength at the lighter load,
    # where the summit departs from a paraboloid by some per cent; that departure and the field
    # of the neighbouring cells grow with the size of the spot, as the cube root of the load.
    assert np.all(departures[1] < [0.05, 0.012, 0.06])
    assert departures[1][2] < 0.6 * departures[0][2]


@pytest.mark.parametrize(
    ("curvatures", "load", "message"),
    [
        ((1.0, 0.0), 1.0, "curvatures must be two positive"),
        ((-1.0, 1.0), 1.0, "curvatures must be two positive"),
        ((1.0, 1.0), 0.0, "load must be positive"),
    ],
)
def test_ellipse_refuses(curvatures, load, message):
    with pytest.raises(ValueError, match=message):
        reference.HertzEllipse(curvatures, load)


def test_westergaard_closed_form_balances_its_load():
    wave = reference.Westergaard(0.02, 3.0, 0.007)
    x = (np.arange(200_000) + 0.5) / 200_000 * 3.0
    # midpoint rule, with a root at the edge: error of order n**-1.5
    assert wave.contact_pressure(x).mean() == pytest.approx(0.007, rel=1e-6)
    assert np.mean(wave.contact_pressure(x) > 0) == pytest.approx(wave.area_fraction, abs=1e-5)
    light = reference.Westergaard(0.02, 3.0, 1e-9)
    np.testing.assert_allclose(light.gap(x), 0.02 - 0.02 * np.cos(2 * np.pi * x / 3), atol=1e-6)


def test_hertz_closed_form_balances_its_load():
    hertz = reference.Hertz(2.0, 1e-4)
    r = np.linspace(0, hertz.contact_radius, 100_001)
    force = np.trapezoid(2 * np.pi * r * hertz.contact_pressure(r), r)
    assert force == pytest.approx(1e-4, rel=1e-6)  # trapezoid with a root at the end: n**-1.5
    far = 1e3 * hertz.contact_radius
    # from afar the load is a point load: gap = r**2 / 2R - indentation + F / (pi r)
    expected = far**2 / 4 - hertz.indentation + 1e-4 / (np.pi * far)
    assert hertz.gap(far) == pytest.approx(expected, rel=1e-12)
    assert hertz.gap(hertz.contact_radius) == pytest.approx(0.0, abs=1e-18)


@pytest.mark.parametrize("arguments", [(0.0, 1.0, 0.1), (1.0, -1.0, 0.1), (1.0, 1.0, np.nan)])
def test_wrong_arguments_of_the_closed_forms(arguments):
    with pytest.raises(ValueError, match="must be positive"):
        reference.Westergaard(*arguments)
    if not (arguments[0] > 0 and arguments[1] > 0):
        with pytest.raises(ValueError, match="must be positive"):
            reference.Hertz(*arguments[:2])
