"""Average the realisations of a case: means in the limit of fine grids, with their errors.

Coarse solutions of further seeds, if the case has them, are kept beside the values seed by seed:
whatever is derived from those is averaged in the same way.
"""

from pipeline.ensembles import add_budgets, annotate, choose_means, ensemble_of
from pipeline.job import start
from stickiness.core import datasets


def main(job):
    averaged = choose_means(job.params.quantities)
    asked = list(job.params.seeds), list(job.params.pressures)
    dataset, parameters = ensemble_of(job.input, *asked, averaged)
    parameters["case"] = job.wildcards.case
    datasets.write(
        add_budgets(annotate(dataset, averaged), parameters, job.input.laws, averaged),
        job.output[0],
        title="repulsive contact averaged over realisations",
        parameters=parameters,
    )


if __name__ == "__main__":
    main(start(globals(), "average_ensemble", case="H0.8_zeta64"))
