"""Average the realisations of a case: means in the limit of fine grids, with their errors.

Coarse solutions of further seeds, if the case has them, are kept beside the values seed by seed:
whatever is derived from those is averaged in the same way, as the slope of area against load is.
"""

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
    others = ensembles.join_coarse(others, kept)
    made = datasets.parameters(realisations) | {"seeds": seeds, "case": job.wildcards.case}
    laws, output = job.input.laws, job.output.means
    ensembles.write_means(realisations, others, made, laws, output, averaged)
    means = datasets.read(output)
    title = "slope of the area-load relation"
    parameters = {**datasets.parameters(means), "linear_up_to": LINEAR_UP_TO}
    kappa = fit_kappa(means, read_models(laws))
    datasets.write(kappa, job.output.kappa, title=title, parameters=parameters)


if __name__ == "__main__":
    main(start(globals(), "average_ensemble", case="H0.8_zeta64"))
