# Checks the configuration and turns it into the tables that the rules use. No rule stands here.

import os
import re
import sys
import time
from pathlib import Path

from snakemake.exceptions import WorkflowError

# Of this process and, by its environment, of every job.
SCRIPTS = f"{workflow.basedir}/scripts"
sys.path.insert(0, SCRIPTS)
os.environ.update(PYTHONPATH=SCRIPTS)
# One thread a job: `-j` runs seeds and cases side by side, which scales better than threaded
# linear algebra on arrays of this size, and sums do not depend on the number of cores.
for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(name, "1")

from pipeline.code import code_of
from stickiness.accuracy import plan
from stickiness.accuracy.error_models import read_models
from stickiness.adhesion import model_choice
from stickiness.config import checks
from stickiness.config.measured_contact import MOST_POINTS

try:
    MATERIALS, REAL_SURFACES, EXPERIMENTS = checks.check_all(
        config, Path(workflow.basedir) / "config/schemas"
    )
    PLANS = plan.plans_of(config, read_models(config["tradeoff"]["table"]))
    DMT_ERRORS = model_choice.read_table(config["dmt_error"])
    if not Path(config["remaining"]["table"]).is_file():
        raise ValueError(f"remaining.table = {config['remaining']['table']!r}: no such file")
except ValueError as error:
    raise WorkflowError(str(error)) from None

STARTED = time.time()
for target in sys.argv[1:]:
    asked = re.match(rf"{re.escape(config['results'])}/([^/]+)/", target)
    if asked and asked[1] in config["fidelities"] and asked[1] != config["fidelity"]:
        raise WorkflowError(
            f"{target} is of fidelity {asked[1]}, this run of {config['fidelity']}: "
            f"add --config fidelity={asked[1]}"
        )

FIDELITY = config["fidelities"][config["fidelity"]]
RESULTS = f"{config['results']}/{config['fidelity']}"
TRADEOFF = f"{config['results']}/tradeoff"
REMAINING = f"{config['results']}/remaining"
MODEL_SURFACES, CASES = config["model_surfaces"], config["cases"]
SWEEPS, ADHESION, LOOPS = config["theory"]["sweeps"], config["adhesion"], config["loops"]
GAMMA, GAPS, TRADE = config["theory"]["gamma"], config["gaps"], config["tradeoff"]
ERROR_MODELS = TRADE["table"]
FIGURES = [f"fig{number}" for number in range(1, 12)]
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
    compared=choices([*CASES, *COMPARISONS]),
    model_surface=choices(MODEL_SURFACES),
    sweep=choices(SWEEPS),
    adhesion=choices(ADHESION),
    loop=choices(LOOPS),
    real_surface=choices(REAL_SURFACES),
    figure=choices(FIGURES),


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


def seeds_of(case):
    return list(range(1, PLANS[case].settings.seeds + 1))


def surfaces_of(case, part="1-1"):
    """Surfaces of a case on the grid that it is solved on: the file that holds a part's seeds."""
    planned = PLANS[case]
    return surfaces_on(planned.surface, planned.settings.pixels_per_wavelength, part)


def surfaces_on(surface, pixels, part="1-1"):
    """File of surfaces on a grid that holds a part's seeds: as many as any case wants of them."""
    counts = [
        each.settings.seeds
        for each in PLANS.values()
        if each.simulated
        and (each.surface, each.settings.pixels_per_wavelength) == (surface, pixels)
    ]
    held = plan.covering_parts(plan.seeds_in(part)[-1], among=max(counts, default=1))[-1]
    grid = "" if pixels == FIDELITY["pixels_per_wavelength"] else f"@{pixels}"
    return f"{RESULTS}/surfaces/{surface}{grid}/seeds{held}.nc"


def a_v_of_simulation(case):
    return f"{RESULTS}/fits/a_v/ensembles/{case}.nc"


def summarise():
    """Say where the results are and what they hold."""
    from pipeline.run_summary import summary

    answers = [f"{RESULTS}/cases/{case}.nc" for case in CASES if "accuracy" in CASES[case]]
    print(summary(RESULTS, STARTED, answers), file=sys.stderr)


onstart:
    # On this machine there is no rate of jobs to limit, but for its sake Snakemake 9.27 looks for
    # jobs to start once a second for every job that has ended: 12 % of a core in a long run.
    if workflow.local_exec and hasattr(workflow.scheduler, "job_rate_limiter"):
        workflow.scheduler.job_rate_limiter = None


onsuccess:
    summarise()


onerror:
    summarise()
    print(
        "  failed    Some jobs failed, as said above; what does not depend on them was made. "
        "Mend what they name\n            and run the same command again: it makes the rest.",
        file=sys.stderr,
    )
