"""Models of config/surfaces.yaml."""

import math
from pathlib import Path
from typing import Annotated, Literal

from pydantic import AfterValidator

from common.config import fields as f
from common.config.entries import measurements
from common.config.fields import Section, needed, optional
from common.config.materials import ElasticPair
from stickiness import plausibility
from stickiness.measured import readers, texture
from stickiness.spectrum import kinds

_BUILTIN = "builtin:jacksboro"


class Direction(Section):
    """Direction of a rough surface."""

    anisotropy: f.number(ge=1, le=100) = optional("long over short correlation length; default 1")
    angle: f.number(ge=-180, le=180) = optional("of the long correlation length from x, in degrees")


class SelfAffine(f.Labelled, Direction):
    """A surface of `kind: self_affine`."""

    one_of = (("longest_wavelength", "q0"), ("shortest_wavelength", "q1"), ("h_rms", "C0"))

    kind: Literal["self_affine", "measured", "surface_texture"] = needed("parameters of a spectrum")
    hurst: f.Hurst
    longest_wavelength: f.Length = optional('longest wavelength, e.g. "6 mm"; or give q0')
    shortest_wavelength: f.Length = optional('shortest wavelength, e.g. "1 um"; or give q1')
    q0: f.WaveNumber = optional('lowest wave number, e.g. "1e3 1/m"')
    q1: f.WaveNumber = optional('highest wave number, e.g. "1e9 1/m"')
    rolloff_wavelength: f.Length = optional("wavelength above which the spectrum is flat")
    h_rms: f.one_or_two(f.Length) = optional('rms height or its range, e.g. ["0.5 um", "2 um"]')
    C0: f.one_or_two(str) = optional('prefactor of C0 q^(-2(H+1)) or its range, e.g. "1e-3 m^0.4"')

    def _problems(self, context):
        longest = self.longest_wavelength or 2 * math.pi / self.q0
        shortest = self.shortest_wavelength or 2 * math.pi / self.q1
        if not shortest < longest:
            yield f"shortest_wavelength = {shortest:g} m must be below the longest, {longest:g} m"
        rolloff = self.rolloff_wavelength
        if rolloff is not None and not shortest < rolloff < longest:
            yield f"rolloff_wavelength = {rolloff:g} m must be in {shortest:g} … {longest:g} m"
        try:
            prefactors = [f.Quantity(one, f"m^{2 - 2 * self.hurst:g}") for one in _listed(self.C0)]
        except ValueError as error:
            yield f"C0 = {error}"
        for key, values in (("C0", prefactors), ("h_rms", _listed(self.h_rms))):
            if not all(value > 0 for value in values):
                yield f"{key} = {getattr(self, key)!r} must be positive"
            if values != sorted(values):
                yield f"{key} = {values!r} must be [low, high]"
            if values:
                band = {"q0": 2 * math.pi / longest, "q1": 2 * math.pi / shortest}
                band["q_rolloff"] = rolloff and 2 * math.pi / rolloff
                rough = kinds.SelfAffine(hurst=self.hurst, **band, **{key: float(values[-1])})
                slope = rough.rms_slope
                if slope > plausibility.LARGEST_SLOPE:
                    yield (
                        f"{key} = {values[-1]!r} means an rms slope of {slope:.3g}, above "
                        f"{plausibility.LARGEST_SLOPE:g}, which no surface has; correct it, its "
                        "unit or the wavelengths"
                    )


class SurfaceTexture(f.Labelled):
    """A surface of `kind: surface_texture`, by the parameters of profiles on drawings.

    The heights are assumed to be Gaussian and isotropic, with Hurst exponents from 0.6 to 1.
    """

    one_of = (("Ra", "Rq"),)

    kind: Literal["surface_texture"] = needed("parameters of profiles (ISO 21920, ISO 4287)")
    Ra: f.one_or_two(f.Length) = optional('mean deviation or its range, e.g. "0.8 um"')
    Rq: f.one_or_two(f.Length) = optional("rms deviation or its range, instead of Ra")
    Rz: f.Length = optional("maximum height, to check that heights can be Gaussian")
    RSm: f.one_or_two(f.Length) = optional(
        "mean spacing of profile elements; default 0.04 to 0.5 times lambda_c"
    )
    lambda_c: f.Length = optional("cut-off of the profile filter; default by ISO 4288")
    shortest_wavelength: f.Length = optional("shortest wavelength; default 1 nm")

    def _problems(self, context):
        for key in ("Ra", "Rq", "RSm"):
            given = _listed(getattr(self, key))
            if given != sorted(given):
                yield f"{key} = {given!r} must be [low, high]"
        if any(wide >= (self.lambda_c or 8e-3) for wide in _listed(self.RSm)):
            yield f"RSm = {self.RSm!r} must be below lambda_c, at most 8 mm"
        rq = _listed(self.Rq) or [texture.RQ_OVER_RA * ra for ra in _listed(self.Ra)]
        widest = max(_listed(self.RSm), default=math.inf)
        if 2 * math.pi * rq[0] > plausibility.LARGEST_SLOPE * widest:
            yield f"RSm = {self.RSm!r} is too narrow for such heights: no surface is as steep"
        if (self.shortest_wavelength or 0) >= min(_listed(self.RSm), default=math.inf) / 2:
            yield f"shortest_wavelength = {self.shortest_wavelength!r} must be below half of RSm"
        low, high = texture.RZ_OVER_RQ
        if self.Rz is not None and not low * rq[0] <= self.Rz <= high * rq[-1]:
            yield (
                f"Rz = {self.Rz!r} is outside {low * rq[0]:.2g} m to {high * rq[-1]:.2g} m of "
                "Gaussian heights, which are assumed: measure the surface, or leave Rz out"
            )


# Unit of a length, here as a length.
LengthUnit = Annotated[str, AfterValidator(lambda unit: f.Quantity(f"1 {unit}", "m"))]


class Reading(Section):
    """How a measured file is read and analysed."""

    file: f.Text = needed('file of any instrument, .nc, .npz, .npy, text or "builtin:jacksboro"')
    format: f.Text = optional(
        "netcdf, numpy, text, instrument or a format of SurfaceTopography, if the name misleads"
    )
    channel: f.by_type(str, str, f.Index) = optional("channel of an instrument's file")
    variable: str = optional("NetCDF variable or npz key")
    length: f.one_or_two(f.Length) = optional("side, or sides along x and y, of what was measured")
    pixel_size: f.one_or_two(f.Length) = optional("grid step, instead of length")
    height_unit: LengthUnit = optional('unit of the heights, e.g. "nm"')
    position_unit: LengthUnit = optional('unit of the positions of a line profile, e.g. "um"')
    missing_value: float = optional("number that marks missing points besides NaN")
    missing: Literal["fill", "crop", "refuse"] = optional(
        "interpolate missing points, cut to the largest rectangle without any, or stop"
    )
    max_missing: f.number(ge=0, lt=1) = optional("largest share that is filled")
    missing_rim: f.by_type(str, Literal["detect"], f.Index) = optional(
        "points dropped around missing ones; default detect: as far as they stand out"
    )
    spikes: Literal["mask", "keep"] = optional("mask (default) points far off their neighbours")
    detrend: Literal["mean", "plane", "quadratic"] = optional("what to subtract from the heights")
    window: Literal["none", "hann", "hann_radial"] = optional("taper; none for periodic heights")
    fit_from: f.Length = optional("longest wavelength of the fit; default a quarter of the side")
    fit_to: f.Length = optional("shortest wavelength of the fit; overrides the next three")
    resolution: f.Length = optional("shortest wavelength that the instrument resolves")
    tip_radius: f.Length = optional('radius of a scanning tip, e.g. "10 nm"')
    cutoff: Literal["detect", "ignore"] = optional("blur and noise in the spectrum; default detect")


class Contact(Section):
    """Contact of the measured heights themselves.

    A job asks for 2 GB of memory at 2048 points along a side, 7 GB at 4096 and 25 GB at 8192. A
    load without adhesion takes about 5 s of processor at 2048 and 30 s at 4096; with adhesion
    whose edges the grid does not resolve, about 3 min at 2048 and, extrapolated, 20 min at 4096.
    """

    pressures: f.Several[f.by_type(str, f.Pressure, f.Positive)] = needed(
        'mean pressures over E* q0 h_rms; or with a unit, e.g. "0.25 MPa", beside `adhesion`'
    )
    shortest_wavelength: f.Length = optional("shortest wavelength to keep")
    measurement: f.Index = optional("which of `measurements`, counted from 0; default the first")
    periodic: bool = optional("true: the heights are periodic and pressed on the grid of the file")
    most_points: f.whole(ge=64, le=8192) = optional("largest grid along a side; default 2048")
    adhesion: ElasticPair = optional("contact on approach with exponential attraction as well")

    def _problems(self, context):
        with_unit = [isinstance(pressure, f.Quantity) for pressure in self.pressures]
        for index, pressure in enumerate(self.pressures if any(with_unit) else []):
            key = f"pressures[{index}] = {pressure!r}"
            if not with_unit[index]:
                yield f"{key} has no unit, while others have; give all of them one kind"
            elif self.adhesion is None:
                remedy = "or give it over E* q0 h_rms, without a unit"
                yield f"{key} needs bem.adhesion, which gives the modulus; {remedy}"


class Measured(f.Labelled, Reading):
    """A surface of `kind: measured`.

    Keys of reading apply to every measurement that does not give its own.
    """

    one_of = (("file", "measurements"),)

    kind: Literal["measured"] = needed("a measurement")
    file: f.Text = optional("as in a measurement")
    measurements: f.AtLeastTwo[Reading] = optional("several files, averaged into one spectrum")
    plausibility: Literal["check", "ignore"] = optional(
        "ignore: a verdict on implausible data, too"
    )
    extend_to: f.Length = optional("wavelength to which the fit is extended beyond the instrument")
    bem: Contact = optional("contact of the measured heights themselves, made periodic")

    def _problems(self, context):
        entries = measurements(self.model_dump(exclude_unset=True, warnings=False))
        for prefix, entry in entries:
            for problem in _file_problems(entry, context["made"]):
                yield f"{prefix}{problem}"
        if self.bem is None:
            return
        index = self.bem.measurement or 0
        if index >= len(entries):
            yield f"bem.measurement = {index} is counted from 0 and must be below {len(entries)}"
            return
        pressed = entries[index][1]
        breaks = "would break the period that bem.periodic states; give"
        if self.bem.periodic and pressed.get("detrend", "mean") != "mean":
            yield f"detrend = {pressed['detrend']!r} {breaks} detrend: mean"
        if self.bem.periodic and pressed.get("missing") == "crop":
            yield f"missing = 'crop' {breaks} missing: fill or refuse"


def _is_kind(kind):
    return lambda given: isinstance(given, dict) and given.get("kind") == kind


Surface = f.choose(
    _is_kind("measured"),
    Measured,
    f.choose(_is_kind("surface_texture"), SurfaceTexture, SelfAffine),
)


class Surfaces(Section):
    """The file of real surfaces."""

    surfaces: f.Names[Surface] = needed("real surfaces by name")


def _file_problems(measurement, made):
    """Yield what is wrong with a measurement, as far as is known before its file is read."""
    file = measurement["file"]
    if file.startswith("builtin:"):
        if file != _BUILTIN:
            yield f"file = {file!r} is unknown; built in: {_BUILTIN}"
        return
    if not Path(file).is_file():
        if not made:
            found = "a folder" if Path(file).is_dir() else "no such file"
            yield f"file = {file!r}: {found}; give a path from the working directory"
        return
    if advice := readers.find_packing(file):
        yield f"file = {file!r}: {advice}"
        return
    sides = _listed(measurement.get("length"))
    for side in [] if measurement.get("plausibility") == "ignore" else sides:
        if side > plausibility.LONGEST_SIDE:
            yield f"length = {side!r} {plausibility.REFUSED_SIDE}"
        if side < plausibility.SHORTEST_SIDE:
            yield (
                f"length = {side!r} is shorter than {plausibility.SHORTEST_SIDE:g} m, a few atoms; "
                "correct it, or give plausibility: ignore if it is so"
            )
    if sides and "pixel_size" in measurement:
        yield f"pixel_size = {measurement['pixel_size']!r}: give length or pixel_size, not both"
    if measurement.get("missing", "fill") != "fill" and "max_missing" in measurement:
        yield (
            f"max_missing = {measurement['max_missing']!r} is the share that missing: fill fills; "
            f"leave it out with missing: {measurement['missing']}"
        )
    kind = readers.format_of(file, measurement.get("format"))
    if kind != readers.INSTRUMENT and "channel" in measurement:
        yield f"channel = {measurement['channel']!r}: a {kind} file has no channels; leave it out"
    if kind not in ("netcdf", "numpy") and "variable" in measurement:
        yield f"variable = {measurement['variable']!r} is for NetCDF and npz, this file is neither"
    fit_from, fit_to = (measurement.get(key) for key in ("fit_from", "fit_to"))
    if fit_from and fit_to and not fit_to < fit_from:
        yield f"fit_to = {fit_to!r} must be below fit_from = {fit_from!r}"


def _listed(given):
    return given if isinstance(given, list) else [] if given is None else [given]
