"""Made-up surfaces, described as if they had been analysed."""

import numpy as np
import xarray as xr

from stickiness import Surface
from stickiness.criteria.a_v_table import SurfaceAv
from stickiness.spectrum import SelfAffine, Tabulated
from stickiness.verdicts.parametric import ENDS

LONGEST = 2e-4  # of the made-up wall [m]
A_V = SurfaceAv(np.array([1e-9, 1.0]), np.full((2, 2), 3.0), 0.1)


def fix_a_v(surface, a_v=A_V):
    """Give a surface an a_V: little depends on it, and theory takes its time."""
    surface.__dict__["a_v"] = (a_v, a_v)
    return surface


def wall(
    h_rms=1e-6,
    draws=0,
    apart=2.0,
    scatter=0.0,
    longest=LONGEST,
    shortest=6e-8,
    not_judged="",
    **variables,
):
    """Surface whose rough end is `apart` times as high as the smooth one.

    Heights of the draws scatter about the smooth end, with this standard deviation in logarithms.
    """
    q = np.geomspace(2 * np.pi / longest, 2 * np.pi / shortest, 200)
    shape = SelfAffine(hurst=0.8, q0=q[0], q1=q[-1], h_rms=h_rms).psd(q)
    spectra = [Tabulated(q, factor**2 * shape) for factor in (1, apart)]
    data = {
        name: ("end", [getattr(spectrum, name) for spectrum in spectra])
        for name in ("h_rms", "rms_slope", "rms_curvature")
    }
    data["elastic_energy"] = "end", [spectrum.elastic_energy() for spectrum in spectra]
    data["psd"] = ("end", "wave_number"), [spectrum.psd(q) for spectrum in spectra]
    if draws:
        factors = np.exp(scatter * np.random.default_rng(1).normal(size=draws))
        for name, power in (("h_rms", 1), ("elastic_energy", 2)):
            data[f"{name}_draws"] = "draw", data[name][1][0] * factors**power
        data["q0_draws"] = "draw", np.full(draws, q[0])
    data |= {"q0": q[0], "q1": q[-1], "hurst": 0.8, **variables}
    dataset = xr.Dataset(data, coords={"end": list(ENDS), "wave_number": q})
    return fix_a_v(Surface(dataset.assign_attrs(not_judged=not_judged)))
