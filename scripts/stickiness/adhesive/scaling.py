"""Adhesive states in the caller's units, and the way to the solver's own and back."""

from dataclasses import dataclass, replace

import numpy as np

from stickiness.adhesive.problem import Problem, Surface
from stickiness.adhesive.state import lowered
from stickiness.compiled import compiled
from stickiness.repulsive.grids import measure_scale
from stickiness.solids import HALF_SPACE

APPROACH, SEPARATION = "approach", "separation"
CLOSEST = 0.9  #: of the range: penetration of a start, or in the mean, without a wall


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
        """Energy plus that of the load, least among the states at one pressure [E* length]."""
        return self.energy + self.mean_pressure * self.mean_gap


@dataclass(frozen=True)
class Control:
    """What is prescribed, in the caller's units: one of the two, the other is None."""

    pressure: float | None = None
    mean_gap: float | None = None


@dataclass(frozen=True, eq=False)
class Scaled:
    """Surface and law in the solver's own units, and the way back."""

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
        own_law = replace(
            law,
            adhesion_length=law.adhesion_length * lengths[0] / height**2,
            range=law.range / height,
        )
        unit = max(surface.flattening_pressure(), own_law.strength)
        return cls(surface, own_law, law, lengths, height, rms, unit)

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
        """Gap of a state in own units, made to have a prescribed mean.

        It is changed in proportion, so that contact stays contact, or rigidly where there is none.
        """
        lowest = 0.0 if self.law.hard_wall else -CLOSEST * self.law.range
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
