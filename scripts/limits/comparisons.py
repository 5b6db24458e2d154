"""What is predicted beside what was simulated, row by row of the committed tables.

Limits are calibrated on these comparisons, and the page of validation says how well they hold.
"""

from dataclasses import dataclass, replace
from functools import cache, cached_property, partial
from pathlib import Path
from typing import Self

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike, NDArray

import campaigns.balls
import campaigns.coated
import campaigns.larger
import campaigns.long_ranges
import campaigns.patches
import campaigns.pull_offs
import campaigns.ranges
import campaigns.solids
import campaigns.unresolved
from common import committed, heights_table, remaining_table
from common.conventions import Q0
from stickiness.entries.material import Material
from stickiness.limited import Limited
from stickiness.remaining import errors
from stickiness.remaining.errors import ErrorLaw
from stickiness.remaining.height_shape import find_height_shape
from stickiness.remaining.roughness import PULL_OFF_KNOWN, Roughness
from stickiness.remaining.share import find_first_touch
from stickiness.remaining.trial_states import DEFAULT_SHARE
from stickiness.verdicts.longer_waves import find_unlikeness
from stickiness.verdicts.meeting import meet
from stickiness.verdicts.rough_ball import BallContact, find_contact
from stickiness.verdicts.rough_surface import Surface

#: Columns of the tables behind limits, by their names.
SIMULATED = {
    "solids": campaigns.solids.COLUMNS,
    "patches": campaigns.patches.COLUMNS,
    "ranges": campaigns.ranges.COLUMNS,
    "pull_offs": campaigns.pull_offs.COLUMNS,
    "unresolved": campaigns.unresolved.COLUMNS,
    "larger": campaigns.larger.COLUMNS,
    "coated": campaigns.coated.COLUMNS,
    "balls": campaigns.balls.COLUMNS,
    "long_ranges": campaigns.long_ranges.COLUMNS,
}
#: Fields of `Roughness` of which rows may tell, but for the elastic energy.
MODELLED = (
    *("q1", "rms_slope", "waves", "shape", "shape_error"),
    *("relative_compliance", "flow", "half_space_energy", "rigid_base_energy"),
    *("solid", "unresolved"),
)
#: Half-widths of limits that are tried, in ln w.
HALF_WIDTHS = np.linspace(0.0, 3.0, 601)
TRIED_FIRST = 25  #: every so many of them
LEAST_SHARE = 0.02  # of which ratios of pull-offs and works are taken
LEAST_LACKING = 0.02  # energy, over that of the others
SMALLEST = 1e-9  # unit of an error that is divided by
LEAST_LOST = 1e-3  # ln of what roughness takes from the force, of weights
#: Columns of what is the same for all places of a ball.
OF_BALL = ("law", "tabor", "hurst", "skewness", "shortest", "waves", "height")
BALL_RANGE = 3e-10  # m
BALL_WORK = 0.05  # J/m^2
ROUNDING = 1e-4  # of shares: tolerance of simulations, rounding of tables
CELLS = (1, 2, 4)  # of the longest waves along a side
LAYER = "layer"  # kind of solids that errs as half-spaces do
PATHS = ("approach", "separation")  # works of making and of breaking contact


#: Shares of the work of adhesion at which thresholds of patches are compared, by their columns.
PATCH_SHARES = {"3": 0.03, "10": 0.1, "30": 0.3, "60": 0.6}


@dataclass(frozen=True)
class Comparison:
    """Predictions of one kind beside simulations.

    The rows have their `set` and `seed`, what was `simulated`, and the `value` predicted. `low` and
    `high` are limits from other, known errors. `unit` is what the calibrated error is proportional
    to. A `group` tells rows of one kind apart.
    """

    law: ErrorLaw  # whose size is calibrated
    rows: pd.DataFrame

    def where(self, chosen) -> Self:
        """The same in some rows."""
        return replace(self, rows=self.rows[chosen])

    def column(self, name: str, otherwise: ArrayLike) -> NDArray:
        """A column of the rows, or what stands for it where there is none."""
        return np.broadcast_to(self.rows.get(name, otherwise), len(self.rows))

    @property
    def surfaces(self) -> NDArray:
        """Number of the surface of every row: rows of one surface are not independent."""
        return self.rows.groupby(["set", "seed"], sort=False).ngroup().to_numpy()

    @property
    def groups(self) -> NDArray:
        """Names of what rows are."""
        return self.column("group", otherwise=self.law.label)

    @property
    def simulated(self) -> NDArray:
        """What was simulated."""
        return self.rows.simulated.to_numpy()

    @property
    def unit(self) -> NDArray:
        """What the error goes with."""
        return self.column("unit", otherwise=1.0)

    @property
    def predicted(self) -> Limited[NDArray]:
        """Value and limits without the error that is calibrated."""
        value = self.rows.value.to_numpy()
        return Limited(value, self.column("low", value), self.column("high", value))

    @property
    def error(self) -> NDArray:
        """What simulations exceed predictions by, in the unit of the error."""
        return (self.simulated - self.predicted.value) / self.unit + 0.0  # 0 rather than -0

    @property
    def needed(self) -> NDArray:
        """Half-width with which limits hold what was simulated."""
        return np.abs(self.simulated - self.predicted.value)

    @property
    def required(self) -> NDArray:
        """Size of the error with which limits hold what was simulated, beside the known ones."""
        excess = np.sqrt(np.maximum(self.needed**2 - self.half_width**2, 0.0))
        return excess / self.unit

    @property
    def half_width(self) -> NDArray:
        """Half-width of the limits without the error, on the side of what was simulated."""
        value, low, high = self.predicted
        return np.where(self.simulated > value, high - value, value - low)

    def with_least_error(self, least: float) -> Self:
        """The same with errors that are no less."""
        simulated = np.maximum(self.simulated, self.predicted.value + least * self.unit)
        return replace(self, rows=self.rows.assign(simulated=simulated))

    def limit(self, spread: Limited[float]) -> Limited[NDArray]:
        """Value and limits with an error, which adds in quadrature."""
        value, low, high = self.predicted
        middle, *ends = spread
        below, above = np.sort([end * self.unit for end in ends], axis=0)
        return Limited(
            value=value + middle * self.unit,
            low=value - np.hypot(value - low, below),
            high=value + np.hypot(high - value, above),
        )

    @property
    def limits(self) -> Limited[NDArray]:
        """Value and limits with the error as it is calibrated."""
        return self.limit(self.law.spread)


@dataclass(frozen=True)
class ByTheory(Comparison):
    """Shares by the spectrum of which the rows tell."""

    @property
    def half_width(self) -> NDArray:
        """None: all known errors are in the theory."""
        return np.zeros(len(self.rows))

    @property
    def limits(self) -> Limited[NDArray]:
        """Value and limits as the library gives them, with all errors."""
        return find_limits(Roughness.share, self.rows)

    def find_log_thresholds(self) -> Limited[NDArray]:
        """Logarithm of the work of adhesion from which on the default share remains."""
        ranges = self.rows.range.to_numpy()[:, None]
        return errors.find_limits(
            model(self.rows), lambda rough: np.log(rough.threshold(ranges))[:, 0]
        )


@dataclass(frozen=True)
class TheoryOfShare(ByTheory):
    """Shares by the spectrum of which the rows tell, whose error is one of the share."""

    @property
    def unit(self) -> NDArray:
        """What the error goes with, at the value."""
        return self._find_unit(self.predicted.value)

    @property
    def required(self) -> NDArray:
        """Size of the error with which limits hold the share, beside that of the first touch."""
        _, low, high = self.predicted
        below = (low - self.simulated - ROUNDING) / self._find_unit(low)
        above = (self.simulated - high - ROUNDING) / self._find_unit(high)
        return np.maximum(np.maximum(below, above), 0.0)

    @cached_property
    def predicted(self) -> Limited[NDArray]:
        """Value and limits by the first touch alone."""
        rough = model(self.rows)
        lowest = find_first_touch(rough.waves)
        shares = (
            predict(replace(rough, first_touch=lowest + touch).share_by_theory, self.rows, error=0)
            for touch in (0.0, *errors.FIRST_TOUCH.spread[:0:-1])
        )
        return Limited(*(share[:, 0] for share in shares))

    def _find_unit(self, share: NDArray) -> NDArray:
        return errors.SHARE.unit(share, self.column("waves", np.inf)) + SMALLEST


@dataclass(frozen=True)
class ShareByTheory(ByTheory):
    """Shares by the spectrum of which the rows tell; their error is one of ln w."""

    @property
    def required(self) -> NDArray:
        """Size of the error beside those that the theory has of a half-space."""
        return self.needed / self.unit

    @cached_property
    def needed(self) -> NDArray:
        """Least half-width in ln w, up to the largest tried, with which limits hold the share."""
        # First among few of the half-widths, then among those up to the one that was found.
        among_few = self._find_first(HALF_WIDTHS[::TRIED_FIRST])
        nearer = np.maximum(among_few[:, None] - HALF_WIDTHS[TRIED_FIRST - 1 :: -1], 0.0)
        return self._find_first(nearer)

    def _find_first(self, half_widths: NDArray) -> NDArray:
        """First of the rising half-widths ``(row, trial)`` that holds, else the last."""
        low, high = (
            predict(model(self.rows).deviating(eta).share_by_theory, self.rows, error=half_widths)
            for eta in (-1.0, 1.0)
        )
        simulated = self.simulated[:, None]
        holds = (low - ROUNDING <= simulated) & (simulated <= high + ROUNDING)
        holds[:, -1] = True
        first = holds.argmax(axis=1)[:, None]
        return np.take_along_axis(np.broadcast_to(half_widths, holds.shape), first, axis=1)[:, 0]


def read_tables(paths) -> dict[str, pd.DataFrame]:
    """Read committed tables, by their names."""
    tables = {Path(path).stem: path for path in paths}
    remaining = remaining_table.read(tables["remaining"])
    return {
        "heights": heights_table.read(tables["heights"]).dropna(subset="simulated"),
        "remaining": remaining.assign(simulated=remaining.bound),
        **{kind: read_table(tables[kind], kind) for kind in SIMULATED},
    }


def read_table(path, kind):
    """Read one of the tables behind limits, with the columns of its campaign."""
    return committed.read(path, SIMULATED[kind], "limits_measured")


def predict(quantity, rows, **given):
    """Predict a number of every row, in a column, by a method of `Roughness`."""
    lengths = rows.adhesion_length.to_numpy()[:, None]
    return quantity(lengths, rows.range.to_numpy()[:, None], **given)


def find_limits(quantity, rows, **given):
    """Value and limits of rows by a function of `Roughness`, and what else is given to it."""

    def evaluate(rough):
        return predict(partial(quantity, rough), rows, **given)[:, 0]

    return errors.find_limits(model(rows), evaluate)


def model(rows):
    """`Roughness` of which rows tell, in columns."""
    # What other kinds of solids have is empty.
    given = (name for name in MODELLED if name in rows and not rows[name].isna().all())
    known = {name: rows[name].to_numpy()[:, None] for name in given}
    energy = rows.full_contact_energy.to_numpy()[:, None]
    return Roughness(h_rms=1.0, q0=Q0, elastic_energy=energy, **known)


def add_waves(rows):
    """Add the finest waves, and how many of the longest a cell has: few are one realisation."""
    return rows.assign(q1=Q0 * rows.magnification, waves=rows.window.astype(float))


def find_gaussian(heights, window):
    """Rows on Gaussian heights in cells of so many of the longest waves along a side."""
    return heights[(heights.kind == heights_table.GAUSSIAN) & (heights.window == window)]


def of_theory(tables):
    """Shares by the spectrum alone: of Gaussian heights, and of layers, which err no more.

    The theory was fitted to most cells of `remaining`, but these need no smaller an error.
    """
    heights = tables["heights"]
    cells = (tables["remaining"], heights[heights.kind == heights_table.GAUSSIAN])
    half_spaces = [
        add_waves(rows).assign(group=f"spectrum, {window} × {window}", solid="half-space")
        for table in cells
        for window, rows in table.groupby("window")
        if window in CELLS
    ]
    long_ranges = tables["long_ranges"].dropna(subset="simulated")
    long_ranges = long_ranges.assign(group="long range", solid="half-space")
    solids = tables["solids"].dropna(subset="simulated")
    layers = add_waves(solids[solids.kind == LAYER]).assign(group=LAYER, solid="layer")
    rows = pd.concat([*half_spaces, long_ranges, layers], ignore_index=True)
    # A half-space is as compliant as itself.
    return TheoryOfShare(errors.SHARE, rows.fillna({"relative_compliance": 1.0, "flow": 0.0}))


def of_heights(rows):
    """Shares by the spectrum alone, of some rows of heights."""
    return TheoryOfShare(errors.SHARE, add_waves(rows))


def of_first_touch(long_ranges):
    """The highest summit of every surface, in place of the mean gap at which it touches."""
    rows = long_ranges.drop_duplicates(["set", "seed"])
    return Comparison(
        errors.FIRST_TOUCH,
        rows.assign(simulated=rows.highest, value=find_first_touch(rows.waves)),
    )


def of_skewed(heights):
    """Shares by the spectrum and the skewness, whose error goes with the ln of its factor."""
    rows = heights[(heights.kind != heights_table.GAUSSIAN) & (heights.window == 4)]
    shape, error = np.transpose([find_height_shape(skewness) for skewness in rows.skewness])
    unit = errors.SKEWNESS.unit(shape)
    rows = add_waves(rows).assign(shape=shape, shape_error=error, unit=unit)
    return ShareByTheory(errors.SKEWNESS, rows)


def of_solids(solids):
    """Shares by the spectrum on thin layers, on those whose film bends, and on skins."""
    for law in (errors.THIN, errors.FILM, errors.SKIN):
        rows = solids[solids.kind == law.kind].dropna(subset="simulated")
        rows = add_waves(rows).assign(solid="layer" if law is errors.THIN else law.kind)
        yield ShareByTheory(law, rows.assign(unit=law.unit(model(rows))[:, 0]))


def of_paths(remaining):
    """Pull-off, and works of making and breaking contact, by the energy gained; logarithms.

    Contact is made by less work than the energy gained, and broken by more.
    """
    rows = remaining[(remaining.window >= 2) & (remaining.bound > LEAST_SHARE)]
    rows = rows.dropna(subset=["approach", "separation", "pull_off"])
    # The theory's distance over which the work acts, beside the simulated one.
    distance = predict(model(add_waves(rows)).distance, rows)[:, 0]
    energy = rows.adhesion_length * rows.bound
    tension = rows.assign(simulated=np.log(rows.pull_off), value=np.log(energy / distance))
    works = pd.concat([rows.assign(simulated=np.log(rows[name])) for name in PATHS])
    yield Comparison(errors.TENSION, tension)
    yield Comparison(errors.PATH, works.assign(value=np.log(works.bound)))


def of_states(heights):
    """Shares by states simulated on the same heights, with limits of another place."""
    rows = heights.assign(value=heights.states, low=heights.states_low, high=heights.states_high)
    return Comparison(errors.STATES, rows)


def of_ranges(ranges):
    """Shares at short ranges, above the bound by the states; up to the chord there is room."""
    rows = ranges.dropna(subset="simulated")
    room = np.maximum(rows.chord - rows.bound, 0.0)
    unit = room * errors.PLACE.unit(rows.energy_ratio, rows.range_ratio)
    return Comparison(errors.PLACE, rows.assign(value=rows.bound, unit=unit))


def of_unresolved(unresolved, shares):
    """Thresholds of shares on thinned grids for the full ones, in ln w beyond what lacks.

    The error goes with the root of the logarithm of the energy and the cube of what is lost.
    """
    parts = []
    for ending, share in shares.items():
        part = unresolved.dropna(subset=[f"thinned_{ending}", f"full_{ending}"])
        part = part[part.lacking > LEAST_LACKING]
        # Rows are in ln of the work that is needed, of which less is left for the rest.
        unit = -errors.UNRESOLVED.unit(part.lacking, 1 - share)
        simulated = part[f"full_{ending}"]
        parts.append(part.assign(simulated=simulated, value=part[f"thinned_{ending}"], unit=unit))
    return Comparison(errors.UNRESOLVED, pd.concat(parts))


def of_pull_offs(pull_offs):
    """Logarithms of pull-offs by states.

    Rows are left out where next to nothing remains, and where contact is full: there the strength
    of the law bounds the pull-off.
    """
    rows = pull_offs.dropna(subset="pull_off")
    rows = rows[(rows.path_share > LEAST_SHARE) & (rows.energy_ratio < PULL_OFF_KNOWN)]
    unit = errors.STATES_TENSION.unit(rows.lost_ratio)
    rows = rows.assign(simulated=np.log(rows.pull_off), value=np.log(rows.predicted), unit=unit)
    return Comparison(errors.STATES_TENSION, rows)


def of_patches(patches):
    """Thresholds of maps for the surface that they were cut from, at several shares.

    The error goes with the rms distance of the thresholds of the quarters from that of the patch.
    """
    quarters = patches[[f"q{number}_10" for number in (1, 2, 3, 4)]]
    distance = np.sqrt((quarters.sub(patches.threshold_10, axis=0) ** 2).mean(axis=1))
    parts = []
    for ending, share in PATCH_SHARES.items():
        part = patches.assign(
            simulated=patches[f"whole_threshold_{ending}"],
            value=patches[f"threshold_{ending}"],
            unit=errors.PATCH.unit(distance, patches.independent_areas, share),
            distance=distance,
            share=share,
            group="map, " + patches.patch_waves.astype(str) + " waves",
        )
        parts.append(part.dropna(subset=["simulated", "value", "unit"]))
    return Comparison(errors.PATCH, pd.concat(parts, ignore_index=True))


def of_larger(larger):
    """Thresholds of scans for larger contacts, where the share does not remain at any work."""
    rows = larger[np.isfinite(larger.value_10) & np.isfinite(larger.whole_threshold_10)]
    rows = rows.assign(
        simulated=rows.whole_threshold_10,
        value=rows.value_10,
        low=rows.low_10,
        high=rows.high_10,
        unit=errors.LARGER.unit(rows.longer, find_unlikeness(rows.unevenness, rows["shape"]))
        + SMALLEST,
    )
    return Comparison(errors.LARGER, rows)


def of_coated(coated, is_skin=True):
    """Works of adhesion that keep a share below skins, or on thin layers, by verdicts on maps.

    Maps lack the finest waves, to which skins are stiff.
    """
    rows = coated[coated.skin_modulus_ratio.notna() == is_skin].dropna(subset="value")
    rows = rows.assign(simulated=np.log(rows.adhesion_length), solid="skin" if is_skin else "layer")
    return Comparison(errors.COATED, rows.assign(unit=errors.COATED.unit(model(rows))[:, 0]))


def of_balls(balls, summits):
    """Logarithms of forces of balls, with so many independent heights in a zone one wave wide.

    Their error goes with the root of ln of the factor that roughness takes from the force.
    """
    groups = balls.groupby(list(OF_BALL), sort=False)
    rows = pd.concat(
        [rows.assign(**predict_force(ball, summits)) for ball, rows in groups]
    ).sort_index()
    logarithms = np.log(rows[["simulated", *Limited._fields]])
    lost = np.maximum(-logarithms.value, LEAST_LOST)
    return Comparison(errors.BALL, rows.assign(**logarithms, unit=errors.BALL.unit(lost)))


@cache
def predict_force(ball, summits):
    """Value and limits of the force of a ball over that of a smooth one, without the place's error.

    `ball` has the columns of `OF_BALL`.
    """
    contact = find_contact(replace(touch_ball(*ball), summits=summits))
    low, value, high = np.divide(contact.force, contact.smooth_force)
    return {"value": value, "low": low, "high": high}


@cache
def touch_ball(law, tabor, hurst, skewness, shortest, waves, height):
    """Contact of a ball with the surface of a user who knows its spectrum and its skewness."""
    zone = BALL_RANGE / campaigns.balls.make_ball(law, tabor).law.range
    ball = campaigns.balls.make_ball(law, tabor, zone)
    rough = Surface.from_spectrum(ball.rough(waves, height, shortest, hurst))
    shape, shape_error = find_height_shape(skewness)
    surface = Surface(rough.data.assign(shape=shape, shape_error=shape_error))
    material = Material(
        youngs_modulus=BALL_WORK / ball.law.adhesion_length,
        poisson_ratio=0.0,
        work_of_adhesion=BALL_WORK,
        range=BALL_RANGE,
        law=law,
    )
    return BallContact(
        meeting=meet(material, surface, DEFAULT_SHARE),
        material=material,
        surface=surface,
        radius=ball.radius,
        summits=np.nan,  # to be calibrated
        error=0.0,
    )


def judge_shares(limits, simulated):
    """Mean width of limits of shares, share of decided pairs, and number of false decisions."""
    low_sticks = limits.low >= DEFAULT_SHARE
    high_fails = limits.high < DEFAULT_SHARE
    sticks = simulated >= DEFAULT_SHARE
    is_false = (low_sticks & ~sticks) | (high_fails & sticks)
    return np.mean(limits.high - limits.low), np.mean(low_sticks | high_fails), is_false.sum()
