"""Limits of what remains: how far simulations lie from predictions, by kind of prediction."""

from dataclasses import replace
from decimal import ROUND_CEILING, ROUND_FLOOR, ROUND_HALF_EVEN, Context
from itertools import chain
from typing import NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from common.conventions import annotate
from common.job import start
from common.model_surfaces import make_heights
from limits import comparisons
from stickiness import __version__, datasets
from stickiness.formatting import number, percent, table
from stickiness.limited import Limited
from stickiness.remaining import errors
from stickiness.remaining.share import FIRST_TOUCH

COVERAGE = 0.9
ROLES = ("fitted", "unseen")
TAILS = (0.05, 0.95)
LEAST_ERRORS = np.linspace(0.05, 0.4, 71)  # of a patch that are tried, in ln w
LEAST_WEIGHT = 0.1  # of what makes a solid other than a half-space
UNRESOLVED_SHARES = {"10": 0.1, "30": 0.3}  # at which what lacks is calibrated, by column
MOST_RATIO = 0.3  # of the range to that simulated, for a place between both bounds
LEAST_ROOM = 0.005  # between both bounds of a share, for a place between them
SUMMITS = (4.0, 9.3, 20.0)  # independent heights in a zone one wave wide that are tried
HARD = 1.0  # Tabor's parameter, from which on solids are soft
MOST_OF_PIXEL = 3.0  # forces of one pixel, below which a sum over rigid solids is not resolved
NEARLY_LEAST = 1.05  # of errors: factor within which they are taken as equal
ERROR_VARIABLES = {
    "row": "simulation",
    "kind": "by what the share is predicted",
    "role": "whether limits are fitted to it",
    "needed": "error of ln w, of balls of ln of the force, with which limits hold a simulation",
    "limit": "that error by the limits",
    "weight": "what the error goes with: of patches the rms distance of the quarters in ln w",
    "tabor": ("1", "Tabor's parameter of a ball", "no ball"),
}
COLUMNS = ("kind", "quantity", "value", "low", "high", "fitted", "unseen", "source")
COMMENT = f"""\
# Limits of what remains, calibrated with version {__version__} (target limits_calibrated) on the
# tables named as source: value, low and high limit, which cover 90 %; numbers of simulations, those
# that are fitted and those that are unseen. Read by stickiness.remaining.calibration. kind: what is
# predicted, and by what. quantity: ln_work, the error of the logarithm of the work of adhesion (of
# "skewness" over the logarithm of its factor, of solids over their distance from a half-space, of
# "patch" over the rms distance of the quarters' thresholds, of "larger" contacts over the root of
# the doublings of the scan, and of "larger non-Gaussian" ones over that times what makes the scan
# unlike Gaussian heights); share, absolute; first_touch, mean gap over h_rms; ln_tension,
# ln_approach, ln_separation, of simulated over predicted ones; place, of a share between both
# bounds, over w/U_full (1 - ratio of ranges)^2; shortening, exponent of the ratio of ranges with
# which the distance of the attraction falls; unresolved, ln w beyond the energy that lacks, over
# the root of ln(1 + lacking energy) and the cube of the share lost; least, of a patch; ln_force, of
# balls, over the root of ln of the factor that roughness takes from the force; summits, independent
# heights in a zone one wave wide, low and high with errors within 5 % of the least.
"""


class Fit(NamedTuple):
    """Limits made of the errors of one kind of prediction."""

    comparison: comparisons.Comparison
    slope: float  # of the error against its unit
    limit: NDArray  # of every row
    others: tuple = ()  # rows of the table for what else is found


def main(job):
    tables = comparisons.read_tables(job.input)
    heights = tables["heights"]
    coated = comparisons.of_coated(tables["coated"])
    fits = [
        *fit_shares(heights, tables["remaining"], tables["solids"]),
        fit_slope(coated, base=coated.half_width),
        fit_patches(tables["patches"]),
        *fit_larger(tables["larger"]),
        fit_balls(tables["balls"]),
    ]
    rows = [
        *chain.from_iterable(describe_fit(fit) for fit in fits),
        calibrate_weak(heights),
        calibrate_first_touch(job.params.touching),
        *calibrate_paths(tables["remaining"]),
        *calibrate_states(heights, tables["ranges"], tables["unresolved"]),
        *calibrate_pull_offs(tables["pull_offs"]),
    ]
    text = COMMENT + pd.DataFrame(rows, columns=COLUMNS).to_csv(index=False, float_format="%.4g")
    summaries = summarise(fits, heights, tables["solids"]), summarise_pull_offs(tables["pull_offs"])
    for output, content in (
        (job.output.table, text),
        (job.output.summary, "\n\n".join(summaries)),
    ):
        with datasets.whole_file(output) as path:
            path.write_text(content, encoding="utf-8")
    of_rows = pd.concat([list_errors(fit) for fit in fits], ignore_index=True)
    datasets.write(
        annotate(of_rows.rename_axis("row").to_xarray(), **ERROR_VARIABLES),
        job.output.dataset,
        title="errors of what is predicted to remain, beside the limits made of them",
        parameters={"coverage": COVERAGE},
    )


def describe(comparison, spread, law=None):
    """Row of the table; `spread` is value, low, high, which are rounded to four digits.

    Limits are rounded outwards: the row that sets a limit would else lie beyond it.
    """
    rounded = [
        float(Context(prec=4, rounding=rounding).create_decimal(repr(float(each))))
        for each, rounding in zip(
            spread, (ROUND_HALF_EVEN, ROUND_FLOOR, ROUND_CEILING), strict=True
        )
    ]
    counts = [int((comparison.rows.role == role).sum()) for role in ROLES]
    law = law or comparison.law
    return (law.kind, law.quantity, *rounded, *counts, law.source)


def describe_fit(fit):
    """Rows of the table for an error about zero, and for what else is found."""
    return [describe(fit.comparison, symmetric(fit.slope)), *fit.others]


def list_errors(fit):
    """Errors of all rows, as `ERROR_VARIABLES` says."""
    return pd.DataFrame(
        {
            "kind": fit.comparison.law.kind,
            "role": fit.comparison.rows.role.to_numpy(),
            "needed": fit.comparison.needed,
            "limit": fit.limit,
            "weight": fit.comparison.unit,
            "tabor": fit.comparison.column("tabor", np.nan),
        }
    )


def symmetric(half_width):
    """Value, low and high limit of an error about zero."""
    return Limited(0.0, -half_width, half_width)


def find_half_width(needed, role):
    """Half-width that holds `COVERAGE` of the fitted rows."""
    return float(np.quantile(needed[role == "fitted"], COVERAGE, method="higher"))


def find_middle(comparison, least=-np.inf):
    """Median error of the fitted rows, and the limits of the middle 90 %; no less than a least."""
    error = np.maximum(comparison.error, least)[comparison.rows.role == "fitted"]
    return Limited(np.median(error), *np.quantile(error, TAILS))


def fit_slope(comparison, base):
    """Limits of `base`, in quadrature with a slope that holds `COVERAGE` of the fitted rows."""
    excess = np.sqrt(np.maximum(comparison.needed**2 - base**2, 0.0))
    slope = find_half_width(excess / comparison.unit, comparison.rows.role)
    return Fit(comparison, slope, np.hypot(base, slope * comparison.unit))


def fit_shares(heights, remaining, solids):
    """Limits of shares by the spectrum: in cells of three sizes, on skewed heights, on solids."""
    one_wave = remaining[remaining.window == 1]
    cells = [
        comparisons.of_heights(comparisons.find_gaussian(heights, window=4)),
        comparisons.of_heights(comparisons.find_gaussian(heights, window=2)),
        comparisons.of_heights(one_wave),
    ]
    of_cells = [fit_slope(cell, base=0.0) for cell in cells]
    others = [
        comparisons.of_skewed(heights),
        *(each.where(each.unit > LEAST_WEIGHT) for each in comparisons.of_solids(solids)),
    ]
    return [*of_cells, *(fit_slope(other, base=of_cells[0].slope) for other in others)]


def fit_patches(patches):
    """Limits of what a map says of its surface, beside a least error.

    Of the least errors that are tried, the one with the narrowest limits is taken.
    """
    fits = {
        least: fit_slope(comparisons.of_patches(patches, least), base=least)
        for least in LEAST_ERRORS
    }
    best = min(fits, key=lambda least: np.median(fits[least].limit))
    row = describe(fits[best].comparison, symmetric(best), errors.PATCH_LEAST)
    return fits[best]._replace(others=(row,))


def fit_larger(larger):
    """Limits of what scans say of larger contacts: of Gaussian heights, and of others."""
    scans = comparisons.of_larger(larger)
    is_unlike = scans.unit * scans.rows.unlike > LEAST_WEIGHT
    gaussian = scans.where(~is_unlike)
    of_gaussian = fit_slope(gaussian, base=gaussian.half_width)
    unlike = comparisons.of_unlike(scans.where(is_unlike), symmetric(of_gaussian.slope))
    return of_gaussian, fit_slope(unlike, base=unlike.half_width)


def fit_balls(balls):
    """Limits of ln of the force of balls, with a number of independent heights in a zone.

    The number is that with which hard solids have the least error.
    """
    resolved = balls[find_resolved(balls)]
    # The height of first touch matters for hard solids alone.
    fitted = resolved[(resolved.tabor < HARD) & (resolved.role == "fitted")]
    slopes = np.array([fit_forces(fitted, summits).slope for summits in SUMMITS])
    good = np.array(SUMMITS)[slopes <= NEARLY_LEAST * slopes.min()]
    best = SUMMITS[slopes.argmin()]
    fit = fit_forces(resolved, best)
    hard = fit.comparison.where(fit.comparison.rows.tabor < HARD)
    row = describe(hard, (best, good.min(), good.max()), errors.SUMMITS)
    return fit._replace(others=(row,))


def fit_forces(balls, summits):
    """Limits of forces with so many independent heights in a zone one wave wide."""
    comparison = comparisons.of_balls(balls, summits)
    return fit_slope(comparison, base=comparison.half_width)


def find_resolved(balls):
    """Whether more than a single pixel of a rigid solid holds; one has the strength of the law."""
    of_pixel = (balls.side / balls.points) ** 2 / np.pi
    return (balls.tabor > 0) | (balls.simulated > MOST_OF_PIXEL * of_pixel)


def calibrate_weak(heights):
    """Theory of the spectrum where next to nothing remains, of few rows, fitted and unseen."""
    weak = comparisons.of_weak(heights)
    return describe(weak, symmetric(float(np.quantile(abs(weak.error), COVERAGE))))


def calibrate_first_touch(touching):
    """Mean gap at which the highest summit touches, in cells of 4 to 16 waves a side."""
    summits = [
        make_heights(surface, surface["points"], seed).max()
        for surface in touching
        for seed in range(surface["seeds"])
    ]
    low, high = np.quantile(summits, TAILS)
    return ("spectrum", "first_touch", FIRST_TOUCH, low, high, len(summits), 0, "synthesised")


def calibrate_paths(remaining):
    """Pull-off, and works of making and breaking contact over the energy gained."""
    return [describe(path, find_middle(path)) for path in comparisons.of_paths(remaining)]


def calibrate_states(heights, ranges, unresolved):
    """States simulated on heights: on the same heights, at shorter ranges, with waves lacking."""
    states = comparisons.of_states(heights[heights.window == 4])
    half_width = find_half_width(find_share_error(states.rows), states.rows.role)
    yield describe(states, symmetric(half_width))

    # Between the bound and the chord, where there is room.
    has_room = ranges.chord - ranges.bound > LEAST_ROOM
    places = comparisons.of_ranges(ranges[has_room & (ranges.range_ratio < MOST_RATIO)])
    # What lies below the bound, some 0.002, is the error of the grid, which `share` holds.
    yield describe(places, find_middle(places, least=0.0))

    # Beyond the energy that lacks.
    lacking = comparisons.of_unresolved(unresolved, UNRESOLVED_SHARES)
    yield describe(lacking, find_middle(lacking))


def calibrate_pull_offs(pull_offs):
    """Pull-off by states simulated on heights: how their distance shortens, and what that errs.

    At the range of the states the pull-off is known within 10 %. Surfaces attract at shorter ones,
    of which the limits are.
    """
    shortening, fitted = fit_pull_offs(pull_offs)
    shorter = fitted.where(fitted.rows.range_ratio < 1)
    yield describe(shorter, shortening, errors.SHORTENING)
    # The median is that of the exponent.
    yield describe(shorter, find_middle(shorter)._replace(value=0.0))


def fit_pull_offs(pull_offs):
    """Spread of the exponent with which distances shorten, and pull-offs by its middle."""
    unshortened = comparisons.of_pull_offs(pull_offs, exponent=0.0)
    shorter = unshortened.where(unshortened.rows.range_ratio < 1)
    # In the unit of -ln of the ratio of ranges, errors are exponents.
    exponents = shorter.rows.assign(unit=errors.SHORTENING.unit(shorter.rows.range_ratio))
    shortening = find_middle(replace(shorter, rows=exponents))
    return shortening, comparisons.of_pull_offs(pull_offs, shortening.value)


def find_share_error(rows):
    """Error of shares by states with which limits hold every simulated share."""
    share = rows.states.to_numpy()
    missed = np.maximum(np.abs(share - rows.simulated.to_numpy()) - comparisons.ROUNDING, 0.0)
    return errors.find_needed_error(share, missed)


def summarise(fits, heights, solids):
    """Coverage and width of limits, by what is predicted, as a table in Markdown.

    Widths of shares and decisions are those of the committed table of limits.
    """
    shares = [
        comparisons.of_heights(comparisons.find_gaussian(heights, window=4)),
        comparisons.of_skewed(heights),
        *comparisons.of_solids(solids),
    ]
    of_kinds = {share.law.kind: share for share in shares}
    lines = []
    for comparison, _, limit, _ in fits:
        for role in comparison.rows.role.unique():
            chosen = (comparison.rows.role == role).to_numpy()
            inside = percent(np.mean((comparison.needed <= limit)[chosen]))
            factor = number(np.exp(2 * np.median(limit[chosen])), 3)
            judged = ("", "", "")
            if comparison.law.kind in of_kinds:
                judged = judge_role(of_kinds[comparison.law.kind], role)
            lines.append(
                (
                    comparison.law.label,
                    role,
                    str(chosen.sum()),
                    inside,
                    factor,
                    *judged,
                )
            )
    columns = ("by", "rows", "number", "inside", "high/low w", "mean width of S")
    return table((*columns, "decided", "false"), lines)


def judge_role(comparison, role):
    """Mean width of the limits of shares in fitted or unseen rows, decided pairs, false ones."""
    chosen = comparison.where(comparison.rows.role == role)
    width, decided, false = comparisons.judge_shares(chosen.limits, chosen.simulated)
    return number(width, 2), percent(decided), str(false)


def summarise_pull_offs(pull_offs):
    """Coverage and errors of pull-offs by states, by the range, as a table in Markdown."""
    _, fitted = fit_pull_offs(pull_offs)
    _, low, high = find_middle(fitted.where(fitted.rows.range_ratio < 1))
    of_rows = fitted.rows.assign(error=fitted.error)
    lines = []
    for (role, ratio), part in of_rows.groupby(["role", "range_ratio"], sort=False):
        inside = percent(part.error.between(low, high).mean())
        median = number(float(np.exp(part.error.median())), 3)
        lines.append((role, number(ratio, 2), str(len(part)), inside, median))
    columns = ("pull-offs", "range over that of the states", "number", "inside")
    return table((*columns, "simulated over predicted"), lines)


if __name__ == "__main__":
    main(start(globals()))
