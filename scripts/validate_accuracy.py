"""Settings chosen for an accuracy, on surfaces that the laws were not fitted to: error and cost."""

import itertools

import numpy as np
import xarray as xr

from _bank import bank_of
from _job import start
from _laws import surface_of
from _tables import table
from _tradeoff import COVERED
from stickiness import accuracy, datasets

FEW, MANY = 60, 240  # repetitions, to look for settings and to confirm them
SEEDS = tuple(n for n in accuracy.SEEDS if n <= 24)  # at most a third of the fine ones
COARSE_SEEDS = tuple(n for n in accuracy.COARSE_SEEDS if n <= 1024)
DESCRIBED = 2048
TOLERANCE = 1e-8  # at which the surfaces were solved
WANTED = {
    "area": ("area",),
    "mean gap": ("mean_gap",),
    "a_V": ("a_v",),
    "area, attractive area": ("area", "attractive_area"),
    "everything": tuple(accuracy.QUANTITIES),
}
TEXTS = {
    "pixels": "grid points per shortest wavelength that were chosen",
    "seeds": "fine seeds that were chosen",
    "coarse_seeds": "coarse seeds that were chosen",
    "within": "share of means within the accuracy, over loads and columns",
    "error": "error that covers 90 % of means, at the worst load and column",
    "predicted": "the same as it was predicted",
    "cost": "cost of the choice, in pairs of transforms of 1024 x 1024 doubles",
    "cost_over_cheapest": "cost over that of the cheapest settings that reach the accuracy",
}
HEAD = """\
Settings chosen for an accuracy on surfaces that were not used to fit the laws behind the choice.
Within: share of repeated means, over all loads and quantities, within the accuracy. Error: covers
90 % of them at the worst load and quantity. Cost ratio: over the cheapest settings that reach the
accuracy there.

"""


def main(job):
    laws, rows = accuracy.read_laws(job.input.laws), []
    for path in job.input.seeds:
        measured = datasets.read(path)
        rows += validated(path.rsplit("/", 1)[1].removesuffix(".nc"), measured, laws, job.params)
    columns = ["case", "wanted", "accuracy", *TEXTS]
    missing = "out of reach, or nothing cheaper measured reaches it"
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
        parameters={"repetitions": MANY},
    )
    with datasets.whole_file(job.output.table) as path:
        path.write_text(HEAD + markdown(columns, rows), encoding="utf-8")


def validated(name, measured, laws, params):
    """One row for every accuracy and set of quantities on one surface."""
    bank, surface = bank_of(measured), surface_of(datasets.parameters(measured))
    loads, rows, found = measured.pressure.values, [], {}

    def errors(settings, repetitions=MANY):
        if (settings, repetitions) not in found:
            drawn = bank.errors(settings, repetitions, DESCRIBED, seed=repetitions)
            found[settings, repetitions] = bank.by_quantity(drawn)
        return found[settings, repetitions]

    def reaches(settings, asked, keys):
        # Of many settings some get there by luck: those are drawn anew, and more often.
        return all(
            np.quantile(errors(settings, repetitions)[key], COVERED) <= asked
            for repetitions in (FEW, MANY)
            for key in keys
        )

    candidates = sorted(
        (
            accuracy.Settings(pixels, TOLERANCE, seeds, coarse)
            for pixels, seeds, coarse in itertools.product(accuracy.PIXELS, SEEDS, COARSE_SEEDS)
        ),
        key=lambda settings: cost_of(settings, measured),
    )
    for (text, quantities), asked in itertools.product(WANTED.items(), params.accuracies):
        columns = [c for quantity in quantities for c in accuracy.QUANTITIES[quantity]]
        keys = [(column, float(load)) for column in columns for load in loads]
        chosen = choose(laws, asked, surface, loads, quantities)
        if chosen is None:
            rows.append((name, text, asked, *[np.nan] * len(TEXTS)))
            continue
        reached = errors(chosen)
        worst = max(np.quantile(reached[key], COVERED) for key in keys)
        within = np.mean([reached[key] <= asked for key in keys])
        predicted = accuracy.worst_error(laws, chosen, surface, loads, quantities, DESCRIBED)[0]
        cheapest = next((one for one in candidates if reaches(one, asked, keys)), None)
        cost = cost_of(chosen, measured)
        ratio = np.nan if cheapest is None else cost / cost_of(cheapest, measured)
        rows.append(
            (
                name,
                text,
                asked,
                float(chosen.pixels_per_wavelength),
                float(chosen.seeds),
                float(chosen.coarse_seeds),
                within,
                worst,
                predicted,
                cost,
                ratio,
            )
        )
    return rows


def choose(laws, asked, surface, loads, quantities):
    """Settings as `accuracy.cheapest` has them, among those that can be drawn here."""
    given = surface, loads, quantities
    for settings in sorted(
        (
            accuracy.Settings(pixels, TOLERANCE, seeds, coarse)
            for pixels, seeds, coarse in itertools.product(accuracy.PIXELS, SEEDS, COARSE_SEEDS)
        ),
        key=lambda one: accuracy.predicted_cost(laws, one, surface, loads, DESCRIBED),
    ):
        if accuracy.worst_error(laws, settings, *given, DESCRIBED)[0] <= asked:
            return settings
    return None


def cost_of(settings, measured):
    """Cost of settings as measured on this surface, for all its loads."""
    seconds = measured.seconds.mean("seed")
    grids = {settings.pixels_per_wavelength, settings.pixels_per_wavelength // 2, accuracy.COARSE}
    total = settings.seeds * float(seconds.sel(pixels=sorted(grids)).sum())
    if settings.coarse_seeds:
        total += settings.coarse_seeds * float(measured.coarse_seconds.mean())
        total += DESCRIBED * float(measured.describing_seconds)
    return total / float(measured.pair_time)


def markdown(columns, rows):
    lines = [[value if isinstance(value, str) else f"{value:.3g}" for value in row] for row in rows]
    reached = np.array([row[columns.index("within")] for row in rows])
    ratio = np.array([row[columns.index("cost_over_cheapest")] for row in rows])
    known = ratio[np.isfinite(ratio)]
    total = (
        f"\nWithin the accuracy: {np.nanmean(reached):.1%} of all means. Cost over the cheapest: "
        f"median {np.median(known):.2f}, at most 1.5 in {np.mean(known <= 1.5):.0%} of "
        f"{known.size}, largest {known.max():.2f}.\n"
    )
    return table(columns, lines) + total


if __name__ == "__main__":
    main(start(globals(), "validate_accuracy"))
