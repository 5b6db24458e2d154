"""Copy the workflow, with its tiny configuration, into a folder: copy_workflow.py FOLDER."""

import shutil
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
PARTS = ("Snakefile", "rules", "scripts", "config", "envs", "profiles", "report")


def copy_workflow(folder):
    for part in PARTS:
        if (ROOT / part).is_dir():
            ignore = shutil.ignore_patterns("__pycache__")
            shutil.copytree(ROOT / part, folder / part, ignore=ignore)
        else:
            shutil.copy2(ROOT / part, folder / part)
    for entry in ROOT.iterdir():  # whatever the configuration may name, such as data
        hidden = entry.name.startswith(".") or entry.name in (*PARTS, "results")
        if entry.is_dir() and not hidden:
            (folder / entry.name).symlink_to(entry)
    shutil.copy2(ROOT / "tests/workflow/tiny.yaml", folder / "config/tiny.yaml")


if __name__ == "__main__":
    target = Path(sys.argv[1])
    target.mkdir(parents=True)
    copy_workflow(target)
