"""Rows of the table and points of the error models for contact without adhesion."""

from dataclasses import dataclass
from functools import cache

import numpy as np

from common.clock import time_task
from common.contact_curves import SOLVED_FROM
from common.conventions import FIT_MEASURED, GAPS_MEASURED
from common.derived_quantities import derive, quote
from common.model_surfaces import cell_size, model_spectrum
from common.theory_variants import contact_of
from stickiness import datasets
from stickiness.accuracy import multilevel
from stickiness.accuracy.error_models import COARSE, FULL, Settings
from stickiness.accuracy.quantities import MODELLED, columns_of
from stickiness.accuracy.settings import COARSE_SEEDS, SEEDS
from stickiness.persson.theory import Persson
from stickiness.repulsive import richardson
from stickiness.surface import lattice_spectrum
from tradeoff.measuring import SETTINGS, split_loads

DESCRIBED_SEEDS = 2048
REPETITIONS = 60  # of means that are drawn


@dataclass(eq=False)
class SeedPool:
    """Solved seeds of one surface, from which means of random seeds are drawn."""

    fine: dict  # (seed, entry), by pixels per shortest wavelength, 2 included
    coarse: np.ndarray  # (seed, entry): more seeds on 2 pixels
    controls: np.ndarray  # (seed, descriptor): long waves of the coarse seeds
    elsewhere: np.ndarray  # (seed, descriptor): long waves of seeds that are not solved
    entries: list  # quantity and load of every entry
    costs: dict  # of all loads of a seed, by pixels or kind

    def __post_init__(self):
        # The finest grid has few seeds: the best grid is the finest one with many.
        *_, self.best, self.finest = sorted(self.fine)
        many = self.fine[self.best]
        few = self.fine[self.finest]
        to_finest = few.sum(0) / many[: len(few)].sum(0)

        # The best estimate on the finest grid of the mean over all surfaces, and the mean of the
        # fine seeds alone, about which their plain means scatter.
        estimate = multilevel.multilevel_mean(
            fine=many,
            coarse=self.fine[COARSE],
            many=self.coarse,
            controls=self.controls,
            elsewhere=self.elsewhere,
        )
        self.truth = estimate.mean * to_finest
        self.truth_error = estimate.standard_error * to_finest
        self.fine_mean = many.mean(0) * to_finest

        # With replacement: means of few seeds then scatter about the mean of all as they would
        # about the mean of the whole ensemble. More seeds include those of fewer, as in a case.
        rng = np.random.default_rng(1)
        self.chosen = rng.integers(len(many), size=(SEEDS[-1], REPETITIONS))
        self.many = rng.integers(len(self.coarse), size=(REPETITIONS, COARSE_SEEDS[-1]))
        self.others = rng.integers(len(self.elsewhere), size=(REPETITIONS, DESCRIBED_SEEDS))
        self.average_coarse = cache(self._average_coarse)

        # Places of the entries of each quantity at each load.
        self.loads = len({load for _, load in self.entries})
        self.places = {}
        for place, key in enumerate(self.entries):
            self.places.setdefault(key, []).append(place)

    def by_quantity(self, errors):
        """Root mean square over the entries of each quantity at each load; leading axes stay."""
        return {
            key: np.sqrt(np.mean(errors[..., places] ** 2, axis=-1))
            for key, places in self.places.items()
        }

    def cost(self, settings):
        """Measured cost of a mean at all loads, without what a larger tolerance saves."""
        pixels = settings.pixels_per_wavelength
        total = settings.seeds * sum(self.costs[p] for p in {pixels, pixels // 2, COARSE})
        if settings.coarse_seeds:
            total += settings.coarse_seeds * self.costs["coarse"]
            total += DESCRIBED_SEEDS * self.costs["described"]
        return total

    def draw(self, settings):
        """Relative errors of the means of every repetition, by quantity and load."""
        chosen = self.chosen[: settings.seeds]
        fine = self.fine[settings.pixels_per_wavelength][chosen]
        truth = self.fine_mean
        mean = fine.mean(0)
        if settings.coarse_seeds:
            level = self.average_coarse(settings.coarse_seeds)
            twin = self.fine[COARSE][chosen]
            mean = multilevel.corrected_mean(fine, twin, level).mean
            truth = self.truth
        return self.by_quantity(mean / truth - 1)

    def _average_coarse(self, count):
        """Means of `count` coarse seeds, one for every repetition."""
        means = []
        for many, others in zip(self.many[:, :count], self.others, strict=True):
            estimate = multilevel.controlled_mean(
                self.coarse[many], self.controls[many], self.elsewhere[others]
            )
            means.append(estimate.mean)
        return multilevel.Estimate(np.array(means), np.zeros(1), np.empty(0))


def make_pool(measured):
    """Make the pool of a file of `measure_contact`."""
    usual = datasets.parameters(measured)["tolerance"]
    unit = float(measured.pair_time)

    # Fine seeds on every grid, and further seeds on the coarsest alone.
    is_fine = (measured.seed < SOLVED_FROM).values
    fine_seeds = measured.isel(solution=is_fine)
    solved = {p: select(fine_seeds, p, usual) for p in np.unique(measured.pixels).tolist()}
    more = select(measured.isel(solution=~is_fine), COARSE, usual)

    costs = {pixels: float(solutions.seconds.mean()) / unit for pixels, solutions in solved.items()}
    costs["coarse"] = float(more.seconds.mean()) / unit
    costs["described"] = float(measured.describing_seconds) / unit
    coarse, entries = flatten(more)
    return SeedPool(
        fine={pixels: flatten(extrapolate(solved, pixels))[0] for pixels in solved},
        coarse=coarse,
        controls=measured.long_waves.values,
        elsewhere=measured.other_long_waves.values,
        entries=entries,
        costs=costs,
    )


def select(measured, pixels, tolerance):
    """Solutions with one grid and tolerance, along the seed."""
    chosen = (measured.pixels == pixels) & (measured.tolerance == tolerance)
    solutions = measured.isel(solution=chosen.values).swap_dims(solution="seed")
    return solutions.drop_vars(SETTINGS[:2])


def extrapolate(solved, pixels):
    """Solutions on one grid, attractive areas in the limit of fine grids, as in ensembles."""
    fine = solved[pixels]
    if pixels == COARSE:
        return fine
    edge_gap = fine.edge_gap.mean("seed")
    half = solved[pixels // 2].sel(seed=fine.seed)
    limit = richardson.estimate(
        "attractive_area",
        [half.attractive_area, fine.attractive_area],
        fine.attractive_area - fine.pixel_attractive_area,
        fine.edges,
        (fine["range"] / edge_gap).where(edge_gap > 0, np.inf),
    )
    return fine.assign(attractive_area=limit.value)


def derive_columns(solved):
    """Derive the columns of all quantities with error models, and P(u) at all gaps measured."""
    contact = derive(solved, FIT_MEASURED)
    columns = {name: quote(name, contact) for name in columns_of(MODELLED)}
    return columns | {"gap_distribution": contact.gap_density.sel(gap=slice(*GAPS_MEASURED))}


def flatten(solved):
    """Join all columns at all loads as `(seed, entry)`; list quantity and load of each entry."""
    values = []
    entries = []
    for name, column in derive_columns(solved).items():
        column = column.transpose("seed", "pressure", ...)
        values.append(column.values.reshape(column.sizes["seed"], -1))
        loads = np.repeat(column.pressure.values, column[0, 0].size)
        entries += [(name, load) for load in loads.tolist()]
    return np.concatenate(values, axis=1), entries


def tabulate_contact(measured, records):
    """Add rows and points of one file of `measure_contact`."""
    pool = make_pool(measured)
    tabulate_grids(pool, records)
    tabulate_tolerances(measured, records)
    tabulate_seeds(pool, records)
    tabulate_theory(measured, pool, records)


def tabulate_grids(pool, records):
    """Errors of single surfaces against the finest grid, errors of means, and costs."""
    fine = pool.fine
    costs = pool.costs
    loads = pool.loads
    exact = fine[pool.finest]
    grids = [pixels for pixels in fine if pixels < pool.finest]
    for pixels in grids:
        errors = pool.by_quantity(fine[pixels][: len(exact)] / exact - 1)
        # Areas are extrapolated from two grids.
        cost = costs[pixels] + (costs[pixels // 2] if pixels > COARSE else 0.0)
        records.add("points per wavelength", str(pixels), errors, cost / loads)
    # Up to the `best` grid with many seeds against it, from there on with few against the finest.
    best = fine[pool.best]
    first, its_noise = compare_means(best[: len(exact)], exact)
    errors = {pool.best: (first, its_noise)}
    for pixels in grids[1:-1]:
        off, noise = compare_means(fine[pixels], best)
        errors[pixels] = (1 + off) * (1 + first) - 1, np.hypot(noise, its_noise)
    for pixels, parts in errors.items():
        records.add_points("discretisation", *map(pool.by_quantity, parts), pixels=pixels)
    for pixels in fine:
        records.add_point("fine_cost", "", costs[pixels] / loads, pixels=pixels)
    records.add_point("coarse_cost", "", costs["coarse"] / loads)
    records.add_point("described_cost", "", costs["described"])


def compare_means(coarse, exact):
    """Relative difference of two means over the same seeds, and its standard error."""
    noise = (coarse / exact.mean(0) - exact * coarse.mean(0) / exact.mean(0) ** 2).std(0)
    return coarse.mean(0) / exact.mean(0) - 1, noise / np.sqrt(max(len(exact) - 1, 1))


def tabulate_tolerances(measured, records):
    """Errors by the solver's tolerance, and the share of the cost that a larger one leaves."""
    parameters = datasets.parameters(measured)
    unit = float(measured.pair_time)
    at_pixels = parameters["at_pixels"]
    tolerances = np.unique(measured.tolerance.sel(solution=measured.pixels == at_pixels))
    best = select(measured, at_pixels, tolerances[0])
    exact = derive_columns(best)
    loads = best.sizes["pressure"]
    solved = {t: select(measured, at_pixels, t).sel(seed=best.seed) for t in tolerances[1:]}
    full = float(solved[parameters["tolerance"]].seconds.mean())
    for tolerance, solutions in solved.items():
        seconds = float(solutions.seconds.mean())
        records.add_point("tolerance_cost", "", seconds / full, tolerance=tolerance / FULL)
        single = {}
        for quantity, values in derive_columns(solutions).items():
            square = (values / exact[quantity] - 1) ** 2
            error = np.sqrt(square.mean([d for d in square.dims if d not in ("seed", "pressure")]))
            single |= split_loads(quantity, error)
        together = {key: np.sqrt((errors**2).mean()) for key, errors in single.items()}
        records.add_points("solver", together, tolerance=tolerance)
        records.add("tolerance", f"{tolerance:g}", single, seconds / loads / unit)


def tabulate_seeds(pool, records):
    """Errors of means by the number and kind of seeds, on the finest grid that has many."""
    scatter = pool.fine[pool.best].std(0, ddof=1) / np.abs(pool.truth)
    records.add_points("scatter", pool.by_quantity(scatter))
    for pixels, fine in pool.fine.items():
        if pixels != COARSE:
            twin = pool.fine[COARSE][: len(fine)]
            left = (fine - fine.sum(0) / twin.sum(0) * twin).std(0, ddof=1) / fine.std(0, ddof=1)
            records.add_points("fine_share", pool.by_quantity(left), pixels=pixels)
    estimate = multilevel.controlled_mean(pool.coarse, pool.controls, pool.elsewhere)
    slopes = np.std(pool.elsewhere @ estimate.coefficient, axis=0, ddof=1)
    explained = np.minimum(slopes / pool.coarse.std(0, ddof=1), 1)
    records.add_points("coarse_share", pool.by_quantity(np.sqrt(1 - explained**2)))

    means = ((4, 0), (8, 0), (16, 0), (32, 0), (2, 64), (4, 64), (8, 64), (4, 256), (8, 256))
    for seeds, more in means:
        settings = Settings(pool.best, FULL, seeds, more)
        text = f"{seeds} + {more}" if more else f"{seeds} plain"
        records.add("seeds", text, pool.draw(settings), pool.cost(settings) / pool.loads)


def tabulate_theory(measured, pool, records):
    """Errors of Persson's theory on the lattice spectrum, relative to the simulation."""
    parameters = datasets.parameters(measured)
    loads = measured.pressure.values
    lattice = lattice_spectrum(model_spectrum(parameters), cell_size(parameters))
    state, seconds = time_task(
        lambda: contact_of(Persson(lattice), loads, measured["range"].values)
    )
    values, _ = flatten(state.expand_dims("seed"))
    errors = pool.by_quantity(values[0] / pool.truth - 1)
    records.add_points("theory", errors, pool.by_quantity(pool.truth_error / pool.truth))
    records.add("model", "theory", errors, seconds / len(loads) / float(measured.pair_time))
