"""Adhesive contact: equilibrium, limits, branches, invariances, extremes."""

from dataclasses import replace

import numpy as np
import pytest
from helpers.rough import on_any_grid
from references.contact import displacement, elastic_pressure
from scipy import optimize

from stickiness import adhesive, dmt, repulsive
from stickiness.adhesive import Exponential, LennardJones, Maugis, VanDerWaals, equilibrium
from stickiness.adhesive.problem import Problem
from stickiness.measured.periodic import periodise

# Some of the laws under test are too short of range for these grids, on purpose.
pytestmark = [pytest.mark.processors, pytest.mark.filterwarnings("ignore:a pixel of")]
LAWS = (Exponential, Maugis, LennardJones, VanDerWaals)
SIDES = (1.0, 1.0)
SLOPE = 0.1  # q0 h_rms of the rough surfaces
HEIGHT = SLOPE / (2 * np.pi)  # their h_rms, on a side of 1
LOAD = 0.065 * SLOPE  # p/(E* q0 h_rms) = 0.065


def rough(n, magnification=8, modes=32):
    """Heights with q0 h_rms = 0.1 on a side of 1; the same on every grid."""
    return HEIGHT * on_any_grid(n, magnification=magnification, modes=modes)


def law_of(kind, range_over_height, length_over_range):
    eps = range_over_height * HEIGHT
    return kind(adhesion_length=length_over_range * eps, range=eps)


def assert_equilibrium(a, heights, tol=1e-8, sides=SIDES):
    """Check fields, forces, areas and energies of a state from scratch."""
    law = a.law
    unit = max(np.sqrt(np.mean(elastic_pressure(heights, sides) ** 2)), law.strength)
    elastic = elastic_pressure(a.gap + heights, sides)
    reaction = elastic + a.mean_pressure + law.traction(a.gap)
    if law.hard_wall:
        assert a.gap.min() >= 0
        touching = a.gap == 0
        violation = max(np.abs(reaction[~touching]).max(initial=0), -reaction.min())
    else:
        touching = a.gap < 0
        violation = np.abs(reaction).max()
    # 1.01 and 1e-12: measured with other transforms, with other rounding
    assert violation <= (1.01 * a.residual + 1e-12) * unit
    assert a.residual <= tol
    # what the interface transmits is what deforms the half-space, to the same residual
    np.testing.assert_allclose(a.pressure, elastic + a.mean_pressure, atol=1.1 * tol * unit)
    balance = a.repulsive_pressure - a.adhesive_pressure - a.mean_pressure
    assert abs(balance) <= 1.1 * tol * unit
    assert a.repulsive_area_fraction == np.mean(touching)
    # the sign of the net pressure, taken from the elasticity where that is clear of the residual
    pushing = touching & (elastic + a.mean_pressure > 0)
    unclear = touching & (np.abs(elastic + a.mean_pressure) < 2 * tol * unit)
    assert a.net_repulsive_area_fraction == pytest.approx(pushing.mean(), abs=unclear.mean())
    assert a.adhesive_area_fraction == np.mean((a.gap <= law.range) & ~touching)
    assert a.mean_gap == pytest.approx(a.gap.mean(), rel=1e-12)
    assert a.elastic_energy == pytest.approx(np.mean((a.gap + heights) * elastic) / 2, rel=1e-9)
    assert a.interaction_energy == pytest.approx(np.mean(law.potential(a.gap)), rel=1e-12)


@pytest.mark.parametrize("kind", LAWS)
@pytest.mark.parametrize(
    "control",
    [{"pressure": LOAD}, {"pressure": 0.0, "start": "separation"}, {"mean_gap": 0.5 * HEIGHT}],
    ids=str,
)
def test_a_mirrored_surface_is_solved_on_a_quarter_of_its_period(kind, control):
    heights = rough(128)[:64, :48]
    sides = (0.5, 0.375)
    law = law_of(kind, range_over_height=0.3, length_over_range=0.1)
    state = adhesive.solve(heights, sides, law, mirrored=True, **control)
    fields = {name: periodise(getattr(state, name), "mirror") for name in ("pressure", "gap")}
    period = periodise(heights, "mirror")
    assert_equilibrium(replace(state, **fields), period, sides=(1.0, 0.75))
    assert 0.01 < state.repulsive_area_fraction < 1


@pytest.mark.slow
@pytest.mark.parametrize("kind", LAWS)
@pytest.mark.parametrize(("eps", "la"), [(1.0, 0.05), (0.1, 0.5), (10.0, 0.01)])
@pytest.mark.parametrize("start", ["approach", "separation"])
def test_states_are_in_equilibrium(kind, eps, la, start):
    heights = rough(64)
    for load in (LOAD, 0.0):
        a = adhesive.solve(heights, 1.0, law_of(kind, eps, la), pressure=load, start=start)
        assert a.mean_pressure == load
        assert (a.branch, a.control) == (start, "pressure")
        assert_equilibrium(a, heights)


@pytest.mark.parametrize("kind", LAWS)
def test_weak_attraction_is_the_repulsive_contact(kind):
    """DMT sum: gaps of the repulsive solution, attraction its integral over them."""
    heights = rough(64)
    contact = repulsive.solve(heights, 1.0, LOAD, tol=1e-10)
    law = law_of(kind, 0.1, 1e-7)
    a = adhesive.solve(heights, 1.0, law, pressure=LOAD, tol=1e-11)
    if kind is LennardJones:
        # its repulsion is soft at strengths far below the load: the contact gives way by up to
        # the range, and no more
        assert np.abs(a.gap - contact.gap).max() < law.range
        return
    # gaps change in proportion to the attraction, which is 1e-7 E* against 7e-3
    np.testing.assert_allclose(a.gap, contact.gap, atol=1e-4 * HEIGHT)
    assert a.repulsive_area_fraction == pytest.approx(contact.area_fraction, abs=1e-3)
    outside = contact.gap > 0
    attraction = np.mean(law.traction(contact.gap) * outside)
    # repulsion less load, both near 7e-3, of which the tolerance leaves 1e-12: 1e-4 of 1e-8
    assert a.adhesive_pressure == pytest.approx(attraction, rel=2e-3)
    if kind is Maugis:
        area = dmt.attractive_area(contact.gap, law.range)
        assert a.adhesive_area_fraction == pytest.approx(area, abs=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("kind", "eps", "la"),
    [
        *((kind, *at) for kind in (Exponential, Maugis) for at in ((1.0, 0.05), (0.1, 0.1))),
        # softens six times as fast at the wall: single points are stable up to a sixth of the work
        *((VanDerWaals, *at) for at in ((1.0, 0.05), (0.1, 0.016))),
    ],
)
def test_branch_of_approach_is_the_first_of_monotone_rounds(kind, eps, la):
    """Against repulsive contacts with the attraction of the round before as a given load.

    With a given traction s the problem is the repulsive one for the heights h + w, where w is the
    displacement that s causes, at the pressure p + <s>. More attraction closes gaps everywhere,
    so the rounds close gaps monotonously, to the widest of all states of equilibrium.
    """
    heights = rough(64)
    law = law_of(kind, eps, la)
    gap = repulsive.solve(heights, 1.0, LOAD, tol=1e-10).gap
    for _ in range(2000):
        s = law.traction(gap)
        contact = repulsive.solve(heights + displacement(s, SIDES), 1.0, LOAD + s.mean(), tol=1e-10)
        closed = gap - contact.gap
        gap = contact.gap
        # exactly so on a continuum; the grid's stiffness couples some far points the other way
        assert closed.min() > -1e-4 * HEIGHT
        if closed.max() < 1e-8 * HEIGHT:
            break
    else:
        pytest.fail("the rounds did not end")
    a = adhesive.solve(heights, 1.0, law, pressure=LOAD)
    # the rounds converge linearly, at a rate that leaves some 100 times the last change
    np.testing.assert_allclose(a.gap, gap, atol=1e-5 * HEIGHT)
    b = adhesive.solve(heights, 1.0, law, pressure=LOAD, start="separation")
    assert np.all(b.gap <= a.gap + 1e-5 * HEIGHT)
    assert b.repulsive_area_fraction >= a.repulsive_area_fraction


@pytest.mark.parametrize("kind", LAWS)
def test_state_is_a_minimum_of_the_energy(kind):
    """Against a general optimiser (L-BFGS-B) that starts nearby, on a small grid."""
    heights = rough(16, magnification=4)
    law = law_of(kind, 0.5, 0.1)
    a = adhesive.solve(heights, 1.0, law, pressure=LOAD, tol=1e-10)

    def energy(gap):
        gap = gap.reshape(16, 16) * HEIGHT
        elastic = elastic_pressure(gap + heights, SIDES)
        value = np.mean((gap + heights) * elastic / 2 + law.potential(gap) + LOAD * gap)
        return value / HEIGHT**2, ((elastic + law.traction(gap) + LOAD) / 256 / HEIGHT).ravel()

    # Maugis: stay off the kinks, so that the descent is of a smooth function
    noise = 1e-4 if kind is Maugis else 0.02
    start = a.gap.ravel() / HEIGHT + noise * np.random.default_rng(0).random(256)
    lowest = -0.4 * law.range / HEIGHT if kind is LennardJones else 0.0
    found = optimize.minimize(
        energy,
        np.maximum(start, lowest),
        jac=True,
        method="L-BFGS-B",
        bounds=[(lowest, None)] * 256,
        options={"maxiter": 20000, "maxfun": 40000, "ftol": 0, "gtol": 1e-12},
    )
    # the optimiser stops where rounding of the energy hides its fall: 1e-6 of h_rms in the gaps
    np.testing.assert_allclose(found.x.reshape(16, 16) * HEIGHT, a.gap, atol=1e-5 * HEIGHT)
    assert a.enthalpy / HEIGHT**2 == pytest.approx(found.fun, rel=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("kind", LAWS)
def test_invariances(kind):
    """Neither units nor the origin matter; steeper heights scale with their tractions."""
    heights = rough(32)
    law = law_of(kind, 0.5, 0.1)
    a = adhesive.solve(heights, 1.0, law, pressure=LOAD)
    for c in (1.0, 4.0, 2.0**-40):  # powers of two: not even the rounding changes
        law = kind(a.law.adhesion_length * c, a.law.range * c)
        b = adhesive.solve(heights * c, c, law, pressure=LOAD)
        np.testing.assert_array_equal(b.gap, a.gap * c)
        np.testing.assert_array_equal(b.pressure, a.pressure)
        assert b.energy == a.energy * c
        assert (b.residual, b.fft_pairs) == (a.residual, a.fft_pairs)
    for c in (1e-3, 30.0):
        law = kind(a.law.adhesion_length * c**2, a.law.range * c)
        b = adhesive.solve(heights * c, 1.0, law, pressure=LOAD * c)
        # the same descent but for rounding, to a tolerance of 1e-8
        np.testing.assert_allclose(b.gap, a.gap * c, atol=1e-6 * HEIGHT * c)
        assert b.repulsive_area_fraction == a.repulsive_area_fraction
        assert b.energy == pytest.approx(a.energy * c**2, rel=1e-7)
    moved = np.roll(heights.T, (3, 11), (0, 1)) + 5.0
    moved = adhesive.solve(moved, 1.0, a.law, pressure=LOAD)
    # 5 is 300 h_rms: heights and gaps lose as many digits
    np.testing.assert_allclose(np.roll(moved.gap, (-3, -11), (0, 1)).T, a.gap, atol=1e-6 * HEIGHT)


@pytest.mark.parametrize("shape", [(31, 33), (1, 32), (24, 40)])
@pytest.mark.parametrize("kind", LAWS)
def test_any_grid(shape, kind):
    heights = np.random.default_rng(2).standard_normal(shape) * 1e-3
    sides = (1.0, shape[1] / shape[0])
    law = kind(1e-5, 1e-3)
    for control in ({"pressure": 0.002}, {"mean_gap": 1.5e-3}):
        a = adhesive.solve(heights, 1.0, law, **control)
        assert_equilibrium(a, heights, sides=sides)
        assert control.get("mean_gap", a.mean_gap) == pytest.approx(a.mean_gap, rel=1e-9)
        assert a.length == pytest.approx(sides)


@pytest.mark.parametrize("kind", LAWS)
def test_flat_on_flat_holds_its_strength(kind):
    """With and without the branch of approach; beyond the strength there is no equilibrium."""
    law = kind(adhesion_length=2e-4, range=1e-3)
    heights = np.full((8, 8), 0.3)
    for share in (0.0, 0.5, 0.9999):
        a = adhesive.solve(heights, 1.0, law, pressure=-share * law.strength)
        assert a.elastic_energy == pytest.approx(0, abs=1e-20)
        assert a.adhesive_pressure == pytest.approx(share * law.strength, abs=1e-8 * law.strength)
        np.testing.assert_allclose(a.pressure, a.mean_pressure, atol=1e-8 * law.strength)
        if law.hard_wall:
            assert a.gap.max() == 0
            # contact holds the whole work of adhesion
            assert a.interaction_energy == pytest.approx(-law.adhesion_length, rel=1e-12)
    with pytest.raises(adhesive.PullOffError, match="strength"):
        adhesive.solve(heights, 1.0, law, pressure=-1.0001 * law.strength, start="separation")
    pressed = adhesive.solve(heights, 1.0, law, pressure=0.01)
    np.testing.assert_allclose(pressed.pressure, 0.01, rtol=1e-6)


def test_full_contact_opens_at_the_strength_less_the_flattening_pressure():
    n = 64
    x = (np.arange(n) + 0.5) / n
    heights = np.repeat(0.002 * np.cos(2 * np.pi * x)[:, None], 4, axis=1)
    law = Maugis(adhesion_length=2e-3, range=0.02)
    full = np.pi * 0.002 * np.cos(np.pi / n)  # of the crests and troughs the grid has
    for share in (0.999, 1.001):
        load = share * (full - law.strength)
        a = adhesive.solve(heights, (1.0, 4 / n), law, pressure=load, start="separation")
        assert (a.repulsive_area_fraction == 1.0) == (share < 1)


@pytest.mark.parametrize("kind", [Exponential, LennardJones, VanDerWaals])
def test_flats_at_a_mean_gap_break_up_where_they_must(kind):
    """A uniform gap is stable while its softening stays below the stiffness of the longest wave."""
    heights = np.zeros((16, 16))
    gap = 1.5e-3
    for steep, uniform in ((0.9, True), (1.1, False)):
        law = kind(adhesion_length=1.0, range=1e-3)
        softening = -float(law.derivative(gap))
        law = kind(adhesion_length=steep * np.pi / softening, range=1e-3)
        a = adhesive.solve(heights, 1.0, law, mean_gap=gap)
        assert a.mean_gap == pytest.approx(gap, rel=1e-9)
        assert (np.ptp(a.gap) < 1e-9) == uniform
        if not uniform:
            assert a.energy < float(law.potential(gap))


def test_far_apart_lennard_jones_is_van_der_waals():
    """Of equal A_H: the repulsion falls with the ninth power of the separation."""
    heights = rough(32)
    eps = 0.1 * HEIGHT
    mean_gap = heights.max() + 5 * eps
    one = adhesive.solve(heights, 1.0, VanDerWaals(0.02 * eps, eps), mean_gap=mean_gap)
    other = adhesive.solve(heights, 1.0, LennardJones(0.015 * eps, eps), mean_gap=mean_gap)
    # the repulsion at the closest point, where the separation is 6 ranges: 6^-6 of the traction
    assert one.mean_pressure == pytest.approx(other.mean_pressure, rel=6.0**-6)
    np.testing.assert_allclose(one.gap, other.gap, atol=1e-6 * HEIGHT)


def test_a_hard_sphere_pulls_off_at_the_dmt_force():
    """2 pi R l_a whatever the law; the cell cuts off what acts at gaps above 60 ranges."""
    radius, eps = 1000.0, 1.0
    side = 2 * np.sqrt(2 * radius * 60 * eps)
    x = (np.arange(128) - 64) / 128 * side
    heights = -(x[:, None] ** 2 + x**2) / (2 * radius)
    law = VanDerWaals(np.sqrt(0.03**3 * eps**3 / radius), eps)  # Tabor's parameter 0.03
    most = 2 * np.pi * radius * law.adhesion_length / side**2
    held = adhesive.solve(heights, side, law, pressure=-0.97 * most)
    assert 0 < held.repulsive_area_fraction < 0.01
    with pytest.raises(adhesive.PullOffError):
        adhesive.solve(heights, side, law, pressure=-1.03 * most, start=held)


def test_weak_attraction_adds_the_slope_of_the_mean_potential():
    """To first order in the attraction at a given mean gap, by Hellmann and Feynman."""
    heights, law = rough(64), law_of(VanDerWaals, 0.3, 1e-5)
    states = [repulsive.solve(heights, 1.0, load * LOAD, tol=1e-11) for load in (0.98, 1.02)]
    gaps = [state.gap.mean() for state in states]
    potentials = [law.potential(state.gap).mean() for state in states]
    between = repulsive.solve(heights, 1.0, LOAD, tol=1e-11)
    a = adhesive.solve(heights, 1.0, law, mean_gap=between.gap.mean(), tol=1e-11)
    expected = np.diff(potentials)[0] / np.diff(gaps)[0]
    assert LOAD - a.mean_pressure == pytest.approx(expected, rel=0.01)


def controls(law, shape):
    """Loads, mean gaps and starts that are hard on a solver."""
    for load in (LOAD, 0.0, -0.5 * law.strength, -1.1 * law.strength):
        for start in ("approach", "separation"):
            yield {"pressure": load, "start": start}
    noise = np.abs(np.random.default_rng(0).standard_normal(shape))
    yield {"pressure": LOAD, "start": 2 * law.range * noise}
    # flats at half a range are unstable, and so is much of a rough surface there
    yield {"pressure": 0.0, "start": np.full(shape, 0.5 * law.range)}
    for mean_gap in (0.0, 1e-3 * HEIGHT, HEIGHT, 10 * HEIGHT):
        yield {"mean_gap": mean_gap}


@pytest.mark.slow
@pytest.mark.parametrize("kind", LAWS)
@pytest.mark.parametrize("la", [1e-6, 0.1, 10.0])
@pytest.mark.parametrize("eps", [1e-3, 1.0, 1e3])
def test_extremes_end_in_a_state_or_a_clear_error(kind, eps, la):
    """Range over height and adhesion length over range at their ends, under every control."""
    heights = rough(24)
    law = law_of(kind, eps, la / kind.strength_ratio**2)
    if (eps, la) == (1e-3, 10.0):
        with pytest.raises(ValueError, match="does not resolve the edges of contact"):
            adhesive.solve(heights, 1.0, law, pressure=LOAD)
        return
    for control in controls(law, heights.shape):
        load = control.get("pressure")
        try:
            a = adhesive.solve(heights, 1.0, law, **control)
        except adhesive.PullOffError as error:
            a = error.contact
            # parted: no point is left that could hold the load
            assert float(law.traction(a.gap.min())) < -load
        else:
            assert load is None or -load < law.strength * (1 + 1e-7)
            assert a.residual <= 1e-8
        assert a.iterations < 3000
        assert np.all(np.isfinite([a.gap, a.pressure]))
        assert np.isfinite([a.mean_pressure, a.energy, a.enthalpy]).all()


@pytest.mark.parametrize("kind", [Maugis, Exponential])
@pytest.mark.parametrize("length_over_range", [1e-6, 1e-8])
@pytest.mark.parametrize("seed", range(4))
def test_last_bits_of_the_heights_do_not_part_surfaces_without_a_load(
    kind, length_over_range, seed
):
    """Without contact nothing but a weak attraction holds them, and no load pushes them back."""
    law = law_of(kind, 1e-3, length_over_range)
    rounding = 1e-15 * np.random.default_rng(seed).standard_normal((24, 24))
    state = adhesive.solve(rough(24) * (1 + rounding), 1.0, law, pressure=0.0, start="separation")
    # The highest point touches, or hangs within the range; nothing else does.
    touching = rough(24).max() - rough(24).mean()
    assert state.gap.min() <= law.range
    assert state.mean_gap == pytest.approx(touching, rel=1e-3)
    assert state.iterations < 300


def test_a_range_that_the_grid_loses_is_refused():
    """Beyond the shares that `edge_zone.is_lost` quotes of what adhesion takes from the load."""
    length, finest, mean_gap = 0.02 * HEIGHT, 256, 0.5 * HEIGHT
    law = Exponential(length, np.sqrt(2 * length / finest))  # half a pixel in range^2/length
    alone = adhesive.solve(rough(64), 1.0, Exponential(1e-9, 1.0), mean_gap=mean_gap)
    best = adhesive.solve(rough(finest), 1.0, law, mean_gap=mean_gap)
    for ratio, kept in ((1, 1.0), (4, 0.85), (8, 0.65), (16, 0.5), (32, 0.3)):
        short = Exponential(length, np.sqrt(length / 64 / ratio))
        found = adhesive.solve(rough(64), 1.0, short, mean_gap=mean_gap)
        lost = (found.mean_pressure - best.mean_pressure) / alone.mean_pressure
        all_of_it = 1 - best.mean_pressure / alone.mean_pressure
        assert 1 - lost / all_of_it == pytest.approx(kept, abs=0.06)
    short = Exponential(length, np.sqrt(length / 64 / 52))
    with pytest.raises(ValueError, match="does not resolve the edges of contact"):
        adhesive.solve(rough(64), 1.0, short, mean_gap=mean_gap)


@pytest.mark.parametrize("kind", LAWS)
@pytest.mark.parametrize("eps", [1e-3, 1e-4, 1e-6, 1e-9])
def test_weak_adhesion_is_solved_at_any_range(kind, eps):
    """A strength below the pressures of contact cannot hold points: nothing changes.

    A few points may go on touching without a force.
    """
    heights = rough(32)
    law = law_of(kind, eps, 0.1 / kind.strength_ratio)
    alone = repulsive.solve(heights, 1.0, LOAD)
    found = adhesive.solve(heights, 1.0, law, pressure=LOAD)
    assert found.net_repulsive_area_fraction == alone.area_fraction
    assert found.mean_gap == pytest.approx(alone.mean_gap, rel=1e-3)


def test_pressures_out_of_balance_are_refused():
    """A strength far above the pressures of contact, with a tolerance in its unit."""
    heights = rough(32)
    law = law_of(Exponential, 10.0, 10.0)
    given = {"mean_gap": 30 * law.range, "start": heights.max() - heights}
    with pytest.raises(adhesive.ConvergenceError, match=r"tol = 5\.00e-01"):
        adhesive.solve(heights, 1.0, law, tol=0.5, **given)
    assert adhesive.solve(heights, 1.0, law, **given).residual <= 1e-8


@pytest.mark.parametrize("kind", LAWS)
def test_convergence_error_carries_the_last_iterate(kind):
    heights, law = rough(32), law_of(kind, 0.5, 0.1)
    with pytest.raises(adhesive.ConvergenceError, match="raise max_iterations") as info:
        adhesive.solve(heights, 1.0, law, pressure=LOAD, max_iterations=3)
    last = info.value.contact
    assert info.value.residual == last.residual > 1e-8
    # it is a start like any other
    assert adhesive.solve(heights, 1.0, law, pressure=LOAD, start=last).residual <= 1e-8


@pytest.mark.slow
def test_branches_on_a_rough_surface_differ_and_the_deeper_is_told():
    """Loaded from afar and unloaded from full contact: two stable states of unlike enthalpy.

    Up to some three times the load the state of less contact is the deeper one, beyond that of
    full contact is, before loading gets there.
    """
    heights = rough(64)
    law = law_of(Exponential, 0.1, 0.5)
    for load, approach_deeper in ((LOAD, True), (3 * LOAD, True), (5 * LOAD, False)):
        enthalpies, states = [], []
        for start in ("approach", "separation"):
            a = adhesive.solve(heights, 1.0, law, pressure=load, start=start)
            assert_equilibrium(a, heights)
            u = a.gap + heights
            energy = u * elastic_pressure(u, SIDES) / 2 + law.potential(a.gap)
            enthalpies.append(np.mean(energy) + load * a.gap.mean())
            states.append(a)
            # a minimum: a start nearby comes back
            moved = a.gap + 1e-3 * law.range * (a.gap > 0)
            back = adhesive.solve(heights, 1.0, law, pressure=load, start=moved)
            np.testing.assert_allclose(back.gap, a.gap, atol=1e-5 * HEIGHT)
        a, b = states
        assert b.repulsive_area_fraction > a.repulsive_area_fraction + 0.1
        assert (enthalpies[0] < enthalpies[1]) == (a.enthalpy < b.enthalpy) == approach_deeper


def test_heights_on_a_strip_are_compared_with_its_length():
    """No warning of units, although the strip is 128 times as long as it is wide."""
    heights = 1.5 * np.cos(2 * np.pi * np.arange(128) / 128)[:, None]
    law = Exponential(1e-3, 0.1)
    state = adhesive.solve(heights, (1.0, 1 / 128), law, mean_gap=3.0, tol=1e-4)
    assert state.repulsive_area_fraction == 0
    assert state.mean_pressure < 0


@pytest.mark.parametrize("closing", [True, False])
def test_an_unstable_state_is_left_by_a_small_part_of_the_range(closing):
    """So that the descent from there stays on its side of any other barrier."""
    law = Exponential(1e-3, 0.1)
    problem = Problem(np.zeros((8, 8)), (1.0, 1.0), law, 1.0, pressure=0.0)
    state = problem.state(np.full((8, 8), 0.5))
    mode = np.random.default_rng(0).random((8, 8))
    change = equilibrium._left(problem, state, mode, closing) - state.gap
    assert 0.02 * law.range < np.abs(change).max() < 0.2 * law.range
    assert np.all(change < 0) if closing else np.all(change > 0)
