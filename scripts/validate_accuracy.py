"""Settings chosen for an accuracy, on surfaces that the laws were not fitted to: error and cost."""

import itertools
from dataclasses import replace
from functools import cache

import numpy as np
import xarray as xr

from _bank import bank_of
from _job import start
from _laws import surface_of
from _tables import table
from _tradeoff import COVERED
from stickiness import accuracy, datasets

FEW, MANY = 60, 240  # repetitions, to look for settings and to confirm them
DESCRIBED = 2048
HOPELESS = 2.0  # times the accuracy asked for, above which predicted errors are not drawn
DEAR = 1.5  # times the cheapest settings that reach the accuracy, above which a choice is dear
WANTED = {
    "area": ("area",),
    "mean gap": ("mean_gap",),
    "a_V": ("a_v",),
    "area, attractive area": ("area", "attractive_area"),
    "everything": tuple(accuracy.QUANTITIES),
}
TEXTS = {
    "pixels": "grid points per shortest wavelength that were chosen",
    "tolerance": "tolerance that was chosen",
    "seeds": "fine seeds that were chosen",
    "coarse_seeds": "coarse seeds that were chosen",
    "within": "share of means within the accuracy, at the worst load and column",
    "error": "error that covers 90 % of means, at the worst load and column",
    "predicted": "the same as it was predicted",
    "cost": "cost of the choice, in pairs of transforms of 1024 x 1024 doubles",
    "cost_over_cheapest": "cost over that of the cheapest settings that reach the accuracy",
}
HEAD = """\
Settings chosen for an accuracy on surfaces that were not used to fit the laws behind the choice;
the factor by which the predicted errors are widened, {safety:g}, was set on them. Within: share of
repeated means within the accuracy at the worst load and quantity. Error: covers 90 % of them there.
Cost ratio: over the cheapest settings that reach the accuracy at every load and quantity.

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
        text = HEAD.format(safety=accuracy.SAFETY) + markdown(columns, rows)
        path.write_text(text, encoding="utf-8")


def validated(name, measured, laws, params):
    """One row for every accuracy and set of quantities on one surface."""
    bank, surface = bank_of(measured), surface_of(datasets.parameters(measured))
    loads, rows, found = measured.pressure.values, [], {}

    def draws(settings, repetitions=MANY):
        drawn = replace(settings, tolerance=accuracy.FULL), repetitions
        if drawn not in found:
            means = bank.errors(*drawn, DESCRIBED, seed=repetitions)
            found[drawn] = bank.by_quantity(means)
        return found[drawn]

    def errors(settings):
        # Solved to 1e-8 here: a larger tolerance adds what the laws say.
        return {
            (column, load): np.hypot(error, solver_error(laws, settings, surface, load, column))
            for (column, load), error in draws(settings).items()
        }

    @cache
    def predicted(settings, quantities):
        return accuracy.worst_error(laws, settings, surface, loads, quantities, DESCRIBED)[0]

    def reaches(settings, asked, quantities, keys):
        if predicted(settings, quantities) > HOPELESS * asked:
            return False
        # Of many settings some get there by luck: those are drawn anew, and more often.
        return all(
            np.quantile(draws(settings, repetitions)[key], COVERED) <= asked
            for repetitions in (FEW, MANY)
            for key in keys
        )

    # The largest tolerance is taken to add no error: what is cheapest is not made out dearer.
    candidates = sorted(
        (
            accuracy.Settings(pixels, accuracy.TOLERANCES[0], seeds, coarse)
            for pixels, seeds, coarse in itertools.product(
                accuracy.PIXELS, accuracy.SEEDS, accuracy.COARSE_SEEDS
            )
        ),
        key=lambda settings: cost_of(settings, measured, laws, surface),
    )
    for (text, quantities), asked in itertools.product(WANTED.items(), params.accuracies):
        columns = [c for quantity in quantities for c in accuracy.QUANTITIES[quantity]]
        keys = [(column, float(load)) for column in columns for load in loads]
        try:
            chosen = accuracy.cheapest(
                laws, asked, surface, loads, quantities, descriptor_seeds=DESCRIBED
            )
        except accuracy.UnreachableError:
            rows.append((name, text, asked, *[np.nan] * len(TEXTS)))
            continue
        reached = errors(chosen)
        cheapest = next((one for one in candidates if reaches(one, asked, quantities, keys)), None)
        cost = cost_of(chosen, measured, laws, surface)
        ratio = np.nan if cheapest is None else cost / cost_of(cheapest, measured, laws, surface)
        rows.append(
            (
                name,
                text,
                asked,
                float(chosen.pixels_per_wavelength),
                chosen.tolerance,
                float(chosen.seeds),
                float(chosen.coarse_seeds),
                min(np.mean(reached[key] <= asked) for key in keys),
                max(np.quantile(reached[key], COVERED) for key in keys),
                predicted(chosen, quantities),
                cost,
                ratio,
            )
        )
    return rows


def solver_error(laws, settings, surface, load, column):
    """What a tolerance above the one of the measurement adds, by its law."""
    if settings.tolerance <= accuracy.FULL:
        return 0.0
    return accuracy.error_parts(laws, settings, surface, load, column, DESCRIBED)["solver"]


def cost_of(settings, measured, laws, surface):
    """Cost of settings as measured on this surface, for all its loads.

    What a larger tolerance saves is by its law.
    """
    seconds = measured.seconds.mean("seed")
    grids = {settings.pixels_per_wavelength, settings.pixels_per_wavelength // 2, accuracy.COARSE}
    tolerance = settings.tolerance / accuracy.FULL
    saved = laws["tolerance_cost", ""](surface, tolerance=tolerance) if tolerance > 1 else 1.0
    total = saved * settings.seeds * float(seconds.sel(pixels=sorted(grids)).sum())
    if settings.coarse_seeds:
        total += saved * settings.coarse_seeds * float(measured.coarse_seconds.mean())
        total += DESCRIBED * float(measured.describing_seconds)
    return total / float(measured.pair_time)


def markdown(columns, rows):
    lines = [[value if isinstance(value, str) else f"{value:.3g}" for value in row] for row in rows]
    return table(columns, lines) + "\n" + summary(columns, rows)


def summary(columns, rows):
    """In how many choices the accuracy is reached at every load and quantity, and at what cost."""
    wanted = ("accuracy", "error", "predicted", "cost_over_cheapest")
    part = np.array([[row[columns.index(name)] for name in wanted] for row in rows], dtype=float)
    asked, error, predicted, ratio = part[np.isfinite(part[:, 1])].T
    reached = error <= asked
    # Where nothing measured reaches the accuracy, nothing is known of the cost.
    cheap, known = ratio <= DEAR, np.isfinite(ratio)
    return (
        f"Accuracy reached at every load and quantity: {reached.sum()} of {reached.size} choices "
        f"({reached.mean():.0%}), the others up to {(error / asked).max():.2f} times over. Reached "
        f"at no more than {DEAR:g} times the cheapest: {(reached & cheap).sum()} of "
        f"{reached.size}. Cost over the cheapest where it is reached: median "
        f"{np.median(ratio[reached & known]):.2f}, largest {ratio[reached & known].max():.2f}. "
        f"Nine in ten choices err by less than {np.quantile(error / predicted, COVERED):.2f} times "
        "what was predicted.\n"
    )


if __name__ == "__main__":
    main(start(globals(), "validate_accuracy"))
