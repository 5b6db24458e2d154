"""Run the commands of docs/tutorial.md as they stand there, in a fresh clone, and time them.

    python docs/walk_tutorial.py FOLDER

FOLDER must not exist. The project is cloned there from its last commit.
"""

from __future__ import annotations

import re
import resource
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).parents[1]


def steps(text: str) -> list[tuple[str, str]]:
    """Headings of the tutorial, each with its commands."""
    sections = re.split(r"^## ", text, flags=re.M)[1:]
    return [
        (section.splitlines()[0], "\n".join(re.findall(r"^```\n(.*?)^```", section, re.M | re.S)))
        for section in sections
    ]


def main() -> None:
    """Clone the project, run every step, and print how long it took."""
    folder = Path(sys.argv[1]).resolve()
    if folder.exists():
        sys.exit(f"{folder} is there already: name a new folder")
    clone = f"git clone -q {ROOT} {folder}"
    tutorial = steps((ROOT / "docs/tutorial.md").read_text(encoding="utf-8"))
    print(f"{'on the clock':>12} {'processor':>10}")
    timed("Clone", clone, ROOT)
    activate = ""
    for heading, commands in tutorial:
        if commands:
            timed(heading, activate + commands, folder)
            activate = "source .venv/bin/activate\n"  # each step is a shell of its own


def timed(heading: str, commands: str, folder: Path) -> None:
    """Run commands in bash and print how long they took; stop if one fails."""
    begin, before = time.monotonic(), processor_seconds()
    done = subprocess.run(
        ["bash", "-ec", commands],
        cwd=folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    if done.returncode:
        sys.exit(f"{heading}: failed\n{commands}\n{done.stdout}")
    took = time.monotonic() - begin, processor_seconds() - before
    print(f"{took[0]:10.0f} s {took[1]:8.0f} s  {heading}", flush=True)


def processor_seconds() -> float:
    """Processor time of all commands that have ended [s]."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


if __name__ == "__main__":
    main()
