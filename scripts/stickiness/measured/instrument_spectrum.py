"""One measurement of a surface, map or line profile, as an isotropic spectrum with its limits."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from stickiness.arguments import number, numbers
from stickiness.measured import profiles
from stickiness.measured.cutoff import find_bend, tip_cutoff
from stickiness.measured.psd import RadialPSD, Taper, merge_rings, power_spectrum, radial_average
from stickiness.measured.self_affine_fit import (
    LOWEST_MODES,
    NYQUIST_SHARE,
    SelfAffineFit,
    fit_rings,
    narrow_rings,
)
from stickiness.measured.topography import Profile, Topography
from stickiness.spectrum.kinds import Tabulated

RINGS = 10  #: per decade, of the spectrum that is shown and integrated
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
    q_min: float  #: lowest wave number that taper and levelling do not change [1/length]
    cutoff: Cutoff  #: highest wave number that the instrument resolves
    lowest: float  #: wave number of the scan [1/length]
    anisotropy: float  #: amplitude of the dependence on direction; NaN for profiles
    fit: SelfAffineFit  #: between `q_min` and the cutoff

    @classmethod
    def within_fit(cls, rings, area, narrow, cutoff, lowest, anisotropy, fit) -> MeasuredSpectrum:
        """Spectrum whose limits are those within which `fit` found data."""
        limits = fit.q_min, replace(cutoff, q=fit.q_max)
        return cls(rings, area, narrow, *limits, lowest, anisotropy, fit)

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

    The taper is that of `psd.power_spectrum`.

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
    narrow = narrow_rings(plane)
    step = max(plane.dqx, plane.dqy)
    q_min = _lowest(limits, step, plane.blur)
    steps = heights.dx, heights.dy
    cutoff = _cutoff(limits, narrow, q_min, plane.q_nyquist, heights.heights, steps)
    fit = fit_rings(narrow, q_min, cutoff.q)
    rings = radial_average(plane, bins_per_decade=RINGS)
    area, lowest = rings.modes * plane.dqx * plane.dqy, min(plane.dqx, plane.dqy)
    anisotropy = plane.anisotropy(fit.q_min, fit.q_max)[0]
    return MeasuredSpectrum.within_fit(rings, area, narrow, cutoff, lowest, anisotropy, fit)


def _analyse_profile(heights: Profile, taper: Taper, limits: Limits) -> MeasuredSpectrum:
    line = profiles.profile_spectrum(heights.heights, heights.dx, taper)
    lowest = float(line.q[0])
    q_min = _lowest(limits, lowest, line.blur)
    # Unevenly spaced points resolve no wave shorter than twice their largest gap.
    nyquist = min(line.q_nyquist, np.pi / max(heights.largest_gap, heights.dx))
    pilot = line.rings(profiles.FINE)
    pilot = replace(pilot, psd=pilot.psd / pilot.q)  # proportional to C
    cutoff = _cutoff(limits, pilot, q_min, nyquist, heights.heights, (heights.dx,))
    narrow, fit = profiles.isotropic(line, q_min, cutoff.q)
    q, mean, dof = merge_rings(narrow, narrow.psd, RINGS)
    rings = RadialPSD(q, mean, mean / np.sqrt(dof), np.rint(dof).astype(int), dof)
    area = ring_areas(q, lowest)
    return MeasuredSpectrum.within_fit(rings, area, narrow, cutoff, lowest, np.nan, fit)


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


def _cutoff(
    limits: Limits,
    rings: RadialPSD,
    q_min: float,
    q_nyquist: float,
    heights: NDArray,
    steps: tuple[float, ...],
) -> Cutoff:
    """Lowest of the cutoffs that are given, detected or general."""
    if limits.fit_to is not None:
        return Cutoff(2 * np.pi / limits.fit_to, "as given (fit_to)")
    found = [Cutoff(NYQUIST_SHARE * q_nyquist, "half the Nyquist wave number")]
    if limits.resolution is not None:
        found.append(Cutoff(2 * np.pi / limits.resolution, "resolution of the instrument"))
    if limits.tip_radius is not None:
        blunt = tip_cutoff(heights, steps, limits.tip_radius)
        if blunt is not None:
            found.append(Cutoff(2 * np.pi / blunt, "shape of the tip", detected=True))
    bend = find_bend(rings, q_min, q_nyquist) if limits.detect else None
    if bend is not None:
        reason = f"{bend.kind} of the instrument (C falls as q^-{max(bend.exponent, 0):.1f} beyond)"
        found.append(Cutoff(bend.q, reason, detected=True))
    lowest = min(found, key=lambda cutoff: cutoff.q)
    if not lowest.q > q_min:
        end = f"at wavelengths of {2 * np.pi / lowest.q:.3g} m" if lowest.q else "everywhere"
        raise ValueError(
            f"{lowest.reason} ends the spectrum {end}, and the longest wavelength that can be used "
            f"is {2 * np.pi / q_min:.3g} m: nothing is left; measure a larger area or give "
            "fit_from and fit_to"
        )
    return lowest
