# Checks the configuration and turns it into the tables that the rules use. No rule stands here.

import re
import time
from collections import Counter
from pathlib import Path
from types import SimpleNamespace

from snakemake.utils import update_config

from common import stored
from common.config.simulations import ModelSurface
from common.source_hash import save_cache, source_hash
from stickiness.accuracy import model_choice, plan
from stickiness.accuracy.error_models import read_models
from stickiness.entries import list_measurements, without_texts

STARTED = time.time()

# Tables that this project measured, which are committed.
ERROR_MODELS = project_file("config/accuracy.csv")
TRADE_SUMMARY = project_file("config/tradeoff.csv")
REMAINING_TABLE = project_file("config/remaining.csv")
HEIGHTS_TABLE = project_file("config/heights.csv")
DMT_ERROR_TABLE = project_file("config/dmt_error.csv")


def read_configuration():
    """Checked content of every file of the configuration, in SI units and with all defaults."""
    whole = load.defaults(PROJECT, project_file)
    update_config(whole, config)
    campaigns = {name: load.load(Path(PROJECT, path)) for name, path in load.CAMPAIGNS.items()}
    # What errors call the user's configuration: its file, and those of the command.
    files = [word for word in sys.argv[1:] if word.endswith((".yaml", ".yml"))]
    name = f"config of module {MODULE}" if MODULE else " or ".join([load.USER, *files])
    return load.check_all(whole, campaigns, config, name, made=bool(MODULE))


with one_line():
    checked = read_configuration()
    config = checked["config"]
    PLANS = plan.plans_of(config, read_models(ERROR_MODELS))
    DMT_ERRORS = model_choice.read_table(DMT_ERROR_TABLE)

MATERIALS = checked["materials"]["materials"]
REAL_SURFACES = checked["surfaces"]["surfaces"]
EXPERIMENTS = checked["experiments"]["experiments"]
TRADE = checked["tradeoff"]
REMAINING_CAMPAIGN = checked["remaining"]
HEIGHT_CAMPAIGN = checked["heights"]
LIMIT_CAMPAIGN = checked["limits"]

FIDELITY = config["fidelities"][config["fidelity"]]
MODEL_SURFACES = config["model_surfaces"]
CASES = config["cases"]
# Cases by their roles in the paper's figures and claims: rules and scripts know no other names.
ROLES = SimpleNamespace(**config["roles"])
SWEEPS = config["theory"]["sweeps"]
ADHESION = config["adhesion"]
LOOPS = config["loops"]
GAMMA = config["theory"]["gamma"]
GAPS = config["gaps"]
COMPARISONS = {
    name: config["comparisons"]["surfaces"][name]
    for name in FIDELITY["comparisons"] or config["comparisons"]["surfaces"]
}
LABELS = {name: entry["label"] for name, entry in REAL_SURFACES.items()}
MEASURED_SURFACES = [name for name, entry in REAL_SURFACES.items() if entry["kind"] == "measured"]
# Figures and report show the cases that are simulated for every quantity. Theory is compared with
# these, and takes heights as Gaussian.
COMPLETE = [
    case
    for case, planned in PLANS.items()
    if planned.complete and "heights" not in MODEL_SURFACES[planned.surface]
]

RESULTS = f"{config['results']}/{config['fidelity']}"
SHARED_RESULTS = config["results"]  # of campaigns and real surfaces, the same at every fidelity
TRADEOFF = f"{SHARED_RESULTS}/tradeoff"
LIMITS = f"{SHARED_RESULTS}/limits"
for folder in (Path(RESULTS), *Path(RESULTS).parents):
    if folder.exists() and not folder.is_dir():
        sys.exit(f"{folder} must be a folder: move this file, or set `results` in {load.USER}")


def choices(names):
    """Pattern of a wildcard that is one of these names."""
    return "|".join(map(re.escape, names)) or "none"


wildcard_constraints:
    seed=r"\d+",
    part=stored.PATTERN,
    pixels=r"\d+",
    tolerance=r"[\d.e-]+",
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
    band = {key: COMPARISONS[name][key] for key in ("hurst", "magnification", "window")}
    return ModelSurface(**band).model_dump()


def pressures_of(name):
    """Loads of a case or a comparison."""
    return PLANS[name].pressures if name in CASES else config["comparisons"]["pressures"]


def several(path, **names):
    """Files of results for every one of some names."""
    return expand(f"{RESULTS}/{path}", **names)


def a_v_of_simulation(case):
    return f"{RESULTS}/fits/a_v/ensembles/{case}.nc"


def find_results(pattern):
    """Files that this run has made."""
    results = Path(rules.write_report.output[0]).parents[1]  # with the prefix of a module
    return sorted(path for path in results.glob(pattern) if path.stat().st_mtime >= STARTED)


def count_words(words):
    """Words by how often they occur: "3 true; 1 false"."""
    return "; ".join(f"{number} {word}" for word, number in Counter(words).most_common())


def summarise():
    """Say where the report is, how claims and pairs came out, and which cases missed their accuracy."""
    from stickiness import datasets
    from stickiness.criteria.pair import WORDS

    results = Path(rules.write_report.output[0]).parents[1]
    lines = [("results", results)]
    for path in find_results("report/report.html"):
        lines.append(("report", path))
    for path in find_results("claims/claims.nc"):
        verdicts = datasets.read(path, ["verdict"]).verdict.values
        lines.append(("claims", count_words(map(str, verdicts))))
    for path in find_results("criteria/verdicts.nc"):
        codes = datasets.read(path, ["verdict"]).verdict.values.ravel()
        lines.append(("pairs", count_words(WORDS[code] for code in codes)))
    for case, entry in CASES.items():
        path = results / f"cases/{case}.nc"
        if entry["accuracy"] is not None and path.exists():
            missed = datasets.read(path).attrs.get("missed")
            lines += [("missed", missed)] if missed else []
    if pages := find_results("report/surfaces/*.html"):
        lines.append(("pages", ", ".join(map(str, pages))))
    for what, text in lines:
        print(f"  {what:<9} {text}", file=sys.stderr)


onsuccess:
    summarise()


onerror:
    summarise()
    print(
        "  failed    Fix what follows and run the same command again; all that does not depend on it\n"
        "            was made.",
        file=sys.stderr,
    )
    for path in find_results("logs/**/*.log"):
        errors = re.findall(r" ERROR (.*)", path.read_text(encoding="utf-8", errors="replace"))
        if errors:
            print(f"  failed    {errors[-1]} (log: {path})", file=sys.stderr)
