"""Which materials the rule judges on a surface again, and that what it keeps is the same."""

import json

import pytest
import xarray as xr
from helpers.analysed import wall
from helpers.pages import make_job

from criteria import judge_surface
from stickiness import datasets
from stickiness.entries import check_material

COMMON = {"work_of_adhesion": "50 mJ/m^2", "range": "0.3 nm"}
MATERIALS = {
    "soft": COMMON | {"label": "a gel", "plane_strain_modulus": "0.1 MPa"},
    "rested": COMMON
    | {
        "label": "a tape",
        "youngs_modulus_prony": {"equilibrium": "40 kPa", "terms": [["50 kPa", "1 s"]]},
        "dwell": "1 min",
    },
    "rough": COMMON | {"label": "a tyre", "plane_strain_modulus": "2 MPa", "surface": "tyre"},
}


class Rule:
    """The rule on one surface in a folder; every call says which materials it judged."""

    known = {}  # verdicts on materials that were judged together on these surfaces before

    def __init__(self, folder, monkeypatch):
        self.folder = folder
        self.judged = []
        self.heights = {}
        self.change("plate", 1e-6)
        self.change("tyre", 1e-7)
        self.judge_pairs = judge_surface.judge
        monkeypatch.setattr(judge_surface, "judge", self.judge)

    def change(self, name, h_rms):
        self.heights[name] = h_rms
        wall(h_rms).write(self.folder / f"{name}.nc", title="a", parameters={"surface": name})

    def judge(self, materials, surfaces):
        self.judged += materials
        key = json.dumps([self.heights, {name: self.entries[name] for name in materials}])
        if key not in self.known:
            self.known[key] = self.judge_pairs(materials, surfaces)
        return self.known[key]

    def run(self, materials, output="verdicts.nc", code="as it is"):
        self.judged.clear()
        self.entries = materials
        judge_surface.main(
            make_job(
                {
                    "surface": str(self.folder / "plate.nc"),
                    "material_surfaces": [str(self.folder / "tyre.nc")],
                },
                {
                    "verdicts": str(self.folder / output),
                    "contact_laws": str(self.folder / "laws.json"),
                },
                {"real_surface": "plate"},
                materials={name: check_material(entry) for name, entry in materials.items()},
                material_surfaces=["tyre"],
                label="plate",
                code=code,
            )
        )
        return list(self.judged)

    def read(self, output="verdicts.nc"):
        """Verdicts, without attributes of the file as a whole."""
        return datasets.read(self.folder / output).drop_attrs(deep=False)


@pytest.fixture
def rule(tmp_path, monkeypatch):
    return Rule(tmp_path, monkeypatch)


def test_materials_that_come_and_change_are_judged_alone_and_as_if_with_all(rule):
    two = {name: MATERIALS[name] for name in ("soft", "rough")}
    assert rule.run(two) == ["soft", "rough"]
    assert rule.run(MATERIALS) == ["rested"]
    assert rule.run(MATERIALS, "anew.nc") == list(MATERIALS)
    xr.testing.assert_identical(rule.read(), rule.read("anew.nc"))

    changed = {**MATERIALS, "soft": MATERIALS["soft"] | {"plane_strain_modulus": "9 MPa"}}
    assert rule.run(changed) == ["soft"]
    assert float(rule.read().plane_strain_modulus.sel(material="soft").item()) == 9e6
    # One goes, and the others have another order.
    assert rule.run({name: changed[name] for name in ("rough", "rested")}) == []
    assert rule.read().material.values.tolist() == ["rough", "rested"]


def test_a_label_judges_nothing_and_is_told(rule):
    rule.run(MATERIALS)
    before = rule.read()
    renamed = {**MATERIALS, "soft": MATERIALS["soft"] | {"label": "jelly", "note": "own"}}
    assert rule.run(renamed) == []
    after = rule.read()
    assert after.material_label.values.tolist() == ["jelly", "a tape", "a tyre"]
    xr.testing.assert_identical(
        after.drop_vars("material_label"), before.drop_vars("material_label")
    )
    laws = json.loads((rule.folder / "laws.json").read_text(encoding="utf-8"))["pairs"]
    assert [law["material"] for law in laws] == ["jelly", "a tape", "a tyre"]


def test_another_surface_or_code_judges_what_it_concerns(rule):
    rule.run(MATERIALS)
    assert rule.run(MATERIALS, code="changed") == list(MATERIALS)
    rule.change("tyre", 2e-7)  # the roughness of one material
    assert rule.run(MATERIALS, code="changed") == ["rough"]
    rule.change("plate", 2e-6)
    assert rule.run(MATERIALS, code="changed") == list(MATERIALS)
    assert rule.run(MATERIALS, code="changed") == []


def test_verdicts_that_cannot_be_read_or_do_not_say_what_they_are_made_from_are_made_anew(rule):
    rule.run(MATERIALS)
    path = rule.folder / "verdicts.nc"
    path.write_bytes(path.read_bytes()[:1000])
    assert rule.run(MATERIALS) == list(MATERIALS)
    datasets.write(datasets.read(path), path, title="verdicts", parameters={})
    assert rule.run(MATERIALS) == list(MATERIALS)
