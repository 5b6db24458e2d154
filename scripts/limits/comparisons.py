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
}
#: Fields of `Roughness` of which rows may tell, but for the elastic energy.
MODELLED = (
    *("q1", "rms_slope", "waves", "shape", "shape_error"),
    *("relative_compliance", "flow", "half_space_energy", "solid", "unresolved"),
)
#: Half-widths of limits that are tried, in ln w.
HALF_WIDTHS = np.linspace(0.0, 3.0, 601)
NEXT_TO_NOTHING = 0.01  # share, below which an error is absolute
LEAST_SHARE = 0.02  # of which ratios of pull-offs and works are taken
LEAST_LACKING = 0.02  # energy, over that of the others
LEAST_LOST = 1e-3  # ln of what roughness takes from the force, of weights
#: Columns of what is the same for all places of a ball.
OF_BALL = ("law", "tabor", "hurst", "skewness", "shortest", "waves", "height")
BALL_RANGE = 3e-10  # m
BALL_WORK = 0.05  # J/m^2
ROUNDING = 1e-4  # of shares: tolerance of simulations, rounding of tables


@dataclass(frozen=True)
class Comparison:
    """Predictions of one kind beside simulations.

    The rows have their `role`, what was `simulated`, and the `value` predicted. `low` and `high`
    are limits from other, known errors. `unit` is what the calibrated error is proportional to.
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
    def half_width(self) -> NDArray:
        """Half-width of the limits without the error, on the side of what was simulated."""
        value, low, high = self.predicted
        return np.where(self.simulated > value, high - value, value - low)

    def limit(self, spread: Limited[float]) -> Limited[NDArray]:
        """Value and limits with an error, which adds in quadrature."""
        value, low, high = self.predicted
        below, above = np.sort([spread.low * self.unit, spread.high * self.unit], axis=0)
        return Limited(
            value=value + spread.value * self.unit,
            low=value - np.hypot(value - low, below),
            high=value + np.hypot(high - value, above),
        )

    @property
    def limits(self) -> Limited[NDArray]:
        """Value and limits with the error as it is calibrated."""
        return self.limit(self.law.spread)


@dataclass(frozen=True)
class ShareByTheory(Comparison):
    """Shares by the spectrum of which the rows tell; their error is one of ln w."""

    @cached_property
    def needed(self) -> NDArray:
        """Least half-width in ln w, up to the largest tried, with which limits hold the share."""
        low, high = (
            predict(model(self.rows).deviating(eta).share_by_theory, self.rows, error=HALF_WIDTHS)
            for eta in (-1.0, 1.0)
        )
        simulated = self.simulated[:, None]
        holds = (low - ROUNDING <= simulated) & (simulated <= high + ROUNDING)
        return np.where(holds.any(axis=1), HALF_WIDTHS[holds.argmax(axis=1)], HALF_WIDTHS[-1])

    @property
    def limits(self) -> Limited[NDArray]:
        """Value and limits as the library gives them, with all errors."""
        return find_limits(Roughness.share, self.rows)


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
    known = {name: rows[name].to_numpy()[:, None] for name in MODELLED if name in rows}
    energy = rows.full_contact_energy.to_numpy()[:, None]
    return Roughness(h_rms=1.0, q0=Q0, elastic_energy=energy, **known)


def add_waves(rows):
    """Add the finest waves, and how many of the longest a cell has: few are one realisation."""
    return rows.assign(q1=Q0 * rows.magnification, waves=rows.window.astype(float))


def find_gaussian(heights, window):
    """Rows on Gaussian heights in cells of so many of the longest waves along a side."""
    return heights[(heights.kind == heights_table.GAUSSIAN) & (heights.window == window)]


def of_heights(rows):
    """Shares by the spectrum alone, on heights in cells of one size."""
    (window,) = rows.window.unique()
    return ShareByTheory(errors.CELLS[window], add_waves(rows))


def of_weak(heights):
    """Shares by the spectrum where next to nothing remains; the error fades with the adhesion."""
    rows = find_gaussian(heights, window=4)
    rows = rows[rows.theory < NEXT_TO_NOTHING]
    onset = predict(model(add_waves(rows)).onset, rows)[:, 0]
    unit = errors.WEAK.unit(rows.energy_ratio / onset)
    return Comparison(errors.WEAK, rows.assign(value=rows.theory, unit=unit))


def of_skewed(heights):
    """Shares by the spectrum and the skewness, whose error goes with the ln of its factor."""
    rows = heights[(heights.kind != heights_table.GAUSSIAN) & (heights.window == 4)]
    shape, error = np.transpose([find_height_shape(skewness) for skewness in rows.skewness])
    unit = errors.SKEWNESS.unit(shape)
    rows = add_waves(rows).assign(shape=shape, shape_error=error, unit=unit)
    return ShareByTheory(errors.SKEWNESS, rows)


def of_solids(solids):
    """Shares by the spectrum on every kind of solids."""
    for law in sorted(errors.SOLIDS, key=lambda law: law.kind):
        rows = solids[solids.kind == law.kind].dropna(subset="simulated")
        if len(rows):
            rows = rows.assign(solid="layer" if law.kind == "thin" else law.kind)
            yield ShareByTheory(law, rows.assign(unit=law.unit(model(rows))[:, 0]))


def of_paths(remaining):
    """Pull-off, and works of making and breaking contact, by the energy gained; logarithms."""
    rows = remaining[(remaining.window >= 2) & (remaining.bound > LEAST_SHARE)]
    rows = rows.dropna(subset=["approach", "separation", "pull_off"])
    # The theory's distance over which the work acts, beside the simulated one.
    distance = predict(model(add_waves(rows)).distance, rows)[:, 0]
    quantities = {
        errors.TENSION: (rows.pull_off, rows.adhesion_length * rows.bound / distance),
        errors.APPROACH: (rows.approach, rows.bound),
        errors.SEPARATION: (rows.separation, rows.bound),
    }
    for law, (simulated, predicted) in quantities.items():
        rows = rows.assign(simulated=np.log(simulated), value=np.log(predicted))
        yield Comparison(law, rows)


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


def of_pull_offs(pull_offs, exponent):
    """Logarithms of pull-offs by states whose distance shortens by an exponent.

    Rows are left out where next to nothing remains, and where contact is full: there the strength
    of the law bounds the pull-off.
    """
    rows = pull_offs.dropna(subset="pull_off")
    rows = rows[(rows.path_share > LEAST_SHARE) & (rows.energy_ratio < PULL_OFF_KNOWN)]
    distance = rows.distance * rows.range_ratio**exponent
    predicted = np.log(rows.adhesion_length * rows.share / distance)
    rows = rows.assign(simulated=np.log(rows.pull_off), value=predicted)
    return Comparison(errors.STATES_TENSION, rows)


def of_patches(patches, least):
    """Thresholds of maps for the surface that they were cut from.

    The error is a least one, in quadrature with one that goes with the rms distance of the
    thresholds of the quarters from that of the patch.
    """
    rows = patches.dropna(subset=["threshold_10", "whole_threshold_10"])
    value = rows.threshold_10
    quarters = rows[[f"q{number}_10" for number in (1, 2, 3, 4)]]
    distance = np.sqrt((quarters.sub(value, axis=0) ** 2).mean(axis=1))
    rows = rows.assign(
        simulated=rows.whole_threshold_10,
        value=value,
        low=value - least,
        high=value + least,
        unit=errors.PATCH.unit(distance),
    )
    return Comparison(errors.PATCH, rows)


def of_larger(larger):
    """Thresholds of scans for larger contacts; the error goes with the root of the doublings."""
    rows = larger.dropna(subset=["value_10", "whole_threshold_10"])
    rows = rows.assign(
        simulated=rows.whole_threshold_10,
        value=rows.value_10,
        low=rows.low_10,
        high=rows.high_10,
        unit=errors.LARGER.unit(rows.parts),
        unlike=find_unlikeness(rows.unevenness, rows["shape"]),
    )
    return Comparison(errors.LARGER, rows)


def of_unlike(scans, of_gaussian):
    """The same with the error of Gaussian heights, and what others add as they are unlike these."""
    limited = scans.limit(of_gaussian)._asdict()
    unit = errors.UNLIKE.unit(scans.rows.parts, scans.rows.unlike)
    return replace(scans, law=errors.UNLIKE, rows=scans.rows.assign(**limited, unit=unit))


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
