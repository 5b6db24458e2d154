"""What is to be known of a surface to predict what remains of adhesion, and what follows."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from functools import cached_property, partial
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.arguments import plain, positive
from stickiness.limited import Limited
from stickiness.remaining.errors import (
    COATED,
    FIRST_TOUCH,
    PATH,
    SHARE,
    STATES_TENSION,
    TENSION,
    between,
    find_limits,
    find_work_error,
    raise_limit,
)
from stickiness.remaining.share import (
    DeepestState,
    count_scales,
    find_deepest_state,
    find_exponent,
    find_first_touch,
    find_narrowest_wave,
    find_onset,
    remaining_share,
)
from stickiness.remaining.solid_response import BOUNDED, SolidResponse, find_columns
from stickiness.remaining.thin_layers import find_gain
from stickiness.remaining.trial_states import DEFAULT_SHARE, SimulatedHeights
from stickiness.solids import HALF_SPACE, Solid
from stickiness.spectrum.family import SpectrumFamily
from stickiness.traction_laws import EXPONENTIAL, find_strength

# The narrowest wave that simulations followed: zeta = 64 with zone zeta = 0.25. Beyond it the onset
# is as uncertain as half of its further rise. That holds the two extremes: that finer waves do not
# move it, and that they take their whole energy from the work of adhesion (Persson and Tosatti).
FINEST_SIMULATED = 128.0
EXTRAPOLATION_ERROR = 0.5
# Energy ratios between which the high limit of the pull-off goes over to the strength of the law.
PULL_OFF_KNOWN = 1.4
PULL_OFF_UNKNOWN = 3.0
# Elastic energies that a pinned edge costs at most: the loss measured on rough diamond is within
# at the energy ratios of 4 to 6 where it was.
PINNING = 6.0
# Pressed to more than 2 E* times the rms slope, contact is full. It lasts if the strength of the
# law exceeds LASTING times the rms tension of full contact, E* rms slope/2; below that a preload
# changed no simulation.
LASTING = 2.2
SHORT_RANGE = 1e-6  #: over h_rms; at 1e-4 no share differs by more than 3e-5
LEAST_LENGTH = 1e-12  #: of thresholds, over the energy of full contact
THRESHOLD_TOLERANCE = 1e-9  #: of their logarithm
# Factor on E* to which thresholds are searched: beside so soft a layer a film is rigid, and full
# contact of a half-space that is as soft takes the bending of its skin alone.
SOFTEST = 1e-6
# Factor on the errors of surfaces unlike those simulated, at a ratio of correlation lengths of 4.
UNLIKE = 2.0
SHARED = ("simulated", "response", "wanted_share")  #: fields that all rows have in common


@dataclass(frozen=True, kw_only=True)
class Roughness:
    """What the prediction needs to know of a surface; numbers or arrays, lengths in one unit.

    The limits of a prediction are its values at another `eta`, see `deviating`.
    """

    h_rms: float | NDArray
    q0: float | NDArray  #: of the longest waves, or of the roll-off
    elastic_energy: float | NDArray  #: of full contact per nominal area over E* [length]
    q1: float | NDArray = np.inf  #: of the finest waves; infinite: many decades of waves
    rms_slope: float | NDArray = np.inf  #: infinite: without adhesion the area in contact vanishes
    waves: float | NDArray = np.inf  #: longest waves along a side of the contact
    exponent: float | NDArray = np.nan  #: of the elastic energy; NaN: by the mean wave number
    #: Error of the model in units of its limits: -1 and 1 at the low and the high one
    eta: float | NDArray = 0.0
    law: str | NDArray = EXPONENTIAL  #: name in `traction_laws.LAWS`
    anisotropy_error_factor: float | NDArray = 1.0  #: see `find_anisotropy_error_factor`
    #: ln of the factor by which heights that are not Gaussian change the energy ratio at which a
    #: share remains, and its error: see `height_shape`
    shape: float | NDArray = 0.0
    shape_error: float | NDArray = 0.0
    #: Mean gap over h_rms at which hard solids first touch; NaN: that of contacts of many waves,
    #: whose error and that of next to nothing then count
    first_touch: float | NDArray = np.nan
    #: Instantaneous modulus over E* after a dwell, by which fast separation may exceed the share
    instant_ratio: float | NDArray = 1.0
    wanted_share: float = DEFAULT_SHARE  #: of the work of adhesion, at which limits cover 90 %

    # What the solid decides, see `solid_response.find_columns`.
    solid: str | NDArray = "half-space"
    half_space_energy: float | NDArray = np.nan  #: energy of full contact of a half-space
    rigid_base_energy: float | NDArray = np.nan  #: and of a layer whose film does not bend
    relative_compliance: float | NDArray = 1.0
    flow: float | NDArray = 0.0  #: of the longest waves along a layer, see `thin_layers.find_flow`
    #: Share of the elastic energy in waves finer than those measured
    unresolved: float | NDArray = 0.0
    row: int | NDArray = 0  #: of the family of `response`
    response: SolidResponse | None = None  #: of layers on a film and of skins, at other moduli

    # States of contact that replace the theory of share, area and tension.
    simulated: SimulatedHeights | None = None
    #: Energy of full contact of waves that are not simulated, over that of the others
    lacking: float | NDArray = 0.0
    height_factor: float | NDArray = 1.0  #: on the heights simulated

    @classmethod
    def of(
        cls, family: SpectrumFamily, solid: Solid = HALF_SPACE, *, q0: NDArray, **known: Any
    ) -> Roughness:
        """Roughness of a family of n spectra on a solid, rows ``(n,)``.

        `q0` are the wave numbers of their longest waves. Other columns that are `known` take the
        place of those that follow from the spectra.
        """
        of_spectra = {
            "h_rms": np.sqrt(family.variance()),
            "rms_slope": np.sqrt(family.variance(2)),
            **find_columns(family, solid, q0),
        }
        return cls(q0=q0, **of_spectra | known)

    def deviating(self, eta: float | NDArray) -> Self:
        """Return the same with another error of the model, which replaces the one there is."""
        return replace(self, eta=eta)

    def at_modulus(self, factor: float | NDArray) -> Self:
        """Return the same with E* times a factor: films and skins keep their stiffness."""
        if self.response is None:
            return self
        change = self.response.change(self.row, factor)
        return replace(self, **{name: getattr(self, name) * each for name, each in change.items()})

    def scaled(self, factor: float | NDArray) -> Self:
        """Return the same with heights times a factor, at an unchanged shape of the spectrum."""
        return replace(
            self,
            h_rms=self.h_rms * factor,
            rms_slope=self.rms_slope * factor,
            elastic_energy=self.elastic_energy * factor**2,
            half_space_energy=self.half_space_energy * factor**2,
            rigid_base_energy=self.rigid_base_energy * factor**2,
            height_factor=self.height_factor * factor,
        )

    def take(self, rows: ArrayLike | slice) -> Self:
        """Return some rows of the arrays; a number is that of all rows."""
        return self._change(lambda column: column[rows] if np.ndim(column) else column)

    def broadcast(self, shape: tuple[int, ...]) -> Self:
        """Return the same with every number and array in one shape, as rows ``(n,)``."""
        return self._change(lambda column: np.broadcast_to(column, shape).ravel())

    def _change(self, change: Callable[[Any], Any]) -> Self:
        """Return the same with every number and array changed alike."""
        return replace(self, **{name: change(each) for name, each in self.columns.items()})

    @property
    def columns(self) -> dict[str, Any]:
        """Numbers and arrays by name, without what all rows have in common."""
        names = [field.name for field in fields(self) if field.name not in SHARED]
        return {name: getattr(self, name) for name in names}

    @property
    def shape_of_arrays(self) -> tuple[int, ...]:
        """Shape to which numbers and arrays broadcast."""
        return np.broadcast_shapes(*map(np.shape, self.columns.values()))

    def share(self, adhesion_length: ArrayLike, range: ArrayLike) -> float | NDArray:
        """Share of the work of adhesion that remains.

        It is that of slow separation. The high limit after a dwell is that of a fast edge of
        contact, and may exceed 1.
        """
        if self.simulated is None:
            slow = self.share_by_theory(adhesion_length, range)
        else:
            ask = partial(self._ask_simulated, "share", wanted_share=self.wanted_share)
            slow = ask(adhesion_length, range, self.eta)
        return plain(slow * self._fast_ratio)

    def limit_share(self, adhesion_length: ArrayLike, range: ArrayLike) -> Limited[Any]:
        """Share of the work of adhesion that remains, with its limits."""
        return find_limits(self, lambda each: each.share(adhesion_length, range))

    @property
    def _fast_ratio(self) -> NDArray:
        """Factor of the high limit by which fast separation may exceed a slow one after a dwell."""
        return np.asarray(self.instant_ratio) ** raise_limit(self.eta)

    def share_by_theory(
        self, adhesion_length: ArrayLike, range: ArrayLike, error: ArrayLike | None = None
    ) -> NDArray:
        """Share by the spectrum; `error` of ln of the work of adhesion replaces the theory's."""
        length = np.asarray(adhesion_length)
        # Below a skin on a map the energy of full contact is not known either.
        energy_factor = np.exp(np.multiply(self.eta, COATED.half_width(self)))
        full_contact_share = 1 - 1 / self._energy_ratio(length * energy_factor)

        # A limit is the value at another work of adhesion, and another height of the summits.
        error = self._find_error(length, range) if error is None else error
        shifted = length * np.exp(np.multiply(self.eta, error))
        is_wide = np.isnan(self.first_touch)
        touch = find_first_touch(self.waves) + between(FIRST_TOUCH.spread, -np.asarray(self.eta))
        energy_ratio = self._shaped_energy_ratio(shifted)
        compliance = np.asarray(self.relative_compliance)
        # Points of a skin are coupled, so that the limit of independent springs does not apply.
        layer_compliance = np.where(np.equal(self.solid, "skin"), 1.0, compliance)
        share = remaining_share(
            energy_ratio,
            np.asarray(range) / self.h_rms,
            onset=self.onset(shifted, range),
            relative_compliance=layer_compliance,
            load_scale=self.load_scale,
            law=self.law,
            gain=find_gain(energy_ratio, compliance, self.flow),
            first_touch=np.where(is_wide, touch, self.first_touch),
        )
        # The theory itself errs by a share, and twice as much where it was not simulated.
        of_theory = SHARE.half_width(share, self.waves) * self.anisotropy_error_factor
        share = share + is_wide * self.eta * of_theory
        if np.isin(self.solid, BOUNDED).any():
            share = self._bound_by_half_space(share, length, range)

        # Full contact is a state that the surfaces may take.
        return np.clip(share, np.maximum(full_contact_share, 0.0), 1.0)

    def _find_error(self, adhesion_length, range) -> NDArray:
        """Error of the logarithm of the work of adhesion, which covers 90 %."""
        # Beyond the waves that were simulated the onset may rise further.
        narrowest_wave = self.narrowest_wave(adhesion_length, range)
        onset = self._find_onset(narrowest_wave)
        simulated_onset = self._find_onset(np.minimum(narrowest_wave, FINEST_SIMULATED))
        extrapolated = EXTRAPOLATION_ERROR * np.log(onset / simulated_onset)
        return find_work_error(self, extrapolated)

    def _ask_simulated(self, quantity: str, adhesion_length, range, *others, **shared) -> NDArray:
        """A quantity by the states simulated on heights, which all rows have in common."""
        # Heights times a factor take the factor squared of all energies.
        length = adhesion_length / np.square(self.height_factor)
        range = range / np.asarray(self.height_factor)
        columns = np.broadcast_arrays(length, range, self.law, self.lacking, *others)
        lengths, ranges, laws, lacking, *rest = (np.ravel(column) for column in columns)
        found = np.empty(lengths.shape)
        for law in np.unique(laws):
            rows = laws == law
            known = (column[rows] for column in (lacking, *rest))
            found[rows] = getattr(self.simulated, quantity)(
                lengths[rows], ranges[rows], str(law), *known, **shared
            )
        return found.reshape(columns[0].shape)

    def _bound_by_half_space(self, share, adhesion_length, range) -> NDArray:
        """Bound a share by that on a half-space.

        A solid that is stiffer to every wave has no state of less energy than a half-space, and a
        softer one has none of more.
        """
        half_space = replace(
            self,
            elastic_energy=self._energy_on_half_space,
            solid="half-space",
            relative_compliance=1.0,
            flow=0.0,
            response=None,
        )
        bound = half_space.share_by_theory(adhesion_length, range)
        is_stiffer = 1 - np.asarray(self.relative_compliance) >= 0
        bounded = np.where(is_stiffer, np.minimum(share, bound), np.maximum(share, bound))
        return np.where(np.isin(self.solid, BOUNDED), bounded, share)

    def _energy_ratio(self, adhesion_length: ArrayLike) -> NDArray:
        """Work of adhesion over the elastic energy of full contact."""
        return np.asarray(adhesion_length) / self.elastic_energy

    def _shaped_energy_ratio(self, adhesion_length: ArrayLike) -> NDArray:
        """That of Gaussian heights which keep the same share."""
        return self._energy_ratio(adhesion_length) * np.exp(self.shape)

    @property
    def magnification(self) -> float | NDArray:
        """Wavelength of the longest waves over that of the finest."""
        return np.maximum(self.q1 / np.asarray(self.q0), 1.0)

    def onset(
        self, adhesion_length: ArrayLike, range: ArrayLike, finest: float = np.inf
    ) -> float | NDArray:
        """Work of adhesion over the energy of full contact at which tough contact begins.

        Waves finer than `finest`, over q0, are not counted.
        """
        narrowest_wave = self.narrowest_wave(adhesion_length, range)
        return plain(self._find_onset(np.minimum(narrowest_wave, finest)))

    def _find_onset(self, narrowest_wave: ArrayLike) -> NDArray:
        """The same by the narrowest wave that counts, over q0."""
        return np.asarray(find_onset(count_scales(narrowest_wave, self._exponent)))

    def narrowest_wave(self, adhesion_length: ArrayLike, range: ArrayLike) -> float | NDArray:
        """Wave number over q0 up to which attraction does not bridge the waves."""
        return find_narrowest_wave(self.zone(adhesion_length, range), self.magnification)

    def extrapolation(self, adhesion_length: ArrayLike, range: ArrayLike) -> float | NDArray:
        """Decades of wave numbers by which the theory goes beyond the simulations behind it."""
        beyond = np.asarray(self.narrowest_wave(adhesion_length, range)) / FINEST_SIMULATED
        return plain(np.maximum(np.log10(beyond), 0.0))

    @cached_property
    def _exponent(self) -> NDArray:
        """Exponent of the elastic energy, by the mean wave number if it is not known."""
        if not np.isnan(self.exponent).any():
            return np.asarray(self.exponent)
        return find_exponent(
            magnification=self.magnification,
            mean_wave_number=4 * self._energy_on_half_space / (np.square(self.h_rms) * self.q0),
        )

    @property
    def _energy_on_half_space(self) -> NDArray:
        """Energy of full contact of a half-space, whatever the solid."""
        is_other = np.not_equal(self.solid, "half-space")
        return np.where(is_other, self.half_space_energy, self.elastic_energy)

    @property
    def load_scale(self) -> float | NDArray:
        """Elastic energy of full contact over rms height and rms slope, see `share`.

        A layer that is stiff to long waves raises the pressures of full contact by the same factor
        as the energy, which cancels: hence the energy of the half-space. The scale of a half-space
        is at most 1/4, since the mean of q over a spectrum is at most its rms.
        """
        energy = self._energy_on_half_space
        return np.minimum(energy / (np.asarray(self.h_rms) * self.rms_slope), 0.25)

    def area(self, adhesion_length: ArrayLike, range: ArrayLike) -> float | NDArray:
        """Share of the nominal area that is in contact at zero load."""
        if self.simulated is not None:
            return plain(self._ask_simulated("area", adhesion_length, range))
        return plain(self._deepest_state(adhesion_length, range).area)

    def distance(self, adhesion_length: ArrayLike, range: ArrayLike) -> float | NDArray:
        """Distance [length] over which what remains acts, by theory: work over largest tension."""
        state = self._deepest_state(adhesion_length, range)
        acts = state.tension > 1e-12  # of elastic_energy/h_rms; else nothing holds the surfaces
        tension = np.where(acts, state.tension, 1.0)
        energy_ratio = self._shaped_energy_ratio(adhesion_length)
        distance = self.h_rms * energy_ratio * state.share / tension
        return plain(np.where(acts, distance, np.asarray(range) + self.h_rms))

    def _deepest_state(self, adhesion_length, range) -> DeepestState:
        return find_deepest_state(
            energy_ratio=self._shaped_energy_ratio(adhesion_length),
            range_ratio=range / self.h_rms,
            onset=self.onset(adhesion_length, range),
            load_scale=self.load_scale,
            law=self.law,
        )

    def zone(self, adhesion_length: ArrayLike, range: ArrayLike) -> float | NDArray:
        """Width of the cohesive zone times q0.

        That is twice the stiffness q0/(2 S) of these waves over the strength^2/w of the law,
        so that attraction reaches over gaps the more, the stiffer a layer or skin holds them.
        """
        softened = np.asarray(adhesion_length) * self.relative_compliance
        return self.q0 * (np.asarray(range) / find_strength(self.law)) ** 2 / softened

    def separation(self, adhesion_length: ArrayLike, range: ArrayLike) -> float | NDArray:
        """Work of separation over the work of adhesion.

        The high limit allows for jumps and for a pinned edge, which may cost the work of adhesion
        times the area of contact, as Dalvi et al. (doi:10.1073/pnas.1913126116) measured it. Full
        contact that lasts up to the strength of the law is within this limit, too.
        """
        share = np.asarray(self.share(adhesion_length, range))
        energy_ratio = self._energy_ratio(adhesion_length)
        jumps = np.exp(PATH.spread.high)
        with_jumps = np.minimum(jumps * share, 1.0)
        pinned = np.minimum(share + self.area(adhesion_length, range), 1 + PINNING / energy_ratio)
        high_limit = np.maximum(with_jumps, pinned)
        return plain(np.where(np.asarray(self.eta) > 0, high_limit, share))

    def tension(
        self, adhesion_length: ArrayLike, range: ArrayLike, pressed: ArrayLike = 0.0
    ) -> float | NDArray:
        """Largest mean tension on separation over E*.

        Edges that lag behind on separation raise the high limit by theory as they do the work. It
        goes over to the strength of the law towards full contact, which was not simulated, and
        takes it where full contact, `pressed` with that pressure over E*, lasts.
        """
        length = np.asarray(adhesion_length)
        eta = np.asarray(self.eta)
        if self.simulated is None:
            value, low, high = TENSION.spread
        else:
            unit = float(np.asarray(STATES_TENSION.unit(self.simulated.lost_ratio)))
            value, low, high = (unit * each for each in STATES_TENSION.spread)

        def find_slow(rough: Roughness) -> NDArray:
            """Tension of slow separation, with the error of the work of adhesion alone."""
            if rough.simulated is not None:
                # Heights times a factor are simulated as they were, in a unit so much larger.
                in_unit = rough._ask_simulated("tension", length, range, rough.eta)
                return in_unit * rough.height_factor
            share = np.asarray(rough.share(length, range)) / rough._fast_ratio
            return length / rough.distance(length, range) * share

        # The errors of the work and of the tension are independent: they add in quadrature.
        slow = find_slow(self)
        exact = find_slow(self.deviating(0.0))
        with np.errstate(divide="ignore", invalid="ignore"):
            of_work = np.abs(np.log(slow / exact))
            of_tension = np.abs(np.where(eta < 0, value - low, high - value) * eta)
            added = np.hypot(of_work, of_tension) - of_work
        correction = value + np.sign(eta) * np.where(np.isfinite(of_work), added, 0.0)
        predicted = slow * self._fast_ratio * np.exp(correction)
        # Towards full contact, which was not simulated, only the strength bounds the high limit.
        log_known = np.log(PULL_OFF_KNOWN)
        log_unknown = np.log(PULL_OFF_UNKNOWN)
        log_ratio = np.log(self._energy_ratio(length))
        weight = np.clip((log_ratio - log_known) / (log_unknown - log_known), 0, 1)
        # Full contact that a preload made lasts up to the strength of a law that is strong enough.
        strength = find_strength(self.law) * length / range
        slope = np.asarray(self.rms_slope)
        lasts = (np.asarray(pressed) > 2 * slope) & (strength > LASTING * slope / 2)
        weight = np.where(lasts, 1.0, weight) * raise_limit(eta)
        # Geometric interpolation between what is predicted and the strength.
        return plain(np.minimum(predicted, strength) ** (1 - weight) * strength**weight)

    def threshold(
        self,
        range: ArrayLike,
        share: ArrayLike = DEFAULT_SHARE,
        adhesion_length: ArrayLike | None = None,
    ) -> float | NDArray:
        """Adhesion length from which on at least a share remains.

        On a film the modulus of the layer changes the length, from `adhesion_length`, and below a
        skin that of the half-space.
        """
        from scipy.optimize import elementwise  # not needed to read a configuration

        positive(
            h_rms=self.h_rms,
            q0=self.q0,
            elastic_energy=self.elastic_energy,
            relative_compliance=self.relative_compliance,
            range=range,
        )
        # One row per pair: the root search runs over rows. Without a length to start from, the film
        # under a layer is taken as it is.
        surface = replace(self, response=None) if adhesion_length is None else self
        start_length = np.nan if adhesion_length is None else adhesion_length
        columns = (range, share, start_length)
        shape = np.broadcast_shapes(surface.shape_of_arrays, *map(np.shape, columns))
        rough = replace(surface, exponent=surface._exponent).broadcast(shape)
        ranges, wanted_shares, start_lengths = (
            np.broadcast_to(column, shape).ravel() for column in columns
        )

        def find_excess(log_length: NDArray, row: NDArray) -> NDArray:
            """Share that remains in these rows, less the wanted one."""
            length = np.exp(log_length)
            rough_rows = rough.take(row).at_modulus(start_lengths[row] / length)
            return rough_rows.share(length, ranges[row]) - wanted_shares[row]

        # The bracket, in the logarithm of the length.
        energy = np.asarray(rough.elastic_energy)
        lowest = np.log(LEAST_LENGTH * energy)
        highest = np.log(rough._find_most_length(wanted_shares))

        # Shares need not rise with the length. The threshold must agree with the share at the
        # start: search below that if enough remains there, else above.
        every_row = np.arange(energy.size)
        log_start = np.clip(np.fmax(np.log(start_lengths), lowest), lowest, highest)
        is_enough = find_excess(log_start, every_row) >= 0
        bracket = (np.where(is_enough, lowest, log_start), np.where(is_enough, log_start, highest))
        root = elementwise.find_root(
            find_excess, bracket, args=(every_row,), tolerances={"xatol": THRESHOLD_TOLERANCE}
        )

        # Attraction whose range is far above h_rms holds at any strength. On a skin that takes more
        # to bend than is gained, nothing holds however soft the half-space is.
        holds_always = find_excess(bracket[0], every_row) >= 0
        holds_never = find_excess(bracket[1], every_row) < 0
        extremes = [LEAST_LENGTH * energy, energy / LEAST_LENGTH]
        lengths = np.select([holds_always, holds_never], extremes, np.exp(root.x))
        return plain(lengths.reshape(shape))

    def _find_most_length(self, share: NDArray) -> NDArray:
        """Adhesion length from which on every limit is above a share.

        Full contact keeps 1 - energy/length, which is more than the share from energy/(1 - share)
        on; 20 times that leaves room for limits. A film may raise the energy on the way there.
        """
        energy = np.asarray(self.at_modulus(SOFTEST).elastic_energy)
        if self.simulated is not None:  # whose energy may exceed that of a spectrum that is drawn
            energy = np.maximum(energy, self.simulated.whole.full_contact_energy)
        return 20 * energy / (1 - share)


def find_anisotropy_error_factor(ratio: float) -> float:
    """Factor on the errors of a prediction for a ratio of correlation lengths: 1 without direction.

    Simulations of ratios up to 4 lie within the limits without it, but they are few.
    """
    return UNLIKE ** float(np.log(ratio) / np.log(4.0))
