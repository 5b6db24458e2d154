# Finds the project and makes its modules known to this process and to every job. No rule stands here.

import contextlib
import os
import subprocess
import sys
import tempfile
from pathlib import Path


def find_project():
    """Folder of the project: the one above these rules, or a copy if Snakemake reads them from git."""
    rules_folder = workflow.current_basedir
    if os.path.isdir(str(rules_folder)):
        return Path(str(rules_folder)).parent
    # Snakemake fetches single files of github(…) and gitlab(…), but scripts import modules, which
    # must lie in a folder. Its documentation offers no way to the clone that it keeps in its cache.
    clone = getattr(getattr(rules_folder, "hosted_repo", None), "repo_clone", None)
    if clone is None:
        sys.exit(f"{rules_folder}: give the Snakefile as a path, or use a newer Snakemake")
    git = ["git", "-C", str(clone)]
    ref = f"{rules_folder.ref}^{{commit}}"
    commit = subprocess.check_output([*git, "rev-parse", ref], encoding="utf-8").strip()
    copy = Path(f"{clone}-{commit}")
    if not copy.exists():
        with tempfile.TemporaryDirectory(dir=copy.parent) as folder:
            content = subprocess.check_output([*git, "archive", "--prefix=copy/", commit])
            subprocess.run(["tar", "-x", "-C", folder], input=content, check=True)
            with contextlib.suppress(OSError):  # another run may have been faster
                os.rename(f"{folder}/copy", copy)
    return copy


PROJECT = find_project()


def is_main():
    """Whether the Snakefile of this project is the one that runs, from a folder or from a git host."""
    if os.path.isdir(str(workflow.basedir)):
        return os.path.samefile(workflow.basedir, PROJECT)
    # Snakemake names the folder of a remote Snakefile by its address.
    rules_address = workflow.current_basedir.get_path_or_uri(secret_free=True)
    return rules_address == f"{workflow.basedir}/rules"


# Another workflow may use this one as a module.
MODULE = None if is_main() else "stickiness"


def project_file(path):
    """A file of the project, seen from the folder of the run; a module's prefix does not move it."""
    return local(path if os.path.samefile(PROJECT, ".") else f"{PROJECT}/{path}")


# Of this process and, by its environment, of every job.
# Numba keeps compiled loops by the path of the code; a folder may hold only a link to it.
SCRIPTS = os.path.realpath(f"{PROJECT}/scripts")
sys.path.insert(0, SCRIPTS)
others = [path for path in os.environ.get("PYTHONPATH", "").split(os.pathsep) if path]
os.environ.update(PYTHONPATH=os.pathsep.join([SCRIPTS, *others]))
# One thread a job: `-j` runs seeds and cases side by side, which scales better than threaded
# linear algebra on arrays of this size, and sums do not depend on the number of cores.
for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(name, "1")

# Made by the first run, which reads units before any job does.
os.environ.setdefault("STICKINESS_UNITS", os.path.abspath(".snakemake/units"))

from common.config import load


@contextlib.contextmanager
def one_line():
    """End with an error in one line; an exception's would have Snakemake's around it."""
    try:
        yield
    except ValueError as error:
        sys.exit(str(error))
