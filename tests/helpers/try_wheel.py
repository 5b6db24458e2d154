"""Build the wheel, install it in an empty environment, and judge the example with it."""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

PROJECT = Path(__file__).parents[2]


def run(*command, folder):
    """Run a command away from the project, and return what it prints."""
    environment = {name: text for name, text in os.environ.items() if name != "PYTHONPATH"}
    done = subprocess.run(
        [*map(str, command)], cwd=folder, env=environment, capture_output=True, text=True
    )
    if done.returncode:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done.stdout


def main():
    """Print the verdict of the example, made by the installed package."""
    with tempfile.TemporaryDirectory() as folder:
        quiet = ("--quiet", "--disable-pip-version-check")
        run(sys.executable, "-m", "pip", "wheel", *quiet, "--no-deps", PROJECT, folder=folder)
        (wheel,) = Path(folder).glob("*.whl")
        run(sys.executable, "-m", "venv", "empty", folder=folder)
        programs = Path(folder, "empty/bin")
        versions = ("--constraint", PROJECT / "envs/constraints.txt")
        pip = (programs / "python", "-m", "pip", "install", *quiet, "--no-compile", *versions)
        run(*pip, wheel, folder=folder)
        place = run(
            programs / "python",
            "-c",
            "import stickiness; print(*stickiness.__path__)",
            folder=folder,
        )
        if str(PROJECT) in place:
            sys.exit(f"the package in {place.strip()} is that of the project, not of the wheel")
        print(run(programs / "stickiness", "--example", folder=folder).strip())
        (page,) = Path(folder, "stickiness-results").glob("*.html")
        if "does not stick" not in page.read_text(encoding="utf-8"):
            sys.exit(f"{page.name} has no verdict")


if __name__ == "__main__":
    main()
