"""Made-up surfaces, described as if they had been analysed."""

import numpy as np

from stickiness import Surface
from stickiness.criteria.a_v_theory import SurfaceAv
from stickiness.spectrum import SelfAffine, SpectrumFamily
from stickiness.verdicts.surface_data import tabulate_family

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
    band = {"hurst": 0.8, "q0": 2 * np.pi / longest, "q1": 2 * np.pi / shortest}
    smooth, rough = (SelfAffine(**band, h_rms=factor * h_rms) for factor in (1, apart))
    data = Surface.from_spectrum(smooth, rough).data.assign(variables)
    if draws:
        factors = np.exp(scatter * np.random.default_rng(1).normal(size=draws))
        one = SpectrumFamily.of(smooth)
        drawn = SpectrumFamily(one.q, one.area, factors[:, None] ** 2 * one.psd)
        data = data.assign(tabulate_family(drawn))
        data = data.assign(drawn_q0=("draw", np.full(draws, smooth.q0)), q_cutoff=smooth.q1)
    return fix_a_v(Surface(data.assign_attrs(not_judged=not_judged)))
