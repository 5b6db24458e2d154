"""Parameters of roughness profiles by ISO 21920-2 (ISO 4287), on profiles that repeat."""

import numpy as np

ALPHA = np.sqrt(np.log(2) / np.pi)  # of the Gaussian filter, ISO 16610-21
SECTIONS = 5  # sampling lengths of an evaluation length


def filter_waves(heights, dx, cutoff):
    """Waves of a periodic profile that a Gaussian filter leaves: half of those at the cut-off."""
    q = np.fft.rfftfreq(len(heights), dx)
    passed = np.exp(-np.pi * (ALPHA * cutoff * q) ** 2)
    return np.fft.irfft(np.fft.rfft(heights) * passed, len(heights))


def evaluate(heights, dx, cutoff, shortest):
    """Ra, Rq, Rz and RSm of a profile longer than six cut-offs; `shortest` is lambda_s."""
    smooth = filter_waves(heights, dx, shortest)
    n = round(cutoff / dx)
    profile = (smooth - filter_waves(smooth, dx, cutoff))[n // 2 :][: SECTIONS * n]
    sections = profile.reshape(SECTIONS, n)
    rz = np.mean(np.ptp(sections, axis=1))
    # Elements have a peak and a valley beyond a tenth of Rz.
    beyond = np.sign(profile) * (np.abs(profile) > 0.1 * rz)
    beyond = beyond[beyond != 0], np.flatnonzero(beyond)
    rises = beyond[1][1:][np.diff(beyond[0]) > 0]
    return np.mean(np.abs(profile)), np.std(profile), rz, np.mean(np.diff(rises)) * dx


def synthesise(spectrum, n, dx, rng):
    """Gaussian profile across an isotropic surface: C1(q) = integral of C(sqrt(q^2 + k^2)) dk."""
    q = 2 * np.pi * np.fft.rfftfreq(n, dx)[1:]
    few = np.geomspace(q[0], q[-1], 300)
    k = np.append(0.0, np.geomspace(1e-3 * spectrum.q0, spectrum.q1, 500))
    line = 2 * np.trapezoid(spectrum.psd(np.hypot(few[:, None], k)), k, axis=1)
    power = np.interp(q, few, line)
    modes = rng.normal(size=(2, len(q))) * np.sqrt(power * np.pi / (n * dx)) * n
    return np.fft.irfft(np.append(0.0, modes[0] + 1j * modes[1]), n)
