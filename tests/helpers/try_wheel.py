"""Build both packages, check them for an index, and judge the example with the installed wheel.

The wheel is made from the sources, and installed in an empty environment.
"""

import os
import re
import subprocess
import sys
import tempfile
import zipfile
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


def check_page(wheel):
    """End if the page of the package leads to files that an index does not have."""
    with zipfile.ZipFile(wheel) as contents:
        (metadata,) = [name for name in contents.namelist() if name.endswith("/METADATA")]
        page = contents.read(metadata).decode()
    if "pip install stickiness\npython -m stickiness --example" not in page:
        sys.exit("the page of the package does not tell how to install it")
    relative = re.findall(r"\]\((?!https://)[^)]*\)", page)
    if relative:
        sys.exit(f"the page of the package leads to files: {', '.join(relative)}")


def main():
    """Print the verdict of the example, made by the installed package."""
    with tempfile.TemporaryDirectory() as folder:
        packages = Path(folder, "packages")
        run(sys.executable, "-m", "build", "--outdir", packages, PROJECT, folder=folder)
        (sources,) = packages.glob("*.tar.gz")
        (wheel,) = packages.glob("*.whl")
        run(sys.executable, "-m", "twine", "check", "--strict", sources, wheel, folder=folder)
        check_page(wheel)
        run(sys.executable, "-m", "venv", "empty", folder=folder)
        programs = Path(folder, "empty/bin")
        versions = ("--constraint", PROJECT / "envs/constraints.txt")
        quiet = ("--quiet", "--disable-pip-version-check", "--no-compile")
        pip = (programs / "python", "-m", "pip", "install", *quiet, *versions)
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
