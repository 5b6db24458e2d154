"""Entries of real surfaces: what files, the command and Python may say of them."""

import math
import re
from pathlib import Path
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import (
    AfterValidator,
    BeforeValidator,
    Field,
    PlainValidator,
    ValidationInfo,
    WithJsonSchema,
    model_validator,
)

from stickiness import plausibility
from stickiness.entries import fields as f
from stickiness.entries.errors import EntryError
from stickiness.entries.fields import Section, needed, optional
from stickiness.measured import readers, spectrum_table, texture
from stickiness.measured.levelling import MAX_MISSING
from stickiness.spectrum import kinds
from stickiness.units import Quantity, si_of_unit


def _as_list(value: Any) -> list[Any]:
    """Return a value, a list of values or None as a list."""
    if value is None:
        return []
    return value if isinstance(value, list) else [value]


def _check_order(section: Section, key: str) -> None:
    values = _as_list(getattr(section, key))
    if values != sorted(values):
        raise EntryError(key, values, "must be [low, high]")


def _read_prefactor(value: Any, info: ValidationInfo) -> float:
    """Read C0, whose unit depends on the Hurst exponent."""
    if "hurst" not in info.data:  # which is wrong, and told of
        return 0.0
    return f.read_quantity(value, info, f"m^{2 - 2 * info.data['hurst']:g}")


Prefactor = Annotated[
    float, PlainValidator(_read_prefactor), f.KEPT, WithJsonSchema({"type": "string"})
]


class SurfaceEntry(f.Labelled):
    """What entries of surfaces have in common."""

    unstated: ClassVar[dict[str, str]] = {"label": "the surface", "source": "not stated"}


class SelfAffineEntry(SurfaceEntry, f.Direction):
    """A surface of `kind: self_affine`."""

    one_of = (("longest_wavelength", "q0"), ("shortest_wavelength", "q1"), ("h_rms", "C0"))

    kind: Literal["self_affine"] = needed("parameters of a spectrum")
    hurst: f.Hurst
    longest_wavelength: f.Maybe[f.Length] = optional('longest wavelength, e.g. "6 mm"; or give q0')
    shortest_wavelength: f.Maybe[f.Length] = optional(
        'shortest wavelength, e.g. "1 um"; or give q1'
    )
    q0: f.Maybe[f.WaveNumber] = optional(
        'lowest wave number, 2 pi over the longest wavelength, e.g. "1e3 1/m"'
    )
    q1: f.Maybe[f.WaveNumber] = optional(
        'highest wave number, 2 pi over the shortest wavelength, e.g. "1e9 1/m"'
    )
    rolloff_wavelength: f.Maybe[f.Length] = optional("wavelength above which the spectrum is flat")
    h_rms: f.Maybe[f.OneOrTwo[f.Length]] = optional(
        'rms height or its range, e.g. ["0.5 um", "2 um"]'
    )
    C0: f.Maybe[f.OneOrTwo[Prefactor]] = optional(
        'prefactor of C0 q^(-2(H+1)) or its range, e.g. "1e-3 m^0.4"'
    )

    @model_validator(mode="after")
    def check_wavelengths(self) -> Self:
        """Check the order of the wavelengths."""
        longest = self.longest_wavelength or 2 * math.pi / self.q0
        shortest = self.shortest_wavelength or 2 * math.pi / self.q1
        if not shortest < longest:
            key = "q1" if self.shortest_wavelength is None else "shortest_wavelength"
            text = f"the shortest wavelength must be below the longest, {longest:g} m"
            raise EntryError(key, getattr(self, key), text)
        rolloff = self.rolloff_wavelength
        if rolloff is not None and not shortest < rolloff < longest:
            text = f"must be in {shortest:g} … {longest:g} m"
            raise EntryError("rolloff_wavelength", rolloff, text)
        return self

    @model_validator(mode="after")
    def check_heights(self) -> Self:
        """Check the order of both ends, and that the rough end is possible."""
        key = "h_rms" if self.C0 is None else "C0"
        _check_order(self, key)
        roughest = _as_list(getattr(self, key))[-1]
        rough = kinds.SelfAffine(
            hurst=self.hurst,
            q0=self.q0 or 2 * math.pi / self.longest_wavelength,
            q1=self.q1 or 2 * math.pi / self.shortest_wavelength,
            q_rolloff=self.rolloff_wavelength and 2 * math.pi / self.rolloff_wavelength,
            h_rms=float(roughest) if key == "h_rms" else None,
            C0=float(roughest) if key == "C0" else None,
        )
        if rough.h_rms < plausibility.PLAUSIBLE["h_rms"].least:
            raise EntryError(key, roughest, _tell_flat(rough.h_rms))
        if rough.rms_slope > plausibility.LARGEST_SLOPE:
            text = (
                f"means an rms slope of {rough.rms_slope:.3g}, above "
                f"{plausibility.LARGEST_SLOPE:g}, which no surface has; correct it, its unit or "
                "the wavelengths"
            )
            raise EntryError(key, roughest, text)
        return self


class SpectrumEntry(SurfaceEntry):
    """A surface of `kind: spectrum`, by a table of its isotropic spectrum C(q)."""

    kind: Literal["spectrum"] = needed("a table of a spectrum")
    file: f.Text = needed(
        "text or CSV with columns named with units: wave number (2 pi/wavelength), spatial "
        "frequency (1/wavelength) or wavelength, and PSD"
    )
    convention: Literal["variance", "fourier", "radial"] = needed(
        "what the table holds, by h_rms^2. variance: 2 pi int q C dq; fourier: int q C dq/(2 pi), "
        "as of contact.engineering; radial: int C dq, as of Gwyddion"
    )

    @model_validator(mode="after")
    def check_file(self, info: ValidationInfo) -> Self:
        """Check that the file holds a spectrum, unless another workflow makes it."""
        if (info.context or {}).get("made") and not Path(self.file).is_file():
            return self
        try:
            spectrum_table.read_spectrum(self.file, self.convention)
        except ValueError as error:
            raise EntryError("file", self.file, str(error)) from None
        return self


class SurfaceTextureEntry(SurfaceEntry):
    """A surface of `kind: surface_texture`, by the parameters of profiles on drawings.

    The heights are assumed to be Gaussian and isotropic, with Hurst exponents from 0.6 to 1.
    """

    one_of = (("Ra", "Rq"),)

    kind: Literal["surface_texture"] = needed("parameters of profiles (ISO 21920, ISO 4287)")
    Ra: f.Maybe[f.OneOrTwo[f.Length]] = optional('mean deviation or its range, e.g. "0.8 um"')
    Rq: f.Maybe[f.OneOrTwo[f.Length]] = optional("rms deviation or its range, instead of Ra")
    Rz: f.Maybe[f.Length] = optional("maximum height, to check that heights can be Gaussian")
    RSm: f.Maybe[f.OneOrTwo[f.Length]] = optional(
        "mean spacing of profile elements; default 0.04 to 0.5 times lambda_c"
    )
    lambda_c: f.Maybe[f.Length] = optional("cut-off of the profile filter; default by ISO 4288")
    shortest_wavelength: f.Maybe[f.Length] = optional("shortest wavelength; default 1 nm")

    @model_validator(mode="after")
    def check_parameters(self) -> Self:
        """Check that a surface with Gaussian heights can have all parameters."""
        self.shortest_wavelength = self.shortest_wavelength or Quantity.read("1 nm", "m")
        for key in ("Ra", "Rq", "RSm"):
            _check_order(self, key)
        widths = _as_list(self.RSm)
        if any(width >= (self.lambda_c or 8e-3) for width in widths):
            raise EntryError("RSm", self.RSm, "must be below lambda_c, at most 8 mm")
        rq = _as_list(self.Rq) or [texture.RQ_OVER_RA * ra for ra in _as_list(self.Ra)]
        if rq[-1] < plausibility.PLAUSIBLE["h_rms"].least:
            key = "Ra" if self.Rq is None else "Rq"
            raise EntryError(key, getattr(self, key), _tell_flat(rq[-1]))
        if widths and 2 * math.pi * rq[0] > plausibility.LARGEST_SLOPE * max(widths):
            text = "is too narrow for such heights: no surface is as steep"
            raise EntryError("RSm", self.RSm, text)
        if widths and self.shortest_wavelength >= min(widths) / 2:
            text = "must be below half of RSm"
            raise EntryError("shortest_wavelength", self.shortest_wavelength, text)
        low, high = texture.RZ_OVER_RQ
        if self.Rz is not None and not low * rq[0] <= self.Rz <= high * rq[-1]:
            text = (
                f"is outside {low * rq[0]:.2g} m to {high * rq[-1]:.2g} m of Gaussian heights, "
                "which are assumed: measure the surface, or leave Rz out"
            )
            raise EntryError("Rz", self.Rz, text)
        return self


LEAST_WAVE = 1e-10  #: [m]; no wave of a surface is shorter than an atom


def _tell_flat(h_rms: float) -> str:
    least = plausibility.PLAUSIBLE["h_rms"].least
    return f"means an rms height of {h_rms:.2g} m, below {least:g} m: atoms are larger; correct it"


def _check_length_unit(unit: str) -> str:
    si_of_unit(unit, "m")
    return unit


LengthUnit = Annotated[str, AfterValidator(_check_length_unit)]


def _split_sides(value: Any) -> Any:
    """Return two sides in one text as a list; a unit behind the second alone is that of both."""
    if not isinstance(value, str):
        return value
    if both := re.fullmatch(r"([\d.]+)\s*(?:[x×*]|by)\s*([\d.]+)\s*([^\W\d_].*)", value):
        return [f"{side} {both[3]}" for side in both.group(1, 2)]
    # An x before 10^5 is that of a number.
    sides = re.split(r"\s*(?:[x×*]|by)\s*(?=\d)(?!10\s*(?:\^|\*\*|[⁻⁰¹²³⁴-⁹]))", value)
    return sides if len(sides) == 2 else value


Sides = Annotated[f.OneOrTwo[f.Length], BeforeValidator(_split_sides)]


class MeasuredFile(Section):
    """A measured file, and what it does not tell itself."""

    file: f.Text = needed("file of any instrument, .nc, .npz, .npy, .mat, .h5 or text")
    format: f.Maybe[f.Text] = optional(
        "netcdf, numpy, text, instrument or a format of SurfaceTopography, if the name misleads"
    )
    channel: f.Maybe[str | f.Index] = optional(
        "channel of an instrument's file, by name or counted from 0"
    )
    variable: f.Maybe[str] = optional("NetCDF variable or npz key")
    length: f.Maybe[Sides] = optional(
        'side, e.g. "2 mm", or sides along x and y, e.g. "2 mm x 1 mm", of what was measured'
    )
    pixel_size: f.Maybe[Sides] = optional('grid step, e.g. "0.5 um", instead of length')
    height_unit: f.Maybe[LengthUnit] = optional('unit of the heights, e.g. "nm"')
    height_factor: Annotated[float, Field(gt=0)] = optional(
        "what all heights are multiplied by, to correct them or to ask about higher ones", 1.0
    )
    position_unit: f.Maybe[LengthUnit] = optional(
        'unit of positions on a line, or of the steps of a map, e.g. "um"'
    )
    missing_value: f.Maybe[float] = optional("number that marks missing points besides NaN")


class Analysis(Section):
    """How measured heights are analysed."""

    missing: Literal["fill", "crop", "refuse"] = optional(
        "interpolate missing points, cut to the largest rectangle without any, or stop", "fill"
    )
    max_missing: Annotated[float, Field(ge=0, lt=1)] = optional(
        "largest share that is filled", MAX_MISSING
    )
    missing_rim: Literal["detect"] | f.Index = optional(
        "points dropped around missing ones; default detect: as far as they stand out", "detect"
    )
    spikes: Literal["mask", "keep"] = optional(
        "mask (default) points far off their neighbours", "mask"
    )
    scan: Literal["detect", "mend", "align", "keep"] = optional(
        "rows at random heights, jumps, creep, drift, bow, scars and hum of a scan; default "
        "detect: mend what is found, and ask where it decides and may belong to the surface; mend: "
        "do not ask; align: set every row to the median 0, too",
        "detect",
    )
    features: Literal["detect", "keep", "beside"] = optional(
        "a step, scratch or particle that holds most of the energy; default detect: ask where it "
        "decides; keep: judge contacts with it; beside: judge the largest part beside it",
        "detect",
    )
    invert: f.Maybe[bool] = optional(
        "true: turn the heights upside down, where a replica was measured in place of the surface; "
        "false: do not ask, where a name says replica"
    )
    detrend: Literal["detect", "mean", "plane", "quadratic"] = optional(
        "what to subtract from the heights; default detect: a plane, or the form of a lens where "
        "that is nearly all of the heights, or the mean of heights that a file calls periodic",
        "detect",
    )
    window: Literal["detect", "none", "hann", "hann_radial"] = optional(
        "taper; default detect: none if the file says that the heights are periodic, else hann",
        "detect",
    )
    fit_from: f.Maybe[f.Length] = optional(
        "longest wavelength of the fit; default a quarter of the side"
    )
    fit_to: f.Maybe[f.Length] = optional(
        "shortest wavelength of the fit; overrides resolution, tip_radius and cutoff"
    )
    resolution: f.Maybe[f.Length] = optional("shortest wavelength that the instrument resolves")
    tip_radius: f.Maybe[f.Length] = optional('radius of a scanning tip, e.g. "10 nm"')
    cutoff: Literal["detect", "ignore"] = optional(
        "blur and noise in the spectrum; default detect", "detect"
    )


class Reading(Analysis, MeasuredFile):
    """How a measured file is read and analysed."""

    @model_validator(mode="after")
    def check_file(self, info: ValidationInfo) -> Self:
        """Check what is known of a file before it is read.

        The context says with `made` that another workflow makes the file, which may be missing, and
        with `unread` that reading it will tell.
        """
        context = info.context or {}
        if not self.file or context.get("unread"):
            return self
        path = Path(self.file)
        if "made" in context and re.search(r"\{\s*\w", self.file):
            text = "a workflow takes braces in names for wildcards; rename the file"
            raise EntryError("file", self.file, text)
        if not path.is_file():
            if context.get("made"):
                return self
            problem = "a folder" if path.is_dir() else "no such file"
            raise EntryError(
                "file", self.file, f"{problem}; give a path from the working directory"
            )
        if advice := readers.find_packing(self.file):
            raise EntryError("file", self.file, advice)
        self._check_keys_of_format()
        return self

    def _check_keys_of_format(self) -> None:
        """Check keys that belong to other keys, or to files of other formats."""
        if self.length is not None and self.pixel_size is not None:
            raise EntryError("pixel_size", self.pixel_size, "give length or pixel_size, not both")
        if self.missing != "fill" and "max_missing" in self.model_fields_set:
            text = (
                f"is the share that missing: fill fills; leave it out with missing: {self.missing}"
            )
            raise EntryError("max_missing", self.max_missing, text)
        kind = readers.format_of(self.file, self.format)
        if misfit := readers.find_misfit(kind, channel=self.channel, variable=self.variable):
            raise EntryError(misfit[0], getattr(self, misfit[0]), misfit[1])
        if self.fit_from and self.fit_to and not self.fit_to < self.fit_from:
            raise EntryError("fit_to", self.fit_to, f"must be below fit_from = {self.fit_from!r}")


class Use(Section):
    """How what was measured is used."""

    plausibility: Literal["check", "ignore"] = optional(
        "ignore: a verdict on implausible data, too", "check"
    )
    extend_to: f.Maybe[f.Length] = optional(
        "wavelength to which the fit is extended beyond the instrument"
    )
    contact: f.Maybe[f.Length] = optional(
        'side of the contact, e.g. "10 mm", if it is larger than the scan'
    )

    @model_validator(mode="after")
    def check_extension(self) -> Self:
        """Check that no wave is shorter than an atom."""
        if self.extend_to is not None and self.extend_to < LEAST_WAVE:
            text = f"is shorter than {LEAST_WAVE:g} m, an atom: correct it"
            raise EntryError("extend_to", self.extend_to, text)
        return self


class HeightsEntry(Use, Analysis):
    """Measured heights in an array."""


class MeasuredEntry(Use, Reading, SurfaceEntry):
    """A surface of `kind: measured`.

    Keys of reading apply to every measurement that does not give its own.
    """

    one_of = (("file", "measurements"),)

    kind: Literal["measured"] = needed("a measurement")
    file: f.Text = optional("as in a measurement")
    measurements: f.Maybe[f.AtLeastTwo[Reading]] = optional(
        "several files, averaged into one spectrum"
    )

    @model_validator(mode="before")
    @classmethod
    def share_keys(cls, entry: Any) -> Any:
        """Give the keys of reading to every measurement that does not have its own."""
        if not isinstance(entry, dict) or not isinstance(entry.get("measurements"), list):
            return entry
        shared = {key: entry[key] for key in Reading.model_fields if key in entry}
        measurements = [
            shared | measurement if isinstance(measurement, dict) else measurement
            for measurement in entry["measurements"]
        ]
        return entry | {"measurements": measurements}

    @model_validator(mode="after")
    def check_sides(self, info: ValidationInfo) -> Self:
        """Check the sides of what was measured, which are mistyped most often."""
        if self.plausibility == "ignore" or (info.context or {}).get("unread"):
            return self
        measurements: list[Reading] = self.measurements or [self]
        for index, measurement in enumerate(measurements):
            key = f"measurements[{index}].length" if self.measurements else "length"
            for side in _as_list(measurement.length):
                if side > plausibility.LONGEST_SIDE:
                    raise EntryError(key, side, plausibility.REFUSED_SIDE)
                if side < plausibility.SHORTEST_SIDE:
                    text = (
                        f"is shorter than {plausibility.SHORTEST_SIDE:g} m, a few atoms; correct "
                        "it, or give plausibility: ignore if it is so"
                    )
                    raise EntryError(key, side, text)
        return self


AnySurface = Annotated[
    MeasuredEntry | SurfaceTextureEntry | SelfAffineEntry | SpectrumEntry,
    Field(discriminator="kind"),
]


class Surfaces(Section):
    """The file of real surfaces."""

    surfaces: f.Names[AnySurface] = needed("real surfaces by name")
