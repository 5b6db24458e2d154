import numpy as np
import pytest

import average_adhesive
import solve_adhesive
from _adhesion import scaled_law
from stickiness import adhesive, cohesive_zone, repulsive, spectrum, surface

LENGTH = 2 * np.pi
ASKED = {
    "q0_h_rms": 0.1,
    "range_over_h_rms": [0.3],
    "adhesion_length_over_range": [1e-3],
    "bem": {"law": "maugis", "pressures": [0.1]},
}


@pytest.fixture(scope="module")
def heights():
    s = spectrum.SelfAffine(hurst=0.8, q0=1.0, q1=8.0, h_rms=1.0)
    return surface.synthesise(s, 64, LENGTH, seed=3)


def solved(heights, **changes):
    asked = ASKED | changes
    chosen = list(solve_adhesive.combinations(asked, LENGTH / len(heights)))
    states = solve_adhesive.states(heights, LENGTH, asked, chosen, 1e-9)
    return states.assign(rms_slope=2.0)


def test_attraction_beyond_all_gaps_is_a_load(heights):
    """Felt everywhere at once, it takes its strength off the pressure and leaves the area."""
    states = solved(heights, range_over_h_rms=[100.0])
    one = average_adhesive.with_slopes(states).squeeze()
    strength = 1e-3 / 0.1
    np.testing.assert_allclose(one.external_pressure, 0.1 - strength, rtol=1e-6)
    assert float(one.repulsive_area) == float(one.area_alone)
    # DMT sums it over the open area only
    np.testing.assert_allclose(one.dmt_ratio, 1 / (1 - one.area_alone), rtol=1e-6)


def test_weak_attraction_relieves_by_the_gaps_that_it_closes(heights):
    """Virtual work: at a given mean gap it takes the slope of its potential off the pressure."""
    one = solved(heights).squeeze()
    law = scaled_law(ASKED, "maugis", 1e-3, 0.3)

    def potential(pressure):
        contact = repulsive.solve(heights, LENGTH, pressure, tol=1e-10)
        return contact.mean_gap, float(np.mean(law.potential(contact.gap)))

    (gap_low, low), (gap_high, high) = potential(0.0999), potential(0.1001)
    relief = (low - high) / (gap_low - gap_high)
    # first order in an attraction that is some thousandths of the pressure
    assert 0.1 - float(one.external_pressure) == pytest.approx(relief, rel=0.02)


def test_what_the_grid_does_not_resolve_is_left_out(heights):
    states = solved(heights, adhesion_length_over_range=[1e-3, 1.0])
    pressure = states.external_pressure.squeeze()
    assert np.isfinite(pressure[0])
    assert np.isnan(pressure[1])
    law = scaled_law(ASKED, "maugis", 1.0, 0.3)
    pixel = LENGTH / 64
    assert cohesive_zone.resolution(pixel, law.range, law.adhesion_length) > cohesive_zone.COARSEST


def test_grid_hardly_matters_to_the_exponential_law(heights):
    """At half the resolution the relief by adhesion changes by less than a twentieth."""
    asked = {"bem": {"law": "exponential", "pressures": [0.1]}}
    fine, coarse = (
        average_adhesive.with_slopes(solved(part, adhesion_length_over_range=[0.03], **asked))
        for part in (surface.resample(heights, 256), surface.resample(heights, 128))
    )
    one, other = (float(part.inverse_kappa_ad.squeeze()) for part in (fine, coarse))
    assert other == pytest.approx(one, rel=0.05)


def test_units_of_the_laws():
    law = scaled_law({"q0_h_rms": 0.1}, "exponential", 0.05, 0.2)
    assert isinstance(law, adhesive.Exponential)
    assert law.maugis_stress == pytest.approx(0.5)  # (l_a/range)/(q0 h_rms)
    assert law.range == 0.2


def test_width_of_the_zone_follows_the_edge_law():
    # u = C x^(3/2) with one pixel from the edge: eight times the gap at four times the distance
    assert cohesive_zone.zone_width(0.1, 0.01, 0.08) == pytest.approx(0.4)
