"""Several measurements stitched to one spectrum; moments of a spectrum with their errors.

Where measurements overlap, ln C is averaged with weights 1/(sampling variance + tau^2), in which
tau is the scatter between measurements: place, calibration, instrument (Jacobs, Junge & Pastewka
2017, doi:10.1088/2051-672X/aa51f8, recommend geometric averages of spectra). Errors of moments come
from drawing spectra that agree with the measured one: rings vary by their sampling error,
measurements by their scatter, extrapolation and plateau by the covariance of the fit.

Between the bands of two measurements there may be a gap. There C is taken to stay level up to a
corner and to fall as a power law from there to the next band, no faster than q^-4 (H = 1). Where
the corner lies is not known: it is spread evenly over the orders of magnitude.

Waves that the instrument does not resolve store elastic energy, most of it for H < 1/2, where the
integral of q^2 C grows without end. They continue the last octave that was measured. Their Hurst
exponent lies between that of the fit and that of the last two octaves, which differ where the
spectrum follows features, such as scratches or flat tops, rather than a law; it is kept within
`HURST_BEYOND`. Where the waves end is not known: spectra are drawn whose ends are spread evenly
over the orders of magnitude between the cutoff and a wave number given, or that at which the rms
slope reaches a largest value.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import special

from stickiness.measured.instrument_spectrum import MeasuredSpectrum, ring_areas
from stickiness.measured.psd import RadialPSD
from stickiness.measured.self_affine_fit import SelfAffineFit, fit_rings
from stickiness.spectrum.direction import expm1_over
from stickiness.spectrum.family import SpectrumFamily

RINGS = 20  #: per decade
SHORTEST_WAVE = 0.3e-9  #: [m]; the distance of atoms, where any roughness ends
#: Energy of unresolved waves over that of the others, above which they decide.
MOST_UNRESOLVED = 0.5
STEEPEST_EXPONENT = 4.0  #: of C ~ q^-s in a gap: H = 1
HURST_BEYOND = (0.3, 1.0)  #: between which the Hurst exponent beyond the cutoff is kept
OCTAVES = 2  #: below the cutoff, which tell the local exponent
REFERENCE_EXPONENT = 3.6  #: of C ~ q^-s, taken out before a mean over a ring: H = 0.8


@dataclass(frozen=True)
class Gap:
    """Wave numbers between the bands of two measurements, and ln C at both ends, `(2,)` each."""

    q: NDArray  #: [1/length]
    log_psd: NDArray
    log_psd_se: NDArray

    def contains(self, q: NDArray) -> NDArray:
        """Which rings lie within; those at the ends belong to the measurements."""
        low, high = self.inside
        return (q > low) & (q < high)

    @property
    def inside(self) -> NDArray:
        """Ends, half a ring from the bands."""
        half = 10 ** (0.5 / RINGS)
        return self.q * [half, 1 / half]

    def bridge(self, q: NDArray, corner: ArrayLike, log_psd: NDArray) -> NDArray:
        """Return ln C at q (m,) by its values at both ends and the place of the corner.

        `corner` goes from 0, at the first end, to 1, at the last place possible. It may be (n,) and
        `log_psd` (n, 2); the result is then (n, m).
        """
        low, high = np.log(self.q)
        start, end = np.moveaxis(np.asarray(log_psd)[..., None], -2, 0)
        # The last corner is that from which the steepest law meets the next band.
        last = high - np.clip((start - end) / STEEPEST_EXPONENT, 0.0, high - low)
        last = np.where(start > end, last, low)
        place = low + np.asarray(corner)[..., None] * (last - low)
        return start + (end - start) * np.maximum(np.log(q) - place, 0.0) / (high - place)

    def variance(self, q: NDArray) -> NDArray:
        """Variance of ln C at q (m,), of the ends and of the corner."""
        first, last = self.bridge(q, np.array([0.0, 1.0]), np.array([self.log_psd] * 2))
        ends = np.interp(np.log(q), np.log(self.q), self.log_psd_se**2)
        return ends + (last - first) ** 2 / 12


@dataclass(frozen=True, kw_only=True)
class Stitched(MeasuredSpectrum):
    """Several measurements of one surface as one spectrum; `fit` has the scatter in its errors."""

    levels: NDArray  #: (k, m), C of each measurement in the rings, NaN outside its band
    #: (k,), mean of ln C less the stitched one where measurements overlap, else NaN
    offsets: NDArray
    #: (k, m), weight of each measurement in each ring; they add up to 1, in a gap to 0
    shares: NDArray
    scatter: float  #: tau, standard deviation of their ln C; NaN if no two overlap
    gaps: tuple[Gap, ...]  #: between the bands of the measurements

    @property
    def in_gap(self) -> NDArray:
        """Which rings lie in a gap, (m,)."""
        return np.any([gap.contains(self.rings.q) for gap in self.gaps], axis=0)


def stitch(measurements: Sequence[MeasuredSpectrum]) -> MeasuredSpectrum:
    """Log-average measurements of one surface into one `Stitched` spectrum; a single one stays.

    Measurements that are not trusted have levels and offsets, but no weight, unless none is.
    """
    if len(measurements) == 1:
        return measurements[0]
    if not any(m.trusted for m in measurements):
        measurements = [replace(m, trusted=True) for m in measurements]
    trusted = [m for m in measurements if m.trusted]
    lowest = min(m.lowest for m in trusted)
    top = max(trusted, key=lambda m: m.cutoff.q)
    band = (min(m.fit.q_min for m in trusted), top.cutoff.q)

    # The mean of ln C in common rings, and its fit.
    gaps = _find_gaps(trusted)
    logs, variances, q = _on_common_rings(measurements, gaps)
    tau2 = _variance_between(logs, variances)
    tau = float(np.sqrt(tau2))
    shares, rings = _average(q, logs, variances, tau2, gaps)
    narrow = _weigh_gaps(rings, gaps)
    fit = fit_rings(narrow, *band)

    # Offsets tilt the spectrum: add what raising each measurement by tau changes. So do corners in
    # gaps: add a sixth of what both ends of their even distribution change.
    others = []
    for raised in tau * np.eye(len(logs)) if tau > 0 else ():
        others.append((_average(q, logs + raised[:, None], variances, tau**2, gaps)[1], 1))
    for corner in (0.0, 1.0) if gaps else ():
        others.append((_average(q, logs, variances, tau2, gaps, corner)[1], 6))
    covariance = fit.log_covariance.copy()
    for other, divisor in others:
        change = _find_change(fit, _weigh_gaps(other, gaps), band)
        covariance += np.outer(change, change) / divisor

    # Where a measurement overlaps with others, how far it is off the mean.
    excess = logs - np.log(rings.psd) + _log_bias(rings.dof)
    shared = np.isfinite(logs) & (shares < 1)
    offsets = [e[s].mean() if s.any() else np.nan for e, s in zip(excess, shared, strict=True)]
    return Stitched(
        rings=rings,
        area=ring_areas(rings.q, lowest),
        narrow=narrow,
        fit=replace(fit, log_covariance=covariance),
        cutoff=replace(top.cutoff, q=fit.q_max),
        lowest=lowest,
        held=measurements[0].held,
        anisotropy=float(np.fmax.reduce([m.anisotropy for m in trusted])),
        levels=np.exp(logs + _log_bias(rings.dof)),
        offsets=np.array(offsets),
        shares=shares,
        scatter=tau,
        gaps=tuple(gaps),
    )


def _find_gaps(measurements: Sequence[MeasuredSpectrum]) -> list[Gap]:
    """Gaps between the bands of measurements that span two rings or more."""
    gaps = []
    by_band = sorted(measurements, key=lambda m: m.fit.q_min)
    below = by_band[0]
    for above in by_band[1:]:
        if above.fit.q_min > below.cutoff.q * 10 ** (2 / RINGS):
            ends = [(below.fit, below.cutoff.q), (above.fit, above.fit.q_min)]
            q = np.array([end for _, end in ends])
            psd = np.array([fit.psd(end) for fit, end in ends])
            errors = np.array([fit.log_psd_se([end])[0] for fit, end in ends])
            gaps.append(Gap(q, np.log(psd), errors))
        below = max(below, above, key=lambda m: m.cutoff.q)
    return gaps


def _weigh_gaps(rings: RadialPSD, gaps: Sequence[Gap]) -> RadialPSD:
    """Rings for the fit: all those of a gap count as three, since three numbers describe them."""
    dof = rings.dof.copy()
    for gap in gaps:
        inside = gap.contains(rings.q)
        dof[inside] *= min(3 / max(np.count_nonzero(inside), 1), 1.0)
    return replace(rings, dof=dof)


def _find_change(fit: SelfAffineFit, rings: RadialPSD, band: tuple[float, float]) -> list[float]:
    """Return what other rings change in the logarithms of the parameters of a fit, and in H."""
    has_plateau = fit.q_rolloff is not None
    changed = fit_rings(rings, *band, rolloff=has_plateau)
    change = [np.log(changed.c0 / fit.c0), changed.hurst - fit.hurst]
    if has_plateau:
        change.append(np.log(changed.q_rolloff / fit.q_rolloff))
    return change


def _on_common_rings(
    measurements: Sequence[MeasuredSpectrum], gaps: Sequence[Gap]
) -> tuple[NDArray, NDArray, NDArray]:
    """Logarithm of C and its variance (k, m), NaN where there are no data; wave numbers (m,).

    The variance is infinite where a measurement is not trusted.
    """
    trusted = [m for m in measurements if m.trusted]
    broadest = min(trusted, key=lambda m: m.lowest)
    q_low = broadest.lowest
    top = max(m.cutoff.q for m in trusted)
    count = int(np.ceil(np.log10(top / q_low) * RINGS)) + 1
    centres = q_low * 10 ** (np.arange(count) / RINGS)
    logs = np.full((len(measurements), count), np.nan)
    variances = np.full_like(logs, np.nan)
    for k, measurement in enumerate(measurements):
        # The broadest counts below the interval of its fit, too: most of the variance is there.
        low = measurement.lowest if measurement is broadest else measurement.fit.q_min
        slack = 1 + 1e-9
        high = min(measurement.cutoff.q, top)
        rings = measurement.narrow.between(low / slack, high * slack)
        index = np.rint(np.log10(rings.q / q_low) * RINGS).astype(int)
        dof = np.bincount(index, weights=rings.dof, minlength=count)
        # The mean of C over a ring differs from C at its middle unless the slope is taken out.
        level = rings.dof * rings.psd * (rings.q / centres[index]) ** REFERENCE_EXPONENT
        sums = np.bincount(index, weights=level, minlength=count)
        here = (dof > 0) & (sums > 0)
        logs[k, here] = np.log(sums[here] / dof[here]) - _log_bias(dof[here])
        variances[k, here] = special.polygamma(1, dof[here]) if measurement.trusted else np.inf
    used = np.isfinite(variances).any(0) | np.any([gap.contains(centres) for gap in gaps], axis=0)
    return logs[:, used], variances[:, used], centres[used]


def _log_bias(dof: NDArray) -> NDArray:
    """Mean logarithm of a Gamma law, below the logarithm of its mean."""
    return special.digamma(dof) - np.log(dof)


def _average(q, logs, variances, tau2, gaps, corner=0.5) -> tuple[NDArray, RadialPSD]:
    """Weights of the mean of ln C (k, m), and rings whose ln C has this mean and its variance."""
    weight = np.nan_to_num(1 / (variances + np.nan_to_num(tau2)))
    total = weight.sum(axis=0)
    total[total == 0] = 1.0  # in gaps
    shares = weight / total
    mean = np.nansum(shares * logs, axis=0)
    variance = 1 / total
    for gap in gaps:
        inside = gap.contains(q)
        mean[inside] = gap.bridge(q[inside], corner, gap.log_psd)
        variance[inside] = gap.variance(q[inside])
    # Solve polygamma(1, dof) = variance: Newton's method on its inverse, nearly linear in dof.
    dof = 0.5 + 1 / variance
    for _ in range(20):
        trigamma = special.polygamma(1, dof)
        dof = dof + trigamma * (1 - trigamma / variance) / special.polygamma(2, dof)
    return shares, RadialPSD(q, np.exp(mean + _log_bias(dof)), dof)


def _variance_between(logs: NDArray, variances: NDArray) -> float:
    """Variance between measurements, from the mean offsets of all pairs that overlap."""
    squares = []
    for j, k in combinations(range(len(logs)), 2):
        weight = np.nan_to_num(1 / (variances[j] + variances[k]))
        if np.any(weight > 0):
            total = weight.sum()
            offset = np.nansum(weight * (logs[j] - logs[k])) / total
            squares.append(max(offset**2, 1 / total))  # at least its sampling error
    return float(np.mean(squares)) / 2 if squares else np.nan


@dataclass(frozen=True)
class Continuation:
    """Power laws by which drawn spectra continue beyond the cutoff, `(n,)` each."""

    cutoff: float  #: [1/length]
    level: NDArray  #: C at the cutoff [length^4]
    hurst: NDArray  #: within `HURST_BEYOND`

    def psd(self, q: NDArray) -> NDArray:
        """C at wave numbers beyond the cutoff [length^4], `(n, m)`."""
        exponent = -2 * (self.hurst[:, None] + 1)
        return self.level[:, None] * (q / self.cutoff) ** exponent

    def integrate(self, end: ArrayLike, order: int) -> NDArray:
        """2 pi * integral of q^(1 + order) C from the cutoff to `end`."""
        octaves = expm1_over(order - 2 * self.hurst, np.log(end / self.cutoff))
        return 2 * np.pi * self.level * self.cutoff ** (2 + order) * octaves

    def find_end(self, square_slope: NDArray) -> NDArray:
        """Wave number at which this mean square slope is added; infinite if none is that far."""
        of_octave = 2 * np.pi * self.level * self.cutoff**4
        exponent = 2 - 2 * self.hurst
        # The slope grows by of_octave expm1(exponent t)/exponent, with t = ln(q/cutoff).
        steps = np.maximum(square_slope, 0.0) / of_octave
        is_level = exponent < 1e-9
        safe = np.where(is_level, 1.0, exponent)
        log_ratio = np.where(is_level, steps, np.log1p(safe * steps) / safe)
        return self.cutoff * np.exp(np.minimum(log_ratio, 500.0))


@dataclass(frozen=True)
class Draws:
    """Spectra that agree with a measured one."""

    family: SpectrumFamily  #: with waves beyond the cutoff, up to where each of them ends
    q0: NDArray  #: (n,), end of the plateau [1/length]; if there is none, lowest of the scan
    #: (n,), energy of all waves from the cutoff to `continue_to` over the measured energy
    unresolved: NDArray
    #: (n,), energy of full contact per area over E* of the waves that the first measurement holds
    #: [length]
    held_energy: NDArray
    hurst: NDArray  #: (n,), of the fitted law
    #: (n,), C of the law at the lowest wave number fitted or the end of a plateau [length^4]
    first_psd: NDArray
    continuation: Continuation  #: of the spectrum beyond the cutoff


def draw(
    spectrum: MeasuredSpectrum,
    count: int,
    seed: int,
    *,
    extend_to: float | None = None,
    continue_to: float | None = None,
    steepest: float = np.inf,
) -> Draws:
    """Draw spectra that agree with a measured one.

    Parameters
    ----------
    spectrum : MeasuredSpectrum
        Of one measurement or several.
    count, seed : int
        Number of draws, and seed of the random numbers.
    extend_to : float, optional
        Wave number up to which the fit extrapolates the spectrum [1/length].
    continue_to : float, optional
        Without `extend_to`: highest wave number at which the fitted law may end [1/length]. The
        spectra end between the cutoff and there; the logarithm of the end is spread evenly.
        Default: they end at the cutoff.
    steepest : float
        Rms slope at which the law ends at the latest.

    Raises
    ------
    ValueError
        If the fit is to extrapolate, but is not self-affine or `extend_to` is below the cutoff.
    """
    if extend_to is not None and not extend_to > spectrum.cutoff.q:
        raise ValueError(
            f"extend_to must be below the shortest wavelength measured, "
            f"{2 * np.pi / spectrum.cutoff.q:.3g} m, got {2 * np.pi / extend_to:.3g} m"
        )
    # Spectra and laws that agree with the measured ones.
    rng = np.random.default_rng(seed)
    rings = spectrum.rings
    cutoff = spectrum.cutoff.q
    levels = _draw_levels(spectrum, count, rng)
    law = _draw_laws(spectrum.fit, count, rng)
    for gap in spectrum.gaps if isinstance(spectrum, Stitched) else ():
        inside = gap.contains(rings.q)
        ends = rng.normal(gap.log_psd, gap.log_psd_se, size=(count, 2))
        levels[:, inside] = np.exp(gap.bridge(rings.q[inside], _draw_places(count, rng), ends))
    continuation = _continue(spectrum, levels, law, rng)

    # Beyond the cutoff heights are the instrument's, and the law goes on in their place.
    resolved = rings.q <= cutoff * (1 + 1e-9)
    measured = SpectrumFamily(rings.q[resolved], spectrum.area[resolved], levels[:, resolved])
    end: float | NDArray = cutoff if extend_to is None else extend_to
    furthest: float | NDArray = cutoff
    if extend_to is None and continue_to is not None:
        of_slope = continuation.find_end(steepest**2 - measured.variance(2))
        furthest = np.clip(of_slope, cutoff, max(continue_to, cutoff))
        # Where the waves end is spread over the orders of magnitude.
        end = cutoff * (furthest / cutoff) ** _draw_places(count, rng)
    ends = np.broadcast_to(end, (count,))
    family = _join(measured, continuation, ends, spectrum.held.q)
    told = measured.energy() if extend_to is None else family.energy()

    q0 = np.full(count, spectrum.lowest)
    if law.log_q_rolloff is not None:
        q0 = np.exp(law.log_q_rolloff)
    start = np.log(np.maximum(spectrum.fit.q_min, q0))
    return Draws(
        family=family,
        q0=q0,
        unresolved=continuation.integrate(furthest, 1) / 4 / told,
        held_energy=family.up_to(spectrum.held.q).energy(),
        hurst=law.hurst,
        first_psd=np.exp(law.log_c0 - 2 * (law.hurst + 1) * start),
        continuation=continuation,
    )


def _join(
    measured: SpectrumFamily, continuation: Continuation, ends: NDArray, held: float
) -> SpectrumFamily:
    """Measured rings, and those of the laws beyond, up to the end of each.

    The energy of every ring is that of the law within it. One begins where the heights end (`held`,
    [1/length]).
    """
    cutoff = continuation.cutoff
    rings = int(np.ceil(RINGS * np.log10(ends.max() / cutoff)))
    if rings == 0:
        return measured
    edges = np.geomspace(cutoff, ends.max(), rings + 1)
    if cutoff < held < ends.max():
        edges = np.unique(np.append(edges, held))
    inside = np.minimum(edges[:, None], ends)
    energy = np.diff(continuation.integrate(inside, 1), axis=0).T
    q = np.sqrt(edges[1:] * edges[:-1])
    area = np.pi * np.diff(edges**2)
    return SpectrumFamily(
        q=np.append(measured.q, q),
        area=np.append(measured.area, area),
        psd=np.append(measured.psd, energy / (area * q), axis=1),
    )


def _draw_levels(spectrum: MeasuredSpectrum, count: int, rng: np.random.Generator) -> NDArray:
    """C of every ring, `(count, m)`, drawn by its sampling error and the scatter."""
    rings = spectrum.rings
    # The mean of dof exponential values has the relative variance 1/dof. A log-normal distribution
    # of that mean and variance is positive and lacks the far tail of the posterior of a single
    # mode: the variance of the measured heights is known.
    variance = np.log1p(1 / rings.dof)
    sampling = variance
    offsets: ArrayLike = 0.0
    if isinstance(spectrum, Stitched):
        tau = np.nan_to_num(spectrum.scatter)
        shares = spectrum.shares
        offsets = rng.normal(size=(count, len(shares))) * tau @ shares
        # The errors of the rings already hold the offsets, as if these were independent.
        sampling = np.maximum(variance - tau**2 * np.sum(shares**2, axis=0), 0.0)
    normal = rng.normal(size=(count, len(variance)))
    return rings.psd * np.exp(offsets + normal * np.sqrt(sampling) - variance / 2)


def _continue(
    spectrum: MeasuredSpectrum, levels: NDArray, law: _Laws, rng: np.random.Generator
) -> Continuation:
    """Laws through the last octave of drawn spectra, `(count, m)`, with a bounded exponent."""
    cutoff = spectrum.cutoff.q
    q = spectrum.rings.q
    is_resolved = q <= cutoff * (1 + 1e-9)

    # The local exponent, by a regression of ln C on ln q.
    first = min(cutoff / 2**OCTAVES, q[is_resolved][-2])
    near = is_resolved & (q >= first * (1 - 1e-9))
    weight = spectrum.rings.dof[near]
    log_q = np.log(q[near]) - np.average(np.log(q[near]), weights=weight)
    slope = np.log(levels[:, near]) @ (weight * log_q) / (weight @ log_q**2)
    local_hurst = -slope / 2 - 1

    # The fit and the last octaves are two opinions; what holds beyond lies between them.
    place = rng.uniform(size=local_hurst.shape)
    hurst = np.clip(law.hurst + place * (local_hurst - law.hurst), *HURST_BEYOND)

    # The law has the energy of the last octave.
    last = is_resolved & (q >= min(cutoff / 2, q[is_resolved][-1]) * (1 - 1e-9))
    density = spectrum.area[last] * q[last]
    shape = (q[last] / cutoff) ** (-2 * (hurst[:, None] + 1))
    return Continuation(
        cutoff=cutoff, level=(levels[:, last] @ density) / (shape @ density), hurst=hurst
    )


def _draw_places(count: int, rng: np.random.Generator) -> NDArray:
    """Places from 0 to 1, a seventh of them at either end.

    So limits of 90 % contain both ends, whatever else errs.
    """
    return np.clip(rng.uniform(-0.2, 1.2, count), 0.0, 1.0)


class _Laws(NamedTuple):
    """Self-affine laws that agree with a fit, `(count,)` each."""

    log_c0: NDArray
    hurst: NDArray
    log_q_rolloff: NDArray | None  #: None without a plateau


def _draw_laws(fit: SelfAffineFit, count: int, rng: np.random.Generator) -> _Laws:
    """Draw laws by the covariance of the fit."""
    centre = [np.log(fit.c0), fit.hurst]
    if fit.q_rolloff:
        centre.append(np.log(fit.q_rolloff))
    drawn = rng.multivariate_normal(centre, fit.log_covariance, size=count, method="eigh")
    return _Laws(drawn[:, 0], drawn[:, 1], drawn[:, 2] if fit.q_rolloff else None)
