"""Models of config/config.yaml and config/campaigns/paper.yaml, which are read as one."""

from operator import attrgetter
from typing import Annotated, Any, Literal, Self

from pydantic import AfterValidator, model_validator

from common.config.campaigns import HeightCampaign, LimitCampaign, Remaining, Tradeoff
from common.config.experiments import Experiments
from common.config.simulations import (
    AdhesionSet,
    Case,
    Comparisons,
    Fidelity,
    Grid,
    Hursts,
    Loop,
    Magnification,
    ModelSurface,
    Roles,
    Sampling,
    Values,
)
from stickiness.accuracy.quantities import MODELLED
from stickiness.entries import fields as f
from stickiness.entries.errors import EntryError, suggest
from stickiness.entries.fields import Section, needed, optional
from stickiness.entries.material import Materials
from stickiness.entries.surface_entry import Surfaces

# What the figures and the claims read; may be edited but not removed.
PAPER = {
    "theory.sweeps": ("fig1a", "fig1b", "fig3a", "fig3b", "fig3c", "fig3d"),
    "adhesion": (
        "fig2",
        "fig4b_rough",
        "fig4b_rough_near",
        "fig4b_smooth",
        "dmt_error",
        "dmt_error_zeta128",
    ),
    "loops": ("fig4a",),
}
# Roles whose cases these need with every quantity; of the others they need Hurst exponents alone.
SIMULATED_ROLES = ("narrow_band", "middle_band", "broad_band", "wide_cell")
# Rms heights over the range at which a_V is known, and the keys that lie between them.
HEIGHTS_KNOWN = 0.1, 1e14
HEIGHTS = ("h_rms_over_range.minimum", "h_rms_over_range.maximum", "quoted_h_rms_over_range")


def check_quoted(variants: list[str]) -> list[str]:
    """Check that the variant of the theory that is quoted is there."""
    if "afferrante2018" not in variants:
        raise ValueError("lacks 'afferrante2018', which is quoted")
    return variants


class Sweep(Section):
    """Theory on continuous spectra for every combination of the lists."""

    one_of = (("pressure", "mean_gap"),)

    hurst: Hursts = needed("Hurst exponents, or roles that have them")
    magnification: f.Several[Magnification] = needed("magnifications q1/q0")
    pressure: Values = optional("mean pressures over E* q0 h_rms")
    mean_gap: Values = optional("mean gaps over h_rms, instead of pressures")


class Theory(Section):
    """Persson's theory."""

    variants: Annotated[
        f.Several[Literal["afferrante2018", "almqvist2011"]], AfterValidator(check_quoted)
    ] = needed("afferrante2018 is quoted and must be there; others show the spread")
    gamma: f.Share = needed("gamma of Yang & Persson's correction; 1 switches the correction off")
    sweeps: f.Names[Sweep] = needed("computations on continuous spectra, by name")


class FitIntervals(Section):
    """Intervals of the fit of a_V; others than the first show their influence."""

    windows: f.Several[f.Interval[f.Positive]] = needed("of range/h_rms; the first is quoted")


class ReferenceCase(Section):
    """Where the a_V of the paper's criterion is simulated; theory extrapolates it."""

    case: str = needed("name in cases, or a role")
    pressure: f.Positive = needed("one of the pressures of that case, over E* q0 h_rms")


class CriterionMap(Section):
    """Map of the paper's criterion, Figure 5."""

    hurst: f.Hurst
    shortest_over_range: f.Positive = needed("shortest wavelength over the range of attraction")
    range_times_q0: Grid = needed("range times q0")
    adhesion_length_over_range: Grid = needed("adhesion length over range")
    slope_parameter: Values = needed("range q0/(l_a/range) of the curves of the slope angle")
    slope_a_v: f.Positive = needed("a_V of these curves")


class Compared(Section):
    """Adhesion that each criterion requires, Figure 9."""

    hurst: f.Hurst
    range_times_q0: f.Positive = needed("range times q0")
    h_rms_over_range: Grid = needed("rms height over range")
    quoted_h_rms_over_range: f.Positive = needed("where the magnification is varied")
    magnification: Grid = needed("q1/q0")
    quoted_magnification: Magnification = needed("where the rms height is varied")


class Criteria(Section):
    """Criteria of stickiness."""

    a_v: ReferenceCase = needed("where the a_V of the paper's criterion is simulated")
    map: CriterionMap = needed("map of the paper's criterion, Figure 5")
    compared: Compared = needed("adhesion that each criterion requires, Figure 9")


class Configuration(Section):
    """The user's configuration, together with that of the paper's figures."""

    results: f.Text = needed("folder for everything that is computed, with one for each fidelity")
    fidelity: str = needed("preset to use: draft, standard, fine or one of your own")
    seeds: f.Count = optional("number of realisations; overrides the preset's")
    fidelities: f.Names[Fidelity] = needed("presets of accuracy by name")
    sampling: Sampling = needed("how means over realisations are estimated")
    gaps: Grid = needed("gaps over h_rms at which attractive areas and P(u) are evaluated")
    model_surfaces: f.Names[ModelSurface] = needed("random periodic surfaces, by name")
    cases: f.Names[Case] = needed("contact simulations by name")
    roles: Roles = needed("cases of the paper's figures and claims, by what they are to these")
    materials: str = needed("file of the materials")
    surfaces: str = needed("file of the real surfaces")
    experiments: str = needed("file of the published experiments")
    comparisons: Comparisons = needed("surfaces on which theory is compared with simulation")
    theory: Theory = needed("Persson's theory")
    a_v: FitIntervals = needed("fit of a_V to attractive areas")
    adhesion: f.Names[AdhesionSet] = needed("sets of adhesive parameters, by name")
    loops: f.Names[Loop] = needed("approach and separation of one realisation, by name")
    criteria: Criteria = needed("criteria of stickiness")

    @model_validator(mode="after")
    def check_paper(self) -> Self:
        """Check that what the paper's figures and claims need is there."""
        for table, names in PAPER.items():
            for name in names:
                if name not in attrgetter(table)(self):
                    text = "is missing; the paper's figures and claims need it"
                    raise EntryError(f"{table}.{name}", None, text)
        if self.adhesion["fig2"].maps is None:
            text = "is missing; Figure 2 needs it: {pressures, ...}"
            raise EntryError("adhesion.fig2.maps", None, text)
        if self.adhesion["dmt_error"].model != "full":
            text = "must be full; the error of the DMT sum is measured"
            raise EntryError("adhesion.dmt_error.model", self.adhesion["dmt_error"].model, text)
        return self

    @model_validator(mode="after")
    def resolve_roles(self) -> Self:
        """Put names of cases and surfaces in the place of roles, which no others may have."""
        surfaces = {}
        for role, case in self.roles:
            if case not in self.cases:
                raise EntryError(
                    f"roles.{role}", case, f"unknown name; {suggest(case, self.cases)}"
                )
            surfaces[role] = self.cases[case].surface
            for table, meant in (("cases", case), ("model_surfaces", surfaces[role])):
                if role in getattr(self, table) and role != meant:
                    text = f"has the name of a role, which is that of {meant}; choose another"
                    raise EntryError(f"{table}.{role}", None, text)
        cases = dict(self.roles)
        for entry in (*self.adhesion.values(), self.criteria.a_v):
            entry.case = cases.get(entry.case, entry.case)
        for loop in self.loops.values():
            loop.surface = surfaces.get(loop.surface, loop.surface)
        return self

    @model_validator(mode="after")
    def check_names(self) -> Self:
        """Check that every name of another entry exists, and that names are not taken twice."""
        for key, name, entries in self._references():
            if name not in entries:
                raise EntryError(key, name, f"unknown name; {suggest(name, entries)}")
        for name in self.comparisons.surfaces:
            if name in self.cases:
                text = "is the name of a case; give the comparison another"
                raise EntryError(f"comparisons.surfaces.{name}", None, text)
        return self

    @model_validator(mode="after")
    def find_hurst_exponents(self) -> Self:
        """Put Hurst exponents of surfaces in the place of roles, each of them once."""
        exponents: dict[Any, float] = {
            role: self.model_surfaces[self.cases[case].surface].hurst for role, case in self.roles
        }
        for key, sweep in self.theory.sweeps.items():
            for index, hurst in enumerate(sweep.hurst):
                if isinstance(hurst, str) and hurst not in exponents:
                    text = f"must be a number or a role; {suggest(hurst, exponents)}"
                    raise EntryError(f"theory.sweeps.{key}.hurst[{index}]", hurst, text)
            found = (exponents.get(hurst, hurst) for hurst in sweep.hurst)
            sweep.hurst = list(dict.fromkeys(found))
        return self

    @model_validator(mode="after")
    def check_uses(self) -> Self:
        """Check that cases have all quantities and loads that something needs."""
        for user, key, case, loads in self._uses():
            entry = self.cases[case]
            if entry.model == "theory" or not {*entry.quantities} >= {*MODELLED}:
                text = (
                    f"{user} needs every quantity by simulation: leave out quantities and model, "
                    "or add a case"
                )
                raise EntryError(f"cases.{case}", None, text)
            for load in loads:
                if load not in entry.pressures:
                    raise EntryError(key, load, f"is not among the pressures of cases.{case}")
        return self

    @model_validator(mode="after")
    def check_heights(self) -> Self:
        """Check that heights are Gaussian where theory stands for them."""
        cases = [*self._simulated_cases(), self.criteria.a_v.case]
        cases += [self.adhesion[name].case for name in PAPER["adhesion"]]
        for case in cases:
            surface = self.cases[case].surface
            if self.model_surfaces[surface].heights is not None:
                text = f"must be left out, since cases.{case} needs Gaussian heights; add a surface"
                raise EntryError(f"model_surfaces.{surface}.heights", None, text)
        for case, entry in self.cases.items():
            if entry.model == "theory" and self.model_surfaces[entry.surface].heights is not None:
                text = f"takes heights as Gaussian, and model_surfaces.{entry.surface} has others"
                raise EntryError(f"cases.{case}.model", entry.model, f"{text}: simulate it")
        return self

    @model_validator(mode="after")
    def check_limits(self) -> Self:
        """Check that values lie within the grids on which they are looked up."""
        for key, value, axis, low, high in self._limits():
            if not low <= value <= high:
                text = f"must lie within {axis} {low:g} … {high:g}"
                raise EntryError(key, value, text)
        return self

    def _simulated_cases(self):
        """List the cases that the paper's figures and claims need with every quantity."""
        return [getattr(self.roles, role) for role in SIMULATED_ROLES]

    def _references(self):
        """Yield keys that name entries: key, name, and the entries that there are."""
        yield "fidelity", self.fidelity, self.fidelities
        for key, fidelity in self.fidelities.items():
            for name in fidelity.comparisons or []:
                yield f"fidelities.{key}.comparisons", name, self.comparisons.surfaces
        for key, case in self.cases.items():
            yield f"cases.{key}.surface", case.surface, self.model_surfaces
        # Known roles were replaced by names; an unknown name may be meant for one.
        roles = dict(self.roles)
        for key, loop in self.loops.items():
            yield f"loops.{key}.surface", loop.surface, self.model_surfaces | roles
        for key, adhesion in self.adhesion.items():
            yield f"adhesion.{key}.case", adhesion.case, self.cases | roles
        yield "criteria.a_v.case", self.criteria.a_v.case, self.cases | roles

    def _uses(self):
        """Yield what needs every quantity of a case: who does, and key, case and loads."""
        a_v = self.criteria.a_v
        yield "criteria.a_v", "criteria.a_v.pressure", a_v.case, [a_v.pressure]
        for name, adhesion in reversed(self.adhesion.items()):
            user = f"adhesion.{name}"
            yield user, f"{user}.pressures", adhesion.case, adhesion.pressures
        for case in self._simulated_cases():
            yield "the paper's figures and claims", "", case, []

    def _limits(self):
        """Yield keys that the grid of gaps and theory limit, with both limits."""
        gaps = "gaps.minimum … gaps.maximum:", self.gaps.minimum, self.gaps.maximum
        for index, window in enumerate(self.a_v.windows):
            for end in window:
                yield f"a_v.windows[{index}]", end, *gaps
        for key, adhesion in self.adhesion.items():
            for value in adhesion.range_over_h_rms:
                yield f"adhesion.{key}.range_over_h_rms", value, *gaps
        for key in HEIGHTS:
            value = attrgetter(key)(self.criteria.compared)
            yield f"criteria.compared.{key}", value, "a_V is known at h_rms/range", *HEIGHTS_KNOWN


MODELS = {
    "config": Configuration,
    "materials": Materials,
    "surfaces": Surfaces,
    "experiments": Experiments,
    "tradeoff": Tradeoff,
    "remaining": Remaining,
    "heights": HeightCampaign,
    "limits": LimitCampaign,
}
