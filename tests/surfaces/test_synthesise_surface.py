"""One random surface and the moments that its file states."""

import numpy as np
import pytest
from helpers.entries import model_surface
from helpers.jobs import make_job
from scipy import stats

from stickiness import datasets
from surfaces import synthesise_surface


def made(folder, seed, **surface):
    asked = model_surface(magnification=8, **surface)
    params = {"seeds": [seed, seed + 1], "surface": asked, "pixels_per_wavelength": 4}
    job = make_job(folder / f"seeds{seed}.nc", params, {})
    synthesise_surface.main(job)
    both = datasets.read(job.output[0])
    assert both.seed.values.tolist() == [seed, seed + 1]
    return both.sel(seed=seed)


def test_moments_are_those_of_the_heights(tmp_path):
    found = made(tmp_path, 3)
    heights, step = found.height.values, float(found.window_length) / found.sizes["x"]
    moments = found.sel(source="heights")
    assert float(moments.h_rms) == pytest.approx(heights.std())
    assert float(found.realised_variance.sum()) == pytest.approx(heights.var())
    # Central differences on 4 points per shortest wave see most of the slope, and never more.
    squares = [
        ((np.roll(heights, -1, axis) - np.roll(heights, 1, axis)) / step / 2) ** 2
        for axis in (0, 1)
    ]
    seen = np.sqrt(np.mean(np.sum(squares, axis=0))) / float(moments.rms_slope)
    assert 0.6 < seen < 1
    assert np.array_equal(made(tmp_path, 3).height, heights)
    assert not np.array_equal(made(tmp_path, 4).height, heights)


def test_skewed_heights_have_the_spectrum_of_the_gaussian_ones(tmp_path):
    plain = made(tmp_path / "plain", 3, window=4)
    skewed = made(tmp_path / "skewed", 3, window=4, heights={"skewness": -1.0})
    np.testing.assert_allclose(skewed.realised_variance, plain.realised_variance, rtol=1e-9)
    assert stats.skew(skewed.height, axis=None) == pytest.approx(-1, abs=0.02)
    assert datasets.parameters(skewed)["heights"] == {"skewness": -1.0}
    assert "heights" not in datasets.parameters(plain)


def test_fixed_amplitudes_hold_the_variance_of_the_lattice(tmp_path):
    found = made(tmp_path, 3, amplitudes="fixed")
    np.testing.assert_allclose(found.realised_variance, found.lattice_variance, rtol=1e-9)
