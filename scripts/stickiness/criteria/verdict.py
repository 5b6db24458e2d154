"""From a rough surface and a material to a verdict on whether they stick."""

from __future__ import annotations

import warnings
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from stickiness import __version__
from stickiness.arguments import number, positive
from stickiness.criteria.a_v_table import RANGES, surface_a_v
from stickiness.criteria.pair import LIMITED, MOST_STRAIN, REGIMES, WORDS, Pair, decide, judge
from stickiness.criteria.registry import CRITERIA, EDGES, REMAINING
from stickiness.plausibility import PlausibilityWarning, warn_of_si
from stickiness.remaining import prediction
from stickiness.remaining.prediction import DEFAULT_SHARE, PULL_OFF_UNKNOWN
from stickiness.solids import HALF_SPACE, Layer, Solid
from stickiness.spectrum.direction import find_ratio
from stickiness.spectrum.interface import Spectrum
from stickiness.traction_laws import EXPONENTIAL

_DRAWS = 20  # of spectra that agree with heights


@dataclass(frozen=True)
class StickinessVerdict:
    """Answer for one material on one surface; every pair of limits is (low, high)."""

    #: One of `WORDS`: "depends" if the wanted share lies within the limits of what remains,
    #: "adheres locally, does not hold" if contact grows by itself at the finest wave but less than
    #: the wanted share remains, "sticks fully" if at least `pair.FULL_SHARE` does.
    word: str
    remaining: float  #: share of the work of adhesion that remains on the rough surface
    remaining_limits: tuple[float, float]
    pull_off: float  #: largest mean tension on separation [Pa]
    pull_off_limits: tuple[float, float]
    #: Adhesion length over the one at which the wanted share remains; sticks above 1. Margin and
    #: threshold have the same relative errors.
    margin: float
    margin_limits: tuple[float, float]
    modulus_threshold: float  #: plane-strain modulus below which the wanted share remains [Pa]
    modulus_threshold_limits: tuple[float, float]
    separation_factor: float  #: on the work of separation, included in what remains
    separation_factor_limits: tuple[float, float]
    poisson: float | None  #: given with Young's modulus, which the printed verdict then tells
    regime: str  #: one of `REGIMES`, by the Tabor parameter of the contact edges
    simulated: bool  #: whether full simulation covers the state of the edges
    a_v: float  #: a_V of the pair
    a_v_limits: tuple[float, float]
    margins: dict[str, float]  #: by every criterion of `registry.CRITERIA`; sticky above 1
    pair: Pair  #: the surface and the material, in SI units
    doubts: tuple[str, ...]  #: why the answer is probably to another question
    spectrum: Spectrum = field(repr=False)  #: of the surface

    def to_dict(self) -> dict[str, Any]:
        """Return the effective attraction for DEM and FE models, in SI units and ready for JSON."""
        remaining = self.remaining, *self.remaining_limits
        pull_off = self.pull_off, *self.pull_off_limits
        ratio = self.pair.adhesion_length / self.pair.elastic_energy
        found = describe_contact_law(self.word, self.pair, remaining, pull_off, ratio)
        return {"version": __version__, **found}

    def __str__(self) -> str:
        pair = self.pair
        low, high = self.remaining_limits
        least, most = self.pull_off_limits
        pull_off = f"{self.pull_off:.2g} Pa ({least:.2g} to {most:.2g} Pa)"
        if pair.adhesion_length > PULL_OFF_UNKNOWN * pair.elastic_energy:
            pull_off = f"at least {least:.2g} Pa (full contact, which was not simulated)"
        name, factor = ("E*", 1e-6) if self.poisson is None else ("E", 1e-6 * (1 - self.poisson**2))
        moduli = self.modulus_threshold, *self.modulus_threshold_limits, pair.modulus
        modulus, least_modulus, most_modulus, given = (f"{factor * x:.3g}" for x in moduli)
        strain = (
            f"conforming strains the layer by about {pair.layer_strain:.2g}, beyond linear "
            "elasticity: all adhesion may be lost\n"
        )
        beyond = "" if self.simulated else " (beyond what was simulated)"
        others = [f"{CRITERIA[n].label} {x:.3g}" for n, x in self.margins.items() if n != REMAINING]
        direction = (
            f"the errors of what remains are multiplied by {pair.anisotropy_error_factor:.3g}: "
            "few surfaces with a direction were simulated\n"
        )
        more = f", separation factor {self.separation_factor:.3g}"
        return "".join(f"warning: {doubt}\n" for doubt in self.doubts) + (
            f"{self.word}: {self.remaining:.2g} of the work of adhesion remains "
            f"({low:.2g} to {high:.2g}); {pair.wanted_share:g} is wanted\n"
            f"pull-off stress: {pull_off}\n"
            f"sticks below {name} = {modulus} MPa ({least_modulus} to {most_modulus} MPa); it is "
            f"{given} MPa\n"
            f"{strain if pair.layer_strain > MOST_STRAIN else ''}"
            f"edges at the finest wave: {self.regime}{beyond}\n"
            f"a_V = {self.a_v:.3g} ({self.a_v_limits[0]:.3g} to {self.a_v_limits[1]:.3g})\n"
            f"margins by other criteria: {'; '.join(others)}\n"
            f"{direction if pair.anisotropy_error_factor > 1 else ''}"
            f"given: E* = {pair.modulus:.3g} Pa, work of adhesion "
            f"{pair.work_of_adhesion:.3g} J/m^2, range {pair.range:.3g} m, {pair.law} law, "
            f"h_rms = {pair.h_rms:.3g} m, longest wave {2 * np.pi / pair.q0:.3g} m"
            f"{f', pressed by {pair.pressed:.3g} Pa' if pair.pressed else ''}"
            f"{more if self.separation_factor != 1 else ''}"
        )


def verdict(
    surface: Spectrum | ArrayLike,
    *,
    modulus: float,
    work_of_adhesion: float,
    range: float,
    poisson: float | None = None,
    length: float | tuple[float, float] | None = None,
    a_v: tuple[float, float, float] | None = None,
    wanted_share: float = DEFAULT_SHARE,
    solid: Solid = HALF_SPACE,
    law: str = EXPONENTIAL,
    pressed: float = 0.0,
    separation_factor: tuple[float, float, float] = (1.0, 1.0, 1.0),
) -> StickinessVerdict:
    """Say whether a material sticks to a rough surface.

    Parameters
    ----------
    surface : Spectrum or (nx, ny) array
        Spectrum, or measured heights [m]; lengths in m. Heights are levelled, and waves beyond
        the resolution are left out, as `stickiness.measured` does.
    modulus : float
        Young's modulus [Pa], or the plane-strain modulus E* if `poisson` is not given.
    work_of_adhesion : float
        [J/m^2].
    range : float
        Range of the attraction [m].
    poisson : float, optional
        Poisson's ratio; then E* = modulus/(1 - poisson^2).
    length : float or pair of floats
        Sides [m] of measured heights; only with these.
    a_v : (value, low, high), optional
        a_V of the pair with its limits. By default Persson's theory on the spectrum gives it, and
        two variants of the theory and Pastewka and Robbins' estimate give its limits, widened by
        `THEORY_ERROR`.
    wanted_share : float
        Share of the work of adhesion that must remain for a pair to stick, between 0 and 1.
    solid : HalfSpace or Layer
        Of the material, thickness in m; see `stickiness.solids`. It changes what remains. Other
        criteria than that and Persson-Tosatti's take a half-space.
    law : str
        As of `predict`, for what remains. The other criteria know the range alone.
    pressed : float
        Mean pressure [Pa] before separation, for the high limit of the pull-off; see `predict`.
    separation_factor : (value, low, high), optional
        On the work of separation, so that more than 1 may remain. After a dwell, `modulus` is the
        relaxation modulus; see `solids.moduli.Prony.separation_factor`.

    Returns
    -------
    StickinessVerdict

    Raises
    ------
    ValueError
        If a number is not positive and finite, if `poisson` is not between -1 and 0.5, or if
        `length` is missing for heights or given for a spectrum.

    Warns
    -----
    PlausibilityWarning
        If the rms slope exceeds 1, if a value is none that real pairs have in SI units, such as a
        modulus in MPa or a length of 2 for 2 mm, if heights have spikes or the like, or if waves
        that heights do not resolve decide. A spectrum has the waves that it is given.

    Examples
    --------
    >>> from stickiness.spectrum import SelfAffine
    >>> rough = SelfAffine(hurst=0.8, q0=6e4, q1=6e8, h_rms=1e-6)
    >>> verdict(rough, modulus=210e9, poisson=0.3, work_of_adhesion=0.1, range=3e-10).word
    'does not stick'
    """
    if not 0 < wanted_share < 1:
        raise ValueError(f"wanted_share must be between 0 and 1, got {wanted_share!r}")
    positive(modulus=modulus, work_of_adhesion=work_of_adhesion, range=range)
    pressed = number("pressed", pressed, zero=True)
    if isinstance(solid, Layer) and poisson != solid.poisson:
        raise ValueError(
            f"poisson = {poisson!r} must equal the layer's, {solid.poisson!r}: `modulus` is that "
            "of the layer"
        )
    if poisson is not None and not -1 < poisson <= 0.5:
        raise ValueError(f"poisson must be above -1 and at most 0.5, got {poisson!r}")
    material = {"modulus": modulus, "work_of_adhesion": work_of_adhesion, "range": range}
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", PlausibilityWarning)
        known = describe_surface(surface, length, solid)
        warn_of_si(**material, rms_slope=known["rms_slope"])
        if isinstance(solid, Layer):
            warn_of_si(thickness=solid.thickness)
    spectrum = known.pop("spectrum")
    if range > RANGES[-1] * known["h_rms"]:
        raise ValueError(
            f"range = {range:.3g} is more than {RANGES[-1]:g} times the rms height "
            f"{known['h_rms']:.3g}: for this attraction the surface is smooth"
        )
    for warning in caught:
        warnings.warn(warning.message, stacklevel=2)
    doubts = [one.message for one in caught if issubclass(one.category, PlausibilityWarning)]
    if a_v is None:
        a_v = surface_a_v(spectrum, known).at(range / known["h_rms"])
    limited = {"a_v": a_v, "separation_factor": separation_factor}
    for (name, given), three in zip(limited.items(), positive(**limited), strict=True):
        if three.shape != (3,) or not three[1] <= three[0] <= three[2]:
            raise ValueError(
                f"{name} must be (value, low, high) with low <= value <= high, got {given!r}"
            )
    value, low, high = map(float, a_v)
    if poisson is not None:
        material["modulus"] = modulus / (1 - poisson**2)
    known |= {"wanted_share": wanted_share, "separation_factor": separation_factor}
    known |= {"law": law, "pressed": pressed}
    pair = Pair(**known, **material, a_v=value)
    found = {name: quantity.item() for name, quantity in judge(pair).items()}
    margins = {name: float(criterion.margin(pair)) for name, criterion in CRITERIA.items()}
    limits = {f"{name}_limits": (found[f"{name}_low"], found[f"{name}_high"]) for name in LIMITED}
    grows = margins[EDGES] > 1
    return StickinessVerdict(
        word=WORDS[int(decide(*limits["remaining_limits"], grows, wanted_share))],
        **{name: found[name] for name in LIMITED},
        **limits,
        poisson=poisson,
        regime=REGIMES[found["regime"]],
        simulated=bool(found["simulated"]),
        a_v=value,
        a_v_limits=(low, high),
        margins=margins,
        pair=pair,
        doubts=tuple(map(str, doubts)),
        spectrum=spectrum,
    )


def describe_contact_law(
    word: str, given: Any, remaining: ArrayLike, pull_off: ArrayLike, energy_ratio: float
) -> dict[str, Any]:
    """Return a verdict and the effective attraction of a smooth surface, for DEM and FE models.

    `given` has properties of a `Pair`; `remaining` and `pull_off` are (value, low, high). What is
    not known is left out: all but the low limit of the pull-off where `energy_ratio`, the work of
    adhesion over the energy of full contact, is large.
    """
    stress = np.array(pull_off, dtype=float)
    if energy_ratio > PULL_OFF_UNKNOWN:
        stress[[0, 2]] = np.nan
    found = {
        "modulus": ("Pa", [given.modulus]),
        "work_of_adhesion": ("J/m^2", [given.work_of_adhesion]),
        "range": ("m", [given.range]),
        "effective_work_of_adhesion": ("J/m^2", given.work_of_adhesion * np.array(remaining)),
        "pull_off_stress": ("Pa", stress),
    }
    ends = "value", "low", "high"
    return {"verdict": word, "law": given.law} | {
        name: {end: float(x) for end, x in zip(ends, values, strict=False) if np.isfinite(x)}
        | {"unit": unit}
        for name, (unit, values) in found.items()
    }


def describe_surface(
    surface: Spectrum | ArrayLike, length: Any = None, solid: Solid = HALF_SPACE
) -> dict[str, Any]:
    """Return the `spectrum` of a surface, and its moments by the names of `Pair`.

    Parameters and errors are those of `verdict`.
    """
    if isinstance(surface, Spectrum):
        if length is not None:
            raise ValueError(f"length is of measured heights; a spectrum has none, got {length!r}")
        spectrum, q0, ratio = surface, surface.q_longest, surface.anisotropy
    else:
        spectrum, q0, ratio = analyse_heights(surface, length)
    return {
        "spectrum": spectrum,
        "q0": float(q0),
        "h_rms": spectrum.h_rms,
        "rms_slope": spectrum.rms_slope,
        "rms_curvature": spectrum.rms_curvature,
        "elastic_energy": spectrum.elastic_energy(solid),
        "relative_compliance": float(solid.factor(q0)),
        "film_response": prediction.find_film_response(spectrum, solid, q0),
        "layer_strain": solid.strain(spectrum.h_rms, q0),
        "half_space_energy": prediction.find_half_space_energy(spectrum, solid),
        "anisotropy_error_factor": prediction.find_anisotropy_error_factor(ratio),
    }


def analyse_heights(heights: ArrayLike, length: Any) -> tuple[Spectrum, float, float]:
    """Spectrum of measured heights, its longest waves and its ratio of correlation lengths."""
    # A verdict on a spectrum needs no reader of measured files.
    from stickiness.measured import instrument_spectrum, stitching
    from stickiness.measured.plausibility import doubt_heights
    from stickiness.measured.topography import Topography

    if length is None:
        raise ValueError("length is missing: the side of the measured heights in m")
    heights = np.asarray(heights, dtype=float)
    if heights.ndim != 2:
        raise ValueError(f"heights must be an (nx, ny) array, got the shape {heights.shape}")
    if np.ndim(length) == 0 and heights.shape[0] != heights.shape[1]:
        raise ValueError(
            f"length must be both sides of heights of the shape {heights.shape}, got {length!r}"
        )
    sides = np.broadcast_to(positive(length=length)[0], 2)
    for side in dict.fromkeys(map(float, sides)):
        warn_of_si(length=side)
    dx, dy = (float(side) / n for side, n in zip(sides, heights.shape, strict=True))
    measured = instrument_spectrum.analyse(
        Topography(heights, dx, dy, "heights").detrended("plane")
    )
    doubts = [*doubt_heights(heights, measured.fit)]
    finest = 2 * np.pi / stitching.SHORTEST_WAVE
    beyond = np.median(stitching.draw(measured, _DRAWS, 0, continue_to=finest).unresolved)
    if not doubts and beyond > stitching.MOST_UNRESOLVED:
        doubts = [
            "finer waves than those resolved decide: if the fitted law goes on to 0.3 nm, full "
            f"contact takes {1 + beyond:.2g} times the energy, and less remains than is said"
        ]
    for doubt in doubts:
        warnings.warn(f"heights: {doubt}", PlausibilityWarning, stacklevel=2)
    ratio = find_ratio(np.nan_to_num(measured.anisotropy), measured.fit.hurst)
    return measured.spectrum(), measured.fit.q_rolloff or measured.lowest, ratio
