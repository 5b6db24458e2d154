"""What is known of the roughness of a surface, from whatever source: `Surface`.

Measured heights, a spectrum, a drawing and parameters in the configuration all become the same
thing: a smooth and a rough end of what is known, each with its spectrum and its moments. A measured
surface also has draws, that is spectra which agree with the measured one within its errors and
contain waves that the instrument does not resolve. Verdicts rest on the draws where there are any.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from stickiness import datasets
from stickiness.arguments import check_length, side, with_gaps
from stickiness.criteria.a_v_table import SurfaceAv, surface_a_v
from stickiness.measured.doubts import doubt_pixels
from stickiness.measured.stitching import MOST_UNRESOLVED
from stickiness.plausibility import PlausibilityWarning, find_doubts
from stickiness.remaining.roughness import Roughness, find_anisotropy_error_factor
from stickiness.remaining.trial_states import SimulatedHeights
from stickiness.solids import Solid
from stickiness.spectrum.interface import Spectrum
from stickiness.spectrum.kinds import SelfAffine
from stickiness.units import Quantity
from stickiness.verdicts import parametric
from stickiness.verdicts.longer_waves import LARGER, lengthen
from stickiness.verdicts.parametric import ENDS, MOMENTS
from stickiness.verdicts.scenarios import Scenarios
from stickiness.verdicts.shorter_waves import shorten, shorten_shells
from stickiness.verdicts.simulated_surface import (
    find_lacking,
    read_simulated,
    simulate_on,
)

if TYPE_CHECKING:  # scripts that open a file of a surface do not read measurements
    from stickiness.verdicts.measured_surface import Measurement

#: What a verdict needs of the file of a surface.
NEEDED = (*MOMENTS, "elastic_energy", "q0", "q1", "psd")
_SAME_SHAPE = 1e-6  # relative, within which both ends have spectra of one shape


@dataclass(frozen=True, eq=False)
class Surface:
    """What is known of the roughness of a surface; lengths in m.

    Make one with `from_heights`, `from_profile`, `from_spectrum`, `from_drawing` or `read`.

    Attributes
    ----------
    data : Dataset
        The variables of `surface_variables.SURFACE_VARIABLES` that are known: spectrum and moments
        at both ends, draws, unresolved waves, the fit, and a thinned picture of the heights. It is
        what the workflow stores in ``real_surfaces/<surface>.nc``.
    shells : Spectrum, optional
        Spectrum of a periodic cell, whose waves are discrete and have no density to tabulate.
    measurements : tuple of Measurement
        Levelled heights that were analysed, for a picture of their contact. Files do not keep them.

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
    measurements: tuple[Measurement, ...] = ()

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
            parametric.tabulate_ends(
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
        from stickiness.verdicts.measured_surface import Measurement

        options = check_heights(options)
        surface = cls._analyse([Measurement.from_array(heights, steps, options)], options)
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

        return cls(parametric.read_drawing(check_drawing(parameters)))

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

        return cls.from_entry(check_surface({"kind": "measured", "file": str(path), **options}))

    @classmethod
    def from_entry(cls, entry: Mapping[str, Any]) -> Surface:
        """Make a surface of a checked entry of the configuration, with values in SI units."""
        if entry["kind"] == "self_affine":
            return cls(parametric.read_self_affine(entry))
        if entry["kind"] == "surface_texture":
            return cls(parametric.read_drawing(entry))
        from stickiness.verdicts.measured_surface import read_measurements

        return cls._analyse(read_measurements(entry), entry)

    @classmethod
    def _analyse(cls, measurements: Sequence[Measurement], entry: Mapping[str, Any]) -> Surface:
        """Make a surface of its measurements as a checked entry says."""
        from stickiness.verdicts.analysis import analyse

        data = analyse(
            measurements,
            extend_to=entry["extend_to"],
            contact=entry["contact"],
            ignore_doubts=entry["plausibility"] == "ignore",
        )
        return cls(data, measurements=tuple(measurements))

    @classmethod
    def open(cls, path: str | Path) -> Surface:
        """Open a file that `write` has written."""
        return cls(datasets.read(path, NEEDED))

    def write(self, path: str | Path, *, title: str, parameters: Mapping[str, Any]) -> None:
        """Write what is known of the surface to a NetCDF file."""
        if self.shells is not None:
            raise ValueError("the spectrum of a periodic cell has no density that can be written")
        datasets.write(self.data, path, title=title, parameters=parameters)

    @property
    def contact(self) -> float:
        """Side of the contact whose waves are known [m]; NaN of a surface that was not measured."""
        return float(self.data.get("contact", np.nan))

    @property
    def scan(self) -> float:
        """Side of the largest scan [m]; NaN of a surface that was not measured."""
        return float(self.data.get("scan", np.nan))

    @property
    def is_larger(self) -> bool:
        """Whether the contact is larger than the scan."""
        return self.contact > self.scan * (1 + 1e-9)

    @cached_property
    def larger(self) -> Surface | None:
        """The surface as a contact of `LARGER` times the side of the scan meets it.

        None if its waves are known, by a roll-off or by the size of the contact, or not judged.
        """
        if "q_rolloff" in self.data or self.not_judged:
            return None
        larger = self.on_contact(LARGER * self.scan)
        return None if larger is self else larger

    def on_contact(self, contact: float) -> Surface:
        """The surface as a contact of a side [m] meets it, itself if its waves are that long."""
        if self.is_larger or not contact > self.scan:  # nor if nothing was scanned
            return self
        return Surface(lengthen(self.data, contact))

    def shorter(self, q: float) -> Surface:
        """The surface without its long waves, as a contact that is smaller than these meets it.

        Parameters
        ----------
        q : float
            Wave number [1/m] of the longest wave that is kept.

        Returns
        -------
        Surface
            With the rms mean curvature of the waves taken out as `lost_curvature`; the same surface
            if it has no waves below `q`.
        """
        if q <= min(spectrum.band[0] for spectrum in self.spectra) * (1 + 1e-9):
            return self
        if self.shells is not None:
            shells, lost = shorten_shells(self.shells, q)
            data = _describe_shells(shells).assign(lost_curvature=("end", [lost, lost]))
            return Surface(data, shells=shells)
        return Surface(shorten(self.data, q))

    @property
    def lost_curvature(self) -> float:
        """Rms mean curvature [1/m] of the waves that `shorter` has taken out."""
        return float(np.median(self.rows("lost_curvature"))) if "lost_curvature" in self.data else 0

    @property
    def highest(self) -> float:
        """Highest wave number that any draw may have [1/m]."""
        of_draws = self.data.get("beyond_end_draws", self.data.q1)
        return float(np.maximum(of_draws, self.data.q1).max())

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
        return parametric.read_ends(self.data, highest=float(self.data.q1))

    @cached_property
    def scenarios(self) -> Scenarios:
        """All that the surface may be, as a half-space meets it."""
        data = self.data
        energy = self.rows("elastic_energy")
        slope = data.rms_slope.sel(end=list(ENDS)).values
        longest_waves = self.contact * float(data.q0) / (2 * np.pi)
        roughness = Roughness(
            h_rms=self.rows("h_rms"),
            q0=self.rows("q0"),
            q1=np.full(energy.shape, float(data.q1)),
            elastic_energy=energy,
            half_space_energy=energy,
            anisotropy_error_factor=find_anisotropy_error_factor(
                float(data.get("axis_ratio", 1.0))
            ),
            # A surface that is described has very many.
            waves=np.float64(np.inf if np.isnan(self.contact) else longest_waves),
            # Slopes of the draws are not kept; those of both ends hardly differ.
            rms_slope=np.append(slope, np.full(self.draw_count, slope.mean())),
            shape=np.float64(data.get("shape", 0.0)),
            shape_error=np.float64(data.get("shape_error", 0.0)),
            simulated=self.simulated,
            lacking=self._find_lacking(),
        )
        if self.draw_count:
            return Scenarios.of_draws(roughness)
        return Scenarios.between_ends(roughness)

    def rows(self, name: str) -> NDArray:
        """A variable at both ends, and of every draw of a measured surface."""
        stored = self.data[name]  # along the ends, or one number for both
        at_ends = stored.sel(end=list(ENDS)).values if stored.ndim else np.full(2, float(stored))
        of_draws = self.data.get(f"{name}_draws")
        return at_ends if of_draws is None else np.append(at_ends, of_draws.values)

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

    def _find_lacking(self) -> NDArray:
        """Energy of waves that are not simulated over that of the others, in every row."""
        if self.simulated is None:
            return np.zeros(2 + self.draw_count)
        longer = self.rows("longer_energy") if "longer_energy" in self.data else 0.0
        return find_lacking(self.simulated, unheld=self.rows("unheld_energy"), longer=longer)

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
