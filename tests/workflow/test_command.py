"""``python -m stickiness``: from a file of heights to a page, or to a line on what is wrong."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from helpers.copy_workflow import ROOT
from helpers.pages import Page

from stickiness import surface
from stickiness.spectrum import SelfAffine

pytestmark = pytest.mark.workflow

TAPE = ["--modulus", "0.2 MPa", "--work", "60 mJ/m^2"]
SIZE = ["--length", "2 mm", "--height-unit", "um"]
RESULTS = Path("stickiness-results/results/draft")


def run(folder, *arguments, scripts=ROOT / "scripts"):
    """The command in a folder: exit status, lines of the answer, and lines of errors."""
    command = [sys.executable, "-m", "stickiness", *map(str, arguments)]
    environment = os.environ | {"PYTHONPATH": str(scripts)}
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True)
    return done.returncode, done.stdout.splitlines(), done.stderr.splitlines()


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder whose name has a blank, with a wall and a soft tape of an improbable range."""
    folder = tmp_path_factory.mktemp("any folder")
    rough = SelfAffine(hurst=0.8, q0=2 * np.pi / 1e-3, q1=2 * np.pi / 64e-6, h_rms=20e-6)
    np.save(folder / "wall#1.npy", 1e6 * surface.synthesise(rough, 128, 2e-3, seed=3))
    tape = 'label: soft tape, youngs_modulus: "1 kPa", poisson_ratio: 0.5, source: own, '
    tape += 'work_of_adhesion: "60 mJ/m^2", range: "0.3 um"'
    (folder / "tape.yaml").write_text(f"materials:\n  tape: {{{tape}}}\n", encoding="utf-8")
    return folder


@pytest.fixture(scope="module")
def first(folder):
    return run(folder, "wall#1.npy", *TAPE, *SIZE)


def test_page_and_answer_from_relative_paths(folder, first):
    code, answer, errors = first
    page = folder / RESULTS / "report/surfaces/wall_1.html"
    assert (code, errors) == (0, [])
    assert answer[0].startswith(("The material ", "For the material "))
    assert answer[-1] == f"Page: {page.relative_to(folder)}"
    assert {path.name for path in folder.iterdir()} == {"wall#1.npy", "tape.yaml", RESULTS.parts[0]}
    shown = Page(page.read_text(encoding="utf-8"))
    shown.check("E = 0.2 MPa", "measured · wall#1.npy", answer[0])
    local = [link for link in shown.links if not link.startswith(("#", "https://doi.org/"))]
    assert len(local) > 3
    assert [link for link in local if not (page.parent / link).exists()] == []


def test_another_tape_repeats_the_verdict_alone(folder, first):
    analysed = folder / RESULTS / "real_surfaces/wall_1.nc"
    before = analysed.stat().st_mtime_ns
    code, answer, errors = run(folder, "wall#1.npy", "--tape", "tape.yaml", *SIZE)
    assert (code, errors) == (0, [])
    assert answer[0].startswith("Soft tape: range = 0.3 µm is improbable: molecules attract over")
    assert answer[1].startswith("Soft tape sticks fully: ")
    assert analysed.stat().st_mtime_ns == before


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        (["wall.npy", *TAPE], "wall.npy: no such file"),
        ([".", *TAPE], ".: a folder; give a file"),
        (["wall#1.npy", "--tape", "no.yaml"], "no.yaml: no such file"),
        (["wall#1.npy", *TAPE, "--tape", "a"], "--tape describes the material: leave out --mod"),
        (["wall#1.npy", "--modulus", "1 MPa"], 'give --modulus "0.2 MPa" and --work "60 mJ/m^2"'),
        (["wall#1.npy", *TAPE, "--modulos", 1], "unrecognized arguments: --modulos 1"),
        (["wall#1.npy", *TAPE, "--output", "."], "--output . holds something else; give a new"),
        (["wall#1.npy", *TAPE, "--work", "60 J/m^2"], "--work '60 J/m^2' must be in 1e-06 … 10 "),
        (["wall#1.npy", *TAPE, "--length", 2], "--length 2 has no unit: a length is wanted"),
        (["wall#1.npy", *TAPE, "--backing", "slip"], "--backing 'slip' belongs to a layer: give "),
        (["wall#1.npy", "--tape", "wall#1.npy"], "wall#1.npy: cannot be read as YAML: it is no"),
        (
            ["wall#1.npy", *TAPE],
            "wall#1.npy: the file does not tell its size or the unit of height; give --length (or "
            "--pixel-size) and --height-unit",
        ),
        (["tape.yaml", *TAPE, *SIZE], "tape.yaml: no line of numbers found; "),
    ],
)
def test_errors_are_one_line_in_terms_of_the_command(folder, arguments, line):
    code, answer, errors = run(folder, *arguments)
    assert (code, answer, len(errors)) == (1, [], 1), errors
    assert errors[0].startswith(f"stickiness: {line}")


def test_the_library_alone_says_what_it_lacks(tmp_path):
    shutil.copytree(ROOT / "scripts/stickiness", tmp_path / "site/stickiness")
    code, _, errors = run(tmp_path, "wall.txt", *TAPE, scripts=tmp_path / "site")
    assert (code, len(errors)) == (1, 1)
    assert "the library without the workflow" in errors[0]


def test_a_file_that_tells_all_needs_no_more_and_its_choice_is_told(folder):
    heights = np.load(folder / "wall#1.npy")
    places = {axis: (axis, np.linspace(0, 2, 128), {"units": "mm"}) for axis in "xy"}
    both = xr.Dataset({"z": (("x", "y"), heights, {"units": "um"}), "line": ("x", heights[0])})
    both.assign_coords(places).to_netcdf(folder / "told.nc")
    code, answer, errors = run(folder, "told.nc", *TAPE)
    assert (code, errors) == (0, [])
    assert "This page shows told.nc: z; there is also line." in answer[-2]
    assert answer[-2].endswith("for an instrument’s file, or --variable for NetCDF or npz.")
    assert answer[-1] == f"Page: {RESULTS}/report/surfaces/told.html"


def test_the_help_fits_a_hundred_columns_and_its_values_have_units(folder):
    _, lines, _ = run(folder, "--help")
    assert max(map(len, lines)) <= 100
    values = re.findall(r'"(\d[^"]*)"', "\n".join(lines))
    assert len(values) > 10
    assert all(re.match(r"[\d.]+ [a-zA-Z]", value) for value in values)
