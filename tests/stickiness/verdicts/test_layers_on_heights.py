"""Layers on measured heights: contact is simulated with the layer itself."""

from dataclasses import replace

import numpy as np
import pytest

from stickiness import Material, Surface, judge, surface
from stickiness.solids import Film, Layer
from stickiness.spectrum import SelfAffine
from stickiness.verdicts.judgement import BY_SHAPED_THEORY, BY_SIMULATION
from stickiness.verdicts.meeting import find_family, find_roughness

Q0 = 6e4  # [1/m]
SIDE = 8 * np.pi / Q0  # [m]
SPECTRUM = SelfAffine(hurst=0.8, q0=Q0, q1=8 * Q0, h_rms=1e-6)
LAYER = Layer(0.5 / Q0, 0.5)
TAPE = Material(youngs_modulus=0.2e6, work_of_adhesion=0.06, range=3e-10, solid=LAYER)

pytestmark = [
    pytest.mark.filterwarnings("ignore::stickiness.plausibility.PlausibilityWarning"),
    pytest.mark.usefixtures("coarse_simulation"),
]


@pytest.fixture(scope="module")
def heights():
    return surface.synthesise(SPECTRUM, 64, SIDE, seed=3)


@pytest.fixture(scope="module")
def wall(heights):
    return Surface.from_heights(heights, SIDE)


def meet_roughness(material, surface):
    """Roughness that a material meets, without errors."""
    return find_roughness(material, surface, find_family(material, surface))


def test_materials_of_one_layer_share_a_simulation(wall):
    stiffer = TAPE.replace(youngs_modulus=1e6)
    first = meet_roughness(TAPE, wall).simulated
    assert meet_roughness(stiffer, wall).simulated is first


def test_what_is_written_simulates_the_same(wall, tmp_path):
    wall.write(tmp_path / "wall.nc", title="wall", parameters={})
    again = Surface.open(tmp_path / "wall.nc")
    kept = wall.simulate_on(LAYER)
    reread = again.simulate_on(LAYER)
    np.testing.assert_allclose(reread.whole.simulated_share, kept.whole.simulated_share, rtol=1e-12)
    np.testing.assert_allclose(reread.whole.gap_share, kept.whole.gap_share, rtol=1e-12)


def test_verdicts_say_what_decided(wall):
    film = replace(LAYER, backing=Film(1e4, 0.4, 0.3 / Q0))
    rough = TAPE.replace(surface=Surface.from_spectrum(SPECTRUM))
    materials = {"layer": TAPE, "film": TAPE.replace(solid=film), "rough": rough}
    verdicts = judge(materials, {"wall": wall}, curves=False, thresholds=False)
    codes = verdicts.decided_by.sel(surface="wall").values.tolist()
    assert codes == [BY_SIMULATION, BY_SHAPED_THEORY, BY_SHAPED_THEORY]


def test_states_on_a_layer_bound_its_energy(wall):
    """Wherever states were followed to, none has less energy than no contact allows."""
    states = wall.simulate_on(LAYER).whole
    energy = states.full_contact_energy
    assert energy == pytest.approx(states.elastic_energy[~states.has_adhesion].max())
    # Full contact leaves 1 - U/w, whatever else there is.
    length = np.array([2.0, 5.0]) * energy
    shares = states.share(length, np.full(2, 1e-10))
    assert (shares >= 1 - energy / length - 1e-12).all()
    assert (shares <= 1).all()
