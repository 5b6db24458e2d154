"""Models of config/config.yaml and config/campaigns/paper.yaml, which are read as one.

The models of the other campaigns, which hold what this project measures once, follow them.
"""

from operator import attrgetter
from typing import Annotated, Literal

from pydantic import Field

from common.config import fields as f
from common.config.experiments import Experiments
from common.config.fields import Section, needed, optional
from common.config.materials import Materials
from common.config.surfaces import Direction, Surfaces
from stickiness.accuracy.quantities import QUANTITIES

# What the figures and the claims read; may be edited but not removed.
PAPER = {
    "cases": ("H0.8_zeta32", "H0.8_zeta64", "H0.8_zeta128", "H0.8_zeta32_wide"),
    "theory.sweeps": ("fig1a", "fig1b", "fig3a", "fig3b", "fig3c", "fig3d"),
    "adhesion": ("fig2", "fig4b_rough", "fig4b_rough_near", "fig4b_smooth", "dmt_error"),
    "loops": ("fig4a",),
}
# Keys of criteria, and axes of the table of a_V within which they must lie.
WITHIN_TABLE = (
    ("a_v.pressure", "pressure"),
    ("map.hurst", "hurst"),
    ("compared.hurst", "hurst"),
    ("compared.magnification.minimum", "magnification"),
    ("compared.magnification.maximum", "magnification"),
    ("compared.quoted_magnification", "magnification"),
    ("compared.h_rms_over_range.minimum", "range, inverted:"),
    ("compared.h_rms_over_range.maximum", "range, inverted:"),
    ("compared.quoted_h_rms_over_range", "range, inverted:"),
)

AtMost = f.whole(ge=2, le=128)
Estimator = Literal["multilevel", "plain"]
EvenNumbers = Annotated[f.Several[f.whole(ge=2, multiple_of=2)], Field(min_length=2)]
Axis = Annotated[
    f.Values,
    Field(min_length=4),
    f.demand(lambda values: values == sorted(values), "must be in increasing order"),
]


class Fidelity(Section):
    """A preset of accuracy.

    Each realisation is also solved on half the points, which gives the discretisation error, and on
    2 points per shortest wavelength. With `coarse_seeds` further realisations are solved on the
    coarse grid only; at least 32, so that the effect of their long waves can be fitted.
    """

    pixels_per_wavelength: f.Pixels = needed("grid points per shortest wavelength")
    tolerance: f.number(gt=0, le=1e-3) = needed("residual of the solver over h_rms")
    seeds: f.Count = needed("realisations of a case")
    coarse_seeds: f.CoarseCount = optional("realisations on the coarse grid only; default 64")
    comparisons: f.Several[str] = optional("which of comparisons.surfaces to compute; default all")


class Sampling(Section):
    """How means over realisations are estimated.

    `plain` takes the mean of the seeds; `multilevel` corrects it by coarse solutions of more seeds,
    and these by the long waves of further seeds, which need no solution.
    """

    method: Estimator = needed("how the mean is estimated")
    descriptor_seeds: f.whole(ge=100, le=100000) = needed("realisations for long waves alone")
    at_most: AtMost = optional("largest number of seeds chosen for an accuracy; default 128")


class Band(Section):
    """Spectrum and cell of a random periodic surface."""

    hurst: f.Hurst
    magnification: f.Magnification
    window: f.number(ge=1) = optional("side of the cell over 2 pi/q0; default 1")


class ModelSurface(Band, Direction):
    """A random periodic surface.

    Error models were measured with gaussian amplitudes (the default) and without a roll-off.
    """

    rolloff: f.Magnification = optional("q_rolloff/q0, below which the spectrum is flat")
    amplitudes: Literal["gaussian", "fixed"] = optional("amplitudes of the modes")

    def _problems(self, context):
        if self.rolloff is not None and self.rolloff >= self.magnification:
            limit = f"magnification = {self.magnification:g}"
            yield f"rolloff = {self.rolloff:g} must be below {limit}"


class Case(Section):
    """A contact simulation."""

    surface: str = needed("name in model_surfaces")
    pressures: f.Loads
    accuracy: f.Share = optional("relative error that covers 90 %, e.g. 0.03")
    at_most: AtMost = optional("largest number of seeds for it; overrides sampling.at_most")
    quantities: f.Several[Literal[QUANTITIES]] = optional(
        "what is wanted; default all but contact_slope, which needs seeds instead of accuracy"
    )
    model: Literal["simulation", "theory"] = optional("Persson's theory alone; default simulation")
    seeds: f.Count = optional("realisations of this case; overrides all other numbers of them")
    sampling: Estimator = optional("overrides sampling.method")
    maps: f.Values = optional("loads at which gaps and pressures of the first seed are kept")

    def _problems(self, context):
        for key in ("accuracy", "at_most", "seeds", "sampling", "maps"):
            value = getattr(self, key)
            if self.model == "theory" and value is not None:
                yield f"{key} = {value!r} is for simulations; leave it out with model: theory"
        if self.at_most is not None and self.accuracy is None:
            yield f"at_most = {self.at_most} needs accuracy; give seeds for a fixed number"
        for pressure in self.maps or []:
            if pressure not in self.pressures:
                yield f"maps: {pressure:g} is not among the case's pressures"


class Comparison(Band):
    """A surface on which theory is compared with simulation."""

    seeds: f.whole(ge=2, le=10000) = needed("realisations")
    coarse_seeds: f.CoarseCount = optional("realisations on the coarse grid only; default none")
    pixels_per_wavelength: f.Pixels = optional("upper limit of the number of the fidelity")


class Comparisons(Section):
    """Comparison of theory with simulation, beside the cases."""

    pressures: f.Loads
    surfaces: f.Names[Comparison] = needed("surfaces by name; one job solves all of one surface")


class Table(Section):
    """Points at which a_V is tabulated, at least 4 along each axis, in increasing order."""

    hurst: Annotated[Axis, Field(description="Hurst exponents")]
    magnification: Annotated[Axis, Field(description="magnifications q1/q0")]
    pressure: Annotated[Axis, Field(description="mean pressures over E* q0 h_rms")]
    range: f.Grid = needed("range over h_rms")


class Sweep(Section):
    """Theory on continuous spectra for every combination of the lists."""

    one_of = (("pressure", "mean_gap"),)

    hurst: f.Several[f.Hurst] = needed("Hurst exponents")
    magnification: f.Several[f.Magnification] = needed("magnifications q1/q0")
    pressure: f.Values = optional("mean pressures over E* q0 h_rms")
    mean_gap: f.Values = optional("mean gaps over h_rms, instead of pressures")


class Theory(Section):
    """Persson's theory."""

    variants: Annotated[
        f.Several[Literal["afferrante2018", "almqvist2011"]],
        f.demand(
            lambda variants: "afferrante2018" in variants, "lacks 'afferrante2018', which is quoted"
        ),
    ] = needed("afferrante2018 is quoted and must be there; others show the spread")
    gamma: f.Share = needed("gamma of Yang & Persson's correction; 1 switches the correction off")
    table: Table = needed("points at which a_V is tabulated")
    sweeps: f.Names[Sweep] = needed("computations on continuous spectra, by name")


class FitIntervals(Section):
    """Intervals of the fit of a_V; others than the first show their influence."""

    windows: f.Several[f.Interval[f.Positive]] = needed("of range/h_rms; the first is quoted")


class Adhesive(Section):
    """Adhesive parameters of simulations."""

    one_of = (("q0_h_rms", "window and h_rms"),)

    law: f.Law
    q0_h_rms: f.Positive = optional("q0 h_rms; or give window and h_rms")
    window: f.Length = optional('longest wavelength, e.g. "100 um"')
    h_rms: f.Length = optional('rms height, e.g. "5 um"')
    adhesion_length_over_range: f.Values = needed("work of adhesion over E* and over the range")


class AdhesiveMaps(Section):
    """States of the first realisation, simulated in full, whose fields are kept."""

    pressures: f.Loads
    range_over_h_rms: f.Positive = needed("range over h_rms")
    adhesion_length_over_range: f.Positive = needed("adhesion length over range")


class AdhesionSet(Adhesive):
    """Adhesion for every combination of the lists.

    Adhesion is computed at the mean gaps that the pressures have without it: `dmt` sums the
    attraction over the gaps without adhesion, `full` simulates by boundary elements, and `auto`
    takes dmt where its measured error is within the accuracy.
    """

    case: str = needed("name in cases")
    range_over_h_rms: f.Values = needed("ranges of attraction over h_rms")
    pressures: f.Values = needed("some of the case's pressures")
    model: Literal["auto", "dmt", "full"] = needed("how adhesion is computed")
    accuracy: f.Share = optional("allowed relative error of 1/kappa_ad, for model: auto")
    seeds: f.Count = optional("largest number of realisations that are simulated in full")
    refine: Literal[1, 2, 4] = optional("refinement of the case's grid; default 1")
    half_from: f.Positive = optional(
        "range over h_rms from which states are solved on every second point along each side, "
        "where that leaves 4 points per shortest wavelength; default never"
    )
    maps: AdhesiveMaps = optional("states whose fields are kept")

    def _problems(self, context):
        if self.model == "auto" and self.accuracy is None:
            yield "accuracy is missing; model: auto chooses by it, relative in 1/kappa_ad"
        if self.model != "auto" and self.accuracy is not None:
            yield f"accuracy = {self.accuracy:g} needs model: auto, which chooses by it"
        for key in ("seeds", "refine", "half_from", "maps"):
            if self.model == "dmt" and getattr(self, key) is not None:
                yield f"{key} is of the full model; leave it out with model: dmt"


class Loop(Adhesive):
    """Approach and separation of one realisation."""

    surface: str = needed("name in model_surfaces")
    range_over_h_rms: f.Positive = needed("range of attraction over h_rms")
    pressure: f.Positive = needed("largest mean pressure over E* q0 h_rms")


class ReferenceCase(Section):
    """Where the a_V of the paper's criterion is simulated; theory extrapolates it."""

    case: str = needed("name in cases")
    pressure: f.Positive = needed("one of the pressures of that case, over E* q0 h_rms")


class CriterionMap(Section):
    """Map of the paper's criterion, Figure 5."""

    hurst: f.Hurst
    shortest_over_range: f.Positive = needed("shortest wavelength over the range of attraction")
    range_times_q0: f.Grid = needed("range times q0")
    adhesion_length_over_range: f.Grid = needed("adhesion length over range")
    slope_parameter: f.Values = needed("range q0/(l_a/range) of the curves of the slope angle")
    slope_a_v: f.Positive = needed("a_V of these curves")


class Compared(Section):
    """Adhesion that each criterion requires, Figure 9."""

    hurst: f.Hurst
    range_times_q0: f.Positive = needed("range times q0")
    h_rms_over_range: f.Grid = needed("rms height over range")
    quoted_h_rms_over_range: f.Positive = needed("where the magnification is varied")
    magnification: f.Grid = needed("q1/q0")
    quoted_magnification: f.Magnification = needed("where the rms height is varied")


class Criteria(Section):
    """Criteria of stickiness."""

    a_v: ReferenceCase = needed("where the a_V of the paper's criterion is simulated")
    frequencies: f.Grid = needed("frequencies [Hz] at which pairs are judged, beside 1 Hz")
    map: CriterionMap = needed("map of the paper's criterion, Figure 5")
    compared: Compared = needed("adhesion that each criterion requires, Figure 9")


class Configuration(Section):
    """The user's configuration, together with that of the paper's figures."""

    results: f.Text = needed("folder for everything that is computed, with one for each fidelity")
    fidelity: str = needed("preset to use: draft, standard, fine or one of your own")
    seeds: f.Count = optional("number of realisations; overrides the preset's")
    fidelities: f.Names[Fidelity] = needed("presets of accuracy by name")
    sampling: Sampling = needed("how means over realisations are estimated")
    gaps: f.Grid = needed("gaps over h_rms at which attractive areas and P(u) are evaluated")
    model_surfaces: f.Names[ModelSurface] = needed("random periodic surfaces, by name")
    cases: f.Names[Case] = needed("contact simulations by name")
    materials: str = needed("file of the materials")
    surfaces: str = needed("file of the real surfaces")
    experiments: str = needed("file of the published experiments")
    comparisons: Comparisons = needed("surfaces on which theory is compared with simulation")
    theory: Theory = needed("Persson's theory")
    a_v: FitIntervals = needed("fit of a_V to attractive areas")
    adhesion: f.Names[AdhesionSet] = needed("sets of adhesive parameters, by name")
    loops: f.Names[Loop] = needed("approach and separation of one realisation, by name")
    criteria: Criteria = needed("criteria of stickiness")

    def _problems(self, context):
        for table, names in PAPER.items():
            for name in names:
                if name not in attrgetter(table)(self):
                    yield f"{table}: {name!r} is missing; the paper's figures and claims need it"
        if self.adhesion["fig2"].maps is None:
            yield "adhesion.fig2.maps is missing; Figure 2 needs it: {pressures, ...}"
        if self.adhesion["dmt_error"].model != "full":
            yield "adhesion.dmt_error.model must be full; the error of the DMT sum is measured"
        for key, name, known in self._references():
            if name not in known:
                yield f.unknown(key, name, known)
        for name in sorted(self.comparisons.surfaces.keys() & self.cases.keys()):
            yield f"comparisons.surfaces.{name} has the name of a case; give it another"
        for user, key, case, loads in self._uses():
            for key_of_case in ("quantities", "model"):
                value = getattr(self.cases[case], key_of_case)
                if value not in (None, "simulation"):
                    yield (
                        f"cases.{case}.{key_of_case} = {value!r}: leave it out, {user} needs every "
                        "quantity by simulation; or add a case"
                    )
            for load in loads:
                if load not in self.cases[case].pressures:
                    yield f"{key} = {load:g} is not among the pressures of cases.{case}"
        for key, value, axis, low, high in self._limits():
            if not low <= value <= high:
                yield f"{key} = {value:g} must lie within {axis} {low:g} … {high:g}"

    def _references(self):
        """Yield keys that name entries: key, name, and the entries that there are."""
        yield "fidelity", self.fidelity, self.fidelities
        for key, fidelity in self.fidelities.items():
            for name in fidelity.comparisons or []:
                yield f"fidelities.{key}.comparisons", name, self.comparisons.surfaces
        for table in ("cases", "loops"):
            for key, entry in getattr(self, table).items():
                yield f"{table}.{key}.surface", entry.surface, self.model_surfaces
        for key, asked in self.adhesion.items():
            yield f"adhesion.{key}.case", asked.case, self.cases
        yield "criteria.a_v.case", self.criteria.a_v.case, self.cases

    def _uses(self):
        """Yield what needs every quantity of a case: who does, and key, case and loads."""
        a_v = self.criteria.a_v
        yield "criteria.a_v", "criteria.a_v.pressure", a_v.case, [a_v.pressure]
        for name, asked in reversed(self.adhesion.items()):
            user = f"adhesion.{name}"
            yield user, f"{user}.pressures", asked.case, asked.pressures
        for case in PAPER["cases"]:
            yield "the paper's figures and claims", "", case, []

    def _limits(self):
        """Yield keys that the grid of gaps and the table of a_V limit, with both limits."""
        gaps = "gaps.minimum … gaps.maximum:", self.gaps.minimum, self.gaps.maximum
        for index, window in enumerate(self.a_v.windows):
            for end in window:
                yield f"a_v.windows[{index}]", end, *gaps
        for key, asked in self.adhesion.items():
            for value in asked.range_over_h_rms:
                yield f"adhesion.{key}.range_over_h_rms", value, *gaps
        table = self.theory.table
        axes = dict(table)
        axes["range, inverted:"] = 1 / table.range.maximum, 1 / table.range.minimum
        for key, axis in WITHIN_TABLE:
            limits = f"theory.table.{axis}", axes[axis][0], axes[axis][-1]
            yield f"criteria.{key}", attrgetter(key)(self.criteria), *limits


class PresetErrors(Section):
    """Errors that the presets may have in full adhesion."""

    quantities: f.Several[Literal["inverse_kappa_ad", "threshold", "pull_off"]]
    accuracy: f.Names[f.Share]


class Presets(Section):
    """Rule of the presets: the cheapest settings for an error in every quantity."""

    surface: str
    pressures: f.Loads
    accuracy: f.Names[f.Share]
    adhesive: PresetErrors


class Settings(Section):
    """Settings of the solver."""

    tolerances: f.Values
    at_tolerance: f.Positive
    at_pixels: f.Pixels


class PullOff(Section):
    """Pull-off during separation under a press."""

    tolerances: f.Values
    at_tolerance: f.Positive
    pixels: EvenNumbers
    points: f.Several[f.Pair[f.Positive]]
    seeds: f.Count
    pressure: f.Positive
    at_balance: f.Positive


class FullAdhesion(Settings):
    """Full adhesion with various settings."""

    surfaces: f.Names[ModelSurface]
    q0_h_rms: f.Positive
    law: f.Law
    pressures: f.Loads
    points: f.Several[f.Pair[f.Positive]]
    pixels: EvenNumbers
    most_points: f.whole(ge=16)
    seeds: f.Count
    more_seeds: f.Count
    pull_off: PullOff


class Counts(Section):
    """Numbers of realisations."""

    fine: f.Count
    finest: f.Count
    coarse: f.Count
    described: f.Count


class MeasuredSurfaces(Section):
    """Surfaces that error models are fitted to."""

    first_seed: f.whole(ge=1)
    counts: Counts
    pixels: EvenNumbers
    pressures: f.Values = optional("loads, if not those of the campaign")
    surfaces: f.Names[ModelSurface]


class Validation(MeasuredSurfaces):
    """Surfaces that the choice of settings is checked on."""

    accuracies: f.Several[f.Share]


class Tradeoff(Section):
    """What accuracy costs, as `snakemake tradeoff` measures it, and the rule of the presets."""

    presets: Presets
    settings: Settings
    pressures: f.Loads
    adhesion: FullAdhesion
    cases: MeasuredSurfaces
    finer: MeasuredSurfaces
    validation: Validation

    def _problems(self, context):
        rule, user = self.presets, context["config"]
        if rule.surface not in user["model_surfaces"]:
            yield f.unknown("presets.surface", rule.surface, user["model_surfaces"])
        for name in rule.accuracy:
            for table in (user["fidelities"], rule.adhesive.accuracy):
                if name not in table:
                    yield f.unknown("presets.accuracy", name, table)


class RemainingSet(ModelSurface):
    """A surface on which adhesion is simulated."""

    one_of = (("zones", "ranges"),)

    points: f.whole(ge=32, multiple_of=2)
    seeds: f.Several[f.Index]
    energies: f.Values
    zones: f.Values = optional("q0 range^2/adhesion_length")
    ranges: f.Values = optional("ranges over h_rms")
    squeezes: f.Values = optional("pressures before separation, over E* q0 h_rms; by default 0.1")

    def _problems(self, context):
        yield from super()._problems(context)
        least = 2 * self.magnification * (self.window or 1)
        if self.points < least:
            yield f"points = {self.points} must be at least {least:g}, two per shortest wavelength"


class Remaining(Section):
    """How much adhesion remains, as `snakemake remaining_measured` simulates it."""

    law: f.Law
    squeeze: f.Positive
    sets: f.Names[RemainingSet]


MODELS = {
    "config": Configuration,
    "materials": Materials,
    "surfaces": Surfaces,
    "experiments": Experiments,
    "tradeoff": Tradeoff,
    "remaining": Remaining,
}
