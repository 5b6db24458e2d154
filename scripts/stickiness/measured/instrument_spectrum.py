"""One measurement of a surface, map or line profile, as an isotropic spectrum with its limits.

The spectrum ends where the instrument stops resolving the surface: by its tip, blur or noise.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import special

from stickiness.arguments import number, numbers
from stickiness.measured import profiles
from stickiness.measured.psd import RadialPSD, Taper, merge_rings, power_spectrum, radial_average
from stickiness.measured.self_affine_fit import FINE, SelfAffineFit, fit_rings
from stickiness.measured.topography import Profile, Topography
from stickiness.spectrum.kinds import Tabulated

RINGS = 10  #: per decade, of the spectrum that is shown and integrated
TIP_FACTOR = 0.5  #: curvature over 1/R from which the tip's shape shows (Sanner et al. 2022)
LOWEST_MODES = 4  #: lattice steps left out at low q if the heights were tapered
NYQUIST_SHARE = 0.5  #: default highest q over q_Nyquist
BLUR_EXPONENT = 5.0  #: C ~ q^-s falls faster than any self-affine surface does (s = 4 at H = 1)
NOISE_EXPONENT = 1.5  #: and slower than any (s = 2 at H = 0)

_BEND_RINGS = 20  # per decade
_WIDTH = np.log(10) / 4  # of the interval for the local exponent
_SCATTER = 0.05  # of ln C beyond sampling, so that rings of many modes do not decide alone
_ROOM = 10**0.5  # smallest ratio of a bend to the lowest wave number
_ROUNDING = 1e-13  # relative range of heights below which they are all the same


@dataclass(frozen=True)
class Cutoff:
    """Highest wave number at which the spectrum is the surface's, and why."""

    q: float  #: [1/length]
    reason: str
    detected: bool = False  #: in the spectrum or the heights, not given or by default


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
    anisotropy: float = np.nan  #: amplitude of the dependence on direction; NaN for profiles

    def spectrum(self) -> Tabulated:
        """Return the spectrum as measured, up to the cutoff, as theories and `verdict` take it."""
        inside = self.rings.between(0.0, self.cutoff.q * (1 + 1e-9))
        return Tabulated(inside.q, inside.psd)


@dataclass(frozen=True)
class Limits:
    """Limits of an instrument, all optional; lengths in the unit of the heights.

    `fit_to` overrides all below it.
    """

    fit_from: float | None = None  #: longest wavelength of the fit interval
    fit_to: float | None = None  #: shortest one
    resolution: float | None = None  #: shortest wavelength that the instrument resolves
    tip_radius: float | None = None  #: of a scanning tip
    detect: bool = True  #: look for blur and noise in the spectrum

    def __post_init__(self):
        for name in ("fit_from", "fit_to", "resolution", "tip_radius"):
            if getattr(self, name) is not None:
                number(name, getattr(self, name))


def analyse(
    heights: Topography | Profile, taper: Taper = "hann", limits: Limits | None = None
) -> MeasuredSpectrum:
    """Isotropic spectrum of one levelled measurement, with its limits and its self-affine fit.

    Parameters
    ----------
    heights : Topography or Profile
        Levelled heights, in any one unit of length.
    taper : {"none", "hann", "hann_radial"}
        Taper of the heights (`psd.power_spectrum`); "none" for periodic heights only.
    limits : Limits, optional
        Limits of the instrument. Default: the cutoff is detected, and at most half the Nyquist
        wave number.

    Returns
    -------
    MeasuredSpectrum
        C(q) in rings [length^4], the interval in which it is the surface's spectrum, and the fit.

    Raises
    ------
    ValueError
        If the heights are flat, or the limits leave too little for a fit.
    """
    limits = Limits() if limits is None else limits
    values = numbers("heights", heights.heights)
    if values.size and np.ptp(values) <= _ROUNDING * np.max(np.abs(values)):
        raise ValueError(f"heights must not be flat, got {values.flat[0]:.6g} throughout")
    if isinstance(heights, Profile):
        return _analyse_profile(heights, taper, limits)
    plane = power_spectrum(heights.heights, heights.dx, heights.dy, taper)
    narrow = radial_average(plane, bins_per_decade=FINE)
    q_min = _lowest(limits, max(plane.dqx, plane.dqy), plane.blur)
    steps = heights.dx, heights.dy
    cutoff = _find_cutoff(limits, narrow, q_min, plane.q_nyquist, heights.heights, steps)
    fit = fit_rings(narrow, q_min, cutoff.q)
    cutoff = replace(cutoff, q=fit.q_max)
    rings = radial_average(plane, bins_per_decade=RINGS)
    area, lowest = rings.modes(plane) * plane.dqx * plane.dqy, min(plane.dqx, plane.dqy)
    anisotropy = plane.anisotropy(fit.q_min, fit.q_max)[0]
    return MeasuredSpectrum(rings, area, narrow, fit, cutoff, lowest, anisotropy)


def _analyse_profile(heights: Profile, taper: Taper, limits: Limits) -> MeasuredSpectrum:
    line = profiles.profile_spectrum(heights.heights, heights.dx, taper)
    lowest = float(line.q[0])
    q_min = _lowest(limits, lowest, line.blur)
    # Unevenly spaced points resolve no wave shorter than twice their largest gap.
    nyquist = min(line.q_nyquist, np.pi / max(heights.largest_gap, heights.dx))
    pilot = line.rings(FINE)
    pilot = replace(pilot, psd=pilot.psd / pilot.q)  # proportional to C
    cutoff = _find_cutoff(limits, pilot, q_min, nyquist, heights.heights, (heights.dx,))
    narrow, fit = profiles.isotropic(line, q_min, cutoff.q)
    q, mean, dof = merge_rings(narrow, narrow.psd, RINGS)
    rings = RadialPSD(q, mean, dof)
    cutoff = replace(cutoff, q=fit.q_max)
    return MeasuredSpectrum(rings, ring_areas(q, lowest), narrow, fit, cutoff, lowest)


def ring_areas(q: NDArray, lowest: float) -> NDArray:
    """Areas in the plane of q of adjoining rings about the wave numbers q (m,).

    Neighbours meet at their geometric mean; the first ring begins half of `lowest` below q[0].
    """
    middle = np.sqrt(q[1:] * q[:-1])
    edges = np.concatenate([[max(q[0] - lowest / 2, 0.0)], middle, [q[-1] ** 2 / middle[-1]]])
    return np.pi * np.diff(edges**2)


def _lowest(limits: Limits, step: float, blur: float) -> float:
    if limits.fit_from is not None:
        return 2 * np.pi / limits.fit_from
    return (LOWEST_MODES if blur else 1) * step


def _find_cutoff(limits, rings, q_min, q_nyquist, heights, steps) -> Cutoff:
    """Lowest of the cutoffs that are given, detected or general."""
    if limits.fit_to is not None:
        return Cutoff(2 * np.pi / limits.fit_to, "as given (fit_to)")
    found = [Cutoff(NYQUIST_SHARE * q_nyquist, "half the Nyquist wave number")]
    if limits.resolution is not None:
        found.append(Cutoff(2 * np.pi / limits.resolution, "resolution of the instrument"))
    if limits.tip_radius is not None and (blunt := tip_cutoff(heights, steps, limits.tip_radius)):
        found.append(Cutoff(2 * np.pi / blunt, "shape of the tip", detected=True))
    if limits.detect and (bend := find_bend(rings, q_min, q_nyquist)):
        found.append(bend)
    lowest = min(found, key=lambda cutoff: cutoff.q)
    if not lowest.q > q_min:
        end = f"at wavelengths of {2 * np.pi / lowest.q:.3g} m" if lowest.q else "everywhere"
        raise ValueError(
            f"{lowest.reason} ends the spectrum {end}, and the longest wavelength that can be used "
            f"is {2 * np.pi / q_min:.3g} m: nothing is left; measure a larger area or give "
            "fit_from and fit_to"
        )
    return lowest


def tip_cutoff(heights: ArrayLike, steps: tuple[float, ...], radius: float) -> float | None:
    """Wavelength below which the heights show the shape of the tip, a sphere.

    A tip of radius R leaves no peak sharper than itself: heights are unreliable at distances over
    which some second difference reaches -1/(2R) (Sanner, Nöhring, Thimons, Jacobs & Pastewka
    2022, doi:10.1016/j.apsadv.2021.100190). The wavelength is the length of the stencil, the
    largest over all axes; None if no peak is so sharp, infinity if there is one at every distance.
    """
    if not radius > 0:
        raise ValueError(f"radius must be positive, got {radius!r}")
    heights, limit, found = np.asarray(heights, dtype=float), TIP_FACTOR / radius, []
    for axis, step in enumerate(steps):
        h = np.moveaxis(heights, axis, 0)
        distances = np.unique(np.geomspace(1, len(h) // 4, 30).astype(int))
        sharpest = [-float(np.min(h[2 * k :] - 2 * h[k:-k] + h[: -2 * k])) for k in distances]
        curvatures = np.array(sharpest) / (distances * step) ** 2
        below = np.flatnonzero(curvatures < limit)
        if not len(below):
            found.append(np.inf)
        elif below[0] > 0:
            # The curve falls as a power between the two distances.
            sharp, blunt = curvatures[below[0] - 1], max(curvatures[below[0]], limit * 1e-9)
            near, far = distances[below[0] - 1], distances[below[0]]
            share = np.log(sharp / limit) / np.log(sharp / blunt)
            found.append(float(2 * (near * (far / near) ** share) * step))
    return max(found, default=None)


def find_bend(rings: RadialPSD, q_min: float, q_nyquist: float) -> Cutoff | None:
    """Find the wave number beyond which blur or noise of the instrument dominates, if any does.

    The local exponent s of C ~ q^-s is fitted in intervals of a quarter of a decade. From the
    Nyquist wave number downwards, a spectrum that falls slower than q^-1.5 is noise and, below
    that, one that falls faster than q^-5 is blur: no self-affine surface has either, whatever its
    roll-off. A bend less than half a decade above `q_min` is ignored; the surface may be smooth.
    """
    q, slope = _local_exponents(rings.between(q_min, q_nyquist))
    # Everything from the last exponent on that is not noise's, and likewise from blur's.
    noise = _start_of_last_run(slope < NOISE_EXPONENT)
    blur = _start_of_last_run(slope[:noise] > BLUR_EXPONENT)
    for kind, start, end in (("blur", blur, noise), ("noise", noise, len(q))):
        if 0 < start < end and q[start - 1] > q_min * _ROOM:
            falls = f"C falls as q^-{max(float(slope[start]), 0):.1f} beyond"
            reason = f"{kind} of the instrument ({falls})"
            return Cutoff(float(q[start - 1]), reason, detected=True)
    return None


def _local_exponents(rings: RadialPSD) -> tuple[NDArray, NDArray]:
    """Wave numbers and exponents s of C ~ q^-s about rings with others on both sides."""
    if not len(rings):
        return np.empty(0), np.empty(0)
    q, mean, dof = merge_rings(rings, rings.psd, _BEND_RINGS)
    inside = mean > 0
    x, y, dof = np.log(q[inside]), np.log(mean[inside]), dof[inside]
    y = y - special.digamma(dof) + np.log(dof)
    weight = 1 / (special.polygamma(1, dof) + _SCATTER**2)
    found = []
    for centre in x:
        near = np.abs(x - centre) <= _WIDTH / 2
        if np.count_nonzero(near) < 4 or np.ptp(x[near]) < _WIDTH * 0.7:
            continue
        w, dx = weight[near], x[near] - np.average(x[near], weights=weight[near])
        found.append((np.exp(centre), -np.sum(w * dx * y[near]) / np.sum(w * dx**2)))
    q, slope = np.array(found).reshape(-1, 2).T
    return q, slope


def _start_of_last_run(flags: NDArray) -> int:
    """Index from which on all are true; the length if the last is not."""
    return int(np.max(np.flatnonzero(~flags) + 1, initial=0))
