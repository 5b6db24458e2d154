# What each case asks for, with its errors by source: means over its realisations, the slope of area
# against load, and a_V if it is wanted; or Persson's theory.

SIMULATED_CASES = [case for case, planned in PLANS.items() if planned.simulated]


def describe_plan(wildcards):
    """What a case's answer needs to know of its plan."""
    case, planned = CASES[wildcards.case], PLANS[wildcards.case]
    descriptors = config["sampling"]["descriptor_seeds"]
    return {
        "quantities": list(planned.quantities),
        "pressures": list(planned.pressures),
        "simulated": planned.simulated,
        "settings": vars(planned.settings),
        "surface": model_surface_of(wildcards.case),
        "accuracy": case["accuracy"],
        "descriptor_seeds": descriptors if planned.settings.coarse_seeds else 0,
    }


# Every case has the file of a_V, which is empty if the case does not want it: Snakemake notices that a
# case wants more only if all files of its job are there.
rule answer_case:
    input:
        laws=ERROR_MODELS,
        realisations=lambda wildcards: solutions_of(wildcards.case),
        coarse=lambda wildcards: coarse_of(wildcards.case),
    output:
        means=f"{RESULTS}/contact/ensembles/{{case}}.nc",
        kappa=f"{RESULTS}/fits/kappa/{{case}}.nc",
        a_v=f"{RESULTS}/fits/a_v/ensembles/{{case}}.nc",
        answer=f"{RESULTS}/cases/{{case}}.nc",
    log:
        f"{RESULTS}/logs/answer_case/cases/{{case}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/answer_case/cases/{{case}}.tsv"
    wildcard_constraints:
        case=choices(SIMULATED_CASES),
    conda:
        "../envs/environment.yaml"
    resources:
        runtime=few_minutes,
    params:
        plan=describe_plan,
        windows=config["a_v"]["windows"],
        code=source_hash("cases/answer_case.py"),
    message:
        "Average realisations and fit kappa and a_V: {wildcards.case}"
    script:
        "../scripts/cases/answer_case.py"


use rule answer_case as answer_by_theory with:
    input:
        laws=ERROR_MODELS,
        theory=rules.persson_lattice.output.theory[0],
    output:
        answer=f"{RESULTS}/cases/{{case}}.nc",
    log:
        f"{RESULTS}/logs/answer_by_theory/cases/{{case}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/answer_by_theory/cases/{{case}}.tsv"
    wildcard_constraints:
        case=choices(case for case in CASES if case not in SIMULATED_CASES),
    message:
        "Answer a case by Persson's theory: {wildcards.case}"
