"""Adhesion that remains on periodic heights, by a minimiser that is none of the solvers."""

import numpy as np
from scipy import optimize


def stiffness(n, length=1.0):
    """Pressure over displacement of every wave on a half-space [1/length], for E* = 1."""
    q = 2 * np.pi * np.fft.fftfreq(n, length / n)
    return np.hypot(q[:, None], q) / 2


def find_full_contact_energy(heights, length=1.0):
    """Elastic energy per area of full contact over E*."""
    modes = np.fft.fft2(heights) / heights.size
    return float(np.sum(stiffness(len(heights), length) * np.abs(modes) ** 2)) / 2


def minimise(heights, adhesion_length, range_, starts, length=1.0):
    """Largest share that remains, by L-BFGS-B over the gaps, which are at least zero."""
    q = stiffness(len(heights), length)

    def find_energy(gap):
        gap = gap.reshape(heights.shape)
        pressure = np.fft.ifft2(q * np.fft.fft2(gap + heights)).real
        attraction = adhesion_length * np.exp(-gap / range_)
        energy = np.mean(pressure * (gap + heights)) / 2 - np.mean(attraction)
        gradient = (pressure + attraction / range_) / gap.size
        unit = adhesion_length * 1e-3  # of energies of order 1
        return energy / unit, gradient.ravel() / unit

    energies = [
        optimize.minimize(
            find_energy,
            start.ravel(),
            jac=True,
            method="L-BFGS-B",
            bounds=[(0, None)] * start.size,
            options={"maxiter": 4000, "maxfun": 8000, "ftol": 1e-12, "gtol": 1e-9},
        ).fun
        for start in starts
    ]
    return max(-min(energies) * 1e-3, 0.0)
