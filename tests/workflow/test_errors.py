"""Bad configuration stops the workflow before any job, in one line and with nothing written."""

import pytest

pytestmark = pytest.mark.workflow


def test_stops_before_any_job(fresh):
    fresh.edit(
        "config/materials.yaml", 'plane_strain_modulus: "100 GPa"', 'plane_strain_modulus: "-1 GPa"'
    )
    done = fresh.snakemake()
    assert done.returncode != 0
    message = (
        "config/materials.yaml: materials.crystal.plane_strain_modulus = '-1 GPa' must be positive"
    )
    assert message in done.stdout
    assert "Traceback" not in done.stdout
    assert not (fresh / "results").exists()


def test_a_target_of_another_fidelity_gets_a_hint(fresh):
    done = fresh.snakemake("-n", "results/draft/report/report.html")
    assert done.returncode != 0
    assert "is of fidelity draft, this run of tiny: add --config fidelity=draft" in done.stdout
