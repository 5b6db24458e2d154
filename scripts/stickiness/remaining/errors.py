"""Errors of predictions of what remains: what each of them is proportional to, written once.

The theory of a spectrum errs by a share of the work of adhesion. Most other errors are of that work
itself: a limit of the share is its value at the work of adhesion times exp(error). An error is a
half-width that was measured, times a unit that says how it grows from one surface or solid to
another. The library multiplies both, and adds errors in quadrature. The rule `calibrate_limits`
divides what simulations are off by the same units, and takes quantiles: those are the half-widths,
see `calibration`.

Limits are written with `eta`, an error of the model in units of its limits: -1 and 1 at the low and
the high limit, 0 at the value. It is a column of `roughness.Roughness`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.limited import Limited
from stickiness.remaining.calibration import find_spread

Roughness = Any  #: of `roughness`, which imports this module


@dataclass(frozen=True)
class ErrorLaw:
    """How an error, or what is found with one, grows. Its size is a row of the table of limits."""

    kind: str  #: of prediction, as in the table
    quantity: str
    source: str  #: committed table that it is calibrated on
    unit: Callable[..., ArrayLike]  #: what it is proportional to
    label: str = ""  #: on pages

    @property
    def spread(self) -> Limited[float]:
        """Middle and limits, in the unit."""
        return find_spread(self.kind, self.quantity)

    def half_width(self, *known: ArrayLike | Roughness) -> NDArray:
        """Half-width of the limits, by what the unit needs to know."""
        return np.asarray(self.unit(*known)) * self.spread.high


def between(spread: Limited, eta: ArrayLike) -> NDArray:
    """Place between value and limits at `eta`."""
    return np.interp(np.asarray(eta), (-1, 0, 1), (spread.low, spread.value, spread.high))


def raise_limit(eta: ArrayLike) -> NDArray:
    """0 up to the value, 1 at the high limit: for what may only add."""
    return np.clip(eta, 0.0, 1.0)


def find_limits(model: Any, evaluate: Callable[[Any], Any]) -> Limited[Any]:
    """Value and limits of what is evaluated of a model that has `deviating`, as `Roughness` has."""
    return Limited(*(evaluate(model.deviating(eta)) for eta in (0.0, -1.0, 1.0)))


# Errors of what is predicted from a spectrum.

FADING = 0.01  #: share of which half the error of larger ones is left
MOST_WAVES = 4  #: along a side of the contact; more tell the theory nothing new


def _share_unit(share: ArrayLike, waves: ArrayLike) -> NDArray:
    """Absolute, but none where nothing remains; a contact of few waves is one realisation."""
    return np.asarray(share) / (np.asarray(share) + FADING) / np.minimum(waves, MOST_WAVES)


#: Of the share itself, by its value and the longest waves along a side of the contact.
SHARE = ErrorLaw("spectrum", "share", "heights.csv", unit=_share_unit, label="spectrum (of S)")
#: Of the mean gap at which the highest summit touches.
FIRST_TOUCH = ErrorLaw("spectrum", "first_touch", "long_ranges.csv", unit=np.ones_like)


def _of(*solids: str, unit: Callable[[Roughness], ArrayLike]) -> Callable[[Roughness], NDArray]:
    """A unit that is zero on other solids."""
    return lambda rough: np.where(np.isin(rough.solid, solids), unit(rough), 0.0)


def _measure_bending(rough: Roughness) -> NDArray:
    """Logarithm of what a film takes of a layer's energy by bending."""
    return np.log(np.divide(rough.rigid_base_energy, rough.elastic_energy))


# Of ln of the work of adhesion, by the solid. Layers err as half-spaces do, but where the material
# has to flow along them.
THIN, FILM, SKIN = (
    ErrorLaw(kind, "ln_work", "solids.csv", unit=unit, label=label)
    for kind, label, unit in (
        ("thin", "thin layer", _of("layer", "film", unit=lambda rough: rough.flow)),
        ("film", "film", _of("film", unit=_measure_bending)),
        ("skin", "skin", _of("skin", unit=lambda _: 1.0)),
    )
)
#: Where waves were not measured, to which a skin is stiff. How much of the energy they are thought
#: to hold tells little of the error.
COATED = ErrorLaw(
    kind="coated",
    quantity="ln_work",
    source="coated.csv",
    unit=_of("skin", unit=lambda rough: np.greater(rough.unresolved, 0.0)),
    label="skin on a map",
)
#: By the ln of the factor that the skewness of the heights makes.
SKEWNESS = ErrorLaw("skewness", "ln_work", "heights.csv", unit=np.abs, label="with skewness")


def find_work_error(rough: Roughness, extrapolated: ArrayLike) -> NDArray:
    """Error of ln of the work of adhesion by theory; `extrapolated` is that beyond simulations."""
    of_solid = sum(np.square(law.half_width(rough)) for law in (THIN, FILM, SKIN, COATED))
    independent = np.sqrt(of_solid + np.square(extrapolated))
    return np.hypot(independent * rough.anisotropy_error_factor, rough.shape_error)


#: Logarithms of works and of pull-offs over those by the energy gained. Of works
#: the low limit is that of making contact, the high one of breaking it.
PATH, TENSION = (
    ErrorLaw("spectrum", quantity, "remaining.csv", unit=np.ones_like)
    for quantity in ("ln_path", "ln_tension")
)

# Errors where contact is simulated on the heights.

#: Waves that lack cost their energy, and more where contact is sparse: by the energy that lacks
#: over that of the others, and by the share of the work of adhesion that is lost.
UNRESOLVED = ErrorLaw(
    kind="states",
    quantity="unresolved",
    source="unresolved.csv",
    unit=lambda lacking, lost: np.sqrt(np.log1p(lacking)) * np.power(lost, 3),
)
#: Place of a share between both bounds at a range shorter than the one simulated, by the strength
#: of the adhesion over the energy of full contact and by the ratio of ranges.
PLACE = ErrorLaw(
    kind="states",
    quantity="place",
    source="ranges.csv",
    unit=lambda strength, ratio: strength * np.maximum(1 - np.asarray(ratio), 0.0) ** 2,
)
#: Of a share on the same heights, see `find_states_error`.
STATES = ErrorLaw("states", "share", "heights.csv", unit=np.ones_like)
#: Of a tension, by the work of adhesion over the energy of full contact at which contact is nearly
#: lost: where that is at once, as on peaks, it depends on chance at which tension.
STATES_TENSION = ErrorLaw(
    kind="states",
    quantity="ln_tension",
    source="pull_offs.csv",
    unit=lambda lost_ratio: 1 + 4 * np.asarray(lost_ratio),
)


def _patch_unit(distance: ArrayLike, areas: ArrayLike, share: ArrayLike) -> NDArray:
    """The fewer independent heights, and the less remains, the more one place tells of another."""
    return np.hypot(distance, np.power(areas, -0.5)) * np.power(share, -0.35)


#: Of a map, by the rms distance of the thresholds of its quarters from its own, by its number of
#: independent heights, and by the share that is wanted.
PATCH = ErrorLaw("patch", "ln_work", "patches.csv", unit=_patch_unit, label="map")


def find_states_error(share: NDArray) -> NDArray:
    """Error of a share by states: absolute, but none of which next to nothing remains."""
    error = STATES.spread.high
    return error * share / (share + error)


def find_needed_error(share: NDArray, missed: NDArray) -> NDArray:
    """Absolute error with which `find_states_error` is what a share was missed by."""
    with np.errstate(divide="ignore", invalid="ignore"):
        needed = share * missed / (share - missed)
    return np.select([missed == 0, missed < share], [0.0, needed], np.inf)


# Errors of contacts that are larger than a scan, and of balls.


#: By the share of the energy in waves longer than the scan, and by how unlike Gaussian heights of
#: even roughness those of the scan are. The draws of the longer waves hold Gaussian heights.
LARGER = ErrorLaw(
    kind="larger",
    quantity="ln_work",
    source="larger.csv",
    unit=lambda longer, unlikeness: longer * unlikeness,
    label="larger contact",
)
#: Of ln of the force, by ln of the factor that roughness takes from it.
BALL = ErrorLaw(
    kind="ball",
    quantity="ln_force",
    source="balls.csv",
    unit=lambda lost: np.sqrt(np.maximum(lost, 0.0)),
    label="ball",
)

#: Independent heights in a zone of contact that is one wave wide.
SUMMITS = ErrorLaw("ball", "summits", "balls.csv", unit=np.ones_like)

#: Those with a name on pages, in their order there.
SHOWN = (SHARE, SKEWNESS, THIN, FILM, SKIN, COATED, PATCH, LARGER, BALL)
