"""Whether the seeds drawn so far give a case the accuracy it asks for; if not, what comes next."""

import logging
from dataclasses import asdict, replace

import numpy as np
import xarray as xr

from fits import fit_a_v, fit_kappa
from pipeline.conventions import DESCRIBED
from pipeline.ensembles import ensemble_of, wanted
from pipeline.job import start
from pipeline.quantities import TEXTS, statistics
from stickiness.accuracy import error_laws, sequential
from stickiness.core import datasets

MISSING = "no mean to refer to"


def main(job):
    asked = sequential.Asked(**job.params.asked)
    ensemble, _ = ensemble_of(job.input, list(asked.pressures), wanted(asked.quantities))
    settings = replace(
        error_laws.Settings(**job.params.settings),
        seeds=ensemble.sizes["seed"],
        coarse_seeds=ensemble.sizes.get("coarse_seed", 0),
    )
    found = measured(ensemble, asked, job.params.windows)
    decision = sequential.assess(error_laws.read_laws(job.input.laws), asked, settings, found)
    logging.info("%s", told(decision, asked, settings))
    datasets.write(
        dataset_of(decision, asked, settings),
        job.output[0],
        title="error of a case after a round of seeds",
        parameters={**asdict(asked), "settings": asdict(settings), "case": job.wildcards.case},
    )


def measured(ensemble, asked, windows):
    """Means and errors of all columns, load by load."""
    fits = {}
    if "a_v" in asked.columns:
        fits["a_v"] = fit_a_v.averaged(fit_a_v.fitted(ensemble, windows), ensemble, windows)
    if "kappa" in asked.columns:
        fits["kappa"] = fit_kappa.averaged(xr.Dataset(), "kappa", fit_kappa.slope, ensemble)
    columns = [statistics(column, ensemble, **fits) for column in asked.columns]
    return sequential.Measured(*(np.array(part) for part in zip(*columns, strict=True)))


def told(decision, asked, settings):
    """The decision in words."""
    worst, column, load = sequential.worst(decision.error, asked)
    after = {
        sequential.MORE: f"next {decision.settings.seeds} and {decision.settings.coarse_seeds}",
        sequential.ENOUGH: "enough",
        sequential.CAP: "at the cap",
        sequential.GRID: "by the grid, which more seeds do not make up for",
    }[decision.state]
    return (
        f"{settings.seeds} seeds and {settings.coarse_seeds} coarse ones: error {worst:.3g} of "
        f"{asked.accuracy:g} asked, largest in {column} at pressure {load:g}; {after}"
    )


def dataset_of(decision, asked, settings):
    dataset = xr.Dataset(
        {
            "error": (("column", "pressure"), decision.error),
            "sampling_error": (("column", "pressure"), decision.sampling),
            "state": np.int8(sequential.STATES.index(decision.state)),
            "seeds": settings.seeds,
            "coarse_seeds": settings.coarse_seeds,
            "next_seeds": decision.settings.seeds,
            "next_coarse_seeds": decision.settings.coarse_seeds,
        },
        coords={"column": list(asked.columns), "pressure": list(asked.pressures)},
    )
    return datasets.annotate(
        dataset,
        column=("1", "; ".join(f"{column}: {TEXTS[column]}" for column in asked.columns)),
        pressure=DESCRIBED["pressure"],
        error=("1", "relative error of the means so far; covers 90 %", MISSING),
        sampling_error=("1", "its part by sampling, as measured and by the laws", MISSING),
        state=("1", f"what follows, counted from 0: {', '.join(sequential.STATES)}"),
        seeds=("1", "seeds drawn so far"),
        coarse_seeds=("1", "coarse seeds drawn so far"),
        next_seeds=("1", "seeds of the next round; those drawn if there is none"),
        next_coarse_seeds=("1", "coarse seeds of the next round; those drawn if there is none"),
    )


if __name__ == "__main__":
    main(start(globals(), "assess_seeds", case="mine", round=1))
