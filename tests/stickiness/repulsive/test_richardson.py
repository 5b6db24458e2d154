"""Continuum limit: the rules, and coverage against much finer grids."""

import numpy as np
import pytest

from stickiness import dmt, repulsive, spectrum, surface
from stickiness.repulsive import richardson, subpixel

RANGES = 10.0 ** (np.arange(-56, 9) / 16)


def test_error_is_the_sum_in_quadrature_of_its_parts():
    rule = richardson.RULES["area_fraction"]
    found = richardson.estimate("area_fraction", [0.10, 0.09], part=-0.01, edges=400)
    expected = np.hypot(rule.change * 0.01, 0.01 * np.hypot(rule.part, rule.noise / 20))
    assert found.error == pytest.approx(expected, rel=1e-12)
    assert found.value == 0.09
    # Without edges nothing is uncertain but the change.
    found = richardson.estimate("area_fraction", [1.0, 1.0], part=0.0, edges=0)
    assert (found.value, found.error) == (1.0, 0.0)


def test_attractive_areas_are_extrapolated_below_the_edge_gap_only():
    rule = richardson.RULES["attractive_area"]
    climbs = np.array([0.0, 0.3, 0.6, 5.0])
    found = richardson.estimate("attractive_area", [0.12, 0.10], 0.08, 1000, climbs)
    shares = rule.weight * np.array([1, 0.5, 0, 0])
    np.testing.assert_allclose(found.value, 0.10 - 0.02 * shares, rtol=1e-12)
    # Below it the law is trusted less.
    assert found.error[0] == found.error[1] > found.error[2] == found.error[3]


def test_a_third_grid_steadies_the_error():
    two = richardson.estimate("mean_gap", [1.02, 1.02], 0.0, 100)
    three = richardson.estimate("mean_gap", [1.10, 1.02, 1.02], 0.0, 100)
    assert two.error == 0 < three.error
    assert three.value == two.value
    # If the changes fall with the order of the rule, both say the same.
    step = 2 ** richardson.RULES["mean_gap"].order
    regular = richardson.estimate("mean_gap", [1 + 0.1 * step + 0.1, 1.1, 1.0], 0.0, 100)
    assert regular.error == pytest.approx(richardson.estimate("mean_gap", [1.1, 1.0], 0, 1).error)


def measured(heights, pressure):
    contact = repulsive.solve(heights, 2 * np.pi, pressure, tol=1e-7)
    touching = contact.pressure > 0
    return {
        "area_fraction": contact.area_fraction - subpixel.boundary_strip(touching),
        "counted": contact.area_fraction,
        "mean_gap": contact.mean_gap,
        "attractive_area": subpixel.attractive_area(contact.gap, RANGES, touching),
        "counted_attractive": dmt.attractive_area(contact.gap, RANGES, touching),
        "edges": subpixel.edge_count(touching),
        "edge_gap": subpixel.edge_gap(contact.gap, touching),
    }


@pytest.fixture(scope="module")
def nested():
    """Surfaces none of which the rules were fitted on, on grids of 4, 8, 16 and 64 points."""
    band = spectrum.SelfAffine(hurst=0.7, q0=1.0, q1=16.0, h_rms=1.0)
    rows = []
    for seed in range(100, 104):
        heights = surface.synthesise(band, n=1024, length=2 * np.pi, seed=seed)
        for pressure in (0.03, 0.15):
            rows.append([measured(heights[::s, ::s], pressure) for s in (16, 8, 4, 1)])
    return rows


def estimates(row, grids):
    """Estimates and true values of ten quantities of one contact."""
    fine, true = row[grids[-1]], row[-1]
    part = fine["area_fraction"] - fine["counted"]
    for name, correction in (("area_fraction", part), ("mean_gap", part * fine["edge_gap"])):
        values = [row[g][name] for g in grids]
        yield richardson.estimate(name, values, correction, fine["edges"]), true[name]
    chosen = [np.argmin(abs(RANGES - eps)) for eps in (0.01, 0.03, 0.1, 0.3)]
    part = fine["attractive_area"] - fine["counted_attractive"]
    areas = [row[g]["attractive_area"] for g in grids]
    found = richardson.estimate(
        "attractive_area", areas, part, fine["edges"], RANGES / fine["edge_gap"]
    )
    for i in chosen:
        yield richardson.Estimate(found.value[i], found.error[i]), true["attractive_area"][i]
    densities = [np.diff(area) / np.diff(RANGES) for area in (*areas, true["attractive_area"])]
    share = (part / fine["attractive_area"])[1:]
    found = richardson.estimate("gap_density", densities[:-1], densities[-2] * share, fine["edges"])
    for i in chosen:
        yield richardson.Estimate(found.value[i], found.error[i]), densities[-1][i]


@pytest.mark.slow
@pytest.mark.parametrize("grids", [(0, 1), (0, 1, 2)])
def test_error_covers_the_truth_in_nine_of_ten_cases(nested, grids):
    """80 pairs of estimate and truth; 64 points per wavelength are the truth."""
    misses, errors, truths = [], [], []
    for row in nested:
        for found, true in estimates(row, grids):
            misses.append(abs(found.value - true))
            errors.append(found.error)
            truths.append(true)
    misses, errors = np.array(misses), np.array(errors)
    assert np.mean(misses <= errors) >= 0.9
    # ... and is no more than some multiple of it, or it would say nothing.
    assert np.median(errors / truths) < 6 * np.median(misses / truths)


def test_only_attractive_areas_are_extrapolated():
    for quantity in ("area_fraction", "mean_gap", "gap_density"):
        found = richardson.estimate(quantity, [0.10, 0.08], part=0.01, edges=300, climbs=0.1)
        assert found.value == 0.08
