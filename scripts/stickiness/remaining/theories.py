"""Other theories of the adhesion that remains, to compare with simulations.

The local criterion and the energy of full contact each describe one end of the problem. The DMT
form of the paper adds attraction to the gaps of contact without adhesion.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.arguments import plain, positive
from stickiness.persson.theory import Persson
from stickiness.spectrum.interface import Spectrum
from stickiness.spectrum.kinds import Shells

# Of the tough limit of `adhesion.equivalent_sphere` with the a_V of the edges of contact and a
# slope of area against load of 2: contact grows by itself from l_a = LOCAL h'^3/h'' on.
LOCAL = 0.28
_CUTS = 60
_LOADS, _LOWEST, _HIGHEST = 60, 1e-5, 4.0  # over the rms gradient
_GAPS = np.geomspace(1e-4, 16, 80)  # over h_rms
_MOST_SHELLS = 40  # a thousand shells take long, and forty give the same


def full_contact_share(energy_ratio: ArrayLike) -> float | NDArray:
    """Share that full contact leaves of the work of adhesion (Persson & Tosatti 2001).

    ``1 - U_full/w``, 0 where it is negative. doi:10.1063/1.1398300
    """
    (x,) = positive(energy_ratio=energy_ratio)
    return plain(np.maximum(1 - 1 / x, 0.0))


def local_threshold(spectrum: Spectrum) -> tuple[float, float, float]:
    """Adhesion length above which contact grows by itself at every scale [length].

    The local criterion, JKR at the shortest wave, taken at every cut of the spectrum.

    Returns
    -------
    largest, cut, finest : float
        Its maximum over the cuts, the wave number where that is [1/length], and the value at the
        finest wave.
    """
    spectrum = spectrum.averaged()
    cuts = np.geomspace(spectrum.q0, spectrum.q1, _CUTS)[1:]
    slope, curvature = (
        np.sqrt(np.array([float(spectrum.variance_below(q, power)) for q in cuts]))
        for power in (2, 4)
    )
    values = np.where(curvature > 0, LOCAL * slope**3 / np.where(curvature > 0, curvature, 1), 0)
    most = int(np.argmax(values))
    return float(values[most]), float(cuts[most]), float(values[-1])


def dmt_share(spectrum: Spectrum, adhesion_length: ArrayLike, range: ArrayLike) -> float | NDArray:
    """Share of a DMT contact by Persson's theory: attraction over gaps without adhesion.

    The largest gain of energy over the load, with the exponential law. For a range that is
    comparable with the heights; as the range falls, edges of contact that attraction deforms are
    what this leaves out.

    Parameters
    ----------
    spectrum : Spectrum
        Of the surface.
    adhesion_length, range : array_like
        Work of adhesion over E*, and range of the exponential law [length]; of one shape.
    """
    length, range = np.broadcast_arrays(*positive(adhesion_length=adhesion_length, range=range))
    spectrum = _group_shells(spectrum) if spectrum.is_discrete else spectrum
    theory = Persson(spectrum)
    load = np.geomspace(_LOWEST, _HIGHEST, _LOADS) * spectrum.rms_slope
    gap, area = theory.mean_gap(load), theory.area_fraction(load)
    # Elastic energy, the work of the load from afar, by parts: int gap dp - p gap.
    first = load[0] * gap[0]
    strips = np.diff(np.log(load)) * ((load * gap)[1:] + (load * gap)[:-1]) / 2
    energy = first + np.concatenate([[0.0], np.cumsum(strips)]) - load * gap
    u = _GAPS * spectrum.h_rms
    within = np.array([theory.gap_cumulative(u, p) for p in load])
    # Mean of exp(-u/range), by parts; beyond the last gap there are no more.
    reach = range[..., None, None]
    decay = np.exp(-u / reach)
    attraction = np.trapezoid(decay / reach * within, u, axis=-1) + decay[..., -1] * within[:, -1]
    gained = np.max(area + attraction - energy / length[..., None], axis=-1)
    return plain(np.maximum(gained, 0.0))


def _group_shells(shells: Shells, most: int = _MOST_SHELLS) -> Shells:
    """Merge shells to at most `most`, with the same slope and energy of full contact."""
    if len(shells.q) <= most:
        return shells
    bins = np.geomspace(shells.q0, shells.q1, most + 1)[1:-1]
    index = np.searchsorted(bins, shells.q, side="right")
    slope, energy = (
        np.bincount(index, shells.variance * shells.q**power, minlength=most) for power in (2, 1)
    )
    there = energy > 0
    q = slope[there] / energy[there]
    return Shells(q, slope[there] / q**2)
