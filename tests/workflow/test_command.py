"""``python -m stickiness``: from a file of heights to a verdict and a page, or to an error."""

import errno
import json
import ntpath
import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple
from urllib.parse import unquote

import numpy as np
import pytest
import xarray as xr
from helpers import served
from helpers.copy_workflow import ROOT
from helpers.pages import Page
from helpers.windows import AS_ON_WINDOWS

import stickiness
from stickiness import datasets
from stickiness.command import claim_name, name_page
from stickiness.formatting import relative_path
from stickiness.spectrum import SelfAffine
from stickiness.verdicts.verdict import StickinessVerdict

pytestmark = [pytest.mark.workflow, pytest.mark.usefixtures("coarse_simulation")]

TAPE = ["--modulus", "0.2 MPa", "--work", "60 mJ/m^2"]
SIZE = ["--length", "2 mm", "--height-unit", "um"]
RESULTS = Path("stickiness-results")
STARTS = 12  #: of Python with its libraries, that a verdict may take in processor time; it takes 5
CACHES = ("XDG_CACHE_HOME", "HOME", "NUMBA_CACHE_DIR", "MPLCONFIGDIR")
LIBRARIES = "import numpy, scipy.optimize, xarray, netCDF4"


class Answer(NamedTuple):
    """What the command answers."""

    status: int
    lines: list[str]
    errors: list[str]


def run(folder, *arguments, **environment):
    """Run the command in a folder, with contact simulated on a coarse grid."""
    done = served.run("stickiness", folder, *arguments, **environment)
    return Answer(done.returncode, done.stdout.splitlines(), done.stderr.splitlines())


def run_alone(folder, *arguments, scripts=ROOT / "scripts", timeout=None, **environment):
    """Run the command in a folder, as a user does."""
    command = [sys.executable, "-m", "stickiness", *map(str, arguments)]
    environment = os.environ | {"PYTHONPATH": str(scripts)} | environment
    done = subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, text=True, timeout=timeout
    )
    return Answer(done.returncode, done.stdout.splitlines(), done.stderr.splitlines())


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder whose name has a blank, with a wall and a soft tape of an improbable range.

    Of the wall, a map of fewer points is as well, for commands in processes of their own.
    """
    folder = tmp_path_factory.mktemp("any folder")
    rough = SelfAffine(hurst=0.8, q0=2 * np.pi / 1e-3, q1=2 * np.pi / 64e-6, h_rms=20e-6)
    heights = stickiness.surface.synthesise(rough, 128, 2e-3, seed=3)
    np.save(folder / "wall#1.npy", 1e6 * heights)
    np.save(folder / "wall#2.npy", 1e6 * heights[::2, ::2])
    tape = 'label: soft tape, youngs_modulus: "1 kPa", poisson_ratio: 0.5, '
    tape += 'work_of_adhesion: "60 mJ/m^2", range: "0.3 um", source: own'
    (folder / "tape.yaml").write_text(f"materials:\n  tape: {{{tape}}}\n", encoding="utf-8")
    return folder


@pytest.fixture(scope="module")
def verdict(folder, coarse_simulation):
    """The verdict of the library on the same pair, on the same coarse grid."""
    options = {"length": "2 mm", "height_unit": "um"}
    wall = stickiness.Surface.read(folder / "wall#1.npy", **options)
    return stickiness.verdict(wall, youngs_modulus=2e5, work_of_adhesion=0.06, range=3e-10)


def test_the_answer_is_that_of_the_library(folder, verdict):
    answer = run(folder, "wall#1.npy", *TAPE, *SIZE, "--no-page")
    assert (answer.status, answer.errors) == (0, [])
    assert answer.lines == f"The material: {verdict}".splitlines()
    assert not (folder / RESULTS).exists()


def test_the_first_block_of_the_readme_gives_the_verdict_shown_there(tmp_path):
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    *_, command = re.search("```\n(.*?)\n```", readme, re.S)[1].splitlines()
    shown = re.search("```text\n(.*?)\n```", readme, re.S)[1].splitlines()
    python, module, name, *arguments = shlex.split(command)
    assert (python, module, name) == ("python", "-m", "stickiness")
    answer = run_alone(tmp_path, *arguments, "--no-page")
    assert (answer.status, answer.errors, answer.lines[1:]) == (0, [], shown)
    # The first line is a command that says the same without the option.
    _, spelt_out = answer.lines[0].split("python -m stickiness ")
    assert "--example" not in spelt_out
    assert run_alone(tmp_path, *shlex.split(spelt_out)).lines == shown
    assert os.listdir(tmp_path) == ["example_wall.txt"]


def test_the_example_takes_another_material_and_leaves_a_file_alone(folder, tmp_path):
    shutil.copy(folder / "wall#1.npy", tmp_path / "example_wall.txt")
    answer = run(tmp_path, "--example", "--modulus", "1 kPa", "--work", "60 mJ/m^2", "--no-page")
    assert (answer.status, answer.lines[0].count("--modulus")) == (0, 1)
    assert (tmp_path / "example_wall.txt").read_bytes() == (folder / "wall#1.npy").read_bytes()


def test_a_common_material_stands_for_its_values_and_a_ball_has_a_force(folder):
    arguments = ["wall#1.npy", *SIZE, "--no-page", "--json", "--radius", "1 mm"]
    common = run(folder, *arguments, "--material", "pdms", "--poisson", "0.4")
    values = ["--modulus", "0.7 MPa", "--work", "40 mJ/m^2", "--poisson", "0.4"]
    assert common == run(folder, *arguments, *values)
    force = json.loads("\n".join(common.lines))["ball"]["smooth_pull_off_force"]
    assert force["value"] == pytest.approx(1.5 * np.pi * 40e-3 * 1e-3, rel=2e-3)  # JKR
    told = run(folder, *[each for each in arguments if each != "--json"], "--material", "pdms")
    assert told.status == 0
    assert [line for line in told.lines if line.startswith("pull-off force of a ball")]


def test_the_common_materials_are_listed_with_their_values(folder):
    answer = run(folder, "--materials")
    assert (answer.status, answer.errors, len(answer.lines)) == (0, [], 12)
    (line,) = [line for line in answer.lines if line.startswith("steel ")]
    for value in ("210 GPa", "0.3", "100 mJ/m^2", "0.3 nm", "Johnson"):
        assert value in line


def test_the_version_is_one_line(folder):
    answer = run(folder, "--version")
    assert (answer.status, answer.errors, len(answer.lines)) == (0, [], 1)
    assert answer.lines[0].startswith(f"stickiness {stickiness.__version__} ")


def test_several_materials_are_a_list_with_their_names(folder):
    materials = (folder / "tape.yaml").read_text(encoding="utf-8")
    second = materials.splitlines()[1].replace("tape", "gel")
    (folder / "two.yaml").write_text(f"{materials}{second}\n", encoding="utf-8")
    arguments = ["wall#1.npy", "--tape", "two.yaml", *SIZE, "--no-page", "--json"]
    contents = json.loads("\n".join(run(folder, *arguments).lines))
    assert [entry["material"] for entry in contents] == ["soft tape", "soft gel"]


def processor_time(command):
    """Processor time [s] of a command in a process of its own."""
    import resource

    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    command()
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def test_a_verdict_takes_a_few_seconds_of_processor_time(folder):
    """Over the start of Python with its libraries, which is as slow on a busy or an old machine."""
    arguments = ["wall#1.npy", *TAPE, *SIZE, "--no-page"]
    run_alone(folder, *arguments)  # the first run compiles
    start = [sys.executable, "-c", LIBRARIES]
    started = processor_time(lambda: subprocess.run(start, check=True))
    assert processor_time(lambda: run_alone(folder, *arguments)) < STARTS * started


@pytest.fixture(scope="module")
def first(folder):
    return run(folder, "wall#1.npy", *TAPE, *SIZE)


def test_page_and_answer_from_relative_paths(folder, first, verdict):
    page = folder / RESULTS / "wall#1.html"
    assert (first.status, first.errors) == (0, [])
    assert first.lines[:-1] == f"The material: {verdict}".splitlines()
    assert first.lines[-1] == f"Page: {page.relative_to(folder)}"
    shown = Page(page.read_text(encoding="utf-8"))
    assert str(folder) not in page.read_text(encoding="utf-8")
    local = [unquote(link) for link in shown.links if not link.startswith(("#", "https:"))]
    assert len(local) > 1
    assert [link for link in local if not (page.parent / link).exists()] == []


def test_terminal_page_and_files_give_one_number(folder, first, verdict):
    """Verdict, share, pull-off and threshold, each as one text and one number."""
    shown = Page((folder / RESULTS / "wall#1.html").read_text(encoding="utf-8"))
    remaining, _, pull_off, threshold = first.lines[:4]
    shown.check(
        remaining.partition(": ")[2].partition(": ")[2],
        pull_off.partition(": ")[2],
        threshold,
        "E = 200 kPa, ν = 0.5",
    )
    stored = datasets.read(folder / RESULTS / "wall#1/verdicts.nc").squeeze()
    assert StickinessVerdict(stored).to_dict() == verdict.to_dict()


def test_two_files_of_one_name_have_a_page_each(folder, tmp_path):
    heights = np.load(folder / "wall#1.npy")
    for name, factor in (("one/wall.npy", 1.0), ("two/wall.npy", 2.0)):
        (tmp_path / name).parent.mkdir()
        np.save(tmp_path / name, factor * heights)
    arguments = ["--tape", folder / "tape.yaml", *SIZE]
    pages = [
        run(tmp_path, name, *arguments).lines[-1]
        for name in ("one/wall.npy", "two/wall.npy", "one/wall.npy")
    ]
    first, second = (f"Page: {RESULTS}/{name}.html" for name in ("wall", "wall-2"))
    assert pages == [first, second, first]
    kept = [datasets.read(tmp_path / RESULTS / f"{name}/surface.nc") for name in ("wall", "wall-2")]
    assert float(kept[1].h_rms_measured) == pytest.approx(2 * float(kept[0].h_rms_measured))


def test_another_tape_replaces_the_page(folder, first):
    answer = run(folder, "wall#1.npy", "--tape", "tape.yaml", *SIZE)
    assert (answer.status, answer.errors) == (0, [])
    assert answer.lines[0].startswith("Soft tape: sticks fully: ")
    assert answer.lines[-1] == first.lines[-1]
    (doubt,) = [line for line in answer.lines if line.startswith("warning: range")]
    page = Page((folder / RESULTS / "wall#1.html").read_text(encoding="utf-8"))
    page.check(f"Soft tape: {doubt.removeprefix('warning: ')}")


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        (["wall.npy", *TAPE], "wall.npy: no such file"),
        ([".", *TAPE], ".: a folder; give a file"),
        (["wall#1.npy", "--tape", "no.yaml"], "no.yaml: no such file"),
        (["wall#1.npy", *TAPE, "--tape", "a"], "--tape describes the material"),
        (["wall#1.npy", "--modulus", "1 MPa"], 'give --modulus "0.2 MPa" and --work "60 mJ/m^2"'),
        (["wall#1.npy", *TAPE, "--modulos", 1], "unrecognized arguments: --modulos 1"),
        (
            ["wall#1.npy", *TAPE, "--lenght", "2 mm"],
            "unrecognized arguments: --lenght 2 mm; did you mean --length?",
        ),
        (["wall#1.npy", *TAPE, *SIZE, "--output", "tape.yaml/out"], "--output tape.yaml/out: tape"),
        (["wall#1.npy", *TAPE, "--work", "60 J/m^2"], "--work '60 J/m^2': "),
        (["wall#1.npy", "--material", "stel"], "--material 'stel': "),
        (["wall#1.npy", *TAPE, "--radius", "1"], "--radius '1' "),
        (["wall#1.npy", *TAPE, "--length", 2], "--length 2: "),
        (["wall#1.npy", *TAPE, "--detrend", "cubic"], "--detrend 'cubic': "),
        (["wall#1.npy", *TAPE, "--backing", "slip"], "--backing 'slip': "),
        (["wall#1.npy", "--tape", "wall#1.npy"], "wall#1.npy: cannot be read as YAML: it is no"),
        (["wall#1.npy", *TAPE], "wall#1.npy: "),  # of unknown size
        (["tape.yaml", *TAPE, *SIZE], "tape.yaml: no line of numbers found"),
        (["wall#1.npy", *TAPE, "--radius", "2,5 mm"], "--radius '2,5 mm' holds a comma, where"),
        # Known before the heights are read, whose size is unknown.
        (
            ["wall#1.npy", *TAPE, "--thickness", "50 um", "--radius", "1 mm"],
            "--radius: the force of a ball needs an infinitely deep material",
        ),
        (["wall#1.npy", *TAPE, "--output", "a", "--no-page"], "--output names the folder of the"),
        (["wall#1.npy", *TAPE, "--max-missing", "-.2"], "--max-missing -0.2: "),
        (
            ["wall#1.npy", *TAPE, "--max-missing", "10 %"],
            "--max-missing '10 %': must be a valid number; did you mean 0.1?",
        ),
        (
            ["wall#1.npy", *TAPE, "--poisson", "0,49"],
            "--poisson '0,49': must be a valid number; did you mean 0.49?",
        ),
        (["wall#1.npy", *TAPE, "--label", ""], "--label '': must not be empty"),
        (["wall#1.npy", *TAPE, "--length", "40x24"], "--length '40': has no unit; a length is"),
        (["/dev/null", *TAPE], "/dev/null: no file of data; give a file"),
    ],
)
def test_errors_are_one_line_in_terms_of_the_command(folder, arguments, line):
    answer = run(folder, *arguments)
    assert (answer.status, answer.lines, len(answer.errors)) == (1, [], 1), answer.errors
    assert answer.errors[0].startswith(f"stickiness: {line}")


#: What a file is called, what the command is told besides, and the label and the page that it has.
PLACES = {
    "terminal without signs": ("wänd 二.txt", [], {"PYTHONIOENCODING": "ascii"}, "wänd 二"),
    "control characters": ("w\x1b[31m\u202e{1}.txt", [], {}, "w[31m{1}"),
    "number as ending": ("scan.001", ["--missing-value", "-3.4e38"], {}, "scan.001"),
    "one unit of two sides": ("w.x", ["--length", "2x2 mm"], {}, "w"),
    "sides in words": ("w.x", ["--length", "2 mm by 2*10^-3 m"], {}, "w"),
    "thousands": ("w.x", ["--length", "2 000 um x 2×10⁻³ m"], {}, "w"),
}


@pytest.mark.parametrize(("name", "arguments", "environment", "page"), PLACES.values(), ids=PLACES)
def test_any_name_terminal_and_number(
    folder, tmp_path, verdict, name, arguments, environment, page
):
    np.savetxt(tmp_path / name, np.load(folder / "wall#1.npy"), fmt="%.17g")
    arguments = [name, *TAPE, *SIZE, *arguments, "--no-page"]
    answer = run(tmp_path, *arguments, **environment)
    assert (answer.status, answer.errors) == (0, [])
    assert answer.lines[0] == f"The material: {verdict}".splitlines()[0]
    failed = run(tmp_path, *arguments, "--format", "netcdf", **environment)
    assert (failed.status, len(failed.errors)) == (1, 1)
    assert not re.search("[\x00-\x1f\u202e]", failed.errors[0])
    contents = json.loads("\n".join(run(tmp_path, *arguments, "--json", **environment).lines))
    assert contents == verdict.to_dict()
    assert name_page(Path(name)) == page


def test_other_files_in_the_folder_of_a_page_are_left_alone(folder, tmp_path):
    (tmp_path / "wall#1").mkdir()
    (tmp_path / "wall#1/notes.txt").write_text("mine")
    answer = run(folder, "wall#1.npy", *TAPE, *SIZE, "--output", tmp_path)
    assert answer.lines[-1] == f"Page: {tmp_path}/wall#1-2.html"
    assert os.listdir(tmp_path / "wall#1") == ["notes.txt"]


def test_the_library_alone_makes_a_page(folder, first, tmp_path):
    """Without the workflow, and where Snakemake cannot be imported."""
    scripts = ROOT / "scripts"
    parts = {path.stem for path in scripts.iterdir()} - {"stickiness"}
    for name in ("snakemake", *parts):
        (tmp_path / f"{name}.py").write_text("raise ImportError('not installed')")
    arguments = ["wall#1.npy", *TAPE, *SIZE, "--output", tmp_path / "out"]
    answer = run_alone(folder, *arguments, scripts=f"{tmp_path}{os.pathsep}{scripts}")
    assert (answer.status, answer.errors) == (0, [])
    assert len(answer.lines) == len(first.lines)
    assert (tmp_path / "out/wall#1.html").exists()


def test_a_file_that_tells_all_needs_no_more(folder):
    heights = np.load(folder / "wall#1.npy")
    places = {axis: (axis, np.linspace(0, 2, 128), {"units": "mm"}) for axis in "xy"}
    both = xr.Dataset({"z": (("x", "y"), heights, {"units": "um"}), "line": ("x", heights[0])})
    both.assign_coords(places).to_netcdf(folder / "told.nc")
    answer = run(folder, "told.nc", *TAPE, "--no-page")
    assert (answer.status, answer.errors, len(answer.lines)) == (0, [], 7)
    assert answer.lines[-1].startswith("This is told.nc: z; the file also holds line")


def test_the_help_fits_a_hundred_columns_and_its_values_have_units(folder):
    lines = run(folder, "--help").lines
    assert max(map(len, lines)) <= 100
    values = re.findall(r'"(\d[^"]*)"', "\n".join(lines))
    assert len(values) > 10
    assert all(re.match(r"[\d.]+ [a-zA-Z]", value) for value in values)


def test_a_page_needs_no_cache(folder, tmp_path):
    arguments = ["wall#2.npy", "--tape", "tape.yaml", *SIZE, "--output", tmp_path]
    answer = run_alone(folder, *arguments, **dict.fromkeys(CACHES, "/proc/nowhere"))
    assert (answer.status, answer.errors) == (0, [])


@pytest.mark.parametrize("encoding", ["cp437", "cp1252", "gbk"])
def test_the_command_runs_as_on_windows(folder, tmp_path, encoding):
    """Without modules of POSIX, in terminals of other encodings, in a folder of any name."""
    output = tmp_path / "größer 厚"
    arguments = ["wall#2.npy", "--tape", "tape.yaml", *SIZE, "--output", output]
    command = [sys.executable, "-m", "stickiness", *map(str, arguments)]
    environment = os.environ | AS_ON_WINDOWS | {"PYTHONIOENCODING": encoding}
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True)
    assert done.returncode == 0, done.stderr
    assert "sticks" in done.stdout.decode(encoding)
    assert sorted(os.listdir(output)) == ["wall#2", "wall#2.html"]


def test_pages_of_two_files_at_once_keep_apart(tmp_path):
    """Whoever comes first has the name, and the same file gets its own page again."""
    names = [claim_name(tmp_path, "wall", f"{folder}/wall.txt") for folder in "ab"]
    assert names == ["wall", "wall-2"]
    assert sorted(os.listdir(tmp_path)) == ["wall", "wall-2"]
    (tmp_path / "other.html").write_text("mine", encoding="utf-8")
    assert claim_name(tmp_path, "other", "c/other.txt") == "other-2"


@pytest.mark.parametrize(
    ("file", "name"), [("aux.txt", "aux_"), ("COM1.x.csv", "COM1.x_"), ("console.txt", "console")]
)
def test_names_of_devices_are_no_names_of_pages(file, name):
    assert name_page(Path(file)) == name


def test_what_lies_on_another_drive_has_its_whole_path(monkeypatch):
    monkeypatch.setattr(os.path, "relpath", lambda *_: ntpath.relpath("D:\\a\\b", "C:\\c"))
    assert relative_path(Path("/a/b"), Path("/c")) == "/a/b"


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="a file that is always full")
def test_a_full_disk_is_one_line(folder):
    arguments = ["wall#2.npy", "--tape", "tape.yaml", *SIZE, "--no-page"]
    command = [sys.executable, "-m", "stickiness", *arguments]
    environment = os.environ | {"PYTHONPATH": str(ROOT / "scripts")}
    with open("/dev/full", "w") as full:
        done = subprocess.run(
            command, cwd=folder, env=environment, stdout=full, stderr=subprocess.PIPE, text=True
        )
    assert done.returncode == 1
    assert done.stderr.splitlines() == [f"stickiness: [Errno 28] {os.strerror(errno.ENOSPC)}"]


def test_a_command_that_failed_can_be_mended(folder, tmp_path):
    """Neither it nor a folder that cannot be written leaves anything behind."""
    output = tmp_path / "page"
    wrong = run(folder, "wall#1.npy", *TAPE, "--length", "2", "--output", output)
    assert wrong.status == 1
    assert not output.exists()
    answer = run(folder, "wall#1.npy", *TAPE, *SIZE, "--output", "/proc/page")
    assert (answer.status, len(answer.errors)) == (1, 1)
    assert answer.errors[0].startswith("stickiness: --output /proc/page")
