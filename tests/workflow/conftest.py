"""The workflow in a folder, driven through its command line, and one complete run at tiny size."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from helpers import served
from helpers.copy_workflow import ROOT, copy_code, copy_workflow
from helpers.dry_runs import dry_run, jobs, outputs
from helpers.windows import AS_ON_WINDOWS

TINY = ["--configfile", "config/config.yaml", "config/tiny.yaml"]


class Workflow:
    """A copy of the workflow, with its tiny configuration."""

    def __init__(self, folder):
        self.folder = Path(folder)

    def __truediv__(self, path):
        return self.folder / path

    def command(self, *arguments):
        return [sys.executable, "-m", "snakemake", "-j2", *arguments, *TINY]

    def start(self, *arguments, **options):
        """A process that runs; output and errors together."""
        return subprocess.Popen(
            self.command(*arguments),
            cwd=self.folder,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            **options,
        )

    def snakemake(self, *arguments, **environment):
        """Run to the end."""
        words = ["-j2", *arguments, *TINY]
        return served.run("snakemake", self.folder, *words, together=True, **environment)

    def python(self, *words):
        """Run Python with the modules of this project."""
        environment = os.environ | {"PYTHONPATH": str(ROOT / "scripts")}
        options = {"cwd": self.folder, "env": environment, "capture_output": True, "text": True}
        return subprocess.run([sys.executable, *words], **options, check=False)

    def dry_run(self, *arguments):
        return dry_run(self.folder, *arguments, *TINY)

    def planned(self, *arguments):
        """Number of jobs by rule that a dry-run lists, without the target rules."""
        listed = jobs(self.dry_run(*arguments, "--quiet", "host", "rules", "reason"))
        return {rule: count for rule, count in listed.items() if rule not in ("all", *arguments)}

    def outputs(self, *arguments):
        """Files by rule that a dry-run lists."""
        return outputs(self.dry_run(*arguments))

    def edit(self, path, old, new):
        """Replace a text, which must be there, in a file of this copy."""
        if path.startswith("scripts/"):
            copy_code(self.folder)
        file = self / path
        text = file.read_text(encoding="utf-8")
        assert old in text, f"{old!r} is not in {path}"
        file.write_text(text.replace(old, new), encoding="utf-8")

    def add(self, text, path="config/tiny.yaml"):
        """Add lines to a file of this copy, by default to its configuration."""
        with (self / path).open("a", encoding="utf-8") as file:
            file.write(text)


@pytest.fixture
def fresh(tmp_path):
    """The workflow with nothing computed."""
    copy_workflow(tmp_path)
    return Workflow(tmp_path)


@pytest.fixture(scope="session")
def finished(tmp_path_factory):
    """The workflow after a complete run, one for all processes of tests; not to be changed.

    Its scripts run as on Windows, without modules of POSIX or an encoding of the locale.
    """
    import fcntl  # here, so that other tests are found where there is none

    base = tmp_path_factory.getbasetemp()
    shared = (base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / "finished"
    with shared.with_suffix(".lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        workflow, said = Workflow(shared), shared.with_suffix(".json")
        if not said.exists():
            shared.mkdir()
            copy_workflow(shared)
            run = workflow.snakemake(**AS_ON_WINDOWS)
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
