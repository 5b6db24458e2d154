"""Paths of an adhesive profile by projected gradient flow: an independent minimiser.

A periodic elastic half-space in plane strain against a rigid profile. At every mean gap the energy
falls by small steps of projected gradient, so that states stay on their branch. Nothing here is
shared with `stickiness.adhesive`.
"""

import numpy as np


def project(gap, mean):
    """Nearest gaps that are not negative and have this mean."""
    shift = mean - gap.mean()
    for _ in range(50):
        moved = np.maximum(gap + shift, 0)
        lacking = mean - moved.sum() / gap.size
        if abs(lacking) < 1e-14:
            break
        shift += lacking / max(np.count_nonzero(moved) / gap.size, 1e-3)
    return moved


def follow(profile, work, reach, mean_gaps, gap, tol=1e-5):
    """Energies and mean pressures along mean gaps, and the last gap; `profile` is one period 2 pi.

    The law is the exponential of adhesion length `work` and range `reach`; E* is 1.
    """
    stiffness = np.arange(profile.size // 2 + 1) / 2
    step = 1 / stiffness.max()
    # A product with a matrix is faster than transforms of so few points.
    waves = np.fft.rfft(np.eye(profile.size), axis=0)
    matrix = np.fft.irfft(stiffness[:, None] * waves, profile.size, axis=0)

    def deform(gap):
        return matrix @ (gap + profile)

    energies, pressures = [], []
    for mean in mean_gaps:
        gap, change = project(gap, mean), np.inf
        while change > tol * reach:
            force = deform(gap) + work / reach * np.exp(-gap / reach)
            moved = project(gap - step * force, mean)
            change, gap = np.abs(moved - gap).max(), moved
        force = deform(gap) + work / reach * np.exp(-gap / reach)
        stored = np.mean((gap + profile) * deform(gap)) / 2
        energies.append(stored - work * np.mean(np.exp(-gap / reach)))
        pressures.append(-force[gap > 0].mean())
    return np.array(energies), np.array(pressures), gap
