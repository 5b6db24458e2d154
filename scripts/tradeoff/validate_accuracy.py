"""Cases with an accuracy, on surfaces that the error models were not fitted to: error and cost.

What a user gets is simulated on pools of solved seeds: settings are chosen by the error models, and
seeds are drawn from the pool. Their mean is compared with that of all, and their cost with the
cheapest settings that would have been enough, which only the pool as a whole can tell.
"""

import itertools
from dataclasses import replace

import numpy as np
import xarray as xr

from common.formatting import table
from common.job import start
from stickiness import datasets
from stickiness.accuracy.choice import (
    COARSE_SEEDS,
    PIXELS,
    SEEDS,
    TOLERANCES,
    UnreachableError,
    cheapest,
)
from stickiness.accuracy.error_models import (
    COARSE,
    FULL,
    Settings,
    Surface,
    read_models,
    single_error,
)
from stickiness.accuracy.prediction import Problem
from stickiness.accuracy.quantities import MODELLED, columns_of
from stickiness.statistics import COVERS
from tradeoff.measuring import COVERED
from tradeoff.seed_pool import Resampling, make_pool

CASES, SEARCHES = 60, 120  # repetitions: of every case, and in the search of what is cheapest
DESCRIBED = 2048
EXPENSIVE = 1.5  # times the cost of the cheapest settings that reach the accuracy
WANTED = {
    "area": ("area",),
    "mean gap": ("mean_gap",),
    "a_V": ("a_v",),
    "area, attractive area": ("area", "attractive_area"),
    "everything": MODELLED,
}
TEXTS = {
    "pixels": "grid points per shortest wavelength that were chosen",
    "tolerance": "tolerance that was chosen",
    "seeds": "fine seeds that were chosen",
    "coarse_seeds": "coarse seeds that were chosen",
    "within": "share of runs within the accuracy in every quantity at every load",
    "error": "error that covers 90 % of runs, of the worst quantity and load of each",
    "cost": "cost of a run, in pairs of transforms of 1024 x 1024 doubles",
    "cost_over_cheapest": "cost over that of the cheapest settings that reach the accuracy",
}
HEAD = """\
Cases that ask for an accuracy, on surfaces that were not used to fit the error models behind the
choice: each run has the settings that the models choose, and is compared with what all seeds say.
Within: share of runs within the accuracy in every quantity at every load at once. Error: covers
90 % of runs, of the worst quantity and load of each. Cost: of all that is solved, over that of the
cheapest settings with which 90 % of runs are within.
Error models and margin were set on the surfaces that the models are fitted to, each with the models
of the others, and fixed before these were looked at.
Runs draw from the seeds that the reference is the mean of, so that these do not add to the error;
its grid does: what 32 points change from 16 is known to {known} (90 %, median and
largest over quantities and loads).

"""


def main(job):
    laws, rows, known = read_models(job.input.laws), [], []
    for path in job.input.seeds:
        measured = datasets.read(path)
        pool, surface = make_pool(measured), Surface.of(datasets.parameters(measured))
        name = path.rsplit("/", 1)[1].removesuffix(".nc")
        rows += validate(name, pool, measured, surface, laws, job.params.accuracies)
        _, noise = pool.grid_errors[max(pool.grid_errors)]
        known += pool.by_quantity(COVERS * noise).values()
    columns = ["case", "wanted", "accuracy", *TEXTS]
    missing = "out of reach, or nothing measured reaches it"
    dataset = xr.Dataset(
        {name: ("row", [row[k] for row in rows]) for k, name in enumerate(columns)},
        coords={"row": np.arange(len(rows))},
    )
    datasets.write(
        datasets.annotate(
            dataset,
            row=("1", "number of the row"),
            case=("1", "surface"),
            wanted=("1", "quantities wanted"),
            accuracy=("1", "relative error asked for"),
            **{name: ("1", text, missing) for name, text in TEXTS.items()},
        ),
        job.output.dataset,
        title="accuracy asked for and reached",
        parameters={"repetitions": CASES},
    )
    with datasets.whole_file(job.output.table) as path:
        known = f"{np.median(known):.2%} and {np.max(known):.1%}"
        text = HEAD.format(known=known) + markdown(columns, rows)
        path.write_text(text, encoding="utf-8")


def validate(name, pool, measured, surface, laws, accuracies):
    """One row for every accuracy and set of quantities on one surface."""
    cost = Cost(measured, surface, laws)
    searches = [Search(Resampling(pool, SEARCHES, DESCRIBED, seed), cost) for seed in (2, 3)]
    resampling, rows = Resampling(pool, CASES, DESCRIBED), []
    loads = tuple(measured.pressure.values.tolist())
    for (text, quantities), asked in itertools.product(WANTED.items(), accuracies):
        problem = Problem(laws, surface, loads, columns_of(quantities), DESCRIBED)
        try:
            chosen = cheapest(problem, asked)
        except UnreachableError:
            rows.append((name, text, asked, *[np.nan] * len(TEXTS)))
            continue
        error, spent = worst_errors(resampling, problem, chosen), cost(chosen)
        rows.append(
            (
                name,
                text,
                asked,
                float(chosen.pixels_per_wavelength),
                chosen.tolerance,
                float(chosen.seeds),
                float(chosen.coarse_seeds),
                float(np.mean(error <= asked)),
                float(np.quantile(error, COVERED)),
                spent,
                spent / find_lowest_cost(searches, problem.columns, asked),
            )
        )
    return rows


class Cost:
    """Cost of settings as measured on a surface, for all its loads.

    The error model tells what a larger tolerance saves.
    """

    def __init__(self, measured, surface, laws):
        self.seconds = measured.seconds.mean("seed").to_series().to_dict()
        self.coarse = float(measured.coarse_seconds.mean())
        self.describing = DESCRIBED * float(measured.describing_seconds)
        self.unit, self.surface = float(measured.pair_time), surface
        self.law = laws["tolerance_cost", ""]

    def __call__(self, settings):
        """Cost of a case with some settings."""
        pixels, tolerance = settings.pixels_per_wavelength, settings.tolerance / FULL
        saved = self.law(self.surface, tolerance=tolerance) if tolerance > 1 else 1.0
        one = sum(self.seconds[grid] for grid in {pixels, pixels // 2, COARSE})
        total = saved * settings.seeds * one
        if settings.coarse_seeds:
            total += saved * settings.coarse_seeds * self.coarse + self.describing
        return total / self.unit


class Search:
    """Errors of all settings on one set of resampled seeds, cheapest first.

    The largest tolerance is taken to add no error, so that the cheapest settings are not
    overestimated.
    """

    def __init__(self, resampling, cost):
        self.resampling, self.found = resampling, {}
        every = itertools.product(PIXELS, TOLERANCES[:1], SEEDS, COARSE_SEEDS)
        self.costs = {one: cost(one) for one in itertools.starmap(Settings, every)}
        self.cheapest_first = sorted(self.costs, key=self.costs.get)

    def reaches(self, settings, columns, asked):
        """Whether 90 % of repetitions are within the accuracy in all columns at all loads."""
        if settings not in self.found:
            errors, _ = self.resampling.draw(settings)
            self.found[settings] = self.resampling.pool.by_quantity(errors)
        worst = np.max([e for (c, _), e in self.found[settings].items() if c in columns], axis=0)
        return np.quantile(worst, COVERED) <= asked


def find_lowest_cost(searches, columns, asked):
    """Cost of the cheapest settings that reach an accuracy; NaN if none does.

    Some of many settings reach it by luck: they must reach it in every search.
    """
    for settings in searches[0].cheapest_first:
        if all(search.reaches(settings, columns, asked) for search in searches):
            return searches[0].costs[settings]
    return np.nan


def worst_errors(resampling, problem, settings):
    """Largest error of each repetition over columns and loads, with what the tolerance adds."""
    draws, _ = resampling.draw(replace(settings, tolerance=FULL))
    errors = resampling.pool.by_quantity(draws)
    return np.max(
        [
            np.hypot(errors[column, load], solver_error(problem, settings, load, column))
            for load, column in problem.points
        ],
        axis=0,
    )


def solver_error(problem, settings, load, column):
    """What a tolerance above the one of the measurement adds, by its error model."""
    if settings.tolerance <= FULL:
        return 0.0
    at = problem.models, "solver", column, problem.surface, load
    return single_error(*at, tolerance=settings.tolerance)


def markdown(columns, rows):
    lines = [[value if isinstance(value, str) else f"{value:.3g}" for value in row] for row in rows]
    return table(columns, lines) + "\n" + summarise(columns, rows)


def summarise(columns, rows):
    """Say in how many runs and cases the accuracy is reached, and at what cost."""
    names = ("accuracy", "within", "error", "cost_over_cheapest")
    part = np.array([[row[columns.index(name)] for name in names] for row in rows])
    return f"Together: {describe(part.astype(float))}\n"


def describe(part):
    """One line on shares within the accuracy, and costs over those of the cheapest settings."""
    asked, within, error, ratio = part[np.isfinite(part[:, 1])].T
    # Where nothing measured reaches the accuracy, nothing is known of the cost.
    cheap, known, reached = ratio <= EXPENSIVE, np.isfinite(ratio), within >= COVERED
    return (
        f"{within.mean():.1%} of runs within the accuracy in every quantity at every load; at "
        f"least 90 % of them in {reached.sum()} of {reached.size} cases, at least 85 % in "
        f"{(within >= 0.85).sum()}, fewest {within.min():.0%}. Cost over the cheapest: median "
        f"{np.median(ratio[known]):.2f}, at most {EXPENSIVE:g} in {cheap.sum()} of {known.sum()}, "
        f"largest {ratio[known].max():.2f}; both in {(reached & cheap).sum()}."
    )


if __name__ == "__main__":
    main(start(globals(), "validate_accuracy"))
