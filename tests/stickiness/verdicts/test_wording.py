"""Materials as pages show them."""

import pytest

from stickiness import Material, Surface
from stickiness.entries import check_material
from stickiness.spectrum import SelfAffine
from stickiness.verdicts.wording import describe_material

TAPE = {"label": "tape", "work_of_adhesion": "70 mJ/m^2", "range": "0.3 nm"}
INCOMPRESSIBLE = {"poisson_ratio": 0.5}
PLAIN = INCOMPRESSIBLE | {"youngs_modulus": "0.1 MPa"}
FILM = {"youngs_modulus": "3 GPa", "poisson_ratio": 0.4, "thickness": "25 um"}
SERIES = {"equilibrium": "10 kPa", "terms": [["30 kPa", "1 s"], ["0.2 MPa", "1 ms"]]}
TABLE = [["10 mHz", "50 kPa"], ["0.1 kHz", "0.5 MPa"]]
THICK = "E = 100 kPa, ν = 0.5, 50 µm thick"


@pytest.mark.parametrize(
    ("keys", "text"),
    [
        (PLAIN | {"surface": "wall"}, "E = 100 kPa, ν = 0.5, rough itself, 2 µm rms"),
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
            "E = 100 kPa, ν = 0.5, under a skin of 90 nm and 3 GPa",
        ),
        (
            INCOMPRESSIBLE | {"youngs_modulus_table": TABLE},
            "E′ = 50 kPa at 10 mHz … 500 kPa at 100 Hz, ν = 0.5",
        ),
        (
            INCOMPRESSIBLE | {"youngs_modulus_prony": SERIES},
            "E = 10 kPa at rest, 2 Prony terms, ν = 0.5",
        ),
        ({"plane_strain_modulus": "2 MPa"}, "E* = 2 MPa"),
    ],
)
def test_materials_are_described(keys, text):
    rough = SelfAffine(hurst=0.8, q0=6e4, q1=6e6, h_rms=2e-6)
    surfaces = {"wall": Surface.from_spectrum(rough)}
    material = Material.from_entry(check_material(TAPE | keys), surfaces)
    assert describe_material(material) == text
