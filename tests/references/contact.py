"""Contact without adhesion by closed forms, plain transforms and dense algebra.

Lengths are in one unit of the caller's choice, pressures in units of the plane-strain modulus E*,
loads are forces over E* in squared units of length. Johnson (1985) is his *Contact Mechanics*.
"""

from dataclasses import dataclass

import numpy as np
import pytest
from scipy import optimize, special

from stickiness.solids import HALF_SPACE


@dataclass(frozen=True)
class Westergaard:
    """Contact of a half-space with the wave ``amplitude * cos(2 pi x / wavelength)``.

    Westergaard, J. Appl. Mech. 6:49 (1939); Johnson (1985), section 13.2. The gap follows from the
    same complex function as the pressure: its real part is the pressure in contact, its imaginary
    part half the slope of the gap outside. `pressure` is the mean one.
    """

    amplitude: float
    wavelength: float
    pressure: float

    @property
    def full_contact_pressure(self):
        """Mean pressure from which on contact is full, in units of E*."""
        return np.pi * self.amplitude / self.wavelength

    @property
    def area_fraction(self):
        """Width of contact over the wavelength."""
        share = min(self.pressure / self.full_contact_pressure, 1.0)
        return float(2 / np.pi * np.arcsin(np.sqrt(share)))

    def contact_pressure(self, x):
        """Pressure [E*] at distances `x` [length] from a crest; zero outside contact."""
        psi = np.pi * np.asarray(x, dtype=float) / self.wavelength
        full = self.full_contact_pressure
        if self.pressure >= full:
            return self.pressure + full * np.cos(2 * psi)
        inside = np.maximum(self.pressure / full - np.sin(psi) ** 2, 0)
        return 2 * full * np.abs(np.cos(psi)) * np.sqrt(inside)

    def gap(self, x):
        """Gap [length] at distances `x` [length] from a crest; zero in contact."""
        edge = np.sqrt(min(self.pressure / self.full_contact_pressure, 1.0))
        ratio = np.abs(np.sin(np.pi * np.asarray(x, dtype=float) / self.wavelength)) / edge
        ratio = np.maximum(ratio, 1.0)
        profile = ratio * np.sqrt(ratio**2 - 1) - np.arccosh(ratio)
        return 2 * self.amplitude * edge**2 * profile


@dataclass(frozen=True)
class Hertz:
    """Contact with a paraboloid of a `radius` under a `load` (Johnson 1985, section 4.2)."""

    radius: float
    load: float

    @property
    def contact_radius(self):
        """Radius of the circle of contact."""
        return (0.75 * self.load * self.radius) ** (1 / 3)

    @property
    def largest_pressure(self):
        """Pressure in the middle, in units of E*."""
        return 1.5 * self.load / (np.pi * self.contact_radius**2)

    @property
    def indentation(self):
        """Approach of distant points."""
        return self.contact_radius**2 / self.radius

    def gap(self, r):
        """Gap [length] at distances `r` [length] from the axis; zero in contact."""
        ratio = np.maximum(np.asarray(r, dtype=float) / self.contact_radius, 1.0)
        sunk = (2 - ratio**2) * np.arcsin(1 / ratio) + np.sqrt(ratio**2 - 1)
        return self.indentation * (0.5 * ratio**2 - 1 + sunk / np.pi)


@dataclass(frozen=True)
class HertzEllipse:
    """Contact of a half-space with an elliptic paraboloid (Johnson 1985, eqs. 4.24 to 4.28).

    The limit of every rough surface at vanishing load: one asperity, with the principal curvatures
    of the `highest_summit`, in any order.
    """

    curvatures: tuple[float, float]
    load: float

    @property
    def axis_ratio(self):
        """Short over long axis of the ellipse; it depends on the curvatures alone."""
        ratio = min(self.curvatures) / max(self.curvatures)
        if ratio > 1 - 1e-6:  # the equation degenerates; there axes go as curvatures^(2/3)
            return ratio ** (2 / 3)

        def mismatch(log_axes):
            axes = np.exp(log_axes)
            first, second = special.ellipk(1 - axes**2), special.ellipe(1 - axes**2)
            return (first - second) - ratio * (second / axes**2 - first)

        # The ratio of the axes lies between that of the curvatures and its square root.
        return float(np.exp(optimize.brentq(mismatch, np.log(ratio), 0.5 * np.log(ratio))))

    @property
    def semi_axes(self):
        """Long and short semi-axis; the long one lies along the smaller curvature."""
        ratio = self.axis_ratio
        second = special.ellipe(1 - ratio**2)
        cube = 3 * self.load * second / (np.pi * sum(self.curvatures) * ratio**2)
        return float(np.cbrt(cube)), float(np.cbrt(cube) * ratio)

    @property
    def area(self):
        """Area of contact."""
        long, short = self.semi_axes
        return np.pi * long * short

    @property
    def largest_pressure(self):
        """Pressure in the middle, in units of E*."""
        return 1.5 * self.load / self.area

    @property
    def indentation(self):
        """Approach of distant points."""
        long, short = self.semi_axes
        return float(self.largest_pressure * short * special.ellipk(1 - (short / long) ** 2))


@dataclass(frozen=True)
class Summit:
    """Highest point of a surface."""

    height: float  #: there
    curvatures: tuple[float, float]  #: principal ones [1/length], positive, the smaller first


def highest_summit(heights, length):
    """Highest summit of periodic heights ``(n, n)``, by Newton's method on the Fourier series."""
    heights = np.asarray(heights, dtype=float)
    n = heights.shape[0]
    coefficients = np.fft.fft2(heights) / n**2
    q = 2 * np.pi * np.fft.fftfreq(n, length / n)
    start = np.array(np.unravel_index(np.argmax(heights), heights.shape)) * (length / n)
    position = start

    def series(factor_0, factor_1):
        phase_0, phase_1 = np.exp(1j * q * position[0]), np.exp(1j * q * position[1])
        return ((factor_0 * phase_0) @ coefficients @ (factor_1 * phase_1)).real

    one, slope = np.ones(n), 1j * q
    for _ in range(20):
        gradient = np.array([series(slope, one), series(one, slope)])
        mixed = series(slope, slope)
        hessian = np.array([[series(slope**2, one), mixed], [mixed, series(one, slope**2)]])
        step = np.linalg.solve(hessian, gradient)
        position = position - step
        if np.abs(step).max() < 1e-12 * length:
            break
    high, low = np.linalg.eigvalsh(hessian)
    return Summit(float(series(one, one)), (-float(low), -float(high)))


def wave_full_contact_pressure(amplitude, wavelength):
    """Mean pressure [E*] of full contact with ``amplitude cos(2 pi x / l) cos(2 pi y / l)``.

    Both arguments [length]. Johnson, Greenwood and Higginson, Int. J. Mech. Sci. 27:383 (1985),
    doi 10.1016/0020-7403(85)90029-3.
    """
    return np.sqrt(2) * np.pi * amplitude / wavelength


def wave_area(ratio):
    """Area fractions of the doubly sinusoidal wave in the limits of small loads and full contact.

    `ratio` is the mean pressure over that of full contact. At small loads every crest is a Hertzian
    contact; near full contact the troughs keep circular holes, loaded like pressurised penny-shaped
    cracks (Johnson, Greenwood and Higginson 1985, eq. 25 and below).
    """
    return np.pi * (3 * ratio / (8 * np.pi)) ** (2 / 3), 1 - 1.5 / np.pi * (1 - ratio)


def wavenumbers(shape, sides):
    """Magnitudes of the wave vectors of a periodic grid, ``(n0, n1)``."""
    q = (2 * np.pi * np.fft.fftfreq(n, side / n) for n, side in zip(shape, sides, strict=True))
    return np.hypot(*np.meshgrid(*q, indexing="ij"))


def displacement(pressure, sides, solid=HALF_SPACE):
    """Displacement of zero mean under a pressure, of a half-space or another solid."""
    half_space = solid == HALF_SPACE
    return _multiply_waves(pressure, sides, lambda q: 2 / q if half_space else solid.compliance(q))


def elastic_pressure(displaced, sides, solid=HALF_SPACE):
    """Pressure of zero mean that causes a displacement; arguments as of `displacement`."""
    half_space = solid == HALF_SPACE
    return _multiply_waves(displaced, sides, lambda q: q / 2 if half_space else solid.stiffness(q))


def _multiply_waves(field, sides, factor):
    q = wavenumbers(field.shape, sides)
    q[0, 0] = 1
    waves = np.fft.fft2(field) * factor(q)
    waves[0, 0] = 0
    return np.fft.ifft2(waves).real


def assert_contact_conditions(contact, heights, displacement, unit, tol=1e-8):
    """Check fields, load and residual of a solution, given the displacement under its pressure."""
    assert np.all(contact.pressure >= 0)
    assert np.all(contact.gap >= 0)
    assert not np.any(contact.pressure * contact.gap)
    # The load is balanced to the rounding of a sum.
    assert contact.pressure.mean() == pytest.approx(contact.mean_pressure, rel=1e-12)
    gap = displacement + contact.shift - heights
    # 1.01 and 1e-13: the residual is measured with other transforms, with other rounding.
    assert np.abs(gap - contact.gap).max() <= (1.01 * tol + 1e-13) * unit
    touching = contact.pressure > 0
    violation = max(np.abs(gap[touching]).max(), -gap.min())
    assert violation <= (1.01 * contact.residual + 1e-13) * unit
    assert contact.residual <= tol
    assert contact.area_fraction == np.mean(touching)
    assert contact.mean_gap == pytest.approx(contact.gap.mean())


def solve_directly(compliance, heights, load):
    """Pressure of all points, flat, which of them touch, and shift, from a dense compliance."""
    n = heights.size
    active = np.ones(n, bool)
    for _ in range(100):
        size = active.sum()
        system = np.ones((size + 1, size + 1))
        system[:size, :size] = compliance[np.ix_(active, active)]
        system[size, size] = 0
        solution = np.linalg.solve(system, np.append(heights.ravel()[active], load * n))
        pressure = np.zeros(n)
        pressure[active] = solution[:size]
        gap = compliance @ pressure + solution[size] - heights.ravel()
        wrong = (pressure < 0) | ((gap < -1e-12) & ~active)
        if not wrong.any():
            return pressure, active, solution[size]
        active = np.where(pressure < 0, False, active | (gap < -1e-12))
    pytest.fail("the direct method did not settle")
