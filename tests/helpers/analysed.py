"""Analysed surfaces, as the rule writes them."""

import json

import numpy as np
import xarray as xr

from criteria.pair_roughness import ENDS
from stickiness.spectrum import SelfAffine, Tabulated

LONGEST = 2e-4  # of the made-up wall [m]


def wall(h_rms=1e-6, draws=0, **more):
    """Analysed surface whose rough end has twice the rms height of the smooth one."""
    spectra = [
        SelfAffine(hurst=0.8, q0=2 * np.pi / LONGEST, q1=1e8, h_rms=factor * h_rms)
        for factor in (1, 2)
    ]
    q = np.geomspace(spectra[0].q0, spectra[0].q1, 200)
    spectra = [Tabulated(q, spectrum.psd(q)) for spectrum in spectra]
    data = {
        name: ("end", [getattr(spectrum, name) for spectrum in spectra])
        for name in ("h_rms", "rms_slope", "rms_curvature")
    }
    data["elastic_energy"] = "end", [spectrum.elastic_energy() for spectrum in spectra]
    data["psd"] = ("end", "wave_number"), [spectrum.psd(q) for spectrum in spectra]
    if draws:
        for name in ("h_rms", "elastic_energy"):
            data[f"{name}_draws"] = "draw", np.full(draws, data[name][1][0])
        data["q0_draws"] = "draw", np.full(draws, q[0])
    data |= {"q0": q[0], "q1": q[-1], "hurst": 0.8, **more}
    made = {"label": "wall", "kind": "self_affine"}
    dataset = xr.Dataset(data, coords={"end": list(ENDS), "wave_number": q})
    return dataset.assign_attrs(parameters=json.dumps(made))
