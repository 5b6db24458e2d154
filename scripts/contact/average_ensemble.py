"""Average the realisations of a case: means in the limit of fine grids, with their errors.

Coarse solutions of further seeds, if the case has them, are kept beside the values seed by seed:
whatever is derived from those is averaged in the same way, as the slope of area against load is.
"""

import xarray as xr

from common.conventions import LINEAR_UP_TO
from common.job import start
from common.model_surfaces import read_all
from common.quantities import fit_kappa
from contact import ensembles
from stickiness import datasets
from stickiness.accuracy.error_models import read_models


def main(job):
    averaged, seeds = ensembles.choose_means(job.params.quantities), list(job.params.seeds)
    optional = [name for name in ensembles.OPTIONAL if name in averaged]
    # The files may be those of another case with more seeds and loads.
    loads, kept = list(job.params.pressures), (*ensembles.COARSE, *optional)
    realisations = read_all(job.input.realisations, (*ensembles.NEEDED, *optional))
    realisations = realisations.sel(seed=seeds, pressure=loads)
    others = [datasets.read(path, kept).sel(pressure=loads) for path in job.input.coarse]
    more = ensembles.join_coarse(others, kept) if others else xr.Dataset()
    dataset = ensembles.add_statistics(realisations, more, averaged)
    largest = float(realisations.residual.max())
    parameters = datasets.parameters(realisations) | {"seeds": seeds, "largest_residual": largest}
    parameters |= ensembles.describe_sampling(parameters, dataset) | {"case": job.wildcards.case}
    ensembles.write_means(dataset, parameters, job.input.laws, job.output.means, averaged)
    datasets.write(
        fit_kappa(datasets.read(job.output.means), read_models(job.input.laws)),
        job.output.kappa,
        title="slope of the area-load relation",
        parameters={**parameters, "linear_up_to": LINEAR_UP_TO},
    )


if __name__ == "__main__":
    main(start(globals(), "average_ensemble", case="H0.8_zeta64"))
