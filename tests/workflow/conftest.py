"""A copy of the workflow in a folder of its own, run once at tiny size."""

import fcntl
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from helpers.copy_workflow import copy_workflow
from helpers.dry_runs import dry_run, jobs

TINY = ["--configfile", "config/config.yaml", "config/tiny.yaml"]


class Workflow:
    """The workflow in a folder, driven through its command line."""

    def __init__(self, folder):
        self.folder = Path(folder)

    def __truediv__(self, path):
        return self.folder / path

    def command(self, *arguments):
        return [sys.executable, "-m", "snakemake", "-j2", *arguments]

    def snakemake(self, *arguments):
        """Run to the end; output and errors together."""
        return subprocess.run(
            self.command(*arguments, *TINY),
            cwd=self.folder,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=3600,  # minutes on a quiet machine
            check=False,
        )

    def dry_run(self, *arguments):
        return dry_run(self.folder, *arguments, *TINY)

    def planned(self, *arguments):
        """Rules and number of jobs that a dry-run lists, without the target rules."""
        listed = jobs(self.dry_run(*arguments, "--quiet", "host", "rules", "reason"))
        return {rule: count for rule, count in listed.items() if rule != "all"}

    def edit(self, path, old, new):
        """Replace a text in a file of this copy, which must be there."""
        file = self / path
        text = file.read_text(encoding="utf-8")
        assert old in text, f"{old!r} is not in {path}"
        file.write_text(text.replace(old, new), encoding="utf-8")


def copied(folder):
    copy_workflow(folder)
    return Workflow(folder)


@pytest.fixture
def fresh(tmp_path):
    """The workflow with nothing computed."""
    return copied(tmp_path)


@pytest.fixture(scope="session")
def finished(tmp_path_factory):
    """The workflow after a complete run, one for all processes of tests; not to be changed."""
    base = tmp_path_factory.getbasetemp()
    shared = (base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / "finished"
    with shared.with_suffix(".lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        workflow, said = Workflow(shared), shared.with_suffix(".json")
        if not said.exists():
            shared.mkdir()
            run = copied(shared).snakemake()
            said.write_text(json.dumps([run.returncode, run.stdout]), encoding="utf-8")
    code, stdout = json.loads(said.read_text(encoding="utf-8"))
    assert code == 0, stdout
    workflow.run = subprocess.CompletedProcess(workflow.command(), code, stdout)
    return workflow


@pytest.fixture
def copy_of_finished(finished, tmp_path):
    """A copy of the finished workflow, results and records included, that may be changed."""
    subprocess.run(["cp", "-a", f"{finished.folder}/.", tmp_path], check=True)
    return Workflow(tmp_path)
