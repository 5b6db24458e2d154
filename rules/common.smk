# Turns the configuration into case tables, once it has been checked, and says which files each
# rule reads. No rule lives here.

import ast
import json
import os
import platform
import re
import sys
from dataclasses import asdict
import time
from functools import cache
from pathlib import Path
from types import SimpleNamespace

import psutil

# Here and in every job, which inherits it.
sys.path.insert(0, str(Path(workflow.basedir) / "scripts"))
os.environ["PYTHONPATH"] = f"{workflow.basedir}/scripts"

from pipeline import job_cost as _cost
from pipeline.run_summary import Progress, graded, jobs_of, missed, quieten, summary
from snakemake.exceptions import WorkflowError
from stickiness.accuracy import plan
from stickiness.accuracy.error_models import read_models
from snakemake.logging import logger
from snakemake.settings.enums import Quietness
from stickiness.adhesion import model_choice
from stickiness.config import checks as configuration

# One thread a job: `-j` runs seeds and cases side by side, which scales better than threaded
# linear algebra on arrays of this size, and sums do not depend on the number of cores.
for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(name, "1")


try:
    MATERIALS, REAL_SURFACES = configuration.checked(
        config, Path(workflow.basedir) / "config/schemas"
    )
    PLANS = plan.plans_of(config, read_models(config["tradeoff"]["table"]))
    DMT_ERRORS = model_choice.read_table(config["dmt_error"])
except ValueError as error:
    raise WorkflowError(str(error)) from None

FIDELITY = config["fidelities"][config["fidelity"]]
RESULTS = f"{config['results']}/{config['fidelity']}"
LOGS, BENCHMARKS = f"{RESULTS}/logs", f"{RESULTS}/benchmarks"
CASES, SWEEPS = config["cases"], config["theory"]["sweeps"]
# Figures and report hold the cases that are simulated for every quantity.
COMPLETE = [case for case, planned in PLANS.items() if planned.complete]
COMPARISONS = {
    name: config["comparisons"]["surfaces"][name]
    for name in FIDELITY.get("comparisons", config["comparisons"]["surfaces"])
}
# Whatever theory is compared with: what it is, in the terms of a model surface, and its loads.
COMPARED = {
    **{
        case: (config["model_surfaces"][asked["surface"]], asked["pressures"])
        for case, asked in CASES.items()
    },
    **{
        name: (
            {key: asked[key] for key in ("hurst", "magnification", "window") if key in asked},
            config["comparisons"]["pressures"],
        )
        for name, asked in COMPARISONS.items()
    },
}
# Of these, what is simulated for every quantity.
SIMULATED = [name for name in COMPARED if name in COMPLETE or name in COMPARISONS]
ADHESION, LOOPS = config["adhesion"], config["loops"]
# Cases that ask for an accuracy, which may be missed.
ACCURATE = [case for case, asked in CASES.items() if "accuracy" in asked]
TRADE = config["tradeoff"]
TRADEOFF = f"{config['results']}/tradeoff"
TRADE_SETS = {
    name: TRADE[part]
    for part in ("cases", "finer", "validation")
    for name in TRADE[part]["surfaces"]
}
TRADE_SURFACES = {name: part["surfaces"][name] for name, part in TRADE_SETS.items()}
FIGURES = [f"fig{number}" for number in range(1, 11)]
PAGE_PARTS = [f"report/{part}" for part in ("macros.html.j2", "page.css", "page.js")]


wildcard_constraints:
    seed=r"\d+",
    part=r"\d+-\d+",
    case="|".join(map(re.escape, CASES)) or "none",
    grid=r"(@\d+)?",
    comparison="|".join(map(re.escape, COMPARISONS)),
    compared="|".join(map(re.escape, COMPARED)),
    model_surface="|".join(map(re.escape, config["model_surfaces"])) or "none",
    sweep="|".join(map(re.escape, SWEEPS)) or "none",
    adhesion="|".join(map(re.escape, ADHESION)) or "none",
    loop="|".join(map(re.escape, LOOPS)) or "none",
    real_surface="|".join(map(re.escape, REAL_SURFACES)),
    figure="|".join(FIGURES),


def seeds_of(case):
    """Seeds of a case."""
    return range(1, PLANS[case].settings.seeds + 1)


def realisations(wildcards):
    """Files of all realisations of a case, which it may share with an earlier one."""
    owner = PLANS[wildcards.case].owner
    return [f"{RESULTS}/contact/{owner}/seed{seed}.nc" for seed in seeds_of(wildcards.case)]


def coarse_solutions(wildcards):
    """Files of the coarse solutions behind a case's means, shared likewise; none for plain means."""
    planned = PLANS[wildcards.case]
    parts = plan.coarse_parts(planned.settings.coarse_seeds)
    return [f"{RESULTS}/contact/{planned.owner}/coarse{part}.nc" for part in parts]


def gaps_of(wildcards):
    """Ranges at which a case's attractive areas are taken; none if it does not want any."""
    return config["gaps"] if PLANS[wildcards.case].gaps else None


def trade_set(wildcards):
    """The part of the configuration that a surface belongs to."""
    return TRADE_SETS[wildcards.trade_case]


@cache
def library_of(script):
    """Library modules that a script uses, found by following its imports.

    Snakemake watches the script of a rule but not what the script imports; with these among the
    inputs, a changed module re-runs the stages that use it and no others.
    """
    root = Path(workflow.basedir) / "scripts"
    found, todo = set(), [root / script]
    while todo:
        for path in imported_modules(todo.pop(), root):
            if path not in found:
                found.add(path)
                todo.append(path)
    return sorted(os.path.relpath(path) for path in found)


@cache
def imported_modules(path, root):
    """Files below `root` that a Python file imports from the library or from beside itself."""
    candidates = []
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            candidates += [root / alias.name.replace(".", "/") for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            base = path.parent if node.level else root
            base = base / (node.module or "").replace(".", "/")
            candidates += [base, *(base / alias.name for alias in node.names)]
    files = [c.with_suffix(".py") for c in candidates] + [c / "__init__.py" for c in candidates]
    return [file for file in files if file.is_file()]


def surface_of(wildcards):
    """Surface of a case on the grid that it is solved on, with the seed left open."""
    planned = PLANS[wildcards.case]
    return f"{RESULTS}/surfaces/{planned.surface}{grid_suffix(planned)}/seed{{seed}}.nc"


def grid_suffix(planned):
    """What tells the grid of a plan from that of the preset, at the end of a folder's name."""
    pixels = planned.settings.pixels_per_wavelength
    return "" if pixels == FIDELITY["pixels_per_wavelength"] else f"@{pixels}"


def pixels_of(wildcards):
    """Grid points per shortest wavelength of a surface's file, the preset's unless it says so."""
    return int(wildcards.grid.lstrip("@") or FIDELITY["pixels_per_wavelength"])


def behind_answer(wildcards):
    """Files that what a case asks for rests on, and no others."""
    case, planned = wildcards.case, PLANS[wildcards.case]
    if not planned.simulated:
        return {"solved": f"{RESULTS}/persson/lattice/{case}.nc"}
    files = {"solved": f"{RESULTS}/contact/ensembles/{case}.nc"}
    if "a_v" in planned.quantities:
        files["a_v"] = f"{RESULTS}/fits/a_v/ensembles/{case}.nc"
    if "kappa" in planned.quantities:
        files["kappa"] = f"{RESULTS}/fits/kappa/{case}.nc"
    return files


def summary_of_plan(case):
    """What a case's answer needs to know of its plan."""
    planned, surface = PLANS[case], config["model_surfaces"][CASES[case]["surface"]]
    wider = {"carry_to": CASES[case]["carry_to"]} if "carry_to" in CASES[case] else {}
    return {
        "quantities": list(planned.quantities),
        "pressures": list(planned.pressures),
        "simulated": planned.simulated,
        "settings": asdict(planned.settings),
        "surface": surface,
        "accuracy": CASES[case].get("accuracy"),
        **wider,
    }


def adhesive_case(wildcards):
    """Wildcards of the contact case behind a set of adhesive parameters."""
    return SimpleNamespace(case=ADHESION[wildcards.adhesion]["case"])


@cache
def model_of(adhesion):
    """Model of every point of a set of adhesive parameters."""
    asked = ADHESION[adhesion]
    surface = config["model_surfaces"][CASES[asked["case"]]["surface"]]
    return model_choice.choose(asked, surface, DMT_ERRORS)


def solved_in_full(wildcards):
    """What a full solution depends on, of a set of adhesive parameters, beside its model."""
    others = ("model", "accuracy", "seeds", "maps")
    return {key: value for key, value in ADHESION[wildcards.adhesion].items() if key not in others}


def adhesive_realisations(wildcards):
    """Files of all realisations to be solved in full; none if the DMT limit is good enough."""
    if not model_of(wildcards.adhesion).full.any():
        return []
    asked = ADHESION[wildcards.adhesion]
    most = asked.get("seeds", 10**9)
    seeds = [seed for seed in seeds_of(asked["case"]) if seed <= most]
    return [f"{RESULTS}/adhesion/full/{wildcards.adhesion}/seed{seed}.nc" for seed in seeds]


def simulated_edges():
    """Attraction at the edges of contact, for every set of parameters with full simulation."""
    names = [name for name in ADHESION if adhesive_realisations(SimpleNamespace(adhesion=name))]
    return [f"{RESULTS}/adhesion/edges/{name}.nc" for name in names]


def topography_files(wildcards):
    """The measured files of a real surface, if it has any of its own."""
    return measured_files(wildcards.real_surface)


def measured_files(name):
    """Files of a real surface's measurements, those that come with the project left out."""
    surface = REAL_SURFACES[name]
    if surface["kind"] != "measured":
        return []
    files = [measurement["file"] for _, measurement in configuration.measurements(surface)]
    return [file for file in files if not file.startswith("builtin:")]


def pressed_heights(wildcards):
    """Contact of the measured heights of a surface, if it is asked for."""
    asked = "bem" in REAL_SURFACES[wildcards.real_surface]
    return [f"{RESULTS}/real_surfaces/contact/{wildcards.real_surface}.nc"] if asked else []


def data_of(rule_name):
    """Datasets that a rule without wildcards reads."""
    return [str(path) for path in getattr(rules, rule_name).input if str(path).endswith(".nc")]


def a_v_inputs():
    """What the a_V of the derived criterion rests on: what was measured once, and theory."""
    case = config["criteria"]["a_v"]["case"]
    return {
        "a_v": config["criteria"]["a_v"]["measured"],
        "lattice": f"{RESULTS}/fits/a_v/lattice/{case}.nc",
        "theory": f"{RESULTS}/fits/a_v/sweeps/fig3c.nc",
    }


def ledger_inputs():
    """Files behind the claims, by the names that scripts/_claims.py uses."""
    return {
        "kappa_64": f"{RESULTS}/fits/kappa/H0.8_zeta64.nc",
        "kappa_128": f"{RESULTS}/fits/kappa/H0.8_zeta128.nc",
        "kappa_wide": f"{RESULTS}/fits/kappa/H0.8_zeta32_wide.nc",
        "lattice_wide": f"{RESULTS}/persson/lattice/H0.8_zeta32_wide.nc",
        "fit_lattice_128": f"{RESULTS}/fits/a_v/lattice/H0.8_zeta128.nc",
        "ensemble_wide": f"{RESULTS}/contact/ensembles/H0.8_zeta32_wide.nc",
        "fit_bem_wide": f"{RESULTS}/fits/a_v/ensembles/H0.8_zeta32_wide.nc",
        "fit_bem_64": f"{RESULTS}/fits/a_v/ensembles/H0.8_zeta64.nc",
        "fit_bem_128": f"{RESULTS}/fits/a_v/ensembles/H0.8_zeta128.nc",
        **{f"fig{n}": f"{RESULTS}/persson/sweeps/fig{n}.nc" for n in ("1b", "3a", "3b", "3c", "3d")},
        **{f"fit_fig{n}": f"{RESULTS}/fits/a_v/sweeps/fig{n}.nc" for n in ("3a", "3c", "3d")},
        "loop": f"{RESULTS}/adhesion/loops/fig4a.nc",
        "adhesive_fig2": f"{RESULTS}/adhesion/full/fig2.nc",
        "adhesive_rough": f"{RESULTS}/adhesion/full/fig4b_rough.nc",
        "adhesive_smooth": f"{RESULTS}/adhesion/full/fig4b_smooth.nc",
        "adhesion_fig2": f"{RESULTS}/adhesion/dmt/fig2.nc",
        "adhesion_rough": f"{RESULTS}/adhesion/dmt/fig4b_rough.nc",
        "adhesion_smooth": f"{RESULTS}/adhesion/dmt/fig4b_smooth.nc",
        "map": f"{RESULTS}/criteria/map.nc",
        "asphalt": f"{RESULTS}/real_surfaces/asphalt.nc",
        "asphalt_theory": f"{RESULTS}/persson/surfaces/asphalt.nc",
        "polished_steel": f"{RESULTS}/real_surfaces/polished_steel.nc",
        "surfaces": [f"{RESULTS}/real_surfaces/{name}.nc" for name in REAL_SURFACES],
        "seeds": [
            f"{RESULTS}/surfaces/H0.8_zeta64/seed{seed}.nc" for seed in seeds_of("H0.8_zeta64")
        ],
    }


def sized(wildcards):
    """The configuration with the grid and coarse seeds that the job's own case has, if any."""
    chosen = {}
    if hasattr(wildcards, "case"):
        settings = PLANS[wildcards.case].settings
        chosen = {
            "pixels_per_wavelength": settings.pixels_per_wavelength,
            "coarse_seeds": settings.coarse_seeds,
        }
        if hasattr(wildcards, "part"):
            chosen["coarse_seeds"] = len(plan.coarse_range(wildcards.part))
    elif hasattr(wildcards, "grid"):
        chosen = {"pixels_per_wavelength": pixels_of(wildcards)}
    return config | {"fidelities": {config["fidelity"]: FIDELITY | chosen}}


def memory_of(rule):
    """Memory [MB] that jobs of a rule ask for, and more each time that one fails."""

    def asked(wildcards, attempt):
        size = _cost.work(sized(wildcards), rule, **dict(wildcards.items()))
        return attempt * _cost.asked_mb(rule, size)

    return asked


def runtime_of(rule):
    """Time [min] that jobs of a rule ask for, and more each time that one fails."""

    def asked(wildcards, attempt):
        size = _cost.work(sized(wildcards), rule, **dict(wildcards.items()))
        return attempt * _cost.asked_minutes(rule, size)

    return asked


# --- A killed run ----------------------------------------------------------------------------
# Snakemake's lock outlives a run that was killed outright. The run that holds it leaves its
# process on record, so that the next one can tell a dead run's lock from a living one's.

RUN_RECORD = Path(".snakemake/run.json")


def this_run():
    me = psutil.Process()
    return {"host": platform.node(), "pid": me.pid, "started": me.create_time()}


def remove_stale_lock():
    """Remove the lock of a run on this machine whose process is no more."""
    try:
        run = json.loads(RUN_RECORD.read_text())
        if run["host"] != platform.node():
            return
        if psutil.pid_exists(run["pid"]):
            if abs(psutil.Process(run["pid"]).create_time() - run["started"]) < 1:
                return
    except (OSError, ValueError, KeyError, psutil.Error):
        return
    for lock in Path(".snakemake/locks").glob("*.lock"):
        lock.unlink(missing_ok=True)
    RUN_RECORD.unlink(missing_ok=True)


remove_stale_lock()


# --- A clock that is or was wrong --------------------------------------------------------------
# What is newer than anything made from it would be re-made for ever; Snakemake itself says so only
# after the first such job.

LEEWAY = 60  # seconds that clocks of a network may differ by


def files_from_the_future():
    """Files that jobs may read with times of change that are yet to come."""
    own = [Path(workflow.basedir) / part for part in ("scripts", "config", "report")]
    files = [file for folder in (*own, Path(RESULTS)) for file in folder.rglob("*.*")]
    files += [Path(file) for name in REAL_SURFACES for file in measured_files(name)]
    latest = time.time() + LEEWAY
    return [file for file in files if file.exists() and file.stat().st_mtime > latest]


def check_clock():
    found = [os.path.relpath(file) for file in files_from_the_future()]
    if found:
        more = f" (and {len(found) - 1} more)" if len(found) > 1 else ""
        command = f"touch {' '.join(found)}"
        if len(found) > 5:
            command = f"find scripts config report {RESULTS} -newermt now -exec touch {{}} +"
        raise WorkflowError(
            f"{found[0]}{more} was changed in the future, by this machine's clock. If the clock "
            f"is right, run: {command}"
        )


if workflow.is_main_process:
    check_clock()


def check_writable():
    """Refuse folders of results that may not be written to, on which Snakemake breaks off."""
    existing = next(p for p in (Path(RESULTS), *Path(RESULTS).parents) if p.exists())
    below = [path for path in Path(RESULTS).rglob("*") if path.is_dir()]
    for folder in (existing, *below):
        if not os.access(folder, os.W_OK):
            raise WorkflowError(
                f"{folder} may not be written to: allow it (chmod -R u+w {existing}), or name "
                "another folder under results in config/config.yaml"
            )


# --- What a run tells ------------------------------------------------------------------------

progress = None  # of this run, once it has begun


def begin():
    """A line for every job in place of Snakemake's, unless it is to be quieter or more talkative."""
    global progress
    progress = Progress(
        jobs_of(workflow.dag), workflow.cores or 1, more=lambda: jobs_of(workflow.dag)
    )
    settings = workflow.output_settings
    if not settings.verbose and not {Quietness.ALL, Quietness.PROGRESS} & set(settings.quiet or ()):
        quieten(logger)
        print(progress.opening(), file=sys.stderr)
    else:
        progress.stream = open(os.devnull, "w")
    logger.addHandler(progress)


def conclude():
    """The summary at the end of a run."""
    RUN_RECORD.unlink(missing_ok=True)
    if progress is None or Quietness.ALL in set(workflow.output_settings.quiet or ()):
        return
    # After a checkpoint Snakemake takes what has run for up to date.
    old = (job for job in workflow.dag.jobs if job.output and job.jobid not in progress.jobs)
    reused = sum(not workflow.dag.needrun(job) for job in old)
    places = {"results": RESULTS, "report": f"{RESULTS}/report/report.html"}
    lines = [*graded(RESULTS), *missed(f"{RESULTS}/cases/{case}.nc" for case in ACCURATE)]
    print(summary(progress, reused, places, lines), file=sys.stderr)


onstart:
    check_writable()
    RUN_RECORD.write_text(json.dumps(this_run()))
    begin()


onsuccess:
    conclude()


onerror:
    conclude()
