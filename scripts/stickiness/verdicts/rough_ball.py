"""Pull-off force of a ball: for atomic force microscopes, grippers and particles.

Only waves shorter than the zone of contact reduce the force. How wide that is depends on what they
leave, so that both are found together.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache, cached_property
from typing import Any

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray

from stickiness.arguments import number
from stickiness.criteria.pair import Pair
from stickiness.entries.material import Material
from stickiness.formatting import amount, in_unit, limited
from stickiness.remaining import sphere
from stickiness.remaining.errors import BALL, SUMMITS
from stickiness.remaining.roughness import Roughness
from stickiness.remaining.trial_states import DEFAULT_SHARE
from stickiness.solids import HALF_SPACE
from stickiness.verdicts.limits import ROUGH_END, VALUE
from stickiness.verdicts.meeting import Meeting, deviate, find_family, find_roughness, meet
from stickiness.verdicts.rough_surface import Surface

LOOSE = 1e-3  #: relative, of the longest wave in the zone of contact
WIDEST = 1.0  #: radii across the zone of contact, in which a paraboloid stands for the ball


@dataclass(frozen=True)
class BallPullOff:
    """Pull-off force of a ball; forces are NaN if the pair is not judged."""

    radius: float  #: of the ball [m]
    force: float  #: [N]
    force_limits: tuple[float, float]  #: (low, high) [N]
    smooth_force: float  #: without roughness [N]
    waves: float  #: longest waves across the contact at pull-off
    not_judged: str = ""  #: why the force is not known, a line each; empty if it is

    @property
    def few_waves(self) -> bool:
        """Whether the contact is too small for statistics of the roughness: forces scatter."""
        return self.waves < sphere.FEWEST_WAVES

    def to_dict(self) -> dict[str, Any]:
        """Return the numbers in SI units, ready for JSON, or `not_judged`, a text a reason."""
        low, high = self.force_limits
        force = {"value": self.force, "low": low, "high": high, "unit": "N"}
        contents: dict[str, Any] = {"radius": {"value": self.radius, "unit": "m"}}
        if self.not_judged:
            contents["not_judged"] = self.not_judged.splitlines()
        if np.isfinite(self.force):
            contents["pull_off_force"] = force
            contents["smooth_pull_off_force"] = {"value": self.smooth_force, "unit": "N"}
            contents["longest_waves_across_contact"] = {"value": self.waves, "unit": "1"}
        return contents

    def __str__(self) -> str:
        name = f"pull-off force of a ball of radius {amount(self.radius, 'm')}"
        if not np.isfinite(self.force):
            return f"{name}: not known, because {self.not_judged.splitlines()[0]}"
        force = limited(self.force, *self.force_limits, in_unit("N"))
        text = f"{name}: {force}; a smooth one {amount(self.smooth_force, 'N', 2)}"
        if self.few_waves:
            text += (
                f"\nthe contact of the ball is {self.waves:.2g} of the longest wavelengths wide: "
                "the force varies from place to place, which the limits include"
            )
        return text


def pull_off_of_ball(surface: Surface, material: Material, radius: float) -> BallPullOff:
    """Pull-off force of a ball after a contact formed by load.

    The ball or the half-space that it touches may be the rough solid, and either may be the elastic
    one: roughness and modulus are those of the pair. Maugis' sphere has the work of adhesion that
    remains, and the distance over which it acts. Only waves that are not longer than the zone of
    contact is wide take from it; longer ones tilt, shift and curve what the ball touches.

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
        The force with limits, which cover 90 % of the places where the ball may touch.

    Raises
    ------
    ValueError
        If the radius is not positive, or the material is a layer or has a skin or a dwell.
    """
    check_ball(material, radius)
    whole = BallContact(
        meeting=meet(material, surface, DEFAULT_SHARE),
        material=material,
        surface=surface,
        radius=radius,
        summits=SUMMITS.spread.value,
        error=BALL.spread.high,
    )
    contact = find_contact(whole)
    low, value, high = contact.force
    doubt = whole.meeting.not_judged or contact.doubt
    if doubt:
        low = value = high = np.nan
    return BallPullOff(
        radius=radius,
        force=value,
        force_limits=(low, high),
        smooth_force=contact.smooth_force,
        waves=contact.zone * float(np.asarray(whole.meeting.ends.q0)[ROUGH_END]) / (2 * np.pi),
        not_judged=doubt,
    )


def check_ball(material: Material, radius: float) -> None:
    """Raise ValueError unless the force of a ball on this material can be predicted."""
    number("radius", radius)
    if material.solid != HALF_SPACE or material.dwell is not None:
        raise ValueError(
            "radius: the force of a ball needs an infinitely deep material: leave out thickness, "
            "skin and dwell"
        )


@dataclass(frozen=True)
class BallContact:
    """Contact of a ball that meets some of the waves."""

    meeting: Meeting  #: with these waves
    material: Material
    surface: Surface
    radius: float  #: of the ball [m]
    summits: float  #: as of `sphere.narrow`
    error: float  #: as of `sphere.pull_off`
    curvature: float = 0.0  #: rms mean curvature of the longer waves [1/m]

    def shorter(self, q: float) -> BallContact:
        """The same where the ball meets the waves from a wave number on [1/m]."""
        family = find_family(self.material, self.surface, above=q)
        rough = find_roughness(self.material, self.surface, family, above=q)
        longer = find_family(self.material, self.surface).below(q)
        # Half of the Laplacian of the waves that are left out.
        curvature = np.median(np.sqrt(longer.variance(4))) / 2
        shorter = replace(self, curvature=float(curvature))
        return shorter._with(deviate(rough, self.meeting.is_drawn)).without_states()

    def without_states(self) -> BallContact:
        """The same by the theory of heights, without states simulated on a map."""
        return self._with(replace(self.pair.rough, simulated=None, lacking=0.0))

    def _with(self, rough: Roughness) -> BallContact:
        """The same with other roughness, on which the same law acts."""
        rough = replace(rough, law=self.pair.rough.law)
        return replace(self, meeting=replace(self.meeting, pair=replace(self.pair, rough=rough)))

    @property
    def pair(self) -> Pair:
        """The ball's material with all that the surface may be."""
        return self.meeting.pair

    def press(self, waves: ArrayLike, eta: float | NDArray) -> sphere.SpherePullOff:
        """Pull-off in every row, where so many of the longest waves lie across the zone."""
        return sphere.pull_off(
            rough=sphere.narrow(self.pair.rough, waves, self.summits).deviating(eta),
            radius=self.radius,
            adhesion_length=self.pair.adhesion_length,
            range=self.pair.range,
            curvature=self.curvature,
            error=self.error,
        )

    @cached_property
    def with_one_wave(self) -> sphere.SpherePullOff:
        """Pull-off in every row where the longest wave is as long as the zone is wide."""
        return self.press(waves=1.0, eta=0.0)

    @cached_property
    def zone(self) -> float:
        """Width of the zone of contact at pull-off [m]."""
        radii = self.with_one_wave.zone_radius
        return 2 * float(self.meeting.limit(radii, self.pair)[VALUE])

    @cached_property
    def force(self) -> tuple[float, ...]:
        """Low limit, value and high limit of the pull-off force [N]."""
        # The value is that without errors of the model.
        waves = self.zone * self.pair.q0 / (2 * np.pi)
        low, _, high = self._limit(self.press(waves, eta=self.pair.rough.eta).force)
        value = self._limit(self.press(waves, eta=0.0).force)[VALUE]
        return low, value, high

    def _limit(self, forces: ArrayLike) -> tuple[float, ...]:
        """Limits of forces over E* in all rows [N]."""
        of_rows = self.pair.modulus * np.asarray(forces)
        return tuple(float(force) for force in self.meeting.limit(of_rows, self.pair))

    @property
    def smooth_force(self) -> float:
        """Pull-off force of a smooth ball [N]."""
        return float(self.pair.modulus * np.max(self.with_one_wave.smooth_force))

    @property
    def doubt(self) -> str:
        """Why the ball is none to the contact, and what to give instead; empty if it is one."""
        if self.zone <= WIDEST * self.radius:
            return ""
        return (
            f"the attraction acts over a zone {amount(self.zone, 'm', 2)} wide, more than "
            f"{WIDEST:g} radii of the ball, within which it is no ball: give a larger radius, or "
            "the roughness of the spot alone"
        )


def find_contact(whole: BallContact) -> BallContact:
    """Contact that meets the waves no longer than its zone is wide.

    The wider the zone, the more waves it holds, which leave less of the attraction.
    """
    lowest = min(spectrum.band[0] for spectrum in whole.meeting.spectra)
    highest = whole.meeting.family.highest
    # States simulated on a map are those of a contact as large as the map. A smaller one touches
    # at lower summits.
    if not whole.zone >= whole.surface.contact:
        whole = whole.without_states()
    if whole.zone >= 2 * np.pi / lowest:
        return whole

    @cache
    def compare_zone(log_q: float) -> float:
        """Logarithm of the zone over the longest wave, where the ball meets waves from q on."""
        zone = whole.shorter(np.exp(log_q)).zone
        return float(np.log(zone / (2 * np.pi))) + log_q

    longest, shortest = float(np.log(lowest)), float(np.log(highest))
    if compare_zone(longest) >= 0:
        return whole
    if compare_zone(shortest) <= 0:
        return whole.shorter(highest)
    return whole.shorter(np.exp(scipy.optimize.brentq(compare_zone, longest, shortest, xtol=LOOSE)))
