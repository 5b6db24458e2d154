"""Pull-off force of a ball: for atomic force microscopes, grippers and particles."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stickiness.arguments import number
from stickiness.formatting import amount, in_unit, limited
from stickiness.remaining import sphere
from stickiness.remaining.prediction import DEFAULT_SHARE
from stickiness.solids import HALF_SPACE
from stickiness.verdicts.draws import draw_model_errors, find_quantiles
from stickiness.verdicts.material import Material
from stickiness.verdicts.pair_roughness import combine_roughness
from stickiness.verdicts.rough_surface import Surface

SIGNS = (-1, 0, 1)  # low limit, value, high limit


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

    # Over all that is known of the surface, from its smooth to its rough end.
    rough = combine_roughness(material, surface)
    ends = rough.meet_ends(material, DEFAULT_SHARE)
    modulus = material.plane_strain_modulus
    length = material.work_of_adhesion / modulus
    pulled = [sphere.pull_off(ends, radius, length, material.range, sign) for sign in SIGNS]
    low, value, high = (modulus * np.asarray(pull_off.force) for pull_off in pulled)
    forces: NDArray = np.array([low.min(), value[-1], high.max()])

    # On a measured surface over its draws: limits with the errors of the model, which are no
    # smooth function of their sign, and the median without them.
    draws = rough.meet_draws(material, DEFAULT_SHARE)
    if draws is not None:
        for kept, errors in (([0, 2], draw_model_errors(draws)), ([1], 0)):
            drawn = sphere.pull_off(draws, radius, length, material.range, errors)
            quantiles = find_quantiles(modulus * np.asarray(drawn.force), draws.withstands)
            forces[kept] = quantiles[kept]

    middle = pulled[SIGNS.index(0)]
    waves = 2 * middle.zone_radius[-1] * ends.q0[-1] / (2 * np.pi)
    if rough.not_judged:
        forces = np.full(len(SIGNS), np.nan)
    return BallPullOff(
        radius=radius,
        force=float(forces[1]),
        force_limits=(float(forces[0]), float(forces[-1])),
        smooth_force=float(modulus * np.max(middle.smooth_force)),
        waves=float(waves),
    )
