"""Pull-off force of a ball: for atomic force microscopes, grippers and particles."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from stickiness.arguments import number
from stickiness.entries.material import Material
from stickiness.formatting import amount, in_unit, limited
from stickiness.remaining import sphere
from stickiness.remaining.trial_states import DEFAULT_SHARE
from stickiness.solids import HALF_SPACE
from stickiness.verdicts.limits import VALUE
from stickiness.verdicts.pair_roughness import combine_roughness
from stickiness.verdicts.rough_surface import Surface
from stickiness.verdicts.scenarios import ENDS


@dataclass(frozen=True)
class BallPullOff:
    """Pull-off force of a ball; forces are NaN if the pair is not judged."""

    radius: float  #: of the ball [m]
    force: float  #: [N]
    force_limits: tuple[float, float]  #: (low, high) [N]
    smooth_force: float  #: without roughness [N]
    waves: float  #: longest waves across the contact at pull-off

    @property
    def few_waves(self) -> bool:
        """Whether the contact is too small for statistics of the roughness: forces scatter."""
        return self.waves < sphere.FEWEST_WAVES

    def to_dict(self) -> dict[str, Any]:
        """Return the numbers in SI units, ready for JSON; what is not known is left out."""
        low, high = self.force_limits
        force = {"value": self.force, "low": low, "high": high, "unit": "N"}
        contents: dict[str, Any] = {"radius": {"value": self.radius, "unit": "m"}}
        if np.isfinite(self.force):
            contents["pull_off_force"] = force
            contents["smooth_pull_off_force"] = {"value": self.smooth_force, "unit": "N"}
            contents["longest_waves_across_contact"] = {"value": self.waves, "unit": "1"}
        return contents

    def __str__(self) -> str:
        name = f"pull-off force of a ball of radius {amount(self.radius, 'm')}"
        if not np.isfinite(self.force):
            return f"{name}: not known"
        force = limited(self.force, *self.force_limits, in_unit("N"))
        text = f"{name}: {force}; a smooth one {amount(self.smooth_force, 'N', 2)}"
        if self.few_waves:
            text += (
                f"\nwarning: the contact of the ball is {self.waves:.2g} longest waves wide; below "
                f"{sphere.FEWEST_WAVES:g}, forces scatter from place to place"
            )
        return text


def pull_off_of_ball(surface: Surface, material: Material, radius: float) -> BallPullOff:
    """Pull-off force of a ball after a contact formed by load.

    The ball or the half-space that it touches may be the rough solid, and either may be the elastic
    one: roughness and modulus are those of the pair. Maugis' sphere has the work of adhesion that
    remains, and the distance over which it acts.

    Parameters
    ----------
    surface : Surface
        The rough surface.
    material : Material
        The elastic solid, infinitely deep, without a skin and without a dwell.
    radius : float
        Radius of the ball [m].

    Returns
    -------
    BallPullOff
        The force with limits, which cover 90 %.

    Raises
    ------
    ValueError
        If the radius is not positive, or the material is a layer or has a skin or a dwell.
    """
    number("radius", radius)
    if material.solid != HALF_SPACE or material.dwell is not None:
        raise ValueError(
            "radius: the force of a ball needs an infinitely deep material: leave out thickness, "
            "skin and dwell"
        )

    # Over all that the surface may be. Errors of the model raise the high limits alone, by jumps
    # and pinned edges, so that the value is that without them.
    rough = combine_roughness(material, surface)
    pair = rough.meet(material, DEFAULT_SHARE)
    length = pair.adhesion_length
    with_errors, exact = (
        sphere.pull_off(pair.rough, radius, length, pair.range, deviation)
        for deviation in (pair.deviation, 0.0)
    )
    low, _, high = rough.limit(pair.modulus * with_errors.force, pair)
    value = rough.limit(pair.modulus * exact.force, pair)[VALUE]

    waves = 2 * np.asarray(exact.zone_radius * pair.q0)[ENDS[-1]] / (2 * np.pi)
    if rough.not_judged:
        low = value = high = np.nan
    return BallPullOff(
        radius=radius,
        force=float(value),
        force_limits=(float(low), float(high)),
        smooth_force=float(pair.modulus * np.max(exact.smooth_force)),
        waves=float(waves),
    )
