"""Adhesive contact of a periodic elastic solid at a prescribed mean pressure or mean gap."""

import warnings
from dataclasses import dataclass, replace

import numpy as np

from stickiness.adhesive import edge_zone
from stickiness.adhesive.equilibrium import relax
from stickiness.adhesive.problem import Problem, Surface, lowered
from stickiness.arguments import grid, integer, number, numbers
from stickiness.compiled import compiled
from stickiness.plausibility import PlausibilityWarning, warn_of_heights, warn_of_pressure
from stickiness.repulsive.half_space import check_length, measure_scale, measure_slope
from stickiness.repulsive.solver import ConvergenceError
from stickiness.solids import HALF_SPACE, check_solid

APPROACH, SEPARATION = "approach", "separation"
DEEPEST = 0.9  #: of the range: penetration of a start, or in the mean, without a wall
# Pixel over epsilon^2/l_a above which edges of contact are a matter of the grid alone. At 2 a
# sphere of Tabor parameter 5 holds 20 % too much.
_UNRESOLVED_PIXEL = 4.0


@dataclass(frozen=True, eq=False)
class Adhesion:
    """State of equilibrium of an adhesive contact; pressures in units of E*.

    Attributes
    ----------
    pressure : numpy.ndarray
        Net pressure at the interface, repulsion minus attraction, ``(n0, n1)``.
    gap : numpy.ndarray
        Gap in the unit of the heights: zero at the hard wall. A law without a wall has its
        equilibrium separation at gap 0, and negative gaps where it repels.
    mean_pressure, mean_gap : float
        Means of pressure and gap that keep the state: one is prescribed, the other follows. The
        gap is that between the surfaces; the mean compression of a layer is no part of it.
    repulsive_pressure, adhesive_pressure : float
        Positive and negative part of `pressure`, each averaged over the nominal area and
        positive: their difference is `mean_pressure` (to the residual).
    repulsive_area_fraction : float
        Share of points at the wall, or with a negative gap if the law has no wall: contact,
        under whatever pressure.
    net_repulsive_area_fraction : float
        Share of those where the net pressure is compressive: next to the edge of contact the
        attraction outweighs the wall's push.
    adhesive_area_fraction : float
        Share of other points with a gap up to the range.
    elastic_energy, interaction_energy : float
        Per nominal area, in units of E* times length; the latter is the mean of the potential.
    residual : float
        Largest violation of equilibrium at any point, over the larger of the rms pressure that
        flattens the surface (half its rms gradient times E*) and the law's strength. The
        violation is the unbalanced pressure, at the wall only if it pulls.
    iterations : int
        Iterations of conjugate gradients.
    fft_pairs : float
        Convolutions (a forward and a backward transform each), those of the start included.
    branch, control : str
        "approach" if the state was reached from wider gaps, "separation" if from closer ones;
        "pressure" or "mean_gap".
    law, length : TractionLaw, tuple of float
        Attraction, sides of the periodic cell.
    rms_height : float
        Root mean square of the heights about their mean.
    """

    pressure: np.ndarray
    gap: np.ndarray
    mean_pressure: float
    repulsive_pressure: float
    adhesive_pressure: float
    repulsive_area_fraction: float
    net_repulsive_area_fraction: float
    adhesive_area_fraction: float
    mean_gap: float
    elastic_energy: float
    interaction_energy: float
    residual: float
    iterations: int
    fft_pairs: float
    branch: str
    control: str
    law: object
    length: tuple
    rms_height: float

    @property
    def energy(self):
        """Elastic plus interaction energy per nominal area [E* length]."""
        return self.elastic_energy + self.interaction_energy

    @property
    def enthalpy(self):
        """Energy plus the potential energy of the load, lowest in the deepest state [E* length]."""
        return self.energy + self.mean_pressure * self.mean_gap


class PullOffError(ConvergenceError):
    """The tension exceeds what the interface can hold: there is no equilibrium but at infinity."""


@dataclass(frozen=True)
class Effort:
    """When to stop, and the logger that is told the progress: see `solve`."""

    tol: float
    max_iterations: int = 1000
    logger: object = None


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

    In general the problem has several solutions. This function returns the stable state that a
    descent in energy reaches from `start`. At a prescribed pressure the states are ordered: loading
    from afar ends in the one with the widest gaps, unloading from full contact in the one with the
    narrowest. Of two states at the same pressure the one of lower `Adhesion.enthalpy` is the deeper
    minimum; at the same mean gap, the one of lower `Adhesion.energy`.

    Parameters
    ----------
    heights : array_like
        Heights ``(n0, n1)`` of the rigid surface (positive towards the half-space), any unit.
    length : float or tuple of float
        Side of the cell along axis 0 (pixels are then square), or both sides; same unit.
    law : TractionLaw
        Attraction, its adhesion length and range in the same unit.
    pressure, mean_gap : float
        Exactly one of them: mean pressure in units of E*, negative for tension, or mean gap.
    start : str, Adhesion, repulsive.Contact or array_like, optional
        "approach" (default): the descent starts from the solution without adhesion at the same
        control or, under tension, from the adhesive solution at zero pressure. At a prescribed
        pressure coarser grids supply a better start unless a descent on one of them meets negative
        curvature, as a jump would; pass a `repulsive.Contact` to skip them. "separation": the
        descent starts from full contact, at a prescribed pressure only (`path` follows a mean gap
        back). Or any state on the same grid, or its gap.
    tol : float
        Largest accepted `Adhesion.residual`.
    max_iterations : int
        Largest number of iterations.
    logger : logging.Logger, optional
        Receives the progress at level DEBUG.
    solid : solids.HalfSpace or solids.Layer, optional
        Elastic solid, a half-space by default; the thickness of a layer is in the unit of
        `length`. The mean gap is measured between the surfaces: see `solids.layers` on the approach
        of the backing.

    Returns
    -------
    Adhesion

    Raises
    ------
    ValueError
        If an argument is malformed or out of range; the message names it.
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
            f"residual {state.residual:.2e} after {state.iterations} iterations exceeds tol = "
            f"{tol:.2e}: raise max_iterations, or tol if it is near rounding",
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
    if ratio > _UNRESOLVED_PIXEL:
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
        lowest = 0.0 if law.hard_wall else -DEEPEST * law.range
        if mean_gap < lowest:
            raise ValueError(f"mean_gap must be at least {lowest!r}, got {mean_gap!r}")


@dataclass(frozen=True)
class Control:
    """What is prescribed, in the caller's units: one of the two, the other is None."""

    pressure: float | None = None
    mean_gap: float | None = None


@dataclass(frozen=True, eq=False)
class Scaled:
    """Surface and law in the units of the solver, and the conversion back."""

    surface: Surface
    law: object
    original_law: object
    lengths: tuple
    height: float  #: unit of heights and gaps
    rms_height: float
    residual_unit: float

    @classmethod
    def of(cls, heights, lengths, law, solid=HALF_SPACE):
        """Scale heights, law and solid."""
        mean, rms = measure_scale(heights)
        height = rms if rms > 0 else law.range
        scaled = (heights - mean) / height if rms > 0 else np.zeros(heights.shape)
        surface = Surface(scaled, (1.0, lengths[1] / lengths[0]), solid.in_unit(lengths[0]))
        scaled_law = replace(
            law,
            adhesion_length=law.adhesion_length * lengths[0] / height**2,
            range=law.range / height,
        )
        flattening = float(np.sqrt(np.mean(surface.exact.stiffness(scaled) ** 2)))
        unit = max(flattening, scaled_law.strength)
        return cls(surface, scaled_law, law, lengths, height, rms, unit)

    @property
    def stress(self):
        """Unit of pressure over E*."""
        return self.height / self.lengths[0]

    def problem(self, control):
        """Problem at one value of the control."""
        pressure, mean_gap = control.pressure, control.mean_gap
        return Problem(
            self.surface,
            self.law,
            self.residual_unit,
            pressure=None if pressure is None else pressure / self.stress,
            mean_gap=None if mean_gap is None else mean_gap / self.height,
        )

    def check_start(self, start, mean_gap):
        """Raise ValueError unless `start` can be one."""
        shape = self.surface.heights.shape
        if isinstance(start, str):
            if start not in (APPROACH, SEPARATION):
                raise ValueError(
                    f"start must be 'approach', 'separation' or a state, got {start!r}"
                )
            if start == SEPARATION and mean_gap is not None:
                raise ValueError(
                    "start='separation' needs a prescribed pressure, got mean_gap = "
                    f"{mean_gap!r}: follow the mean gap back with path, or start from a state"
                )
        elif start is not None:
            gap = np.asarray(getattr(start, "gap", start), dtype=float)
            if gap.shape != shape:
                raise ValueError(f"start has the shape {gap.shape}, the heights {shape}")
            if not np.all(np.isfinite(gap)):
                raise ValueError("start must have finite gaps, got NaN or infinite values")

    def first_gap(self, start, mean_gap=None):
        """Scaled gap of a state, adjusted to a prescribed mean.

        It is changed in proportion, so that contact stays contact, or rigidly where there is none.
        """
        lowest = 0.0 if self.law.hard_wall else -DEEPEST * self.law.range
        gap = np.asarray(getattr(start, "gap", start), dtype=float) / self.height
        gap = np.maximum(gap, lowest)
        if mean_gap is None:
            return gap
        mean, old = mean_gap / self.height, float(gap.mean())
        if self.law.hard_wall and old > 0 and gap.min() == 0:
            return gap * (mean / old)
        return lowered(gap + max(mean - old, 0.0), mean, lowest)

    def adhesion(self, state, branch, problem, pairs):
        """`Adhesion` in the caller's units."""
        law, gap = self.law, state.gap
        net = np.empty(gap.shape)
        fields = gap, state.elastic, state.traction, self.surface.heights, net
        repulsion, attraction, elastic, *areas = (
            value / gap.size
            for value in _sum_up(
                *(field.ravel() for field in fields), state.pressure, law.hard_wall, law.range
            )
        )
        net *= self.stress
        energy = self.height * self.stress
        return Adhesion(
            pressure=net,
            gap=gap * self.height,
            mean_pressure=state.pressure * self.stress,
            repulsive_pressure=repulsion * self.stress,
            adhesive_pressure=attraction * self.stress,
            repulsive_area_fraction=areas[0],
            net_repulsive_area_fraction=areas[1],
            adhesive_area_fraction=areas[2],
            mean_gap=float(gap.mean()) * self.height,
            elastic_energy=elastic / 2 * energy,
            interaction_energy=state.potential * energy,
            residual=state.residual,
            iterations=state.iterations,
            fft_pairs=float(pairs),
            branch=branch,
            control="pressure" if problem.pressure is not None else "mean_gap",
            law=self.original_law,
            length=self.lengths,
            rms_height=self.rms_height,
        )


@compiled
def _sum_up(gap, elastic, traction, heights, net, pressure, wall, reach):
    """Fill in the net pressure at every point, and sum up over all what `Adhesion` has means of.

    Returns sums of repulsion, of attraction and of twice the elastic energy, and counts of points
    in contact, of those that are compressed, and of others within the reach of the law.
    """
    repulsion = attraction = energy = 0.0
    touching = compressed = near = 0
    for i in range(gap.size):
        contact = gap[i] <= 0 if wall else gap[i] < 0
        push = elastic[i] + traction[i] + pressure if wall and contact else 0.0
        net[i] = (push if push > 0 else 0.0) - traction[i]
        repulsion += net[i] if net[i] > 0 else 0.0
        attraction -= net[i] if net[i] < 0 else 0.0
        energy += (gap[i] + heights[i]) * elastic[i]
        touching += contact
        compressed += contact and net[i] > 0
        near += not contact and gap[i] <= reach
    return repulsion, attraction, energy, touching, compressed, near
