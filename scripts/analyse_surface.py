"""Spectrum and moments of a real surface, given by parameters or by a measured topography.

Both kinds end in the same variables, so that criteria need not know which it was: a smooth and a
rough end of what is known of the surface, each with its moments.
"""

import logging

import numpy as np
import xarray as xr

from _job import start
from stickiness import datasets, psd, selfaffine, topography
from stickiness.spectrum import SelfAffine
from stickiness.units import si

ENDS = ["smooth", "rough"]
REFERENCE_HURST = 0.8  # of the paper's lines C0 = 1e-3 and 1e-5 m^0.4
POINTS_PER_DECADE = 10


def main(job):
    asked = job.params.surface
    dataset = measured(asked) if asked["kind"] == "measured" else self_affine(asked)
    datasets.write(
        annotated(dataset),
        job.output[0],
        title=f"spectrum of a real surface: {asked['label']}",
        parameters={"surface": job.wildcards.real_surface, **asked},
    )


def self_affine(asked):
    """Both ends of the range of a parametric surface."""
    spectra = [spectrum_of(asked, end) for end in (0, -1)]
    q = np.geomspace(spectra[0].q0, spectra[0].q1, points(spectra[0].magnification))
    dataset = moments_of(spectra, [s.h_rms for s in spectra])
    dataset["psd"] = (("end", "wave_number"), [s.psd(q) for s in spectra])
    dataset["C0"] = ("end", [s.C0 for s in spectra])
    line = [(s.psd(q) * q ** (2 * REFERENCE_HURST + 2)).max() for s in spectra]
    dataset["C0_reference_upper"] = ("end", line)
    return dataset.assign(
        hurst=asked["hurst"],
        q0=spectra[0].q0 if spectra[0].q_rolloff is None else spectra[0].q_rolloff,
        q1=spectra[0].q1,
    ).assign_coords(wave_number=q)


def spectrum_of(asked, end):
    def bound(key, unit):
        value = asked[key]
        return si(value[end] if isinstance(value, list) else value, unit)

    hurst = asked["hurst"]
    size = {"h_rms": bound("h_rms", "m")} if "h_rms" in asked else {}
    if "C0" in asked:
        size["C0"] = bound("C0", f"m^{2 - 2 * hurst:g}")
    return SelfAffine(
        hurst=hurst,
        q0=wave_number(asked, "q0", "longest_wavelength"),
        q1=wave_number(asked, "q1", "shortest_wavelength"),
        q_rolloff=wave_number(asked, "", "rolloff_wavelength"),
        **size,
    )


def wave_number(asked, key, wavelength):
    if key in asked:
        return si(asked[key], "1/m")
    return 2 * np.pi / si(asked[wavelength], "m") if wavelength in asked else None


def measured(asked):
    """Level, window and average the spectrum of a topography; fit H and C0."""
    heights = read(asked).detrended(asked.get("detrend", "plane"))
    plane = psd.power_spectrum(heights.heights, heights.dx, heights.dy, asked.get("window", "hann"))
    rings = psd.radial_average(plane, bins_per_decade=POINTS_PER_DECADE)
    fit = selfaffine.fit_self_affine(
        plane,
        q_min=wave_number(asked, "", "fit_from"),
        q_max=wave_number(asked, "", "fit_to"),
    )
    line = fit.c0_at_hurst(REFERENCE_HURST)
    anisotropy, _ = plane.anisotropy(fit.q_min, fit.q_max)
    remarks = selfaffine.remarks(fit, anisotropy)
    for remark in remarks:
        logging.info(remark)
    dataset = resolved_moments(rings, plane.dqx * plane.dqy, fit.q_max)
    dataset["h_rms_measured"] = heights.h_rms
    if fit.q_rolloff is None:
        lowest = 2 * np.pi / fit.q_min
        remarks.append(
            f"no roll-off was found below wavelengths of {lowest:.3g} m, and longer ones cannot "
            "show one: q0 is that of the scan, not of the surface"
        )
    shortest = 2 * np.pi / fit.q_max
    remarks.append(f"waves shorter than {shortest:.3g} m are not part of slope, curvature and a_V")
    if fit.q_rolloff is not None:
        dataset["q_rolloff"] = fit.q_rolloff
    return (
        dataset.assign(
            psd=(("end", "wave_number"), [rings.psd, rings.psd]),
            psd_standard_error=("wave_number", rings.standard_error),
            psd_fit=("wave_number", fit.psd(rings.q)),
            fitted=("wave_number", ((rings.q >= fit.q_min) & (rings.q <= fit.q_max)).astype("i1")),
            C0=("end", fit.c0 * np.ones(2)),
            C0_relative_error=fit.c0_se / fit.c0,
            C0_reference=line.c0,
            C0_reference_error=line.c0_se,
            C0_reference_upper=("end", [line.upper, line.upper]),
            hurst=fit.hurst,
            hurst_error=fit.hurst_se,
            misfit=fit.misfit,
            anisotropy=anisotropy,
            q0=fit.q_rolloff or min(plane.dqx, plane.dqy),
            q1=fit.q_max,
            missing_fraction=heights.missing_fraction,
        )
        .assign_coords(wave_number=rings.q)
        .assign_attrs(remarks="; ".join(remarks))
    )


def read(asked):
    if asked["file"] == "builtin:jacksboro":
        return topography.jacksboro()
    keys = ("length", "pixel_size", "height_unit", "variable", "missing_value", "max_missing")
    return topography.read(asked["file"], **{key: asked[key] for key in keys if key in asked})


def resolved_moments(rings, cell, q_max):
    """Moments of the spectrum at both ends of its sampling error.

    All from the windowed spectrum, so that they belong together. Slope, curvature and energy are
    of the waves up to q_max: beyond it the instrument decides, not the surface.
    """
    inside = rings.q <= q_max
    h, h_error = root_and_error(rings, cell, 0)
    slope, slope_error = root_and_error(rings, cell, 2, inside)
    curvature, curvature_error = root_and_error(rings, cell, 4, inside)
    energy, energy_error = root_and_error(rings, cell, 1, inside)
    ends = np.array([-1, 1])
    return xr.Dataset(
        {
            "h_rms": ("end", h * np.exp(ends * h_error)),
            "rms_slope": ("end", slope * np.exp(ends * slope_error)),
            "rms_curvature": ("end", curvature * np.exp(ends * curvature_error)),
            "elastic_energy": ("end", (energy * np.exp(ends * energy_error)) ** 2 / 4),
        },
        coords={"end": ENDS},
    )


def root_and_error(rings, cell, power, inside=True):
    """Root of the variance 2 pi int q^(1 + power) C dq and its relative sampling error.

    The error is large for the heights, whose variance sits in the few longest waves.
    """
    parts = np.where(inside, rings.psd * rings.modes * cell * rings.q**power, 0)
    total = parts.sum()
    return np.sqrt(total), np.sqrt(np.sum(parts**2 / rings.dof)) / total / 2


def moments_of(spectra, h_rms):
    return xr.Dataset(
        {
            "h_rms": ("end", h_rms),
            "rms_slope": ("end", [s.rms_slope for s in spectra]),
            "rms_curvature": ("end", [s.rms_curvature for s in spectra]),
            "elastic_energy": ("end", [s.elastic_energy() for s in spectra]),
        },
        coords={"end": ENDS},
    )


def points(magnification):
    return int(np.ceil(POINTS_PER_DECADE * np.log10(magnification))) + 2


def annotated(dataset):
    exponent = 2 - 2 * float(dataset.hurst)
    reference = f"m^{2 - 2 * REFERENCE_HURST:g}"
    described = {
        "end": ("1", "smooth or rough end of what is known of the surface"),
        "wave_number": ("1/m", "wave number"),
        "psd": ("m^4", "power spectral density C, h_rms^2 = 2 pi int q C dq"),
        "psd_standard_error": ("m^4", "sampling error of the power spectral density"),
        "psd_fit": ("m^4", "fitted self-affine spectrum"),
        "fitted": ("1", "1 where the wave number is within the range of the fit"),
        "h_rms": ("m", "rms height"),
        "h_rms_measured": ("m", "rms height of the levelled heights, without a window"),
        "rms_slope": ("1", "rms gradient, of waves up to q1"),
        "rms_curvature": ("1/m", "rms Laplacian, of waves up to q1"),
        "elastic_energy": ("m", "elastic energy of full contact per area over E*"),
        "hurst": ("1", "Hurst exponent"),
        "hurst_error": ("1", "standard error of the Hurst exponent"),
        "C0": (f"m^{exponent:.4g}", "prefactor of C = C0 q^(-2(H+1))"),
        "C0_relative_error": ("1", "relative standard error of C0"),
        "C0_reference": (reference, f"prefactor of the line fitted at H = {REFERENCE_HURST}"),
        "C0_reference_error": (reference, f"standard error of C0 at H = {REFERENCE_HURST}"),
        "C0_reference_upper": (reference, f"largest C q^(2(H+1)) at H = {REFERENCE_HURST}"),
        "q_rolloff": ("1/m", "end of the plateau"),
        "misfit": ("1", "departure of the spectrum from the fit beyond sampling noise"),
        "q0": ("1/m", "lowest wave number of the self-affine range"),
        "q1": ("1/m", "highest wave number"),
        "anisotropy": ("1", "amplitude of the spectrum's dependence on direction, cos 2 phi"),
        "missing_fraction": ("1", "share of points that were missing and interpolated"),
    }
    present = {name: text for name, text in described.items() if name in dataset.variables}
    return datasets.annotate(dataset, **present)


if __name__ == "__main__":
    main(start(globals(), "analyse_surface", real_surface="jacksboro"))
