"""Contact of one made-up surface along its load path, against closed forms."""

import numpy as np
import pytest
import xarray as xr
from helpers.jobs import make_job

from contact import contact_maps, solve_repulsive
from stickiness import datasets

LENGTH, AMPLITUDE, N = 2 * np.pi, 1.0, 64
FULL = AMPLITUDE / 2  # mean pressure over E* that flattens h = cos(x): E* q a / 2


@pytest.fixture(scope="module")
def surface(tmp_path_factory):
    """A one-dimensional wave, whose contact Westergaard solved."""
    x = np.arange(N) * LENGTH / N
    dataset = xr.Dataset(
        {
            "height": (("seed", "x", "y"), [np.tile(AMPLITUDE * np.cos(x)[:, None], N)] * 2),
            "window_length": ((), LENGTH),
            "rms_slope": (("seed", "source"), [[AMPLITUDE / np.sqrt(2)]] * 2),
        },
        coords={"seed": [1, 2], "x": x, "y": x, "source": ["heights"]},
    )
    texts = {name: ("1", name) for name in dataset.variables}
    path = tmp_path_factory.mktemp("surface") / "seeds1-2.nc"
    parameters = {"grid_points": N, "magnification": 1, "window": 1.0, "seeds": [1, 2]}
    datasets.write(datasets.annotate(dataset, **texts), path, title="wave", parameters=parameters)
    return str(path)


def job_of(path, surface, **params):
    asked = {"pressures": [0.5 * FULL, 2 * FULL], "tolerance": 1e-8} | params
    return make_job(path, asked, surfaces=[surface])


def test_load_path_of_a_wave(tmp_path, surface):
    gaps = {"minimum": 0.01, "maximum": 10, "per_decade": 4}
    asked = {"seeds": [2], "pixels_per_wavelength": 4, "gaps": gaps}
    job = job_of(tmp_path / "solved.nc", surface, **asked)
    solve_repulsive.main(job)
    found = datasets.read(job.output[0])
    np.testing.assert_allclose(found.pressure, [0.5 * FULL, 2 * FULL])
    half, flat = (found.area_fraction.isel(pressure=i) for i in (0, 1))
    assert (flat == 1).all()
    # Westergaard 1939: area fraction (2/pi) arcsin(sqrt(p/p_full)), to a point at either edge.
    assert half.values == pytest.approx(0.5, abs=2 / found.resolution.values.min())
    assert float(found.residual.max()) < 1e-6
    assert found.seed.values.tolist() == [2]


def test_maps_are_of_the_loads_asked_for(tmp_path, surface):
    job = job_of(tmp_path / "maps.nc", surface)
    contact_maps.main(job)
    found = datasets.read(job.output[0])
    loads = found.contact_pressure.mean(("x", "y"))
    np.testing.assert_allclose(loads, [0.5 * FULL, 2 * FULL], rtol=1e-6)
    assert (found.gap >= 0).all()
    assert float((found.gap * found.contact_pressure).max()) == 0


def test_surfaces_of_a_job_may_be_in_several_files_and_a_missing_one_is_named(tmp_path, surface):
    gaps = {"minimum": 0.01, "maximum": 10, "per_decade": 4}
    both = datasets.read(surface)
    paths = [str(tmp_path / f"seeds{seed}-{seed}.nc") for seed in (1, 2)]
    for seed, path in zip((1, 2), paths, strict=True):
        one = both.sel(seed=[seed])
        datasets.write(one, path, title="wave", parameters=datasets.parameters(both))
    asked = {"seeds": [1, 2], "pixels_per_wavelength": 4, "gaps": gaps}
    found = []
    for name, inputs in (("one", [surface]), ("two", paths)):
        job = job_of(tmp_path / f"{name}.nc", surface, **asked)
        job.input.surfaces = inputs
        solve_repulsive.main(job)
        found.append(datasets.read(job.output[0]))
    assert found[0].equals(found[1])
    job.input.surfaces = paths[1:]
    with pytest.raises(datasets.DatasetError, match=r"seeds2-2\.nc: no surface of seed 1"):
        solve_repulsive.main(job)
