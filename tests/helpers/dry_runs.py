"""Dry-runs without Snakemake's start, which takes longer than most of them."""

import atexit
import json
import os
import re
import subprocess
import sys
import tempfile
from functools import cache
from pathlib import Path


@cache
def server():
    command = [sys.executable, Path(__file__).with_name("serve_snakemake.py")]
    started = subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, encoding="utf-8"
    )
    atexit.register(started.communicate)  # which ends it
    return started


def dry_run(folder, *arguments):
    """``snakemake -n`` in a folder to its end; output and errors together."""
    command = ["-n", "-j2", *map(str, arguments)]
    with tempfile.NamedTemporaryFile("r", encoding="utf-8") as output:
        order = (str(folder), command, dict(os.environ), output.name)
        names = ("folder", "arguments", "environment", "output")
        server().stdin.write(json.dumps(dict(zip(names, order, strict=True))) + "\n")
        server().stdin.flush()
        code = int(server().stdout.readline())
        return subprocess.CompletedProcess(command, code, output.read())


def outputs(done):
    """Files by rule that a dry-run lists in full, below the folder of a fidelity."""
    assert done.returncode == 0, done.stdout
    found = {}
    for rule, paths in re.findall(
        r"^(?:local)?rule (\w+):\n(?:    \w+: .*\n)*?    output: (.*)$", done.stdout, re.M
    ):
        names = [path.split("/", 2)[2] for path in paths.split(", ")]
        found.setdefault(rule, set()).update(names)
    return found


def jobs(done):
    """Jobs by rule in the table of a dry-run."""
    assert done.returncode == 0, done.stdout
    table = re.search(r"^job\s+count\n[-\s]+\n(.*?)^total", done.stdout, re.M | re.S)
    if table is None:
        assert "Nothing to be done" in done.stdout, done.stdout
        return {}
    return {rule: int(count) for rule, count in map(str.split, table[1].strip().splitlines())}
