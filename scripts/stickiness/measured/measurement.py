"""One measurement of a surface as configured: levelled heights, and the spectrum found in them."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from inspect import signature
from pathlib import Path
from typing import Any

from numpy.typing import NDArray

from stickiness.measured import instrument_spectrum, topography
from stickiness.measured.features import find_feature
from stickiness.measured.guess import Guess, guess_place, guess_side
from stickiness.measured.instrument_spectrum import MeasuredSpectrum, TrustedWaves
from stickiness.measured.psd import Taper
from stickiness.measured.topography import Profile, Step, Topography
from stickiness.statistics import measure_shape

FEWEST_POINTS = {1: 256, 2: 64}  #: along a profile, and along the shorter side of a map, for a fit
_ALL_MISSING = 1 - 1e-9  # a share of missing points that no file reaches
_INSTRUMENT_KEYS = {"fit_from", "fit_to", "resolution", "tip_radius"}  # lengths of `TrustedWaves`
# Keys of heights in files and arrays.
_CLEANING = {"missing", "max_missing", "missing_rim", "spikes", "scan"}
_READING = set(signature(topography.read).parameters) - {"path", "max_missing"}
# Texts about a measurement that say that a replica was measured; metals and films are cast, too.
_REPLICA = re.compile(
    r"(?i)repli[ck]|replis|imprint|impression|moulage|empreinte|abdruck|abguss|abformung"
    r"|(?<![a-z])(?:cast(?![ _-]?(?:iron|steel|al|film))|mou?ld)(?:ing)?(?![a-z])"
)
_ABOUT = ("label", "source", "note")  # keys with such texts
LEAST_SKEWNESS = 0.5  #: above which heights upside down have another verdict; 0.3 by chance


@dataclass(frozen=True)
class Measurement:
    """Levelled heights of one measurement, and how its spectrum is to be found."""

    heights: Topography | Profile
    window: Taper = "hann"  #: taper of the heights before they are transformed
    instrument: TrustedWaves = field(default_factory=TrustedWaves)

    @classmethod
    def from_entry(cls, entry: Mapping[str, Any]) -> Measurement:
        """Read a measurement as a checked entry of the configuration says.

        A file with too many missing points is read all the same, with a doubt that forbids a
        verdict, so that its page can show what is wrong.
        """
        reading = {key: entry[key] for key in _READING if entry.get(key) is not None}
        reading["height_factor"] = _find_sign(entry) * entry["height_factor"]
        heights = topography.read(entry["file"], max_missing=_ALL_MISSING, **reading)
        return cls._level(_doubt_missing(heights, most=entry["max_missing"]), entry)

    @classmethod
    def from_array(
        cls, heights: NDArray, steps: float | tuple[float, ...], options: Mapping[str, Any]
    ) -> Measurement:
        """Take heights on a grid of these steps [m], with checked `options` of an entry."""
        reading = {key: options[key] for key in _CLEANING if options[key] is not None}
        measured = topography.from_array(heights, steps, scale=_find_sign(options), **reading)
        return cls._level(measured, options)

    @classmethod
    def _level(cls, heights: Topography | Profile, entry: Mapping[str, Any]) -> Measurement:
        """Level heights, and say which of their waves are trusted."""
        lengths = {key: float(entry[key]) for key in _INSTRUMENT_KEYS if entry.get(key) is not None}
        levelled = heights.detrended(entry["detrend"])
        if isinstance(levelled, Topography):
            levelled = _look_for_feature(levelled, entry)
        if guess := _guess_replica(levelled, entry):
            step = Step("take for the surface itself", guess=guess)
            levelled = replace(levelled, processing=(*levelled.processing, step))
        window = entry["window"]
        if window == "detect":
            window = "none" if levelled.periodic else "hann"
        if levelled.periodic:
            taper = "without a taper" if window == "none" else f"with the taper {window}"
            remark = (
                "the file says that the heights are periodic; they were analysed less their mean "
                f"and {taper} (to change it, give detrend or window)"
            )
            step = Step("take for periodic", parameters={"window": window}, remark=remark)
            levelled = replace(levelled, processing=(*levelled.processing, step))
        return cls(
            heights=levelled,
            window=window,
            instrument=TrustedWaves(**lengths, detect=entry["cutoff"] == "detect"),
        )

    def find_spectrum(self, alone: bool = True) -> tuple[MeasuredSpectrum, str]:
        """Spectrum of the heights, and why its fit cannot be relied on; empty if it can.

        Fewer waves are enough if it is not `alone`, because other measurements complete it.

        Raises
        ------
        ValueError
            If the heights have no spectrum at all.
        """
        try:
            spectrum = instrument_spectrum.analyse(
                self.heights, self.window, self.instrument, alone=alone
            )
            return spectrum, ""
        except ValueError as error:
            doubt = self._explain(error)
        try:
            spectrum = instrument_spectrum.analyse(self.heights, self.window, demand=False)
            return replace(spectrum, trusted=False), doubt
        except ValueError:
            raise ValueError(doubt) from None

    def _explain(self, error: ValueError) -> str:
        """Say why the spectrum has no fit."""
        shape = self.heights.heights.shape
        points = " x ".join(map(str, shape))
        doubt = f"{self.heights.source}: no fit to the spectrum of {points} points: {error}"
        if min(shape) < FEWEST_POINTS[len(shape)]:
            doubt += (
                f"; a map needs about {FEWEST_POINTS[2]} points along its shorter side, a profile "
                f"{FEWEST_POINTS[1]}"
            )
        return doubt


def find_spectra(measurements: Sequence[Measurement]) -> list[tuple[MeasuredSpectrum, str]]:
    """Spectrum of every measurement of a surface, and why it is not used; see `find_spectrum`."""
    analysed = [measurement.find_spectrum() for measurement in measurements]
    if not any(spectrum.trusted for spectrum, _ in analysed):
        return analysed
    # One that stands alone completes those that are short.
    return [
        (spectrum, doubt) if spectrum.trusted else measurement.find_spectrum(alone=False)
        for measurement, (spectrum, doubt) in zip(measurements, analysed, strict=True)
    ]


def _find_sign(entry: Mapping[str, Any]) -> float:
    """Sign of heights: those of a replica are turned upside down."""
    return -1.0 if entry["invert"] else 1.0


def _look_for_feature(levelled: Topography, entry: Mapping[str, Any]) -> Topography:
    """Name a feature that decides the energy of a map, or take the part of the map beside it."""
    choice = entry["features"]
    feature = None if choice == "keep" else find_feature(levelled.heights, levelled.size)
    if feature is None:
        return levelled
    points = tuple(
        slice(*(round(end / step) for end in ends))
        for ends, step in zip(feature.beside, levelled.steps, strict=True)
    )
    beside = levelled.heights[points]
    is_enough = min(beside.shape) >= FEWEST_POINTS[2]
    if choice == "beside" and is_enough:
        done = Step("take the part beside a feature", beside.size, {"features": choice})
        part = replace(
            levelled,
            heights=beside,
            processing=(*levelled.processing, done),
            as_read=None,
            unused=None,
            periodic=False,
        )
        return part.detrended(entry["detrend"])
    remark = str(feature)
    if not is_enough:
        remark += ". The map beside it is too small to judge the surface elsewhere"
    guess = guess_place(str(feature)) if is_enough and choice == "detect" else None
    step = Step("keep a feature", parameters={"features": choice}, remark=remark, guess=guess)
    doubts = levelled.doubts
    if choice == "beside":
        sides = " x ".join(map(str, beside.shape))
        doubts += (
            f"{levelled.source}: the map beside the feature has {sides} points, too few to judge "
            f"({FEWEST_POINTS[2]} a side): map a larger part, or give features: keep",
        )
    if (entry.get("contact") or 0.0) > max(levelled.size):
        doubts += (
            f"{levelled.source}: {feature}. A contact larger than the map may hold more of these, "
            "or none: give features: beside for the surface elsewhere, or leave contact out",
        )
    processing = (*levelled.processing, step)
    return replace(levelled, processing=processing, feature=feature, doubts=doubts)


def _guess_replica(heights: Topography | Profile, entry: Mapping[str, Any]) -> Guess | None:
    """Guess that skewed heights of a file named like a replica are those of the surface."""
    texts = [Path(entry.get("file") or "").name, *(entry.get(key) or "" for key in _ABOUT)]
    if entry["invert"] is not None or not (named := _REPLICA.search(" | ".join(texts))):
        return None
    skewness, _ = measure_shape(heights.heights)
    return guess_side(named[0], skewness) if abs(skewness) > LEAST_SKEWNESS else None


def _doubt_missing(heights: Topography | Profile, most: float) -> Topography | Profile:
    """Add a doubt to heights of which more than the share `most` is missing."""
    if heights.missing_fraction <= most:
        return heights
    doubt = (
        f"{100 * heights.missing_fraction:.2g} % of the points of {heights.source} are missing or "
        f"not used, more than {100 * most:.2g} % (max_missing): cut them off with missing: crop, "
        "measure again or raise max_missing"
    )
    return replace(heights, doubts=(*heights.doubts, doubt))
