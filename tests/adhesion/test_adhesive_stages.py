import itertools

import numpy as np
import pytest
import xarray as xr
from helpers.entries import model_surface
from helpers.jobs import make_job
from scipy import optimize, stats

from adhesion import adhesive_maps, average_adhesive, solve_adhesive
from adhesion.dmt_sum import fit_slope, integrate_law, linearity_error, weak_attraction
from common.adhesion_sets import scaled_law
from stickiness import adhesive, datasets, dmt, repulsive, spectrum, surface
from stickiness.adhesive import edge_zone
from surfaces import synthesise_surface

LENGTH = 2 * np.pi
AXES = "pressures", "adhesion_length_over_range", "range_over_h_rms"
ASKED = {"q0_h_rms": 0.1, "range_over_h_rms": [0.3], "adhesion_length_over_range": [1e-3]}
ASKED |= {"pressures": [0.1], "law": "maugis", "refine": 1, "half_from": None}


@pytest.fixture(scope="module")
def heights():
    s = spectrum.SelfAffine(hurst=0.8, q0=1.0, q1=8.0, h_rms=1.0)
    return surface.synthesise(s, 64, LENGTH, seed=3)


def solved(heights, curve=None, **changes):
    """States in full and what compares them with contact without adhesion, at one resolution."""
    asked = ASKED | changes
    full = np.ones([len(asked[name]) for name in AXES], bool)
    chosen = solve_adhesive.combinations(asked, LENGTH / len(heights), full)
    states = solve_adhesive.states([heights], LENGTH, asked, chosen, 1e-9)[0]
    states = states.assign(rms_slope=2.0).expand_dims(seed=[3], resolution=[8.0])
    linear = states.area_alone.squeeze() < 1
    curve = load_curve(heights) if curve is None else curve
    return average_adhesive.add_slopes(states, curve, linear.expand_dims("pressure"))


def load_curve(heights, loads=(0.02, 0.05, 0.1, 0.2)):
    """Area without adhesion at loads around that of the states, as an ensemble has it."""
    loads = np.unique([*loads, 0.1])
    path = repulsive.load_path(heights, LENGTH, loads, tol=1e-9)
    area = np.array([[[contact.area_fraction for contact in path]]])
    return xr.Dataset(
        {"area_fraction": (("seed", "resolution", "pressure"), area)},
        coords={"seed": [3], "resolution": [8.0], "pressure": loads},
    )


def test_attraction_beyond_all_gaps_is_a_load(heights):
    """Felt everywhere at once, it takes its strength off the pressure and leaves the area."""
    one = solved(heights, range_over_h_rms=[100.0]).squeeze()
    strength = 1e-3 / 0.1
    np.testing.assert_allclose(one.external_pressure, 0.1 - strength, rtol=1e-6)
    assert float(one.repulsive_area) == float(one.area_alone)
    # the same area is at the same mean gap
    np.testing.assert_allclose(one.inverse_kappa_ad_equal_area, one.inverse_kappa_ad, rtol=1e-6)
    contact = repulsive.solve(heights, LENGTH, 0.1, tol=1e-9)
    assert float(one.net_repulsive_area) == np.mean(contact.pressure > strength)
    # DMT sums it over the open area only
    np.testing.assert_allclose(one.dmt_ratio, 1 / (1 - one.area_alone), rtol=1e-6)


@pytest.mark.parametrize("law", ["maugis", "exponential"])
def test_weak_attraction_takes_the_slope_of_its_potential_off_the_pressure(heights, law):
    """At a given mean gap, in full simulation and from the areas of an ensemble."""
    asked = ASKED | {"law": law}
    one = solved(heights, **asked).squeeze()
    loads, gaps = [0.097, 0.1, 0.103], np.geomspace(1e-4, 10, 801)
    contacts = list(repulsive.load_path(heights, LENGTH, loads, tol=1e-10))
    alone = xr.Dataset(
        {
            "area_fraction": ("pressure", [c.area_fraction for c in contacts]),
            "mean_gap": ("pressure", [c.mean_gap for c in contacts]),
            "attractive_area": (
                ("pressure", "range"),
                [dmt.attractive_area(c.gap, gaps) for c in contacts],
            ),
        },
        coords={"pressure": loads, "range": gaps},
    )
    limit = weak_attraction(asked, alone).sel(pressure=0.1).item()
    # first order in an attraction that is some hundredths of the pressure
    assert 0.1 - float(one.external_pressure) == pytest.approx(limit, rel=0.02)
    assert limit < 0.8 * float(one.attraction_dmt)
    assert weak_attraction(asked, alone.isel(pressure=[0, 1])).isnull().all()


def test_a_ratio_of_means_is_not_the_mean_of_ratios():
    values, limit = (xr.DataArray(given, dims="seed") for given in ([1.0, 6.0], [2.0, 4.0]))
    ratio = average_adhesive.ratio_of_means(values, limit)
    assert float(ratio.mean()) == pytest.approx(7 / 6)
    # To first order the scatter of a ratio: that of the residuals over the mean below.
    assert float(ratio.std(ddof=1)) == pytest.approx(np.std([1 - 14 / 6, 6 - 28 / 6], ddof=1) / 3)


def test_grids_of_seeds_and_ranges(tmp_path):
    """Half of the seeds are on half the grid alone, and long ranges on grids half as fine."""
    surface = model_surface(magnification=8)
    made = {"surface": surface, "pixels_per_wavelength": 8, "seeds": [1, 2]}
    synthesised = make_job(tmp_path / "surfaces.nc", made)
    synthesise_surface.main(synthesised)
    asked = ASKED | {"law": "exponential", "range_over_h_rms": [0.1, 0.5], "half_from": 0.3}
    params = {"adhesion": asked, "full": [[[True, True]]], "grids": [[[2, 1], [1]], [[2], [2]]]}
    job = make_job(tmp_path / "solved.nc", params, surfaces=synthesised.output)
    solve_adhesive.main(job)
    found = datasets.read(tmp_path / "solved.nc").squeeze()
    missing = found.external_pressure.isnull().all("range_over_h_rms")
    assert missing.transpose("seed", ...).values.tolist() == [[False, False], [False, True]]
    heights = datasets.read(tmp_path / "surfaces.nc").height.values
    for seed, fineness, of_range, step in [(1, 8, 0, 1), (1, 8, 1, 2), (1, 4, 1, 4), (2, 4, 0, 2)]:
        one = asked | {"range_over_h_rms": asked["range_over_h_rms"][of_range : of_range + 1]}
        grid = np.ascontiguousarray(heights[seed - 1][::step, ::step])
        direct = solve_adhesive.states([grid], LENGTH, one, np.ones((1, 1, 1), bool))[0]
        at = found.external_pressure.sel(seed=seed, resolution=fineness)[of_range]
        assert float(at) == pytest.approx(float(direct.external_pressure.squeeze()), rel=1e-5)


def test_what_the_grid_does_not_resolve_is_left_out(heights):
    states = solved(heights, adhesion_length_over_range=[1e-3, 1.0])
    pressure = states.external_pressure.squeeze()
    assert np.isfinite(pressure[0])
    assert np.isnan(pressure[1])
    law = scaled_law(ASKED, "maugis", 1.0, 0.3)
    pixel = LENGTH / 64
    assert edge_zone.resolution(pixel, law.range, law.adhesion_length) > edge_zone.COARSEST


@pytest.mark.slow
def test_equal_area_is_found_on_the_load_curve(heights):
    """Against a search for the pressure that gives the same pixels without adhesion."""
    curve = load_curve(heights, np.linspace(0.08, 0.5, 43))
    one = solved(heights, curve, adhesion_length_over_range=[0.05]).squeeze()
    area = float(one.repulsive_area)
    assert area > 1.03 * float(one.area_alone)

    def excess(pressure):
        return repulsive.solve(heights, LENGTH, pressure, tol=1e-9).area_fraction - area

    held = optimize.bisect(excess, 0.1, 0.5, xtol=1e-4)
    expected = (1 - float(one.external_pressure) / held) / 2
    assert float(one.inverse_kappa_ad_equal_area) == pytest.approx(expected, rel=0.01)
    assert float(one.inverse_kappa_ad) != pytest.approx(expected, rel=0.01)


def test_a_change_of_no_pixel_is_not_a_certain_zero(heights):
    """Adhesion too weak to turn a pixel: what may have gone unseen covers what is in proportion."""
    made = {"grid_points": len(heights), "refine": 1, "coarser": [1]}
    strong, weak = (
        solved(heights, law="exponential", adhesion_length_over_range=[length])
        for length in (1e-2, 1e-6)
    )
    alone = weak.area_alone.item()
    assert strong.repulsive_area.item() > alone == weak.repulsive_area.item()
    linear = (weak.area_alone.squeeze() < 1).expand_dims("pressure")
    more = average_adhesive.add_pixels(weak, made)
    fuller = average_adhesive.add_slopes(more, load_curve(heights), linear)
    unseen = abs((fuller.inverse_kappa_ad - weak.inverse_kappa_ad).item())
    in_proportion = 1e-4 * strong.inverse_kappa_ad.item()
    assert weak.inverse_kappa_ad.item() < in_proportion < unseen
    # pixels take their share of the area off the load that goes with it: 2.3 of them, for exp(-2.3)
    # is a tenth
    assert unseen == pytest.approx(np.log(10) / heights.size / alone / 2, rel=0.01)


@pytest.mark.parametrize("turned", [0, 1, 3, 40])
def test_pixels_unseen_are_the_limit_of_a_poisson_count(turned):
    made, area = {"grid_points": 10, "refine": 4}, (("seed", "resolution"), np.full((8, 1), 0.5))
    made["coarser"] = [2]  # half of the grid
    states = xr.Dataset(dict.fromkeys(average_adhesive.STATES, area) | {"area_alone": area})
    states["repulsive_area"] = states.repulsive_area + turned / (8 * 400)
    more = average_adhesive.add_pixels(states, made).repulsive_area - states.repulsive_area
    limit = turned + more.sum().item() * 400
    assert stats.poisson.cdf(turned, limit) == pytest.approx(0.1)


def test_fits_go_through_the_origin_and_over_the_linear_loads_only():
    pressure = xr.DataArray([1.0, 2.0, 4.0], dims="pressure")
    area, linear = 0.5 * pressure, xr.DataArray([True, True, False], dims="pressure")
    external = pressure - xr.DataArray([0.2, 0.1, 9.0], dims="pressure")
    expected = (0.5 * 0.8 + 1.0 * 1.9) / (0.5**2 + 1.0**2)
    assert float(fit_slope(external, area, linear)) == pytest.approx(expected)
    gap = external.where(external != external[0])
    assert np.isnan(fit_slope(gap, area, linear))  # one load is not solved
    assert np.isnan(fit_slope(external, area, linear & (pressure < 2)))  # a single load
    assert float(linearity_error(external / area, linear)) == pytest.approx((1.9 - 1.6) / 2)


def test_dmt_attraction_of_areas_is_that_over_the_gaps(heights):
    """From the attractive areas of an ensemble as from the gaps themselves, for either law."""
    contact = repulsive.solve(heights, LENGTH, 0.1, tol=1e-9)
    gaps = np.geomspace(1e-4, 10, 81)
    coords = {"pressure": [0.1], "range": gaps}
    areas = xr.DataArray([dmt.attractive_area(contact.gap, gaps)], coords, list(coords))
    for law in ("maugis", "exponential"):
        asked = ASKED | {"law": law, "range_over_h_rms": [0.3, 3.0]}
        asked["adhesion_length_over_range"] = [1e-3, 2e-3]
        got = integrate_law(asked, areas).squeeze()
        for length, reach in itertools.product(*(got[name].values for name in got.dims[::-1])):
            one = scaled_law(asked, law, length, reach)
            expected = dmt.adhesive_pressure(contact.gap, one)
            at = got.sel(adhesion_length_over_range=length, range_over_h_rms=reach)
            # 16 areas a decade, which count the points one by one
            assert float(at) == pytest.approx(expected, rel=0.01)


def test_maps_on_a_finer_grid_agree_with_the_areas_of_direct_solutions(tmp_path):
    """Zones add up to the areas, which grow with adhesion, and are those of a direct solution."""
    entry = model_surface(magnification=8)
    params = {"seeds": [3], "surface": entry, "pixels_per_wavelength": 4}
    synthesised = make_job(tmp_path / "seeds1-1.nc", params)
    synthesise_surface.main(synthesised)
    shown = {"pressures": [0.2, 0.05], "range_over_h_rms": 0.1}
    shown |= {"adhesion_length_over_range": [0.1, 0.3]}
    adhesion = {"law": "exponential", "q0_h_rms": 0.1, "maps": shown}
    job = make_job(
        tmp_path / "maps.nc", {"adhesion": adhesion, "points": 96}, surfaces=synthesised.output
    )
    adhesive_maps.main(job)
    maps = datasets.read(job.output[0])
    assert maps.sizes["x"] == 96  # more than the 32 of the surface
    strongest = maps.isel(adhesion_length_over_range=-1)
    for zones, name in (
        ([3], "net_repulsive_area"),
        ([2, 3], "repulsive_area"),
        ([1], "attractive_area"),
    ):
        np.testing.assert_allclose(maps.zone.isin(zones).mean(["x", "y"]), strongest[name])
    weaker = maps.repulsive_area.isel(adhesion_length_over_range=0)
    assert (maps.area_alone < weaker).all()
    assert (weaker < strongest.repulsive_area).all()
    # The zone of attraction is range^2/l_a = 0.1 * 0.1/0.3 over q0, a pixel 2 pi/96 over q0.
    np.testing.assert_allclose(strongest.pixels_in_zone, 0.1 * 0.1 / 0.3 * 96 / LENGTH)
    heights = datasets.read(synthesised.output[0]).height.values[0]
    law = scaled_law(adhesion, "exponential", 0.3, 0.1)
    fine = surface.resample(heights, 96)
    direct = adhesive.solve(fine, LENGTH, law, pressure=0.05, tol=1e-8)
    area = strongest.repulsive_area.sel(pressure=0.05)
    np.testing.assert_allclose(area, direct.repulsive_area_fraction, rtol=0.02)
