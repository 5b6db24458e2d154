# a_V of simulation, with its errors and what the fit interval does to it; where theory departs from
# simulation; a_V in a table.

# Whatever is simulated for every quantity, with which theory is compared.
SIMULATED = [*COMPLETE, *COMPARISONS]


rule fit_a_v:
    input:
        laws=ERROR_MODELS,
        areas=f"{RESULTS}/contact/ensembles/{{case}}.nc",
    output:
        f"{RESULTS}/fits/a_v/ensembles/{{case}}.nc",
    log:
        f"{RESULTS}/logs/fit_a_v/fits/a_v/ensembles/{{case}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/fit_a_v/fits/a_v/ensembles/{{case}}.tsv"
    conda:
        "../envs/environment.yaml"
    params:
        windows=config["a_v"]["windows"],
        code=source_hash("fits/fit_a_v.py"),
    script:
        "../scripts/fits/fit_a_v.py"


# One job for all: each takes less time than a job takes to start.
if SIMULATED:

    rule compare_theory:
        input:
            ensembles=several("contact/ensembles/{compared}.nc", compared=SIMULATED),
            theories=several("persson/lattice/{compared}.nc", compared=SIMULATED),
        output:
            several("fits/theory/{compared}.nc", compared=SIMULATED),
        log:
            f"{RESULTS}/logs/compare_theory/fits/theory.log",
        benchmark:
            f"{RESULTS}/benchmarks/compare_theory/fits/theory.tsv"
        conda:
            "../envs/environment.yaml"
        params:
            code=source_hash("fits/compare_theory.py"),
        script:
            "../scripts/fits/compare_theory.py"


rule tabulate_a_v:
    input:
        theory=f"{RESULTS}/persson/table.nc",
        comparisons=expand(f"{RESULTS}/fits/theory/{{compared}}.nc", compared=SIMULATED),
    output:
        f"{RESULTS}/fits/a_v_table.nc",
    log:
        f"{RESULTS}/logs/tabulate_a_v/fits/a_v_table.log",
    benchmark:
        f"{RESULTS}/benchmarks/tabulate_a_v/fits/a_v_table.tsv"
    conda:
        "../envs/environment.yaml"
    params:
        code=source_hash("fits/tabulate_a_v.py"),
    script:
        "../scripts/fits/tabulate_a_v.py"


rule fit_gamma:
    input:
        ensembles=expand(f"{RESULTS}/contact/ensembles/{{compared}}.nc", compared=SIMULATED),
        comparisons=expand(f"{RESULTS}/fits/theory/{{compared}}.nc", compared=SIMULATED),
    output:
        f"{RESULTS}/fits/gamma.nc",
    log:
        f"{RESULTS}/logs/fit_gamma/fits/gamma.log",
    benchmark:
        f"{RESULTS}/benchmarks/fit_gamma/fits/gamma.tsv"
    conda:
        "../envs/environment.yaml"
    params:
        code=source_hash("fits/fit_gamma.py"),
    script:
        "../scripts/fits/fit_gamma.py"
