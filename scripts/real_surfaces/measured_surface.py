"""Measured surfaces: from files to a dataset of spectrum, fit and moments with their errors."""

import logging
from dataclasses import fields
from inspect import signature

import numpy as np
import xarray as xr

from common.config.entries import measurements
from common.formatting import amount, percent
from stickiness.measured import (
    instrument_spectrum,
    plausibility,
    self_affine_fit,
    spectrum_draws,
    stitching,
    topography,
)
from stickiness.spectrum.direction import find_ratio
from stickiness.units import si

ENDS = ["smooth", "rough"]
END_QUANTILES = (0.16, 0.84)  # of the draws: one standard error
DRAWS, SEED = 200, 1
REFERENCE_HURST = 0.8  # of the paper's lines C0 = 1e-3 and 1e-5 m^0.4
POINTS_PER_DECADE = 10
FEWEST_POINTS, FEWEST_ON_LINE = 64, 256  # about so many are needed for a fit
# Spikes beyond which a remark tells what they change: share of the points, relative rms height.
MANY_SPIKES, LARGE_CHANGE = 1e-3, 0.1
PICTURE_POINTS = 400  # along a side of the picture of the heights
# Of a measurement in the configuration, what `topography.read` takes.
READ_KEYS = set(signature(topography.read).parameters) - {"path"}


def analyse(asked):
    """Dataset of a measured surface, as configured."""
    entries = [one for _, one in measurements(asked)]
    heights = [read_levelled(one) for one in entries]
    spectra = [find_spectrum(h, one) for h, one in zip(heights, entries, strict=True)]
    stitched = stitching.stitch(spectra) if len(spectra) > 1 else None
    spectrum = stitched.spectrum if stitched else spectra[0]
    extend_to = 2 * np.pi / si(asked["extend_to"], "m") if "extend_to" in asked else None
    drawn = spectrum_draws.draw(spectrum, DRAWS, SEED, stitched=stitched, extend_to=extend_to)
    dataset = describe_spectrum(spectrum, extend_to)
    dataset = dataset.merge(describe_draws(drawn)).merge(picture_of(heights[0]))
    if stitched:
        dataset = dataset.merge(describe_stitching(stitched))
    remarks = self_affine_fit.remarks(spectrum.fit, np.nan_to_num(spectrum.anisotropy))
    as_read = [
        h.h_rms_as_read(one.get("detrend", "plane"))
        for h, one in zip(heights, entries, strict=True)
    ]
    remarks += remarks_on_files(heights) + remarks_on_spikes(heights, as_read)
    remarks += remarks_on_limits(spectrum, extend_to)
    remarks += remarks_on_stitching(stitched)
    doubts = [doubt for one in heights for doubt in one.doubts]
    doubts += plausibility.doubt_fit(spectrum.fit)
    if asked.get("plausibility", "check") == "ignore":
        remarks += [f"judged all the same (plausibility: ignore): {doubt}" for doubt in doubts]
        doubts = []
    for doubt in doubts:
        logging.warning("no verdict: %s", doubt)
    for remark in remarks:
        logging.info(remark)
    return dataset.assign(
        h_rms_measured=heights[0].h_rms,
        h_rms_as_read=as_read[0],
        missing_fraction=max(h.missing_fraction for h in heights),
        dropped_points=sum(h.dropped for h in heights),
        masked_spikes=sum(h.spikes for h in heights),
        cropped_fraction=max(getattr(h, "cropped", 0.0) for h in heights),
    ).assign_attrs(
        remarks="; ".join(remarks),
        cutoff=spectrum.cutoff.reason,
        files="; ".join(h.source for h in heights),
        not_judged="\n".join(doubts),
    )


def read_levelled(measurement):
    """Levelled heights of a measurement, as configured."""
    if measurement["file"] == "builtin:jacksboro":
        heights = topography.jacksboro()
    else:
        keys = {key: measurement[key] for key in READ_KEYS if key in measurement}
        heights = topography.read(measurement["file"], **keys)
    return heights.detrended(measurement.get("detrend", "plane"))


def find_cutoff(asked, index, heights, finest):
    """Cutoff [1/m] of one of a surface's measurements, whose levelled heights these are.

    `finest` is that of the surface, which is that of its finest measurement.
    """
    listed = measurements(asked)
    if len(listed) == 1:
        return finest
    return min(finest, find_spectrum(heights, listed[index][1]).cutoff.q)


def find_spectrum(heights, measurement):
    """Spectrum of one measurement; an error names the file and what helps."""
    try:
        return instrument_spectrum.analyse(
            heights, measurement.get("window", "hann"), limits_of(measurement)
        )
    except ValueError as error:
        points = " x ".join(map(str, heights.heights.shape))
        raise ValueError(
            f"{heights.source}: no fit to the spectrum of {points} points: {error}; a map needs "
            f"about {FEWEST_POINTS} points along its shorter side, a profile {FEWEST_ON_LINE}"
        ) from None


def limits_of(measurement):
    """Limits of the instrument, as configured."""
    names = [field.name for field in fields(instrument_spectrum.Limits) if field.name != "detect"]
    lengths = {name: si(measurement[name], "m") for name in names if name in measurement}
    detect = measurement.get("cutoff", "detect") == "detect"
    return instrument_spectrum.Limits(**lengths, detect=detect)


def describe_spectrum(spectrum, extend_to):
    """Spectrum, fit and the line at the paper's exponent; extrapolated by the fit if configured."""
    fit, rings = spectrum.fit, spectrum.rings
    line = fit.c0_at_hurst(REFERENCE_HURST)
    q, psd, error = rings.q, rings.psd, rings.standard_error
    psd = [psd, psd]
    top = spectrum.cutoff.q
    if extend_to is not None:
        inside = q <= top * (1 + 1e-9)
        count = int(np.ceil(np.log10(extend_to / top) * POINTS_PER_DECADE)) + 1
        more = np.geomspace(top, extend_to, count)[0 if q[inside][-1] < top * 0.99 else 1 :]
        q = np.append(q[inside], more)
        spread = log_error_of_fit(fit, more)
        psd = [np.append(rings.psd[inside], fit.psd(more) * np.exp(s * spread)) for s in (-1, 1)]
        error = np.append(error[inside], fit.psd(more) * spread)
    fitted = (q >= fit.q_min * (1 - 1e-9)) & (q <= fit.q_max * (1 + 1e-9))
    dataset = xr.Dataset(
        {
            "psd": (("end", "wave_number"), psd),
            "psd_standard_error": ("wave_number", error),
            "psd_fit": ("wave_number", fit.psd(q)),
            "fitted": ("wave_number", fitted.astype("i1")),
            "C0": ("end", fit.c0 * np.ones(2)),
            "C0_relative_error": fit.c0_se / fit.c0,
            "C0_reference": line.c0,
            "C0_reference_standard_error": line.c0_se,
            "C0_reference_upper": ("end", [line.upper, line.upper]),
            "hurst": fit.hurst,
            "hurst_standard_error": fit.hurst_se,
            "misfit": fit.misfit,
            "q0": fit.q_rolloff or spectrum.lowest,
            "q1": top if extend_to is None else extend_to,
            "q_cutoff": top,
            "cutoff_detected": int(spectrum.cutoff.detected),
        },
        coords={"end": ENDS, "wave_number": q},
    )
    if np.isfinite(spectrum.anisotropy):
        dataset["anisotropy"] = spectrum.anisotropy
        dataset["axis_ratio"] = find_ratio(spectrum.anisotropy, fit.hurst)
    if fit.q_rolloff is not None:
        dataset["q_rolloff"] = fit.q_rolloff
        dataset["q_rolloff_standard_error"] = fit.q_rolloff_se
    return dataset


def log_error_of_fit(fit, q):
    """Standard error of the fitted ln C at wave numbers beyond the plateau."""
    design = np.array([np.ones_like(q), -2 * np.log(q)])
    return np.sqrt(np.einsum("in,ij,jn->n", design, fit.log_covariance[:2, :2], design))


def describe_draws(drawn):
    """Both ends of every moment, and the draws themselves for what depends on several."""
    data = {name: ("end", drawn.quantiles(name, END_QUANTILES)) for name in drawn.moments}
    data |= {f"{name}_draws": ("draw", values) for name, values in drawn.moments.items()}
    data["q0_draws"] = "draw", drawn.q0
    return xr.Dataset(data, coords={"end": ENDS, "draw": np.arange(len(drawn.q0))})


def picture_of(heights):
    """Levelled heights, thinned to what a picture shows."""
    if heights.heights.ndim == 1:
        x = np.arange(len(heights.heights)) * heights.dx
        return xr.Dataset({"profile": ("x", heights.heights)}, coords={"x": x})
    thin = max(1, *(n // PICTURE_POINTS for n in heights.heights.shape))
    picture = heights.heights[::thin, ::thin]
    x, y = map(np.arange, picture.shape)
    x, y = x * thin * heights.dx, y * thin * heights.dy
    return xr.Dataset({"heights": (("x", "y"), picture.astype("f4"))}, coords={"x": x, "y": y})


def describe_stitching(stitched):
    """Spectrum of every measurement by itself, and their offsets."""
    data = {
        "psd_measurement": (("measurement", "wave_number_measured"), stitched.levels),
        "offset": ("measurement", stitched.offsets),
        "scatter": stitched.scatter,
    }
    number, q = np.arange(len(stitched.offsets)), stitched.spectrum.rings.q
    return xr.Dataset(data, coords={"measurement": number, "wave_number_measured": q})


def remarks_on_files(heights):
    """Remarks on what was missing."""
    found = []
    for one in heights:
        if one.spikes:
            found.append(
                f"points of {one.source} far off all their neighbours, spikes, which are not used: "
                f"{one.spikes} (spikes: keep uses them)"
            )
        if getattr(one, "cropped", 0):
            found.append(
                f"{percent(one.cropped)} of {one.source} cut off to leave no missing points"
            )
        if one.dropped:
            found.append(
                f"{one.dropped} points of {one.source} beside missing ones were measured and are "
                "not used (missing_rim)"
            )
        if one.missing > one.spikes:
            found.append(
                f"{percent(one.missing_fraction)} of the points of {one.source} were missing and "
                "are interpolated, smoother than the surface"
            )
        if one.heights.ndim == 1:
            found.append(f"{one.source} is a line profile: isotropy is assumed, not seen")
    return found


def remarks_on_spikes(heights, as_read):
    """Remarks on spikes that are many, or change the rms height; `as_read` is that with them."""
    found = []
    for one, before in zip(heights, as_read, strict=True):
        share, after = one.spikes / one.heights.size, one.h_rms
        if one.spikes and (share > MANY_SPIKES or abs(before - after) > LARGE_CHANGE * after):
            found.append(
                f"{share:.2g} of the points of {one.source} are spikes, and the rms height is "
                f"{amount(before, 'm')} with all points, {amount(after, 'm')} "
                "without those not used: if they are part of the surface, give spikes: keep"
            )
    return found


def remarks_on_limits(spectrum, extend_to):
    """Remarks on the ends of the spectrum."""
    found, fit = [], spectrum.fit
    if fit.q_rolloff is None:
        found.append(
            f"no roll-off was found below wavelengths of {wavelength(fit.q_min)}, and longer "
            "ones cannot show one: q0 is that of the scan, not of the surface"
        )
    shorter = f"waves shorter than {wavelength(spectrum.cutoff.q)} ({spectrum.cutoff.reason})"
    if extend_to is None:
        return [*found, f"{shorter} are not part of slope, curvature and a_V"]
    end = wavelength(extend_to)
    return [*found, f"{shorter} follow the fitted law down to {end}: carried on, not measured"]


def wavelength(q):
    return amount(2 * np.pi / q, "m")


def remarks_on_stitching(stitched):
    """Remarks on how well several measurements agree."""
    if stitched is None:
        return []
    if np.isnan(stitched.scatter):
        return ["no two measurements overlap: whether they agree in height cannot be told"]
    return [
        f"{len(stitched.offsets)} measurements stitched, which differ by a factor of "
        f"{np.exp(stitched.scatter):.2f} in C (standard deviation)"
    ]
