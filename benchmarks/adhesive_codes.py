"""Drivers of the reference codes with adhesion: same heights, load and law, one thread.

Every driver takes heights ``(n, n)``, the side of the square cell, a traction law, the mean
pressure in units of E*, a tolerance relative to the law's strength and a limit of processor
seconds, and returns a `Run`. What a run
really reached is measured for all codes by `assess`. Only solutions are timed, not the set-up of
operators and plans, and in processor seconds.

Each peer runs in the strongest way found, with Tamaas 2.9.0 and Adhesion 0.93 with NuMPI 0.18.1:

* Tamaas takes attraction as a functional of the gap, so the gap has to be the primal variable. It
  meets a mean gap in a tenth of the iterations that a mean pressure takes, so the load is found by
  iterating on the mean gap.
* Adhesion prescribes a displacement. Its energy and gradient with the gap as variable take a load
  by one more term, p times the mean gap, if the half-space is told not to resist its mean
  displacement (``stiffness_q0=0``). NuMPI's trust-region Newton method minimises that energy.
"""

import contextlib
import time
import warnings
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, eq=False)
class Run:
    """What a code found and how long it took."""

    gap: np.ndarray  # exactly zero in contact
    seconds: float  # processor time of all solutions
    iterations: int | None  # as the code counts them, or evaluations of the energy
    solves: int = 1  # solutions it took to meet the load
    # Processor time of the last of several solutions: what the code would take if it were told the
    # mean gap that belongs to the load.
    last: float | None = None


@dataclass(frozen=True)
class Assessment:
    """Measures of a solution that do not depend on the code it comes from."""

    residual: float  # largest violation of the conditions of equilibrium over the law's strength
    energy: float  # total potential energy per area over E* and rms height; tells branches apart
    contact: float  # share of points without a gap
    attractive: float  # share of points with a gap between zero and the range of the law


def assess(gap, heights, length, law, pressure):
    """Measure how well a gap meets the conditions of equilibrium, and what it amounts to.

    With u = gap + heights the net pressure is the prescribed mean plus the field ``|q| u_q / 2``,
    by numpy's transforms, and the repulsive pressure is r = net pressure + traction(gap). Where
    the surfaces are apart r must vanish, where they touch it must not be negative. Both are one
    condition, min(r, k gap) = 0 with any stiffness k > 0; here k is the largest stiffness of the
    grid, so that a gap of rounding size over a loaded point counts for its size. Negative gaps
    count in full and are then set to zero. The residual is the largest modulus over the grid, in
    units of the strength of the law: the mean pressure is as a rule smaller by some factor of
    one to ten. A load that is not met shows as a residual in every open point.
    """
    n0, n1 = heights.shape
    q0 = 2 * np.pi * np.fft.fftfreq(n0, length / n0)
    q1 = 2 * np.pi * np.fft.rfftfreq(n1, length / n1)
    stiffness = np.hypot(q0[:, None], q1) / 2
    largest = stiffness.max()
    penetration = largest * np.maximum(-gap, 0).max()
    gap = np.maximum(gap, 0)
    u = gap + heights
    elastic = np.fft.irfft2(np.fft.rfft2(u) * stiffness, s=heights.shape)
    r = pressure + elastic + law.traction(gap)
    residual = max(np.abs(np.minimum(r, largest * gap)).max(), penetration) / law.strength
    energy = np.mean(u * elastic / 2 + law.potential(gap) + pressure * gap) / heights.std()
    near = (gap > 0) & (gap <= law.range)
    return Assessment(float(residual), float(energy), float(np.mean(gap == 0)), float(near.mean()))


def stickiness(heights, length, law, pressure, tol, limit=np.inf):
    """Run this project's solver."""
    from stickiness import surface
    from stickiness.adhesive import solve

    # Its residual is relative to the flattening pressure where that exceeds the strength.
    flattening = surface.moments(heights, length).rms_slope / 2
    own_tol = tol * law.strength / max(law.strength, flattening)
    begin = time.process_time()
    contact = solve(heights, length=length, law=law, pressure=pressure, tol=own_tol)
    seconds = time.process_time() - begin
    return Run(contact.gap, seconds, contact.iterations)


def tamaas(heights, length, law, pressure, tol, limit=np.inf):
    """Run Tamaas, `PolonskyKeerRey` on the gap, at the mean gap that belongs to the load.

    Frerot et al. 2020, doi 10.21105/joss.02121; Rey, Anciaux & Molinari 2017, doi
    10.1007/s00466-017-1392-5. A secant method adjusts the mean gap, from that without adhesion;
    as long as the load is off by more than a hundredth, a tolerance of 1e-4 does.
    """
    begin = time.process_time()
    solves = 0

    def load_at(mean_gap, tolerance):
        nonlocal solves
        solves += 1
        gap, load = _tamaas_solve(heights, length, law, mean_gap, tolerance, by_gap=True)
        return gap, load / pressure

    guess = _tamaas_solve(heights, length, None, pressure, 1e-4, by_gap=False)[0].mean()
    gap, load = load_at(guess, max(tol, 1e-4))
    # A smaller gap carries more: without adhesion some exp(-2 gap/h_rms).
    step = np.clip((load - 1) * heights.std() / 4, -0.2 * guess, 0.2 * guess)
    restart = begin
    while solves < 15 and time.process_time() - begin < limit:
        tolerance = tol if abs(load - 1) < 1e-2 else max(tol, 1e-4)
        guess, before = guess + step, load
        restart = time.process_time()
        gap, load = load_at(guess, tolerance)
        if abs(load - 1) < 10 * tol or load == before:
            break
        step = np.clip(step * (load - 1) / (before - load), -0.2 * guess, 0.2 * guess)
    end = time.process_time()
    return Run(gap, end - begin, None, solves, end - restart)


def _tamaas_solve(heights, length, law, target, tol, by_gap):
    """Gap and mean pressure at a prescribed mean gap or pressure."""
    import tamaas as tm

    tm.set_log_level(tm.LogLevel.error)
    tm.initialize(1)
    kind = tm.PolonskyKeerRey
    model = tm.ModelFactory.createModel(
        tm.model_type.basic_2d, [length, length], list(heights.shape)
    )
    model.E, model.nu = 1.0, 0.0
    if law is None:
        solver = kind(model, heights, tol)
    else:
        solver = kind(model, heights, tol, kind.gap, kind.gap if by_gap else kind.pressure)
        functional = _tamaas_functional(tm, law)(heights)
        functional.parameters = {"rho": law.range, "surface_energy": law.adhesion_length}
        solver.addFunctionalTerm(functional)
    solver.max_iter = 3000
    solver.solve(target)
    gap = np.array(model["gap"]).reshape(heights.shape)
    return gap, float(np.array(model.traction).mean())


def _tamaas_functional(tm, law):
    functionals = {
        "Exponential": tm.ExponentialAdhesionFunctional,
        "Maugis": tm.MaugisAdhesionFunctional,
    }
    try:
        return functionals[type(law).__name__]
    except KeyError:
        raise NotImplementedError(f"Tamaas has no {type(law).__name__} law") from None


def adhesion(heights, length, law, pressure, tol, limit=np.inf):
    """Run Adhesion's energy with NuMPI's bounded trust-region Newton method.

    It starts from the gap without adhesion, which is not timed.
    """

    from NuMPI.Optimization import tr_newton_bounded

    from stickiness import repulsive

    system = _adhesion_system(heights, length, law)
    objective = system.primal_objective(0.0, gradient=True)
    points_per_area = heights.size / length**2
    start = repulsive.solve(heights, length, pressure, tol=1e-6).gap.ravel()
    begin, calls, last = time.process_time(), 0, start

    def energy(gap):
        nonlocal calls, last
        if time.process_time() - begin > limit:
            raise _OutOfTime
        calls, last = calls + 1, np.array(gap)
        value, slope = objective(gap)
        return (
            value * points_per_area + pressure * gap.sum(),
            np.asarray(slope).ravel() * points_per_area + pressure,
        )

    def hessian_product(gap, direction):
        shaped = (field.reshape(heights.shape) for field in (gap, direction))
        return system.primal_hessian_product(*shaped).ravel() * points_per_area

    with contextlib.suppress(_OutOfTime):
        last = tr_newton_bounded(
            energy,
            start,
            hessian_product,
            jac=True,
            bounds_lo=0.0,
            gtol=tol * law.strength,
            maxiter=500,
            delta0=0.1 * heights.std(),
            delta_max=heights.std(),
        ).x
    seconds = time.process_time() - begin
    return Run(np.reshape(last, heights.shape), seconds, calls)


class _OutOfTime(Exception):
    """Raised by a function that has no time left."""


def _adhesion_system(heights, length, law):
    """Half-space, heights and interaction as Adhesion has them."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # it warns of a missing MPI on import
        import ContactMechanics
        from Adhesion.Interactions import Exponential
        from Adhesion.System import BoundedSmoothContactSystem
        from SurfaceTopography import Topography

    if type(law).__name__ != "Exponential":
        raise NotImplementedError(f"Adhesion's driver has no {type(law).__name__} law")
    sides = (length, length)
    half_space = ContactMechanics.PeriodicFFTElasticHalfSpace(
        heights.shape, 1.0, sides, stiffness_q0=0.0
    )
    topography = Topography(heights, physical_sizes=sides, periodic=True)
    return BoundedSmoothContactSystem(
        half_space, Exponential(law.adhesion_length, law.range), topography
    )
