"""Drivers of the reference codes: same heights, load and residual, one thread.

Every driver takes heights ``(n0, n1)``, the side of the square cell, the mean pressure in units of
E* and a tolerance relative to h_rms, and returns a `Run`. Only the solution itself is timed, not
the set-up of operators and plans, and in processor seconds: on one thread that is what a machine
without other jobs would take.
"""

import time
import warnings
from dataclasses import dataclass
from functools import partial

import numpy as np
from scipy import fft


@dataclass(frozen=True, eq=False)
class Run:
    """What a code found, how long it took and, where it tells, how much work it did."""

    pressure: np.ndarray
    seconds: float
    iterations: int | None
    fft_pairs: float | None


def complementarity(pressure, heights, length, periodic=True):
    """Mean gap under the pressure, and mean gap, over h_rms: by plain transforms.

    The first is ``sum(p g) / sum(p)``, the error that all codes are held to; the gap is measured
    from its smallest value, so that penetration counts as well.
    """
    gap = (displace if periodic else displace_freely)(pressure, length) - heights
    gap -= gap.min()
    error = np.sum(pressure * gap) / pressure.sum()
    return error / heights.std(), gap.mean() / heights.std()


def displace(pressure, length):
    """Displacement of a periodic half-space, of zero mean."""
    n0, n1 = pressure.shape
    q0 = 2 * np.pi * np.fft.fftfreq(n0, length / n0)
    q1 = 2 * np.pi * np.fft.rfftfreq(n1, length / n1)
    q = np.hypot(q0[:, None], q1[None, :])
    q[0, 0] = np.inf
    return np.fft.irfft2(2 * np.fft.rfft2(pressure) / q, s=pressure.shape)


def displace_freely(pressure, length):
    """Displacement of a half-space without end, by Love's integral over square pixels."""
    n, pixel = max(pressure.shape), length / pressure.shape[0]
    x = (np.minimum(np.arange(2 * n), 2 * n - np.arange(2 * n)) + 0.5) * pixel
    x, y = np.meshgrid(x, x, indexing="ij", sparse=True)
    kernel = np.zeros((2 * n, 2 * n))
    for sign_x in (1, -1):
        for sign_y in (1, -1):
            a, b = x - (sign_x < 0) * pixel, y - (sign_y < 0) * pixel
            corner = a * np.arcsinh(b / np.abs(a)) + b * np.arcsinh(a / np.abs(b))
            kernel += sign_x * sign_y * corner / np.pi
    spectrum = fft.rfft2(kernel) * fft.rfft2(pressure, s=kernel.shape)
    return fft.irfft2(spectrum, s=kernel.shape)[tuple(map(slice, pressure.shape))]


def stickiness(heights, length, pressure, tol, periodic=True):
    """Run this project's solver."""
    from stickiness import repulsive

    begin = time.process_time()
    contact = repulsive.solve(heights, length, pressure, tol=tol, periodic=periodic)
    seconds = time.process_time() - begin
    return Run(contact.pressure, seconds, contact.iterations, contact.fft_pairs)


def tamaas(heights, length, pressure, tol):
    """Run Tamaas, `PolonskyKeerRey` (Frerot et al. 2020, doi 10.21105/joss.02121).

    Its error estimate turns out to be close to `complementarity`.
    """
    import tamaas as tm

    tm.set_log_level(tm.LogLevel.error)
    tm.initialize(1)
    model = tm.ModelFactory.createModel(
        tm.model_type.basic_2d, [length, length], list(heights.shape)
    )
    model.E, model.nu = 1.0, 0.0
    solver = tm.PolonskyKeerRey(model, heights, tol)
    solver.max_iter = 20_000
    begin = time.process_time()
    solver.solve(pressure)
    seconds = time.process_time() - begin
    return Run(np.array(model.traction), seconds, None, None)


def contact_mechanics(heights, length, pressure, tol):
    """Run ContactMechanics, its constrained conjugate gradients (Polonsky and Keer).

    Every iteration takes two convolutions.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # it warns of a missing MPI on import
        import ContactMechanics
        from ContactMechanics.Optimization import ConstrainedConjugateGradients

    half_space = ContactMechanics.PeriodicFFTElasticHalfSpace(heights.shape, 1.0, (length, length))
    begin = time.process_time()
    result = ConstrainedConjugateGradients.constrained_conjugate_gradients(
        half_space,
        heights,
        external_force=pressure * length**2,
        pentol=tol * heights.std(),
        maxiter=20_000,
    )
    seconds = time.process_time() - begin
    force = np.asarray(result.jac).reshape(heights.shape)
    return Run(np.abs(force) * heights.size / length**2, seconds, result.nit, 2 * result.nit + 1)


def aspher(heights, length, pressure, tol, **options):
    """Run ASPHER on nested grids.

    It makes its operators inside the call that is timed; they are a small part.
    """
    from aspher import solve_nested

    loaded = heights.shape[0], -heights.ravel(), pressure, length
    begin = time.process_time()
    result = solve_nested(*loaded, tol=tol, **options)
    seconds = time.process_time() - begin
    return Run(np.array(result.pressure).reshape(heights.shape), seconds, result.iterations, None)


_SPECTRAL = {"backend": "periodic"}
# Its fastest path: clusters of points, and on the finest grid only points that may touch.
_FREE = {"backend": "h2", "active_set": True, "light_result": True}

CODES = {
    "stickiness": stickiness,
    "aspher": partial(aspher, **_SPECTRAL, precision="double"),
    # In single precision until that no longer pays, then in double.
    "aspher_mixed": partial(aspher, **_SPECTRAL, precision="float_then_double"),
    "tamaas": tamaas,
    "contactmechanics": contact_mechanics,
}
FREE_EDGES = {
    "stickiness_free": partial(stickiness, periodic=False),
    "aspher_free": partial(aspher, **_FREE, precision="double"),
    "aspher_free_single": partial(aspher, **_FREE, precision="float"),
}
