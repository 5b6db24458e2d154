"""Dry-runs without Snakemake's start, which takes longer than most of them."""

import re

from helpers import served


def dry_run(folder, *arguments):
    """``snakemake -n`` in a folder to its end; output and errors together."""
    return served.run("snakemake", folder, "-n", "-j2", *arguments, together=True)


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
