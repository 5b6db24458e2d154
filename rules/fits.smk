# a_V and kappa_rep from simulation and theory, with their errors and window sensitivity, what
# separates theory from simulation, and what each case asks for with the sources of its errors.

# Where the attractive areas behind a fit of a_V come from.
A_V_SOURCES = {
    "ensembles": "contact/ensembles",
    "sweeps": "persson/sweeps",
    "lattice": "persson/lattice",
}


rule fit_a_v:
    input:
        library=library_of("fits/fit_a_v.py"),
        laws=config["tradeoff"]["table"],
        areas=lambda wildcards: f"{RESULTS}/{A_V_SOURCES[wildcards.source]}/{wildcards.name}.nc",
    output:
        f"{RESULTS}/fits/a_v/{{source}}/{{name}}.nc",
    log:
        f"{LOGS}/fit_a_v/{{source}}/{{name}}.log",
    benchmark:
        f"{BENCHMARKS}/fit_a_v/{{source}}/{{name}}.tsv"
    wildcard_constraints:
        source="|".join(A_V_SOURCES),
        name="[^/]+",
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=500,
    params:
        windows=config["a_v"]["windows"],
    script:
        "../scripts/fits/fit_a_v.py"


rule fit_kappa:
    input:
        library=library_of("fits/fit_kappa.py"),
        laws=config["tradeoff"]["table"],
        ensemble=f"{RESULTS}/contact/ensembles/{{case}}.nc",
        theory=f"{RESULTS}/persson/lattice/{{case}}.nc",
    output:
        f"{RESULTS}/fits/kappa/{{case}}.nc",
    log:
        f"{LOGS}/fit_kappa/{{case}}.log",
    benchmark:
        f"{BENCHMARKS}/fit_kappa/{{case}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=500,
    script:
        "../scripts/fits/fit_kappa.py"


rule compare_theory:
    input:
        library=library_of("fits/compare_theory.py"),
        ensemble=f"{RESULTS}/contact/ensembles/{{compared}}.nc",
        theory=f"{RESULTS}/persson/lattice/{{compared}}.nc",
    output:
        f"{RESULTS}/fits/theory/{{compared}}.nc",
    log:
        f"{LOGS}/compare_theory/{{compared}}.log",
    benchmark:
        f"{BENCHMARKS}/compare_theory/{{compared}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=500,
    script:
        "../scripts/fits/compare_theory.py"


rule answer_case:
    input:
        unpack(behind_answer),
        library=library_of("cases/answer_case.py"),
        laws=config["tradeoff"]["table"],
    output:
        f"{RESULTS}/cases/{{case}}.nc",
    log:
        f"{LOGS}/answer_case/{{case}}.log",
    benchmark:
        f"{BENCHMARKS}/answer_case/{{case}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=500,
    params:
        plan=lambda wildcards: summary_of_plan(wildcards.case),
        fit_interval=config["a_v"]["windows"][0],
    script:
        "../scripts/cases/answer_case.py"


rule tabulate_a_v:
    input:
        library=library_of("fits/tabulate_a_v.py"),
        theory=f"{RESULTS}/persson/table.nc",
        comparisons=expand(f"{RESULTS}/fits/theory/{{compared}}.nc", compared=SIMULATED),
    output:
        f"{RESULTS}/fits/a_v_table.nc",
    log:
        f"{LOGS}/tabulate_a_v.log",
    benchmark:
        f"{BENCHMARKS}/tabulate_a_v.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=500,
    script:
        "../scripts/fits/tabulate_a_v.py"


rule fit_gamma:
    input:
        library=library_of("fits/fit_gamma.py"),
        ensembles=expand(f"{RESULTS}/contact/ensembles/{{compared}}.nc", compared=SIMULATED),
        comparisons=expand(f"{RESULTS}/fits/theory/{{compared}}.nc", compared=SIMULATED),
    output:
        f"{RESULTS}/fits/gamma.nc",
    log:
        f"{LOGS}/fit_gamma.log",
    benchmark:
        f"{BENCHMARKS}/fit_gamma.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=500,
    script:
        "../scripts/fits/fit_gamma.py"
