"""What a material and a surface bring to their contact: layers, two rough solids, direction."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from helpers.analysed import A_V, LONGEST, fix_a_v, wall

from common.materials import read_material
from common.templates import make_environment
from common.verdicts import find_limits
from criteria import verdicts
from criteria.pair_roughness import ENDS, TOO_DIFFERENT, combine, find_spectra
from report.table_rows import describe_pair
from stickiness.criteria.pair import WORDS
from stickiness.remaining import predict
from stickiness.remaining.prediction import DEFAULT_SHARE, FILM_FACTORS, find_film_response
from stickiness.solids import Film, Layer
from stickiness.spectrum import SelfAffine

TAPE = {"label": "tape", "youngs_modulus": "0.1 MPa", "poisson_ratio": 0.5}
TAPE |= {"work_of_adhesion": "70 mJ/m^2", "range": "0.3 nm", "source": "made up"}
FILM = {"youngs_modulus": "3 GPa", "poisson_ratio": 0.4, "thickness": "25 um"}


def joined(material, surface, second=None):
    found = combine(material, surface, (A_V, A_V), second)
    return SimpleNamespace(**{name: values.values for name, values in found.items()})


def layer_factor(k, backing):
    """S of an incompressible layer, as physics books have it."""
    if backing == "slip":
        return (np.cosh(2 * k) - 1) / (np.sinh(2 * k) + 2 * k)
    return (np.sinh(2 * k) - 2 * k) / (np.cosh(2 * k) + 2 * k**2 + 1)


@pytest.mark.parametrize("backing", ["bonded", "slip"])
def test_a_layer_takes_the_energy_of_its_response(backing):
    surface = wall()
    material = read_material(TAPE | {"thickness": "40 um", "backing": backing})
    found = joined(material, surface)
    q = np.geomspace(float(surface.q0), float(surface.q1), 20001)
    psd = np.exp(np.interp(np.log(q), np.log(surface.wave_number), np.log(surface.psd[0])))
    factor = layer_factor(np.minimum(q * 40e-6, 300), backing)
    ratio = np.trapezoid(q**3 * psd / factor, np.log(q)) / np.trapezoid(q**3 * psd, np.log(q))
    assert found.stiffening == pytest.approx([ratio, ratio], rel=1e-5)
    assert found.elastic_energy == pytest.approx(ratio * surface.elastic_energy.values, rel=1e-5)
    assert found.relative_compliance == pytest.approx(
        layer_factor(float(surface.q0) * 40e-6, backing)
    )


def test_a_thick_layer_is_a_half_space():
    thick, deep = (
        joined(read_material(TAPE | keys), wall()) for keys in ({"thickness": "1 m"}, {})
    )
    assert thick.elastic_energy == pytest.approx(deep.elastic_energy, rel=1e-12)
    assert thick.relative_compliance == deep.relative_compliance == 1
    assert (deep.stiffening == 1).all()


def test_a_tape_on_a_film_takes_less_energy_than_on_a_rigid_base():
    base, tape, thin = (
        joined(read_material(TAPE | {"thickness": "40 um", "backing": backing}), wall())
        for backing in ("bonded", FILM, FILM | {"thickness": "2 um"})
    )
    assert (base.stiffening > tape.stiffening).all()
    assert (tape.stiffening > thin.stiffening).all()
    assert np.isnan(tape.half_space_energy).all()  # a half-space bounds nothing
    assert np.isfinite(base.half_space_energy).all()


THIN = {key: value for key, value in TAPE.items() if key != "youngs_modulus"}
THIN |= {"thickness": "40 um", "backing": FILM | {"thickness": "4 um", "youngs_modulus": "0.1 GPa"}}


def at_moduli(moduli, draws):
    """Verdicts on the thin tape with these E* [Pa], each with its film as a solid of its own."""
    entries = {str(i): THIN | {"youngs_modulus": f"{0.75 * x!r} Pa"} for i, x in enumerate(moduli)}
    return judged(entries, {"wall": wall(h_rms=1.3e-6, draws=draws)}).sel(surface="wall")


@pytest.mark.slow
@pytest.mark.parametrize("draws", [0, 60])
def test_thresholds_and_curves_of_a_tape_keep_its_film(draws):
    """They interpolate the response of the layer. Verdicts at other moduli do not."""
    tape = at_moduli([0.1e6], draws).isel(material=0)
    thresholds = tape.modulus_threshold.values.tolist()
    limits = [float(x) for x in find_limits(tape, "modulus_threshold")]
    found = at_moduli([*thresholds, *limits], draws)
    low, high = find_limits(found)
    # Errors of the energy are up to 3e-4; the share falls with its third power there.
    shares = np.diag(found.remaining.isel(material=[0, 1])), [low[2], high[3]]
    np.testing.assert_allclose(shares, DEFAULT_SHARE, rtol=3e-3)
    for place in (40, 55, 65):
        factor = float(tape.modulus_factor[place])
        other = at_moduli([0.1e6 * factor], draws).isel(material=0)
        at = tape.isel(modulus_factor=place)
        np.testing.assert_allclose(at.remaining_by_modulus, other.remaining, rtol=2e-3, atol=1e-5)
        for name, limit in zip(("low", "high"), find_limits(other), strict=True):
            at_limit = float(at[f"remaining_by_modulus_{name}"])
            assert at_limit == pytest.approx(float(limit), rel=2e-3, abs=1e-5)


@pytest.mark.slow
def test_a_rate_dependent_tape_has_its_film_at_every_rate_and_dwell():
    table = [["1 mHz", "10 kPa"], ["1 Hz", "0.1 MPa"], ["1 kHz", "3 MPa"]]
    slow = THIN | {"youngs_modulus_table": table}
    rested = slow | {"dwell": "10 s", "broken_at": "1 Hz"}
    found = judged({"slow": slow, "rested": rested}, {"wall": wall()}, np.geomspace(1e-2, 1e2, 5))
    spectra = find_spectra(wall())
    film = read_material(THIN | {"youngs_modulus": "1 Pa"}).solid.backing
    solids = [read_material(entry) for entry in (slow, rested)]
    moduli = {"slow": found.modulus.sel(material="slow").values, "rested": [solids[1].modulus]}
    factor = solids[1].separation_factor[0]
    for name, scale in (("slow", 1.0), ("rested", factor)):
        one = found.sel(material=name, surface="wall")
        shares = one.remaining_by_rate.values.T if name == "slow" else [one.remaining.values]
        for modulus, share in zip(moduli[name], shares, strict=True):
            ratio = film.modulus_ratio / (0.75 * modulus)
            solid = Layer(40e-6, 0.5, replace(film, modulus_ratio=ratio))
            expected = [predict(s, 0.07 / modulus, 3e-10, solid=solid).separation for s in spectra]
            np.testing.assert_allclose(share, scale * np.array(expected), rtol=2e-3, atol=1e-6)


def test_the_response_on_a_film_ends_at_the_rigid_base_and_at_the_bent_plate():
    q0 = 2 * np.pi / LONGEST
    spectrum = SelfAffine(hurst=0.8, q0=q0, q1=2 * q0, h_rms=1e-6)
    solid = Layer(40e-6, 0.5, Film(1e3, 0.4, 25e-6))
    energy, compliance = np.exp(find_film_response(spectrum, solid, q0))
    base = Layer(40e-6, 0.5)
    soft = spectrum.elastic_energy(base), base.factor(q0)
    at = energy * spectrum.elastic_energy(solid), compliance * solid.factor(q0)
    assert (at[0][0], at[1][0]) == pytest.approx(soft, rel=1e-5)
    # A hard layer bends the plate: it takes D q^4/2 times the variance of every wave.
    plate = 1e3 * 0.75 / (1 - 0.16) * (25e-6) ** 3 / 12
    bent = plate * spectrum.integrate(lambda q: q**4, *spectrum.band) / 2
    hard = 1e-6 * bent, 1e6 / (2 * plate * q0**3)
    assert (at[0][-1], at[1][-1]) == pytest.approx(hard, rel=1e-3)
    at_one = FILM_FACTORS.size // 2
    assert (energy[at_one], compliance[at_one]) == pytest.approx((1, 1), rel=1e-12)
    assert find_film_response(spectrum, base, q0) is None


def test_the_layer_acts_on_draws_as_on_both_ends():
    found = joined(read_material(TAPE | {"thickness": "40 um"}), wall(draws=3))
    plain = joined(read_material(TAPE), wall(draws=3))
    ratio = found.elastic_energy_draws / plain.elastic_energy_draws
    assert ratio == pytest.approx(np.full(3, found.stiffening[0]))
    assert found.relative_compliance < 1
    assert found.half_space_energy_draws == pytest.approx(plain.elastic_energy_draws)


def test_roughness_of_both_solids_adds():
    surface = wall(draws=4)
    both = joined(read_material(TAPE), surface, second=surface)
    one = joined(read_material(TAPE), surface)
    for name in ("h_rms", "rms_slope", "rms_curvature"):
        assert getattr(both, name) == pytest.approx(np.sqrt(2) * getattr(one, name))
    assert both.elastic_energy == pytest.approx(2 * one.elastic_energy)
    assert both.q0 == pytest.approx(one.q0)
    assert both.h_rms_draws == pytest.approx(np.sqrt(2) * one.h_rms_draws)
    assert both.elastic_energy_draws == pytest.approx(2 * one.elastic_energy_draws)
    assert both.anisotropy_error_factor == 1


def test_a_smooth_partner_changes_nothing():
    rough, smooth = wall(draws=4), wall(h_rms=1e-11)
    smooth = smooth.isel(end=[0, 0]).assign_coords(end=list(ENDS))  # known exactly
    both = joined(read_material(TAPE), rough, second=smooth)
    assert both.elastic_energy == pytest.approx(rough.elastic_energy.values, rel=1e-6)
    assert both.q0 == pytest.approx(float(rough.q0), rel=1e-6)
    assert both.h_rms_draws == pytest.approx(rough.h_rms_draws.values, rel=1e-6)


@pytest.mark.slow
def test_solids_of_very_different_scale_are_not_judged():
    steep = wall(h_rms=1e-3).assign(q0=6e8)
    found = judged({"rough": TAPE | {"surface": "wall"}}, {"wall": steep})
    assert found.not_judged.item() == TOO_DIFFERENT
    assert WORDS[found.verdict.item()] == "not judged"
    assert np.isnan(found.remaining).all()


def test_a_direction_widens_limits():
    for keys, factor in (({}, 1), ({"axis_ratio": 4.0}, 2)):
        assert joined(read_material(TAPE), wall(**keys)).anisotropy_error_factor == factor


def judged(materials, surfaces, frequencies=(1.0,)):
    solids = {name: read_material(entry) for name, entry in materials.items()}
    with pytest.MonkeyPatch.context() as patch:
        fix_a_v(patch)
        return verdicts.find_verdicts(solids, surfaces, surfaces, np.array(frequencies))


@pytest.mark.slow
def test_thinner_tapes_keep_less_and_the_row_says_why():
    tapes = {"deep": {}} | {d: {"thickness": f"{d} um"} for d in ("50", "20")}
    found = judged({name: TAPE | keys for name, keys in tapes.items()}, {"wall": wall(h_rms=3e-6)})
    remaining = found.remaining.sel(surface="wall", end="smooth").values
    strains = (3 * 3 / d / (d * 1e-6 * 2 * np.pi / LONGEST) for d in (50, 20))
    assert found.layer_strain.values[:, 0, 0] == pytest.approx([0, *strains], rel=1e-3)
    assert remaining[0] > remaining[1] > remaining[2]
    thick = found.sel(material="20", surface="wall").assign(layer_strain=("end", [0.15, 0.301]))
    deep, thin = (
        describe_pair(found.sel(material=d, surface="wall"), TAPE) for d in ("deep", "50")
    )
    assert (deep["stiffening"], deep["strain"], thin["strain"]) == ("", "", "")
    assert thin["stiffening"].startswith("1")
    assert describe_pair(thick, TAPE)["strain"] == "0.3"


SERIES = {"equilibrium": "10 kPa", "terms": [["30 kPa", "1 s"], ["0.2 MPa", "1 ms"]]}
TABLE = [["10 mHz", "50 kPa"], ["0.1 kHz", "0.5 MPa"]]
THICK = "E = 0.1 MPa, ν = 0.5, 50 µm thick"


@pytest.mark.parametrize(
    ("keys", "text"),
    [
        ({"surface": "wall"}, "E = 0.1 MPa, ν = 0.5, rough as the brick wall"),
        ({"thickness": "50 um"}, f"{THICK} on a rigid base"),
        ({"thickness": "50 um", "backing": "slip"}, f"{THICK}, free to slip on a rigid base"),
        ({"thickness": "50 um", "backing": FILM}, f"{THICK} on a film of 25 µm and 3 GPa"),
        ({"youngs_modulus_table": TABLE}, "E′ = 50 kPa at 10 mHz … 0.5 MPa at 0.1 kHz, ν = 0.5"),
        ({"youngs_modulus_prony": SERIES}, "E = 10 kPa at rest, 2 Prony terms, ν = 0.5"),
        ({"plane_strain_modulus": "2 MPa"}, "E* = 2 MPa"),
    ],
)
def test_materials_are_shown_as_configured(keys, text):
    macros = make_environment("report").get_template("macros.html.j2").module
    found = macros.given(TAPE | keys, {"wall": "the brick wall"})
    assert found.replace("\u00a0", " ") == text
