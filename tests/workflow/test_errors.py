"""Bad configuration stops the workflow before any job, in one line and with nothing written."""

import pytest

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
    assert only_line(fresh.snakemake()) == (
        "config/materials.yaml: materials.crystal.plane_strain_modulus = '-1 GPa' must be positive"
    )
    assert not (fresh / "results").exists()


def test_a_target_of_another_fidelity_gets_a_hint(fresh):
    line = only_line(fresh.dry_run("results/draft/report/report.html"))
    assert line.endswith("is of fidelity draft, this run of tiny: add --config fidelity=draft")
