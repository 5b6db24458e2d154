"""Adhesion that remains on a rough surface, predicted from its spectrum, with limits."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import Self

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import elementwise

from stickiness.arguments import number, plain, positive
from stickiness.remaining.share import ONSET, find_deepest_state, find_onset, remaining_share
from stickiness.solids import HALF_SPACE, Film, Layer, Solid, check_solid
from stickiness.spectrum.interface import Spectrum, check_spectrum
from stickiness.traction_laws import EXPONENTIAL, find_strength

# Errors of the onset (the spread of extrapolations to short ranges, no interval of 90 %), and of a
# share: relative, in proportion to what is lost, and absolute, for small ones. In simulations of
# two by two waves and more they contain all energies where more than 5 % remains and 95 % of the
# smaller ones; in cells of one wave a third.
ONSET_ERROR = 0.08
SHARE_ERROR = 0.15
LEAST_ERROR = 0.015
WEAK_ERROR = 4.0  # relative, far below the onset at short ranges: the highest summits decide
# On layers limits are wider by these parts of what is lost, times the distance of S of the longest
# waves from 1: LESS for films on a soft backing and S of about a half, MORE for thin incompressible
# layers. Both were set so that limits hold all simulations on layers; no others were kept back.
LAYER_LESS, LAYER_MORE = 0.06, 0.2
PULL_OFF_ERROR = 0.3  # of the largest tension, beside the error of the share
# Energy ratios between which the high limit of the pull-off goes over to the strength of the law.
PULL_OFF_KNOWN, PULL_OFF_UNKNOWN = 1.4, 3.0
# Jumps at a given mean gap: what the energy gained over the work of approach, and the work of
# separation over the energy gained, reach in simulations. Both tend to a limit as the range falls.
LATE, HYSTERESIS = 1.3, 1.6
# Elastic energies that a pinned edge costs at most: the loss measured on rough diamond is within
# at the energy ratios of 4 to 6 where it was.
PINNING = 6.0
# Pressed to more than 2 E* times the rms slope, contact is full. It lasts up to the strength of the
# law where that is more than so many times the rms tension of full contact, E* rms slope/2: below
# that the preload did not change simulations.
LASTING = 2.2
MOST_RATIO = 1e30  #: of adhesion length to the energy of full contact, and of range to h_rms
_NOTHING = 1e-12  # of tensions that act at all, over elastic_energy/h_rms
SHORT_RANGE = 1e-6  #: over h_rms; at 1e-4 no share differs by more than 3e-5
LEAST_LENGTH = 1e-12  #: of thresholds, over the energy of full contact
DEFAULT_SHARE = 0.1  #: of the work of adhesion, from which a pair is said to stick
# Factors on the modulus of a layer on a film, between which logarithms are interpolated; the energy
# of full contact is off by less than 1e-3 of itself.
FILM_FACTORS = 10.0 ** (np.arange(-60, 61) / 10)
# Factor on the errors of surfaces unlike those simulated, at a ratio of correlation lengths, see
# `find_anisotropy_error_factor`.
UNLIKE, UNLIKE_RATIO = 2.0, 4.0


@dataclass(frozen=True)
class Prediction:
    """What remains of the work of adhesion on a rough surface, predicted.

    Works are over the work of adhesion. The theory has no jumps: approach and separation are both
    the energy gained, and their limits allow for the jumps that were simulated. Limits (low, high)
    cover 90 % where more than 5 % remains.
    """

    approach: float  #: work at given mean gaps
    separation: float
    pull_off: float  #: largest mean tension on separation [E*]
    area_at_zero_load: float  #: share of the nominal area; an upper estimate, `share.tough_area`
    approach_limits: tuple[float, float]
    separation_limits: tuple[float, float]
    pull_off_limits: tuple[float, float]
    energy_ratio: float  #: work of adhesion over the elastic energy of full contact
    #: Tabor's parameter of the longest waves, (l_a^2/(q0^2 h_rms range^3))^(1/3): the range drops
    #: out where it is large. On a layer the longest waves see the modulus E*/S instead of E*.
    tabor: float
    #: Factor on the errors that limits stand for, see `find_anisotropy_error_factor`.
    anisotropy_error_factor: float = 1.0


@dataclass(frozen=True)
class Roughness:
    """What the prediction needs to know of a surface; numbers or arrays, lengths in one unit."""

    h_rms: ArrayLike
    q0: ArrayLike  #: of the longest waves, or of the roll-off
    elastic_energy: ArrayLike  #: of full contact per nominal area over E* [length]
    relative_compliance: ArrayLike = 1.0  #: S of the longest waves on a layer, see `solids`
    #: Energy of a half-space, which bounds that of a layer; NaN: it does not.
    half_space_energy: ArrayLike | None = None
    anisotropy_error_factor: ArrayLike = 1.0  #: see `find_anisotropy_error_factor`
    rms_slope: ArrayLike = np.inf  #: infinite: without adhesion the area in contact vanishes
    law: ArrayLike = EXPONENTIAL  #: name in `traction_laws.LAWS`
    #: How both depend on the modulus of a layer on a film, see `find_film_response`
    film_response: ArrayLike | None = None

    def at_modulus(self, factor: ArrayLike) -> Roughness:
        """Return the same with E* times a factor: the film under a layer keeps its stiffness."""
        if self.film_response is None:
            return self
        logs = np.log(FILM_FACTORS)
        place = np.asarray(np.log(factor) - logs[0]) / (logs[1] - logs[0])
        place, logs = np.broadcast_arrays(place[..., None, None], self.film_response)
        place = place[..., :1]
        below = np.clip(np.floor(place).astype(int), 0, logs.shape[-1] - 2)
        low, high = (np.take_along_axis(logs, below + step, axis=-1) for step in (0, 1))
        found = np.exp(low + (place - below) * (high - low))[..., 0]
        return replace(
            self,
            elastic_energy=self.elastic_energy * found[..., 0],
            relative_compliance=self.relative_compliance * found[..., 1],
        )

    def scaled(self, factor: ArrayLike) -> Self:
        """Return the same with heights times a factor, at an unchanged shape of the spectrum."""
        powers = {"h_rms": 1, "rms_slope": 1, "elastic_energy": 2, "half_space_energy": 2}
        powers["layer_strain"] = 1  # of a `Pair`
        known = {name: getattr(self, name, None) for name in powers}
        scaled = {n: x * factor ** powers[n] for n, x in known.items() if x is not None}
        return replace(self, **scaled)

    def share(
        self,
        adhesion_length: ArrayLike,
        range: ArrayLike,
        sign: ArrayLike = 0,
        separation_factor: ArrayLike = 1.0,
    ) -> float | NDArray:
        """Share of the work of adhesion that remains; `sign` -1 or +1 for its low or high limit.

        A factor on the work of separation multiplies the share where the edge of the whole contact
        dissipates. At the high limit all edges of contact do, so that it multiplies the area.
        """
        if np.any(np.asarray(separation_factor) != 1):
            value, area = self.share(adhesion_length, range), self.area(adhesion_length, range)
            all_edges = np.clip(sign, 0, 1) * np.maximum(area - value, 0)
            more = (np.asarray(separation_factor) - 1) * (value + all_edges)
            return plain(self.share(adhesion_length, range, sign) + more)
        sign = sign * self.anisotropy_error_factor
        ratio = np.asarray(adhesion_length) / self.elastic_energy
        zone = self.zone(adhesion_length, range)
        reach = np.asarray(range) / self.h_rms
        onset = ONSET - sign * ONSET_ERROR
        compliance, load_scale = self.relative_compliance, self.load_scale
        share = remaining_share(ratio, reach, zone, onset, compliance, load_scale, self.law)
        sign, lost = np.asarray(sign), 1 - np.asarray(share)
        fades = np.minimum(ratio / ONSET, 1.0)  # of absolute errors, below the onset
        weak = 1 - np.minimum(ratio / find_onset(zone), 1.0)
        error = (SHARE_ERROR + WEAK_ERROR * weak / (1 + reach)) * lost
        # A tail attracts whatever small gaps do.
        least = LEAST_ERROR * fades ** np.where(np.equal(self.law, EXPONENTIAL), 1, 2)
        share = share * (1 + error) ** sign + sign * least * lost
        harder = 1 - np.asarray(self.relative_compliance)
        less, more = np.minimum(abs(harder), 1.0), np.maximum(harder, 0.0)
        layer = sign * np.where(sign < 0, LAYER_LESS * less, LAYER_MORE * more)
        share = share + layer * fades * lost
        if self.half_space_energy is not None and np.isfinite(self.half_space_energy).any():
            # A solid that is stiffer to every wave has no state of less energy than a half-space,
            # and a softer one has none of more.
            known = np.isfinite(self.half_space_energy)
            energy = np.where(known, self.half_space_energy, self.elastic_energy)
            deep = Roughness(self.h_rms, self.q0, energy, rms_slope=self.rms_slope, law=self.law)
            deep = deep.share(adhesion_length, range, sign)
            bound = np.where(harder >= 0, np.minimum(share, deep), np.maximum(share, deep))
            share = np.where(known, bound, share)
        # Full contact is a state that the surfaces may take.
        return plain(np.clip(share, np.maximum(1 - 1 / ratio, 0.0), 1.0))

    @property
    def load_scale(self) -> float | NDArray:
        """Elastic energy of full contact over rms height and rms slope, see `share`.

        A layer that is stiff to long waves raises the pressures of full contact as it does energy.
        Of a half-space it is at most 1/4, since the mean of q over a spectrum is at most its rms.
        """
        bound = np.nan if self.half_space_energy is None else np.asarray(self.half_space_energy)
        energy = np.where(np.isfinite(bound), bound, self.elastic_energy)
        return np.minimum(energy / (np.asarray(self.h_rms) * self.rms_slope), 0.25)

    def area(self, adhesion_length: ArrayLike, range: ArrayLike) -> float | NDArray:
        """Share of the nominal area that is in contact at zero load."""
        return plain(self._deepest_state(adhesion_length, range)[2])

    def distance(self, adhesion_length: ArrayLike, range: ArrayLike) -> float | NDArray:
        """Distance over which what remains acts: its work over the largest tension [length]."""
        share, tension, _ = self._deepest_state(adhesion_length, range)
        ratio = np.asarray(adhesion_length) / self.elastic_energy
        acts = tension > _NOTHING
        found = self.h_rms * ratio * share / np.where(acts, tension, 1.0)
        return plain(np.where(acts, found, np.asarray(range) + self.h_rms))

    def _deepest_state(self, adhesion_length, range):
        ratio, reach = np.asarray(adhesion_length) / self.elastic_energy, range / self.h_rms
        zone = self.zone(adhesion_length, range)
        return find_deepest_state(ratio, reach, zone, self.load_scale, self.law)

    def zone(self, adhesion_length: ArrayLike, range: ArrayLike) -> float | NDArray:
        """Width of the cohesive zone over the longest waves.

        That is twice the stiffness q0/(2 S) of these waves over the strength^2/w of the law,
        so that attraction reaches over gaps the more, the stiffer a layer holds them.
        """
        softened = np.asarray(adhesion_length) * self.relative_compliance
        return self.q0 * (np.asarray(range) / find_strength(self.law)) ** 2 / softened

    def separation(
        self, adhesion_length: ArrayLike, range: ArrayLike, sign: ArrayLike = 0
    ) -> float | NDArray:
        """Work of separation over the work of adhesion; `sign` as of `share`.

        The high limit allows for jumps and for a pinned edge, which may cost the work of adhesion
        times the area of contact, as Dalvi et al. (doi:10.1073/pnas.1913126116) measured it. Full
        contact that lasts up to the strength of the law is within this limit, too.
        """
        share = np.asarray(self.share(adhesion_length, range, sign))
        ratio = np.asarray(adhesion_length) / self.elastic_energy
        pinned = np.minimum(share + self.area(adhesion_length, range), 1 + PINNING / ratio)
        most = np.maximum(np.minimum(HYSTERESIS * share, 1.0), pinned)
        return plain(np.where(np.asarray(sign) > 0, most, share))

    def tension(
        self,
        adhesion_length: ArrayLike,
        range: ArrayLike,
        sign: ArrayLike = 0,
        pressed: ArrayLike = 0.0,
        separation_factor: ArrayLike = 1.0,
    ) -> float | NDArray:
        """Largest mean tension on separation over E*; `sign` as of `share`.

        The high limit goes over to the strength of the law towards full contact, which was not
        simulated, and takes it where full contact, `pressed` with that pressure over E*, lasts. A
        factor on the work of separation raises the tension as it does the share.
        """
        length = np.asarray(adhesion_length)
        found = np.asarray(
            length
            / self.distance(length, range)
            * self.share(length, range, sign, separation_factor)
            * (1 + PULL_OFF_ERROR) ** (np.asarray(sign) * self.anisotropy_error_factor)
        )
        known, unknown = np.log(PULL_OFF_KNOWN), np.log(PULL_OFF_UNKNOWN)
        beyond = np.clip((np.log(length / self.elastic_energy) - known) / (unknown - known), 0, 1)
        strength = find_strength(self.law) * length / range
        slope = np.asarray(self.rms_slope)
        lasts = (np.asarray(pressed) > 2 * slope) & (strength > LASTING * slope / 2)
        beyond = np.where(lasts, 1.0, beyond) * np.clip(sign, 0.0, 1.0)
        return plain(np.minimum(found, strength) ** (1 - beyond) * strength**beyond)

    def threshold(
        self,
        range: ArrayLike,
        share: ArrayLike = DEFAULT_SHARE,
        sign: ArrayLike = 0,
        separation_factor: ArrayLike = 1.0,
        adhesion_length: ArrayLike | None = None,
    ) -> float | NDArray:
        """Adhesion length from which on at least a share remains.

        With `sign` +1 or -1, from which on the high or low limit of the share is at least that.
        On a film it is the modulus of the layer that changes the length, from `adhesion_length`.
        """
        names = ("h_rms", "q0", "elastic_energy", "relative_compliance")
        positive(**{name: getattr(self, name) for name in names}, range=range)
        *known, films = (getattr(self, field.name) for field in fields(Roughness))
        known = [np.nan if value is None else value for value in (*known, adhesion_length)]
        at = np.broadcast_arrays(*known, range, sign, separation_factor, share)
        energy, share, shape = at[2], at[-1], at[0].shape
        at, most = [values.ravel() for values in at], 0.0
        bends = films is not None and adhesion_length is not None
        if bends:
            most, table = films[..., 0, :].max(axis=-1), films.shape[-2:]
            films = np.broadcast_to(films, (*shape, *table)).reshape(-1, *table)

        def excess(log_length, i):
            *known, start, range, sign, factor, share = (values[i] for values in at)
            length, rough = np.exp(log_length), Roughness(*known, films[i] if bends else None)
            return rough.at_modulus(start / length).share(length, range, sign, factor) - share

        bracket = np.log(LEAST_LENGTH * energy), np.log(20 * energy / (1 - share)) + most
        # Limits say at the length given what the share there says, even if they do not rise.
        given = np.clip(np.fmax(np.log(known[-1]), bracket[0]), *bracket)
        place = np.arange(share.size).reshape(shape)
        remains = excess(given, place) >= 0
        bracket = np.where(remains, bracket[0], given), np.where(remains, given, bracket[1])
        found = elementwise.find_root(excess, bracket, args=(place,))
        # Attraction whose range is far above h_rms holds at any strength.
        always = excess(bracket[0], place) >= 0
        return plain(np.where(always, LEAST_LENGTH * energy, np.exp(found.x)))


def find_film_response(spectrum: Spectrum, solid: Solid, q0: float) -> NDArray | None:
    """Logarithms of elastic energy over E* and of S at `q0`, over both as they are.

    For factors on the modulus of a layer whose film stays as it is, ``(2, FILM_FACTORS)``; None
    without a film.
    """
    if not isinstance(solid, Layer) or not isinstance(film := solid.backing, Film):
        return None
    ratios = film.modulus_ratio / np.append(1.0, FILM_FACTORS)
    layers = [replace(solid, backing=replace(film, modulus_ratio=float(r))) for r in ratios]
    found = np.log([(spectrum.elastic_energy(layer), layer.factor(q0)) for layer in layers]).T
    return found[:, 1:] - found[:, :1]


def find_half_space_energy(spectrum: Spectrum, solid: Solid) -> float | None:
    """Elastic energy that bounds that of a layer; none of a film, which is softer to long waves."""
    bends = isinstance(solid, Layer) and isinstance(solid.backing, Film)
    return None if solid == HALF_SPACE or bends else spectrum.elastic_energy()


def find_anisotropy_error_factor(ratio: float) -> float:
    """Factor on the errors of a prediction for a ratio of correlation lengths: 1 without direction.

    Simulations of ratios up to 4 lie within the limits without it, but they are few.
    """
    return UNLIKE ** float(np.log(ratio) / np.log(UNLIKE_RATIO))


def predict(
    spectrum: Spectrum,
    adhesion_length: float,
    range: float,
    q0: float | None = None,
    solid: Solid = HALF_SPACE,
    law: str = EXPONENTIAL,
    pressed: float = 0.0,
) -> Prediction:
    """Predict what remains of adhesion on a rough surface.

    The limits are for surfaces with many of the longest waves. In a periodic cell of one wave,
    realisations scatter by a factor of two and keep more. Compare with simulations in cells of four
    by four waves, and use the spectrum of those heights (`surface.realised_spectrum`).

    Parameters
    ----------
    spectrum : Spectrum
        Of the surface.
    adhesion_length : float
        Work of adhesion over E* [length].
    range : float
        Range of the attraction [length].
    q0 : float, optional
        Wave number of the longest waves that matter [1/length]; by default the roll-off,
        or the lowest of the spectrum, with a direction of its norm.
    solid : solids.HalfSpace or solids.Layer
        Elastic solid; the thickness of a layer is in the unit of the spectrum. On thin
        incompressible layers the value is a third to nine tenths of what was simulated (the less,
        the weaker the adhesion); the limits hold that.
    law : str
        Name in `traction_laws.LAWS`. The range of "van_der_waals" is the cut-off distance.
    pressed : float
        Mean pressure [E*] before separation. Only a pressure that makes contact full matters, and
        only to the high limit of the pull-off.

    Examples
    --------
    >>> from stickiness.spectrum import SelfAffine
    >>> rough = SelfAffine(hurst=0.8, q0=1.0, q1=1e4, h_rms=1.0)
    >>> found = predict(rough, adhesion_length=1.0, range=0.01)
    >>> print(f"{found.separation:.2f} of the work of adhesion remains")
    0.40 of the work of adhesion remains
    """
    check_spectrum(spectrum)
    length, range = number("adhesion_length", adhesion_length), number("range", range)
    pressed = number("pressed", pressed, zero=True)
    q0 = number("q0", spectrum.q_longest if q0 is None else q0)
    rough = Roughness(
        h_rms=spectrum.h_rms,
        q0=q0,
        elastic_energy=spectrum.elastic_energy(solid),
        relative_compliance=check_solid(solid).factor(q0),
        half_space_energy=find_half_space_energy(spectrum, solid),
        anisotropy_error_factor=find_anisotropy_error_factor(spectrum.anisotropy),
        rms_slope=spectrum.rms_slope,
        law=law,
    )
    if not 1 / MOST_RATIO < range / rough.h_rms < MOST_RATIO:
        raise ValueError(
            f"range = {range:.3g} is out of proportion to the rms height, {rough.h_rms:.3g}: give "
            "both in one unit"
        )
    if not length <= MOST_RATIO * rough.elastic_energy:
        raise ValueError(
            f"adhesion_length = {length:.3g} is more than {MOST_RATIO:g} times the elastic energy "
            f"of full contact over E*, {rough.elastic_energy:.3g}: give the work of adhesion over "
            "E*, in the unit of the heights"
        )
    low, share, high = (float(rough.share(length, range, sign)) for sign in (-1, 0, 1))
    ratio, softened = length / rough.elastic_energy, length * rough.relative_compliance
    least, pull_off, most = (
        float(rough.tension(length, range, sign, pressed)) for sign in (-1, 0, 1)
    )
    return Prediction(
        approach=share,
        separation=share,
        pull_off=pull_off,
        area_at_zero_load=float(rough.area(length, range)),
        approach_limits=(low / LATE, high),
        separation_limits=(low, float(rough.separation(length, range, 1))),
        pull_off_limits=(least, most),
        energy_ratio=ratio,
        tabor=float(
            np.cbrt(softened**2 / (q0**2 * rough.h_rms * (range / find_strength(law)) ** 3))
        ),
        anisotropy_error_factor=rough.anisotropy_error_factor,
    )
