"""Gaussian line profiles of an isotropic spectrum, from a plain sum over its waves."""

import numpy as np


def synthesise_profile(psd, length, points, seed):
    """Heights of a profile of this length, a quarter of one whose spectrum is C1 of `psd`(q)."""
    step = length / points
    count = 4 * points
    q = 2 * np.pi * np.fft.rfftfreq(count, step)[1:]
    # C1(q) is the integral of C(sqrt(q^2 + k^2)) over all k, here by k = q sinh(t).
    some = np.geomspace(q[0], q[-1], 300)
    t = np.linspace(0, 20, 2001)
    along = some[:, None] * np.cosh(t)
    c1 = 2 * np.trapezoid(psd(along) * along, t, axis=1)
    c1 = np.exp(np.interp(np.log(q), np.log(some), np.log(c1)))
    rng = np.random.default_rng(seed)
    normal = rng.normal(size=(2, q.size))
    modes = np.sqrt(2 * c1 * q[0]) * (normal[0] + 1j * normal[1]) / 2
    heights = np.fft.irfft(np.concatenate([[0], modes]) * count, count)
    return heights[:points]
