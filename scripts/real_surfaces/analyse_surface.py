"""Spectrum and moments of a real surface, given by parameters or by a measured topography.

Both kinds have the same variables, so that criteria treat them alike: a smooth and a rough end of
the uncertainty of the surface, each with its moments.
"""

import numpy as np
import xarray as xr

from common.job import start
from common.real_spectra import configured_spectrum
from real_surfaces import measured_surface
from real_surfaces.measured_surface import ENDS, POINTS_PER_DECADE, REFERENCE_HURST
from stickiness import datasets
from stickiness.error_budget import Part, absent, with_budget
from stickiness.statistics import COVERS

VARIABLE_TEXTS = {
    "end": ("1", "smooth or rough end of what is known of the surface"),
    "wave_number": ("1/m", "wave number"),
    "psd": ("m^4", "power spectral density"),
    "psd_standard_error": ("m^4", "sampling error of the power spectral density"),
    "psd_fit": ("m^4", "fitted self-affine spectrum"),
    "fitted": ("1", "1 where the wave number is within the range of the fit"),
    "h_rms": ("m", "rms height"),
    "h_rms_measured": ("m", "rms height of the levelled heights, without a window"),
    "h_rms_as_read": ("m", "rms height of the levelled heights, with points dropped or masked"),
    "masked_spikes": ("1", "points far off all their neighbours, not used"),
    "rms_slope": ("1", "rms gradient, of waves up to q1"),
    "rms_curvature": ("1/m", "rms Laplacian, of waves up to q1"),
    "elastic_energy": ("m", "elastic energy of full contact per area over E*"),
    "draw": ("1", "spectra drawn that agree with the measured one"),
    "h_rms_draws": ("m", "rms height of every draw"),
    "rms_slope_draws": ("1", "rms gradient of every draw"),
    "rms_curvature_draws": ("1/m", "rms Laplacian of every draw"),
    "elastic_energy_draws": ("m", "elastic energy of full contact per area over E*, every draw"),
    "q0_draws": ("1/m", "lowest wave number of the self-affine range of every draw"),
    "hurst": ("1", "Hurst exponent"),
    "C0_relative_error": ("1", "relative standard error of C0"),
    "q_rolloff": ("1/m", "end of the plateau"),
    "misfit": ("1", "departure of the spectrum from the fit beyond sampling noise"),
    "q0": ("1/m", "lowest wave number of the self-affine range"),
    "q1": ("1/m", "highest wave number"),
    "q_cutoff": ("1/m", "highest wave number that the instrument resolves"),
    "cutoff_detected": ("1", "1 if that was found in the data rather than given or by default"),
    "anisotropy": ("1", "amplitude of the spectrum's dependence on direction, cos 2 phi"),
    "axis_ratio": ("1", "ratio of the long to the short correlation length"),
    "missing_fraction": ("1", "share of points that were missing or dropped, and interpolated"),
    "dropped_points": ("1", "points measured beside missing ones, not used"),
    "cropped_fraction": ("1", "share of points cut off to leave no missing ones"),
    "x": ("m", "position along x"),
    "y": ("m", "position along y"),
    "heights": ("m", "levelled heights of the first measurement, thinned"),
    "profile": ("m", "levelled heights of the first measurement"),
    "measurement": ("1", "measurement of the surface, as listed"),
    "wave_number_measured": ("1/m", "wave number of the rings of the measurements"),
    "psd_measurement": ("m^4", "power spectral density of each measurement", "outside its band"),
    "offset": ("1", "ln C of a measurement less the stitched one", "overlaps with no other"),
    "scatter": ("1", "standard deviation of the offsets", "no two measurements overlap"),
}

# Quoted numbers, and the standard errors of those that were fitted.
STANDARD_ERRORS = {n: f"{n}_standard_error" for n in ("hurst", "C0_reference", "q_rolloff")}


def main(job):
    asked = job.params.surface
    dataset = measured_surface.analyse(asked) if asked["kind"] == "measured" else self_affine(asked)
    datasets.write(
        annotate(dataset),
        job.output[0],
        title=f"spectrum of a real surface: {asked['label']}",
        parameters={"surface": job.wildcards.real_surface, **asked},
    )


def self_affine(asked):
    """Both ends of the range of a parametric surface."""
    spectra = [configured_spectrum(asked, end) for end in (0, -1)]
    smooth = spectra[0]
    points = int(np.ceil(POINTS_PER_DECADE * np.log10(smooth.magnification))) + 2
    q = np.geomspace(smooth.q0, smooth.q1, points)
    dataset = moments_of(spectra)
    dataset["psd"] = (("end", "wave_number"), [s.psd(q) for s in spectra])
    dataset["C0"] = ("end", [s.C0 for s in spectra])
    line = [(s.psd(q) * q ** (2 * REFERENCE_HURST + 2)).max() for s in spectra]
    dataset["C0_reference_upper"] = ("end", line)
    if "anisotropy" in asked:
        dataset["axis_ratio"] = asked["anisotropy"]
    return dataset.assign(
        hurst=asked["hurst"],
        q0=smooth.q0 if smooth.q_rolloff is None else smooth.q_rolloff,
        q1=smooth.q1,
    ).assign_coords(wave_number=q)


def moments_of(spectra):
    names = ("h_rms", "rms_slope", "rms_curvature")
    data = {name: ("end", [getattr(s, name) for s in spectra]) for name in names}
    data["elastic_energy"] = "end", [s.elastic_energy() for s in spectra]
    return xr.Dataset(data, coords={"end": ENDS})


def add_budgets(dataset, errors):
    """Add the errors of the quoted parameters; both ends of the others are in the dataset."""
    given, band = absent("given in the configuration"), absent("of the band that was fitted")
    for name, error in STANDARD_ERRORS.items():
        if name not in dataset:
            continue
        fitted = error in errors
        parts = dict.fromkeys(("discretisation", "solver", "bandwidth"), band if fitted else given)
        parts |= {"sampling": given, "model": given}
        if fitted:
            parts["sampling"] = Part(COVERS * errors[error], "of the spectrum measured")
            parts["model"] = absent("the law is what is quoted; its misfit stands beside")
        dataset = with_budget(dataset, name, **parts)
    return dataset


def annotate(dataset):
    errors = {name: dataset[name] for name in STANDARD_ERRORS.values() if name in dataset}
    dataset = dataset.drop_vars(errors)
    reference = f"m^{2 - 2 * REFERENCE_HURST:g}"
    texts = VARIABLE_TEXTS | {
        "C0": (f"m^{2 - 2 * float(dataset.hurst):.4g}", "prefactor of C = C0 q^(-2(H+1))"),
        "C0_reference": (reference, f"prefactor of the line fitted at H = {REFERENCE_HURST}"),
        "C0_reference_upper": (reference, f"largest C q^(2(H+1)) at H = {REFERENCE_HURST}"),
    }
    present = {name: text for name, text in texts.items() if name in dataset.variables}
    dataset = datasets.annotate(dataset, **present)
    dataset.psd.attrs["comment"] = "h_rms^2 = 2 pi int q C dq"
    return add_budgets(dataset, errors)


if __name__ == "__main__":
    main(start(globals(), "analyse_surface", real_surface="jacksboro"))
