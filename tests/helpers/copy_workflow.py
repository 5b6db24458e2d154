"""Copy the workflow, with its tiny configuration, into a folder: copy_workflow.py FOLDER.

The code is linked to, so that the copy uses loops that are compiled already.
"""

import shutil
import sys
from pathlib import Path

import yaml

ROOT = Path(__file__).parents[2]
# What claims need: real surfaces, one by its spectrum and one by its heights, and an experiment.
FEW = {
    "surfaces": ("asphalt", "polished_steel", "uncd_diamond"),
    "experiments": ("dahlquist", "fuller_tabor"),
}
PARTS = ("Snakefile", "rules", "config", "envs", "profiles", "report")


def copy_workflow(folder):
    for part in PARTS:
        copy = shutil.copytree if (ROOT / part).is_dir() else shutil.copy2
        copy(ROOT / part, folder / part)
    for entry in ROOT.iterdir():  # code, and whatever the configuration may name
        hidden = entry.name.startswith(".") or entry.name in (*PARTS, "results")
        if entry.is_dir() and not hidden:
            (folder / entry.name).symlink_to(entry)
    shutil.copy2(ROOT / "tests/workflow/tiny.yaml", folder / "config/tiny.yaml")
    for kind, names in FEW.items():
        entries = yaml.safe_load((ROOT / f"config/{kind}.yaml").read_text(encoding="utf-8"))[kind]
        few = yaml.safe_dump({kind: {name: entries[name] for name in names}})
        (folder / f"config/tiny_{kind}.yaml").write_text(few, encoding="utf-8")


def copy_code(folder):
    """Put a copy in the place of the link, for tests that change the code."""
    code = folder / "scripts"
    if code.is_symlink():
        code.unlink()
        ignore = shutil.ignore_patterns("__pycache__")
        shutil.copytree(ROOT / "scripts", code, ignore=ignore)


if __name__ == "__main__":
    target = Path(sys.argv[1])
    target.mkdir(parents=True)
    copy_workflow(target)
