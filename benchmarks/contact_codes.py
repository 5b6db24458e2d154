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


@dataclass(frozen=True, eq=False)
class Run:
    """What a code found, how long it took and, where it tells, how much work it did."""

    pressure: np.ndarray
    seconds: float
    iterations: int | None
    fft_pairs: float | None


def complementarity(pressure, heights, length):
    """Mean gap under the pressure, and mean gap, over h_rms: by numpy's transforms.

    The first is ``sum(p g) / sum(p)``, the error that all codes are held to; the gap is measured
    from its smallest value, so that penetration counts as well.
    """
    n0, n1 = heights.shape
    q0 = 2 * np.pi * np.fft.fftfreq(n0, length / n0)
    q1 = 2 * np.pi * np.fft.rfftfreq(n1, length / n1)
    q = np.hypot(q0[:, None], q1[None, :])
    q[0, 0] = np.inf
    gap = np.fft.irfft2(2 * np.fft.rfft2(pressure) / q, s=heights.shape) - heights
    gap -= gap.min()
    error = np.sum(pressure * gap) / pressure.sum()
    return error / heights.std(), gap.mean() / heights.std()


def stickiness(heights, length, pressure, tol):
    """Run this project's solver."""
    from stickiness import repulsive

    begin = time.process_time()
    contact = repulsive.solve(heights, length, pressure, tol=tol)
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


def aspher(heights, length, pressure, tol, precision="double"):
    """Run ASPHER on nested grids with its spectral periodic half-space.

    It makes its operators inside the call that is timed; they are a small part.
    """
    from aspher import solve_nested

    begin = time.process_time()
    result = solve_nested(
        heights.shape[0],
        -heights.ravel(),
        pressure,
        domain_size=length,
        tol=tol,
        backend="periodic",
        precision=precision,
    )
    seconds = time.process_time() - begin
    return Run(np.array(result.pressure).reshape(heights.shape), seconds, result.iterations, None)


CODES = {
    "stickiness": stickiness,
    "aspher": aspher,
    # In single precision until that no longer pays, then in double.
    "aspher_mixed": partial(aspher, precision="float_then_double"),
    "tamaas": tamaas,
    "contactmechanics": contact_mechanics,
}
