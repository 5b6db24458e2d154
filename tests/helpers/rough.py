"""Self-affine heights from plain transforms, independent of the library's synthesis."""

import numpy as np


def on_any_grid(n, hurst=0.8, magnification=None, seed=0, modes=64):
    """Band-limited periodic heights of unit rms; the same surface on every even grid."""
    magnification = magnification or n // 8
    coarse = np.fft.fft2(np.random.default_rng(seed).standard_normal((modes, modes)))
    coarse *= _amplitudes((modes, modes), min(magnification, modes // 2 - 1), hurst)
    k = np.fft.fftfreq(modes, 1 / modes)
    kept = np.abs(k) < min(n, modes) // 2
    index = k[kept].astype(int) % n
    fine = np.zeros((n, n), complex)
    fine[np.ix_(index, index)] = coarse[np.ix_(kept, kept)]
    heights = np.fft.ifft2(fine).real
    return heights / heights.std()


def periodic(shape, modes=12, hurst=0.8, seed=0):
    """Heights of unit rms with wave numbers up to `modes` on a grid of any shape."""
    noise = np.fft.fft2(np.random.default_rng(seed).standard_normal(shape))
    heights = np.fft.ifft2(noise * _amplitudes(shape, modes, hurst)).real
    return heights / heights.std()


def _amplitudes(shape, largest, hurst):
    radius = np.hypot(*np.meshgrid(*(np.fft.fftfreq(n, 1 / n) for n in shape), indexing="ij"))
    inside = (radius >= 1) & (radius <= largest)
    return np.where(inside, np.maximum(radius, 1) ** -(1 + hurst), 0)
