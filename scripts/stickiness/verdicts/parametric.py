"""Surfaces that are described by parameters: of a spectrum, or of profiles on a drawing."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr

from stickiness import datasets
from stickiness.error_budget import SOURCES, not_applicable, with_budget
from stickiness.measured import texture
from stickiness.spectrum.interface import Spectrum
from stickiness.spectrum.kinds import SelfAffine, Tabulated
from stickiness.verdicts.surface_variables import SURFACE_VARIABLES

ENDS = ("smooth", "rough")  #: of what is known of a surface
END_QUANTILES = (0.16, 0.84)  #: of draws, one standard error either side: smooth and rough end
MOMENTS = ("h_rms", "rms_slope", "rms_curvature")
REFERENCE_HURST = 0.8  #: of the paper's lines C0 = 1e-3 and 1e-5 m^0.4
POINTS_PER_DECADE = 10  #: at which spectra are tabulated


def tabulate_ends(
    smooth: Spectrum, rough: Spectrum, hurst: float | None = None, C0: Sequence[float] | None = None
) -> xr.Dataset:
    """Describe a surface between two spectra: their moments, and C(q) on common wave numbers.

    `hurst` and `C0` (of both ends) are stored if they are known.
    """
    spectra = (smooth, rough)
    q = _choose_wave_numbers(smooth)
    # The highest line of the reference exponent that touches the spectrum.
    line = [(s.psd(q) * q ** (2 * REFERENCE_HURST + 2)).max() for s in spectra]
    tabulated: dict[str, Any] = {
        "psd": (("end", "wave_number"), [s.psd(q) for s in spectra]),
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


def describe_variables(dataset: xr.Dataset) -> xr.Dataset:
    """Give every variable of a surface its unit and description."""
    of_line = f"m^{2 - 2 * REFERENCE_HURST:g}"
    hurst = float(dataset.hurst) if "hurst" in dataset else REFERENCE_HURST
    texts = SURFACE_VARIABLES | {
        "C0": (f"m^{2 - 2 * hurst:.4g}", "prefactor of C = C0 q^(-2(H+1))"),
        "C0_reference": (of_line, f"prefactor of the line fitted at H = {REFERENCE_HURST}"),
        "C0_reference_upper": (of_line, f"largest C q^(2(H+1)) at H = {REFERENCE_HURST}"),
    }
    for name in MOMENTS + ("elastic_energy",):
        unit, description = SURFACE_VARIABLES[name]
        texts[f"{name}_draws"] = (unit, f"{description}, of every draw")
    present = {name: texts[name] for name in texts if name in dataset.variables}
    dataset = datasets.annotate(dataset, **present)
    dataset.psd.attrs["comment"] = "h_rms^2 = 2 pi int q C dq"
    return dataset


def _choose_wave_numbers(spectrum: Spectrum) -> np.ndarray:
    """Wave numbers [1/m] on which a spectrum is tabulated."""
    points = int(np.ceil(POINTS_PER_DECADE * np.log10(spectrum.magnification))) + 2
    q = np.geomspace(spectrum.q0, spectrum.q1, points)
    if isinstance(spectrum, SelfAffine):
        return q
    # Tabulated spectra may have kinks anywhere.
    return np.unique(np.concatenate([q[1:-1], spectrum.knots]))


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
