"""Average the realisations of a case: means in the limit of fine grids, with their errors.

Coarse solutions of further seeds, if the case has them, are kept beside the values seed by seed:
whatever is derived from those is averaged in the same way, as the slope of area against load is.
"""

from common.conventions import LINEAR_UP_TO
from common.job import start
from common.quantities import fit_kappa
from contact.ensembles import average_files, choose_means, write_means
from stickiness import datasets
from stickiness.accuracy.error_models import read_models


def main(job):
    averaged = choose_means(job.params.quantities)
    wanted = list(job.params.seeds), list(job.params.pressures)
    dataset, parameters = average_files(job.input, *wanted, averaged)
    parameters["case"] = job.wildcards.case
    write_means(dataset, parameters, job.input.laws, job.output.means, averaged)
    datasets.write(
        fit_kappa(datasets.read(job.output.means), read_models(job.input.laws)),
        job.output.kappa,
        title="slope of the area-load relation",
        parameters={**parameters, "linear_up_to": LINEAR_UP_TO},
    )


if __name__ == "__main__":
    main(start(globals(), "average_ensemble", case="H0.8_zeta64"))
