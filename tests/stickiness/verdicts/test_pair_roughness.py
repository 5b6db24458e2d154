"""What a material and a surface bring to their contact: layers, two rough solids, direction."""

from dataclasses import replace

import numpy as np
import pytest
from helpers.analysed import LONGEST, fix_a_v, wall

from stickiness import Material, Surface, judge
from stickiness.criteria.pair import WORDS
from stickiness.remaining import predict
from stickiness.remaining.solid_response import FilmResponse, find_relative_compliance
from stickiness.remaining.trial_states import DEFAULT_SHARE
from stickiness.solids import Film, Layer, Skin
from stickiness.solids.moduli import Table
from stickiness.spectrum import SelfAffine
from stickiness.verdicts.pair_roughness import TOO_DIFFERENT, combine_roughness

pytestmark = pytest.mark.usefixtures("coarse_simulation")

TAPE = Material(youngs_modulus=0.1e6, work_of_adhesion=0.07, range=3e-10)
FILM = Film(3e9 / TAPE.youngs_modulus, 0.4, 25e-6)
THIN_FILM_MODULUS = 0.1e9  # Young's modulus [Pa]


def put_on_layer(thickness, backing="bonded"):
    """The tape as a layer."""
    return TAPE.replace(solid=Layer(thickness, 0.5, backing))


def layer_factor(k, backing):
    """S of an incompressible layer, as physics books have it."""
    if backing == "slip":
        return (np.cosh(2 * k) - 1) / (np.sinh(2 * k) + 2 * k)
    return (np.sinh(2 * k) - 2 * k) / (np.cosh(2 * k) + 2 * k**2 + 1)


@pytest.mark.parametrize("backing", ["bonded", "slip"])
def test_a_layer_takes_the_energy_of_its_response(backing):
    surface = wall()
    rough = combine_roughness(put_on_layer(40e-6, backing), surface)
    data = surface.data
    q = np.geomspace(float(data.q0), float(data.q1), 20001)
    psd = np.exp(np.interp(np.log(q), np.log(data.wave_number), np.log(data.psd[0])))
    factor = layer_factor(np.minimum(q * 40e-6, 300), backing)
    ratio = np.trapezoid(q**3 * psd / factor, np.log(q)) / np.trapezoid(q**3 * psd, np.log(q))
    assert rough.stiffening == pytest.approx([ratio, ratio], rel=1e-5)
    energy = ratio * data.elastic_energy.values
    assert rough.scenarios.ends.elastic_energy == pytest.approx(energy, rel=1e-5)
    compliance = layer_factor(float(data.q0) * 40e-6, backing)
    assert rough.scenarios.ends.relative_compliance == pytest.approx(np.full(2, compliance))


def test_a_thick_layer_is_a_half_space():
    thick = combine_roughness(put_on_layer(1.0), wall())
    deep = combine_roughness(TAPE, wall())
    assert thick.scenarios.ends.elastic_energy == pytest.approx(
        deep.scenarios.ends.elastic_energy, rel=1e-12
    )
    assert np.all(thick.scenarios.ends.relative_compliance == 1)
    assert deep.scenarios.ends.relative_compliance == 1
    assert (deep.stiffening == 1).all()


def test_a_tape_on_a_film_takes_less_energy_than_on_a_rigid_base():
    base = combine_roughness(put_on_layer(40e-6), wall())
    tape = combine_roughness(put_on_layer(40e-6, FILM), wall())
    thin = combine_roughness(put_on_layer(40e-6, replace(FILM, thickness=2e-6)), wall())
    assert (base.stiffening > tape.stiffening).all()
    assert (tape.stiffening > thin.stiffening).all()
    assert np.isnan(tape.scenarios.ends.half_space_energy)  # a half-space bounds nothing
    assert np.isfinite(base.scenarios.ends.half_space_energy).all()


def make_thin_tape(modulus):
    """The tape on a thin film, whose own Young's modulus stays as it is."""
    film = Film(THIN_FILM_MODULUS / modulus, 0.4, 4e-6)
    return TAPE.replace(youngs_modulus=modulus, solid=Layer(40e-6, 0.5, film))


def judge_at_moduli(moduli, draws):
    """Verdicts on the thin tape with these E* [Pa]."""
    tapes = [make_thin_tape(0.75 * float(modulus)) for modulus in moduli]
    surface = wall(h_rms=1.3e-6, draws=draws)
    return judge(tapes, {"wall": surface}, thresholds=False).sel(surface="wall")


@pytest.mark.slow
@pytest.mark.parametrize("draws", [0, 60])
def test_thresholds_and_curves_of_a_tape_keep_its_film(draws):
    tape = judge_at_moduli([0.1e6], draws).isel(material=0)
    at_thresholds = judge_at_moduli(tape.plane_strain_modulus_threshold.values, draws)
    np.testing.assert_allclose(np.diag(at_thresholds.remaining), DEFAULT_SHARE, rtol=1e-6)
    for place in (40, 55, 65):
        factor = float(tape.modulus_factor[place])
        other = judge_at_moduli([0.1e6 * factor], draws).isel(material=0)
        curve = tape.isel(modulus_factor=place)
        # The flow along the layer, which limits know, stays that of the pair.
        np.testing.assert_allclose(curve.remaining_by_modulus, other.remaining, rtol=2e-5)


@pytest.mark.slow
def test_a_rate_dependent_tape_has_its_film_at_every_rate_and_dwell():
    table = Table((1e-3, 1.0, 1e3), (10e3, 0.1e6, 3e6))

    def put_on_film(material):
        """The ratio of moduli is that to Young's modulus of the verdict."""
        film = Film(THIN_FILM_MODULUS / (0.75 * material.plane_strain_modulus), 0.4, 4e-6)
        return material.replace(solid=Layer(40e-6, 0.5, film))

    slow = put_on_film(TAPE.replace(youngs_modulus_table=table))
    rested = put_on_film(TAPE.replace(youngs_modulus_table=table, dwell=10.0))
    surface = wall()
    dataset = judge(
        {"slow": slow, "rested": rested},
        {"wall": surface},
        frequencies=np.geomspace(1e-2, 1e2, 5),
        thresholds=False,
    ).sel(surface="wall")

    def check(modulus, shares):
        film = Film(THIN_FILM_MODULUS / (0.75 * modulus), 0.4, 4e-6)
        solid = Layer(40e-6, 0.5, film)
        smooth, rough = surface.spectra
        expected = [
            predict(rough, 0.07 / modulus, 3e-10, solid=solid).separation_limits[0],
            predict(rough, 0.07 / modulus, 3e-10, solid=solid).separation,
            predict(smooth, 0.07 / modulus, 3e-10, solid=solid).approach_limits[1],
        ]
        np.testing.assert_allclose(shares, expected, rtol=2e-5)

    by_rate = dataset.sel(material="slow")
    for modulus, shares in zip(
        by_rate.modulus.values, by_rate.remaining_by_rate.values, strict=True
    ):
        check(float(modulus), shares)
    after_dwell = dataset.sel(material="rested").remaining.values
    check(rested.plane_strain_modulus, after_dwell / [1, 1, rested.instant_ratio])


def test_the_response_on_a_film_ends_at_the_rigid_base_and_at_the_bent_plate():
    q0 = 2 * np.pi / LONGEST
    spectrum = SelfAffine(hurst=0.8, q0=q0, q1=2 * q0, h_rms=1e-6)
    solid = Layer(40e-6, 0.5, Film(1e3, 0.4, 25e-6))
    response = FilmResponse((spectrum,), solid, q0)
    energy, compliance = response.at_modulus(np.array([1e-6, 1.0, 1e6]))
    energy *= spectrum.elastic_energy(solid)
    compliance *= solid.factor(q0)
    base = Layer(40e-6, 0.5)
    soft = spectrum.elastic_energy(base), base.factor(q0)
    assert (energy[0], compliance[0]) == pytest.approx(soft, rel=1e-5)
    as_it_is = spectrum.elastic_energy(solid), solid.factor(q0)
    assert (energy[1], compliance[1]) == pytest.approx(as_it_is, rel=1e-12)
    # A hard layer bends the plate: it takes D q^4/2 times the variance of every wave.
    plate = 1e3 * 0.75 / (1 - 0.16) * (25e-6) ** 3 / 12
    bent = plate * spectrum.integrate(lambda q: q**4, *spectrum.band) / 2
    hard = 1e-6 * bent, 1e6 / (2 * plate * q0**3)
    assert (energy[2], compliance[2]) == pytest.approx(hard, rel=1e-3)


@pytest.mark.parametrize("axis_ratio", [1.0, 4.0])
def test_the_response_is_that_of_solids_with_other_moduli(axis_ratio):
    """Of two spectra it is the geometric mean."""
    spectra = wall(axis_ratio=axis_ratio).spectra
    q0 = 2 * np.pi / LONGEST
    factors = np.array([1e-3, 0.5, 20.0])

    def put_on_film(factor):
        return Layer(40e-6, 0.5, Film(1e3 / factor, 0.4, 25e-6))

    def put_below_skin(factor):
        return Skin(1e-6, 100.0 / factor, 0.35, 0.5)

    def find_means(solid):
        energies = [spectrum.elastic_energy(solid) for spectrum in spectra]
        softness = [find_relative_compliance(spectrum, solid, q0) for spectrum in spectra]
        return np.exp(np.mean(np.log([energies, softness]), axis=1))

    for make_solid in (put_on_film, put_below_skin):
        ratios = FilmResponse(spectra, make_solid(1.0), q0).at_modulus(factors)
        expected = [find_means(make_solid(f)) / find_means(make_solid(1.0)) for f in factors]
        np.testing.assert_allclose(np.transpose(ratios), expected, rtol=1e-12)


def test_the_layer_acts_on_draws_as_on_both_ends():
    layer = combine_roughness(put_on_layer(40e-6), wall(draws=3))
    plain = combine_roughness(TAPE, wall(draws=3))
    ratio = layer.scenarios.draws.elastic_energy / plain.scenarios.draws.elastic_energy
    assert ratio == pytest.approx(np.full(3, layer.stiffening[0]))
    assert (layer.scenarios.draws.relative_compliance < 1).all()
    assert layer.scenarios.draws.half_space_energy == pytest.approx(
        plain.scenarios.draws.elastic_energy
    )


def test_roughness_of_both_solids_adds():
    surface = wall(draws=4)
    both = combine_roughness(TAPE.replace(surface=surface), surface)
    one = combine_roughness(TAPE, surface)
    for name in ("h_rms", "rms_slope"):
        combined = getattr(both.scenarios.ends, name)
        assert combined == pytest.approx(np.sqrt(2) * getattr(one.scenarios.ends, name))
    assert both.rms_curvature == pytest.approx(np.sqrt(2) * one.rms_curvature)
    assert both.scenarios.ends.elastic_energy == pytest.approx(
        2 * one.scenarios.ends.elastic_energy
    )
    assert both.scenarios.ends.q0 == pytest.approx(one.scenarios.ends.q0)
    assert both.scenarios.draws.h_rms == pytest.approx(np.sqrt(2) * one.scenarios.draws.h_rms)
    assert both.scenarios.draws.elastic_energy == pytest.approx(
        2 * one.scenarios.draws.elastic_energy
    )
    assert both.scenarios.ends.anisotropy_error_factor == 1


def test_a_smooth_partner_changes_nothing():
    rough = wall(draws=4)
    smooth = wall(h_rms=1e-11, apart=1.0)  # known exactly
    both = combine_roughness(TAPE.replace(surface=smooth), rough)
    assert both.scenarios.ends.elastic_energy == pytest.approx(
        rough.scenarios.ends.elastic_energy, rel=1e-6
    )
    assert both.scenarios.ends.q0 == pytest.approx(rough.scenarios.ends.q0, rel=1e-6)
    assert both.scenarios.draws.h_rms == pytest.approx(rough.scenarios.draws.h_rms, rel=1e-6)


@pytest.mark.slow
def test_solids_of_very_different_scale_are_not_judged():
    steep = fix_a_v(Surface(wall(h_rms=1e-3).data.assign(q0=6e8)))
    dataset = judge([TAPE.replace(surface=steep)], [steep])
    assert dataset.not_judged.item() == TOO_DIFFERENT
    assert WORDS[dataset.verdict.item()] == "not judged"
    assert np.isnan(dataset.remaining).all()


@pytest.mark.parametrize(("axis_ratio", "factor"), [(1.0, 1), (4.0, 2)])
def test_a_direction_widens_limits(axis_ratio, factor):
    rough = combine_roughness(TAPE, wall(axis_ratio=axis_ratio))
    assert rough.scenarios.ends.anisotropy_error_factor == factor


@pytest.mark.slow
def test_thinner_tapes_keep_less():
    materials = {"deep": TAPE, "50": put_on_layer(50e-6), "20": put_on_layer(20e-6)}
    dataset = judge(materials, {"wall": wall(h_rms=3e-6)}, thresholds=False)
    smooth = dataset.sel(surface="wall", end="smooth")
    strains = [3 * 3 / d / (d * 1e-6 * 2 * np.pi / LONGEST) for d in (50, 20)]
    assert smooth.layer_strain.values == pytest.approx([0, *strains], rel=1e-3)
    assert (smooth.remaining.sel(limit="high").diff("material") < 0).all()


def test_skewed_heights_of_two_solids_add_as_third_cumulants():
    shape = {"shape": 0.8, "shape_error": 0.4}
    plateau = wall(**shape)
    gaussian = wall()
    alone = combine_roughness(TAPE, plateau).scenarios.ends
    first = combine_roughness(TAPE.replace(surface=gaussian), plateau).scenarios.ends
    second = combine_roughness(TAPE.replace(surface=plateau), gaussian).scenarios.ends
    twice = combine_roughness(TAPE.replace(surface=plateau), plateau).scenarios.ends
    assert alone.shape == pytest.approx(np.full(2, 0.8))
    # The skewness of one of two equal heights counts 1/sqrt(8).
    assert first.shape == pytest.approx(np.full(2, 0.8 / np.sqrt(8)))
    assert first.shape_error == pytest.approx(np.full(2, 0.4 / np.sqrt(8)))
    assert second.shape == pytest.approx(first.shape)
    assert second.shape_error == pytest.approx(first.shape_error)
    assert twice.shape == pytest.approx(2 * first.shape)
    assert twice.shape_error == pytest.approx(np.sqrt(2) * first.shape_error)


@pytest.mark.parametrize("own", [{"apart": 1.0}, {"draws": 5}])
def test_draws_of_two_solids_and_layers_keep_the_shape_of_heights(own):
    plateau = wall(draws=8, shape=0.8, shape_error=0.4)
    both = combine_roughness(TAPE.replace(surface=wall(**own)), plateau)
    assert both.scenarios.draws.shape == pytest.approx(np.full(8, 0.8 / np.sqrt(8)))
    layer = combine_roughness(put_on_layer(40e-6), plateau)
    assert (layer.scenarios.ends.shape == 0.8).all()
    assert layer.scenarios.draws.shape == 0.8


def test_limits_follow_the_shape_of_heights():
    """Half a logarithm on the energy ratio is half a logarithm on the threshold of the modulus."""
    skewed = [wall(), wall(shape=0.5), wall(shape=0.5, shape_error=0.2)]
    judged = judge([TAPE], skewed, curves=False)
    threshold = judged.modulus_threshold.sel(limit="value").squeeze().values
    # The width of the cohesive zone, which depends on the work of adhesion itself, hardly matters.
    assert np.log(threshold[1] / threshold[0]) == pytest.approx(0.5, rel=0.01)
    low = judged.remaining.sel(limit="low").squeeze().values
    high = judged.remaining.sel(limit="high").squeeze().values
    assert low[1] > low[0]
    assert high[1] > high[0]
    assert low[2] < low[1]
    assert high[2] > high[1]
