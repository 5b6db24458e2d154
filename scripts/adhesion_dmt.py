"""Area-load curves with attraction in the DMT limit: the gaps stay those without adhesion."""

import numpy as np
import xarray as xr

import _limits
from _adhesion import AXES, axes, roughness
from _adhesion import DESCRIBED as ADHESION_DESCRIBED
from _dmt_limit import QUANTITIES, DmtLimit
from _errors import coarse, described, with_errors
from _job import start
from _model import DESCRIBED
from stickiness import datasets

OUTSIDE = "outside the table of measured errors"


def main(job):
    asked = job.params.adhesion
    ensemble = datasets.read(job.input.ensemble, ["attractive_area", "area_fraction", "rms_slope"])
    limit = DmtLimit.of(asked, ensemble)
    pressures, lengths, ranges = axes(asked)
    coordinates = {one.name: one for one in (pressures, lengths, ranges)}
    dataset = xr.Dataset(
        {
            "area_fraction": ensemble.area_fraction_mean.sel(pressure=pressures),
            "dmt_valid": (AXES, np.asarray(job.params.jtb, dtype="i1")),
            "dmt_error": (AXES, np.asarray(job.params.dmt_error, dtype=float)),
            "q0_h_rms": roughness(asked),
        },
        coords=coordinates,
    )
    for name in QUANTITIES:
        quantity = getattr(limit, name)
        left = _limits.inherited(ensemble, quantity, ["area_fraction", "attractive_area"])
        values, more = quantity(ensemble), coarse(ensemble, quantity)
        dataset = with_errors(dataset, name, values, more, plain=True, limit=left)
    datasets.write(
        annotated(dataset),
        job.output[0],
        title=f"adhesion in the DMT limit, {asked['law']} traction",
        parameters={**datasets.parameters(ensemble), **asked},
    )


def annotated(dataset):
    texts = {}
    for name, text in QUANTITIES.items():
        texts |= described(name, text, plain=True, discretisation=_limits.INHERITED)
    few = "fewer than two loads, or a single seed"
    return datasets.annotate(
        dataset,
        pressure=DESCRIBED["pressure"],
        area_fraction=DESCRIBED["area_fraction"],
        **ADHESION_DESCRIBED,
        dmt_valid=("1", "1 where the JTB condition for the DMT limit holds"),
        dmt_error=("1", "measured relative error of this 1/kappa_ad", OUTSIDE),
        **{name: (*text[:2], few) if "fit" in name else text for name, text in texts.items()},
    )


if __name__ == "__main__":
    main(start(globals(), "adhesion_dmt", adhesion="fig2"))
