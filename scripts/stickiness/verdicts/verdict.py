"""One material on one rough surface: whether it sticks, and what would make it stick."""

from __future__ import annotations

import warnings
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from stickiness import __version__
from stickiness.criteria.pair import DEPENDS, MOST_STRAIN, NOT_JUDGED, REGIMES, WORDS
from stickiness.criteria.registry import CRITERIA, REMAINING
from stickiness.formatting import amount, in_percent, in_unit, in_units_of, limited, number
from stickiness.limited import Limited
from stickiness.plausibility import LIMITS, PlausibilityWarning
from stickiness.remaining.roughness import LEAST_LENGTH, PULL_OFF_UNKNOWN
from stickiness.remaining.trial_states import DEFAULT_SHARE
from stickiness.spectrum.interface import Spectrum
from stickiness.verdicts.judgement import DECIDED_BY, LARGER, judge
from stickiness.verdicts.limits import read_limited
from stickiness.verdicts.material import Material
from stickiness.verdicts.rough_surface import Surface
from stickiness.verdicts.thresholds import CONTACT_AREA, UNKNOWN

LEAST_STRESS = 1.0  #: [Pa]; beyond these two nobody can use a stress or a modulus
MOST_STRESS = 1e13
LEAST_SHOWN = 1e-3  #: share of the work of adhesion below which texts say 0 %


class LargerContact(NamedTuple):
    """Answer for a contact larger than the scan, if the fitted law goes on to longer waves."""

    contact: float  #: side of the contact [m]
    word: str  #: verdict
    remaining: Limited  #: share of the work of adhesion
    modulus_threshold: Limited  #: plane-strain modulus below which the wanted share remains [Pa]


@dataclass(frozen=True)
class StickinessVerdict:
    """Answer for one material on one surface; every pair of limits is (low, high).

    Numbers are NaN if the pair is not judged.
    """

    #: One of `WORDS`: "depends" if the wanted share lies within the limits of what remains,
    #: "adheres locally, does not hold" if contact grows by itself at the finest wave but less than
    #: the wanted share remains, "sticks fully" if at least `pair.FULL_SHARE` does, "not judged" if
    #: the data are implausible.
    word: str
    remaining: float  #: share of the work of adhesion that remains on the rough surface
    remaining_limits: tuple[float, float]
    pull_off: float  #: largest mean tension on separation [Pa]
    pull_off_limits: tuple[float, float]
    #: Adhesion length over the one at which the wanted share remains; sticks above 1.
    margin: float
    margin_limits: tuple[float, float]
    modulus_threshold: float  #: plane-strain modulus below which the wanted share remains [Pa]
    modulus_threshold_limits: tuple[float, float]
    regime: str  #: one of `REGIMES`, by the Tabor parameter of the contact edges
    simulated: bool  #: whether full simulation covers the state of the edges
    a_v: float  #: a_V of the pair
    a_v_limits: tuple[float, float]
    margins: dict[str, float]  #: by every criterion of `registry.CRITERIA`; sticky above 1
    energy_ratio: float  #: work of adhesion over the elastic energy of full contact
    wanted_share: float  #: of the work of adhesion, that must remain to stick
    decided_by: str  #: one of `DECIDED_BY`: theory, or contact simulated on the heights
    #: Side of the contact [m] that the answer is for: that of the scan, unless a larger one was
    #: given; NaN of a surface that was not measured.
    contact: float
    larger: LargerContact | None  #: answer for a larger contact; None where nothing would change
    material: Material = field(repr=False)  #: that was judged
    surface: Surface = field(repr=False)  #: on which it was judged
    doubts: tuple[str, ...]  #: why the answer is probably to another question
    not_judged: tuple[str, ...] = ()  #: why there is no answer; they are doubts, too

    def to_dict(self) -> dict[str, Any]:
        """Return verdict, threshold and the effective attraction for DEM and FE models.

        Values are in SI units and ready for JSON; what is not known is left out. `warnings` has the
        doubts about the pair.
        """
        contact_law = describe_contact_law(
            word=self.word,
            material=self.material,
            remaining=Limited(self.remaining, *self.remaining_limits),
            pull_off=Limited(self.pull_off, *self.pull_off_limits),
            modulus_threshold=Limited(self.modulus_threshold, *self.modulus_threshold_limits),
            energy_ratio=self.energy_ratio,
            decided_by=self.decided_by,
            contact=self.contact,
            larger=self.larger,
        )
        return {"version": __version__, **contact_law, "warnings": list(self.doubts)}

    def __str__(self) -> str:
        height = f"rms height of the surface: {amount(self.surface.rms_height, 'm')}"
        if self.not_judged:
            doubts = [doubt for doubt in self.doubts if doubt != self.not_judged[0]]
            headline = [f"{self.word}: {self.not_judged[0]}", height]
        else:
            doubts = list(self.doubts)
            headline = [
                f"{self.word}: {self._describe_remaining()}{self._describe_doubt()}",
                height,
                f"pull-off stress: {self._describe_pull_off()}",
                self._describe_threshold(),
                *self._describe_contact(),
                f"decided by {self.decided_by}",
                *self._describe_dwell(),
            ]
        return "\n".join([*headline, *(f"warning: {doubt}" for doubt in doubts)])

    def _describe_doubt(self) -> str:
        """Improbable values that decide, behind the verdict; empty if there are none."""
        improbable = []
        slope = float(self.surface.data.rms_slope[-1])
        if slope > LIMITS["rms_slope"].usual:
            improbable.append(f"the rms slope is {number(slope, 2)}")
        work = self.material.work_of_adhesion
        if work > LIMITS["work_of_adhesion"].usual and not self.material.work_on_smooth:
            improbable.append(f"the work of adhesion is {number(work, 2)} J/m^2")
        if self.material.range > LIMITS["range"].usual:
            improbable.append(f"the range is {amount(self.material.range, 'm', 2)}")
        return f"; doubtful, for {' and '.join(improbable)}" if improbable else ""

    def _describe_remaining(self) -> str:
        share = tell_share(self.remaining, *self.remaining_limits)
        of = "" if share.endswith("times") else " of"
        wanted = f"{100 * self.wanted_share:g} % is wanted"
        return f"{share}{of} the work of adhesion remains; {wanted}"

    def _describe_pull_off(self) -> str:
        low, high = self.pull_off_limits
        if self.energy_ratio <= PULL_OFF_UNKNOWN:
            return limited(self.pull_off, low, high, in_unit("Pa"), least=LEAST_STRESS)
        if low < LEAST_STRESS:
            return "not known (contact is nearly full, which was not simulated)"
        return f"at least {amount(low, 'Pa', 2)} (contact is nearly full, which was not simulated)"

    def _describe_threshold(self) -> str:
        """Threshold of the modulus, as the modulus was given: E, or E*."""
        poisson = self.material.poisson
        name = "E*" if poisson is None else "E"
        as_given = 1.0 if poisson is None else 1 - poisson**2
        actual = f"it is {amount(as_given * self.material.plane_strain_modulus, 'Pa')}"
        value = as_given * self.modulus_threshold
        low, high = (as_given * modulus for modulus in self.modulus_threshold_limits)
        if low > MOST_STRESS:
            return f"sticks at any modulus; {actual}"
        if high < LEAST_STRESS:
            return f"sticks at no modulus; {actual}"
        if value > MOST_STRESS:
            below = f"sticks below {name} = {amount(low, 'Pa')}"
            return f"{below}, and probably at any modulus; {actual}"
        if value < LEAST_STRESS:
            return f"sticks at no modulus, or below {name} = {amount(high, 'Pa')}; {actual}"
        text = limited(value, low, high, in_unit("Pa", 3), least=LEAST_STRESS, most=MOST_STRESS)
        return f"sticks below {name} = {text}; {actual}"

    def _describe_contact(self) -> list[str]:
        """Size of the contact, and the answer for a larger one; none where neither matters."""
        size = amount(self.contact, "m")
        if self.surface.is_larger:
            return [f"for a contact of {size}"]
        if self.larger is None:
            return []
        larger = amount(self.larger.contact, "m")
        share = tell_share(*self.larger.remaining)
        return [
            f"for contacts up to the size of the scan, {size}; for {larger}, if longer waves "
            f"follow the fitted law: {self.larger.word}, {share} remains"
        ]

    def _describe_dwell(self) -> list[str]:
        """What a dwell does, in one line; none without one."""
        if self.material.dwell is None:
            return []
        return [
            f"after a dwell of {self.material.dwell:g} s: values are for slow separation, high "
            f"limits for up to {number(self.material.instant_ratio, 2)} times the work and stress, "
            "the instantaneous modulus over the relaxed one"
        ]


def tell_share(value: float, low: float, high: float) -> str:
    """Share of the work of adhesion that remains, or a multiple, with its limits."""
    if high <= 1:
        return limited(value, low, high, in_percent, least=LEAST_SHOWN)
    return f"{limited(value, low, high, in_units_of(1.0), least=LEAST_SHOWN)} times"


def verdict(
    surface: Surface | Spectrum | ArrayLike,
    /,
    material: Material | None = None,
    *,
    length: float | tuple[float, float] | None = None,
    wanted_share: float = DEFAULT_SHARE,
    **properties: Any,
) -> StickinessVerdict:
    """Say whether a material sticks to a rough surface.

    It is one cell of `judge`, and so the answer of the workflow and of ``python -m stickiness``.

    Parameters
    ----------
    surface : Surface, Spectrum or (nx, ny) array
        The surface, its spectrum, or its heights [m] with their `length`.
    material : Material, optional
        The material. Or give its `properties`.
    length : float or pair of floats
        Sides [m] of heights; only with these.
    wanted_share : float
        Share of the work of adhesion that must remain for a pair to stick, between 0 and 1.
    **properties
        Parameters of `Material`: at least `modulus`, `work_of_adhesion` and `range`; also
        `poisson` (0.5 by default), `solid`, `law`, `pressed`, `dwell` and others.

    Returns
    -------
    StickinessVerdict
        Its `word` is "not judged", and its numbers are NaN, where the data are implausible.

    Raises
    ------
    ValueError
        If a property is out of range, or if `length` is missing for heights or given for others.

    Warns
    -----
    PlausibilityWarning
        If the rms slope exceeds 1, if a value is none that real pairs have in SI units, such as a
        modulus in MPa or a length of 2 for 2 mm, if heights have spikes or the like, or if waves
        that heights do not resolve decide. A spectrum has the waves that it is given.

    See Also
    --------
    stickiness.judge : many materials on many surfaces
    stickiness.thresholds : what would make a pair stick

    Examples
    --------
    >>> from stickiness.spectrum import SelfAffine
    >>> rough = SelfAffine(hurst=0.8, q0=6e4, q1=6e8, h_rms=1e-6)
    >>> verdict(rough, modulus=210e9, poisson=0.3, work_of_adhesion=0.1, range=3e-10).word
    'does not stick'
    """
    pair = read_pair(surface, material, length=length, **properties)
    cell = _judge_one(pair, wanted_share=wanted_share, thresholds=False)
    return summarise(cell, pair, wanted_share)


@dataclass(frozen=True)
class Thresholds:
    """What would make a material stick to a surface, all else being as it is."""

    modulus: Limited  #: sticks below [Pa]; Young's modulus, or E* if `poisson` is None
    rms_height: Limited  #: sticks below [m]
    thickness: Limited | None  #: sticks above [m]; None of a half-space
    pressure: Limited  #: mean pressure [Pa] that makes the area of contact, without adhesion
    rate: Limited | None  #: sticks below [Hz]; None of an elastic solid, and after a dwell


def thresholds(
    surface: Surface | Spectrum | ArrayLike,
    /,
    material: Material | None = None,
    *,
    length: float | tuple[float, float] | None = None,
    wanted_share: float = DEFAULT_SHARE,
    contact_area: float = CONTACT_AREA,
    **properties: Any,
) -> Thresholds:
    """Find the modulus, rms height, thickness and rate at which a material begins to stick.

    Also the pressure at which a share of the nominal area is in contact.

    Parameters
    ----------
    surface : Surface, Spectrum or (nx, ny) array
        As of `verdict`. Other rms heights have a spectrum of the same shape.
    material, length, wanted_share, **properties
        As of `verdict`, with its errors and warnings.
    contact_area : float
        Share of the nominal area, 0.005 to 0.35, down to the shortest wave of the surface. By
        `Persson` with Wang and Müser's correction (Tribol. Lett. 65:103, 2017).

    Returns
    -------
    Thresholds
        At a threshold the verdict has the wanted share to 1e-4; at its limits one of the limits of
        the share.

    Examples
    --------
    >>> from stickiness.spectrum import SelfAffine
    >>> wall = SelfAffine(hurst=0.8, q0=6e4, q1=6e8, h_rms=1e-6)
    >>> tape = Material(modulus=2e6, poisson=0.5, work_of_adhesion=0.06, range=3e-10)
    >>> answer = thresholds(wall, tape)
    >>> print(f"sticks below E = {answer.modulus.value / 1e6:.2f} MPa")
    sticks below E = 1.50 MPa
    """
    pair = read_pair(surface, material, length=length, **properties)
    cell = _judge_one(pair, wanted_share=wanted_share, contact_area=contact_area)

    def collect(name: str) -> Limited | None:
        threshold = read_limited(cell[name])
        return None if np.isnan(threshold).all() else threshold

    moduli = find_limited(cell, "modulus_threshold")
    if int(cell.verdict) == NOT_JUDGED:
        return Thresholds(Limited(*moduli), UNKNOWN, None, UNKNOWN, None)

    # Where any modulus would do, no number is a threshold.
    judged = pair.material
    full_contact_energy = judged.work_of_adhesion / float(cell.energy_ratio.sel(end="rough"))
    any_modulus = 0.99 * judged.plane_strain_modulus * judged.work_of_adhesion
    any_modulus /= LEAST_LENGTH * full_contact_energy
    as_given = 1.0 if judged.poisson is None else 1 - judged.poisson**2
    moduli = [as_given * x if x < any_modulus else np.inf for x in moduli]
    return Thresholds(
        modulus=Limited(*moduli),
        rms_height=collect("rms_height_threshold"),
        thickness=collect("thickness_threshold"),
        pressure=collect("contact_pressure"),
        rate=collect("rate_threshold"),
    )


class ReadPair(NamedTuple):
    """A material and a surface, and the values of theirs that hardly any real pair has."""

    material: Material
    surface: Surface
    doubts: tuple[str, ...]


def read_pair(
    surface: Surface | Spectrum | ArrayLike,
    /,
    material: Material | None = None,
    *,
    length: float | tuple[float, float] | None = None,
    **properties: Any,
) -> ReadPair:
    """Make a `Material` and a `Surface` of the arguments of `verdict`, with their doubts."""
    if (material is None) == (not properties):
        raise ValueError("give either a material or its properties, such as modulus=2e5")
    if material is None:
        material = Material(**properties)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", PlausibilityWarning)
        if isinstance(surface, Material | str | Path):
            raise ValueError(
                "surface must be a Surface, a spectrum or heights, got "
                f"{surface!r}; Surface.read opens a file"
            )
        if isinstance(surface, Surface | Spectrum):
            if length is not None:
                raise ValueError(f"length is of heights alone; leave it out, got {length!r}")
        else:
            if length is None:
                raise ValueError("length is missing: the side of the measured heights in m")
            surface = Surface.from_heights(surface, length)
        if isinstance(surface, Spectrum):
            surface = Surface.from_spectrum(surface)
        material.warn()
        for rough in filter(None, (surface, material.surface)):
            rough.warn()
    for warning in caught:  # others are none of ours
        if not issubclass(warning.category, PlausibilityWarning):
            warnings.warn(warning.message, stacklevel=3)
    doubts = [str(w.message) for w in caught if issubclass(w.category, PlausibilityWarning)]
    return ReadPair(material, surface, tuple(doubts))


def _judge_one(pair: ReadPair, **settings: Any) -> xr.Dataset:
    """The cell of `judge` for one pair, with a warning of every doubt about it."""
    dataset = judge([pair.material], [pair.surface], curves=False, **settings)
    for doubt in pair.doubts:
        warnings.warn(doubt, PlausibilityWarning, stacklevel=3)
    return dataset.isel(material=0, surface=0)


def summarise(cell: xr.Dataset, pair: ReadPair, wanted_share: float) -> StickinessVerdict:
    """`StickinessVerdict` of one cell of what `judge` returns."""
    # The margin of a pair is that of what remains; the other criteria are told at the rough end.
    margin = read_limited(cell.margin)
    by_criterion = cell.margin_by_criterion.sel(end="rough")
    margins = {name: float(by_criterion.sel(criterion=name)) for name in CRITERIA}
    margins[REMAINING] = margin.value
    limited = {
        name: find_limited(cell, name) for name in ("remaining", "pull_off", "modulus_threshold")
    }
    a_v = read_limited(cell.pair_a_v)
    reasons = str(cell.not_judged.item()).splitlines()
    remarks = [text for text in pair.surface.remarks if text not in reasons]
    larger = find_larger(cell)
    if larger is not None and larger.word == WORDS[DEPENDS]:
        remarks += filter(lambda text: text not in remarks, pair.surface.larger.remarks)
    strain = float(cell.layer_strain.max())
    if strain > MOST_STRAIN:
        remarks.append(
            f"to conform, the layer would have to strain by about {strain:.2g}, beyond linear "
            "elasticity: all adhesion may be lost"
        )
    return StickinessVerdict(
        word=WORDS[int(cell.verdict)],
        remaining=limited["remaining"].value,
        remaining_limits=limited["remaining"][1:],
        pull_off=limited["pull_off"].value,
        pull_off_limits=limited["pull_off"][1:],
        margin=margin.value,
        margin_limits=margin[1:],
        modulus_threshold=limited["modulus_threshold"].value,
        modulus_threshold_limits=limited["modulus_threshold"][1:],
        regime=REGIMES[int(cell.regime.sel(end="rough"))],
        simulated=bool(cell.simulated.all()),
        a_v=a_v.value,
        a_v_limits=a_v[1:],
        margins=margins,
        energy_ratio=float(cell.energy_ratio.max()),
        wanted_share=wanted_share,
        decided_by=DECIDED_BY[int(cell.decided_by)],
        contact=float(cell.contact),
        larger=larger,
        material=pair.material,
        surface=pair.surface,
        doubts=(*pair.doubts, *remarks, *reasons),
        not_judged=tuple(reasons),
    )


def find_larger(cell: xr.Dataset) -> LargerContact | None:
    """Answer for a larger contact from one cell of what `judge` returns; None if there is none."""
    if np.isnan(cell.larger_contact):
        return None
    limited = {name: read_limited(cell[f"larger_{name}"]) for name in LARGER}
    return LargerContact(
        contact=float(cell.larger_contact), word=WORDS[int(cell.larger_verdict)], **limited
    )


def find_limited(cell: xr.Dataset, name: str) -> Limited:
    """Value and limits of a quantity of one pair."""
    limited = read_limited(cell[name])
    if name == "modulus_threshold":
        # Nothing is softer: below a skin that is too stiff no modulus would do.
        return Limited(*(0.0 if x < 1e-3 * LEAST_STRESS else x for x in limited))
    return limited


def describe_contact_law(
    *,
    word: str,
    material: Material,
    remaining: Limited,
    pull_off: Limited,
    modulus_threshold: Limited,
    energy_ratio: float,
    decided_by: str,
    contact: float,
    larger: LargerContact | None,
) -> dict[str, Any]:
    """Return a verdict and the effective attraction of a smooth surface, for DEM and FE models.

    What is not known is left out: all but the low limit of the pull-off where `energy_ratio`, the
    work of adhesion over the energy of full contact, is large.
    """
    if energy_ratio > PULL_OFF_UNKNOWN:
        pull_off = pull_off._replace(value=np.nan, high=np.nan)
    work = material.work_of_adhesion
    contact_law = {
        "verdict": word,
        "decided_by": None if word == WORDS[NOT_JUDGED] else decided_by,
        "law": material.law,
        "modulus": {"value": material.plane_strain_modulus, "unit": "Pa"},
        "work_of_adhesion": {"value": work, "unit": "J/m^2"},
        "range": {"value": material.range, "unit": "m"},
        "modulus_threshold": _quantity(_drop_unbounded(modulus_threshold), "Pa"),
        "effective_work_of_adhesion": _quantity(
            Limited(*(work * share for share in remaining)), "J/m^2"
        ),
        "pull_off_stress": _quantity(pull_off, "Pa"),
    }
    if not np.isnan(contact):
        contact_law["contact"] = {"value": contact, "unit": "m"}
    if larger is not None:
        contact_law["larger_contact"] = {
            "contact": {"value": larger.contact, "unit": "m"},
            "verdict": larger.word,
            "effective_work_of_adhesion": _quantity(
                Limited(*(work * share for share in larger.remaining)), "J/m^2"
            ),
            "modulus_threshold": _quantity(_drop_unbounded(larger.modulus_threshold), "Pa"),
        }
    return {name: value for name, value in contact_law.items() if value is not None}


def _drop_unbounded(moduli: Limited) -> Limited:
    """Moduli with NaN in place of those that no material reaches: there any modulus sticks."""
    return Limited(*(modulus if modulus <= MOST_STRESS else np.nan for modulus in moduli))


def _quantity(limited: Limited, unit: str) -> dict[str, Any] | None:
    """Those of value and limits that are finite, with their unit; None if none is."""
    finite = {name: value for name, value in limited._asdict().items() if np.isfinite(value)}
    return finite | {"unit": unit} if finite else None
