"""Materials as pages show them."""

import pytest

from common.templates import make_environment
from stickiness.entries import check_material

TAPE = {"label": "tape", "work_of_adhesion": "70 mJ/m^2", "range": "0.3 nm"}
INCOMPRESSIBLE = {"poisson_ratio": 0.5}
PLAIN = INCOMPRESSIBLE | {"youngs_modulus": "0.1 MPa"}
FILM = {"youngs_modulus": "3 GPa", "poisson_ratio": 0.4, "thickness": "25 um"}
SERIES = {"equilibrium": "10 kPa", "terms": [["30 kPa", "1 s"], ["0.2 MPa", "1 ms"]]}
TABLE = [["10 mHz", "50 kPa"], ["0.1 kHz", "0.5 MPa"]]
THICK = "E = 0.1 MPa, ν = 0.5, 50 µm thick"


@pytest.mark.parametrize(
    ("keys", "text"),
    [
        (PLAIN | {"surface": "wall"}, "E = 0.1 MPa, ν = 0.5, rough as the brick wall"),
        (PLAIN | {"thickness": "50 um"}, f"{THICK} on a rigid base"),
        (
            PLAIN | {"thickness": "50 um", "backing": "slip"},
            f"{THICK}, free to slip on a rigid base",
        ),
        (
            PLAIN | {"thickness": "50 um", "backing": FILM},
            f"{THICK} on a film of 25 µm and 3 GPa",
        ),
        (
            PLAIN | {"skin": {"thickness": "90 nm", "modulus": "3 GPa", "poisson": 0.35}},
            "E = 0.1 MPa, ν = 0.5, under a skin of 90 nm and 3 GPa",
        ),
        (
            INCOMPRESSIBLE | {"youngs_modulus_table": TABLE},
            "E′ = 50 kPa at 10 mHz … 0.5 MPa at 0.1 kHz, ν = 0.5",
        ),
        (
            INCOMPRESSIBLE | {"youngs_modulus_prony": SERIES},
            "E = 10 kPa at rest, 2 Prony terms, ν = 0.5",
        ),
        ({"plane_strain_modulus": "2 MPa"}, "E* = 2 MPa"),
    ],
)
def test_materials_are_shown_as_configured(keys, text):
    macros = make_environment("report").get_template("macros.html.j2").module
    shown = macros.given(check_material(TAPE | keys), {"wall": "the brick wall"})
    assert shown.replace("\u00a0", " ") == text
