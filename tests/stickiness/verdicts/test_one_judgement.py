"""The library's verdict is what the workflow's scripts write."""

import json
from typing import Any, NamedTuple

import numpy as np
import pytest
from helpers.pages import make_job

from criteria import judge_surface
from stickiness import Material, Surface, datasets, surface, verdict
from stickiness.criteria.pair import WORDS
from stickiness.criteria.registry import REMAINING
from stickiness.entries import check_material
from stickiness.spectrum import SelfAffine
from stickiness.verdicts.limits import read_limited

MAP_SIDE = 2 * np.pi / 6e4  # [m]
SPECTRUM = SelfAffine(hurst=0.8, q0=6e4, q1=6e6, h_rms=1e-6)
TEXTS = {
    "poisson_ratio": 0.5,
    "work_of_adhesion": "60 mJ/m^2",
    "range": "0.3 nm",
}
TAPE = {"youngs_modulus": "0.2 MPa"}
SERIES = {"equilibrium": "0.1 MPa", "terms": [["0.5 MPa", "0.1 s"], ["10 MPa", "1 ms"]]}
FILM = {"youngs_modulus": "3 GPa", "poisson_ratio": 0.4, "thickness": "25 um"}
LIMITED = ("remaining", "pull_off", "modulus_threshold")

pytestmark = [
    pytest.mark.filterwarnings("ignore::stickiness.plausibility.PlausibilityWarning"),
    pytest.mark.usefixtures("coarse_simulation"),
]


class Written(NamedTuple):
    """What the script writes of one pair."""

    cell: Any
    contact_law: dict[str, Any]


def run_workflow(folder, wall, texts):
    """Judge one material of the configuration on a surface by the rule's script."""
    entry = check_material(TEXTS | texts)
    wall.write(folder / "wall.nc", title="wall", parameters={})
    inputs = {"surface": folder / "wall.nc", "material_surfaces": [folder / "wall.nc"]}
    outputs = {"verdicts": folder / "verdicts.nc", "contact_laws": folder / "laws.json"}
    judge_surface.main(
        make_job(
            inputs,
            outputs,
            wildcards={"real_surface": "wall"},
            materials={"tape": entry},
            material_surfaces=["wall"],
            label="the wall",
        )
    )
    verdicts = datasets.read(outputs["verdicts"])
    laws = json.loads(outputs["contact_laws"].read_text(encoding="utf-8"))
    (contact_law,) = laws["pairs"]
    return Written(verdicts.sel(material="tape", surface="wall"), contact_law)


def check(answer, written):
    """Compare an answer of the library with what the script has written."""
    cell = written.cell
    assert answer.word == WORDS[int(cell.verdict)]
    assert answer.word != "not judged"
    for name in LIMITED:
        ours = [getattr(answer, name), *getattr(answer, f"{name}_limits")]
        np.testing.assert_allclose(ours, read_limited(cell[name]), rtol=1e-12)
    for name, margin in answer.margins.items():
        if name != REMAINING:  # of which the draws have the margin
            theirs = float(cell.margin_by_criterion.sel(criterion=name, end="rough"))
            assert margin == pytest.approx(theirs, rel=1e-12), name
    contact_law = answer.to_dict()
    del contact_law["version"]
    del contact_law["warnings"]
    for name, quantity in contact_law.items():
        theirs = written.contact_law[name]
        if not isinstance(quantity, dict):
            assert quantity == theirs
            continue
        assert quantity.keys() == theirs.keys()
        for part in quantity.keys() - {"unit", "symbol"}:
            assert quantity[part] == pytest.approx(theirs[part], rel=1e-12), (name, part)


@pytest.mark.parametrize(
    "wall",
    [
        Surface.from_spectrum(SPECTRUM),
        Surface.from_drawing(Ra=(1e-6, 2e-6), shortest_wavelength=1e-8),
    ],
    ids=["spectrum", "drawing"],
)
@pytest.mark.parametrize(
    "texts",
    [
        TAPE,
        TAPE | {"thickness": "40 um"},
        {"youngs_modulus_prony": SERIES, "thickness": "40 um", "backing": FILM},
        {"youngs_modulus_prony": SERIES, "dwell": "10 s"},
        TAPE | {"surface": "wall"},
    ],
    ids=["half-space", "layer", "film with rates", "dwell", "two rough solids"],
)
def test_pairs_of_described_surfaces(wall, texts, tmp_path):
    written = run_workflow(tmp_path, wall, texts)
    material = Material.from_entry(check_material(TEXTS | texts), {"wall": wall})
    check(verdict(wall, material), written)


MAP = surface.synthesise(SPECTRUM, 256, MAP_SIDE, seed=3)
PROFILE_STEP = 2e-7  # [m]
PROFILE = surface.synthesise(SPECTRUM, 1024, 1024 * PROFILE_STEP, seed=4)[:, 0]


def test_a_map_as_a_file_and_as_an_array(tmp_path):
    np.save(tmp_path / "wall.npy", MAP.T * 1e6)  # rows of a file run along y
    wall = Surface.read(tmp_path / "wall.npy", length=f"{MAP_SIDE!r} m", height_unit="um")
    texts = TAPE | {"thickness": "40 um"}
    written = run_workflow(tmp_path, wall, texts)
    heights = (MAP * 1e6) * 1e-6  # as they are read
    for rough, options in ((wall, {}), (heights, {"length": MAP_SIDE})):
        check(
            verdict(rough, Material.from_entry(check_material(TEXTS | texts)), **options), written
        )


def test_a_line_profile_as_a_file_and_as_an_array(tmp_path):
    positions = np.arange(PROFILE.size) * PROFILE_STEP
    np.savetxt(tmp_path / "profile.txt", np.transpose([positions, PROFILE]) * 1e6)
    wall = Surface.read(tmp_path / "profile.txt", position_unit="um", height_unit="um")
    written = run_workflow(tmp_path, wall, TAPE)
    heights = np.loadtxt(tmp_path / "profile.txt")[:, 1] * 1e-6
    same = Surface.from_profile(heights, PROFILE_STEP * PROFILE.size)
    for rough in (wall, same):
        properties = {"youngs_modulus": 0.2e6, "work_of_adhesion": 0.06, "range": 3e-10}
        check(verdict(rough, **properties), written)
