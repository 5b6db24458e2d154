"""Cases with an accuracy, on surfaces that the laws were not fitted to: error and cost.

What a user gets is simulated on pools of solved seeds: the laws choose settings, seeds are drawn in
rounds until `sequential.assess` has enough, and the mean is over all seeds drawn. It is compared
with the cheapest settings that would have sufficed, which only the whole pool can tell.
"""

import itertools
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import xarray as xr

from pipeline.job import start
from pipeline.tables import table
from pipeline.tradeoff.measuring import COVERED
from pipeline.tradeoff.seed_pool import Resampling, make_pool
from stickiness.accuracy import error_laws, sequential
from stickiness.core import datasets

CASES, SEARCHES = 60, 120  # repetitions: of every case, and in the search of what is cheapest
DESCRIBED = 2048
EXPENSIVE = 1.5  # times the cost of the cheapest settings that reach the accuracy
WANTED = {
    "area": ("area",),
    "mean gap": ("mean_gap",),
    "a_V": ("a_v",),
    "area, attractive area": ("area", "attractive_area"),
    "everything": tuple(error_laws.QUANTITIES),
}
TEXTS = {
    "pixels": "grid points per shortest wavelength that were chosen",
    "tolerance": "tolerance that was chosen",
    "seeds": "fine seeds in the end, mean over runs",
    "coarse_seeds": "coarse seeds in the end, mean over runs",
    "rounds": "rounds of seeds, mean over runs",
    "ended": "share of runs that ended with enough seeds, not at the cap or for the grid",
    "within": "share of runs within the accuracy in every quantity at every load",
    "error": "error that covers 90 % of runs, of the worst quantity and load of each",
    "open_within": "share of runs within it with the settings chosen in advance, and no rounds",
    "cost": "mean cost of a run, in pairs of transforms of 1024 x 1024 doubles",
    "cost_over_cheapest": "cost over that of the cheapest settings that reach the accuracy",
    "open_cost_over_cheapest": "the same with the settings chosen in advance, and no rounds",
}
HEAD = """\
Cases that ask for an accuracy, on surfaces that were not used to fit the laws behind the choice:
each run chooses grid and tolerance by the laws, draws seeds in rounds until it is content, and is
compared with what all seeds say. Within: share of runs within the accuracy in every quantity at
every load at once. Error: covers 90 % of runs, of the worst quantity and load of each. Cost: of all
that is solved, over that of the cheapest settings with which 90 % of runs are within. Open: the
settings chosen in advance, without rounds.
Laws, rule and margin were set on the surfaces that the laws are fitted to, each with the laws of
the others, and fixed before these were looked at.
Runs draw from the seeds that the reference is the mean of, so that these do not add to the error;
its grid does: what 32 points change from 16 is known to {known} (90 %, median and
largest over quantities and loads).

"""


def main(job):
    laws, rows, known = error_laws.read_laws(job.input.laws), [], []
    for path in job.input.seeds:
        measured = datasets.read(path)
        pool, surface = make_pool(measured), error_laws.Surface.of(datasets.parameters(measured))
        cost = Cost(measured, surface, laws)
        loads = tuple(measured.pressure.values.tolist())
        for row in validate(pool, cost, laws, loads, job.params.accuracies):
            rows.append({"case": Path(path).stem} | row)
        _, noise = pool.grid_errors[max(pool.grid_errors)]
        known += pool.by_quantity(error_laws.COVERS * noise).values()
    columns = ["case", "wanted", "accuracy", *TEXTS]
    missing = "out of reach, or nothing measured reaches it"
    dataset = xr.Dataset(
        {name: ("row", [row.get(name, np.nan) for row in rows]) for name in columns},
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
    known = f"{np.median(known):.2%} and {np.max(known):.1%}"
    lines = [[format_value(row.get(name, np.nan)) for name in columns] for row in rows]
    with datasets.whole_file(job.output.table) as path:
        text = HEAD.format(known=known) + table(columns, lines) + "\n" + summarise(dataset)
        path.write_text(text, encoding="utf-8")


def validate(pool, cost, laws, loads, accuracies):
    """List a row for every set of quantities and accuracy on one surface."""
    searches = [Search(Resampling(pool, SEARCHES, DESCRIBED, seed), cost) for seed in (2, 3)]
    resampling, surface = Resampling(pool, CASES, DESCRIBED), cost.surface
    for (text, quantities), accuracy in itertools.product(WANTED.items(), accuracies):
        row = {"wanted": text, "accuracy": accuracy}
        case = sequential.Asked(accuracy, surface, loads, quantities, descriptor_seeds=DESCRIBED)
        try:
            chosen = error_laws.cheapest(
                laws, accuracy, surface, loads, quantities, descriptor_seeds=DESCRIBED
            )
        except error_laws.UnreachableError:
            yield row
            continue
        cheapest = find_lowest_cost(searches, case.columns, accuracy)
        runs = Runs(resampling, laws, case)
        ends = [runs.run(k, chosen) for k in range(CASES)]
        error = np.array([end.error for end in ends])
        spent = np.mean([cost(end.settings) for end in ends])
        yield row | {
            "pixels": float(chosen.pixels_per_wavelength),
            "tolerance": chosen.tolerance,
            "seeds": float(np.mean([end.settings.seeds for end in ends])),
            "coarse_seeds": float(np.mean([end.settings.coarse_seeds for end in ends])),
            "rounds": float(np.mean([end.rounds for end in ends])),
            "ended": float(np.mean([end.state == sequential.ENOUGH for end in ends])),
            "within": float(np.mean(error <= accuracy)),
            "error": float(np.quantile(error, COVERED)),
            "open_within": float(np.mean(runs.worst_errors(chosen) <= accuracy)),
            "cost": float(spent),
            "cost_over_cheapest": spent / cheapest,
            "open_cost_over_cheapest": cost(chosen) / cheapest,
        }


def format_value(value):
    return value if isinstance(value, str) else f"{value:.3g}"


@dataclass(frozen=True)
class End:
    """Settings, number of rounds, reason and error with which a run ended."""

    settings: error_laws.Settings
    rounds: int
    state: str
    error: float


class Cost:
    """Cost of settings as measured on a surface, for all its loads.

    The law tells what a larger tolerance saves.
    """

    def __init__(self, measured, surface, laws):
        self.seconds = measured.seconds.mean("seed").to_series().to_dict()
        self.coarse = float(measured.coarse_seconds.mean())
        self.describing = DESCRIBED * float(measured.describing_seconds)
        self.unit, self.surface = float(measured.pair_time), surface
        self.law = laws["tolerance_cost", ""]

    def __call__(self, settings):
        """Cost of a case with some settings."""
        pixels, tolerance = settings.pixels_per_wavelength, settings.tolerance / error_laws.FULL
        saved = self.law(self.surface, tolerance=tolerance) if tolerance > 1 else 1.0
        one = sum(self.seconds[grid] for grid in {pixels, pixels // 2, error_laws.COARSE})
        total = saved * settings.seeds * one
        if settings.coarse_seeds:
            total += saved * settings.coarse_seeds * self.coarse + self.describing
        return total / self.unit


class Search:
    """Errors of all settings on resampled seeds, cheapest first.

    The largest tolerance is taken to add no error, so that the cheapest settings are not
    overestimated.
    """

    def __init__(self, resampling, cost):
        self.resampling, self.found = resampling, {}
        every = itertools.product(
            error_laws.PIXELS, error_laws.TOLERANCES[:1], error_laws.SEEDS, error_laws.COARSE_SEEDS
        )
        self.costs = {s: cost(s) for s in itertools.starmap(error_laws.Settings, every)}
        self.cheapest_first = sorted(self.costs, key=self.costs.get)

    def reaches(self, settings, columns, accuracy):
        """Whether 90 % of repetitions are within the accuracy in all columns at all loads."""
        if settings not in self.found:
            errors, _ = self.resampling.draw(settings)
            self.found[settings] = self.resampling.pool.by_quantity(errors)
        worst = np.max([e for (c, _), e in self.found[settings].items() if c in columns], axis=0)
        return np.quantile(worst, COVERED) <= accuracy


def find_lowest_cost(searches, columns, accuracy):
    """Cost of the cheapest settings that reach an accuracy; NaN if none does.

    Some of many settings reach it by luck: they must reach it in every search.
    """
    for settings in searches[0].cheapest_first:
        if all(search.reaches(settings, columns, accuracy) for search in searches):
            return searches[0].costs[settings]
    return np.nan


class Runs:
    """Runs of one case on resampled seeds, one for each repetition."""

    def __init__(self, resampling, laws, case):
        self.resampling, self.laws, self.case, self.found = resampling, laws, case, {}

    def run(self, k, chosen):
        """Draw seeds for repetition `k` until the rule stops."""
        case, rounds = self.case, 1
        settings = sequential.first(self.laws, case, chosen)
        while True:
            scatter = self.measure(settings)[1][..., k]
            # What a single run tells of its grid is not in the pool; the laws stand alone.
            measured = sequential.Measured(
                np.ones_like(scatter), scatter, np.full_like(scatter, np.inf)
            )
            decision = sequential.assess(self.laws, case, settings, measured)
            if decision.state != sequential.MORE:
                return End(settings, rounds, decision.state, self.worst_errors(settings)[k])
            settings, rounds = decision.settings, rounds + 1

    def worst_errors(self, settings):
        """Largest error of each repetition over columns and loads."""
        return self.measure(settings)[0].max(axis=(0, 1))

    def measure(self, settings):
        """Errors, tolerance included, and standard errors; `(column, load, repetition)`."""
        if settings not in self.found:
            exact = replace(settings, tolerance=error_laws.FULL)
            by_quantity = self.resampling.pool.by_quantity
            errors, scatter = (by_quantity(part) for part in self.resampling.draw(exact))
            places = [[(c, p) for p in self.case.pressures] for c in self.case.columns]
            self.found[settings] = (
                np.array(
                    [
                        [np.hypot(errors[at], self.solver_error(settings, *at)) for at in row]
                        for row in places
                    ]
                ),
                np.array([[scatter[at] for at in row] for row in places]),
            )
        return self.found[settings]

    def solver_error(self, settings, column, load):
        """Error that a tolerance above that of the measurement adds, by its law."""
        if settings.tolerance <= error_laws.FULL:
            return 0.0
        return error_laws.single_error(
            self.laws, "solver", column, self.case.surface, load, tolerance=settings.tolerance
        )


def summarise(dataset):
    """Say in how many runs and cases the accuracy is reached, and at what cost."""
    lines = []
    for text, prefix in (("As it is run", ""), ("Without rounds", "open_")):
        known = dataset.isel(row=np.isfinite(dataset[f"{prefix}within"]))
        within, ratio = (
            known[f"{prefix}{name}"].values for name in ("within", "cost_over_cheapest")
        )
        lines.append(f"{text}: {describe(within, ratio)}\n")
    return "\n".join(lines)


def describe(within, ratio):
    """One line on shares within the accuracy, and costs over those of the cheapest settings."""
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
