"""Waves longer than a scan, which only a larger contact meets.

A scan holds no wave longer than its side. A larger contact does, and for H > 1/2 the longest waves
store most of the elastic energy. The fitted law goes on to longer waves, up to a roll-off beyond
which the spectrum is level. A roll-off that the fit shows stays where it is. Otherwise the odds are
even that the law goes on to the contact, and the place of a roll-off is spread evenly over the
orders of magnitude between the waves fitted and the contact. The rings of the scan below those
fitted tell which of these are likely.

The law also replaces the longest waves of the scan, those below the fit: levelling and taper change
them, and they are one sample of those that a larger contact meets. The share of the contact's area
that was measured keeps them.

The waves of a square of side L are a lattice of wave vectors with the step 2 pi/L. As an integral
over C they begin below that step, at `FIRST_WAVE` times it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from stickiness.formatting import amount, number
from stickiness.remaining.errors import LARGER
from stickiness.remaining.height_shape import HeightShape
from stickiness.spectrum.family import SpectrumFamily
from stickiness.statistics import COVERS
from stickiness.verdicts.simulated_surface import MOST_LONGER, find_simulated_shape
from stickiness.verdicts.surface_data import (
    END_QUANTILES,
    ENDS,
    describe_variables,
    find_moments,
    read_family,
    tabulate_family,
)

#: Places of the roll-off among which one is drawn, over the logarithm of wave numbers from twice
#: the lowest fitted (0) to the contact; from 1 on, half of them, the law goes on to the contact.
PLACES = np.minimum(np.linspace(0.0, 2.0, 201), 1.0)
FIRST_TOLD = 1.2  #: lowest ring over 2 pi/L that tells of the roll-off; levelling changes the first
#: Weight of these rings. Neighbours vary together in a tapered scan, so that their ratios are known
#: better than each: with the covariance of simulated rings, logarithms of the likelihood of a
#: roll-off at two waves of the scan differ by 1.5 to 1.9, with independent rings by 0.25 to 0.45.
#: With the weight 4 limits hold 88 % of 48 patches of surfaces whose law goes on, with 3 94 %.
TOLD_WEIGHT = 3.0
SEED = 4  #: of the roll-offs, and of the power of the longest waves
SCATTER_SEED = 5  #: of what a scan does not tell of a larger contact
RINGS = 20  #: per decade
TOLD_ERROR = 0.5  #: of ln of the work of adhesion, above which it is explained
#: Wave number over 2 pi/L from which integrals over C equal sums over the lattice of a square of
#: side L: 0.67 to 0.72 for energy and variance of self-affine spectra, H = 0.6 to 0.9.
FIRST_WAVE = 0.7


@dataclass(frozen=True)
class LongerWaves:
    """Spectra from the longest wave of a contact to those fitted in a scan, `n` draws in `m` rings.

    A contact has few of the longest waves: the power of a ring of nu independent waves is
    Gamma-distributed with the shape nu, as that of a periodogram.
    """

    q: NDArray  #: wave numbers of the rings [1/m], (m,)
    width: float  #: of a ring in ln q
    law: NDArray  #: C of the law in the rings [m^4], (n, m)
    power: NDArray  #: power of this contact over that of the law, (n, m)
    q0: NDArray  #: lowest wave number of the self-affine range [1/m], (n,)

    @classmethod
    def draw(cls, data: xr.Dataset, contact: float) -> LongerWaves:
        """Draw them from the laws fitted to a surface, for a contact of a side [m]."""
        rng = np.random.default_rng(SEED)
        of_contact = 2 * np.pi / contact
        fitted = float(data.q_fitted)

        # Rings between the first wave of the contact and those that are kept of the scan.
        first = FIRST_WAVE * of_contact
        whole_width = np.log(_find_kept(data) / first)
        count = int(np.ceil(RINGS * whole_width / np.log(10)))
        width = whole_width / count
        q = first * np.exp(width * (np.arange(count) + 0.5))

        # The law, level below the roll-off of every draw.
        level = data.drawn_first_psd.values[:, None]
        exponent = 2 * np.clip(data.drawn_hurst.values, 0.0, 1.0)[:, None] + 2
        if "q_rolloff" in data:
            q0 = data.drawn_q0.values
            corner = q0
            start = np.maximum(fitted, corner)
        else:
            place = PLACES[_draw_places(data, contact, rng)]
            q0 = _find_rolloff(data, contact, place)
            corner = q0 * FIRST_WAVE**place
            start = np.full(q0.shape, fitted)
        law = level * (np.maximum(q, corner[:, None]) / start[:, None]) ** -exponent

        # Half of the waves of a ring are independent, for heights are real.
        waves = np.pi * q**2 * width / of_contact**2
        power = rng.gamma(waves, size=law.shape) / waves
        return cls(q=q, width=width, law=law, power=power, q0=q0)

    @property
    def family(self) -> SpectrumFamily:
        """Spectra of this contact in the rings."""
        return SpectrumFamily(self.q, 2 * np.pi * self.width * self.q**2, self.law * self.power)


def _find_kept(data: xr.Dataset) -> float:
    """Wave number from which the area of the rings begins that the fit has [1/m]."""
    lowest = 2 * np.pi / float(data.scan)
    longer = data.ring.values < float(data.q_fitted) * (1 - 1e-9)
    area = data.ring_area.values[longer].sum() + lowest**2  # the first cell has no wave
    return max(np.sqrt(area / np.pi), FIRST_WAVE * lowest)


def _find_rolloff(data: xr.Dataset, contact: float, place: NDArray) -> NDArray:
    """Wave number of the roll-off [1/m] at places from 0, twice the fit's lowest, to 1."""
    top = 2 * float(data.q_fitted)
    return top * (2 * np.pi / contact / top) ** place


def _draw_places(data: xr.Dataset, contact: float, rng: np.random.Generator) -> NDArray:
    """Index of the place of the roll-off of every draw, by the likelihood of the scan's rings."""
    fitted = float(data.q_fitted)
    q = data.wave_number.values
    told = (q > FIRST_TOLD * 2 * np.pi / float(data.scan)) & (q < 2.2 * fitted)
    psd = data.psd.isel(end=0).values[told]
    dof = TOLD_WEIGHT * (psd / data.psd_standard_error.values[told]) ** 2
    corner = _find_rolloff(data, contact, PLACES) * FIRST_WAVE**PLACES
    rise = np.maximum(q[told], corner[:, None]) / fitted

    # Whittle's likelihood, as of the fit, for every draw and place.
    exponent = 2 * np.clip(data.drawn_hurst.values, 0.0, 1.0)[:, None, None] + 2
    ratio = psd / (data.drawn_first_psd.values[:, None, None] * rise**-exponent)
    log_likelihood = -np.sum(dof * (ratio - np.log(ratio)), axis=-1)
    likelihood = np.exp(log_likelihood - log_likelihood.max(axis=1, keepdims=True))
    share = np.cumsum(likelihood, axis=1)
    drawn = rng.uniform(size=len(share)) * share[:, -1]
    return np.minimum(np.sum(share < drawn[:, None], axis=1), PLACES.size - 1)


def lengthen(data: xr.Dataset, contact: float, error: float | None = None) -> xr.Dataset:
    """Add the waves that a larger contact meets to what is known of a measured surface.

    Parameters
    ----------
    data : Dataset
        Variables of `surface_data.SURFACE_VARIABLES` of a measured surface.
    contact : float
        Side of the contact [m], at least that of the scan.
    error : float, optional
        Error of ln of the work of adhesion by what the scan does not tell of the contact; by
        default that of `LARGER`.

    Returns
    -------
    Dataset
        The same variables for the larger contact. States simulated on the heights are left out if
        the longer waves hold much of its energy. `remarks` say why the scan tells little of the
        contact, if it does.

    Raises
    ------
    ValueError
        If the contact is smaller than the scan.
    """
    scan = float(data.scan)
    if not contact >= scan * (1 - 1e-9):
        raise ValueError(
            f"give contact as at least the side of the scan, {amount(scan, 'm')}, not as "
            f"{amount(contact, 'm')}; for a smaller contact, crop the heights"
        )
    if contact <= scan * (1 + 1e-9):
        return data

    # What is not measured of the contact follows the law.
    waves = LongerWaves.draw(data, contact)
    longer = waves.family
    measured = (scan / contact) ** 2
    of_scan = read_family(data)
    is_long = of_scan.q < float(data.q_fitted) * (1 - 1e-9)
    of_contact = SpectrumFamily(
        q=np.append(longer.q, of_scan.q),
        area=np.append(longer.area, of_scan.area),
        psd=np.append(
            (1 - measured) * longer.psd, np.where(is_long, measured, 1.0) * of_scan.psd, axis=1
        ),
    )
    energy = of_contact.energy()
    added = np.maximum(energy / of_scan.energy() - 1, 0.0)
    share = np.mean(added / (1 + added))

    # The shape of the heights, by simulation if there is one. Those of the longer waves are not
    # known: their shape is that of the scan's, or they are Gaussian.
    of_heights = HeightShape(float(data.shape), float(data.shape_error))
    of_scan_heights = find_simulated_shape(data) or of_heights
    shape = of_scan_heights.shape * (1 - share / 2)
    unlikeness = float(find_unlikeness(float(data.unevenness), shape))
    shape_error = np.hypot(of_scan_heights.error, of_scan_heights.shape * share / 2)

    # What the scan does not tell scatters the energy, for full contact bounds what remains.
    if error is None:
        error = float(LARGER.half_width(share, unlikeness))
    scatter = np.random.default_rng(SCATTER_SEED).normal(size=energy.size) / COVERS
    factor = np.exp(error * scatter)

    family = replace(of_contact, psd=factor[:, None] * of_contact.psd)
    changed = data.drop_dims("ring").assign(
        **tabulate_family(family),
        **find_moments(family, float(data.q1)),
        held_energy=("draw", factor * data.held_energy.values),
        drawn_q0=("draw", np.minimum(data.drawn_q0.values, waves.q0)),
        unresolved_energy=data.unresolved_energy * (1 - share),
        q0=np.minimum(float(data.q0), np.median(waves.q0)),
        shape=shape,
        shape_error=shape_error,
        contact=contact,
    )
    # The heights do not stand for a contact of which longer waves hold much of the energy.
    if np.quantile(added / (1 + added), END_QUANTILES[-1]) > MOST_LONGER:
        changed = changed.drop_vars("trial_energy", errors="ignore")
    remarks = (data.attrs.get("remarks", ""), _explain_error(data, contact / scan, error))
    changed = _prepend_spectrum(changed, waves, order=np.argsort(energy))
    return describe_variables(changed).assign_attrs(remarks="\n".join(filter(None, remarks)))


def _explain_error(data: xr.Dataset, ratio: float, error: float) -> str:
    """Say why a scan tells little of a contact `ratio` times as large; empty unless it does."""
    if error <= TOLD_ERROR:
        return ""
    factor = number(np.exp(error), 2)
    skewness = number(float(data.skewness), 2)
    unevenness = number(np.exp(float(data.unevenness)), 2)
    return (
        f"this scan may not stand for a contact {number(ratio, 2)} times as large, which may need "
        f"{factor} times more or less work of adhesion: the heights are unlike Gaussian ones of "
        f"even roughness (skewness {skewness}; the mean square slope of the quarters differs by a "
        f"factor of {unevenness} more than by chance)"
    )


def find_unlikeness(unevenness: ArrayLike, shape: ArrayLike) -> NDArray:
    """How unlike Gaussian heights of even roughness those of a scan are.

    `unevenness` is the scatter among its quarters, see `uneven_roughness`, and `shape` what the
    heights change, see `height_shape`; both are logarithms of factors on energies.
    """
    return np.hypot(unevenness, shape)


def _prepend_spectrum(data: xr.Dataset, waves: LongerWaves, order: NDArray) -> xr.Dataset:
    """Put these waves in the place of those below the fit, in the spectra of both ends.

    They are those of the draws at the same quantiles of the energy; `order` sorts these.
    """
    chosen = order[np.rint(np.multiply(END_QUANTILES, order.size - 1)).astype(int)]
    longer = xr.Dataset(
        {
            "psd": (("end", "wave_number"), waves.law[chosen]),
            "psd_standard_error": ("wave_number", np.std(waves.family.psd, axis=0)),
            "psd_fit": ("wave_number", np.median(waves.law, axis=0)),
            "fitted": ("wave_number", np.zeros(waves.q.size, "i1")),
        },
        coords={"end": list(ENDS), "wave_number": waves.q},
    )
    kept = data[list(longer)].sel(wave_number=slice(waves.q[-1] * (1 + 1e-9), None))
    joined = xr.concat([longer, kept], dim="wave_number")
    return data.drop_dims("wave_number").merge(joined.transpose("end", ...))
