"""Reference values of Persson's contact theory, by mpmath with 30 digits.

This program shares nothing with the library. It is written from the relations as published, with
integrals over wave numbers: where the library integrates by parts over -1/q this program
integrates q^2 C w F over q and differentiates under the integral. The pressure diffuses by
dV_eff = S(A) dV, the mean gap seen from a magnification on takes the elastic energy d(A S)/dA, and
P(u) is the integral of its pair of Gaussians over the area lost. The quadratures are composite
Gauss-Legendre; with half again as many nodes values change by less than 1e-10 of themselves.

Writes tests/data/persson_reference.csv in about a quarter of an hour::

    python benchmarks/persson_reference.py
"""

import csv
from bisect import bisect_right
from functools import cache, lru_cache
from pathlib import Path

from mpmath import mp, mpf

TABLE = Path(__file__).parents[1] / "tests/data/persson_reference.csv"

# name: (kind, parameters); lengths in any unit
SPECTRA = {
    "power H=0.8 zeta=1.001": ("power", (0.8, 1.001, None)),
    "power H=0.05 zeta=1.001": ("power", (0.05, 1.001, None)),
    "power H=1 zeta=10": ("power", (1.0, 10.0, None)),
    "power H=0.5 zeta=100": ("power", (0.5, 100.0, None)),
    "power H=0.8 zeta=1000": ("power", (0.8, 1000.0, None)),
    "power H=0.8 zeta=5e4": ("power", (0.8, 5e4, None)),
    "power H=0.05 zeta=1e8": ("power", (0.05, 1e8, None)),
    "power H=0.8 zeta=1e8": ("power", (0.8, 1e8, None)),
    "power H=1 zeta=1e8": ("power", (1.0, 1e8, None)),
    "rolloff H=0.8 zeta=1e4": ("power", (0.8, 1e4, 30.0)),
    "table": (
        "table",
        (
            (1.0, 1.5, 4.0, 11.0, 40.0, 90.0, 500.0),
            (1.0, 1.4, 0.02, 3e-4, 9e-6, 1e-7, 6e-10),
        ),
    ),
    "shell": ("shells", ((2.0,), (1.0,))),
    "two shells": ("shells", ((1.0, 1000.0), (1.0, 1e-4))),
    "five shells": (
        "shells",
        ((1.0, 2**0.5, 2.0, 5**0.5, 8**0.5), (1.0, 0.4, 0.2, 0.2, 0.05)),
    ),
}

NARROW, MIDDLE = (1e-3, 0.1, 3.0), (1e-4, 0.01, 1.0)
NEW, OLD = "afferrante2018", "almqvist2011"
# spectrum, variant, correction, gamma, p/(q0 h_rms), u/h_rms
CASES = (
    ("power H=0.8 zeta=1.001", NEW, "yang2008", 0.45, 0.065, NARROW),
    ("power H=0.05 zeta=1.001", OLD, "yang2008", 0.45, 1e-6, NARROW),
    ("power H=1 zeta=10", NEW, "yang2008", 0.45, 1e-6, NARROW),
    ("power H=1 zeta=10", OLD, "xu2024", 0.42, 0.3, NARROW),
    ("power H=0.5 zeta=100", NEW, "yang2008", 0.45, 20.0, (1e-5, 1e-3, 0.05)),
    ("power H=0.5 zeta=100", OLD, "wang2017", 0.5, 20.0, (1e-5, 1e-3, 0.05)),
    ("power H=0.8 zeta=1000", NEW, "yang2008", 0.45, 0.065, (*MIDDLE, 4.0)),
    ("power H=0.8 zeta=1000", NEW, "yang2008", 1.0, 0.065, MIDDLE),
    ("power H=0.8 zeta=1000", NEW, "wang2017", None, 0.065, MIDDLE),
    ("power H=0.8 zeta=1000", NEW, "xu2024", None, 0.065, MIDDLE),
    ("power H=0.8 zeta=1000", OLD, "xu2024", None, 2.0, MIDDLE),
    ("power H=0.8 zeta=5e4", NEW, "yang2008", 0.45, 0.065, (1e-6, *MIDDLE, 8.0)),
    ("power H=0.8 zeta=5e4", OLD, "yang2008", 0.45, 0.065, MIDDLE),
    ("power H=0.05 zeta=1e8", NEW, "yang2008", 0.45, 1e-6, NARROW),
    ("power H=0.05 zeta=1e8", OLD, "xu2024", None, 1.0, MIDDLE),
    ("power H=0.8 zeta=1e8", NEW, "yang2008", 0.45, 1e-3, MIDDLE),
    ("power H=1 zeta=1e8", NEW, "xu2024", None, 0.065, MIDDLE),
    ("power H=1 zeta=1e8", OLD, "wang2017", None, 1e-6, NARROW),
    ("rolloff H=0.8 zeta=1e4", NEW, "yang2008", 0.45, 0.01, NARROW),
    ("rolloff H=0.8 zeta=1e4", OLD, "xu2024", None, 3.0, NARROW),
    ("table", NEW, "yang2008", 0.45, 0.1, NARROW),
    ("table", OLD, "wang2017", None, 1e-4, NARROW),
    ("shell", NEW, "yang2008", 0.45, 0.3, NARROW),
    ("two shells", NEW, "yang2008", 0.45, 0.1, (1e-3, 0.03, 1.0)),
    ("two shells", OLD, "yang2008", 0.45, 1.0, (1e-3, 0.03, 1.0)),
    ("five shells", NEW, "wang2017", None, 0.05, NARROW),
    ("five shells", OLD, "yang2008", 0.45, 1e-6, NARROW),
    ("five shells", NEW, "xu2024", None, 3.0, (1e-4, 1e-2, 0.3)),
)
DENSITY = 1.5  # width of panels, in ln(q/q_m - 1) and such
OWN_GAMMA = {"yang2008": (9, 20), "wang2017": (5, 9), "xu2024": (9, 20)}


@lru_cache
def gauss_legendre(order):
    """Nodes on (-1, 1) and weights."""
    found = []
    for i in range(order):
        x = mp.cos(mp.pi * (i + mpf(3) / 4) / (order + mpf(1) / 2))
        for _ in range(8):
            here, before = mp.legendre(order, x), mp.legendre(order - 1, x)
            slope = order * (before - x * here) / (1 - x * x)
            x -= here / slope
        found.append((x, 2 / ((1 - x * x) * slope**2)))
    return tuple(found)


class Tail:
    """Integral of f(t) dt/t from x to the last edge, by Chebyshev series cell by cell."""

    def __init__(self, f, edges, above, degree=16):
        self.edges, self.cells = edges, []
        angles = [mp.pi * (2 * k + 1) / (2 * degree) for k in range(degree)]
        cosines = [[mp.cos(j * angle) for angle in angles] for j in range(degree)]
        total = above
        for low, high in reversed(list(zip(edges[:-1], edges[1:], strict=True))):
            middle, half = (mp.log(low) + mp.log(high)) / 2, (mp.log(high) - mp.log(low)) / 2
            values = [f(mp.exp(middle + half * c)) for c in cosines[1]]
            series = [
                2 * mp.fsum(v * c for v, c in zip(values, row, strict=True)) / degree
                for row in cosines
            ]
            series += [mpf(0)] * 2
            series[0] /= 2
            twice = [2 * series[0], *series[1:]]
            integral = [(twice[j - 1] - twice[j + 1]) / (2 * j) for j in range(1, degree)]
            at_end = mp.fsum(integral)
            at_start = mp.fsum(c * (-1) ** (j + 1) for j, c in enumerate(integral))
            cell = [mpf(0)] + [c * half for c in integral]
            self.cells.append((middle, half, cell, total + half * at_end, series[:degree]))
            total += half * (at_end - at_start)
        self.cells.reverse()

    def both(self, x):
        """The integral and the integrand f(x)."""
        i = min(max(bisect_right(self.edges, x) - 1, 0), len(self.cells) - 1)
        middle, half, integral, end, integrand = self.cells[i]
        t = (mp.log(x) - middle) / half
        return end - clenshaw(integral, t), clenshaw(integrand, t)

    def __call__(self, x):
        return self.both(x)[0]


def clenshaw(series, t):
    """Sum of a Chebyshev series."""
    b1 = b2 = mpf(0)
    twice = 2 * t
    for c in reversed(series):
        b1, b2 = c + twice * b1 - b2, b1
    return b1 - t * b2


class Universal:
    """Corrected diffusion S, energy K and their integrals T and F, for one correction."""

    def __init__(self, correction, gamma):
        self.correction, self.gamma = correction, gamma
        low = [mpf("1e-16") * mp.exp(mpf(i) / 2) for i in range(73)]
        edges = [x for x in low if x < 1.0]
        while edges[-1] < 30:
            edges.append(min(edges[-1] * mp.exp(mpf(1) / 4), mp.sqrt(edges[-1] ** 2 + 2)))
        self.T = Tail(lambda t: 2 / (t**2 * self.S(t)), edges, edges[-1] ** -2)
        self.F = Tail(lambda t: self.K(t) * mp.exp(-t * t), edges, mpf(0))

    def S(self, y):
        """As printed, or from the printed area law."""
        area, gamma = mp.erf(y), self.gamma
        if self.correction == "yang2008":
            return gamma + (1 - gamma) * area**2
        if self.correction == "wang2017":
            return gamma - mpf(2) / 9 * area**2 + (mpf(11) / 9 - gamma) * area**4
        # dV_eff/dV with V_eff = 1/y^2 and V = 1/(y^2 g)
        g, g_slope = gamma + (1 - gamma) * area, (1 - gamma) * self.density(y)
        return (-2 / y**3) / (-2 / (y**3 * g) - g_slope / (y * g) ** 2)

    def K(self, y):
        """d(A S)/dA."""
        area, gamma = mp.erf(y), self.gamma
        if self.correction == "yang2008":
            return gamma + 3 * (1 - gamma) * area**2
        if self.correction == "wang2017":
            return gamma - mpf(2) / 3 * area**2 + 5 * (mpf(11) / 9 - gamma) * area**4
        step = y * mpf("1e-9")
        with mp.workdps(50):
            around = [(mp.erf(y + k * step) * self.S(y + k * step)) for k in (-2, -1, 1, 2)]
            slope = (8 * (around[2] - around[1]) - (around[3] - around[0])) / (12 * step)
            return +(slope / self.density(y))

    @staticmethod
    def density(y):
        """d erf(y)/dy."""
        return 2 / mp.sqrt(mp.pi) * mp.exp(-y * y)


@lru_cache
def universal(correction, gamma):
    """One `Universal` per correction."""
    return Universal(correction, gamma)


def power_integral(level, knot, exponent, a, b):
    """Integral of level (q/knot)^exponent from a to b."""
    if exponent == -1:
        return level * knot * mp.log(b / a)
    e = exponent + 1
    return level * knot / e * ((b / knot) ** e - (a / knot) ** e)


class Continuous:
    """C(q) of adjoining power laws."""

    def __init__(self, knots, level, exponent):
        self.knots, self.level, self.exponent = knots, level, exponent
        self.q0, self.q1 = knots[0], knots[-1]
        self.h_rms = mp.sqrt(2 * mp.pi * self.integral(1, self.q0, self.q1))
        self.M = mp.pi * self.integral(3, self.q0, self.q1)

    def piece(self, q):
        return min(max(bisect_right(self.knots, q) - 1, 0), len(self.level) - 1)

    def C(self, q):
        i = self.piece(q)
        return self.level[i] * (q / self.knots[i]) ** self.exponent[i]

    def integral(self, power, a, b):
        """Integral of q^power C from a to b."""
        parts = []
        for i, level in enumerate(self.level):
            low, high = max(a, self.knots[i]), min(b, self.knots[i + 1])
            if low < high:
                knot = self.knots[i]
                exponent = self.exponent[i] + power
                parts.append(power_integral(level * knot**power, knot, exponent, low, high))
        return mp.fsum(parts)

    def at(self, m):
        """Wave number up to which pi int q^3 C is m."""
        i = 0
        while i < len(self.level) - 1:
            part = mp.pi * self.integral(3, self.knots[i], self.knots[i + 1])
            if part > m:
                break
            m, i = m - part, i + 1
        knot, e = self.knots[i], self.exponent[i] + 4
        share = m / (mp.pi * self.level[i] * knot**4)
        return knot * (mp.exp(share) if e == 0 else (1 + e * share) ** (1 / e))

    def height_variance(self, m):
        """Of what is finer than m."""
        return 2 * mp.pi * self.integral(1, self.at(m), self.q1)

    def gap(self, kernel, m, P, dP, density):
        """Mean gap seen from m on and its derivative with respect to m."""
        a, rest = self.at(m), self.M - m
        smallest = P**2 / (P**2 / rest + 70)
        start = mp.log(self.at(m + smallest) / a - 1) if smallest < rest else None
        end = mp.log(self.q1 / a - 1)
        start = end - 3 if start is None else min(start, end - mpf(1) / 100)
        stops = sorted(mp.log(k / a - 1) for k in self.knots if k > a)
        edges = [start]
        for stop in (x for x in stops if x > start):
            count = int(mp.ceil((stop - edges[-1]) / density)) or 1
            begin = edges[-1]
            edges += [begin + (stop - begin) * k / count for k in range(1, count + 1)]
        value, slope = mpf(0), mpf(0)
        for low, high in zip(edges[:-1], edges[1:], strict=True):
            i = self.piece(a * (1 + mp.exp((low + high) / 2)))
            knot, level, exponent = self.knots[i], self.level[i], self.exponent[i]
            before = mp.pi * self.integral(3, self.q0, knot) - m
            for x, weight in gauss_legendre(16):
                r = mp.exp((low + high) / 2 + (high - low) / 2 * x)
                q = a * (1 + r)
                C = level * (q / knot) ** exponent
                if exponent == -4:
                    D = before + mp.pi * level * knot**4 * mp.log(q / knot)
                else:
                    D = before + mp.pi * (C * q**4 - level * knot**4) / (exponent + 4)
                root = mp.sqrt(D)
                F, turn = kernel.F.both(P / root)  # turn = -x F'
                turn *= root / P
                share = weight * (high - low) / 2 * a * r * q**2 * C
                value += share * F / root
                slope += share * (F / (2 * root * D) - turn * (dP / D + P / (2 * D * D)))
        return mp.sqrt(mp.pi) * value, mp.sqrt(mp.pi) * slope


class Shells:
    """Height variance on shells of one wave number each, which m passes through evenly."""

    def __init__(self, q, variance):
        self.q, self.variance = q, variance
        self.q0, self.q1 = q[0], q[-1]
        self.h_rms = mp.sqrt(mp.fsum(variance))
        self.upto = [
            mp.fsum(v * k * k for k, v in zip(q[: i + 1], variance, strict=False)) / 2
            for i in range(len(q))
        ]
        self.M = self.upto[-1]

    def height_variance(self, m):
        """Of what is finer than m."""
        i = min(bisect_right(self.upto, m), len(self.q) - 1)
        return mp.fsum(self.variance[i + 1 :]) + 2 * (self.upto[i] - m) / self.q[i] ** 2

    def gap(self, kernel, m, P, dP, density):
        """Mean gap seen from m on and its derivative with respect to m."""
        value, slope = mpf(0), mpf(0)
        start, rest = mpf(0), self.M - m
        smallest = P**2 / (P**2 / rest + 70)
        for q, upto in zip(self.q, self.upto, strict=True):
            if upto <= m:
                continue
            stop = upto - m
            low, high = mp.log(max(start, smallest)), mp.log(stop)
            if high > low:
                count = int(mp.ceil((high - low) / density))
                part = inner = mpf(0)
                for k in range(count):
                    half = (high - low) / (2 * count)
                    for x, weight in gauss_legendre(16):
                        D = mp.exp(low + half * (2 * k + 1 + x))
                        root = mp.sqrt(D)
                        F, turn = kernel.F.both(P / root)  # turn = -x F'
                        part += weight * half * root * F
                        inner -= weight * half * turn * root / P * dP
                value += part / q
                slope += inner / q
                slope -= kernel.F(P / mp.sqrt(stop)) / mp.sqrt(stop) / q
                if start > smallest:
                    slope += kernel.F(P / mp.sqrt(start)) / mp.sqrt(start) / q
            start = stop
        return value / mp.sqrt(mp.pi), slope / mp.sqrt(mp.pi)


def spectrum_of(name):
    """The spectrum in multiprecision; power laws have h_rms = 1 and q0 = 1."""
    kind, values = SPECTRA[name]
    if kind == "shells":
        return Shells(*([mpf(x) for x in column] for column in values))
    if kind == "table":
        q, C = ([mpf(x) for x in column] for column in values)
        slopes = [mp.log(C[i + 1] / C[i]) / mp.log(q[i + 1] / q[i]) for i in range(len(q) - 1)]
        return Continuous(q, C[:-1], slopes)
    hurst, magnification, rolloff = (x if x is None else mpf(x) for x in values)
    slope = -2 * (hurst + 1)
    knots, level, exponent = [mpf(1), magnification], [mpf(1)], [slope]
    if rolloff is not None:
        knots.insert(1, rolloff)
        level, exponent = [rolloff**slope] * 2, [mpf(0), slope]
    h2 = Continuous(knots, level, exponent).h_rms ** 2
    return Continuous(knots, [x / h2 for x in level], exponent)


class Theory:
    """One spectrum at one load."""

    def __init__(self, spectrum, variant, kernel, p, density):
        self.spectrum, self.variant, self.kernel, self.p = spectrum, variant, kernel, p
        self.density, self.order = density, 14 if density == DENSITY else 20
        target = mp.log(spectrum.M / p**2)
        self.y_end = mp.exp(
            mp.findroot(
                lambda v: mp.log(kernel.T(mp.exp(v))) - target,
                (-target / 2, -target / 2 + mpf("0.1")),
                tol=mpf("1e-50"),
            )
        )

    def area(self):
        return mp.erf(self.y_end)

    def mean_gap(self):
        return self.spectrum.gap(self.kernel, mpf(0), self.p, mpf(0), self.density)[0]

    @cache  # noqa: B019 - one theory at a time
    def lost(self, log_step):
        """u1 and the width where A = erf(y_end + step)."""
        y = self.y_end + mp.exp(log_step)
        m = self.p**2 * self.kernel.T(y)
        area, slope = mp.erf(y), self.kernel.density(y)
        slope *= -(y**3) * self.kernel.S(y) / (2 * self.p**2)  # dA/dm
        P = self.p / area
        gap, gap_slope = self.spectrum.gap(self.kernel, m, P, -P * slope / area, self.density)
        u1 = gap + gap_slope * area / slope
        h = mp.sqrt(self.spectrum.height_variance(m))
        return u1, h if self.variant == OLD else u1 * h / mp.sqrt(u1**2 + h**2)

    def breaks(self):
        """Steps at which the wave number is not a smooth function of m."""
        s = self.spectrum
        if isinstance(s, Shells):
            inner = s.upto[:-1]
        else:
            inner = [mp.pi * s.integral(3, s.q0, k) for k in s.knots[1:-1]]
        found = []
        for m in inner:
            target = mp.log(m / self.p**2)
            guess = -target / 2
            y = mp.exp(
                mp.findroot(
                    lambda v, t=target: mp.log(self.kernel.T(mp.exp(v))) - t, (guess, guess + 0.1)
                )
            )
            P = self.p / mp.erf(y)
            found.append(mp.log(y - self.y_end))
            if isinstance(s, Shells):
                found += self.approach(m, P)
        return found

    def approach(self, m, P):
        """Steps that close in on a shell from its coarse side."""
        found = []
        for k in range(24):
            before = m - P**2 / mpf(2) ** k
            if before > m / 1000:
                target = mp.log(before / self.p**2)
                y = mp.exp(
                    mp.findroot(
                        lambda v, t=target: mp.log(self.kernel.T(mp.exp(v))) - t,
                        (-target / 2, -target / 2 + mpf("0.1")),
                    )
                )
                found.append(mp.log(y - self.y_end))
        return found

    def distribution(self, gaps):
        """Density and cumulative distribution at the `gaps`."""
        high = mp.log(mp.sqrt(self.y_end**2 + 45) - self.y_end)
        low = high
        while True:  # down to where the Gaussians are points next to the smallest gap
            u1, width = self.lost(low)
            if u1 + 12 * width < min(gaps):
                break
            low -= mpf(3) / 4
        panels = sorted({low, high, *(b for b in self.breaks() if low < b < high)})
        panels = [self.split(a, b, max(gaps)) for a, b in zip(panels[:-1], panels[1:], strict=True)]
        density, cumulative = [mpf(0)] * len(gaps), [mpf(0)] * len(gaps)
        for a, b in (pair for part in panels for pair in part):
            for x, weight in gauss_legendre(self.order):
                t = (a + b) / 2 + (b - a) / 2 * x
                y = self.y_end + mp.exp(t)
                share = weight * (b - a) / 2 * mp.exp(t) * self.kernel.density(y)
                u1, width = self.lost(t)
                for i, u in enumerate(gaps):
                    left, right = (u - u1) / width, (u + u1) / width
                    pair = mp.exp(-(left**2) / 2) + mp.exp(-(right**2) / 2)
                    density[i] += share * pair / (mp.sqrt(2 * mp.pi) * width)
                    pair = mp.erf(left / mp.sqrt(2)) + mp.erf(right / mp.sqrt(2))
                    cumulative[i] += share * pair / 2
        closed = mp.erf(self.y_end + mp.exp(low)) - mp.erf(self.y_end)
        return density, [c + closed for c in cumulative]

    def split(self, a, b, largest):
        """Panels over which the Gaussians move and widen little, those far off left out."""
        (u_a, w_a), (u_b, w_b) = self.lost(a), self.lost(b)
        if min(u_a - 12 * w_a, u_b - 12 * w_b) > largest and b - a < 1:
            return []
        move = abs(min(u_a, largest + 12 * w_a) - min(u_b, largest + 12 * w_b)) / min(w_a, w_b)
        tail = mp.exp(2 * b) - mp.exp(2 * a) + 2 * self.y_end * (mp.exp(b) - mp.exp(a))
        if (max(abs(mp.log(w_a / w_b)), move, tail) < 3 and b - a < 2) or b - a < mpf("1e-3"):
            return [(a, b)]
        middle = (a + b) / 2
        return self.split(a, middle, largest) + self.split(middle, b, largest)


def rows(case, density):
    """Lines of the table for one case."""
    name, variant, correction, gamma, load, gaps = case
    spectrum = spectrum_of(name)
    gamma_used = mpf(gamma) if gamma else mpf(OWN_GAMMA[correction][0]) / OWN_GAMMA[correction][1]
    kernel = universal(correction, gamma_used)
    theory = Theory(spectrum, variant, kernel, mpf(load) * spectrum.q0 * spectrum.h_rms, density)
    at = [mpf(u) * spectrum.h_rms for u in gaps]
    density_at, cumulative = theory.distribution(at)
    area, mean_gap = theory.area(), theory.mean_gap()
    for u, P, share in zip(gaps, density_at, cumulative, strict=True):
        values = (1 - area, area, mean_gap / spectrum.h_rms, P * spectrum.h_rms, share)
        yield [name, variant, correction, "" if gamma is None else gamma, load, u] + [
            mp.nstr(value, 15) for value in values
        ]


HEADER = [
    *("spectrum", "variant", "correction", "gamma", "pressure", "gap"),
    *("lost_fraction", "area_fraction", "mean_gap", "gap_density", "gap_cumulative"),
]


def main():
    mp.dps = 30
    with TABLE.open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(HEADER)
        for case in CASES:
            writer.writerows(rows(case, DENSITY))


if __name__ == "__main__":
    main()
