"""One material on one rough surface: whether it sticks, and what would make it stick."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from stickiness import __version__
from stickiness.criteria.pair import REGIMES, WORDS
from stickiness.criteria.registry import CRITERIA, REMAINING
from stickiness.entries.material import Material
from stickiness.formatting import amount
from stickiness.limited import Limited
from stickiness.plausibility import PlausibilityWarning
from stickiness.remaining.trial_states import DEFAULT_SHARE
from stickiness.spectrum.interface import Spectrum
from stickiness.verdicts import wording
from stickiness.verdicts.judgement import find_pair_doubts, judge
from stickiness.verdicts.limits import read_limited
from stickiness.verdicts.pair_variables import DECIDED_BY
from stickiness.verdicts.rough_surface import Surface
from stickiness.verdicts.thresholds import CONTACT_AREA
from stickiness.verdicts.wording import MOST_STRESS


@dataclass(frozen=True, eq=False)
class StickinessVerdict:
    """Answer for one material on one surface: a view of one cell of what `judge` returns.

    Numbers are NaN if the pair is not judged; every pair of limits is (low, high).
    """

    cell: xr.Dataset  #: of `judge`, at one material and one surface

    def __repr__(self) -> str:
        share = wording.tell_share(*read_limited(self.cell.remaining))
        return f"StickinessVerdict({self.word!r}, remaining: {share})"

    @property
    def word(self) -> str:
        """Verdict, one of `WORDS`.

        "depends" if the wanted share lies within the limits of what remains, "adheres locally, does
        not hold" if contact grows by itself at the finest wave but less than the wanted share
        remains, "sticks fully" if at least `pair.FULL_SHARE` does, "not judged" if the data are
        implausible.
        """
        return WORDS[int(self.cell.verdict)]

    @property
    def remaining(self) -> float:
        """Share of the work of adhesion that remains on the rough surface."""
        return self._value("remaining")

    @property
    def remaining_limits(self) -> tuple[float, float]:
        """Limits of the share."""
        return self._limits("remaining")

    @property
    def wanted_share(self) -> float:
        """Share of the work of adhesion that must remain to stick."""
        return float(self.cell.wanted_share)

    @property
    def pull_off(self) -> float:
        """Largest mean tension on separation [Pa]."""
        return self._value("pull_off")

    @property
    def pull_off_limits(self) -> tuple[float, float]:
        """Limits of the pull-off [Pa]."""
        return self._limits("pull_off")

    @property
    def margin(self) -> float:
        """Adhesion length over the one at which the wanted share remains; sticks above 1."""
        return self._value("margin")

    @property
    def margin_limits(self) -> tuple[float, float]:
        """Limits of the margin."""
        return self._limits("margin")

    @property
    def modulus_threshold(self) -> float:
        """Young's modulus [Pa] below which the wanted share remains.

        Of a material that was given by its plane-strain modulus alone it is that of E*.
        """
        return self._value("modulus_threshold")

    @property
    def modulus_threshold_limits(self) -> tuple[float, float]:
        """Limits of the threshold [Pa]."""
        return self._limits("modulus_threshold")

    @property
    def plane_strain_modulus_threshold(self) -> float:
        """Plane-strain modulus E* [Pa] below which the wanted share remains."""
        return self._value("plane_strain_modulus_threshold")

    @property
    def plane_strain_modulus_threshold_limits(self) -> tuple[float, float]:
        """Limits of that threshold [Pa]."""
        return self._limits("plane_strain_modulus_threshold")

    @property
    def regime(self) -> str:
        """One of `REGIMES`, by the Tabor parameter of the contact edges."""
        return REGIMES[int(self.cell.regime.sel(end="rough"))]

    @property
    def simulated(self) -> bool:
        """Whether full simulation covers the state of the edges."""
        return bool(self.cell.simulated.all())

    @property
    def a_v(self) -> float:
        """a_V of the pair."""
        return self._value("pair_a_v")

    @property
    def a_v_limits(self) -> tuple[float, float]:
        """Limits of a_V."""
        return self._limits("pair_a_v")

    @property
    def margins(self) -> dict[str, float]:
        """Margin by every criterion of `registry.CRITERIA`, at the rough end; sticky above 1.

        That of what remains is the `margin`.
        """
        at_rough_end = self.cell.margin_by_criterion.sel(end="rough")
        margins = {name: float(at_rough_end.sel(criterion=name)) for name in CRITERIA}
        return margins | {REMAINING: self.margin}

    @property
    def energy_ratio(self) -> float:
        """Work of adhesion over the elastic energy of full contact."""
        return float(self.cell.energy_ratio.max())

    @property
    def decided_by(self) -> str:
        """One of `DECIDED_BY`: theory, or contact simulated on the heights."""
        return DECIDED_BY[int(self.cell.decided_by)]

    @property
    def contact(self) -> float:
        """Side of the contact [m] that the answer is for; NaN of a surface that was not measured.

        It is that of the scan, unless a larger one was given.
        """
        return float(self.cell.contact)

    @property
    def doubts(self) -> tuple[str, ...]:
        """Why the answer is probably to another question."""
        return tuple(self.cell.doubts.item().splitlines())

    @property
    def not_judged(self) -> tuple[str, ...]:
        """Why there is no answer; they are doubts, too."""
        return tuple(self.cell.not_judged.item().splitlines())

    @property
    def questions(self) -> list[dict[str, Any]]:
        """Questions that the measurement leaves open and that decide, see `questions.ask`."""
        return wording.list_questions(self.cell)

    def _tell(self, asked: Mapping[str, Any]) -> Iterator[str]:
        """A question and its answers, a line each."""
        yield f"question: {asked['question']}"
        for answer in asked["answers"]:
            yield f"  {wording.tell_answer(answer, self.cell)}"

    def _value(self, name: str) -> float:
        return float(self.cell[name].sel(limit="value"))

    def _limits(self, name: str) -> tuple[float, float]:
        return float(self.cell[name].sel(limit="low")), float(self.cell[name].sel(limit="high"))

    def to_dict(self) -> dict[str, Any]:
        """Return verdict, thresholds and the effective attraction for DEM and FE models.

        Values are in SI units and ready for JSON; what is not known is left out: all but the low
        limit of the pull-off where contact is nearly full, and moduli that no material reaches.
        Moduli say whether they are Young's modulus E or the plane-strain modulus E*. `warnings` has
        the doubts about the pair.
        """
        cell = self.cell
        pull_off = read_limited(cell.pull_off)
        if not wording.is_pull_off_known(cell):
            pull_off = pull_off._replace(value=np.nan, high=np.nan)
        contents = {
            "version": __version__,
            "verdict": self.word,
            "decided_by": self.decided_by if wording.is_judged(cell) else None,
            "law": cell.law.item(),
            **self._describe_moduli(),
            "work_of_adhesion": _quantity_of(cell.work_of_adhesion, "J/m^2"),
            "range": _quantity_of(cell.range, "m"),
            "dwell": _quantity_of(cell.dwell, "s"),
            "material_properties": cell.properties.item(),
            "rms_height": _quantity_of(cell.rms_height, "m"),
            "wanted_share": self.wanted_share,
            **self._describe_remaining(),
            "pull_off_stress": _quantity(pull_off, "Pa"),
            "contact": _quantity_of(cell.contact, "m"),
        }
        contents["questions"] = [
            asked | {"answers": list(map(self._describe_answer, asked["answers"]))}
            for asked in self.questions
        ] or None
        contents["warnings"] = list(self.doubts)
        return _leave_out_unknown(contents)

    def _describe_answer(self, answer: Mapping[str, Any]) -> dict[str, Any]:
        """One answer to a question, with quantities as of the verdict."""
        units = {"remaining": ("remaining_share", "1"), "modulus_threshold": (None, "Pa")}
        described = dict(answer)
        for name, (told, unit) in units.items():
            low, value, high = described.pop(name)
            numbers = _drop_unbounded(Limited(value, low, high))
            described[told or name] = _quantity(numbers, unit)
        return _leave_out_unknown(described)

    def _describe_moduli(self) -> dict[str, Any]:
        """Moduli of the material; Young's only with Poisson's ratio."""
        plane_strain = {"plane_strain_modulus": _quantity_of(self.cell.plane_strain_modulus, "Pa")}
        if np.isnan(self.cell.poisson_ratio):
            return plane_strain
        return {
            "youngs_modulus": _quantity_of(self.cell.quoted_modulus, "Pa"),
            "poisson_ratio": float(self.cell.poisson_ratio),
            **plane_strain,
        }

    def _describe_remaining(self) -> dict[str, Any]:
        """What remains, and the thresholds."""
        share = read_limited(self.cell.remaining)
        work = float(self.cell.work_of_adhesion)
        moduli = {
            "modulus_threshold": wording.name_modulus(self.cell),
            "plane_strain_modulus_threshold": "E*",
        }
        described = {
            "remaining_share": _quantity(share, "1"),
            "effective_work_of_adhesion": _quantity(Limited(*(work * x for x in share)), "J/m^2"),
        }
        for name, symbol in moduli.items():
            modulus = _quantity(_drop_unbounded(read_limited(self.cell[name])), "Pa")
            described[name] = modulus and {"symbol": symbol, **modulus}
        return _leave_out_unknown(described)

    def __str__(self) -> str:
        cell = self.cell
        doubts = list(self.doubts)
        height = f"rms height of the surface: {amount(float(cell.rms_height), 'm')}"
        if self.not_judged:
            doubts.remove(self.not_judged[0])
            lines = [f"{self.word}: {self.not_judged[0]}", height]
        else:
            remaining = (wording.tell_remaining(cell), wording.tell_improbable(cell))
            lines = [
                f"{self.word}: {'; '.join(filter(None, remaining))}",
                *(line for asked in self.questions for line in self._tell(asked)),
                height,
                f"pull-off stress: {wording.tell_pull_off(cell)}",
                wording.tell_change(cell),
                wording.tell_contact(cell),
                f"decided by {self.decided_by}",
                wording.tell_dwell(cell),
            ]
        return "\n".join([*filter(None, lines), *(f"warning: {doubt}" for doubt in doubts)])


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
        Keys of `Material`: at least `youngs_modulus`, `work_of_adhesion` and `range`; also
        `poisson_ratio` (0.5 by default), `thickness`, `law`, `pressed`, `dwell` and others.

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
    >>> steel = {"youngs_modulus": "210 GPa", "poisson_ratio": 0.3}
    >>> verdict(rough, **steel, work_of_adhesion=0.1, range=3e-10).word
    'does not stick'
    """
    material, surface = _read_pair(surface, material, length, properties)
    cell = _judge_one(material, surface, wanted_share=wanted_share, thresholds=False)
    return StickinessVerdict(cell)


@dataclass(frozen=True)
class Thresholds:
    """What would make a material stick to a surface, all else being as it is."""

    modulus: Limited[float]  #: sticks below [Pa]; Young's modulus, or E* if that was given
    rms_height: Limited[float]  #: sticks below [m]
    thickness: Limited[float] | None  #: sticks above [m]; None of a half-space
    pressure: Limited[float]  #: mean pressure [Pa] that makes the area of contact, without adhesion
    rate: Limited[float] | None  #: sticks below [Hz]; None of an elastic solid, and after a dwell


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
    >>> tape = Material(youngs_modulus=2e6, work_of_adhesion=0.06, range=3e-10)
    >>> answer = thresholds(wall, tape)
    >>> print(f"sticks below E = {answer.modulus.value / 1e6:.2f} MPa")
    sticks below E = 1.50 MPa
    """
    material, surface = _read_pair(surface, material, length, properties)
    cell = _judge_one(material, surface, wanted_share=wanted_share, contact_area=contact_area)

    def collect(name: str) -> Limited[float] | None:
        threshold = read_limited(cell[name])
        return None if np.isnan(threshold).all() else threshold

    return Thresholds(
        modulus=read_limited(cell.modulus_threshold),
        rms_height=read_limited(cell.rms_height_threshold),
        thickness=collect("thickness_threshold"),
        pressure=read_limited(cell.contact_pressure),
        rate=collect("rate_threshold"),
    )


def _read_pair(
    surface: Surface | Spectrum | ArrayLike,
    material: Material | None,
    length: float | tuple[float, float] | None,
    properties: Mapping[str, Any],
) -> tuple[Material, Surface]:
    """Make a `Material` and a `Surface` of the arguments of `verdict`."""
    if (material is None) == (not properties):
        raise ValueError("give either a material or its properties, such as youngs_modulus=2e5")
    if material is None:
        material = Material(**properties)
    if isinstance(surface, Material | str | Path):
        raise ValueError(
            f"surface must be a Surface, a spectrum or heights, got {surface!r}; Surface.read "
            "opens a file"
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
    return material, surface


def _judge_one(material: Material, surface: Surface, **settings: Any) -> xr.Dataset:
    """The cell of `judge` for one pair, with a warning of every doubt about its values."""
    dataset = judge([material], [surface], curves=False, **settings)
    for doubt in find_pair_doubts(material, surface):
        warnings.warn(doubt, PlausibilityWarning, stacklevel=3)
    return dataset.isel(material=0, surface=0)


def _leave_out_unknown(contents: Mapping[str, Any]) -> dict[str, Any]:
    """The contents that are known."""
    return {name: content for name, content in contents.items() if content is not None}


def _quantity_of(number: xr.DataArray, unit: str) -> dict[str, Any] | None:
    """One number with its unit; None if it is not known."""
    return {"value": float(number), "unit": unit} if np.isfinite(number) else None


def _drop_unbounded(moduli: Limited[float]) -> Limited[float]:
    """Moduli with NaN in place of those that no material reaches: there any modulus sticks."""
    return Limited(*(modulus if modulus <= MOST_STRESS else np.nan for modulus in moduli))


def _quantity(limited: Limited, unit: str) -> dict[str, Any] | None:
    """Those of value and limits that are finite, with their unit; None if none is."""
    finite = {name: number for name, number in limited._asdict().items() if np.isfinite(number)}
    return finite | {"unit": unit} if finite else None
