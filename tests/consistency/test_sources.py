"""A pair is the only source of what is said of it, and a map says what its draws say."""

from dataclasses import replace

import numpy as np
import pytest
from helpers.analysed import fix_a_v

import stickiness
from stickiness import Material, Surface
from stickiness.remaining.trial_states import DEFAULT_SHARE
from stickiness.spectrum import SelfAffine, Shells
from stickiness.surface import synthesise
from stickiness.verdicts import meeting
from stickiness.verdicts.verdict import StickinessVerdict

pytestmark = pytest.mark.filterwarnings("ignore::stickiness.plausibility.PlausibilityWarning")

SIDE = 1e-4  # m
ADHESION = {"work_of_adhesion": 0.03, "range": 3e-10}
SKIN = {"thickness": "90 nm", "modulus": "300 MPa", "poisson": 0.35}
FILM = {"thickness": "20 um", "youngs_modulus": "1 GPa", "poisson_ratio": 0.4}
SOLIDS = {
    "half-space": {"youngs_modulus": 2e6},
    "layer": {"youngs_modulus": 2e6, "thickness": 5e-6, "poisson_ratio": 0.4},
    "thin layer": {"youngs_modulus": 2e4, "thickness": 1e-6},
    "film": {"youngs_modulus": 1e6, "thickness": 1e-5, "backing": FILM},
    "hard skin": {"youngs_modulus": 1e4, "skin": SKIN},
    "thick skin": {
        "youngs_modulus": 1e5,
        "skin": {"thickness": "1 um", "modulus": "10 MPa", "poisson": 0.35},
    },
}
# Texts about the material as it was given, and tables of its own.
OF_MATERIAL = ("material_label", "material_doubts", "properties", "doubts", "modulus")


def make_profile(seed):
    q0 = 2 * np.pi / (SIDE / 10)
    rough = SelfAffine(hurst=0.8, q0=q0, q1=20 * q0, h_rms=2e-7)
    return Surface.from_profile(synthesise(rough, 1024, SIDE, seed)[0], SIDE)


@pytest.mark.parametrize("surface", ["described", "measured"])
@pytest.mark.parametrize(
    ("of_pair", "of_material"),
    [
        ({"work_of_adhesion": 0.01}, {"work_of_adhesion": 0.01}),
        ({"range": 1e-9}, {"range": 1e-9}),
        ({"modulus": 3e6 / 0.75}, {"youngs_modulus": 3e6}),
        ({"pressed": 1e6}, {"pressed": 1e6}),
    ],
)
def test_all_outputs_are_those_of_the_pair(surface, of_pair, of_material, monkeypatch):
    make = {
        "described": lambda: Surface.from_spectrum(
            SelfAffine(hurst=0.8, q0=6e4, q1=6e8, h_rms=1e-6)
        ),
        "measured": lambda: make_profile(seed=3),
    }
    rough = make[surface]()
    given = {"youngs_modulus": 2e6, **ADHESION}
    wanted = stickiness.judge([Material(**given | of_material)], [rough])

    # A property of materials that changes the pair, and nothing else.
    make_pair = meeting.make_pair
    monkeypatch.setattr(meeting, "make_pair", lambda *args: replace(make_pair(*args), **of_pair))
    found = stickiness.judge([Material(**given)], [rough])
    for name in found.data_vars:
        if name not in OF_MATERIAL:
            np.testing.assert_allclose(
                *map(as_numbers, (found[name], wanted[name])), rtol=1e-6, err_msg=name
            )
    cells = [each.isel(material=0, surface=0) for each in (found, wanted)]
    answers = [StickinessVerdict(cell).to_dict() for cell in cells]
    own = ("material_properties", "warnings")
    for name in answers[1].keys() - own:
        assert str(answers[0][name])[:20] == str(answers[1][name])[:20], name


def as_numbers(variable):
    """Numbers as they are; texts by whether they differ."""
    values = variable.values
    return values if values.dtype.kind != "O" else [hash(text) % 2**30 for text in values.ravel()]


@pytest.fixture(scope="module")
def surface_and_draws():
    """A measured surface, and one for each of some draws, of which a_V is not compared."""
    surface = make_profile(seed=5)
    family = surface.family
    spectra = [Shells(family.q, family.area * psd) for psd in family.psd[::5]]
    return surface, [fix_a_v(Surface.from_spectrum(spectrum)) for spectrum in spectra]


@pytest.mark.slow
@pytest.mark.parametrize("solid", SOLIDS)
def test_a_measured_surface_says_what_its_draws_say(surface_and_draws, solid):
    surface, draws = surface_and_draws
    material = Material(**ADHESION, **SOLIDS[solid])
    found = stickiness.verdict(surface, material)
    met = [meeting.meet(material, draw, DEFAULT_SHARE) for draw in draws]
    shares = np.array([each.limit(each.pair.remaining, each.pair)[1] for each in met])
    low, high = found.remaining_limits
    # Of 40 draws 36 are expected inside. As spectra they have more scales: a measured surface
    # counts those that were measured.
    inside = ((shares >= low - 1e-6) & (shares <= high + 1e-6)).sum()
    assert inside >= 32
    quarter, three_quarters = np.quantile(shares, [0.25, 0.75])
    assert quarter - 0.05 <= found.remaining <= three_quarters + 0.05
