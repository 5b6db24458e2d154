"""What measurements tell of a surface: its spectrum, moments and draws, with their errors.

Measurements are stitched to one spectrum, to which a self-affine law is fitted. Spectra are drawn
that agree with the measured one within its errors, and that contain waves which the instrument does
not resolve. Doubts about the data forbid a verdict, unless the user insists on one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import xarray as xr

from stickiness.error_budget import SOURCES, ErrorComponent, not_applicable, with_budget
from stickiness.measured import stitching
from stickiness.measured.doubts import doubt_fit, doubt_pattern
from stickiness.measured.instrument_spectrum import Cutoff, MeasuredSpectrum
from stickiness.measured.measurement import Measurement, find_spectra
from stickiness.measured.self_affine_fit import SelfAffineFit
from stickiness.measured.topography import DROP_RIMS, MASK_SPIKES, Profile, Topography
from stickiness.plausibility import PLAUSIBLE
from stickiness.remaining.height_shape import find_shape_of
from stickiness.remaining.uneven_roughness import find_unevenness
from stickiness.spectrum.direction import find_ratio
from stickiness.statistics import COVERS, measure_shape
from stickiness.verdicts.simulated_surface import simulate_surface
from stickiness.verdicts.surface_data import (
    END_QUANTILES,
    ENDS,
    POINTS_PER_DECADE,
    REFERENCE_HURST,
    describe_variables,
    find_moments,
    tabulate_family,
)

DRAWS = 200  #: spectra that are drawn
SEED = 1  #: of the draws
PICTURE_POINTS = 400  #: along a side of the picture of the heights that is kept
READING_POINTS = 100  #: along a side of the picture of the heights as read
FEWEST_STEPS = 2  #: of the grid, over which a slope is taken: half of the shortest wave fitted
ROUNDED = 0.01  #: relative, by which the end of waves may miss the cutoff that it was read from
LEAST_BEYOND = 1e-6  #: relative, beyond the cutoff, at which waves end that are told to end there
LEFT_OUT = "left out of the spectrum"


def analyse(
    measurements: Sequence[Measurement],
    *,
    extend_to: float | None = None,
    ignore_doubts: bool = False,
) -> xr.Dataset:
    """Analyse measurements of one surface.

    Parameters
    ----------
    measurements : sequence of Measurement
        Levelled heights, lengths in m.
    extend_to : float, optional
        Wavelength [m] down to which the fitted law extrapolates the spectrum. By default it goes on
        to an unknown end, which widens the limits of verdicts.
    ignore_doubts : bool
        Judge implausible data, too.

    Returns
    -------
    Dataset
        Variables of `surface_data.SURFACE_VARIABLES`. Its attribute `not_judged` lists, a line
        each, why no verdict should rest on the data; it is empty if one may.
    """
    heights = [measurement.heights for measurement in measurements]
    analysed = find_spectra(measurements)
    spectrum = stitching.stitch([each for each, _ in analysed])
    fit = spectrum.fit
    unfitted = [doubt for _, doubt in analysed if doubt]
    is_fitted = len(unfitted) < len(analysed)

    # Doubts: heights that no instrument measures, of which most other doubts follow; no fit, or a
    # fit that no surface has.
    is_end_told = extend_to is not None
    doubts = [doubt for each in heights for doubt in each.doubts]
    about_fit = list(doubt_fit(fit, is_end_told)) if is_fitted else unfitted
    if about_fit:
        doubts += _find_features(heights) or _find_patterns(heights) or about_fit
    not_judged = [] if ignore_doubts else doubts

    # Without a fit there is no law that goes on.
    q_extended = 2 * np.pi / extend_to if is_end_told and is_fitted else None
    if q_extended is not None and q_extended > (1 - ROUNDED) * spectrum.cutoff.q:
        q_extended = max(q_extended, (1 + LEAST_BEYOND) * spectrum.cutoff.q)
    end_of_grid = np.pi / max(heights[0].steps)
    if q_extended is not None and q_extended <= end_of_grid * (1 + 1e-9):
        # Whoever tells that the waves end within the grid says that the heights hold all of them.
        spectrum = replace(spectrum, held=Cutoff(end_of_grid, "as given (extend_to)"))

    # Spectra that agree with the measured one, with waves that the instrument does not resolve.
    draws = stitching.draw(
        spectrum,
        DRAWS,
        SEED,
        extend_to=q_extended,
        continue_to=2 * np.pi / stitching.SHORTEST_WAVE,
        steepest=PLAUSIBLE["rms_slope"].usual,
    )
    dataset = _tabulate(heights, spectrum, draws, q_extended)

    # Contact on the heights themselves.
    simulated = None if not_judged else simulate_surface(measurements, spectrum)
    if simulated is not None:
        dataset = dataset.merge(simulated)
    dataset = _add_budgets(describe_variables(dataset), fit)
    ignored = doubts if ignore_doubts else []
    remarks = [
        *(f"{LEFT_OUT}: {doubt}" for doubt in unfitted if is_fitted),
        *(f"judged all the same (plausibility: ignore): {doubt}" for doubt in ignored),
        *(remark for each in heights for remark in each.remarks),
        *([] if doubts or q_extended is not None else _remark_on_exponent(fit)),
    ]
    return dataset.assign_attrs(
        remarks="\n".join(remarks),
        cutoff=spectrum.cutoff.reason,
        **_describe_files(heights),
        not_judged="\n".join(not_judged),
    )


def _tabulate(
    heights: Sequence[Topography | Profile],
    spectrum: MeasuredSpectrum,
    draws: stitching.Draws,
    q_extended: float | None,
) -> xr.Dataset:
    """Variables of the spectrum, its draws and the heights."""
    return xr.merge(
        [
            _tabulate_spectrum(spectrum, draws.continuation, q_extended),
            _thin_picture(heights[0]),
            _thin_reading(heights[0]),
            _describe_fit(spectrum, q_extended),
            _describe_heights(heights, spectrum),
            _tabulate_draws(draws, spectrum.cutoff.q if q_extended is None else q_extended),
            _compare_measurements(spectrum),
            _outline_feature(heights[0]),
        ]
    )


def _describe_files(heights: Sequence[Topography | Profile]) -> dict[str, str]:
    """Which files hold the heights, what was done to these, and what else the files say."""
    return {
        "files": "; ".join(each.source for each in heights),
        "steps": "\n".join(filter(None, (each.tell_steps() for each in heights))),
        "contradictions": "\n".join(line for each in heights for line in each.contradictions),
        "choices": "\n".join(
            f"{each.source} | {', '.join(each.others)}" for each in heights if each.others
        ),
    }


def _remark_on_exponent(fit: SelfAffineFit) -> list[str]:
    """Say that the spectrum does not continue with the fitted exponent; nothing if it does."""
    low, high = stitching.HURST_BEYOND
    if low - COVERS * fit.hurst_se <= fit.hurst <= high + COVERS * fit.hurst_se:
        return []
    return [
        f"the fitted H = {fit.hurst:.2f} is outside {low:g} to {high:g}: waves that are not "
        "resolved continue the last octave with an exponent within these bounds"
    ]


def _find_features(heights: Sequence[Topography | Profile]) -> list[str]:
    """Doubts about features that decide the spectrum of a map, so that it has no such fit."""
    return [
        f"{each.source}: {each.feature}, and no spectrum of random roughness fits; "
        + (
            "give features: beside for the surface elsewhere"
            if each.guesses
            else "map a larger part"
        )
        for each in heights
        if each.feature is not None
    ]


def _find_patterns(heights: Sequence[Topography | Profile]) -> list[str]:
    """Doubts about periodic patterns: they have no such fit either, but a period."""
    return [
        doubt
        for each in heights
        for doubt in doubt_pattern(each.source, each.heights, sides=each.size)
    ]


def _tabulate_spectrum(
    spectrum: MeasuredSpectrum, continuation: stitching.Continuation, q_extended: float | None
) -> xr.Dataset:
    """Measured and fitted spectrum at both ends; continued to `q_extended` [1/m]."""
    fit = spectrum.fit
    rings = spectrum.rings
    q = rings.q
    error = rings.standard_error
    psd = [rings.psd, rings.psd]
    if isinstance(spectrum, stitching.Stitched):
        # In gaps between the measurements both ends are one standard error apart from the middle.
        spread = np.where(spectrum.in_gap, 1 / np.sqrt(rings.dof), 0.0)
        psd = [rings.psd * np.exp(sign * spread) for sign in (-1, 1)]
    if q_extended is not None:
        top = spectrum.cutoff.q
        inside = q <= top * (1 + 1e-9)
        count = int(np.ceil(np.log10(q_extended / top) * POINTS_PER_DECADE)) + 1
        beyond = np.geomspace(top, q_extended, count)[0 if q[inside][-1] < top * 0.99 else 1 :]
        q = np.append(q[inside], beyond)
        continued = continuation.psd(beyond)
        ends = np.quantile(continued, END_QUANTILES, axis=0)
        psd = [
            np.append(of_rings[inside], of_law) for of_rings, of_law in zip(psd, ends, strict=True)
        ]
        error = np.append(error[inside], continued.std(axis=0))
    fitted = (q >= fit.q_min * (1 - 1e-9)) & (q <= fit.q_max * (1 + 1e-9))
    return xr.Dataset(
        {
            "psd": (("end", "wave_number"), psd),
            "psd_standard_error": ("wave_number", error),
            "psd_fit": ("wave_number", fit.psd(q)),
            "fitted": ("wave_number", fitted.astype("i1")),
        },
        coords={"end": list(ENDS), "wave_number": q},
    )


def _thin_picture(heights: Topography | Profile) -> xr.DataArray:
    """Levelled heights, thinned to what a picture shows."""
    picture = heights.to_xarray()
    if picture.ndim == 1:
        return picture.rename("profile")
    thin = max(1, *(n // PICTURE_POINTS for n in picture.shape))
    return picture[::thin, ::thin].astype("f4").rename("heights")


def _thin_reading(heights: Topography | Profile) -> xr.Dataset:
    """Heights of a map before anything was done to them, and what is not used, thinned."""
    if heights.heights.ndim == 1 or heights.as_read is None:
        return xr.Dataset()
    thin = max(1, -(-max(heights.as_read.shape) // READING_POINTS))
    # One unused point in a block is shown.
    unused = xr.DataArray(heights.unused, dims=("x_read", "y_read"))
    unused = unused.coarsen(x_read=thin, y_read=thin, boundary="pad").max()
    picture = heights.as_read[::thin, ::thin].astype("f4")
    return xr.Dataset({"heights_as_read": (unused.dims, picture), "unused": unused.astype("i1")})


def _outline_feature(heights: Topography | Profile) -> xr.Dataset:
    """Corners of the feature that decides the energy of a map; nothing of others."""
    if heights.feature is None:
        return xr.Dataset()
    return xr.Dataset({"feature_outline": (("corner", "axis"), list(heights.feature.outline))})


def _describe_fit(spectrum: MeasuredSpectrum, q_extended: float | None) -> xr.Dataset:
    """Parameters of the fitted law, and the band of the spectrum."""
    fit = spectrum.fit
    cutoff = spectrum.cutoff
    line, _, upper = fit.c0_at_hurst(REFERENCE_HURST)
    dataset = xr.Dataset(
        {
            "C0": ("end", fit.c0 * np.ones(2)),
            "C0_relative_error": fit.c0_se / fit.c0,
            "C0_reference": line,
            "C0_reference_upper": ("end", [upper, upper]),
            "hurst": fit.hurst,
            "misfit": fit.misfit,
            "scan": 2 * np.pi / spectrum.lowest,
            "contact": 2 * np.pi / spectrum.lowest,
            "q_fitted": fit.q_min,
            "q0": fit.q_rolloff or spectrum.lowest,
            "q1": cutoff.q if q_extended is None else q_extended,
            "q_cutoff": cutoff.q,
            "cutoff_detected": int(cutoff.detected),
        }
    )
    if fit.q_rolloff is not None:
        dataset["q_rolloff"] = fit.q_rolloff
    if np.isfinite(spectrum.anisotropy):
        dataset["anisotropy"] = spectrum.anisotropy
        dataset["axis_ratio"] = find_ratio(spectrum.anisotropy, fit.hurst)
    return dataset


def _describe_heights(
    every: Sequence[Topography | Profile], spectrum: MeasuredSpectrum
) -> xr.Dataset:
    """Parameters of the first heights, the shape of the highest, and what is missing of all."""
    first = every[0]
    skewness, kurtosis = measure_shape(first.heights)
    # The largest rms height is that of the longest waves, whose shape decides.
    highest = max(every, key=lambda heights: heights.h_rms)
    shape = find_shape_of(highest.heights)
    half_wave = np.pi / spectrum.fit.q_max
    lags = [max(round(half_wave / step), FEWEST_STEPS) for step in highest.steps]
    return xr.Dataset(
        {
            "h_rms_measured": first.h_rms,
            "mean_deviation": np.mean(np.abs(first.heights)),  # levelled heights have no mean
            "height_range": np.ptp(first.heights),
            "skewness": skewness,
            "kurtosis": kurtosis,
            "shape": shape.shape,
            "shape_error": shape.error,
            "unevenness": find_unevenness(highest.heights, lags),
            "h_rms_as_read": first.h_rms_as_read(),
            "missing_fraction": max(heights.missing_fraction for heights in every),
            "dropped_points": sum(heights.count(DROP_RIMS) for heights in every),
            "masked_spikes": sum(heights.count(MASK_SPIKES) for heights in every),
            "cropped_fraction": max(heights.cropped_fraction for heights in every),
        }
    )


def _tabulate_draws(draws: stitching.Draws, q1: float) -> xr.Dataset:
    """The spectra drawn, and both ends of their moments."""
    return xr.Dataset(
        {
            **tabulate_family(draws.family),
            **find_moments(draws.family, q1),
            "unresolved_energy": ("end", np.quantile(draws.unresolved, END_QUANTILES)),
            "held_energy": ("draw", draws.held_energy),
            "drawn_q0": ("draw", draws.q0),
            "drawn_hurst": ("draw", draws.hurst),
            "drawn_first_psd": ("draw", draws.first_psd),
        }
    ).set_coords(["draw", "ring"])


def _compare_measurements(spectrum: MeasuredSpectrum) -> xr.Dataset:
    """Spectrum of every measurement, and how far they differ; nothing of one measurement."""
    if not isinstance(spectrum, stitching.Stitched):
        return xr.Dataset()
    places = {
        "measurement": np.arange(len(spectrum.levels)),
        "wave_number_measured": spectrum.rings.q,
    }
    compared = {
        "psd_measurement": (tuple(places), spectrum.levels),
        "offset": ("measurement", spectrum.offsets),
        "is_used": ("measurement", spectrum.shares.any(axis=1).astype("i1")),
        "scatter": spectrum.scatter,
    }
    if spectrum.gaps:
        compared["gap"] = (("gap_between", "side"), [gap.inside for gap in spectrum.gaps])
    return xr.Dataset(compared, coords=places)


def _add_budgets(dataset: xr.Dataset, fit: SelfAffineFit) -> xr.Dataset:
    """Add error budgets from the standard errors of what was fitted."""
    _, reference_error, _ = fit.c0_at_hurst(REFERENCE_HURST)
    errors = {"hurst": fit.hurst_se, "C0_reference": reference_error}
    if fit.q_rolloff is not None:
        errors["q_rolloff"] = fit.q_rolloff_se
    sources = dict.fromkeys(SOURCES, not_applicable("of the band that was fitted"))
    sources["model"] = not_applicable("the law is what is quoted; its misfit stands beside")
    for name, error in errors.items():
        sources["sampling"] = ErrorComponent(COVERS * error, "of the spectrum measured")
        dataset = with_budget(dataset, name, **sources)
    return dataset
