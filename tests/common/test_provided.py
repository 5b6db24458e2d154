"""What comes with the project, and what is the user's own."""

from pathlib import Path

import yaml

from report import provided

CONFIG = Path(__file__).parents[2] / "config"


def test_names_are_those_of_the_configuration():
    for kind, names in (("materials", provided.MATERIALS), ("surfaces", provided.SURFACES)):
        file = yaml.safe_load((CONFIG / f"{kind}.yaml").read_text(encoding="utf-8"))
        assert file[kind].keys() >= names


def test_own_come_first_in_their_order():
    names = ["steel", "b", "psa", "a"]
    assert provided.own_first(names, provided.MATERIALS) == ["b", "a", "steel", "psa"]
    assert provided.own(names, provided.MATERIALS) == ["b", "a"]
