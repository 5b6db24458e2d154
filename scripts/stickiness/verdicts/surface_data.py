"""What is known of a surface, as a dataset: of a measurement, or by a description.

A measured surface has draws, that is spectra which agree with it. One that is described, by
parameters of a spectrum or of profiles on a drawing, has a smooth and a rough end.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr

from stickiness import datasets
from stickiness.error_budget import SOURCES, not_applicable, with_budget
from stickiness.measured import texture
from stickiness.spectrum.family import SpectrumFamily
from stickiness.spectrum.interface import Spectrum
from stickiness.spectrum.kinds import SelfAffine, Tabulated

ENDS = ("smooth", "rough")  #: of what is known of a surface
END_QUANTILES = (0.16, 0.84)  #: of draws, one standard error either side: smooth and rough end
MOMENTS = ("h_rms", "rms_slope", "rms_curvature")
REFERENCE_HURST = 0.8  #: of the paper's lines C0 = 1e-3 and 1e-5 m^0.4
POINTS_PER_DECADE = 10  #: at which spectra are tabulated
ALIKE = 1e-9  #: relative, of two wave numbers that are tabulated once


#: Every variable with its unit and its description.
SURFACE_VARIABLES = {
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
    "kurtosis": ("1", "kurtosis of the levelled heights, Sku (profile: Pku); 3 of Gaussian ones"),
    "shape": ("1", "ln of the factor on the energy ratio that the shape of the heights makes"),
    "shape_error": ("1", "half the width of the interval of 90 % of that"),
    "unevenness": ("1", "scatter of ln of the mean square slope among quarters, beyond the mean"),
    "part": ("1", "part of the map that is simulated: 0 the whole, then its quarters"),
    "resolved_energy": ("m", "elastic energy of full contact of the periodic map, resolved waves"),
    "simulated_pixel": ("m", "pixel of the grid on which the heights are simulated"),
    "independent_areas": ("1", "number of independent heights among these"),
    "standard_heights": ("1", "heights as they are simulated, over standard_height_unit"),
    "standard_quarters": ("1", "the same of the quarters of the map"),
    "standard_sides": ("1", "sides of every part, over standard_length_unit"),
    "standard_height_unit": ("m", "unit of the heights of every part"),
    "standard_length_unit": ("m", "first side of the map"),
    "trial_energy": ("m", "elastic energy per area over E* of every state simulated"),
    "trial_gap_share": ("1", "share of the area in every bin of gaps; the first is contact"),
    "trial_gap": ("m", "mean gap of every bin"),
    "trial_gap_bin": ("1", "bin of the gap of every point of the map; 0 is contact"),
    "trial_has_adhesion": ("1", "1 where a state was simulated with adhesion"),
    "simulated_full_contact": ("m", "elastic energy of full contact of the heights simulated"),
    "simulated_length": ("m", "adhesion lengths simulated"),
    "simulated_range": ("m", "range of the attraction simulated at every adhesion length"),
    "simulated_share": ("1", "share of the work of adhesion that remained in simulation"),
    "pulled_length": ("m", "adhesion lengths at which contact was pulled off"),
    "pulled_range": ("m", "range of the attraction of every pull-off"),
    "pulled_tension": ("1", "largest mean tension over E* of every pull-off"),
    "pulled_area": ("1", "share of the area in contact before every pull-off"),
    "ring": ("1/m", "wave number of the rings of every spectrum drawn"),
    "ring_area": ("1/m^2", "area of these rings in the plane of wave vectors"),
    "drawn_psd": ("m^4", "power spectral density of every spectrum drawn"),
    "drawn_q0": ("1/m", "lowest wave number of the self-affine range of every draw"),
    "drawn_hurst": ("1", "Hurst exponent of the law fitted, of every draw"),
    "drawn_first_psd": ("m^4", "C of that law at q_fitted or at drawn_q0, whichever is higher"),
    "held_energy": ("m", "energy of full contact of the waves that the first map holds, as drawn"),
    "q_fitted": ("1/m", "lowest wave number that was fitted"),
    "scan": ("m", "longest side of the measurements"),
    "contact": ("m", "side of the contact, whose waves the spectrum has"),
    "draw": ("1", "spectra drawn that agree with the measured one"),
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
    "heights_as_read": ("m", "heights of the first measurement as read, thinned", "missing"),
    "feature_outline": ("m", "corners, x and y, of a feature that decides the energy"),
    "unused": ("1", "1 if a point that was read is masked, dropped or cut off, thinned"),
    "profile": ("m", "levelled heights of the first measurement"),
    "x": ("m", "position along x"),
    "y": ("m", "position along y"),
    "measurement": ("1", "measurement of the surface, as listed"),
    "wave_number_measured": ("1/m", "wave number of the rings of the measurements"),
    "psd_measurement": ("m^4", "power spectral density of each measurement", "outside its band"),
    "offset": ("1", "ln C of a measurement less the stitched one", "overlaps with no other"),
    "is_used": ("1", "1 if the measurement has waves within the limits of its instrument"),
    "gap": ("1/m", "ends of a range of wave numbers that no measurement resolves"),
    "scatter": ("1", "standard deviation between measurements in ln C", "no two overlap"),
}


def tabulate_ends(
    smooth: Spectrum, rough: Spectrum, hurst: float | None = None, C0: Sequence[float] | None = None
) -> xr.Dataset:
    """Describe a surface between two spectra: their moments, and C(q) on common wave numbers.

    `hurst` and `C0` (of both ends) are stored if they are known.
    """
    spectra = (smooth, rough)
    q = _choose_wave_numbers(spectra)
    # The highest line of the reference exponent that touches the spectrum.
    levels = [spectrum.averaged().psd(q) for spectrum in spectra]
    line = [(level * q ** (2 * REFERENCE_HURST + 2)).max() for level in levels]
    tabulated: dict[str, Any] = {
        "psd": (("end", "wave_number"), levels),
        "elastic_energy": ("end", [s.elastic_energy() for s in spectra]),
        "C0_reference_upper": ("end", line),
        "C0": ("end", line if C0 is None else list(C0)),
        "q0": np.sqrt(smooth.q_longest * rough.q_longest),
        "q1": smooth.q1,
    }
    tabulated |= {name: ("end", [getattr(s, name) for s in spectra]) for name in MOMENTS}
    if hurst is not None:
        tabulated["hurst"] = hurst
    if smooth.anisotropy != 1:
        tabulated["axis_ratio"] = smooth.anisotropy
    dataset = xr.Dataset(tabulated, coords={"end": list(ENDS), "wave_number": q})
    dataset = describe_variables(dataset)
    if hurst is None:
        return dataset
    exact = dict.fromkeys(SOURCES, not_applicable("given or assumed in the configuration"))
    return with_budget(dataset, "hurst", **exact)


def read_ends(data: xr.Dataset, highest: float) -> tuple[Spectrum, Spectrum]:
    """Spectra of the smooth and of the rough end, up to a wave number [1/m]."""
    inside = np.flatnonzero(data.wave_number.values <= highest * (1 + 1e-9))
    q = data.wave_number.values[inside]
    smooth, rough = (data.psd.sel(end=end).values[inside] for end in ENDS)
    return Tabulated(q, smooth), Tabulated(q, rough)


def read_family(data: xr.Dataset) -> SpectrumFamily:
    """Spectra that agree with a measured one, a row for each draw."""
    return SpectrumFamily(data.ring.values, data.ring_area.values, data.drawn_psd.values)


def tabulate_family(family: SpectrumFamily) -> dict[str, Any]:
    """Variables that hold drawn spectra; `read_family` reads them."""
    return {
        "drawn_psd": (("draw", "ring"), family.psd),
        "ring_area": ("ring", family.area),
        "ring": family.q,
        "draw": np.arange(family.count),
    }


def find_moments(family: SpectrumFamily, q1: float) -> dict[str, Any]:
    """Both ends of the moments of drawn spectra; of slope and curvature of the waves up to q1."""
    told = family.up_to(q1)
    of_draws = {
        "h_rms": np.sqrt(family.variance()),
        "rms_slope": np.sqrt(told.variance(2)),
        "rms_curvature": np.sqrt(told.variance(4)),
        "elastic_energy": family.energy(),
    }
    return {name: ("end", np.quantile(each, END_QUANTILES)) for name, each in of_draws.items()}


def describe_variables(dataset: xr.Dataset) -> xr.Dataset:
    """Give every variable of a surface its unit and description."""
    of_line = f"m^{2 - 2 * REFERENCE_HURST:g}"
    hurst = float(dataset.hurst) if "hurst" in dataset else REFERENCE_HURST
    texts = SURFACE_VARIABLES | {
        "C0": (f"m^{2 - 2 * hurst:.4g}", "prefactor of C = C0 q^(-2(H+1))"),
        "C0_reference": (of_line, f"prefactor of the line fitted at H = {REFERENCE_HURST}"),
        "C0_reference_upper": (of_line, f"largest C q^(2(H+1)) at H = {REFERENCE_HURST}"),
    }
    present = {name: texts[name] for name in texts if name in dataset.variables}
    dataset = datasets.annotate(dataset, **present)
    dataset.psd.attrs["comment"] = "h_rms^2 = 2 pi int q C dq"
    return dataset


def _choose_wave_numbers(spectra: Sequence[Spectrum]) -> np.ndarray:
    """Wave numbers [1/m] on which spectra are tabulated: between their kinks, power laws are exact.

    With a direction, the spectrum averaged over directions goes beyond the band of the norm.
    """
    averaged = [spectrum.averaged() for spectrum in spectra]
    low, high = averaged[0].band
    points = int(np.ceil(POINTS_PER_DECADE * np.log10(high / low))) + 2
    kinks = np.concatenate([spectrum.knots for spectrum in averaged])
    q = np.sort(np.append(np.geomspace(low, high, points), kinks))
    is_new = np.append(True, np.diff(q) > ALIKE * q[1:])
    return np.clip(q[is_new], low, high)


def read_self_affine(entry: Mapping[str, Any]) -> xr.Dataset:
    """Describe a self-affine surface of the configuration; h_rms or C0 may be a range."""
    smooth, rough = (_make_self_affine(entry, end) for end in (0, -1))
    return tabulate_ends(smooth, rough, hurst=entry["hurst"], C0=[smooth.C0, rough.C0])


def _make_self_affine(entry: Mapping[str, Any], end: int) -> SelfAffine:
    """Self-affine spectrum of one end, 0 or -1, of the configured range of h_rms or C0."""
    roughness = "C0" if entry["h_rms"] is None else "h_rms"
    rolloff = entry["rolloff_wavelength"]
    return SelfAffine(
        hurst=entry["hurst"],
        q0=_find_wave_number(entry, "q0", "longest_wavelength"),
        q1=_find_wave_number(entry, "q1", "shortest_wavelength"),
        q_rolloff=None if rolloff is None else 2 * np.pi / rolloff,
        anisotropy=entry["anisotropy"],
        angle=np.radians(entry["angle"]),
        **{roughness: float(choose_end(entry[roughness], end))},
    )


def _find_wave_number(entry: Mapping[str, Any], key: str, wavelength: str) -> float:
    """Wave number [1/m] that is given as such or as a wavelength."""
    return 2 * np.pi / entry[wavelength] if entry[key] is None else float(entry[key])


def read_drawing(entry: Mapping[str, Any]) -> xr.Dataset:
    """Describe the surface that a drawing specifies, see `measured.texture`."""
    smooth, rough = (_make_texture(entry, end) for end in (0, -1))
    return tabulate_ends(smooth, rough, hurst=texture.MIDDLE_HURST)


def _make_texture(entry: Mapping[str, Any], end: int) -> SelfAffine:
    """Spectrum of one end of what a drawing says; low values are the smooth end."""
    # Profiles of Gaussian heights have a fixed ratio of Rq to Ra.
    height, factor = (entry["Rq"], 1.0) if entry["Rq"] else (entry["Ra"], texture.RQ_OVER_RA)
    # Wider profile elements are smoother.
    widths = [choose_end(entry["RSm"], place) for place in (-1, 0)] if entry["RSm"] else []
    # Where their width is not known, the cut-off of the profile filter limits it.
    cutoff = entry["lambda_c"]
    if cutoff is None:
        largest_ra = factor * choose_end(height, -1) / texture.RQ_OVER_RA
        cutoff = texture.standard_cutoff(largest_ra, *widths[:1])
    spacing = widths[end] if widths else texture.RSM_OVER_CUTOFF[end] * cutoff
    return SelfAffine(
        hurst=texture.HURST[end],
        q0=2 * np.pi / cutoff,
        q_rolloff=2 * np.pi * texture.RSM_OVER_ROLLOFF[end] / spacing,
        q1=2 * np.pi / entry["shortest_wavelength"],
        h_rms=texture.HEIGHT_OVER_RQ[end] * factor * choose_end(height, end),
    )


def choose_end(value: float | Sequence[float], end: int) -> float:
    """One end, 0 or -1, of a value or of a range [low, high]."""
    return value[end] if isinstance(value, Sequence) else value
