"""Bad configuration stops the workflow before any job, in one line and with nothing written."""

import pytest
from helpers.dry_runs import dry_run

pytestmark = pytest.mark.workflow


def only_line(done):
    """The one line of a run that failed, without what Snakemake says of profile and configfiles."""
    assert done.returncode == 1, done.stdout
    said = ("Using workflow specific profile", "Config file ")
    (line,) = [line for line in done.stdout.strip().splitlines() if not line.startswith(said)]
    return line


def test_stops_before_any_job(fresh):
    fresh.edit(
        "config/materials.yaml", 'plane_strain_modulus: "100 GPa"', 'plane_strain_modulus: "-1 GPa"'
    )
    line = only_line(fresh.snakemake())
    assert line.startswith(
        "config/materials.yaml: materials.crystal.plane_strain_modulus = '-1 GPa'"
    )
    assert not (fresh / "results").exists()


TAB = "line 2: not valid YAML: it holds a tab: indent with blanks"
EMPTY = "must hold keys and values, found nothing"
FOLDER = "cannot be read as YAML: Is a directory"


@pytest.mark.parametrize("path", ["config/materials.yaml", "config/config.yaml"])
@pytest.mark.parametrize(
    ("text", "says"), [("a:\n\tb: 1\n", TAB), ("# a\n", EMPTY), (None, FOLDER)]
)
def test_a_file_that_cannot_be_read_is_named(fresh, path, text, says):
    (fresh / path).unlink()
    (fresh / path).mkdir() if text is None else fresh.add(text, path)
    assert only_line(dry_run(fresh.folder)) == f"{path}: {says}"


def test_results_must_be_a_folder(fresh):
    fresh.add("", "results")
    assert only_line(fresh.dry_run()).startswith("results must be a folder: move this file, or")
