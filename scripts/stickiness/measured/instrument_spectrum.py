"""One measurement of a surface as an isotropic spectrum, up to where the instrument resolves it.

A profile across an isotropic surface has C1(q) = integral of C(sqrt(q^2 + k^2)) dk over all k,
Abel's transform of C (Nayak 1971, doi:10.1115/1.3451608). Its inverse takes a derivative of a noisy
spectrum. Here the ratio C/C1 is taken from the self-affine fit to the profile. It is exact for such
a spectrum; elsewhere its error follows from the local exponent: for C ~ q^-s the ratio is
Gamma(s/2)/(sqrt(pi) Gamma(s/2 - 1/2))/q.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import special

from stickiness.arguments import number, numbers
from stickiness.measured import psd
from stickiness.measured.psd import RadialPSD, Taper, merge_rings, radial_average
from stickiness.measured.self_affine_fit import FINE, SelfAffineFit, fit_rings
from stickiness.measured.topography import Profile, Topography
from stickiness.spectrum.kinds import Tabulated

RINGS = 10  #: per decade, of the spectrum that is shown and integrated
TIP_FACTOR = 0.5  #: curvature over 1/R from which the tip's shape shows (Sanner et al. 2022)
LOWEST_MODES = 4  #: lattice steps left out at low q if the heights were tapered
NYQUIST_SHARE = 0.5  #: default highest q over q_Nyquist
BLUR_EXPONENT = 5.0  #: C ~ q^-s falls faster than any self-affine surface does (s = 4 at H = 1)
#: Where waves end, C falls as q^-s beyond what looks like a plateau, with s = 19 to 34 on synthetic
#: surfaces. Of heights with scratches s is 5.4, by their width.
END_EXPONENT = 10.0
EMPTY = 1e-6  #: q^5 C over its largest value, below which a spectrum is empty
NOISE_EXPONENT = 1.5  #: and slower than any (s = 2 at H = 0)
LOWEST_HURST = -0.4  #: of a profile; at -1/2 the transform of q^(-2(H+1)) no longer exists


@dataclass(frozen=True)
class Cutoff:
    """Highest wave number at which the spectrum is the surface's, and why."""

    q: float  #: [1/length]
    reason: str
    detected: bool = False  #: in the spectrum or the heights, not given or by default
    #: Whether the waves beyond are not the surface's, as noise or by the user's word. Blurred waves
    #: are the surface's, only lower.
    is_noise_beyond: bool = False


@dataclass(frozen=True)
class MeasuredSpectrum:
    """Isotropic spectrum of a surface as measured."""

    rings: RadialPSD  #: C in rings, to show and to integrate [length^4]
    #: (m,), of each ring in the plane of q [1/length^2]; the sum of C times it is the variance
    area: NDArray
    narrow: RadialPSD  #: rings for the fit
    fit: SelfAffineFit  #: from the lowest to the highest q that taper and instrument leave
    cutoff: Cutoff  #: highest wave number that the instrument resolves, as the fit found data
    lowest: float  #: wave number of the scan [1/length]
    #: Highest wave number that the heights hold: that of two steps of the grid, or that from which
    #: on they are blurred or noise
    held: Cutoff
    anisotropy: float = np.nan  #: amplitude of the dependence on direction; NaN for profiles
    trusted: bool = True  #: False if no waves are left within the limits of the instrument

    def spectrum(self) -> Tabulated:
        """Return the spectrum as measured, up to the cutoff, as theories and `verdict` take it."""
        inside = self.rings.between(0.0, self.cutoff.q * (1 + 1e-9))
        return Tabulated(inside.q, inside.psd)


@dataclass(frozen=True)
class TrustedWaves:
    """What tells which waves of a measurement are trusted; lengths in the unit of the heights."""

    fit_from: float | None = None  #: longest wavelength of the fit interval
    fit_to: float | None = None  #: shortest one; overrides all that follow
    resolution: float | None = None  #: shortest wavelength that the instrument resolves
    tip_radius: float | None = None  #: of a scanning tip
    detect: bool = True  #: look for blur and noise in the spectrum

    def __post_init__(self):
        for name in ("fit_from", "fit_to", "resolution", "tip_radius"):
            if getattr(self, name) is not None:
                number(name, getattr(self, name))


def analyse(
    heights: Topography | Profile,
    taper: Taper = "hann",
    instrument: TrustedWaves | None = None,
    demand: bool = True,
    alone: bool = True,
) -> MeasuredSpectrum:
    """Isotropic spectrum of one levelled measurement, with its limits and its self-affine fit.

    Parameters
    ----------
    heights : Topography or Profile
        Levelled heights, in any one unit of length.
    taper : {"none", "hann", "hann_radial"}
        "hann" fades along both axes, "hann_radial" from the centre; "none" if they are periodic.
    instrument : TrustedWaves, optional
        Default: the cutoff is detected, and at most half the Nyquist wave number.
    demand : bool
        False: fit all waves of the grid, few or noise as they may be, to show what was measured.
    alone : bool
        False: few waves within the limits are enough, because other measurements of the surface
        complete them (`stitching.stitch`).

    Returns
    -------
    MeasuredSpectrum
        C(q) in rings [length^4], the interval in which it is the surface's spectrum, and the fit.

    Raises
    ------
    ValueError
        If the heights are flat, the limits leave too little for a fit, or a profile is noise.
    """
    instrument = TrustedWaves() if instrument is None else instrument
    levelled = numbers("heights", heights.heights)
    if levelled.size and np.ptp(levelled) <= 1e-13 * np.max(np.abs(levelled)):  # but for rounding
        raise ValueError(f"heights must not be flat, got {levelled.flat[0]:.6g} throughout")

    # The spectrum in fine rings, of a profile C1, and in rings proportional to C.
    is_map = isinstance(heights, Topography)
    modes, line, nyquist = _transform(heights, levelled, taper)
    narrow = line if is_map else replace(line, psd=line.psd / line.q)
    lowest = min(modes.steps)
    of_grid = Cutoff(nyquist, "two steps of the grid")

    # The interval of the fit. `modes.blur` is by the taper, not by the instrument.
    q_min = (LOWEST_MODES if modes.blur else 1) * max(modes.steps)
    if instrument.fit_from is not None:
        q_min = 2 * np.pi / instrument.fit_from
    if demand:
        cutoff = _find_cutoff(instrument, narrow, q_min, nyquist, levelled, heights.steps)
    else:
        q_min = lowest
        cutoff = of_grid

    # The fit. The end of the waves that an instrument resolves looks like that of a plateau.
    enough = demand and alone

    def fit_to(q_max: float) -> tuple[RadialPSD, SelfAffineFit]:
        if is_map:
            return narrow, fit_rings(narrow, q_min, q_max, demand=enough)
        return _fit_profile(line, q_min, q_max, NYQUIST_SHARE * nyquist, enough)

    fitted, fit = fit_to(cutoff.q)
    while demand and instrument.detect and fit.q_rolloff is not None and fit.fall > END_EXPONENT:
        reason = f"blur of the instrument (C falls as q^-{fit.fall:.1f} beyond)"
        cutoff = Cutoff(fit.q_rolloff, reason, detected=True)
        fitted, fit = fit_to(cutoff.q)

    rings, area = _broad_rings(modes, fitted)
    anisotropy = np.nan
    if isinstance(modes, psd.PowerSpectrum):
        anisotropy, _ = modes.anisotropy(fit.q_min, fit.q_max)
    return MeasuredSpectrum(
        rings=rings,
        area=area,
        narrow=fitted,
        fit=fit,
        cutoff=replace(cutoff, q=fit.q_max),
        lowest=lowest,
        held=cutoff if cutoff.detected or cutoff.is_noise_beyond else of_grid,
        anisotropy=anisotropy,
    )


def _transform(
    heights: Topography | Profile, levelled: NDArray, taper: Taper
) -> tuple[psd.Modes, RadialPSD, float]:
    """Waves of a measurement, their power in fine rings, and the highest one that it records."""
    modes: psd.Modes
    if isinstance(heights, Topography):
        modes = psd.power_spectrum(levelled, heights.dx, heights.dy, taper=taper)
        return modes, radial_average(modes, FINE), modes.q_nyquist
    modes = psd.profile_spectrum(levelled, heights.dx, taper=taper)
    # Unevenly spaced points resolve no wave shorter than twice their largest gap.
    nyquist = min(modes.q_nyquist, np.pi / max(heights.largest_gap, heights.dx))
    return modes, radial_average(modes, FINE), nyquist


def _broad_rings(modes: psd.Modes, fitted: RadialPSD) -> tuple[RadialPSD, NDArray]:
    """Rings that are shown and integrated, and their areas in the plane of q."""
    if isinstance(modes, psd.PowerSpectrum):
        rings = radial_average(modes, RINGS)
        area = rings.modes(modes) * modes.steps[0] * modes.steps[1]
    else:
        rings = RadialPSD(*merge_rings(fitted, fitted.psd, RINGS))
        area = ring_areas(rings.q, min(modes.steps))
    # Exact waves have rings without power between them.
    has_power = rings.psd > 0
    filled = RadialPSD(rings.q[has_power], rings.psd[has_power], rings.dof[has_power])
    return filled, area[has_power]


def ring_areas(q: NDArray, lowest: float) -> NDArray:
    """Areas in the plane of q of rings about q (m,), which meet at geometric means."""
    middle = np.sqrt(q[1:] * q[:-1])
    edges = np.concatenate([[max(q[0] - lowest / 2, 0.0)], middle, [q[-1] ** 2 / middle[-1]]])
    return np.pi * np.diff(edges**2)


def _fit_profile(
    line: RadialPSD, q_min: float, q_max: float, q_recorded: float, demand: bool
) -> tuple[RadialPSD, SelfAffineFit]:
    """Rings of C of a profile that records more waves than it resolves, and the fit."""
    falls = fit_rings(replace(line, psd=line.psd / line.q), q_min, q_max, demand=demand).hurst > 0
    if falls or q_max >= q_recorded:
        return isotropic(line, q_min, q_max, demand=demand)
    # C1 of a plateau contains waves across the profile, up to where C falls by a roll-off or by
    # blur. That is beyond q_max, but recorded.
    rings, _ = isotropic(line, q_min, q_recorded, rolloff=True, demand=demand)
    return rings, fit_rings(rings, q_min, q_max, demand=demand)


def isotropic(
    line: RadialPSD, q_min: float, q_max: float, rolloff: bool | None = None, demand: bool = True
) -> tuple[RadialPSD, SelfAffineFit]:
    """Rings of C behind narrow ones of a profile's C1, and the self-affine fit between two q."""
    rings = replace(line, psd=line.psd * (1 / line.q))
    fit = fit_rings(rings, q_min, q_max, rolloff, demand)
    for _ in range(20):
        before = fit
        if demand and not fit.hurst > LOWEST_HURST:
            raise ValueError(
                f"the profile's spectrum goes as q^{-2 * fit.hurst - 1:.2f}: it falls too slowly "
                "for a surface and is probably noise; lower the highest wave number of the fit"
            )
        hurst = max(fit.hurst, LOWEST_HURST)
        rings = replace(line, psd=line.psd * abel_ratio(line.q, hurst, fit.q_rolloff))
        # The model stays once it is chosen: else a plateau might come and go for ever.
        fit = fit_rings(rings, q_min, q_max, fit.q_rolloff is not None, demand)
        if abs(fit.hurst - before.hurst) < 1e-3 * fit.hurst_se:
            break
    return rings, fit


def abel_ratio(q: ArrayLike, hurst: float, q_rolloff: float | None = None) -> NDArray:
    """C/C1 [1/length] of a self-affine spectrum without an upper end; H is above -1/2."""
    q = np.asarray(q, dtype=float)
    if q_rolloff is None:
        return special.gamma(hurst + 1) / (np.sqrt(np.pi) * special.gamma(hurst + 0.5)) / q
    # With C = 1 on the plateau. Beyond q_rolloff the integral over k is an incomplete beta
    # function in t = q^2/(q^2 + k^2), with q along the profile and k across it; below it the
    # integrand is constant.
    t = np.minimum((q / q_rolloff) ** 2, 1.0)
    level = np.minimum((q / q_rolloff) ** (-2 * (hurst + 1)), 1.0)
    tail = special.betainc(hurst + 0.5, 0.5, t) * special.beta(hurst + 0.5, 0.5)
    sloped = q_rolloff * (q / q_rolloff) ** (-2 * hurst - 1) * tail
    flat = 2 * np.sqrt(np.maximum(q_rolloff**2 - q**2, 0.0))
    return level / (sloped + flat)


def _find_cutoff(instrument, rings, q_min, q_nyquist, heights, steps) -> Cutoff:
    """Lowest of the cutoffs that are given, detected or general."""
    if instrument.fit_to is not None:
        return Cutoff(2 * np.pi / instrument.fit_to, "as given (fit_to)", is_noise_beyond=True)
    candidates = [Cutoff(NYQUIST_SHARE * q_nyquist, "half the Nyquist wave number")]
    if instrument.resolution is not None:
        resolved = 2 * np.pi / instrument.resolution
        candidates.append(Cutoff(resolved, "resolution of the instrument", is_noise_beyond=True))
    if instrument.tip_radius is not None:
        blunt = tip_cutoff(heights, steps, instrument.tip_radius)
        if blunt is not None:
            candidates.append(Cutoff(2 * np.pi / blunt, "shape of the tip", detected=True))
    if instrument.detect:
        bend = find_bend(rings, q_min, q_nyquist)
        if bend is not None:
            candidates.append(bend)
    lowest = min(candidates, key=lambda cutoff: cutoff.q)
    if not lowest.q > q_min:
        end = (
            f"at wavelengths of {2 * np.pi / lowest.q:.3g} (in the unit of the heights)"
            if lowest.q
            else "everywhere"
        )
        raise ValueError(
            f"{lowest.reason} ends the spectrum {end}, and the longest wavelength that can be used "
            f"is {2 * np.pi / q_min:.3g}: nothing is left; measure a larger area or give "
            "fit_from and fit_to"
        )
    return lowest


def tip_cutoff(heights: ArrayLike, steps: tuple[float, ...], radius: float) -> float | None:
    """Wavelength below which heights show the tip, a sphere.

    None if no distance shows it, infinite if all do.
    """
    number("radius", radius)
    # A tip of radius R leaves no peak sharper than itself: heights are unreliable at distances over
    # which some second difference reaches -1/(2R) (Sanner, Nöhring, Thimons, Jacobs & Pastewka
    # 2022, doi:10.1016/j.apsadv.2021.100190). The wavelength is the length of the stencil.
    heights = np.asarray(heights, dtype=float)
    limit = TIP_FACTOR / radius
    wavelengths = []  # of every axis that shows the tip
    for axis, step in enumerate(steps):
        h = np.moveaxis(heights, axis, 0)
        distances = np.unique(np.geomspace(1, len(h) // 4, 30).astype(int))
        sharpest = [-float(np.min(h[2 * k :] - 2 * h[k:-k] + h[: -2 * k])) for k in distances]
        curvatures = np.array(sharpest) / (distances * step) ** 2
        below = np.flatnonzero(curvatures < limit)
        if not len(below):
            wavelengths.append(np.inf)
        elif below[0] > 0:
            # The curve falls as a power between the two distances.
            near, far = distances[below[0] - 1 : below[0] + 1]
            sharp, blunt = np.maximum(curvatures[below[0] - 1 : below[0] + 1], limit * 1e-9)
            share = np.log(sharp / limit) / np.log(sharp / blunt)
            wavelengths.append(float(2 * (near * (far / near) ** share) * step))
    return max(wavelengths, default=None)


def find_bend(rings: RadialPSD, q_min: float, q_nyquist: float) -> Cutoff | None:
    """Find the wave number beyond which blur or noise of the instrument dominates, if any does."""
    rings = rings.between(q_min, q_nyquist)
    if not len(rings):
        return None
    log_q, log_psd, exponents = _find_local_exponents(rings)

    # A filter may leave nothing but rounding.
    flattened = log_psd + BLUR_EXPONENT * log_q
    is_empty = flattened < np.max(flattened, initial=-np.inf) + np.log(EMPTY)
    filled = slice(_start_of_last_run(is_empty))
    q = np.exp(log_q[filled])
    exponents = exponents[filled]

    # Noise is the last run, up to the Nyquist wave number, of exponents below NOISE_EXPONENT; blur
    # is the last run before it of exponents above BLUR_EXPONENT.
    noise = _start_of_last_run(exponents < NOISE_EXPONENT)
    blur = _start_of_last_run(exponents[:noise] > BLUR_EXPONENT)
    for kind, start, end in (("blur", blur, noise), ("noise", noise, len(q))):
        # A bend within half a decade of `q_min` is ignored; the surface may be smooth.
        if 0 < start < end and q[start - 1] > q_min * 10**0.5:
            fall = max(float(exponents[start]), 0)
            return Cutoff(
                float(q[start - 1]),
                f"{kind} of the instrument (C falls as q^-{fall:.1f} beyond)",
                detected=True,
                is_noise_beyond=kind == "noise",
            )
    return None


def _find_local_exponents(rings: RadialPSD) -> NDArray:
    """Centres ln q, ln C and s of C ~ q^-s, `(3, n)`, by regression over a quarter of a decade."""
    q, mean, dof = merge_rings(rings, rings.psd, bins_per_decade=20)
    has_power = mean > 0
    dof = dof[has_power]
    log_q = np.log(q[has_power])
    log_psd = np.log(mean[has_power]) - special.digamma(dof) + np.log(dof)
    # A scatter of ln C beyond sampling, so that rings of many modes do not decide alone.
    weight = 1 / (special.polygamma(1, dof) + 0.05**2)
    width = np.log(10) / 4
    regressions = []
    for centre in log_q:
        near = np.abs(log_q - centre) <= width / 2
        if np.count_nonzero(near) < 4 or np.ptp(log_q[near]) < width * 0.7:
            continue
        mean_log_q = np.average(log_q[near], weights=weight[near])
        mean_log_psd = np.average(log_psd[near], weights=weight[near])
        off = log_q[near] - mean_log_q
        exponent = -np.sum(weight[near] * off * log_psd[near]) / np.sum(weight[near] * off**2)
        regressions.append((centre, mean_log_psd - exponent * (centre - mean_log_q), exponent))
    return np.reshape(regressions, (-1, 3)).T


def _start_of_last_run(flags: NDArray) -> int:
    """Index from which on all are true; the length if the last is not."""
    return int(np.max(np.flatnonzero(~flags) + 1, initial=0))
