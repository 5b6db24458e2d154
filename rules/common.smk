# Finds the project, checks the configuration and turns it into the tables that the rules use. No rule
# stands here.

import contextlib
import os
import re
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

from snakemake.utils import update_config


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
    commit = subprocess.check_output([*git, "rev-parse", ref], text=True).strip()
    copy = Path(f"{clone}-{commit}")
    if not copy.exists():
        with tempfile.TemporaryDirectory(dir=copy.parent) as folder:
            content = subprocess.check_output([*git, "archive", "--prefix=copy/", commit])
            subprocess.run(["tar", "-x", "-C", folder], input=content, check=True)
            with contextlib.suppress(OSError):  # another run may have been faster
                os.rename(f"{folder}/copy", copy)
    return copy


PROJECT = find_project()
# Another workflow may use this one as a module.
MODULE = None if os.path.samefile(workflow.basedir, PROJECT) else "stickiness"


def project_file(path):
    """A file of the project, seen from the folder of the run; a module's prefix does not move it."""
    return local(path if os.path.samefile(PROJECT, ".") else f"{PROJECT}/{path}")


# Of this process and, by its environment, of every job.
SCRIPTS = f"{PROJECT}/scripts"
sys.path.insert(0, SCRIPTS)
others = [path for path in os.environ.get("PYTHONPATH", "").split(os.pathsep) if path]
os.environ.update(PYTHONPATH=os.pathsep.join([SCRIPTS, *others]))
# One thread a job: `-j` runs seeds and cases side by side, which scales better than threaded
# linear algebra on arrays of this size, and sums do not depend on the number of cores.
for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(name, "1")

# Made by the first run, which reads units before any job does.
os.environ.setdefault("STICKINESS_UNITS", os.path.abspath(".snakemake/units"))

from common.source_hash import save_cache, source_hash
from stickiness.accuracy import model_choice, plan
from stickiness.accuracy.error_models import read_models
from common.config import load
from common.config.entries import MOST_POINTS, measurements

# Tables that this project measured, which are committed.
ERROR_MODELS, TRADE_SUMMARY, REMAINING_TABLE, DMT_ERROR_TABLE = (
    project_file(f"config/{name}.csv")
    for name in ("accuracy", "tradeoff", "remaining", "dmt_error")
)

try:
    # What a user leaves out is as in the project.
    given, config = config, load.defaults(PROJECT, project_file)
    update_config(config, given)
    campaigns = {name: load.load(Path(PROJECT, path)) for name, path in load.CAMPAIGNS.items()}
    TRADE, REMAINING_CAMPAIGN = campaigns["tradeoff"], campaigns["remaining"]
    if workflow.is_main_process:  # whose jobs read what was checked here
        more = [word for word in sys.argv[1:] if word.endswith((".yaml", ".yml"))]
        name = f"config of module {MODULE}" if MODULE else " or ".join([load.USER, *more])
        load.check_all(config, campaigns, given, name, made=bool(MODULE))
    MATERIALS, REAL_SURFACES, EXPERIMENTS = (
        load.load(config[table])[table] for table in load.TABLES
    )
    PLANS = plan.plans_of(config, read_models(ERROR_MODELS))
    DMT_ERRORS = model_choice.read_table(DMT_ERROR_TABLE)
except ValueError as error:
    sys.exit(str(error))  # one line, where an exception's would have Snakemake's around it

STARTED = time.time()
for target in [] if MODULE else sys.argv[1:]:
    asked = re.match(rf"{re.escape(config['results'])}/([^/]+)/", target)
    if asked and asked[1] in config["fidelities"] and asked[1] != config["fidelity"]:
        sys.exit(
            f"{target} is of fidelity {asked[1]}, this run of {config['fidelity']}: "
            f"add --config fidelity={asked[1]}"
        )

FIDELITY = config["fidelities"][config["fidelity"]]
RESULTS = f"{config['results']}/{config['fidelity']}"
TRADEOFF = f"{config['results']}/tradeoff"
REMAINING = f"{config['results']}/remaining"
MODEL_SURFACES, CASES = config["model_surfaces"], config["cases"]
SWEEPS, ADHESION, LOOPS = config["theory"]["sweeps"], config["adhesion"], config["loops"]
GAMMA, GAPS = config["theory"]["gamma"], config["gaps"]
MEASURED_SURFACES = [name for name, entry in REAL_SURFACES.items() if entry["kind"] == "measured"]
# Figures and report show the cases that are simulated for every quantity.
COMPLETE = [case for case, planned in PLANS.items() if planned.complete]
COMPARISONS = {
    name: config["comparisons"]["surfaces"][name]
    for name in FIDELITY.get("comparisons", config["comparisons"]["surfaces"])
}


def choices(names):
    """Pattern of a wildcard that is one of these names."""
    return "|".join(map(re.escape, names)) or "none"


wildcard_constraints:
    seed=r"\d+",
    part=r"\d+-\d+",
    grid=r"(@\d+)?",
    case=choices(CASES),
    comparison=choices(COMPARISONS),
    model_surface=choices(MODEL_SURFACES),
    adhesion=choices(ADHESION),
    loop=choices(LOOPS),
    real_surface=choices(REAL_SURFACES),


def model_surface_of(name):
    """Parameters of the surface that a case, or a comparison of theory with simulation, is on."""
    if name in CASES:
        return MODEL_SURFACES[CASES[name]["surface"]]
    keys = ("hurst", "magnification", "window")
    return {key: COMPARISONS[name][key] for key in keys if key in COMPARISONS[name]}


def pressures_of(name):
    """Loads of a case or a comparison."""
    return PLANS[name].pressures if name in CASES else config["comparisons"]["pressures"]


def several(path, **names):
    """Files of results for every one of some names."""
    return expand(f"{RESULTS}/{path}", **names)


def pixels_of_case(case):
    return PLANS[case].settings.pixels_per_wavelength


def seeds_of(case):
    return list(range(1, PLANS[case].settings.seeds + 1))


def surfaces_of(case, part="1-1"):
    """Surfaces of a case on the grid that it is solved on: the file that holds a part's seeds."""
    return surfaces_on(PLANS[case].surface, pixels_of_case(case), part)


def surfaces_on(surface, pixels, part="1-1"):
    """File of surfaces on a grid that holds a part's seeds: as many as any case wants of them."""
    counts = [
        each.settings.seeds
        for case, each in PLANS.items()
        if each.simulated and (each.surface, pixels_of_case(case)) == (surface, pixels)
    ]
    held = plan.batches_covering(plan.seeds_in(part)[-1], among=max(counts, default=1))[-1]
    grid = "" if pixels == FIDELITY["pixels_per_wavelength"] else f"@{pixels}"
    return f"{RESULTS}/surfaces/{surface}{grid}/seeds{held}.nc"


def a_v_of_simulation(case):
    return f"{RESULTS}/fits/a_v/ensembles/{case}.nc"


def summarise():
    """Say where the report is, how claims and pairs came out, and which cases missed their accuracy."""
    from stickiness import datasets
    from stickiness.criteria.pair import WORDS

    def find(pattern):  # files of this run, not of an earlier one
        return [path for path in results.glob(pattern) if path.stat().st_mtime >= STARTED]

    def count(words):
        return "; ".join(f"{n} {word}" for word, n in Counter(map(str, words)).most_common())

    results = Path(rules.write_report.output[0]).parents[1]  # with the prefix of a module
    lines = [("results", results)]
    lines += [("report", path) for path in find("report/report.html")]
    for path in find("claims/claims.nc"):
        lines.append(("claims", count(datasets.read(path, ["verdict"]).verdict.values)))
    for path in find("criteria/verdicts.nc"):
        codes = datasets.read(path, ["verdict"]).verdict.values.ravel()
        lines.append(("pairs", count(WORDS[code] for code in codes)))
    for case in CASES:
        path = results / f"cases/{case}.nc"
        if "accuracy" in CASES[case] and path.exists():
            missed = datasets.read(path).attrs.get("missed")
            lines += [("missed", missed)] if missed else []
    if pages := find("report/surfaces/*.html"):
        lines.append(("pages", ", ".join(sorted(map(str, pages)))))
    print("\n".join(f"  {what:<9} {text}" for what, text in lines), file=sys.stderr)


onsuccess:
    summarise()


onerror:
    summarise()
    print(
        "  failed    Some jobs failed, as reported above; whatever does not depend on them was made.\n"
        "            Fix the cause and run the same command again to make the rest.",
        file=sys.stderr,
    )
