"""Models of simulations in the configuration: presets, surfaces, cases and adhesion."""

import math
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from stickiness.accuracy.plan import FEWEST_COARSE
from stickiness.accuracy.quantities import MODELLED, QUANTITIES
from stickiness.accuracy.settings import SEEDS
from stickiness.entries import fields as f
from stickiness.entries.errors import EntryError
from stickiness.entries.fields import Section, needed, optional

Values = f.Several[f.Positive]
Hursts = f.Several[f.Hurst | str]
Loads = Annotated[Values, Field(description="mean pressures over E* q0 h_rms")]
Magnification = Annotated[float, Field(gt=1, description="q1/q0, above 1")]
Pixels = Annotated[int, Field(ge=4, multiple_of=2)]
CoarseCount = Annotated[int, Field(ge=32, le=10000)]
AtMost = Annotated[int, Field(ge=2, le=128)]
Estimator = Literal["multilevel", "plain"]


class Grid(Section):
    """Values spaced evenly on a logarithmic axis."""

    minimum: f.Positive = needed("smallest value")
    maximum: f.Positive = needed("largest value")
    per_decade: Annotated[int, Field(ge=1, le=200)] = needed("values per decade")

    @model_validator(mode="after")
    def check_limits(self) -> Self:
        """Check the order of both ends."""
        if not self.minimum < self.maximum:
            raise EntryError("minimum", self.minimum, f"must be below maximum = {self.maximum:g}")
        return self


class Fidelity(Section):
    """A preset of accuracy.

    Each realisation is also solved on half the points, which gives the discretisation error, and on
    2 points per shortest wavelength. With `coarse_seeds` further realisations are solved on the
    coarse grid only; at least 32, so that the effect of their long waves can be fitted.
    """

    pixels_per_wavelength: Pixels = needed("grid points per shortest wavelength")
    tolerance: Annotated[float, Field(gt=0, le=1e-3)] = needed("residual of the solver over h_rms")
    seeds: f.Count = needed("realisations of a case")
    coarse_seeds: CoarseCount = optional(
        "realisations on the coarse grid only; default 64", FEWEST_COARSE
    )
    comparisons: f.Several[str] = optional("which of comparisons.surfaces to compute; default all")
    map_points: Annotated[int, Field(ge=16, le=8192)] = optional(
        "grid points along the side of the maps with adhesion, if the case's grid has fewer; "
        "default 1024",
        1024,
    )


class Sampling(Section):
    """How means over realisations are estimated.

    `plain` takes the mean of the seeds; `multilevel` corrects it by coarse solutions of more seeds,
    and these by the long waves of further seeds, which need no solution.
    """

    method: Estimator = needed("how the mean is estimated")
    descriptor_seeds: Annotated[int, Field(ge=100, le=100000)] = needed(
        "realisations for long waves alone"
    )
    at_most: AtMost = optional(
        "largest number of seeds chosen for an accuracy; default 128", SEEDS[-1]
    )


class Band(Section):
    """Spectrum and cell of a random periodic surface."""

    hurst: f.Hurst
    magnification: Magnification
    window: Annotated[float, Field(ge=1)] = optional(
        "side of the cell over 2 pi/q0; default 1", 1.0
    )


class GaussianSurface(Band, f.Direction):
    """A random periodic surface whose phases are random."""

    rolloff: Magnification = optional("q_rolloff/q0, below which the spectrum is flat")
    amplitudes: Literal["gaussian", "fixed"] = optional("amplitudes of the modes", "gaussian")

    @model_validator(mode="after")
    def check_rolloff(self) -> Self:
        """Check that the spectrum is not flat throughout."""
        if self.rolloff is not None and self.rolloff >= self.magnification:
            text = f"must be below magnification = {self.magnification:g}"
            raise EntryError("rolloff", self.rolloff, text)
        return self


class Heights(Section):
    """Distribution of the heights: log-normal, as far as the spectrum allows."""

    skewness: Annotated[float, Field(ge=-4, le=4)] = needed(
        "positive for peaks on a plain, negative for a plateau with valleys"
    )


class ModelSurface(GaussianSurface):
    """A random periodic surface.

    Error models were measured with gaussian amplitudes (the default), without a roll-off and
    without `heights`.
    """

    # Without it the surface is to scripts what it was before there was this key.
    heights: Heights = Field(
        None,
        exclude_if=lambda heights: heights is None,
        description="distribution of the heights; default Gaussian",
    )


class Case(Section):
    """A contact simulation."""

    surface: str = needed("name in model_surfaces")
    pressures: Loads
    accuracy: f.Share = optional("relative error that covers 90 %, e.g. 0.03")
    at_most: AtMost = optional("largest number of seeds for it; overrides sampling.at_most")
    quantities: f.Several[Literal[QUANTITIES]] = optional(
        "what is wanted; default all but contact_slope, which needs seeds instead of accuracy",
        list(MODELLED),
    )
    model: Literal["simulation", "theory"] = optional(
        "Persson's theory alone; default simulation", "simulation"
    )
    seeds: f.Count = optional("realisations of this case; overrides all other numbers of them")
    sampling: Estimator = optional("overrides sampling.method")
    maps: Values = optional("loads at which gaps and pressures of the first seed are kept")

    @model_validator(mode="after")
    def check_simulation(self) -> Self:
        """Check what only simulations have, and that maps are of loads of the case."""
        for key in ("accuracy", "at_most", "seeds", "sampling", "maps"):
            value = getattr(self, key)
            if self.model == "theory" and value is not None:
                raise EntryError(key, value, "is for simulations; leave it out with model: theory")
        if self.at_most is not None and self.accuracy is None:
            text = "needs accuracy; give seeds for a fixed number"
            raise EntryError("at_most", self.at_most, text)
        for pressure in self.maps or []:
            if pressure not in self.pressures:
                raise EntryError("maps", pressure, "is not among the case's pressures")
        return self


class Roles(Section):
    """Cases by what they are to the paper's figures and claims, which know no other names.

    A role may also stand for its case in `adhesion` and `criteria`, for the surface of this case in
    `loops`, and for the Hurst exponent of this surface in `theory.sweeps`.
    """

    narrow_band: str = needed(
        "case of the smallest magnification, a cell of one longest wavelength"
    )
    middle_band: str = needed("case of the middle magnification, likewise")
    broad_band: str = needed("case of the largest magnification, likewise")
    wide_cell: str = needed("case in a cell of several longest wavelengths a side")
    low_hurst: str = needed("case of a smaller Hurst exponent, for Figure 3C")
    high_hurst: str = needed("case of a larger Hurst exponent, for Figure 3C")


class Comparison(Band):
    """A surface on which theory is compared with simulation."""

    seeds: Annotated[int, Field(ge=2, le=10000)] = needed("realisations")
    coarse_seeds: CoarseCount = optional("realisations on the coarse grid only; default none", 0)
    pixels_per_wavelength: Pixels = optional("upper limit of the number of the fidelity")


class Comparisons(Section):
    """Comparison of theory with simulation, beside the cases."""

    pressures: Loads
    surfaces: f.Names[Comparison] = needed("surfaces by name; one job solves all of one surface")


class Adhesive(Section):
    """Adhesive parameters of simulations."""

    one_of = (("q0_h_rms", "window and h_rms"),)

    law: f.Law
    q0_h_rms: f.Positive = optional("q0 h_rms; or give window and h_rms")
    window: f.Length = optional('longest wavelength, e.g. "100 um"')
    h_rms: f.Length = optional('rms height, e.g. "5 um"')
    adhesion_length_over_range: Values = needed("work of adhesion over E* and over the range")

    @model_validator(mode="after")
    def find_roughness(self) -> Self:
        """Fill in q0 h_rms where lengths are given instead."""
        if self.q0_h_rms is None:
            self.q0_h_rms = 2 * math.pi / self.window * self.h_rms
        return self


class AdhesiveMaps(Section):
    """States of the first realisation, simulated in full on a finer grid.

    Areas are kept at every adhesion length, the zones of contact and attraction at the largest.
    """

    pressures: Loads
    range_over_h_rms: f.Positive = needed("range over h_rms")
    adhesion_length_over_range: Values = needed("adhesion lengths over range")


class AdhesionSet(Adhesive):
    """Adhesion for every combination of the lists.

    Adhesion is computed at the mean gaps that the pressures have without it: `dmt` sums the
    attraction over the gaps without adhesion, `full` simulates by boundary elements, and `auto`
    takes dmt where its measured error is within the accuracy.
    """

    case: str = needed("name in cases, or a role")
    range_over_h_rms: Values = needed("ranges of attraction over h_rms")
    pressures: Values = needed("some of the case's pressures")
    model: Literal["auto", "dmt", "full"] = needed("how adhesion is computed")
    accuracy: f.Share = optional("allowed relative error of 1/kappa_ad, for model: auto")
    seeds: f.Count = optional("largest number of realisations that are simulated in full")
    refine: Literal[1, 2, 4] = optional("refinement of the case's grid; default 1", 1)
    half_from: f.Positive = optional(
        "range over h_rms from which states are solved on every second point along each side, "
        "where that leaves 4 points per shortest wavelength; default never"
    )
    maps: AdhesiveMaps = optional("states of one realisation on a finer grid, for Figure 2")

    @model_validator(mode="after")
    def check_model(self) -> Self:
        """Check keys that belong to one of the models."""
        if self.model == "auto" and self.accuracy is None:
            text = "is missing; model: auto chooses by it, relative in 1/kappa_ad"
            raise EntryError("accuracy", None, text)
        if self.model != "auto" and self.accuracy is not None:
            text = "needs model: auto, which chooses by it"
            raise EntryError("accuracy", self.accuracy, text)
        for key in ("seeds", "refine", "half_from", "maps"):
            if self.model == "dmt" and key in self.model_fields_set:
                text = "is of the full model; leave it out with model: dmt"
                raise EntryError(key, None, text)
        return self


class Loop(Adhesive):
    """Approach and separation of one realisation."""

    surface: str = needed("name in model_surfaces, or a role")
    range_over_h_rms: f.Positive = needed("range of attraction over h_rms")
    pressure: f.Positive = needed("largest mean pressure over E* q0 h_rms")
