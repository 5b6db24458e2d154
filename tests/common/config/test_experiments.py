"""Experiments of the configuration: what is wrong with an entry, in one line."""

import copy
from pathlib import Path

import pytest

from common.config import checks
from common.config.experiment_entries import conditions_of

ROOT = Path(__file__).parents[3]
SCHEMA = ROOT / "config/schemas/experiments.schema.yaml"

MINE = {
    "label": "mine",
    "citation": "none",
    "radius": {"value": "1 mm", "known": "read"},
    "youngs_modulus": {"value": "1 MPa", "known": "read"},
    "poisson_ratio": {"value": 0.5, "known": "assumed"},
    "work_of_adhesion": {"value": "50 mJ/m^2", "known": "read"},
    "range": {"value": "0.3 nm", "known": "assumed"},
    "hurst": {"value": 0.8, "known": "assumed"},
    "longest_wavelength": {"between": ["10 um", "100 um"], "known": "assumed"},
    "shortest_wavelength": {"value": "10 nm", "known": "assumed"},
    "cases": {
        "force": {
            "label": "pull-off",
            "h_rms": {"between": ["10 nm", "20 nm"], "known": "read"},
            "observed": {"quantity": "relative_pull_off", "value": 0.5, "known": "read"},
        },
        "limit": {
            "label": "roughness",
            "observed": {
                "quantity": "limiting_roughness",
                "between": ["1 um", "2 um"],
                "known": "recalled",
            },
        },
    },
}
FORCE, LIMIT = ("cases", "force"), ("cases", "limit")
MISSING = object()


def changed(*edits):
    """The experiment with other values at some keys, or without these."""
    entry = copy.deepcopy(MINE)
    for *keys, value in edits:
        node = entry
        for key in keys[:-1]:
            node = node[key]
        if value is MISSING:
            del node[keys[-1]]
        else:
            node[keys[-1]] = value
    return entry


def check(entry):
    content = {"experiments": {"mine": entry}}
    checks.check_schema(content, SCHEMA, "x.yaml")
    checks.check_experiments(content["experiments"], "x.yaml")


def known(value, by="read"):
    return {"value" if not isinstance(value, list) else "between": value, "known": by}


def seen(quantity, **more):
    return {"quantity": quantity, "known": "read", **more}


def test_the_committed_experiments_pass():
    content = checks.load(ROOT / "config/experiments.yaml")
    checks.check_schema(content, SCHEMA, "config/experiments.yaml")
    checks.check_experiments(content["experiments"])
    assert {"fuller_tabor", "dalvi", "everyday"} <= content["experiments"].keys()


def test_the_made_up_experiment_is_right_but_for_what_is_changed():
    check(MINE)
    plateau = ("rolloff_wavelength", known(["1 um", "5 um"]))
    relation = seen("work_of_separation", relation="cycle_loss", factor=[1, 2], error="1 mJ/m^2")
    check(changed(plateau, (*FORCE, "observed", relation)))


def test_level_silent_criteria_and_what_is_not_published_are_taken():
    more = {"level": 0.03, "silent": ["persson_tosatti", "dahlquist"]}
    observed = MINE["cases"]["limit"]["observed"] | more
    check(changed((*LIMIT, "observed", observed), ("published", False)))


@pytest.mark.parametrize(
    ("edits", "message"),
    [
        (
            [("range", known("0.3"))],
            "experiments.mine.range.value = '0.3' has no unit; a length is wanted, e.g. '10 um'",
        ),
        (
            [("range", known(0.3))],
            "experiments.mine.range.value = 0.3 must be of type string (the value with its unit)",
        ),
        (
            [("hurst", 0.8)],
            "experiments.mine.hurst = 0.8 must say how it is known: write {value: 0.8, known: "
            "measured}, or read, recalled, assumed in place of measured",
        ),
        (
            [("range", "0.3 nm")],
            "experiments.mine.range = '0.3 nm' must say how it is known: write "
            '{value: "0.3 nm", known: measured}',
        ),
        (
            [("radius", known("1 s"))],
            "experiments.mine.radius.value = '1 s' is a time; a length is wanted, e.g. '10 um'",
        ),
        (
            [("work_of_adhesion", known("-50 mJ/m^2"))],
            "experiments.mine.work_of_adhesion.value = '-50 mJ/m^2' must be positive",
        ),
        (
            [(*FORCE, "h_rms", known(["20 nm", "0.01 um"]))],
            "experiments.mine.cases.force.h_rms.between = ['20 nm', '0.01 um'] must be "
            "[low, high] with low < high",
        ),
        (
            [("work_of_adhesio", known("1 J/m^2"))],
            "experiments.mine: unknown key 'work_of_adhesio'; did you mean 'work_of_adhesion'?",
        ),
        (
            [(*FORCE, "observd", MINE["cases"]["force"]["observed"])],
            "experiments.mine.cases.force: unknown key 'observd'; did you mean 'observed'?",
        ),
        (
            [("youngs_modulus", MISSING)],
            "experiments.mine.cases.force: give plane_strain_modulus, or youngs_modulus and "
            "poisson_ratio",
        ),
        (
            [("poisson_ratio", MISSING)],
            "experiments.mine.cases.force: give plane_strain_modulus, or youngs_modulus and "
            "poisson_ratio",
        ),
        (
            [("plane_strain_modulus", known("1 MPa"))],
            "experiments.mine.cases.force: give one of plane_strain_modulus and youngs_modulus",
        ),
        (
            [("poisson_ratio", known(0.6))],
            "experiments.mine.poisson_ratio.value = 0.6 must be between 0 and 0.5",
        ),
        (
            [(*LIMIT, "hurst", known([0.5, 1.5]))],
            "experiments.mine.cases.limit.hurst.between = 1.5 must be between 0.01 and 1",
        ),
        (
            [(*FORCE, "observed", seen("sticks", value=1))],
            "experiments.mine.cases.force.observed.value = 1 must be true or false for 'sticks'",
        ),
        (
            [(*FORCE, "observed", seen("sticks", between=[0, 1]))],
            "experiments.mine.cases.force.observed.value = [0, 1] must be true or false for "
            "'sticks'",
        ),
        (
            [(*FORCE, "observed", seen("relative_pull_off", value=True))],
            "experiments.mine.cases.force.observed.value = True must be a number",
        ),
        (
            [(*FORCE, "observed", seen("relative_pull_off", value="50 %"))],
            "experiments.mine.cases.force.observed.value = '50 %' must be a number",
        ),
        (
            [(*FORCE, "observed", seen("work_of_approach", value="5 mN"))],
            "experiments.mine.cases.force.observed.value = '5 mN' is a force; an energy per area "
            "is wanted, e.g. '50 mJ/m^2'",
        ),
        (
            [(*FORCE, "observed", seen("work_of_approach", value=5))],
            "experiments.mine.cases.force.observed.value = 5 has no unit: an energy per area is "
            "wanted, e.g. '50 mJ/m^2', as a text with its unit",
        ),
        (
            [(*FORCE, "observed", seen("work_of_separation", relation="conformal_contact"))],
            "experiments.mine.cases.force.observed.quantity = 'work_of_separation' must be "
            "'work_of_approach' for 'conformal_contact'",
        ),
        (
            [(*FORCE, "observed", seen("work_of_separation", relation="cycle_loss"))],
            "experiments.mine.cases.force.observed: the key 'factor' is missing, limits of that "
            "of 'cycle_loss'",
        ),
        (
            [(*FORCE, "observed", seen("work_of_approach", relation="conformal_contact"))],
            "experiments.mine.cases.force.observed: the key 'factor' is missing, limits of that "
            "of 'conformal_contact'",
        ),
        (
            [(*LIMIT, "observed", seen("limiting_roughness", relation="energy_ratio"))],
            "experiments.mine.cases.limit.observed: the key 'factor' is missing, limits of that "
            "of 'energy_ratio'",
        ),
        (
            [(*LIMIT, "observed", seen("limiting_roughness", value="1 um", silent=["dalquist"]))],
            "experiments.mine.cases.limit.observed.silent[0] = 'dalquist' is unknown; did you mean "
            "'dahlquist'?",
        ),
        (
            [(*LIMIT, "observed", seen("limiting_roughness", value="1 um", silent=[]))],
            "experiments.mine.cases.limit.observed.silent = [] needs at least 1 item(s)",
        ),
        (
            [(*LIMIT, "observed", seen("limiting_roughness", value="1 um", level=0))],
            "experiments.mine.cases.limit.observed.level = 0 must be greater than 0",
        ),
        (
            [(*LIMIT, "observed", seen("limiting_roughness", value="1 um", level=1))],
            "experiments.mine.cases.limit.observed.level = 1 must be below 1",
        ),
        (
            [("published", "no")],
            "experiments.mine.published = 'no' must be of type boolean",
        ),
        (
            [(*LIMIT, "observed", seen("roughness_at_a_tenth", value="1 um"))],
            "experiments.mine.cases.limit.observed.quantity = 'roughness_at_a_tenth' is unknown; "
            "choose one of relative_pull_off, limiting_roughness, work_of_approach, "
            "work_of_separation, sticks",
        ),
        (
            [
                (
                    *(*LIMIT, "observed"),
                    seen("limiting_roughness", relation="energy_ratio", factor=[0.6, 0.4]),
                )
            ],
            "experiments.mine.cases.limit.observed.factor = [0.6, 0.4] must be [low, high] with "
            "low < high",
        ),
        (
            [
                (
                    *(*FORCE, "observed"),
                    seen(
                        "work_of_approach",
                        relation="conformal_contact",
                        factor=[1, 2],
                        error="4 mm",
                    ),
                )
            ],
            "experiments.mine.cases.force.observed.error = '4 mm' is a length; an energy per area "
            "is wanted, e.g. '50 mJ/m^2'",
        ),
        (
            [(*LIMIT, "observed", seen("limiting_roughness", relation="energy_rato"))],
            "experiments.mine.cases.limit.observed.relation = 'energy_rato' is unknown; did you "
            "mean 'energy_ratio'?",
        ),
        (
            [("shortest_wavelength", known(["10 nm", "20 um"]))],
            "experiments.mine.cases.force.shortest_wavelength reaches 2e-05 m and must stay below "
            "longest_wavelength, 1e-05 m",
        ),
        (
            [
                (*FORCE, "observed", seen("sticks", value=False)),
                (*FORCE, "longest_wavelength", known("1 nm")),
            ],
            "experiments.mine.cases.force.shortest_wavelength reaches 1e-08 m and must stay below "
            "longest_wavelength, 1e-09 m",
        ),
        (
            [("rolloff_wavelength", known(["1 um", "20 um"]))],
            "experiments.mine.cases.force.rolloff_wavelength reaches 2e-05 m and must stay below "
            "longest_wavelength, 1e-05 m",
        ),
        (
            [("rolloff_wavelength", known("5 nm"))],
            "experiments.mine.cases.force.shortest_wavelength reaches 1e-08 m and must stay below "
            "rolloff_wavelength, 5e-09 m",
        ),
        (
            [(*FORCE, "h_rms", MISSING)],
            "experiments.mine.cases.force: the key 'h_rms' is missing, here and in the experiment",
        ),
        (
            [("range", MISSING)],
            "experiments.mine.cases.force: the key 'range' is missing, here and in the experiment",
        ),
        (
            [("range", {"value": "1 nm"})],
            "experiments.mine.range: the key 'known' is missing (measured: by you; read: stands in "
            "a public text that was read; recalled: known from the literature, not checked; "
            "assumed: chosen "
            "or inferred here)",
        ),
        (
            [("range", known("1 nm", by="guessed"))],
            "experiments.mine.range.known = 'guessed' is unknown; choose one of measured, read, "
            "recalled, "
            "assumed",
        ),
        (
            [("range", {"value": "1 nm", "between": ["1 nm", "2 nm"], "known": "read"})],
            "experiments.mine.range: give exactly one of: value; between",
        ),
        (
            [(*LIMIT, "observed", MISSING)],
            "experiments.mine.cases.limit: the key 'observed' is missing (what was observed)",
        ),
        ([("cases", {})], "experiments.mine.cases = {} needs at least 1 entry"),
        (
            [("citation", MISSING)],
            "experiments.mine: the key 'citation' is missing (full citation)",
        ),
    ],
)
def test_one_line_says_what_is_wrong(edits, message):
    with pytest.raises(checks.ConfigError) as caught:
        check(changed(*edits))
    assert str(caught.value).startswith(f"x.yaml: {message}")
    assert "\n" not in str(caught.value)


def test_no_experiments_are_refused():
    with pytest.raises(checks.ConfigError, match=r"experiments = \{\} needs at least 1 entry"):
        checks.check_schema({"experiments": {}}, SCHEMA, "x.yaml")


def test_a_limiting_roughness_needs_no_rms_height():
    check(
        changed(
            (*FORCE, "observed", MINE["cases"]["limit"]["observed"]), (*FORCE, "h_rms", MISSING)
        )
    )


def test_a_case_s_own_value_replaces_that_of_the_experiment():
    own = {"range": known("1 nm"), "observed": {}}
    found = conditions_of(MINE, own)
    assert found["range"]["value"] == "1 nm"
    assert found["hurst"] == MINE["hurst"]
    assert "h_rms" not in found


@pytest.mark.parametrize(
    ("mine", "other"),
    [
        ("plane_strain_modulus", "youngs_modulus"),
        ("youngs_modulus", "plane_strain_modulus"),
    ],
)
def test_a_case_s_own_modulus_replaces_one_of_either_kind(mine, other):
    experiment = changed(("youngs_modulus", MISSING), (other, known("2 MPa")))
    found = conditions_of(experiment, {mine: known("3 MPa")})
    assert found[mine]["value"] == "3 MPa"
    assert other not in found
    assert found["poisson_ratio"]["value"] == 0.5
