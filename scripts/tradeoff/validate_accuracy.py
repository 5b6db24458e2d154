"""Cases with an accuracy, on surfaces that the laws were not fitted to: error and cost.

What a user gets is simulated on banks of solved seeds: settings are chosen by the laws, seeds are
drawn in rounds until `stickiness.stopping` is content, and the mean is that of all seeds drawn, the
lucky ones and the others. It is compared with the cheapest settings that would have done, which
only the bank as a whole can tell.
"""

import itertools
from dataclasses import dataclass, replace

import numpy as np
import xarray as xr

from pipeline.job import start
from pipeline.tables import table
from pipeline.tradeoff.measuring import COVERED
from pipeline.tradeoff.seed_pool import Draws, bank_of
from stickiness.accuracy import error_laws, sequential
from stickiness.core import datasets

CASES, SEARCHES = 60, 120  # repetitions: of every case, and in the search of what is cheapest
DESCRIBED = 2048
DEAR = 1.5  # times the cheapest settings that reach the accuracy, above which a case is dear
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
        bank, surface = bank_of(measured), error_laws.Surface.of(datasets.parameters(measured))
        name = path.rsplit("/", 1)[1].removesuffix(".nc")
        rows += validated(name, bank, measured, surface, laws, job.params.accuracies)
        _, noise = bank.offsets[max(bank.offsets)]
        known += bank.by_quantity(error_laws.COVERS * noise).values()
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


def validated(name, bank, measured, surface, laws, accuracies):
    """One row for every accuracy and set of quantities on one surface."""
    cost = Cost(measured, surface, laws)
    searches = [Search(Draws(bank, SEARCHES, DESCRIBED, seed), cost) for seed in (2, 3)]
    draws, rows = Draws(bank, CASES, DESCRIBED), []
    loads = tuple(measured.pressure.values.tolist())
    for (text, quantities), asked in itertools.product(WANTED.items(), accuracies):
        case = sequential.Asked(asked, surface, loads, quantities, descriptor_seeds=DESCRIBED)
        try:
            chosen = error_laws.cheapest(
                laws, asked, surface, loads, quantities, descriptor_seeds=DESCRIBED
            )
        except error_laws.UnreachableError:
            rows.append((name, text, asked, *[np.nan] * len(TEXTS)))
            continue
        cheapest = lowest_cost(searches, case.columns, asked)
        runs = Runs(draws, laws, case)
        found = [runs.ended(one, chosen) for one in range(CASES)]
        error = np.array([one.error for one in found])
        spent = np.array([cost(one.settings) for one in found])
        rows.append(
            (
                name,
                text,
                asked,
                float(chosen.pixels_per_wavelength),
                chosen.tolerance,
                float(np.mean([one.settings.seeds for one in found])),
                float(np.mean([one.settings.coarse_seeds for one in found])),
                float(np.mean([one.rounds for one in found])),
                float(np.mean([one.state == sequential.ENOUGH for one in found])),
                float(np.mean(error <= asked)),
                float(np.quantile(error, COVERED)),
                float(np.mean(runs.worst(chosen) <= asked)),
                float(spent.mean()),
                spent.mean() / cheapest,
                cost(chosen) / cheapest,
            )
        )
    return rows


@dataclass(frozen=True)
class Ended:
    """How a run ended: with what settings, after how many rounds, why, and with what error."""

    settings: error_laws.Settings
    rounds: int
    state: str
    error: float


class Cost:
    """Cost of settings as measured on a surface, for all its loads.

    What a larger tolerance saves is by its law.
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
    """Errors of all settings on one set of draws, cheapest first.

    The largest tolerance is taken to add no error: what is cheapest is not made out dearer.
    """

    def __init__(self, draws, cost):
        self.draws, self.found = draws, {}
        every = itertools.product(
            error_laws.PIXELS, error_laws.TOLERANCES[:1], error_laws.SEEDS, error_laws.COARSE_SEEDS
        )
        self.costs = {one: cost(one) for one in itertools.starmap(error_laws.Settings, every)}
        self.every = sorted(self.costs, key=self.costs.get)

    def reach(self, settings, columns, asked):
        """Whether 90 % of repetitions are within the accuracy in all columns at all loads."""
        if settings not in self.found:
            errors, _ = self.draws(settings)
            self.found[settings] = self.draws.bank.by_quantity(errors)
        worst = np.max([e for (c, _), e in self.found[settings].items() if c in columns], axis=0)
        return np.quantile(worst, COVERED) <= asked


def lowest_cost(searches, columns, asked):
    """Cost of the cheapest settings that reach an accuracy; NaN if none does.

    Of many some get there by luck: they must on every set of draws.
    """
    for settings in searches[0].every:
        if all(search.reach(settings, columns, asked) for search in searches):
            return searches[0].costs[settings]
    return np.nan


class Runs:
    """Runs of one case on a set of draws, one for each repetition."""

    def __init__(self, draws, laws, case):
        self.draws, self.laws, self.case, self.found = draws, laws, case, {}

    def ended(self, one, chosen):
        """Draw seeds for repetition `one` until there is no more to draw."""
        case, rounds = self.case, 1
        settings = sequential.first(self.laws, case, chosen)
        while True:
            scatter = self.of(settings)[1][..., one]
            # What a single run says of its grid is not in the bank; the laws stand alone.
            measured = sequential.Measured(
                np.ones_like(scatter), scatter, np.full_like(scatter, np.inf)
            )
            decision = sequential.assess(self.laws, case, settings, measured)
            if decision.state != sequential.MORE:
                return Ended(settings, rounds, decision.state, self.worst(settings)[one])
            settings, rounds = decision.settings, rounds + 1

    def worst(self, settings):
        """Largest error of each repetition over columns and loads."""
        return self.of(settings)[0].max(axis=(0, 1))

    def of(self, settings):
        """Errors with what the tolerance adds, and standard errors; `(column, load, one)`."""
        if settings not in self.found:
            exact = replace(settings, tolerance=error_laws.FULL)
            case, by_quantity = self.case, self.draws.bank.by_quantity
            errors, scatter = (by_quantity(part) for part in self.draws(exact))
            solver = {
                (column, load): self.solver_error(settings, column, load)
                for column, load in itertools.product(case.columns, case.pressures)
            }
            self.found[settings] = (
                np.array(
                    [
                        [np.hypot(errors[c, p], solver[c, p]) for p in case.pressures]
                        for c in case.columns
                    ]
                ),
                np.array([[scatter[c, p] for p in case.pressures] for c in case.columns]),
            )
        return self.found[settings]

    def solver_error(self, settings, column, load):
        """What a tolerance above the one of the measurement adds, by its law."""
        if settings.tolerance <= error_laws.FULL:
            return 0.0
        return error_laws.single_error(
            self.laws, "solver", column, self.case.surface, load, tolerance=settings.tolerance
        )


def markdown(columns, rows):
    lines = [[value if isinstance(value, str) else f"{value:.3g}" for value in row] for row in rows]
    return table(columns, lines) + "\n" + summary(columns, rows)


def summary(columns, rows):
    """In how many runs and cases the accuracy is reached, and at what cost."""
    wanted = ("accuracy", "within", "error", "cost_over_cheapest")
    opened = ("accuracy", "open_within", "error", "open_cost_over_cheapest")
    lines = []
    for text, names in (("As it is run", wanted), ("Without rounds", opened)):
        part = np.array([[row[columns.index(name)] for name in names] for row in rows])
        lines.append(f"{text}: {told(part.astype(float))}\n")
    return "\n".join(lines)


def told(part):
    """One line on shares within, and costs over those of the cheapest."""
    asked, within, error, ratio = part[np.isfinite(part[:, 1])].T
    # Where nothing measured reaches the accuracy, nothing is known of the cost.
    cheap, known, reached = ratio <= DEAR, np.isfinite(ratio), within >= COVERED
    return (
        f"{within.mean():.1%} of runs within the accuracy in every quantity at every load; at "
        f"least 90 % of them in {reached.sum()} of {reached.size} cases, at least 85 % in "
        f"{(within >= 0.85).sum()}, fewest {within.min():.0%}. Cost over the cheapest: median "
        f"{np.median(ratio[known]):.2f}, at most {DEAR:g} in {cheap.sum()} of {known.sum()}, "
        f"largest {ratio[known].max():.2f}; both in {(reached & cheap).sum()}."
    )


if __name__ == "__main__":
    main(start(globals(), "validate_accuracy"))
