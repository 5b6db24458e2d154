"""What comes with the project, and what is the user's own."""

from pathlib import Path

import yaml

from common import provided

CONFIG = Path(__file__).parents[2] / "config"


def test_names_are_those_of_the_configuration():
    for kind, names in (("materials", provided.MATERIALS), ("surfaces", provided.SURFACES)):
        file = yaml.safe_load((CONFIG / f"{kind}.yaml").read_text(encoding="utf-8"))
        assert file[kind].keys() >= names


def test_user_defined_names_come_first_in_their_order():
    names = ["steel", "b", "psa", "a"]
    assert provided.user_defined_first(names, provided.MATERIALS) == ["b", "a", "steel", "psa"]
    assert provided.user_defined(names, provided.MATERIALS) == ["b", "a"]
