"""Limits of what remains: how far simulations lie from predictions, by kind of prediction."""

from decimal import ROUND_CEILING, ROUND_FLOOR, ROUND_HALF_EVEN, Context
from typing import NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from common.conventions import annotate
from common.job import start
from limits import comparisons
from stickiness import __version__, datasets
from stickiness.formatting import number, percent, table
from stickiness.limited import Limited
from stickiness.remaining import errors

COVERAGE = 0.9
TAILS = (0.05, 0.95)
RESAMPLES = 400  # of surfaces, for how well a size is known
SEED = 1  # of these
UNRESOLVED_SHARES = {"10": 0.1, "30": 0.3}  # at which what lacks is calibrated, by column
MOST_RATIO = 0.3  # of the range to that simulated, for a place between both bounds
LEAST_ROOM = 0.005  # between both bounds of a share, for a place between them
SUMMITS = (4.0, 9.3, 20.0)  # independent heights in a zone one wave wide that are tried
HARD = 1.0  # Tabor's parameter, from which on solids are soft
MOST_OF_PIXEL = 3.0  # forces of one pixel, below which a sum over rigid solids is not resolved
NEARLY_LEAST = 1.05  # of errors: factor within which they are taken as equal
UNLIMITED = "limits have no end on that side"
ERROR_VARIABLES = {
    "row": "simulation",
    "kind": "by what is predicted",
    "group": "of one kind",
    "required": "size of the error with which limits hold a simulation",
    "left_out": "size by the simulations of all other surfaces",
    "limit": ("1", "error by the limits: of S, of ln w, of balls of ln of the force", UNLIMITED),
    "needed": ("1", "that error with which limits hold a simulation", UNLIMITED),
    "distance": ("1", "rms distance of the quarters of a map in ln w", "no map"),
    "share": ("1", "at which thresholds of a map are compared", "no map"),
    "tabor": ("1", "Tabor's parameter of a ball", "no ball"),
}
COLUMNS = (
    *("kind", "quantity", "value", "low", "high"),
    *("least", "most", "rows", "surfaces", "source"),
)
COMMENT = f"""\
# Limits of what remains, calibrated with version {__version__} (target limits_calibrated) on the
# tables named as source: value, low and high limit, which cover 90 %; between which the high limit
# is by 90 % of resampled surfaces; numbers of simulations and of surfaces. Read by
# stickiness.remaining.calibration. kind: what is predicted, and by what. quantity: share, the
# error of a share (of "spectrum" by the number of waves); first_touch, of the mean gap over h_rms;
# ln_work, the error of the logarithm of the work of adhesion (of "skewness" over the logarithm of
# its factor, of "thin" over the flow, of "film" over the logarithm of what bending takes of the
# energy, of "patch" over the rms distance of the quarters' thresholds, of "larger" contacts over
# the share of the energy in longer waves times what makes the scan unlike Gaussian heights);
# ln_tension and ln_path, of simulated over predicted ones, the low limit of a path for making
# contact and the high one for breaking it (tensions of "states" over a factor that grows with the
# work of adhesion at which contact is nearly lost); place, of a share between both bounds, over
# w/U_full (1 - ratio of ranges)^2; unresolved, ln w beyond the energy that lacks, over the root of
# ln(1 + lacking energy) and the cube of the share lost; ln_force, of balls, over the root of ln of
# the factor that roughness takes from the force; summits, independent heights in a zone one wave
# wide, low and high with errors within 5 % of the least.
"""


def main(job):
    tables = comparisons.read_tables(job.input)
    sizes = [
        *fit_theory(tables),
        fit_size(comparisons.of_coated(tables["coated"])),
        fit_size(comparisons.of_patches(tables["patches"])),
        fit_size(comparisons.of_larger(tables["larger"])),
        fit_balls(tables["balls"]),
    ]
    rows = [describe_size(size) for size in sizes]
    rows += [
        describe_summits(tables["balls"]),
        describe_first_touch(tables["long_ranges"]),
        *(describe_spread(each, find_spread(each)) for each in list_spreads(tables)),
        describe_states(tables["heights"]),
    ]
    text = COMMENT + pd.DataFrame(rows, columns=COLUMNS).to_csv(index=False, float_format="%.4g")
    summaries = summarise(sizes), summarise_pull_offs(tables["pull_offs"])
    for output, content in (
        (job.output.table, text),
        (job.output.summary, "\n\n".join(summaries)),
    ):
        with datasets.whole_file(output) as path:
            path.write_text(content, encoding="utf-8")
    of_rows = pd.concat([list_errors(size) for size in sizes], ignore_index=True)
    datasets.write(
        annotate(of_rows.rename_axis("row").to_xarray(), **ERROR_VARIABLES),
        job.output.dataset,
        title="errors of what is predicted to remain, beside the limits made of them",
        parameters={"coverage": COVERAGE},
    )


class Size(NamedTuple):
    """Size of the errors of one kind of prediction."""

    comparison: comparisons.Comparison
    required: NDArray  # by every row
    size: float  # of the error over its unit

    @property
    def limit(self):
        """Error by the limits, of every row."""
        return np.hypot(self.comparison.half_width, self.size * self.comparison.unit)

    @property
    def left_out(self):
        """Size by the rows of all other surfaces, of every row."""
        return leave_out(self.required, self.comparison.surfaces, find_size)

    @property
    def is_inside(self):
        """Whether limits made of all other surfaces hold a row."""
        return self.required <= self.left_out


def fit_size(comparison):
    """Size of the error that holds `COVERAGE` of the rows."""
    required = comparison.required
    return Size(comparison, required, find_size(required))


def find_size(required):
    """Size of the error that holds `COVERAGE` of rows."""
    return float(np.quantile(required, COVERAGE, method="higher"))


def leave_out(values, surfaces, find):
    """What is found by the values of all other surfaces, for every value."""
    found = np.empty(values.shape)
    for each in np.unique(surfaces):
        found[surfaces == each] = find(values[surfaces != each])
    return found


def resample(values, surfaces, find):
    """5 and 95 % of what is found by surfaces that are drawn anew: rows are not independent."""
    rng = np.random.default_rng(SEED)
    of_surface = [values[surfaces == each] for each in np.unique(surfaces)]
    drawn = rng.integers(len(of_surface), size=(RESAMPLES, len(of_surface)))
    found = [find(np.concatenate([of_surface[each] for each in draw])) for draw in drawn]
    return np.quantile(found, TAILS)


def describe(comparison, spread, bounds, law=None):
    """Row of the table; `spread` is value, low, high, and `bounds` are those of the high limit.

    Limits are rounded outwards to four digits: the row that sets a limit would else lie beyond it.
    """
    rounded = [
        float(Context(prec=4, rounding=rounding).create_decimal(repr(float(each))))
        for each, rounding in zip(
            spread, (ROUND_HALF_EVEN, ROUND_FLOOR, ROUND_CEILING), strict=True
        )
    ]
    counts = len(comparison.rows), np.unique(comparison.surfaces).size
    law = law or comparison.law
    return (law.kind, law.quantity, *rounded, *bounds, *counts, law.source)


def describe_size(size):
    """Row of the table for an error about zero."""
    bounds = resample(size.required, size.comparison.surfaces, find_size)
    return describe(size.comparison, (0.0, -size.size, size.size), bounds)


def describe_spread(comparison, spread, law=None):
    """Row of the table for errors whose middle and limits are found."""
    bounds = resample(comparison.error, comparison.surfaces, lambda error: take_middle(error).high)
    return describe(comparison, spread, bounds, law)


def find_spread(comparison):
    """Median error, and the limits of the middle 90 %."""
    return take_middle(comparison.error)


def take_middle(error):
    """Median, and the limits of the middle 90 %."""
    return Limited(np.median(error), *np.quantile(error, TAILS))


def list_errors(size):
    """Errors of all rows, as `ERROR_VARIABLES` says."""
    comparison = size.comparison
    rows = pd.DataFrame(
        {
            "kind": comparison.law.kind,
            "group": comparison.groups,
            "required": size.required,
            "left_out": size.left_out,
            "limit": size.limit,
            "needed": np.hypot(comparison.half_width, size.required * comparison.unit),
            "distance": comparison.column("distance", np.nan),
            "share": comparison.column("share", np.nan),
            "tabor": comparison.column("tabor", np.nan),
        }
    )
    return rows.replace(np.inf, np.nan)


def fit_theory(tables):
    """Sizes of errors of shares by the spectrum: of the theory, of skewness, and of solids."""
    compared = (
        comparisons.of_theory(tables),
        comparisons.of_skewed(tables["heights"]),
        *comparisons.of_solids(tables["solids"]),
    )
    return [fit_size(each) for each in compared]


def fit_balls(balls):
    """Size of the error of ln of the force of balls."""
    summits, *_ = find_summits(balls)
    return fit_size(comparisons.of_balls(balls[find_resolved(balls)], summits))


def describe_summits(balls):
    """Row of the table for the independent heights in a zone one wave wide."""
    hard = choose_hard(balls)
    summits = find_summits(balls)
    return describe(
        comparisons.of_balls(hard, summits[0]), summits, summits[1:], law=errors.SUMMITS
    )


def find_summits(balls):
    """Number of independent heights with which hard solids have the least error, and its range."""
    hard = choose_hard(balls)
    sizes = np.array([fit_size(comparisons.of_balls(hard, summits)).size for summits in SUMMITS])
    good = np.array(SUMMITS)[sizes <= NEARLY_LEAST * sizes.min()]
    return SUMMITS[sizes.argmin()], good.min(), good.max()


def choose_hard(balls):
    """Rows of hard solids, for which alone the height of first touch matters."""
    return balls[find_resolved(balls) & (balls.tabor < HARD)]


def find_resolved(balls):
    """Whether more than a single pixel of a rigid solid holds; one has the strength of the law."""
    of_pixel = (balls.side / balls.points) ** 2 / np.pi
    return (balls.tabor > 0) | (balls.simulated > MOST_OF_PIXEL * of_pixel)


def describe_first_touch(long_ranges):
    """Row of the table for the highest summits, whose middle is the law of the library."""
    touch = comparisons.of_first_touch(long_ranges)
    return describe_spread(touch, find_spread(touch)._replace(value=0.0))


def list_spreads(tables):
    """Comparisons whose middle and limits are found."""
    yield from comparisons.of_paths(tables["remaining"])

    # Between the bound and the chord, where there is room. What lies below the bound, some 0.002,
    # is the error of the grid, which `states, share` holds.
    ranges = tables["ranges"]
    has_room = ranges.chord - ranges.bound > LEAST_ROOM
    places = comparisons.of_ranges(ranges[has_room & (ranges.range_ratio < MOST_RATIO)])
    yield places.with_least_error(0.0)

    # Beyond the energy that lacks.
    yield comparisons.of_unresolved(tables["unresolved"], UNRESOLVED_SHARES)

    # At the range of the states pull-offs are known within 10 %. Surfaces attract at shorter ones.
    pull_offs = tables["pull_offs"]
    yield comparisons.of_pull_offs(pull_offs[pull_offs.range_ratio < 1])


def describe_states(heights):
    """Row of the table for shares by states that are simulated on the same heights."""
    states = comparisons.of_states(heights[heights.window == 4])
    required = find_share_error(states.rows)
    return describe_size(Size(states, required, find_size(required)))


def find_share_error(rows):
    """Error of shares by states with which limits hold every simulated share."""
    share = rows.states.to_numpy()
    missed = np.maximum(np.abs(share - rows.simulated.to_numpy()) - comparisons.ROUNDING, 0.0)
    return errors.find_needed_error(share, missed)


def summarise(sizes):
    """Coverage and width of limits, by what is predicted, as a table in Markdown."""
    lines = []
    for size in sizes:
        for group in pd.unique(size.comparison.groups):
            chosen = size.comparison.groups == group
            comparison = size.comparison.where(chosen)
            judged = judge(comparison)
            lines.append(
                (
                    group,
                    str(chosen.sum()),
                    str(np.unique(comparison.surfaces).size),
                    percent(np.mean(size.is_inside[chosen])),
                    number(find_factor(comparison, size.limit[chosen]), 3),
                    *judged,
                )
            )
    columns = ("by", "rows", "surfaces", "inside", "high/low", "mean width of S")
    return table((*columns, "decided", "false"), lines)


def find_factor(comparison, limit):
    """Median ratio of both limits: of the threshold of w, of balls of the force."""
    if isinstance(comparison, comparisons.ByTheory):
        value, low, high = comparison.find_log_thresholds()
        return float(np.exp(np.median(low - high)))
    return float(np.exp(2 * np.median(limit)))


def judge(comparison):
    """Mean width of the limits of shares, share of decided pairs, and number of false ones."""
    if not isinstance(comparison, comparisons.ByTheory):
        return ("", "", "")
    width, decided, false = comparisons.judge_shares(comparison.limits, comparison.simulated)
    return number(width, 2), percent(decided), str(false)


def summarise_pull_offs(pull_offs):
    """Coverage and errors of pull-offs by states, by the range, as a table in Markdown."""
    compared = comparisons.of_pull_offs(pull_offs)
    value, low, high = find_spread(compared.where(compared.rows.range_ratio < 1))
    of_rows = compared.rows.assign(error=compared.error)
    lines = []
    for ratio, part in of_rows.groupby("range_ratio", sort=False):
        inside = percent(part.error.between(low, high).mean())
        median = number(float(np.exp(((part.error - value) * part.unit).median())), 3)
        lines.append((number(ratio, 2), str(len(part)), inside, median))
    columns = ("range over that of the states", "pull-offs", "inside")
    return table((*columns, "simulated over predicted"), lines)


if __name__ == "__main__":
    main(start(globals()))
