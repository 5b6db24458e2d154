"""A wrong configuration gets one line: file, key, value, and what would be right."""

import copy
from pathlib import Path

import pytest

from common.config import load
from common.config.models import MODELS

ROOT = Path(__file__).parents[3]
MAP = {"kind": "measured", "label": "map", "source": "own", "file": "README.md", "detrend": "plane"}
CASES = load.load(Path(__file__).with_name("errors.yaml"))


@pytest.fixture(scope="module")
def files():
    """The committed configuration by its files, and a map in a file of its own."""
    files = {
        "config": load.defaults(ROOT),
        **{table: load.load(ROOT / f"config/{table}.yaml") for table in load.TABLES},
        **{name: load.load(ROOT / path) for name, path in load.CAMPAIGNS.items()},
    }
    files["surfaces"]["surfaces"]["map"] = dict(MAP)
    return files


@pytest.fixture
def check(files, monkeypatch):
    """Check one of the files with other values at some keys, or without these."""
    monkeypatch.chdir(ROOT)

    def check(file, wrong):
        content = copy.deepcopy(files[file])
        for path, value in wrong.items():
            *keys, last = path.split("/")
            node = content
            for key in keys:
                node = node[key]
            if value is None:
                del node[last]
            else:
                node[last] = value
        context = {"config": files["config"], "surfaces": files["surfaces"]["surfaces"]}
        load.check(MODELS[file], content, f"{file}.yaml", made=False, **context)

    return check


@pytest.mark.parametrize(
    ("file", "wrong", "key"), [(file, *case) for file, cases in CASES.items() for case in cases]
)
def test_one_line_names_the_wrong_key_and_its_value(check, file, wrong, key):
    with pytest.raises(load.ConfigError) as caught:
        check(file, wrong)
    error = caught.value.__cause__
    assert error.key == key
    shown = "" if error.value is None else f" = {error.value!r}"
    assert str(caught.value) == f"{file}.yaml: {key}{shown}: {error.message}"
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("wrong", "hint"),
    [
        ({"fidelty": "draft"}, "did you mean 'fidelity'"),
        ({"cases/H0.8_zeta64/surface": "H0.8_zeta65"}, "did you mean 'H0.8_zeta64'"),
        ({"roles/broad_band": "H0.8_zeta12"}, "did you mean 'H0.8_zeta128'"),
        ({"adhesion/fig2/case": "middle"}, "did you mean 'middle_band'"),
        ({"cases/H0.8_zeta64/pressures": ["1e-2"]}, "write 1.0e-2 for 1e-2"),
        ({"cases/H0.8_zeta64/quantities": ["areas"]}, "'area'"),
    ],
)
def test_an_error_says_what_would_be_right(check, wrong, hint):
    with pytest.raises(load.ConfigError, match=hint):
        check("config", wrong)


FILM = {"youngs_modulus": "3 GPa", "poisson_ratio": 0.3, "thickness": "25 um"}
SKIN = {"modulus": "3 GPa", "poisson": 0.35, "thickness": "90 nm"}
LAYER = {"materials/psa/thickness": "50 um"}
TEXT = {"surfaces/map/file": "README.md"}
LIMIT = "experiments/wafers/cases/limit"
KNOWN = {"value": "1 um", "known": "read"}


@pytest.mark.parametrize(
    ("file", "right"),
    [
        *((file, {}) for file in MODELS),
        ("materials", LAYER | {"materials/psa/backing": "slip"}),
        ("materials", LAYER | {"materials/psa/backing": FILM}),
        ("materials", {"materials/psa/skin": SKIN}),
        ("materials", {"materials/psa/surface": "asphalt"}),
        (
            "surfaces",
            TEXT
            | {"surfaces/map/length": ["160 m", "2 mm"]}
            | {"surfaces/map/plausibility": "ignore"},
        ),
        ("surfaces", TEXT | {"surfaces/map/missing_rim": 2}),
        ("experiments", {f"{LIMIT}/rolloff_wavelength": {"value": "0.1 um", "known": "read"}}),
        (
            "experiments",
            {
                f"{LIMIT}/observed": {"quantity": "limiting_roughness", **KNOWN}
                | {"level": 0.03, "silent": ["dahlquist"]}
            },
        ),
        ("config", {"model_surfaces/H0.7_zeta64/heights": {"skewness": -1.0}}),
        ("heights", {"sets/H0.5_zeta16_skewed_up1/height_skewness": 1.5}),
        ("config", {"cases/mine": {"surface": "H0.7_zeta64", "pressures": [0.1], "accuracy": 0.1}}),
    ],
)
def test_what_is_right_passes(check, file, right):
    check(file, right)
