"""Adhesive contact of a periodic elastic solid at a prescribed mean pressure or mean gap."""

import warnings
from dataclasses import dataclass, replace

import numpy as np

from stickiness.adhesive import edge_zone
from stickiness.adhesive.equilibrium import relax
from stickiness.adhesive.scaling import APPROACH, CLOSEST, SEPARATION, Control, Scaled
from stickiness.arguments import grid, integer, number, numbers
from stickiness.plausibility import PlausibilityWarning, warn_of_heights, warn_of_pressure
from stickiness.repulsive.grids import check_length, measure_slope
from stickiness.repulsive.solver import ConvergenceError
from stickiness.solids import HALF_SPACE, check_solid

# Pixel over epsilon^2/l_a above which edges of contact are a matter of the grid alone. At 2 a
# sphere of Tabor parameter 5 holds 20 % too much.
_COARSEST = 4.0


class PullOffError(ConvergenceError):
    """The tension exceeds what the interface can hold: there is no equilibrium but at infinity."""


def solve(
    heights,
    length,
    law,
    pressure=None,
    mean_gap=None,
    start=None,
    tol=1e-8,
    max_iterations=3000,
    logger=None,
    solid=HALF_SPACE,
):
    """Solve the adhesive contact of an elastic solid with a rigid periodic surface.

    The problem has several solutions in general. The one found is the stable state, an `Adhesion`,
    that a descent in energy reaches from `start`. At a prescribed pressure the states are ordered:
    that with the widest gaps is where loading from afar ends, that with the closest where
    unloading from full contact does. `Adhesion.enthalpy` tells which of two states at one pressure
    is the deeper minimum, `Adhesion.energy` at one mean gap.

    Parameters
    ----------
    heights : array_like
        Heights ``(n0, n1)`` of the rigid surface (positive towards the half-space), any unit.
    length : float or tuple of float
        Side of the cell along axis 0 (pixels are then square), or both sides; same unit.
    law : TractionLaw
        Attraction, its adhesion length and range in the same unit.
    pressure, mean_gap : float
        Give one: mean pressure in units of E*, negative for tension, or mean gap.
    start : str, Adhesion, repulsive.Contact or array_like, optional
        "approach" (default): as from the solution without adhesion at the same control; under
        tension, from the adhesive solution at zero pressure. At a prescribed pressure coarser
        grids lead there, unless a descent on any of them meets negative curvature, which a jump
        would; a `solver.Contact` as the start does without them. "separation": from full
        contact, at a prescribed pressure only (`path` follows a mean gap back). Or any state on
        the same grid, or its gap: the start of a descent.
    tol : float
        Largest accepted `Adhesion.residual`.
    max_iterations : int
        Largest number of iterations.
    logger : logging.Logger, optional
        Told the progress at level DEBUG.
    solid : solids.HalfSpace or solids.Layer, optional
        Elastic solid, a half-space by default; the thickness of a layer is in the unit of
        `length`. A mean gap is that between the surfaces: see `solids` on the approach of the
        backing.

    Raises
    ------
    ValueError
        If an argument is not what it should be.
    PullOffError
        If the tension tears the surfaces apart; it carries the last iterate.
    ConvergenceError
        If `max_iterations` do not suffice; it carries the last iterate.

    Warns
    -----
    PlausibilityWarning
        If the pixels are far too large for the edges of contact, or arguments are probably in
        different units.

    Examples
    --------
    >>> import numpy as np
    >>> from stickiness import adhesive
    >>> law = adhesive.Maugis(adhesion_length=1e-4, range=1e-3)
    >>> adhesive.solve(np.zeros((8, 8)), 1.0, law, pressure=-0.099).repulsive_area_fraction
    1.0
    """
    heights = grid("heights", heights)
    lengths = check_length(length, heights.shape)
    tol = number("tol", tol)
    max_iterations = integer("max_iterations", max_iterations, least=1)
    if isinstance(law, type) or not hasattr(law, "evaluate"):
        raise ValueError(f"law must be a TractionLaw such as Maugis(...), got {law!r}")
    _check_control(pressure, mean_gap, law)
    scaled = Scaled.of(heights, lengths, law, check_solid(solid))
    scaled.check_start(start, mean_gap)
    warn_of_heights(scaled.rms_height, lengths[0])
    if pressure is not None and pressure > 1:
        stiffening = 1 / solid.factor(2 * np.pi / max(lengths))
        warn_of_pressure(pressure, measure_slope(heights, lengths) * stiffening)
    if scaled.rms_height > 0:
        _warn_of_edges(lengths[0] / heights.shape[0], law)
    control, effort = Control(pressure, mean_gap), Effort(tol, max_iterations, logger)
    gap, branch, spent = _find_start(scaled, start, control, effort)
    return relax_from(scaled, gap, branch, control, effort, spent)


@dataclass(frozen=True)
class Effort:
    """When to stop, and who is told the progress: see `solve`."""

    tol: float
    max_iterations: int
    logger: object = None


def relax_from(scaled, gap, branch, control, effort, spent=(0, 0)):
    """Find the state that a descent from a gap in scaled units ends in; errors as of `solve`.

    None stands for loading from afar. `spent`: iterations and convolutions that went into the
    start.
    """
    before = scaled.surface.pairs
    problem = scaled.problem(control)
    pressure, tol = control.pressure, effort.tol
    state, separated = relax(
        problem, gap, tol, effort.max_iterations, closing=branch == APPROACH, logger=effort.logger
    )
    state.iterations += spent[0]
    pairs = scaled.surface.pairs - before + state.start_pairs + spent[1]
    result = scaled.adhesion(state, branch, problem, pairs)
    if pressure is not None:  # as given, not as scaled there and back
        result = replace(result, mean_pressure=float(pressure))
    if separated:
        raise PullOffError(
            f"pressure = {pressure!r} pulls the surfaces apart: they hold less on this branch "
            f"(the strength of the law is {scaled.original_law.strength:.6g}); "
            "control mean_gap instead",
            result,
        )
    if not state.residual <= tol:
        raise ConvergenceError(
            f"residual {state.residual:.2e} after {state.iterations} iterations, "
            f"asked for {tol:.2e}: raise max_iterations, or tol if it is near rounding",
            result,
        )
    return result


def _find_start(scaled, start, control, effort):
    """Start of the descent as in `relax_from`, its branch, and what went into it."""
    nothing, mean_gap = (0, 0.0), control.mean_gap
    if isinstance(start, str) and start == SEPARATION:
        return np.zeros(scaled.surface.heights.shape), SEPARATION, nothing
    if start is not None and not isinstance(start, str):
        return scaled.first_gap(start, mean_gap), getattr(start, "branch", APPROACH), nothing
    if mean_gap is not None or control.pressure >= 0:
        return None, APPROACH, nothing
    before = scaled.surface.pairs
    unloaded = scaled.problem(Control(pressure=0.0))
    state, _ = relax(unloaded, None, effort.tol, effort.max_iterations)
    pairs = scaled.surface.pairs - before + state.start_pairs
    return state.gap, APPROACH, (state.iterations, pairs)


def _warn_of_edges(pixel, law):
    """Warn if the pixels are far too large for the law to act at the edges of contact."""
    ratio = edge_zone.resolution(pixel, law.range, law.adhesion_length)
    if ratio > _COARSEST:
        warnings.warn(
            f"a pixel of {pixel:.3g} does not resolve the edges of contact under a range of "
            f"{law.range:.3g} and an adhesion length of {law.adhesion_length:.3g}: points snap in "
            "and out one by one, and pull-off is too strong. Take pixels of at most "
            f"{edge_zone.COARSEST * pixel / ratio:.3g} (range^2/(2 adhesion_length)), "
            "or a longer range",
            PlausibilityWarning,
            stacklevel=3,
        )


def _check_control(pressure, mean_gap, law):
    if (pressure is None) == (mean_gap is None):
        raise ValueError(
            f"exactly one of pressure and mean_gap must be given, got {pressure!r}, {mean_gap!r}"
        )
    name, value = ("pressure", pressure) if mean_gap is None else ("mean_gap", mean_gap)
    array = numbers(name, value)
    if array.ndim or not np.isfinite(array):
        raise ValueError(f"{name} must be a finite number, got {value!r}")
    if mean_gap is not None:
        lowest = 0.0 if law.hard_wall else -CLOSEST * law.range
        if mean_gap < lowest:
            raise ValueError(f"mean_gap must be at least {lowest!r}, got {mean_gap!r}")
