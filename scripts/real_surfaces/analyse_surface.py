"""Spectrum and moments of a real surface, given by parameters or by a measured topography.

Both kinds have the same variables, so that criteria treat them alike: a smooth and a rough end of
the uncertainty of the surface, each with its moments.
"""

import logging

import numpy as np
import xarray as xr
from scipy import stats

from common import conventions
from common.config.entries import measurements
from common.job import start
from real_surfaces.measured_surface import find_spectrum, read_levelled
from stickiness import datasets
from stickiness.error_budget import SOURCES, ErrorComponent, not_applicable, with_budget
from stickiness.measured import plausibility, stitching, texture
from stickiness.spectrum.direction import find_ratio
from stickiness.spectrum.kinds import SelfAffine
from stickiness.statistics import COVERS
from stickiness.units import si

ENDS = ["smooth", "rough"]
END_QUANTILES = (0.16, 0.84)  # of the draws: one standard error
DRAWS, SEED = 200, 1
REFERENCE_HURST = 0.8  # of the paper's lines C0 = 1e-3 and 1e-5 m^0.4
POINTS_PER_DECADE = 10
MOMENTS = ("h_rms", "rms_slope", "rms_curvature")
IGNORED = "judged all the same (plausibility: ignore)"
PICTURE_POINTS = 400  # along a side of the picture of the heights

VARIABLE_TEXTS = {
    "end": ("1", "smooth or rough end of what is known of the surface"),
    "wave_number": ("1/m", "wave number"),
    "psd": ("m^4", "power spectral density"),
    "psd_standard_error": ("m^4", "sampling error of the power spectral density"),
    "psd_fit": ("m^4", "fitted self-affine spectrum"),
    "fitted": ("1", "1 where the wave number is within the range of the fit"),
    "h_rms": ("m", "rms height"),
    "h_rms_measured": ("m", "rms height of the levelled heights, Sq (profile: Pq)"),
    "h_rms_as_read": ("m", "rms height of the levelled heights, with points dropped or masked"),
    "masked_spikes": ("1", "points far off all their neighbours, not used"),
    "rms_slope": ("1", "rms gradient, of waves up to q1"),
    "rms_curvature": ("1/m", "rms Laplacian, of waves up to q1"),
    "elastic_energy": ("m", "elastic energy of full contact per area over E*"),
    "unresolved_energy": ("1", "energy of the law from q_cutoff to 0.3 nm over that measured"),
    "mean_deviation": ("m", "mean absolute height of the levelled heights, Sa (profile: Pa)"),
    "height_range": ("m", "highest less lowest of the levelled heights, Sz (profile: Pt)"),
    "skewness": ("1", "skewness of the levelled heights, Ssk (profile: Psk)"),
    "draw": ("1", "spectra drawn that agree with the measured one"),
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
    "heights": ("m", "levelled heights of the first measurement, thinned"),
    "profile": ("m", "levelled heights of the first measurement"),
    "measurement": ("1", "measurement of the surface, as listed"),
    "wave_number_measured": ("1/m", "wave number of the rings of the measurements"),
    "psd_measurement": ("m^4", "power spectral density of each measurement", "outside its band"),
    "offset": ("1", "ln C of a measurement less the stitched one", "overlaps with no other"),
    "scatter": ("1", "standard deviation between measurements in ln C", "no two overlap"),
}


def main(job):
    entry = job.params.surface
    dataset = analyse(entry) if entry["kind"] == "measured" else self_affine(entry)
    title = f"spectrum of the real surface {job.wildcards.real_surface}"
    parameters = {"surface": job.wildcards.real_surface, **entry}
    datasets.write(dataset, job.output[0], title=title, parameters=parameters)


def self_affine(entry):
    """Both ends of the range of a parametric surface, or of what a drawing says of it."""
    is_texture = entry["kind"] == "surface_texture"
    find = texture_spectrum if is_texture else configured_spectrum
    smooth, rough = spectra = [find(entry, end) for end in (0, -1)]
    points = int(np.ceil(POINTS_PER_DECADE * np.log10(smooth.magnification))) + 2
    q = np.geomspace(smooth.q0, smooth.q1, points)
    line = [(s.psd(q) * q ** (2 * REFERENCE_HURST + 2)).max() for s in spectra]
    data = {name: ("end", [getattr(s, name) for s in spectra]) for name in MOMENTS}
    data |= {
        "elastic_energy": ("end", [s.elastic_energy() for s in spectra]),
        "psd": (("end", "wave_number"), [s.psd(q) for s in spectra]),
        "C0": ("end", line if is_texture else [s.C0 for s in spectra]),
        "C0_reference_upper": ("end", line),
        "hurst": texture.MIDDLE_HURST if is_texture else entry["hurst"],
        "q0": np.sqrt(smooth.q_longest * rough.q_longest),
        "q1": smooth.q1,
    }
    if "anisotropy" in entry:
        data["axis_ratio"] = entry["anisotropy"]
    return annotate(xr.Dataset(data, coords={"end": ENDS, "wave_number": q}))


def configured_spectrum(asked, end):
    """Self-affine spectrum of one end of the configured range of h_rms or C0."""
    hurst = asked["hurst"]
    units = {"h_rms": "m", "C0": f"m^{2 - 2 * hurst:g}"}
    return SelfAffine(
        hurst=hurst,
        q0=wave_number(asked, "q0", "longest_wavelength"),
        q1=wave_number(asked, "q1", "shortest_wavelength"),
        q_rolloff=wave_number(asked, "", "rolloff_wavelength"),
        anisotropy=asked.get("anisotropy", 1.0),
        angle=np.radians(asked.get("angle", 0.0)),
        **{key: bound(asked[key], end, unit) for key, unit in units.items() if key in asked},
    )


def texture_spectrum(asked, end):
    """Spectrum of one end of what a drawing says, see `texture`; low values are the smooth end."""
    given, factor = (asked["Rq"], 1.0) if "Rq" in asked else (asked["Ra"], texture.RQ_OVER_RA)
    # Wider profile elements are smoother. Where they are not known, the cut-off limits them.
    widths = [bound(asked["RSm"], at) for at in (-1, 0)] if "RSm" in asked else ()
    if "lambda_c" in asked:
        cutoff = si(asked["lambda_c"], "m")
    else:
        cutoff = texture.standard_cutoff(
            factor * bound(given, -1) / texture.RQ_OVER_RA, *widths[:1]
        )
    spacing = widths[end] if widths else texture.RSM_OVER_CUTOFF[end] * cutoff
    return SelfAffine(
        hurst=texture.HURST[end],
        q0=2 * np.pi / cutoff,
        q_rolloff=2 * np.pi * texture.RSM_OVER_ROLLOFF[end] / spacing,
        q1=2 * np.pi / si(asked.get("shortest_wavelength", "1 nm"), "m"),
        h_rms=texture.HEIGHT_OVER_RQ[end] * factor * bound(given, end),
    )


def bound(value, end, unit="m"):
    """One end, 0 or -1, of a value or a range."""
    return si(value[end] if isinstance(value, list) else value, unit)


def wave_number(asked, key, wavelength):
    """Wave number [1/m] that is given as such or as a wavelength; None if it is not given."""
    if key in asked:
        return si(asked[key], "1/m")
    return 2 * np.pi / si(asked[wavelength], "m") if wavelength in asked else None


def analyse(entry):
    """Dataset of a measured surface, as configured."""
    entries = [one for _, one in measurements(entry)]
    heights = [read_levelled(one) for one in entries]
    found = [find_spectrum(h, one) for h, one in zip(heights, entries, strict=True)]
    spectrum = stitching.stitch([one for one, _ in found])
    fit, cutoff = spectrum.fit, spectrum.cutoff
    doubts = [doubt for _, doubt in found if doubt] or [*plausibility.doubt_fit(fit)]
    extend_to = 2 * np.pi / si(entry["extend_to"], "m") if "extend_to" in entry else None
    if extend_to is not None and not fit.is_self_affine:
        doubts.append(f"H = {fit.hurst:.2f} cannot extrapolate the spectrum: leave out extend_to")
        extend_to = None
    drawn = stitching.draw(
        spectrum, DRAWS, SEED, extend_to=extend_to, continue_to=2 * np.pi / stitching.SHORTEST_WAVE
    )
    doubts += [doubt for one in heights for doubt in one.doubts]
    withheld = [] if entry.get("plausibility") == "ignore" else doubts
    for doubt in withheld:
        logging.warning("no verdict: %s", doubt)

    line, line_se, upper = fit.c0_at_hurst(REFERENCE_HURST)
    errors = {"hurst": fit.hurst_se, "C0_reference": line_se}
    dataset = xr.merge([tabulate_spectrum(spectrum, extend_to), picture_of(heights[0])]).assign(
        C0=("end", fit.c0 * np.ones(2)),
        C0_relative_error=fit.c0_se / fit.c0,
        C0_reference=line,
        C0_reference_upper=("end", [upper, upper]),
        hurst=fit.hurst,
        misfit=fit.misfit,
        q0=fit.q_rolloff or spectrum.lowest,
        q1=cutoff.q if extend_to is None else extend_to,
        q_cutoff=cutoff.q,
        cutoff_detected=int(cutoff.detected),
        h_rms_measured=heights[0].h_rms,
        mean_deviation=np.mean(np.abs(heights[0].heights)),  # of levelled heights, whose mean is 0
        height_range=np.ptp(heights[0].heights),
        skewness=stats.skew(heights[0].heights, axis=None),
        h_rms_as_read=heights[0].h_rms_as_read(entries[0].get("detrend", "plane")),
        missing_fraction=max(h.missing_fraction for h in heights),
        dropped_points=sum(h.dropped for h in heights),
        masked_spikes=sum(h.spikes for h in heights),
        cropped_fraction=max(h.cropped for h in heights),
        unresolved_energy=("end", np.quantile(drawn.unresolved, END_QUANTILES)),
        q0_draws=("draw", drawn.q0),
        draw=np.arange(DRAWS),
    )
    # Both ends of every moment, and the draws themselves for what depends on several.
    for name, values in drawn.moments.items():
        dataset[name] = "end", drawn.quantiles(name, END_QUANTILES)
        dataset[f"{name}_draws"] = "draw", values
    if np.isfinite(spectrum.anisotropy):
        dataset["anisotropy"] = spectrum.anisotropy
        dataset["axis_ratio"] = find_ratio(spectrum.anisotropy, fit.hurst)
    if fit.q_rolloff is not None:
        dataset["q_rolloff"], errors["q_rolloff"] = fit.q_rolloff, fit.q_rolloff_se
    if isinstance(spectrum, stitching.Stitched):
        places = {"measurement": np.arange(len(heights)), "wave_number_measured": spectrum.rings.q}
        dataset = dataset.assign_coords(places)
        dataset["psd_measurement"] = tuple(places), spectrum.levels
        dataset["offset"] = "measurement", spectrum.offsets
        dataset["scatter"] = spectrum.scatter
    return annotate(dataset, **errors).assign_attrs(
        remarks="; ".join(f"{IGNORED}: {doubt}" for doubt in doubts if not withheld),
        cutoff=cutoff.reason,
        files="; ".join(h.source for h in heights),
        contradictions="\n".join(said for h in heights for said in h.contradictions),
        choices="\n".join(f"{h.source} | {', '.join(h.others)}" for h in heights if h.others),
        not_judged="\n".join(withheld),
    )


def tabulate_spectrum(spectrum, extend_to):
    """Measured and fitted spectrum; extrapolated by the fit to `extend_to` [1/m] if configured."""
    fit, rings, top = spectrum.fit, spectrum.rings, spectrum.cutoff.q
    q, psd, error = rings.q, [rings.psd, rings.psd], rings.standard_error
    if extend_to is not None:
        inside = q <= top * (1 + 1e-9)
        count = int(np.ceil(np.log10(extend_to / top) * POINTS_PER_DECADE)) + 1
        more = np.geomspace(top, extend_to, count)[0 if q[inside][-1] < top * 0.99 else 1 :]
        q = np.append(q[inside], more)
        # Standard error of the fitted ln C, beyond the plateau.
        design = np.array([np.ones_like(more), -2 * np.log(more)])
        spread = np.sqrt(np.einsum("in,ij,jn->n", design, fit.log_covariance[:2, :2], design))
        psd = [np.append(rings.psd[inside], fit.psd(more) * np.exp(s * spread)) for s in (-1, 1)]
        error = np.append(error[inside], fit.psd(more) * spread)
    fitted = (q >= fit.q_min * (1 - 1e-9)) & (q <= fit.q_max * (1 + 1e-9))
    data = {
        "psd": (("end", "wave_number"), psd),
        "psd_standard_error": ("wave_number", error),
        "psd_fit": ("wave_number", fit.psd(q)),
        "fitted": ("wave_number", fitted.astype("i1")),
    }
    return xr.Dataset(data, coords={"end": ENDS, "wave_number": q})


def picture_of(heights):
    """Levelled heights, thinned to what a picture shows."""
    picture = heights.to_xarray()
    if picture.ndim == 1:
        return picture.rename("profile")
    thin = max(1, *(n // PICTURE_POINTS for n in picture.shape))
    return picture[::thin, ::thin].astype("f4").rename("heights")


def annotate(dataset, **errors):
    """Add units and texts, and budgets from the standard errors of what was fitted."""
    reference = f"m^{2 - 2 * REFERENCE_HURST:g}"
    texts = VARIABLE_TEXTS | {
        "C0": (f"m^{2 - 2 * float(dataset.hurst):.4g}", "prefactor of C = C0 q^(-2(H+1))"),
        "C0_reference": (reference, f"prefactor of the line fitted at H = {REFERENCE_HURST}"),
        "C0_reference_upper": (reference, f"largest C q^(2(H+1)) at H = {REFERENCE_HURST}"),
    }
    for name in stitching.ORDERS:
        unit, text = VARIABLE_TEXTS[name]
        texts[f"{name}_draws"] = unit, f"{text}, of every draw"
    dataset = conventions.annotate(dataset, **texts)
    dataset.psd.attrs["comment"] = "h_rms^2 = 2 pi int q C dq"
    if not errors:
        given = dict.fromkeys(SOURCES, not_applicable("given or assumed in the configuration"))
        return with_budget(dataset, "hurst", **given)
    parts = dict.fromkeys(SOURCES, not_applicable("of the band that was fitted"))
    parts["model"] = not_applicable("the law is what is quoted; its misfit stands beside")
    for name, error in errors.items():
        parts["sampling"] = ErrorComponent(COVERS * error, "of the spectrum measured")
        dataset = with_budget(dataset, name, **parts)
    return dataset


if __name__ == "__main__":
    main(start(globals(), "analyse_surface", real_surface="jacksboro"))
