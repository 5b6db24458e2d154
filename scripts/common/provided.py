"""Materials and surfaces that come with the project; a user's entries are shown before them."""

from collections.abc import Iterable, Mapping
from typing import Any

from criteria.materials import read_material

MATERIALS = frozenset(("psa", "pdms", "natural_rubber", "pmma", "steel", "crystal", "soft_block"))
SURFACES = frozenset(
    (
        *("upper_line", "lower_line", "asphalt", "sandblasted_pmma"),
        *("ground_steel", "polished_steel", "jacksboro"),
    )
)


def user_defined(names: Iterable[str], provided: frozenset[str]) -> list[str]:
    """The names that do not come with the project."""
    return [name for name in names if name not in provided]


def user_defined_first(names: Iterable[str], provided: frozenset[str]) -> list[str]:
    """The names, those that do not come with the project first.

    Examples
    --------
    >>> user_defined_first(["steel", "my_tape", "psa"], MATERIALS)
    ['my_tape', 'steel', 'psa']
    """
    return sorted(names, key=lambda name: name in provided)


def choose_pictured(materials: Mapping[str, Mapping[str, Any]]) -> str:
    """The material whose pull-off is pictured: the user's first one, or else the softest."""
    mine = user_defined(materials, MATERIALS)
    return mine[0] if mine else min(materials, key=lambda m: read_material(materials[m]).modulus)
