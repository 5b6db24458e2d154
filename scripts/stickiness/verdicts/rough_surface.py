"""What is known of the roughness of a surface, from whatever source: `Surface`.

Measured heights, a spectrum, a drawing and parameters in the configuration all become the same
thing: a smooth and a rough end of what is known, each with its spectrum and its moments. A measured
surface also has draws, that is spectra which agree with the measured one within its errors and
contain waves that the instrument does not resolve. Verdicts rest on the draws where there are any.
"""

from __future__ import annotations

import json
import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, Self

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from stickiness import datasets
from stickiness.arguments import check_length, side, with_gaps
from stickiness.criteria.a_v_theory import SurfaceAv, surface_a_v
from stickiness.measured.doubts import doubt_pixels
from stickiness.measured.guess import Guess
from stickiness.measured.stitching import MOST_UNRESOLVED
from stickiness.plausibility import PlausibilityWarning, find_doubts
from stickiness.remaining.roughness import find_anisotropy_error_factor
from stickiness.remaining.trial_states import SimulatedHeights
from stickiness.solids import Solid
from stickiness.spectrum.family import SpectrumFamily
from stickiness.spectrum.interface import Spectrum
from stickiness.spectrum.kinds import SelfAffine
from stickiness.units import Quantity
from stickiness.verdicts import surface_data
from stickiness.verdicts.longer_waves import lengthen
from stickiness.verdicts.simulated_surface import (
    find_lacking,
    read_simulated,
    simulate_on,
)
from stickiness.verdicts.surface_data import ENDS, MOMENTS, read_family

if TYPE_CHECKING:  # scripts that open a file of a surface do not read measurements
    from stickiness.measured.measurement import Measurement

#: What a verdict needs of the file of a surface.
NEEDED = (*MOMENTS, "elastic_energy", "q0", "q1", "psd")
_SAME_SHAPE = 1e-6  # relative, within which both ends have spectra of one shape


class Reading(NamedTuple):
    """A surface as it is if a guess about its measurement is wrong."""

    guess: Guess
    surface: Surface


@dataclass(frozen=True, eq=False)
class Surface:
    """What is known of the roughness of a surface; lengths in m.

    Make one with `from_heights`, `from_profile`, `from_spectrum`, `from_drawing` or `read`.

    Attributes
    ----------
    data : Dataset
        The variables of `surface_data.SURFACE_VARIABLES` that are known: spectrum and moments
        at both ends, draws, unresolved waves, the fit, and a thinned picture of the heights. It is
        what the workflow stores in ``real_surfaces/<surface>.nc``.
    shells : Spectrum, optional
        Spectrum of a periodic cell, whose waves are discrete and have no density to tabulate.
    readings : tuple of Reading
        The same surface by other answers to questions that its measurement leaves open.

    See Also
    --------
    stickiness.verdict : whether a material sticks to a surface

    Examples
    --------
    >>> from stickiness.spectrum import SelfAffine
    >>> rough = SelfAffine(hurst=0.8, q0=6e4, q1=6e8, h_rms=1e-6)
    >>> wall = Surface.from_spectrum(rough)
    >>> print(f"{wall.rms_height:.2g} m")
    1e-06 m
    """

    data: xr.Dataset
    shells: Spectrum | None = None
    readings: tuple[Reading, ...] = ()

    @classmethod
    def from_spectrum(cls, spectrum: Spectrum, rough: Spectrum | None = None) -> Surface:
        """Describe a surface by its spectrum, or by a smooth and a `rough` end of its spectrum.

        The surface has the waves of the spectrum and no others. Both ends must have the same band.

        Raises
        ------
        ValueError
            If the bands differ, or if the rough end has the lower rms height.
        """
        rough = spectrum if rough is None else rough
        if not np.allclose(spectrum.band, rough.band, rtol=1e-9):
            raise ValueError(f"rough must have the band {spectrum.band}, got {rough.band}")
        if rough.h_rms < spectrum.h_rms:
            raise ValueError(
                f"rough must have the higher rms height, got {rough.h_rms:.3g} below "
                f"{spectrum.h_rms:.3g}"
            )
        if spectrum.is_discrete:
            return cls(_describe_shells(spectrum), shells=spectrum)
        return cls(
            surface_data.tabulate_ends(
                spectrum,
                rough,
                hurst=getattr(spectrum, "hurst", None),
                C0=[each.C0 for each in (spectrum, rough) if isinstance(each, SelfAffine)] or None,
            )
        )

    @classmethod
    def from_heights(
        cls, heights: ArrayLike, length: float | str | tuple[float | str, ...], **options: Any
    ) -> Surface:
        """Analyse a map of heights.

        Parameters
        ----------
        heights : (nx, ny) array
            Heights [m], NaN or masked where nothing was measured; the first axis runs along x.
        length : float or str, or a pair of them
            Side of the map, or its sides along x and y: numbers in m or texts with a unit.
        **options
            Keys of a measured surface that do not tell how its file is read, see
            docs/configuration.md, such as `detrend`, `missing`, `resolution`, `extend_to` and
            `contact`. Lengths are numbers in m or texts with a unit.

        Raises
        ------
        ValueError
            If the heights are no map, a side is missing, too many points are missing, or an option
            is unknown or has a value that cannot be used.
        """
        heights = with_gaps("heights", heights)
        if heights.ndim != 2:
            raise ValueError(f"heights must be an (nx, ny) array, got the shape {heights.shape}")
        if min(heights.shape) < 4:
            raise ValueError(f"heights must have at least 4 x 4 points, got {heights.shape}")
        if np.ndim(length) == 0 and heights.shape[0] != heights.shape[1]:
            raise ValueError(
                f"length must be both sides of heights of the shape {heights.shape}, got {length!r}"
            )
        sides = check_length(_in_metres(length), heights.shape)
        steps = tuple(a / n for a, n in zip(sides, heights.shape, strict=True))
        doubts = [doubt for each in dict.fromkeys(sides) for doubt in find_doubts(length=each)]
        doubts += doubt_pixels("heights", heights.shape, steps)
        return cls._from_array(heights, steps, options, doubts)

    @classmethod
    def from_profile(cls, heights: ArrayLike, length: float | str, **options: Any) -> Surface:
        """Analyse a line profile of even steps.

        We assume that the surface is isotropic, and convert the spectrum of the profile.

        Parameters
        ----------
        heights : (n,) array
            Heights [m], NaN or masked where nothing was measured.
        length : float or str
            Length of the profile: a number in m or a text with a unit.
        **options
            As of `from_heights`.
        """
        heights = with_gaps("heights", heights)
        if heights.ndim != 1:
            raise ValueError(f"a profile must be an (n,) array, got the shape {heights.shape}")
        if heights.size < 16:
            raise ValueError(f"a profile must have at least 16 points, got {heights.size}")
        length = side("length", _in_metres(length))
        doubts = find_doubts(length=length)
        return cls._from_array(heights, length / heights.size, options, doubts)

    @classmethod
    def _from_array(
        cls,
        heights: np.ndarray,
        steps: float | tuple[float, ...],
        options: Mapping[str, Any],
        doubts: Iterable[str],
    ) -> Surface:
        """Analyse heights on a grid of these steps [m]; warn of `doubts` and keep them."""
        from stickiness.entries import check_heights
        from stickiness.measured.measurement import Measurement

        def measure(entry: Mapping[str, Any]) -> list[Measurement]:
            return [Measurement.from_array(heights, steps, entry)]

        surface = cls._analyse(measure, check_heights(options))
        doubts = list(doubts)
        for doubt in doubts:
            warnings.warn(doubt, PlausibilityWarning, stacklevel=3)
        attributes = surface.data.attrs
        attributes["remarks"] = "\n".join(filter(None, [*doubts, attributes["remarks"]]))
        return surface

    @classmethod
    def from_drawing(cls, **parameters: Any) -> Surface:
        """Describe a surface by the parameters of profiles on a drawing.

        Parameters
        ----------
        **parameters
            Keys of a surface of `kind: surface_texture`, see docs/configuration.md, as numbers in m
            or texts: `Ra` or `Rq`, one value or (low, high), and `Rz`, `RSm`, `lambda_c` and
            `shortest_wavelength` if they are known.

        Raises
        ------
        ValueError
            If not exactly one of Ra and Rq is given, or if a value cannot be used.

        Examples
        --------
        >>> print(f"{Surface.from_drawing(Ra='0.8 um', RSm='0.1 mm').rms_height:.2g} m")
        1.1e-06 m
        """
        from stickiness.entries import check_drawing

        return cls(surface_data.read_drawing(check_drawing(parameters)))

    @classmethod
    def read(cls, path: str | Path, **options: Any) -> Surface:
        """Read a measured topography from a file of an instrument, NetCDF, numpy or text.

        Parameters
        ----------
        path : path
            The file. The rows of a matrix in a text or numpy file run along y, as in an image.
        **options
            Keys of a measured surface, see docs/configuration.md: those of `from_heights`, `length`
            and `height_unit` of a map, `position_unit` and `height_unit` of a profile, `channel`
            and others. Values with units are texts, or numbers in SI units.

        Raises
        ------
        ValueError
            If the file cannot be read; the message says what to give.
        """
        from stickiness.entries import check_surface

        given = {"kind": "measured", "file": str(path), **options}
        return cls.from_entry(check_surface(given, arguments=True))

    @classmethod
    def from_entry(cls, entry: Mapping[str, Any]) -> Surface:
        """Make a surface of a checked entry of the configuration, with values in SI units."""
        if entry["kind"] == "self_affine":
            return cls(surface_data.read_self_affine(entry))
        if entry["kind"] == "spectrum":
            from stickiness.measured.spectrum_table import read_spectrum

            return cls.from_spectrum(read_spectrum(entry["file"], entry["convention"]))
        if entry["kind"] == "surface_texture":
            return cls(surface_data.read_drawing(entry))
        return cls._analyse(read_measurements, entry)

    @classmethod
    def _analyse(
        cls,
        measure: Callable[[Mapping[str, Any]], Sequence[Measurement]],
        entry: Mapping[str, Any],
    ) -> Surface:
        """Make a surface of its measurements as a checked entry says, and by every other guess."""
        from stickiness.verdicts.analysis import analyse

        def analyse_as(measurements: Sequence[Measurement]) -> xr.Dataset:
            data = analyse(
                measurements,
                extend_to=entry["extend_to"],
                ignore_doubts=entry["plausibility"] == "ignore",
            )
            return data if entry["contact"] is None else lengthen(data, entry["contact"])

        measurements = measure(entry)
        # Several measurements may ask the same.
        guesses: dict[str, Guess] = {}
        for guess in (guess for each in measurements for guess in each.heights.guesses):
            guesses.setdefault(repr(guess.options), guess)
        # A surface may leave other questions open if one is answered otherwise.
        taken = {key: text for each in guesses.values() for key, text in each.options[0].items()}
        return cls(
            analyse_as(measurements),
            readings=tuple(
                Reading(guess, cls._analyse(measure, override(entry, taken | guess.options[1])))
                for guess in guesses.values()
            ),
        )

    @classmethod
    def open(cls, path: str | Path) -> Surface:
        """Open a file that `write` has written; raise ValueError with the reason if it has none."""
        data = datasets.read(path)
        if reason := data.attrs.get("unread"):
            raise ValueError(reason)
        datasets.demand(data, path, NEEDED)
        return cls._collect(data, datasets.read_groups(path))

    @classmethod
    def _collect(cls, data: xr.Dataset, groups: Mapping[str, xr.Dataset], place: str = "") -> Self:
        """Make a surface of its data, and of those of its readings, the groups below a place."""
        own = {name: each for name, each in groups.items() if name.rpartition("/")[0] == place}
        readings = (
            Reading(Guess(**json.loads(each.attrs["guess"])), cls._collect(each, groups, name))
            for name, each in own.items()
        )
        return cls(data, readings=tuple(readings))

    def write(self, path: str | Path, *, title: str, parameters: Mapping[str, Any]) -> None:
        """Write what is known of the surface to a NetCDF file."""
        if self.shells is not None:
            raise ValueError("the spectrum of a periodic cell has no density that can be written")
        groups = self._list_groups()
        datasets.write(self.data, path, title=title, parameters=parameters, groups=groups)

    def _list_groups(self, place: str = "") -> dict[str, xr.Dataset]:
        """Data of all readings, and of theirs, by their groups in a file."""
        groups = {}
        for number, (guess, other) in enumerate(self.readings, 1):
            name = f"{place}reading_{number}"
            groups[name] = other.data.assign_attrs(guess=json.dumps(guess._asdict()))
            groups |= other._list_groups(f"{name}/")
        return groups

    @property
    def contact(self) -> float:
        """Side of the contact whose waves are known [m]; NaN of a surface that was not measured."""
        return float(self.data.get("contact", np.nan))

    @property
    def scan(self) -> float:
        """Side of the largest scan [m]; NaN of a surface that was not measured."""
        return float(self.data.get("scan", np.nan))

    @property
    def not_judged(self) -> str:
        """Why no verdict should rest on the data, a line each; empty if one may."""
        return self.data.attrs.get("not_judged", "")

    @property
    def remarks(self) -> tuple[str, ...]:
        """Doubts that the user ignored, and where the user contradicts the file."""
        ignored = self.data.attrs.get("remarks", "").split("\n")
        contradictions = self.data.attrs.get("contradictions", "").split("\n")
        return tuple(filter(None, (*ignored, *contradictions)))

    @property
    def choices(self) -> tuple[str, ...]:
        """What else the files hold, where one of several data sets was taken."""
        return tuple(filter(None, self.data.attrs.get("choices", "").split("\n")))

    @property
    def steps(self) -> tuple[str, ...]:
        """What was done to measured heights in turn, if they were not levelled alone."""
        return tuple(filter(None, self.data.attrs.get("steps", "").split("\n")))

    def __repr__(self) -> str:
        h_rms = sorted(self.data.h_rms.values)
        draws = f", {self.draw_count} draws" if self.draw_count else ""
        return f"Surface(h_rms = {h_rms[0]:.3g} to {h_rms[1]:.3g} m{draws})"

    @property
    def rms_height(self) -> float:
        """Rms height [m]: of one scan as it is levelled, of several by their spectrum.

        Of a surface that was not measured it is that of its rough end.
        """
        if "measurement" in self.data.dims:  # no single scan holds all waves
            return float(np.sqrt(self.data.h_rms.prod()))
        return float(self.data.get("h_rms_measured", self.data.h_rms[-1]))

    @property
    def draw_count(self) -> int:
        """Number of draws; 0 of a surface that was not measured."""
        return self.data.sizes.get("draw", 0)

    @cached_property
    def spectra(self) -> tuple[Spectrum, Spectrum]:
        """Spectra of the smooth and of the rough end, up to q1."""
        if self.shells is not None:
            return self.shells, self.shells
        highest = float(self.data.q1) if self.draw_count else np.inf
        return surface_data.read_ends(self.data, highest)

    @cached_property
    def family(self) -> SpectrumFamily:
        """Every spectrum that the surface may have: those drawn, or that of both ends."""
        return read_family(self.data) if self.draw_count else SpectrumFamily.of(*self.spectra)

    @property
    def shortest_resolved(self) -> float:
        """Shortest wave that the instrument resolves [m]; NaN of a surface not measured."""
        return 2 * np.pi / float(self.data.get("q_cutoff", np.nan))

    @cached_property
    def as_measured(self) -> Surface | None:
        """The same without waves that were not resolved; None if their end is known."""
        if not self.draw_count or self.data.q1 > self.data.q_cutoff * (1 + 1e-9):
            return None
        is_resolved = self.data.ring <= self.data.q_cutoff * (1 + 1e-9)
        measured = self.data.assign(drawn_psd=self.data.drawn_psd.where(is_resolved, 0.0))
        # The heights hold all of these waves.
        return Surface(measured.assign(held_energy=("draw", read_family(measured).energy())))

    @property
    def _told(self) -> SpectrumFamily:
        """The waves that were measured or told; what draws have beyond is unknown."""
        return self.family.up_to(float(self.data.q1)) if self.draw_count else self.family

    def find_family(self, above: float) -> SpectrumFamily:
        """The same without waves below a wave number [1/m]."""
        if not above:
            return self.family
        if not self.draw_count:
            return self.family.above(above)
        # The last ring measured reaches beyond the cutoff, where the law begins.
        return self.family.ending_rings(float(self.data.q_cutoff)).above(above)

    def find_columns(self, above: float = 0.0) -> dict[str, Any]:
        """Columns of `Roughness` that no solid changes, a row for each of `find_family`."""
        data = self.data
        q0 = data.drawn_q0.values if self.draw_count else np.full(2, float(data.q0))
        q1 = float(data.q1)
        longest_waves = self.contact * max(float(data.q0), above) / (2 * np.pi)
        shape = float(data.get("shape", 0.0))
        columns = {
            "q0": np.maximum(q0, above),
            "q1": q1,
            "rms_slope": np.sqrt(self._told.variance(2)),
            "anisotropy_error_factor": find_anisotropy_error_factor(
                float(data.get("axis_ratio", 1.0))
            ),
            # A surface that is described has very many.
            "waves": np.inf if np.isnan(self.contact) else longest_waves,
            "shape": shape,
            "shape_error": float(data.get("shape_error", 0.0)),
            "simulated": self.simulated,
            "lacking": self.lacking,
        }
        if not above:
            return columns
        # The shape of the heights is mostly that of the waves that hold their energy. States
        # simulated on the heights have all waves.
        kept = self.find_family(above)
        lost = shape * (1 - np.minimum(kept.energy() / self.family.energy(), 1.0)) / 2
        if above >= q1:
            ends = [self.family.q[psd > 0].max() for psd in self.family.psd]
            columns["q1"] = max(q1, float(np.median(ends)))
        return columns | {
            "rms_slope": np.sqrt(kept.variance(2)),
            "shape": shape - lost,
            "shape_error": np.hypot(columns["shape_error"], lost),
            "simulated": None,
            "lacking": 0.0,
        }

    @cached_property
    def simulated(self) -> SimulatedHeights | None:
        """States of contact that were simulated on the heights; None if there are none."""
        return read_simulated(self.data)

    @cached_property
    def _simulated_on(self) -> dict[Solid, SimulatedHeights | None]:
        """What `simulate_on` has simulated, by solid: several materials may have the same."""
        return {}

    def simulate_on(self, solid: Solid) -> SimulatedHeights | None:
        """States of contact of another solid, simulated on the heights; None if there are none."""
        if solid not in self._simulated_on:
            self._simulated_on[solid] = simulate_on(self.data, solid)
        return self._simulated_on[solid]

    @cached_property
    def lacking(self) -> NDArray | float:
        """Energy of waves that are not simulated over that of the others, of every spectrum."""
        if self.simulated is None:
            return 0.0
        return find_lacking(self.simulated, self.family.energy() / self.data.held_energy.values)

    @property
    def lacking_energy(self) -> NDArray | float:
        """The same as an energy per area over E* [m], on a half-space."""
        if self.simulated is None:
            return 0.0
        return self.lacking * self.simulated.whole.full_contact_energy

    @cached_property
    def a_v(self) -> tuple[SurfaceAv, SurfaceAv]:
        """a_V of both ends by theory; it is computed once where they differ by a factor only."""
        psd = self.data.psd.sel(end=list(ENDS)).values
        ratio = psd[0] / psd[1]
        if np.ptp(ratio) < _SAME_SHAPE * ratio.max():
            a_v = self.find_a_v(0)
            return a_v, a_v
        return self.find_a_v(0), self.find_a_v(1)

    def find_a_v(self, end: int) -> SurfaceAv:
        """a_V of the smooth (0) or rough (1) end by Persson's theory."""
        moments = {name: float(self.data[name].sel(end=ENDS[end])) for name in MOMENTS}
        return surface_a_v(self.spectra[end], moments | {"q0": float(self.data.q0)})

    @property
    def unresolved_energy(self) -> float:
        """Elastic energy of waves that the instrument does not resolve, over that of the others.

        It is that of the rough end if the fitted law goes on to 0.3 nm; 0 of a surface that was not
        measured.
        """
        return float(np.max(self.data.get("unresolved_energy", 0.0)))

    @property
    def doubts(self) -> tuple[str, ...]:
        """Sentences about improbable heights and slopes, and unresolved waves that decide."""
        if self.not_judged:  # of which they would follow
            return ()
        doubts = list(
            find_doubts(h_rms=float(self.data.h_rms[-1]), rms_slope=float(self.data.rms_slope[-1]))
        )
        if self.unresolved_energy > MOST_UNRESOLVED:
            doubts.append(
                "waves that the instrument does not resolve decide: if the fitted law goes on to "
                f"0.3 nm, full contact takes {1 + self.unresolved_energy:.2g} times the energy. "
                "The limits include that; a finer measurement narrows them"
            )
        return tuple(doubts)


def read_measurements(entry: Mapping[str, Any]) -> tuple[Measurement, ...]:
    """Read every measurement of a checked entry of a measured surface."""
    from stickiness.entries import list_measurements
    from stickiness.measured.measurement import Measurement

    return tuple(map(Measurement.from_entry, list_measurements(entry)))


def override(entry: Mapping[str, Any], options: Mapping[str, Any]) -> dict[str, Any]:
    """Return an entry of a measured surface with other options, also of each measurement."""
    measurements = entry.get("measurements") or []
    return {**entry, **options, "measurements": [{**each, **options} for each in measurements]}


def _describe_shells(spectrum: Spectrum) -> xr.Dataset:
    """Moments of the spectrum of a periodic cell; its density only tells that both ends agree."""
    moments = {name: ("end", [getattr(spectrum, name)] * 2) for name in MOMENTS}
    return xr.Dataset(
        {
            **moments,
            "elastic_energy": ("end", [spectrum.elastic_energy()] * 2),
            "psd": (("end", "wave_number"), np.ones((2, spectrum.q.size))),
            "q0": spectrum.q_longest,
            "q1": spectrum.q1,
            "axis_ratio": spectrum.anisotropy,
        },
        coords={"end": list(ENDS), "wave_number": spectrum.q},
    )


def _in_metres(length: Any) -> Any:
    """Length, or each of several, where it is a text with a unit; else as it is."""
    if isinstance(length, list | tuple):
        return tuple(map(_in_metres, length))
    if not isinstance(length, str):
        return length
    try:
        return float(Quantity.read(length, "m"))
    except ValueError as error:
        raise ValueError(f"length {error}") from None
