"""Measured surfaces as configured: levelled heights, and the spectrum of one measurement."""

from dataclasses import replace
from inspect import signature

from common.config.entries import measurements
from common.formatting import percent
from stickiness.measured import instrument_spectrum, topography
from stickiness.measured.levelling import MAX_MISSING
from stickiness.units import si

LENGTHS = ("fit_from", "fit_to", "resolution", "tip_radius")  # of `Limits`
ALL_MISSING = 1 - 1e-9  # a share that every file is below
FEWEST_POINTS, FEWEST_ON_LINE = 64, 256  # about so many are needed for a fit
# Of a measurement in the configuration, what `topography.read` takes.
READ_KEYS = set(signature(topography.read).parameters) - {"path"}


def read_levelled(measurement):
    """Levelled heights of a measurement, as configured."""
    if measurement["file"] == "builtin:jacksboro":
        heights = topography.jacksboro()
    else:
        keys = {key: measurement[key] for key in READ_KEYS if key in measurement}
        most, keys["max_missing"] = keys.get("max_missing", MAX_MISSING), ALL_MISSING
        heights = topography.read(measurement["file"], **keys)
        if heights.missing_fraction > most:
            share = f"{percent(heights.missing_fraction)} of the points of {heights.source}"
            doubt = f"{share} are missing or not used, more than {percent(most)} (max_missing): "
            doubt += "cut them off with missing: crop, measure again or raise max_missing"
            heights = replace(heights, doubts=(*heights.doubts, doubt))
    return heights.detrended(measurement.get("detrend", "plane"))


def find_cutoff(entry, index, heights, finest):
    """Cutoff [1/m] of a measurement with these levelled heights; `finest` is the surface's."""
    listed = measurements(entry)
    if len(listed) == 1:
        return finest
    return min(finest, find_spectrum(heights, listed[index][1])[0].cutoff.q)


def find_spectrum(heights, measurement):
    """Spectrum of one measurement, and why its fit is none to rely on; empty if it is."""
    lengths = {name: si(measurement[name], "m") for name in LENGTHS if name in measurement}
    detect = measurement.get("cutoff", "detect") == "detect"
    limits = instrument_spectrum.Limits(**lengths, detect=detect)
    window, shape = measurement.get("window", "hann"), heights.heights.shape
    try:
        return instrument_spectrum.analyse(heights, window, limits), ""
    except ValueError as error:
        points = " x ".join(map(str, shape))
        doubt = f"{heights.source}: no fit to the spectrum of {points} points: {error}"
        if min(shape) < (FEWEST_ON_LINE, FEWEST_POINTS)[len(shape) - 1]:
            doubt += (
                f"; a map needs about {FEWEST_POINTS} points along its shorter side, a profile "
                f"{FEWEST_ON_LINE}"
            )
    try:
        return instrument_spectrum.analyse(heights, window, demand=False), doubt
    except ValueError:
        raise ValueError(doubt) from None
