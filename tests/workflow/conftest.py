"""A copy of the workflow in a folder of its own, run once at tiny size."""

import re
import subprocess
import sys
from pathlib import Path

import pytest
from helpers.copy_workflow import copy_workflow

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

    def planned(self, *arguments):
        """Rules and number of jobs that a dry-run lists, without the target rules."""
        done = self.snakemake("-n", *arguments, "--quiet", "host")
        assert done.returncode == 0, done.stdout
        table = re.search(r"^job\s+count\n[-\s]+\n(.*?)^total", done.stdout, re.M | re.S)
        if table is None:
            assert "Nothing to be done" in done.stdout, done.stdout
            return {}
        jobs = dict(line.split() for line in table[1].strip().splitlines())
        return {rule: int(count) for rule, count in jobs.items() if rule != "all"}

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
    """The workflow after a complete run; not to be changed."""
    workflow = copied(tmp_path_factory.mktemp("finished"))
    workflow.run = workflow.snakemake()
    assert workflow.run.returncode == 0, workflow.run.stdout
    return workflow


@pytest.fixture
def copy_of_finished(finished, tmp_path):
    """A copy of the finished workflow, results and records included, that may be changed."""
    subprocess.run(["cp", "-a", f"{finished.folder}/.", tmp_path], check=True)
    return Workflow(tmp_path)
