"""The proof on a real Slurm (run.sh), where it is wanted: it starts daemons and takes minutes."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest


@pytest.mark.workflow
@pytest.mark.skipif("SLURM_PROOF" not in os.environ, reason="set SLURM_PROOF=1: needs root, 10 min")
@pytest.mark.skipif(shutil.which("slurmctld") is None, reason="Slurm is not installed (slurm-wlm)")
def test_run_survives_a_failed_node_and_equals_a_local_one():
    script = Path(__file__).parent / "run.sh"
    done = subprocess.run([script], text=True, capture_output=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "PASSED" in done.stdout
