"""Analysed surfaces, as the rule writes them."""

import json

import numpy as np
import xarray as xr

from criteria.pair_roughness import ENDS
from stickiness.criteria.a_v_table import SurfaceAv
from stickiness.spectrum import SelfAffine, Tabulated

LONGEST = 2e-4  # of the made-up wall [m]
Q = np.geomspace(2 * np.pi / LONGEST, 1e8, 200)
A_V = SurfaceAv(np.array([1e-9, 1.0]), np.full((2, 2), 3.0), 0.1)  # of any surface


def tabulate(h_rms, q=Q):
    """Spectrum of the wall."""
    return Tabulated(q, SelfAffine(hurst=0.8, q0=q[0], q1=q[-1], h_rms=h_rms).psd(q))


def wall(h_rms=1e-6, ends=(1, 2), draws=(), q=Q, **more):
    """Analysed surface; rms heights at its `ends` and of its `draws` are in units of `h_rms`."""
    spectra, draws = [tabulate(factor * h_rms, q) for factor in ends], np.array(draws)
    names = ("h_rms", "rms_slope", "rms_curvature")
    data = {name: ("end", [getattr(spectrum, name) for spectrum in spectra]) for name in names}
    data["elastic_energy"] = "end", [spectrum.elastic_energy() for spectrum in spectra]
    data["psd"] = ("end", "wave_number"), [spectrum.psd(q) for spectrum in spectra]
    if draws.size:
        data["h_rms_draws"] = "draw", h_rms * draws
        data["elastic_energy_draws"] = "draw", tabulate(h_rms, q).elastic_energy() * draws**2
        data["q0_draws"] = "draw", np.full(draws.size, q[0])
    data |= {"q0": q[0], "q1": q[-1], "hurst": 0.8, **more}
    made = {"label": "wall", "kind": "self_affine"}
    dataset = xr.Dataset(data, coords={"end": list(ENDS), "wave_number": q})
    return dataset.assign_attrs(parameters=json.dumps(made))
