"""Where an instrument stops resolving the surface: tip radius, blur and noise."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import special

from stickiness.measured.psd import RadialPSD, merge_rings

TIP_FACTOR = 0.5  #: curvature over 1/R from which the tip's shape shows (Sanner et al. 2022)
BLUR_EXPONENT = 5.0  #: C ~ q^-s falls faster than any self-affine surface does (s = 4 at H = 1)
NOISE_EXPONENT = 1.5  #: and slower than any (s = 2 at H = 0)

_RINGS = 20  # per decade
_WIDTH = np.log(10) / 4  # of the interval for the local exponent
_SCATTER = 0.05  # of ln C beyond sampling, so that rings of many modes do not decide alone
_ROOM = 10**0.5  # smallest ratio of the bend to the lowest wave number


@dataclass(frozen=True)
class Bend:
    """Wave number beyond which a spectrum is the instrument's rather than the surface's."""

    q: float  #: highest wave number of the surface's spectrum [1/length]
    #: the spectrum beyond falls faster or slower than that of any surface
    kind: Literal["blur", "noise"]
    exponent: float  #: s in C ~ q^-s just beyond


def tip_cutoff(heights: ArrayLike, steps: tuple[float, ...], radius: float) -> float | None:
    """Wavelength below which a spherical tip has left its own shape in the heights.

    A tip of radius R leaves no peak sharper than itself: heights are unreliable at distances over
    which some second difference reaches -1/(2R) (Sanner, Nöhring, Thimons, Jacobs & Pastewka
    2022, doi:10.1016/j.apsadv.2021.100190).

    Returns
    -------
    float or None
        Length of the stencil at which the sharpest peak reaches the limit, the largest over all
        axes; None if no peak is so sharp; infinity if there is one at every distance.
    """
    if not radius > 0:
        raise ValueError(f"radius must be positive, got {radius!r}")
    heights = np.asarray(heights, dtype=float)
    found = [
        _tip_cutoff_along(np.moveaxis(heights, axis, 0), step, TIP_FACTOR / radius)
        for axis, step in enumerate(steps)
    ]
    return max((length for length in found if length is not None), default=None)


def _tip_cutoff_along(h: NDArray, step: float, limit: float) -> float | None:
    def sharpest(k: int) -> float:
        return -float(np.min(h[2 * k :] - 2 * h[k:-k] + h[: -2 * k])) / (k * step) ** 2

    distances = np.unique(np.geomspace(1, len(h) // 4, 30).astype(int))
    curvatures = np.array([sharpest(int(k)) for k in distances])
    if curvatures[0] < limit:
        return None
    below = np.flatnonzero(curvatures < limit)
    if not len(below):
        return np.inf
    i = below[0]  # the curve falls as a power between the two distances
    share = np.log(curvatures[i - 1] / limit) / np.log(
        curvatures[i - 1] / max(curvatures[i], limit * 1e-9)
    )
    k = distances[i - 1] * (distances[i] / distances[i - 1]) ** share
    return float(2 * k * step)


def find_bend(rings: RadialPSD, q_min: float, q_nyquist: float) -> Bend | None:
    """Find the wave number beyond which blur or noise of the instrument dominates, if any does.

    The local exponent s of C ~ q^-s is fitted in intervals of a quarter of a decade. From the
    Nyquist wave number downwards, a spectrum that falls slower than q^-1.5 is noise and, below
    that, one that falls faster than q^-5 is blur: no self-affine surface has either, whatever its
    roll-off. A bend less than half a decade above `q_min` is ignored; the surface may be smooth.
    """
    q, slope = local_exponents(rings.between(q_min, q_nyquist))
    if not len(q):
        return None
    end = len(q)
    noise = _run_from_the_top(slope < NOISE_EXPONENT)
    blur = _run_from_the_top((slope > BLUR_EXPONENT)[: end - noise])
    for kind, length, start in (("blur", blur, end - noise - blur), ("noise", noise, end - noise)):
        if length and start and q[start - 1] > q_min * _ROOM:
            return Bend(float(q[start - 1]), kind, float(slope[start]))
    return None


def local_exponents(rings: RadialPSD) -> tuple[NDArray, NDArray]:
    """Wave numbers and exponents s of C ~ q^-s about rings with others on both sides."""
    if not len(rings):
        return np.empty(0), np.empty(0)
    q, mean, dof = merge_rings(rings, rings.psd, _RINGS)
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


def _run_from_the_top(flags: NDArray) -> int:
    """Number of the last entries that are all true."""
    others = np.flatnonzero(~flags)
    return len(flags) - (others[-1] + 1 if len(others) else 0)
