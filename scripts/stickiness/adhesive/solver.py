"""Adhesive contact of a periodic elastic solid at a prescribed mean pressure or mean gap."""

import warnings
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from stickiness.adhesive import edge_zone
from stickiness.adhesive.equilibrium import relax
from stickiness.adhesive.problem import Problem, lowered, sum_blocks
from stickiness.arguments import check_length, flag, grid, integer, number, numbers
from stickiness.plausibility import PlausibilityWarning, warn_of_heights, warn_of_pressure
from stickiness.repulsive.half_space import measure_scale, measure_slope
from stickiness.repulsive.solver import Contact, ConvergenceError
from stickiness.solids import HALF_SPACE, Solid, check_solid
from stickiness.traction_laws import TractionLaw, check_law

APPROACH = "approach"
SEPARATION = "separation"
_DEEPEST = 0.9  # of the range: penetration of a start, or in the mean, without a wall
# Pixel over epsilon^2/l_a above which edges of contact are a matter of the grid alone. At 2 a
# sphere of Tabor parameter 5 holds 20 % too much.
_UNRESOLVED_PIXEL = 4.0


@dataclass(frozen=True, eq=False)
class Adhesion:
    """State of equilibrium of an adhesive contact; pressures in units of E*.

    Areas are shares of the nominal area, energies per nominal area in units of E* times length.
    Contact is at the wall or, if the law has none, where the gap is negative.
    """

    pressure: np.ndarray  #: net at the interface, repulsion minus attraction, ``(n0, n1)``
    #: In the unit of the heights, zero at the hard wall. A law without a wall has its equilibrium
    #: separation at gap 0, and negative gaps where it repels.
    gap: np.ndarray
    mean_pressure: float  #: prescribed, or what keeps the mean gap
    repulsive_pressure: float  #: mean of the positive part of `pressure`
    adhesive_pressure: float  #: mean of its negative part, positive
    repulsive_area_fraction: float  #: contact, under whatever pressure
    #: Contact under net compression: next to the edge the attraction outweighs the wall's push.
    net_repulsive_area_fraction: float
    adhesive_area_fraction: float  #: points out of contact with a gap up to the range
    #: Prescribed, or what keeps the mean pressure: of the gap between the surfaces, without the
    #: mean compression of a layer.
    mean_gap: float
    elastic_energy: float
    interaction_energy: float  #: mean of the law's potential
    #: Largest unbalanced pressure at any point, at the wall only if it pulls, over the larger of
    #: the rms pressure that flattens the surface (half its rms gradient times E*) and the strength.
    residual: float
    iterations: int  #: of conjugate gradients
    fft_pairs: float  #: convolutions, by their share of the points; those of the start included
    branch: str  #: "approach" if reached from wider gaps, "separation" if from closer ones
    control: str  #: "pressure" or "mean_gap"
    law: TractionLaw
    length: tuple  #: sides of the periodic cell
    rms_height: float  #: about the mean

    @property
    def energy(self) -> float:
        """Elastic plus interaction energy per nominal area [E* length]."""
        return self.elastic_energy + self.interaction_energy

    @property
    def enthalpy(self) -> float:
        """Energy plus the potential energy of the load, lowest in the deepest state [E* length]."""
        return self.energy + self.mean_pressure * self.mean_gap


class PullOffError(ConvergenceError):
    """The tension exceeds what the interface can hold: there is no equilibrium but at infinity."""


def solve(
    heights: ArrayLike,
    length: float | tuple[float, float],
    law: TractionLaw,
    pressure: float | None = None,
    mean_gap: float | None = None,
    start: str | Adhesion | Contact | ArrayLike | None = None,
    tol: float = 1e-8,
    max_iterations: int = 3000,
    solid: Solid = HALF_SPACE,
    mirrored: bool = False,
) -> Adhesion:
    """Solve the adhesive contact of an elastic solid with a rigid periodic surface.

    In general the problem has several solutions. This function returns the stable state that a
    descent in energy reaches from `start`. At a prescribed pressure the states are ordered: loading
    from afar ends in the one with the widest gaps, unloading from full contact in the one with the
    narrowest. Of two states at the same pressure the one of lower `Adhesion.enthalpy` is the deeper
    minimum; at the same mean gap, the one of lower `Adhesion.energy`. A `PlausibilityWarning` says
    if the pixels are far too large for the edges of contact, or units probably differ.

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
        pressure coarser grids, if not mirrored, supply a better start unless a descent on one of
        them meets negative curvature, as a jump would; pass a `repulsive.Contact` to skip them.
        "separation": the descent starts from full contact, at a prescribed pressure only (`path`
        follows a mean gap back). Or any state on the same grid, or its gap.
    tol : float
        Largest accepted `Adhesion.residual`.
    max_iterations : int
        Largest number of iterations.
    solid : solids.HalfSpace, solids.Layer or solids.Skin, optional
        Elastic solid, a half-space by default; the thickness of a layer is in the unit of
        `length`. The mean gap is measured between the surfaces: see `solids.layers` on the approach
        of the backing.
    mirrored : bool
        Whether the surface goes on as its mirror image at every side, instead of repeating as it
        is, and the state as well. It takes a quarter of the work of heights with their images. The
        state is stable among those with this symmetry: heights with their images may leave it.

    Returns
    -------
    Adhesion
        State of equilibrium, in the caller's units.

    Raises
    ------
    ValueError
        If an argument is out of range, or the grid would set the edges (`edge_zone.is_lost`).
    PullOffError
        If the tension tears the surfaces apart; it carries the last iterate.
    ConvergenceError
        If `max_iterations` do not suffice, or `tol` leaves a tenth of the largest pressure out of
        balance; it carries the last iterate.

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
    check_law(law)
    control = _check_control(pressure, mean_gap, law)
    effort = Effort(tol=tol, max_iterations=max_iterations)
    scaled = Scaled.of(heights, lengths, law, check_solid(solid), flag("mirrored", mirrored))
    _check_start(start, heights.shape, mean_gap)
    warn_of_heights(scaled.rms_height, lengths[0])
    if pressure is not None and pressure > 1:
        stiffening = 1 / solid.factor(2 * np.pi / max(lengths))
        warn_of_pressure(pressure, measure_slope(heights, lengths, mirrored) * stiffening)
    lost = scaled.rms_height > 0 and _check_edges(lengths[0] / heights.shape[0], law, scaled)
    gap = None
    branch = APPROACH
    unloaded = None
    if isinstance(start, str) and start == SEPARATION:
        gap = np.zeros(heights.shape)
        branch = SEPARATION
    elif start is not None and not isinstance(start, str):
        gap = scaled.first_gap(start, mean_gap)
        branch = getattr(start, "branch", APPROACH)
    elif pressure is not None and pressure < 0:
        # Under tension nothing holds the surfaces together that were not in contact before.
        unloaded = relax(scaled.problem(pressure=0.0), None, tol, max_iterations)
        gap = unloaded.gap
    adhesion = relax_from(scaled, gap, branch, control, effort, unloaded)
    if lost and 0 < adhesion.repulsive_area_fraction < 1:
        raise ValueError(lost)
    return adhesion


@dataclass(frozen=True)
class Control:
    """What is prescribed, in the caller's units: one of the two, the other is None."""

    pressure: float | None = None
    mean_gap: float | None = None

    @property
    def name(self):
        """Name of what is prescribed."""
        return "pressure" if self.mean_gap is None else "mean_gap"


@dataclass(frozen=True)
class Effort:
    """How well a state is to be solved, and how long that may take."""

    tol: float
    max_iterations: int


def relax_from(scaled, gap, branch, control, effort, unloaded=None):
    """State that a descent from a gap in scaled units, or None, ends in; errors as of `solve`.

    The iterations of the state `unloaded`, if any, count, too.
    """
    problem = scaled.problem(pressure=control.pressure, mean_gap=control.mean_gap)
    state = relax(problem, gap, effort.tol, effort.max_iterations, closing=branch == APPROACH)
    if unloaded is not None:
        state.iterations += unloaded.iterations
        state.fft_pairs += unloaded.fft_pairs
    result = scaled.adhesion(state, branch, control)
    if state.separated:
        raise PullOffError(
            f"pressure = {control.pressure!r} separates the surfaces: the tension exceeds the "
            f"pull-off stress of this branch (the strength of the law is "
            f"{scaled.law.strength:.6g}); control mean_gap instead",
            result,
        )
    if not state.residual <= effort.tol:
        raise ConvergenceError(
            f"residual {state.residual:.2e} after {state.iterations} iterations exceeds tol = "
            f"{effort.tol:.2e}: raise max_iterations, or tol if it is near rounding",
            result,
        )
    imbalance = state.residual * problem.unit * scaled.stress
    largest = max(np.abs(result.pressure).max(), scaled.flattening * scaled.stress)
    if imbalance > 0.1 * largest > 0:
        text = (
            f"forces are out of balance by {imbalance:.2g} E* (largest pressure {largest:.2g} E*): "
        )
        raise ConvergenceError(f"{text}lower tol = {effort.tol:.2e}, or use a longer range", result)
    return result


def _check_edges(pixel, law, scaled):
    """Warn of edges that the grid does not resolve; text of an error where it loses them."""
    ratio = edge_zone.resolution(pixel, law.maugis_range, law.adhesion_length)
    text = (
        f"a pixel of {pixel:.3g} does not resolve the edges of contact under a range of "
        f"{law.range:.3g} and an adhesion length of {law.adhesion_length:.3g}: points snap in "
        "and out one by one. Take pixels of at most "
        f"{edge_zone.COARSEST * pixel / ratio:.3g} (adhesion_length/(2 strength^2)), "
        "or a longer range"
    )
    if edge_zone.is_lost(ratio, scaled.scaled.law.strength / scaled.flattening):
        return text
    if ratio > _UNRESOLVED_PIXEL:
        warnings.warn(text, PlausibilityWarning, stacklevel=3)
    return None


def _check_control(pressure, mean_gap, law):
    """Return the `Control` of checked values."""
    if (pressure is None) == (mean_gap is None):
        raise ValueError(
            f"exactly one of pressure and mean_gap must be given, got {pressure!r}, {mean_gap!r}"
        )
    control = Control(pressure, mean_gap)
    value = pressure if mean_gap is None else mean_gap
    array = numbers(control.name, value)
    if array.ndim or not np.isfinite(array):
        raise ValueError(f"{control.name} must be a finite number, got {value!r}")
    if mean_gap is not None and mean_gap < _lowest_gap(law):
        raise ValueError(f"mean_gap must be at least {_lowest_gap(law)!r}, got {mean_gap!r}")
    return control


def _check_start(start, shape, mean_gap):
    if isinstance(start, str):
        if start not in (APPROACH, SEPARATION):
            raise ValueError(f"start must be 'approach', 'separation' or a state, got {start!r}")
        if start == SEPARATION and mean_gap is not None:
            raise ValueError(
                "start='separation' needs a prescribed pressure, got mean_gap = "
                f"{mean_gap!r}: follow the mean gap back with path, or start from a state"
            )
    elif start is not None:
        gap = numbers("start", getattr(start, "gap", start))
        if gap.shape != shape:
            raise ValueError(f"start has the shape {gap.shape}, the heights {shape}")
        if not np.all(np.isfinite(gap)):
            raise ValueError("start must have finite gaps, got NaN or infinite values")


def _lowest_gap(law):
    return 0.0 if law.hard_wall else -_DEEPEST * law.range


@dataclass(frozen=True, eq=False)
class Scaled:
    """Surface and law in the units of the solver, and the conversion back."""

    scaled: Problem  #: without a control
    law: TractionLaw  #: as given
    lengths: tuple
    height: float  #: unit of heights and gaps
    rms_height: float
    flattening: float  #: rms pressure of full contact, scaled

    @classmethod
    def of(cls, heights, lengths, law, solid=HALF_SPACE, mirrored=False):
        """Scale heights, law and solid."""
        mean, rms = measure_scale(heights)
        height = rms if rms > 0 else law.range
        scaled_heights = (heights - mean) / height if rms > 0 else np.zeros(heights.shape)
        scaled_law = replace(
            law,
            adhesion_length=law.adhesion_length * lengths[0] / height**2,
            range=law.range / height,
        )
        problem = Problem(
            heights=scaled_heights,
            sides=(1.0, lengths[1] / lengths[0]),
            law=scaled_law,
            unit=scaled_law.strength,
            solid=solid.in_unit(lengths[0]),
            mirrored=mirrored,
        )
        flattening = float(np.sqrt(np.mean(problem.exact.stiffness(scaled_heights) ** 2)))
        return cls(
            scaled=replace(problem, unit=max(flattening, scaled_law.strength)),
            law=law,
            lengths=lengths,
            height=height,
            rms_height=rms,
            flattening=flattening,
        )

    @property
    def stress(self):
        """Unit of pressure over E*."""
        return self.height / self.lengths[0]

    def problem(self, pressure=None, mean_gap=None):
        """Problem at one value of the control, which is in the caller's units."""
        return replace(
            self.scaled,
            pressure=None if pressure is None else pressure / self.stress,
            mean_gap=None if mean_gap is None else mean_gap / self.height,
        )

    def first_gap(self, start, mean_gap=None):
        """Scaled gap of a state, adjusted to a prescribed mean."""
        law = self.scaled.law
        lowest = _lowest_gap(law)
        gap = np.asarray(getattr(start, "gap", start), dtype=float) / self.height
        gap = np.maximum(gap, lowest)
        if mean_gap is None:
            return gap
        wanted = mean_gap / self.height
        mean = float(gap.mean())
        if law.hard_wall and mean > 0 and gap.min() == 0:  # contact stays contact
            return gap * (wanted / mean)
        return lowered(gap + max(wanted - mean, 0.0), wanted, lowest)

    def adhesion(self, state, branch, control):
        """`Adhesion` in the caller's units, those of `control`."""
        law = self.scaled.law
        gap = state.gap
        contact = gap <= 0 if law.hard_wall else gap < 0
        push = 0.0
        if law.hard_wall:  # it pushes where elastic pressure, traction and load pull
            push = np.where(contact, state.elastic + state.traction + state.pressure, 0)
            push = np.maximum(push, 0)
        net = (push - state.traction) * self.stress
        deformation = gap + self.scaled.heights
        energy = self.height * self.stress  # unit of energies per area
        mean_pressure = control.pressure
        if mean_pressure is None:
            mean_pressure = state.pressure * self.stress
        return Adhesion(
            pressure=net,
            gap=gap * self.height,
            mean_pressure=float(mean_pressure),
            repulsive_pressure=float(np.maximum(net, 0).sum()) / gap.size,
            adhesive_pressure=-float(np.minimum(net, 0).sum()) / gap.size,
            repulsive_area_fraction=float(contact.mean()),
            net_repulsive_area_fraction=float((contact & (net > 0)).mean()),
            adhesive_area_fraction=float((~contact & (gap <= law.range)).mean()),
            mean_gap=float(gap.mean()) * self.height,
            elastic_energy=sum_blocks(np.vdot, deformation, state.elastic) / gap.size / 2 * energy,
            interaction_energy=state.potential * energy,
            residual=state.residual,
            iterations=state.iterations,
            fft_pairs=state.fft_pairs,
            branch=branch,
            control=control.name,
            law=self.law,
            length=self.lengths,
            rms_height=self.rms_height,
        )
