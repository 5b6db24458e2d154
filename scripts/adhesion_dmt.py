"""Area-load curves with attraction in the DMT limit: the gaps stay those without adhesion."""

import numpy as np
import xarray as xr

import _limits
from _adhesion import DESCRIBED as ADHESION_DESCRIBED
from _adhesion import axis, dmt_valid, roughness
from _errors import coarse, described, with_errors
from _job import start
from _model import DESCRIBED
from stickiness import datasets


def main(job):
    asked = job.params.adhesion
    ensemble = datasets.read(job.input.ensemble, ["attractive_area", "area_fraction", "rms_slope"])
    q0_h_rms = roughness(asked)
    lengths = axis("adhesion_length_over_range", asked)
    ranges = axis("range_over_h_rms", asked)

    def attraction(solved):
        return lengths * area_within(solved.attractive_area, ranges) / q0_h_rms

    def inverse_kappa(solved):
        external = solved.pressure - attraction(solved)
        return external / (solved.area_fraction * solved.rms_slope)

    def inverse_kappa_ad(solved):
        return attraction(solved) / solved.pressure / 2

    dataset = xr.Dataset({"area_fraction": ensemble.area_fraction_mean, "q0_h_rms": q0_h_rms})
    for quantity in (attraction, inverse_kappa, inverse_kappa_ad):
        values, more = quantity(ensemble), coarse(ensemble, quantity)
        limit = _limits.inherited(ensemble, quantity, ["area_fraction", "attractive_area"])
        dataset = with_errors(dataset, quantity.__name__, values, more, plain=True, limit=limit)
    dataset["dmt_valid"] = dmt_valid(q0_h_rms, lengths, ranges)
    datasets.write(
        annotated(dataset),
        job.output[0],
        title="adhesion in the DMT limit, Maugis traction",
        parameters={**datasets.parameters(ensemble), **asked, "model": "DMT", "law": "Maugis"},
    )


def area_within(area, ranges):
    """Attractive area at ranges between those stored, along a power law from point to point."""
    logs = xr.apply_ufunc(np.log, area).assign_coords(range=np.log(area["range"]))
    return np.exp(logs.interp(range=np.log(ranges))).drop_vars("range")


QUANTITIES = {
    "attraction": "attractive pressure over E* q0 h_rms",
    "inverse_kappa": "1/kappa = p_ext A_nom/(A_rep E* h'_rms)",
    "inverse_kappa_ad": "1/kappa_ad = p_ad/(2 p_rep)",
}


def annotated(dataset):
    texts = {}
    for name, text in QUANTITIES.items():
        texts |= described(name, text, plain=True, discretisation=_limits.INHERITED)
    return datasets.annotate(
        dataset,
        pressure=DESCRIBED["pressure"],
        area_fraction=DESCRIBED["area_fraction"],
        **ADHESION_DESCRIBED,
        dmt_valid=("1", "1 where the JTB condition for the DMT limit holds"),
        **texts,
    )


if __name__ == "__main__":
    main(start(globals(), "adhesion_dmt", adhesion="fig2"))
