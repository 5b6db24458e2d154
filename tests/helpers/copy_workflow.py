"""Copy the workflow, with its tiny configuration, into a folder: copy_workflow.py FOLDER."""

import shutil
import sys
from pathlib import Path

import yaml

ROOT = Path(__file__).parents[2]
# Real surfaces that claims need, one by its spectrum and one by its heights.
SURFACES = ("asphalt", "polished_steel", "uncd_diamond")
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
    surfaces = yaml.safe_load((ROOT / "config/surfaces.yaml").read_text(encoding="utf-8"))
    few = {"surfaces": {name: surfaces["surfaces"][name] for name in SURFACES}}
    (folder / "config/tiny_surfaces.yaml").write_text(yaml.safe_dump(few), encoding="utf-8")


if __name__ == "__main__":
    target = Path(sys.argv[1])
    target.mkdir(parents=True)
    copy_workflow(target)
