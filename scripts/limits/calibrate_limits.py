"""Limits of what remains: how far simulations lie from predictions, by kind of prediction."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd

from common import heights_table, limits_table, remaining_table
from common.conventions import Q0, annotate
from common.job import start
from common.model_surfaces import make_heights
from limits import measure_balls
from stickiness import __version__, datasets
from stickiness.entries.material import Material
from stickiness.formatting import number, percent, table
from stickiness.remaining.calibration import find_spread
from stickiness.remaining.height_shape import find_height_shape
from stickiness.remaining.roughness import PULL_OFF_KNOWN, Roughness
from stickiness.remaining.share import FIRST_TOUCH
from stickiness.remaining.trial_states import DEFAULT_SHARE
from stickiness.verdicts.longer_waves import find_unlikeness, weigh_larger
from stickiness.verdicts.pair_roughness import combine_roughness
from stickiness.verdicts.rough_ball import BallContact, find_contact
from stickiness.verdicts.rough_surface import Surface

COVERAGE = 0.9
TAILS = (0.05, 0.95)
#: Half-widths of limits that are tried, in ln w.
HALF_WIDTHS = np.linspace(0.0, 3.0, 601)
LEAST_ERRORS = np.linspace(0.05, 0.4, 71)  # of a patch that are tried, in ln w
NEXT_TO_NOTHING = 0.01  # share, below which an error is absolute
LEAST_SHARE = 0.02  # of which ratios of pull-offs and works are taken
LEAST_WEIGHT = 0.1  # of what makes a solid other than a half-space
UNRESOLVED_SHARES = {"10": 0.1, "30": 0.3}  # at which what lacks is calibrated, by column
LEAST_LACKING = 0.02  # energy, over that of the others
MOST_RATIO = 0.3  # of the range to that simulated, for a place between both bounds
LEAST_ROOM = 0.005  # between both bounds of a share, for a place between them
SUMMITS = (4.0, 9.3, 20.0)  # independent heights in a zone one wave wide that are tried
HARD = 1.0  # Tabor's parameter, from which on solids are soft
LEAST_LOST = 1e-3  # ln of what roughness takes from the force, of weights
BALL_RANGE = 3e-10  # m
BALL_WORK = 0.05  # J/m^2
MOST_OF_PIXEL = 3.0  # forces of one pixel, below which a sum over rigid solids is not resolved
NEARLY_LEAST = 1.05  # of errors: factor within which they are taken as equal
ROUNDING = 1e-4  # of shares: tolerance of simulations, rounding of tables
SOURCES = {
    "spectrum": "heights.csv",
    "two waves": "heights.csv",
    "one wave": "remaining.csv",
    "skewness": "heights.csv",
    "patch": "patches.csv",
    "larger": "larger.csv",
    "larger non-Gaussian": "larger.csv",
    "ball": "balls.csv",
}
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


def main(job):
    tables = {Path(path).stem: path for path in job.input}
    heights = add_roles(heights_table.read(tables["heights"]))
    remaining = remaining_table.read(tables["remaining"])
    simulated = {kind: limits_table.read(tables[kind], kind) for kind in limits_table.COLUMNS}
    summits, balls = compare_balls(simulated["balls"])
    cells = [
        set_limit(compare_cells("spectrum", find_gaussian(heights, window=4))),
        set_limit(compare_cells("two waves", find_gaussian(heights, window=2))),
        set_limit(compare_cells("one wave", find_single(remaining))),
    ]
    base = cells[0].limit.iloc[0]
    errors = pd.concat(
        [
            *cells,
            compare_skewness(heights, base),
            *(compare_solid(kind, rows, base) for kind, rows in group_solids(simulated["solids"])),
            compare_patches(simulated["patches"]),
            *compare_larger(simulated["larger"]),
            balls,
        ]
    )
    rows = [
        *describe_errors(errors),
        describe("ball", "summits", summits, find_hard(simulated["balls"]), "balls.csv"),
        *calibrate_weak(heights, job.params.touching),
        *calibrate_paths(remaining),
        *calibrate_states(heights, simulated["ranges"], simulated["unresolved"]),
        *calibrate_pull_offs(simulated["pull_offs"]),
    ]
    text = COMMENT + pd.DataFrame(rows, columns=COLUMNS).to_csv(index=False, float_format="%.4g")
    for output, content in (
        (job.output.table, text),
        (
            job.output.summary,
            f"{summarise(errors, heights, simulated['solids'])}\n\n"
            f"{summarise_pull_offs(simulated['pull_offs'])}",
        ),
    ):
        with datasets.whole_file(output) as path:
            path.write_text(content, encoding="utf-8")
    columns = [name for name in ERROR_VARIABLES if name != "row"]
    dataset = errors[columns].reset_index(drop=True).rename_axis("row").to_xarray()
    datasets.write(
        annotate(dataset, **ERROR_VARIABLES),
        job.output.dataset,
        title="errors of what is predicted to remain, beside the limits made of them",
        parameters={"coverage": COVERAGE},
    )


def add_roles(heights):
    """Add which sets are fitted: every second pair, since cells of two sizes alternate."""
    order = {name: place for place, name in enumerate(heights["set"].unique())}
    is_fitted = heights["set"].map(order) // 2 % 2 == 0
    return heights.assign(role=np.where(is_fitted, "fitted", "unseen")).dropna(subset="simulated")


def describe(kind, quantity, spread, rows, source):
    """Row of the table; `spread` is value, low, high."""
    count = rows.role.value_counts()
    counts = [int(count.get(role, 0)) for role in ("fitted", "unseen")]
    return (kind, quantity, *spread, *counts, source)


def symmetric(half_width):
    """Value, low and high limit of an error about zero."""
    return 0.0, -half_width, half_width


def model_heights(rows, shape=0.0):
    """`Roughness` of rows of `heights.csv`, in columns."""
    return Roughness(
        h_rms=1.0,
        q0=Q0,
        elastic_energy=rows.full_contact_energy.to_numpy()[:, None],
        q1=Q0 * rows.magnification.to_numpy()[:, None],
        rms_slope=rows.rms_slope.to_numpy()[:, None],
        shape=np.reshape(shape, (-1, 1)),
    )


def model_solids(rows):
    """`Roughness` of rows of `solids.csv`, in columns."""

    def column(name):
        return rows[name].to_numpy()[:, None]

    is_film = column("kind") == "film"
    return Roughness(
        h_rms=1.0,
        q0=Q0,
        elastic_energy=column("full_contact_energy"),
        q1=column("q1"),
        rms_slope=column("rms_slope"),
        relative_compliance=column("relative_compliance"),
        flow=column("flow"),
        half_space_energy=np.where(is_film, np.nan, column("half_space_energy")),
        is_skin=column("kind") == "skin",
    )


def find_needed(rough, rows):
    """Least half-width in ln w, up to the largest tried, with which limits hold every share."""
    lengths = rows.adhesion_length.to_numpy()[:, None]
    ranges = rows.range.to_numpy()[:, None]
    simulated = rows.simulated.to_numpy()[:, None]
    low, high = (rough.share(lengths, ranges, sign, error=HALF_WIDTHS) for sign in (-1, 1))
    holds = (low - ROUNDING <= simulated) & (simulated <= high + ROUNDING)
    return np.where(holds.any(axis=1), HALF_WIDTHS[holds.argmax(axis=1)], HALF_WIDTHS[-1])


def find_half_width(needed, role):
    """Half-width that holds `COVERAGE` of the fitted rows."""
    return float(np.quantile(needed[role == "fitted"], COVERAGE, method="higher"))


def find_gaussian(heights, window):
    """Rows on Gaussian heights in cells of so many of the longest waves along a side."""
    return heights[(heights.kind == heights_table.GAUSSIAN) & (heights.window == window)]


def find_single(remaining):
    """Rows of energies in cells of one longest wave."""
    rows = remaining[remaining.window == 1].assign(simulated=remaining.bound)
    return rows.assign(role=np.where(rows.held, "unseen", "fitted"))


def compare_cells(kind, rows):
    """Errors of the theory of the spectrum, on Gaussian heights in cells of one size."""
    return make_errors(kind, rows, find_needed(model_heights(rows), rows), weight=1.0)


def set_limit(errors):
    """Errors beside the limit that holds `COVERAGE` of the fitted ones."""
    half_width = find_half_width(errors.needed, errors.role)
    return errors.assign(slope=half_width, limit=half_width)


def make_errors(kind, rows, needed, weight):
    """Errors in ln w of one kind of prediction; `weight` is what its own error goes with."""
    return pd.DataFrame(
        {"kind": kind, "role": rows.role.to_numpy(), "needed": needed, "weight": weight}
    )


def add_limits(errors, base):
    """Add the slope of the error against its weight, in quadrature with `base`, and the limits."""
    scaled = find_excess(errors.needed, base) / errors.weight
    slope = find_half_width(scaled, errors.role)
    return errors.assign(slope=slope, limit=np.hypot(base, slope * errors.weight))


def describe_errors(errors):
    """Rows of the table for the errors in ln w."""
    for kind, rows in errors.groupby("kind", sort=False):
        source = SOURCES.get(kind, "solids.csv")
        quantity = "ln_force" if kind == "ball" else "ln_work"
        yield describe(kind, quantity, symmetric(rows.slope.iloc[0]), rows, source)
        if kind == "patch":
            yield describe(kind, "least", symmetric(rows.least.iloc[0]), rows, source)


def calibrate_weak(heights, touching):
    """Theory of the spectrum where next to nothing remains."""
    rows = find_gaussian(heights, window=4)
    weak = rows[rows.theory < NEXT_TO_NOTHING]
    rough = model_heights(weak)
    lengths = weak.adhesion_length.to_numpy()[:, None]
    onset = rough.onset(lengths, weak.range.to_numpy()[:, None])[:, 0]
    fading = np.minimum(weak.energy_ratio / onset, 1.0) ** 2
    error = float(np.quantile(abs(weak.theory - weak.simulated) / fading, COVERAGE))
    yield describe("spectrum", "share", symmetric(error), weak, "heights.csv")

    # Mean gap at which the highest summit touches, in cells of 4 to 16 waves a side.
    summits = [
        make_heights(surface, surface["points"], seed).max()
        for surface in touching
        for seed in range(surface["seeds"])
    ]
    roles = pd.DataFrame({"role": ["fitted"] * len(summits)})
    low, high = np.quantile(summits, TAILS)
    yield describe("spectrum", "first_touch", (FIRST_TOUCH, low, high), roles, "synthesised")


def find_skewed(heights):
    """Rows of skewed heights in cells of four by four waves, and the law of their skewness."""
    rows = heights[(heights.kind != heights_table.GAUSSIAN) & (heights.window == 4)]
    shape = np.array([find_height_shape(skewness).shape for skewness in rows.skewness])
    return rows, shape


def compare_skewness(heights, base):
    """Errors of the theory with the law of the skewness, which go with the log of its factor."""
    rows, shape = find_skewed(heights)
    needed = find_needed(model_heights(rows, shape), rows)
    return add_limits(make_errors("skewness", rows, needed, weight=np.abs(shape)), base)


def find_excess(needed, base):
    """What is needed beside the error of the spectrum, `base`, in quadrature."""
    return np.sqrt(np.maximum(needed**2 - base**2, 0.0))


def compare_solid(kind, rows, base):
    """Errors of the theory on other solids, which go with the distance from a half-space."""
    weight = weigh_solid(kind, rows)
    used = rows[weight > LEAST_WEIGHT]
    needed = find_needed(model_solids(used), used)
    errors = make_errors(kind, used, needed, weight=weight[weight > LEAST_WEIGHT])
    return add_limits(errors, base)


def group_solids(solids):
    """Kinds of solids and their rows."""
    return solids.dropna(subset="simulated").groupby("kind")


def weigh_solid(kind, rows):
    """Distance of a solid from a half-space, as `Roughness` takes it."""
    flow = rows.flow.to_numpy()
    compliance_lost = np.maximum(1 - rows.relative_compliance.to_numpy(), 0.0)
    weights = {
        "film": np.ones(len(rows)),
        "layer": compliance_lost * (1 - flow),
        "thin": flow,
        "skin": compliance_lost,
    }
    return weights[kind]


def calibrate_paths(remaining):
    """Pull-off, and works of making and breaking contact over the energy gained."""
    rows = remaining[(remaining.window >= 2) & (remaining.bound > LEAST_SHARE)]
    rows = rows.dropna(subset=["approach", "separation", "pull_off"])
    rows = rows.assign(role=np.where(rows.held, "unseen", "fitted"))
    fitted = rows[rows.role == "fitted"]
    # The theory's distance over which the work acts, beside the simulated one.
    rough = model_heights(fitted)
    lengths = fitted.adhesion_length.to_numpy()
    distance = rough.distance(lengths[:, None], fitted.range.to_numpy()[:, None])[:, 0]
    ratios = {
        "ln_tension": fitted.pull_off * distance / (lengths * fitted.bound),
        "ln_approach": fitted.approach / fitted.bound,
        "ln_separation": fitted.separation / fitted.bound,
    }
    for quantity, ratio in ratios.items():
        low, high = np.quantile(np.log(ratio), TAILS)
        spread = (float(np.median(np.log(ratio))), low, high)
        yield describe("spectrum", quantity, spread, rows, "remaining.csv")


def calibrate_states(heights, ranges, unresolved):
    """States simulated on heights: on the same heights, at shorter ranges, with waves lacking."""
    rows = heights[heights.window == 4]
    half_width = find_half_width(find_share_error(rows), rows.role)
    yield describe("states", "share", symmetric(half_width), rows, "heights.csv")

    # Between the bound and the chord, where there is room.
    rows = ranges.dropna(subset="simulated")
    rows = rows[(rows.chord - rows.bound > LEAST_ROOM) & (rows.range_ratio < MOST_RATIO)]
    place = (rows.simulated - rows.bound) / (rows.chord - rows.bound)
    # What lies below the bound, some 0.002, is the error of the grid, which `share` holds.
    scaled = (place / (1 - rows.range_ratio) ** 2 / rows.energy_ratio).clip(lower=0)
    yield describe("states", "place", find_middle(scaled, rows), rows, "ranges.csv")

    # Beyond the energy that lacks, over the root of its logarithm and the cube of what is lost.
    ladder = []
    for name, share in UNRESOLVED_SHARES.items():
        error = unresolved[f"thinned_{name}"] - unresolved[f"full_{name}"]
        ladder.append(unresolved.assign(scaled=error / (1 - share) ** 3))
    rows = pd.concat(ladder).dropna(subset="scaled")
    rows = rows[rows.lacking > LEAST_LACKING]
    scaled = rows.scaled / np.sqrt(np.log1p(rows.lacking))
    yield describe("states", "unresolved", find_middle(scaled, rows), rows, "unresolved.csv")


def calibrate_pull_offs(pull_offs):
    """Pull-off by states simulated on heights: how their distance shortens, and what that errs.

    At the range of the states the pull-off is known within 10 %. Surfaces attract at shorter ones,
    of which the limits are.
    """
    shortening, rows = fit_pull_offs(pull_offs)
    shorter = rows[rows.range_ratio < 1]
    _, low, high = find_middle(shorter.error, shorter)  # the median is that of the exponent
    for quantity, limited in (("shortening", shortening), ("ln_tension", (0.0, low, high))):
        yield describe("states", quantity, limited, shorter, "pull_offs.csv")


def fit_pull_offs(pull_offs):
    """Spread of the exponent with which the distance shortens, and rows with the `error` then left.

    Rows are left out where next to nothing remains, and where contact is full: there the strength
    of the law bounds the pull-off.
    """
    rows = pull_offs.dropna(subset="pull_off")
    rows = rows[(rows.path_share > LEAST_SHARE) & (rows.energy_ratio < PULL_OFF_KNOWN)]
    shorter = rows[rows.range_ratio < 1]
    exponent = -find_tension_error(shorter, exponent=0.0) / np.log(shorter.range_ratio)
    shortening = find_middle(exponent, shorter)
    return shortening, rows.assign(error=find_tension_error(rows, shortening[0]))


def find_tension_error(rows, exponent):
    """Logarithm of simulated pull-offs over those of a distance that shortens by an exponent."""
    distance = rows.distance * rows.range_ratio**exponent
    return np.log(rows.pull_off * distance / (rows.adhesion_length * rows.share))


def find_share_error(rows):
    """Error of shares by states, absolute, with which limits hold every simulated share.

    Limits of a share S are S e/(S + e) apart from it, for an error e.
    """
    share = rows.states.to_numpy()
    missed = np.maximum(np.abs(share - rows.simulated.to_numpy()) - ROUNDING, 0.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        needed = share * missed / (share - missed)
    return np.select([missed == 0, missed < share], [0.0, needed], np.inf)


def find_middle(values, rows):
    """Median of the fitted rows, and the limits of the middle 90 %."""
    low, value, high = np.quantile(values[rows.role == "fitted"], (TAILS[0], 0.5, TAILS[1]))
    return value, low, high


def compare_patches(patches):
    """Errors of what a map says of the surface it was cut from, by the distance of its quarters.

    The error is a least one, in quadrature with one that goes with the distance. Of all such pairs
    that hold `COVERAGE` of the fitted rows, the one with the narrowest limits is taken.
    """
    rows = patches.dropna(subset=["threshold_10", "whole_threshold_10"])
    needed = np.abs(rows.threshold_10 - rows.whole_threshold_10).to_numpy()
    errors = make_errors("patch", rows, needed, weight=find_distance(rows))
    limited = [add_limits(errors, least).assign(least=least) for least in LEAST_ERRORS]
    return min(limited, key=lambda each: each.limit.median())


def compare_larger(larger):
    """Errors of what scans say of larger contacts: of Gaussian heights, and of others.

    They go with the root of the number of doublings, and of other heights with that times what
    makes them unlike Gaussian ones. Limits of the table contain neither.
    """
    rows = larger.dropna(subset=["value_10", "whole_threshold_10"])
    error = rows.value_10 - rows.whole_threshold_10
    half_width = np.where(error > 0, rows.value_10 - rows.low_10, rows.high_10 - rows.value_10)
    needed = error.abs().to_numpy()
    base = half_width
    doublings = weigh_larger(rows.parts.to_numpy())
    unlike = doublings * find_unlikeness(rows.unevenness.to_numpy(), rows["shape"].to_numpy())
    is_unlike = unlike > LEAST_WEIGHT

    def compare(kind, chosen, weight, base):
        errors = make_errors(kind, rows[chosen], needed[chosen], weight=weight[chosen])
        return add_limits(errors, base[chosen])

    gaussian = compare("larger", ~is_unlike, doublings, base)
    base = np.hypot(base, gaussian.slope.iloc[0] * doublings)
    return gaussian, compare("larger non-Gaussian", is_unlike, unlike, base)


def compare_balls(balls):
    """Number of independent heights in a zone, and errors of ln of the force of balls with it.

    They go with the root of ln of the factor that roughness takes from the force. The number is
    that with which hard solids have the least error.
    """
    balls = balls[find_resolved(balls)]
    hard = find_hard(balls)
    fitted = hard[hard.role == "fitted"]
    slopes = np.array([find_ball_errors(fitted, each).slope.iloc[0] for each in SUMMITS])
    good = np.array(SUMMITS)[slopes <= NEARLY_LEAST * slopes.min()]
    best = SUMMITS[slopes.argmin()]
    return (best, good.min(), good.max()), find_ball_errors(balls, best)


def find_resolved(balls):
    """Whether more than a single pixel of a rigid solid holds; one has the strength of the law."""
    of_pixel = (balls.side / balls.points) ** 2 / np.pi
    return (balls.tabor > 0) | (balls.simulated > MOST_OF_PIXEL * of_pixel)


def find_hard(balls):
    """Rows of hard solids, of which the height of first touch matters."""
    return balls[balls.tabor < HARD]


def find_ball_errors(balls, summits):
    """Errors of ln of the force of balls in all rows."""
    parts = [predict_ball(rows, summits) for _, rows in balls.groupby(["set", "waves", "height"])]
    rows = pd.concat(parts)
    error = np.log(rows.simulated / rows.force)
    base = np.where(error > 0, np.log(rows.high / rows.force), np.log(rows.force / rows.low))
    weight = np.sqrt(np.maximum(-np.log(rows.force), LEAST_LOST)).to_numpy()
    errors = make_errors("ball", rows, error.abs().to_numpy(), weight)
    return add_limits(errors, base).assign(tabor=rows.tabor.to_numpy())


def predict_ball(rows, summits):
    """Rows of one roughness with the force of the ball, without errors of the place.

    Forces are over that of a smooth ball. The surface is a user's who knows its spectrum, and the
    skewness of its heights.
    """
    row = rows.iloc[0]
    zone = BALL_RANGE / measure_balls.make_ball(row.law, row.tabor).law.range
    ball = measure_balls.make_ball(row.law, row.tabor, zone)
    rough = Surface.from_spectrum(ball.rough(row.waves, row.height, row.shortest, row.hurst))
    shape, shape_error = find_height_shape(row.skewness)
    material = Material(
        youngs_modulus=BALL_WORK / ball.law.adhesion_length,
        poisson_ratio=0.0,
        work_of_adhesion=BALL_WORK,
        range=BALL_RANGE,
        law=row.law,
    )
    surface = Surface(rough.data.assign(shape=shape, shape_error=shape_error))
    whole = combine_roughness(material, surface)
    contact = find_contact(
        BallContact(whole, material, surface, ball.radius, summits=summits, error=0.0)
    )
    low, value, high = np.divide(contact.force, contact.smooth_force)
    return rows.assign(force=value, low=low, high=high)


def find_distance(rows):
    """Rms distance of the quarters' thresholds from that of the patch, in ln w."""
    quarters = rows[[f"q{number}_10" for number in (1, 2, 3, 4)]].to_numpy()
    return np.sqrt(np.nanmean((quarters - rows.threshold_10.to_numpy()[:, None]) ** 2, axis=1))


def summarise(errors, heights, solids):
    """Coverage and width of limits, by what is predicted, as a table in Markdown.

    Widths of shares and decisions are those of the committed table of limits.
    """
    gaussian = find_gaussian(heights, window=4)
    skewed, shape = find_skewed(heights)
    error = find_spread("skewness", "ln_work").high * np.abs(shape)
    models = {
        "spectrum": (model_heights(gaussian), gaussian),
        "skewness": (replace(model_heights(skewed, shape), shape_error=error[:, None]), skewed),
    }
    models |= {kind: (model_solids(rows), rows) for kind, rows in group_solids(solids)}
    lines = []
    for (kind, role), rows in errors.groupby(["kind", "role"], sort=False):
        inside = percent(np.mean(rows.needed <= rows.limit))
        factor = number(float(np.exp(2 * rows.limit.median())), 3)
        judged = ("", "", "")
        if kind in models:
            rough, of_model = models[kind]
            judged = judge_rows(rough, of_model, of_model.role.to_numpy() == role)
        lines.append((kind, role, str(len(rows)), inside, factor, *judged))
    columns = ("by", "rows", "number", "inside", "high/low w", "mean width of S")
    return table((*columns, "decided", "false"), lines)


def summarise_pull_offs(pull_offs):
    """Coverage and errors of pull-offs by states, by the range, as a table in Markdown."""
    _, rows = fit_pull_offs(pull_offs)
    shorter = rows[rows.range_ratio < 1]
    _, low, high = find_middle(shorter.error, shorter)
    lines = []
    for (role, ratio), part in rows.groupby(["role", "range_ratio"], sort=False):
        inside = percent(part.error.between(low, high).mean())
        median = number(float(np.exp(part.error.median())), 3)
        lines.append((role, number(ratio, 2), str(len(part)), inside, median))
    columns = ("pull-offs", "range over that of the states", "number", "inside")
    return table((*columns, "simulated over predicted"), lines)


def judge_rows(rough, rows, chosen):
    """Mean width of the limits of the share, share of decided pairs, and false decisions."""
    lengths = rows.adhesion_length.to_numpy()[:, None]
    ranges = rows.range.to_numpy()[:, None]
    low, high = (rough.share(lengths, ranges, sign)[chosen, 0] for sign in (-1, 1))
    share = rows.simulated.to_numpy()[chosen]
    sticks = low >= DEFAULT_SHARE
    fails = high < DEFAULT_SHARE
    is_false = (sticks & (share < DEFAULT_SHARE)) | (fails & (share >= DEFAULT_SHARE))
    return (
        number(float(np.mean(high - low)), 2),
        percent(np.mean(sticks | fails)),
        str(is_false.sum()),
    )


if __name__ == "__main__":
    main(start(globals()))
