"""What comes with the project, and what is the user's own."""

from common import provided
from stickiness.entries import check_material

ADHESION = {"work_of_adhesion": "0.1 J/m^2", "range": "0.3 nm"}
STIFF = check_material({"plane_strain_modulus": "1 GPa"} | ADHESION)
SOFT = check_material({"plane_strain_modulus": "1 kPa"} | ADHESION)


def test_the_material_pulled_is_the_users_first_one_or_the_softest():
    given = {"steel": STIFF, "pdms": SOFT}
    assert provided.choose_pictured(given) == "pdms"
    assert provided.choose_pictured(given | {"mine": STIFF, "too": given["pdms"]}) == "mine"
