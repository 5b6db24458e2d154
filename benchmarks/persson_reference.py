"""Reference values of Persson's contact theory, by mpmath with 30 digits.

This program shares nothing with the library. It is written from the relations as published: the
pressure diffuses by dV_eff = S(A) dV; the mean gap seen from a magnification on takes the elastic
energy d(A S)/dA; P(u) is the integral of its pair of Gaussians over the area lost. Where the
library integrates by parts over -1/q and takes derivatives in closed form, this program integrates
over the slope variance and differentiates numerically. The quadratures are composite
Gauss-Legendre; with half again as many nodes values change by less than 1e-10 of themselves.

Writes tests/data/persson_reference.csv in about a quarter of an hour::

    python benchmarks/persson_reference.py
"""

import csv
from bisect import bisect_right
from functools import cache, lru_cache
from itertools import accumulate, pairwise
from pathlib import Path

from mpmath import mp, mpf
from numpy.polynomial.legendre import leggauss

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
OWN_GAMMA = {"yang2008": (9, 20), "wang2017": (5, 9), "xu2024": (9, 20)}
DEGREE = 16  # terms of the polynomials


@cache
def gauss_legendre(order):
    """Nodes on (-1, 1) and weights, whose 16 digits are more than the table keeps."""
    return [(mpf(float(x)), mpf(float(weight))) for x, weight in zip(*leggauss(order), strict=True)]


class Tail:
    """Integral of f(t) dt/t from x to infinity, by polynomials in ln t from edge to edge."""

    def __init__(self, f, above):
        # `above` is the integral as a function of the last edge
        edges = [mpf("1e-16") * mp.exp(mpf(i) / 2) for i in range(74)]
        while edges[-1] < 30:
            edges.append(min(edges[-1] * mp.exp(mpf(1) / 4), mp.sqrt(edges[-1] ** 2 + 2)))
        self.edges, self.cells, total = edges, [], above(edges[-1])
        for low, high in reversed(list(pairwise(edges))):
            middle, half = mp.log(low * high) / 2, mp.log(high / low) / 2
            values = cache(lambda t, m=middle, h=half: f(mp.exp(m + h * t)))
            series = mp.chebyfit(values, [-1, 1], DEGREE)  # highest power first
            integral = [-half * c / (DEGREE - k) for k, c in enumerate(series)]
            integral.append(total - mp.fsum(integral))
            total = mp.polyval(integral, -1)
            self.cells.insert(0, (middle, half, integral))

    def __call__(self, x):
        middle, half, integral = self.cells[
            min(max(bisect_right(self.edges, x) - 1, 0), len(self.cells) - 1)
        ]
        return mp.polyval(integral, (mp.log(x) - middle) / half)


def density(y):
    """d erf(y)/dy."""
    return 2 / mp.sqrt(mp.pi) * mp.exp(-y * y)


class Kernel:
    """Integrals T of the corrected diffusion S and F of the energy d(A S)/dA."""

    def __init__(self, correction, gamma):
        self.correction, self.gamma = correction, gamma
        self.T = Tail(lambda t: 2 / (t**2 * self.S(t)), lambda last: last**-2)
        self.F = Tail(lambda t: self.energy(t) * mp.exp(-t * t), lambda last: mpf(0))

    def S(self, y):
        """As printed, or from the printed area law."""
        area, gamma = mp.erf(y), self.gamma
        if self.correction == "yang2008":
            return gamma + (1 - gamma) * area**2
        if self.correction == "wang2017":
            return gamma - mpf(2) / 9 * area**2 + (mpf(11) / 9 - gamma) * area**4
        # dV_eff/dV with V_eff = 1/y^2 and V = 1/(y^2 g)
        g, g_slope = gamma + (1 - gamma) * area, (1 - gamma) * density(y)
        return (-2 / y**3) / (-2 / (y**3 * g) - g_slope / (y * g) ** 2)

    def energy(self, y):
        step = y * mpf("1e-12")
        with mp.workdps(60):
            rise = mp.erf(y + step) * self.S(y + step) - mp.erf(y - step) * self.S(y - step)
            return +(rise / (2 * step * density(y)))


kernel_of = lru_cache(Kernel)


class Continuous:
    """C(q) of adjoining power laws. `m` is pi int q^3 C up to a wave number, `knots` are its."""

    shells = False

    def __init__(self, q, level, exponent):
        self.q, self.level, self.exponent = q, level, exponent
        self.q0 = q[0]
        parts = [mp.pi * self.integral(3, a, b) for a, b in pairwise(q)]
        self.knots = list(accumulate(parts, initial=mpf(0)))
        self.h_rms = mp.sqrt(self.height_variance(mpf(0)))

    def integral(self, power, start, stop):
        """Integral of q^power C."""
        total = mpf(0)
        for (a, b), level, exponent in zip(
            pairwise(self.q), self.level, self.exponent, strict=True
        ):
            low, high, e = max(a, start), min(b, stop), exponent + power + 1
            if low < high:
                ends = mp.log(high / low) if e == 0 else ((high / a) ** e - (low / a) ** e) / e
                total += level * a ** (power + 1) * ends
        return total

    def wave_number(self, m):
        i = min(bisect_right(self.knots, m), len(self.level)) - 1
        e = self.exponent[i] + 4
        share = (m - self.knots[i]) / (mp.pi * self.level[i] * self.q[i] ** 4)
        return self.q[i] * (mp.exp(share) if e == 0 else (1 + e * share) ** (1 / e))

    def height_variance(self, m):
        """Of what is finer than m."""
        return 2 * mp.pi * self.integral(1, self.wave_number(m), self.q[-1])


class Shells:
    """Height variance on shells of one wave number each, which m passes through evenly."""

    shells = True

    def __init__(self, q, variance):
        self.q, self.variance, self.q0 = q, variance, q[0]
        parts = [v * k * k / 2 for k, v in zip(q, variance, strict=True)]
        self.knots = list(accumulate(parts, initial=mpf(0)))
        self.h_rms = mp.sqrt(mp.fsum(variance))

    def shell(self, m):
        return min(bisect_right(self.knots, m), len(self.q)) - 1

    def wave_number(self, m):
        return self.q[self.shell(m)]

    def height_variance(self, m):
        """Of what is finer than m."""
        i = self.shell(m)
        return mp.fsum(self.variance[i + 1 :]) + 2 * (self.knots[i + 1] - m) / self.q[i] ** 2


def spectrum_of(name):
    """The spectrum in multiprecision; power laws have h_rms = 1 and q0 = 1."""
    kind, values = SPECTRA[name]
    if kind == "shells":
        return Shells(*([mpf(x) for x in column] for column in values))
    if kind == "table":
        q, C = ([mpf(x) for x in column] for column in values)
        slopes = [
            mp.log(c / b) / mp.log(k / j)
            for (j, k), (b, c) in zip(pairwise(q), pairwise(C), strict=True)
        ]
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

    def __init__(self, spectrum, variant, kernel, p):
        self.spectrum, self.variant, self.kernel, self.p = spectrum, variant, kernel, p
        self.y_end = self.y_at(spectrum.knots[-1])

    def y_at(self, m):
        """Where A = erf(y): p^2 T(y) = m."""
        target = mp.log(m / self.p**2)
        ends = (-target / 2, -target / 2 + mpf("0.1"))
        return mp.exp(mp.findroot(lambda v: mp.log(self.kernel.T(mp.exp(v))) - target, ends))

    def area(self):
        return mp.erf(self.y_end)

    def mean_gap(self):
        return self.gap(mpf(0), self.p)

    def gap(self, m, P):
        """Mean gap seen from m on: int F(P/D^1/2)/(pi D)^1/2 dD/q over the D = m' - m beyond."""
        knots, q = self.spectrum.knots, self.spectrum.wave_number
        rest = knots[-1] - m
        smallest = P**2 / (P**2 / rest + 70)
        stops = [mp.log(knot - m) for knot in knots if knot - m > smallest]
        value = mpf(0)
        for a, b in pairwise([mp.log(smallest), *stops]):
            count = int(mp.ceil(b - a))
            half = (b - a) / (2 * count)
            for k in range(count):
                for x, weight in gauss_legendre(16):
                    D = mp.exp(a + half * (2 * k + 1 + x))
                    root = mp.sqrt(D)
                    value += weight * half * root * self.kernel.F(P / root) / q(m + D)
        return value / mp.sqrt(mp.pi)

    @cache  # noqa: B019 - one theory at a time
    def lost(self, log_step):
        """u1 = d(A gap)/dA and the width where A = erf(y_end + step)."""
        y, change = self.y_end + mp.exp(log_step), mp.exp(log_step) * mpf("1e-11")
        with mp.workdps(60):  # near full contact A is 1 but for some 1e-30
            below, above = (
                mp.erf(v) * self.gap(self.p**2 * self.kernel.T(v), self.p / mp.erf(v))
                for v in (y - change, y + change)
            )
            u1 = (above - below) / (2 * change * density(y))
        h = mp.sqrt(self.spectrum.height_variance(self.p**2 * self.kernel.T(y)))
        return u1, h if self.variant == OLD else u1 * h / mp.sqrt(u1**2 + h**2)

    def breaks(self):
        """Steps at which the wave number is not smooth in m, closing in on shells from below."""
        for m in self.spectrum.knots[1:-1]:
            y = self.y_at(m)
            yield mp.log(y - self.y_end)
            P = self.p / mp.erf(y)
            near = [m - P**2 / mpf(2) ** k for k in range(24)] if self.spectrum.shells else []
            yield from (mp.log(self.y_at(b) - self.y_end) for b in near if b > m / 1000)

    def distribution(self, gaps):
        """Density and cumulative distribution at the `gaps`."""
        low = high = mp.log(mp.sqrt(self.y_end**2 + 45) - self.y_end)
        while True:  # down to where the Gaussians are points next to the smallest gap
            u1, width = self.lost(low)
            if u1 + 12 * width < min(gaps):
                break
            low -= mpf(3) / 4
        stops = sorted({low, high, *(b for b in self.breaks() if low < b < high)})
        density_at = [mpf(0)] * len(gaps)
        cumulative = [mp.erf(self.y_end + mp.exp(low)) - mp.erf(self.y_end)] * len(gaps)
        for a, b in (panel for ends in pairwise(stops) for panel in self.split(*ends, max(gaps))):
            for x, weight in gauss_legendre(14):
                t = (a + b) / 2 + (b - a) / 2 * x
                share = weight * (b - a) / 2 * mp.exp(t) * density(self.y_end + mp.exp(t))
                u1, width = self.lost(t)
                for i, u in enumerate(gaps):
                    left, right = (u - u1) / width, (u + u1) / width
                    density_at[i] += share * (mp.npdf(left) + mp.npdf(right)) / width
                    cumulative[i] += share * (mp.ncdf(left) + mp.ncdf(right) - 1)
        return density_at, cumulative

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


def theory_of(case):
    """Theory of one case."""
    name, variant, correction, gamma, load, _ = case
    spectrum = spectrum_of(name)
    numerator, denominator = OWN_GAMMA[correction]
    kernel = kernel_of(correction, mpf(gamma) if gamma else mpf(numerator) / denominator)
    return Theory(spectrum, variant, kernel, mpf(load) * spectrum.q0 * spectrum.h_rms)


def rows(case):
    """Lines of the table for one case."""
    theory, gaps = theory_of(case), case[-1]
    h = theory.spectrum.h_rms
    area, mean_gap = theory.area(), theory.mean_gap()
    found = theory.distribution([mpf(u) * h for u in gaps])
    for u, P, share in zip(gaps, *found, strict=True):
        values = (1 - area, area, mean_gap / h, P * h, share)
        yield [*("" if x is None else x for x in case[:-1]), u, *(mp.nstr(v, 15) for v in values)]


HEADER = [
    *("spectrum", "variant", "correction", "gamma", "pressure", "gap"),
    *("lost_fraction", "area_fraction", "mean_gap", "gap_density", "gap_cumulative"),
]


def main():
    with TABLE.open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(HEADER)
        for case in CASES:
            writer.writerows(rows(case))


if __name__ == "__main__":
    mp.dps = 30
    main()
