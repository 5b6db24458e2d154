# What each case asks for, with its errors by source.


def behind_answer(wildcards):
    """Files that the quantities of a case rest on, and no others."""
    case, planned = wildcards.case, PLANS[wildcards.case]
    if not planned.simulated:
        return {"solved": f"{RESULTS}/persson/lattice/{case}.nc"}
    files = {"solved": f"{RESULTS}/contact/ensembles/{case}.nc"}
    if "a_v" in planned.quantities:
        files["a_v"] = a_v_of_simulation(case)
    if "kappa" in planned.quantities:
        files["kappa"] = f"{RESULTS}/fits/kappa/{case}.nc"
    return files


def describe_plan(wildcards):
    """What a case's answer needs to know of its plan."""
    case, planned = CASES[wildcards.case], PLANS[wildcards.case]
    return {
        "quantities": list(planned.quantities),
        "pressures": list(planned.pressures),
        "simulated": planned.simulated,
        "settings": vars(planned.settings),
        "surface": model_surface_of(wildcards.case),
        "accuracy": case.get("accuracy"),
    }


rule answer_case:
    input:
        unpack(behind_answer),
        laws=ERROR_MODELS,
    output:
        f"{RESULTS}/cases/{{case}}.nc",
    log:
        f"{RESULTS}/logs/answer_case/cases/{{case}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/answer_case/cases/{{case}}.tsv"
    conda:
        "../envs/environment.yaml"
    params:
        plan=describe_plan,
        fit_interval=config["a_v"]["windows"][0],
        code=source_hash("cases/answer_case.py"),
    script:
        "../scripts/cases/answer_case.py"
