# Checks the configuration and turns it into the tables that the rules use. No rule stands here.

import difflib
import re
import time
from collections import Counter
from pathlib import Path

from snakemake.cli import get_argument_parser
from snakemake.utils import update_config


from common.source_hash import save_cache, source_hash
from stickiness.accuracy import model_choice, plan
from stickiness.accuracy.error_models import read_models
from common.config.entries import MOST_POINTS, measurements

# Tables that this project measured, which are committed.
ERROR_MODELS, TRADE_SUMMARY, REMAINING_TABLE, DMT_ERROR_TABLE = (
    project_file(f"config/{name}.csv")
    for name in ("accuracy", "tradeoff", "remaining", "dmt_error")
)

with one_line():
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

STARTED = time.time()
FIDELITY = config["fidelities"][config["fidelity"]]
RESULTS = f"{config['results']}/{config['fidelity']}"
for folder in (Path(RESULTS), *Path(RESULTS).parents):
    if folder.exists() and not folder.is_dir():
        sys.exit(f"{folder} must be a folder: move this file, or set `results` in {load.USER}")
TRADEOFF = f"{config['results']}/tradeoff"
REMAINING = f"{config['results']}/remaining"
MODEL_SURFACES, CASES = config["model_surfaces"], config["cases"]
SWEEPS, ADHESION, LOOPS = config["theory"]["sweeps"], config["adhesion"], config["loops"]
GAMMA, GAPS = config["theory"]["gamma"], config["gaps"]
LABELS = {name: entry["label"] for name, entry in REAL_SURFACES.items()}
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


def without_texts(entry):
    """An entry without what only readers need, which must not start a simulation."""
    return {key: value for key, value in entry.items() if key not in ("label", "source", "note")}


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


def check_targets():
    """Stop if the command names a target that no rule makes, and say what may be meant."""
    by_command = workflow.is_main_process and Path(sys.argv[0]).stem in ("snakemake", "__main__")
    if MODULE or not by_command:
        return
    files = [
        file
        for found in TARGETS.values()
        for file in ([found] if isinstance(found, str) else found)
    ]
    for target in get_argument_parser().parse_known_args()[0].targets:
        asked = re.match(rf"{re.escape(config['results'])}/([^/]+)/", target)
        if asked and asked[1] in config["fidelities"] and asked[1] != config["fidelity"]:
            sys.exit(
                f"{target} is of fidelity {asked[1]}, this run of {config['fidelity']}: "
                f"add --config fidelity={asked[1]}"
            )
        made = any(target == rule.name or rule.is_producer(target) for rule in workflow.rules)
        if not made and not Path(target).exists():
            close = difflib.get_close_matches(target, [*TARGETS, *files], n=1)
            hint = f"did you mean {close[0]!r}?" if close else f"choose from {', '.join(TARGETS)}"
            sys.exit(f"{target!r} is no target; {hint}")


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


def explain(job):
    """Say which files a job failed to make, why, and where its log is."""
    path = Path(str(job.log[0]))
    said = path.read_text(encoding="utf-8", errors="replace") if path.exists() else ""
    errors = re.findall(r" ERROR (.*)", said)
    reason = errors[-1] if errors else "ended without a word; was it killed, or out of memory?"
    return f"{', '.join(job.output)}: {reason} (log: {path})"


onerror:
    summarise()
    print(
        "  failed    Fix what follows and run the same command again; all that does not depend on it\n"
        "            was made.",
        file=sys.stderr,
    )
    # Snakemake's log, which it offers here, lacks the errors of a quiet run.
    failed = (job if job.is_group() else [job] for job in workflow.scheduler.failed)
    for line in sorted(explain(job) for group in failed for job in group):
        print(f"  failed    {line}", file=sys.stderr)
