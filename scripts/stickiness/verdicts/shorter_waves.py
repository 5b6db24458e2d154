"""Waves shorter than a contact, which is smaller than what is known of a surface.

Waves longer than the contact of a ball only tilt, shift and curve the surface below it. So they are
taken out, of both ends and of every draw. Their curvature is kept, for it makes the ball act as a
larger or a smaller one.

Spectra of draws are not kept: the waves that the instrument resolves are taken out of every draw by
the share that they have in both ends, and those beyond by the law that every draw goes on with.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from stickiness.spectrum.direction import expm1_over
from stickiness.spectrum.interface import Spectrum
from stickiness.spectrum.kinds import Shells
from stickiness.verdicts.parametric import END_QUANTILES, read_ends

LEAST = 1e-12  #: share of a variance that is left where no wave is: such a surface is smooth
#: Variables by the power of q in their variance.
ORDERS = {"h_rms": 0, "elastic_energy": 1, "rms_slope": 2, "rms_curvature": 4}


def shorten(data: xr.Dataset, q: float) -> xr.Dataset:
    """Take the waves below a wave number out of what is known of a surface.

    Parameters
    ----------
    data : Dataset
        Variables of `surface_variables.SURFACE_VARIABLES`, with a spectrum that has a density.
    q : float
        Wave number [1/m] above the lowest of the spectrum.

    Returns
    -------
    Dataset
        The same variables for the waves that are left, and their `lost_curvature`: the rms mean
        curvature of those taken out [1/m], at both ends and of every draw.
    """
    resolved = read_ends(data, highest=float(data.get("q_cutoff", data.q1)))
    changed: dict[str, object] = {}
    last = q1 = float(data.q1)
    if "draw" in data.dims:
        of_draws = _shorten_draws(data, resolved, q)
        at_ends = {name: np.quantile(drawn, END_QUANTILES) for name, drawn in of_draws.items()}
        changed["q0_draws"] = ("draw", np.maximum(data.q0_draws.values, q))
        changed |= {f"{name}_draws": ("draw", drawn) for name, drawn in of_draws.items()}
        last = float(np.median(data.beyond_end_draws.values))
    else:
        at_ends = _shorten_ends(data, resolved, q)
    changed |= {name: ("end", moment) for name, moment in at_ends.items()}
    kept_energy = float(np.mean(at_ends["elastic_energy"] / data.elastic_energy.values))

    # The shape of the heights is mostly that of the waves that hold their energy.
    if "shape" in data:
        shape = float(data["shape"])
        lost_shape = shape * (1 - min(kept_energy, 1.0)) / 2
        changed["shape"] = shape - lost_shape
        changed["shape_error"] = np.hypot(float(data.shape_error), lost_shape)
    # States simulated on the heights have all waves.
    data = data.drop_vars("trial_energy", errors="ignore")
    if q >= q1:
        q1 = max(q1, last)
    changed |= {"q0": max(float(data.q0), q), "q1": q1}
    return _cut_spectrum(data, q).assign(changed)


def _find_kept(spectrum: Spectrum, q: float, order: int) -> float:
    """Share of a variance in the waves from q on; at least `LEAST`."""
    low, high = spectrum.band
    if q >= high:
        return LEAST
    above = float(spectrum.variance_above(max(q, low), order))
    return max(above / spectrum.total_variance(order), LEAST)


def _find_lost_curvature(spectrum: Spectrum, q: float) -> float:
    """Rms mean curvature, half of the Laplacian, of the waves below q."""
    low, high = spectrum.band
    return float(np.sqrt(spectrum.variance_below(np.clip(q, low, high), 4))) / 2


def _shorten_ends(data: xr.Dataset, resolved: Sequence[Spectrum], q: float) -> dict[str, NDArray]:
    """Moments of both ends from q on, and the curvature that is lost."""
    moments = {}
    for name, order in ORDERS.items():
        kept = np.array([_find_kept(spectrum, q, order) for spectrum in resolved])
        moments[name] = data[name].values * (kept if order == 1 else np.sqrt(kept))
    moments["lost_curvature"] = np.array([_find_lost_curvature(each, q) for each in resolved])
    return moments


def _shorten_draws(data: xr.Dataset, resolved: Sequence[Spectrum], q: float) -> dict[str, NDArray]:
    """Moments of every draw from q on, and the curvature that is lost."""
    energy = data.elastic_energy_draws.values
    of_scan = energy
    if "longer_energy_draws" in data:
        of_scan = energy / (1 + data.longer_energy_draws.values)
    beyond = data.beyond_energy_draws.values
    beyond_energy = of_scan * beyond / (1 + beyond)

    def integrate(order: int, low: float) -> NDArray:
        """Variance of unresolved waves of every draw from a wave number on."""
        cutoff = float(data.q_cutoff)
        start = max(low, cutoff)
        exponent = order - 2 * data.beyond_hurst_draws.values
        octaves = np.log(np.maximum(data.beyond_end_draws.values / start, 1.0))
        of_start = start**order * (start / cutoff) ** (exponent - order)
        return of_start * expm1_over(exponent, octaves)

    whole = integrate(1, 0.0)
    level = np.where(whole > 0, 4 * beyond_energy / np.where(whole > 0, whole, 1.0), 0.0)
    moments = {}
    for name, order in ORDERS.items():
        kept = np.mean([_find_kept(spectrum, q, order) for spectrum in resolved])
        unresolved = level * integrate(order, q)
        if order == 1:
            moments[name] = kept * (energy - beyond_energy) + unresolved / 4
        else:
            moments[name] = np.sqrt(kept * data[f"{name}_draws"].values ** 2 + unresolved)
    lost = np.mean([_find_lost_curvature(spectrum, q) ** 2 for spectrum in resolved])
    of_beyond = level * (integrate(4, 0.0) - integrate(4, q)) / 4
    moments["lost_curvature"] = np.sqrt(lost + np.maximum(of_beyond, 0.0))
    return moments


def _cut_spectrum(data: xr.Dataset, q: float) -> xr.Dataset:
    """Spectra of both ends from q on; nearly nothing where they end before."""
    known = data.wave_number.values
    kept = known[known > q * (1 + 1e-9)]
    if kept.size == 0:
        last = data[["psd"]].isel(wave_number=slice(-2, None)) * LEAST
        return data.drop_dims("wave_number").merge(last)
    first, second = np.searchsorted(known, q) + np.array([-1, 0])
    place = np.log(q / known[first]) / np.log(known[second] / known[first])
    ends = data.psd.transpose("end", "wave_number").values[:, [first, second]]
    at_q = ends[:, 0] ** (1 - place) * ends[:, 1] ** place
    beyond = data.psd.transpose("end", "wave_number").sel(wave_number=kept).values
    psd = np.concatenate([at_q[:, None], beyond], axis=1)
    return (
        data.drop_dims("wave_number")
        .assign(psd=(("end", "wave_number"), psd))
        .assign_coords(wave_number=np.append(q, kept))
    )


def shorten_shells(shells: Spectrum, q: float) -> tuple[Shells, float]:
    """Shells from a wave number on, and the rms mean curvature of the others [1/m]."""
    kept = shells.q >= q
    lost = np.sqrt(np.sum(shells.variance[~kept] * shells.q[~kept] ** 4)) / 2
    if not kept.any():
        return Shells(shells.q[-1:], LEAST * shells.variance[-1:], shells.anisotropy), float(lost)
    return Shells(shells.q[kept], shells.variance[kept], shells.anisotropy), float(lost)
