"""What a change re-runs, and that it is no more than that."""

import re
import time

import pytest
from helpers.copy_workflow import FEW, copy_code

from stickiness import datasets

pytestmark = pytest.mark.workflow

SOLUTIONS = {"synthesise_surface", "solve_repulsive", "solve_coarse"}
# All rules that solve for contact or loading of model surfaces, and those that answer cases.
SOLVING = SOLUTIONS | {"contact_maps", "solve_ensemble", "solve_adhesive", "adhesive_maps"}
SOLVING |= {"follow_loop"}
ANSWERING = {"answer_case", "answer_by_theory"}
# What shows answers of cases, and the theory that goes with a case.
SHOWING = {"persson_lattice", "compare_theory", "average_adhesive", "map_criterion"}
SHOWING |= {"compare_criteria", "check_claims", "write_report", "write_findings"}
SHOWING |= {"persson_sweep"}  # at the Hurst exponents of cases that have a role
SHOWING |= {f"plot_fig{number}" for number in range(1, 14)}


def test_a_complete_run_has_no_warnings_and_leaves_nothing_to_do(finished):
    assert re.search(r"(\d+) of \1 steps \(100%\) done", finished.run.stdout), "not every job ran"
    assert "warning" not in finished.run.stdout.lower()
    logs = list((finished / "results/tiny/logs").rglob("*.log"))
    assert logs
    for log in logs:
        assert not re.search("WARNING|ERROR", log.read_text(encoding="utf-8")), log
    assert list((finished / "results/tiny/benchmarks").rglob("*.tsv"))
    assert finished.planned() == {}


# File, text and its replacement, rules that run again, rules that do not.
CHANGES = {
    "material": (
        "config/materials.yaml",
        ("{common: pdms}", '{common: pdms, work_of_adhesion: "45 mJ/m^2"}'),
        {"judge", "write_surface", "plot_fig9", "check_claims", "write_report"},
        {"analyse_surface", *SOLUTIONS},
    ),
    "label of a material": (
        "config/materials.yaml",
        ("{common: pdms}", "{common: pdms, label: silicone}"),
        {"judge", "write_surface", "write_report"},
        {"analyse_surface", "plot_fig6", *SOLUTIONS},
    ),
    "label of a surface": (
        "config/tiny_surfaces.yaml",
        ("label: ultrananocrystalline diamond", "label: diamond"),
        {"judge", "write_surface", "write_report", "check_claims"},
        {"analyse_surface", "plot_fig6", *SOLUTIONS},
    ),
    "experiment": (
        "config/tiny_experiments.yaml",
        ("value: 0.22 MPa", "value: 0.23 MPa"),
        {"predict_experiments", "check_claims", "write_report"},
        {"judge", "analyse_surface", *SOLUTIONS},
    ),
    "seed": (
        "config/tiny.yaml",
        (" seeds: 2, coarse_", " seeds: 3, coarse_"),
        {"synthesise_surface", "solve_repulsive", "answer_case"},
        {"solve_coarse", "persson_sweep", "persson_lattice", "analyse_surface", "judge"},
    ),
    "coarse seeds": (
        "config/tiny.yaml",
        ("coarse_seeds: 32", "coarse_seeds: 40"),
        {"solve_coarse", "answer_case"},
        {"synthesise_surface", "solve_repulsive", "persson_lattice"},
    ),
    "theory": (
        "scripts/stickiness/persson/theory.py",
        ("class Persson", "A_CHANGE = 1\n\n\nclass Persson"),
        # What is known of a surface includes its a_V by theory.
        {"persson_sweep", "persson_lattice", "analyse_surface"},
        {"answer_case", *SOLUTIONS},
    ),
    "solver": (
        "scripts/stickiness/repulsive/solver.py",
        ("def solve(", "A_CHANGE = 1\n\n\ndef solve("),
        # Contact is simulated on measured heights, too.
        {"solve_repulsive", "solve_coarse", "contact_maps", "analyse_surface"},
        {"synthesise_surface"},
    ),
}


@pytest.mark.parametrize(("path", "texts", "reruns", "leaves"), CHANGES.values(), ids=CHANGES)
def test_a_change_reruns_what_uses_it(copy_of_finished, path, texts, reruns, leaves):
    copy_of_finished.edit(path, *texts)
    planned = copy_of_finished.planned().keys()
    assert reruns <= planned
    assert leaves.isdisjoint(planned)


def test_changes_of_cases_rerun_those_cases_and_what_averages_them(copy_of_finished):
    """Other loads of one case, a seed for one, plain means for one."""
    copy_of_finished.add("cases:\n  H0.8_zeta32_wide: {pressures: [0.03, 0.065, 0.07]}\n")
    planned = copy_of_finished.planned("fig5")
    assert planned["solve_repulsive"] == 1
    assert {"answer_case", "map_criterion"} <= planned.keys()
    assert copy_of_finished.planned("verdicts") == {}

    copy_of_finished.edit(
        "config/tiny.yaml",
        "H0.8_zeta32_wide: {pressures: [0.03, 0.065, 0.07]}",
        "H0.9_zeta64: {seeds: 3}",
    )
    planned = copy_of_finished.planned()
    assert planned["synthesise_surface"] == planned["solve_repulsive"] == 1
    assert planned["answer_case"] == 1

    copy_of_finished.edit("config/tiny.yaml", "{seeds: 3}", "{sampling: plain}")
    planned = copy_of_finished.planned()
    assert planned["answer_case"] == 1
    assert SOLUTIONS.isdisjoint(planned)


def plan_changes(workflow):
    """What a change solves by rule, and the cases that it answers; the rest shows these."""
    planned = workflow.outputs("all", "cases")
    solved = {rule: files for rule, files in planned.items() if rule in SOLVING}
    answered = {
        file.removeprefix("cases/").removesuffix(".nc")
        for rule, files in planned.items()
        if rule in ANSWERING
        for file in files
        if file.startswith("cases/")
    }
    assert planned.keys() - SOLVING - ANSWERING <= SHOWING
    return solved, answered


SURFACE = "{surface: H0.7_zeta64, pressures: "
SHORT = "[0.0065, 0.03, 0.065, 0.13, 0.3"  # loads of the case on this surface
ALL_CASES = {"H0.8_zeta32", "H0.8_zeta64", "H0.8_zeta128", "H0.8_zeta32_wide"}
ALL_CASES |= {"H0.7_zeta64", "H0.9_zeta64"}
FINE, COARSE = "contact/H0.7_zeta64@4_1e-06/seeds", "contact/H0.7_zeta64@2_1e-06/coarse"
SURFACES = "surfaces/H0.7_zeta64@4/seeds"
MORE_SEEDS = {
    "synthesise_surface": {f"{SURFACES}3-4.nc"},
    "solve_repulsive": {f"{FINE}3-4_p0.03.nc"},
}

# Additions to a finished run: lines of cases, what is solved for them, and what is answered.
ADDITIONS = {
    "case of fewer seeds": (f"  mine: {SURFACE}[0.03], seeds: 1}}", {}, {"mine"}),
    "case of more seeds": (f"  mine: {SURFACE}[0.03], seeds: 4}}", MORE_SEEDS, {"mine"}),
    "case with a load of its own": (
        f"  mine: {SURFACE}[0.03, 0.05], seeds: 1}}",
        {
            "solve_repulsive": {f"{FINE}1-1_p0.05.nc"},
            "solve_coarse": {f"{COARSE}1-32_p0.05.nc"},
        },
        {"mine"},
    ),
    "case of theory": (f"  mine: {SURFACE}[0.03], model: theory}}", {}, {"mine"}),
    "seeds of a case": (
        "  H0.7_zeta64: {seeds: 4}",
        {
            "synthesise_surface": {f"{SURFACES}3-4.nc"},
            "solve_repulsive": {f"{FINE}3-4_p0.0065_0.03_0.065_0.13_0.3.nc"},
        },
        {"H0.7_zeta64"},
    ),
    "load of a case": (
        f"  H0.7_zeta64: {{pressures: {SHORT}, 0.05]}}",
        {
            "solve_repulsive": {f"{FINE}1-2_p0.05.nc"},
            "solve_coarse": {f"{COARSE}1-32_p0.05.nc"},
        },
        {"H0.7_zeta64"},
    ),
    "fewer loads of a case": ("  H0.7_zeta64: {pressures: [0.03, 0.065]}", {}, {"H0.7_zeta64"}),
    "quantity of a case": (
        "  H0.7_zeta64: {quantities: [a_v, contact_slope]}",
        {},
        {"H0.7_zeta64"},
    ),
}


@pytest.mark.parametrize(("case", "solved", "answered"), ADDITIONS.values(), ids=ADDITIONS)
def test_only_what_is_new_is_solved(copy_of_finished, case, solved, answered):
    copy_of_finished.add(f"cases:\n{case}\n")
    assert plan_changes(copy_of_finished) == (solved, answered)


def test_a_new_case_leaves_the_figures_of_other_cases(copy_of_finished):
    copy_of_finished.add("cases:\n  mine: {surface: H0.7_zeta64, pressures: [0.05]}\n")
    assert copy_of_finished.planned("fig1", "fig2", "fig4") == {}
    assert copy_of_finished.planned("results/tiny/persson/lattice/mine.nc") == {
        "persson_lattice": 1
    }


def test_a_new_surface_a_material_and_a_case_that_goes_solve_nothing_else(copy_of_finished):
    copy_of_finished.add("cases:\n  mine: {surface: new, pressures: [0.05]}\n")
    config = "config/tiny.yaml"
    new = "model_surfaces:\n  new: {hurst: 0.6, magnification: 8}\n"
    copy_of_finished.edit(config, "model_surfaces:\n", new)
    solved = {
        "synthesise_surface": {"surfaces/new@4/seeds1-2.nc"},
        "solve_repulsive": {"contact/new@4_1e-06/seeds1-2_p0.05.nc"},
        "solve_coarse": {"contact/new@2_1e-06/coarse1-32_p0.05.nc"},
    }
    assert plan_changes(copy_of_finished) == (solved, {"mine"})
    copy_of_finished.edit(config, "cases:\n  mine: {surface: new, pressures: [0.05]}\n", "")
    assert copy_of_finished.planned() == {}

    # A case of the configuration that every run includes.
    text = "  H0.9_zeta64:\n    surface: H0.9_zeta64\n    pressures: *short\n"
    copy_of_finished.edit("config/config.yaml", text, "")
    copy_of_finished.edit(
        "config/config.yaml", "high_hurst: H0.9_zeta64", "high_hurst: H0.7_zeta64"
    )
    assert plan_changes(copy_of_finished) == ({}, set())
    copy_of_finished.edit(
        "config/config.yaml", "  H0.7_zeta64:\n    surface", "  renamed:\n    surface"
    )
    for role in ("low_hurst", "high_hurst"):
        copy_of_finished.edit("config/config.yaml", f"{role}: H0.7_zeta64", f"{role}: renamed")
    assert plan_changes(copy_of_finished) == ({}, {"renamed"})

    before = copy_of_finished.outputs()
    copy_of_finished.add("  mine: {common: pdms}\n", "config/materials.yaml")
    after = copy_of_finished.outputs()
    assert before.keys() & (SOLVING | ANSWERING) == after.keys() & (SOLVING | ANSWERING)
    assert {"judge", "write_surface"} <= after.keys() - before.keys()


def run_verdicts(workflow):
    """Materials that a run for verdicts judges, by surface; a job's log says it."""
    logs = workflow / "results/tiny/logs/judge_surface/criteria/verdicts"
    for log in logs.glob("*.log"):
        log.unlink()
    done = workflow.snakemake("verdicts")
    assert done.returncode == 0, done.stdout
    said = {log.stem: log.read_text(encoding="utf-8") for log in logs.glob("*.log")}
    return {name: re.search(r" judges (.*)", text)[1] for name, text in said.items()}


def test_a_new_material_and_a_new_surface_are_judged_alone_and_a_label_judges_nothing(
    copy_of_finished,
):
    workflow = copy_of_finished
    before = datasets.read(workflow / "results/tiny/criteria/verdicts.nc")
    names = list(FEW["surfaces"])
    workflow.add("  mine: {common: pdms, work_of_adhesion: 30 mJ/m^2}\n", "config/materials.yaml")
    assert run_verdicts(workflow) == dict.fromkeys(names, "mine")
    after = datasets.read(workflow / "results/tiny/criteria/verdicts.nc")
    assert after.material.values.tolist() == [*before.material.values, "mine"]
    assert after.sel(material=before.material).equals(before)

    workflow.edit("config/materials.yaml", "{common: pdms,", "{common: pdms, label: my silicone,")
    new = "  mine: {kind: self_affine, label: mine, source: own, hurst: 0.8, "
    new += "h_rms: 1 um, longest_wavelength: 1 mm, shortest_wavelength: 10 nm}\n"
    workflow.add(new, "config/tiny_surfaces.yaml")
    every = ", ".join(after.material.values)
    assert run_verdicts(workflow) == dict.fromkeys(names, "no material anew") | {"mine": every}
    labelled = datasets.read(workflow / "results/tiny/criteria/verdicts.nc")
    assert labelled.material_label.sel(material="mine") == "my silicone"
    rest, before = (each.drop_vars("material_label") for each in (labelled, after))
    assert rest.sel(surface=names).equals(before.sel(surface=names))


def test_what_was_solved_for_a_case_outlives_it(copy_of_finished):
    """More seeds and loads are solved; then the case changes in every way, and goes."""
    workflow, config = copy_of_finished, "config/tiny.yaml"
    case = f"  mine: {SURFACE}[0.03, 0.05], seeds: 4, quantities: [area]}}\n"
    workflow.add(f"cases:\n  H0.9_zeta64: {{seeds: 3}}\n{case}")
    cases = ["results/tiny/cases/mine.nc", "results/tiny/cases/H0.9_zeta64.nc"]
    done = workflow.snakemake(*cases)
    assert done.returncode == 0, done.stdout
    assert workflow.planned(*cases) == {}

    def change(old, new):
        workflow.edit(config, old, new)
        solved, answered = plan_changes(workflow)
        assert solved == {}
        return answered - {"H0.9_zeta64"}

    # The other case shares a file with this one, and does not notice.
    assert change("seeds: 3}", "seeds: 3}  # nothing") == set()
    assert change("seeds: 4, quantities", "seeds: 2, quantities") == {"mine"}
    assert change("[0.03, 0.05], seeds: 2", "[0.03], seeds: 2") == {"mine"}
    assert change("quantities: [area]", "quantities: [area, a_v, contact_slope]") == {"mine"}
    assert change("  mine:", "  yours:") == {"yours"}
    assert change("  H0.9_zeta64: {seeds: 3}", "  H0.9_zeta64: {seeds: 2}") == {"yours"}
    assert plan_changes(workflow) == ({}, {"yours", "H0.9_zeta64"})
    text = (workflow / config).read_text(encoding="utf-8")
    (workflow / config).write_text(text[: text.index("cases:\n")], encoding="utf-8")
    assert plan_changes(workflow) == ({}, {"H0.9_zeta64"})


def test_another_fidelity_or_preset_and_back_solves_nothing(copy_of_finished):
    workflow, config = copy_of_finished, "config/tiny.yaml"
    answers = ["results/tiny/cases/H0.7_zeta64.nc"]
    workflow.edit(config, "tiny: {pixels_per_wavelength: 4", "tiny: {pixels_per_wavelength: 6")
    done = workflow.snakemake(*answers)
    assert done.returncode == 0, done.stdout
    for name in ("surfaces/H0.7_zeta64@6", "contact/H0.7_zeta64@6_1e-06"):
        assert list((workflow / "results/tiny" / name).glob("seeds1-2*.nc"))
    # The coarse grid is the same.
    assert len(list((workflow / "results/tiny/contact/H0.7_zeta64@2_1e-06").iterdir())) == 1
    workflow.edit(config, "tiny: {pixels_per_wavelength: 6", "tiny: {pixels_per_wavelength: 4")
    assert plan_changes(workflow) == ({}, {"H0.7_zeta64"})

    workflow.edit(config, "fidelity: tiny", "fidelity: draft")
    planned = workflow.planned("cases")
    assert planned["solve_repulsive"] == 6
    assert {"judge_surface", "write_surface"} <= workflow.planned("verdicts", "surfaces").keys()
    assert "analyse_surface" not in workflow.planned("verdicts", "surfaces")
    workflow.edit(config, "fidelity: draft", "fidelity: tiny")
    assert plan_changes(workflow) == ({}, {"H0.7_zeta64"})


def test_comments_docstrings_and_times_of_change_rerun_nothing(copy_of_finished):
    time.sleep(1.1)  # file systems with whole-second time stamps
    copy_code(copy_of_finished.folder)
    for file in (copy_of_finished / "scripts").rglob("*.py"):
        text = file.read_text(encoding="utf-8")
        file.write_text(text.replace('"""', '"""Other words. ', 1) + "\n# A comment.\n")
    assert copy_of_finished.planned() == {}


@pytest.mark.parametrize(
    ("targets", "runs", "leaves"),
    [
        ("fig3", {"plot_fig3", "solve_repulsive"}, {"analyse_surface", "judge"}),
        ("claims", {"check_claims"}, {"plot_fig1", "write_report"}),
        ("experiments", {"predict_experiments"}, {"solve_repulsive", "judge", "check_claims"}),
        (
            "fig6 results/tiny/persson/sweeps/fig1a.nc",
            {"plot_fig6", "analyse_surface", "persson_sweep"},
            {"solve_repulsive", "judge"},
        ),
    ],
)
def test_targets_run_what_they_need(fresh, targets, runs, leaves):
    planned = fresh.planned(*targets.split()).keys()
    assert runs <= planned
    assert leaves.isdisjoint(planned)


def test_adhesion_is_solved_in_full_only_where_the_dmt_limit_is_not_good_enough(fresh):
    models = {
        "rough": "model: auto, accuracy: 0.15",
        "close": "model: auto, accuracy: 0.01",
        "limit": "model: dmt",
        "full": "model: full",
    }
    # The least rough of the surfaces on which the error of the DMT sum was measured.
    fresh.edit(
        "config/tiny.yaml", "{hurst: 0.8, magnification: 4}", "{hurst: 0.8, magnification: 32}"
    )
    for name, model in models.items():
        fresh.add(
            f"  {name}: {{case: H0.8_zeta32, q0_h_rms: 0.1, range_over_h_rms: [3], "
            "adhesion_length_over_range: [0.001, 0.003], pressures: [0.0065, 0.065], "
            f"law: exponential, {model}}}\n"
        )
    done = fresh.dry_run(*(f"results/tiny/adhesion/full/{name}.nc" for name in models))
    assert done.returncode == 0, done.stdout
    solved = re.findall(r"output: results/tiny/adhesion/full/(\w+)/seeds", done.stdout)
    assert set(solved) == {"close", "full"}
