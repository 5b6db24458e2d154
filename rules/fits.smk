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
    params:
        windows=config["a_v"]["windows"],
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
        script:
            "../scripts/fits/compare_theory.py"


rule tabulate_a_v:
    input:
        theory=f"{RESULTS}/persson/table.nc",
        comparisons=expand(f"{RESULTS}/fits/theory/{{compared}}.nc", compared=SIMULATED),
    output:
        f"{RESULTS}/fits/a_v_table.nc",
    script:
        "../scripts/fits/tabulate_a_v.py"


rule fit_gamma:
    input:
        ensembles=expand(f"{RESULTS}/contact/ensembles/{{compared}}.nc", compared=SIMULATED),
        comparisons=expand(f"{RESULTS}/fits/theory/{{compared}}.nc", compared=SIMULATED),
    output:
        f"{RESULTS}/fits/gamma.nc",
    script:
        "../scripts/fits/fit_gamma.py"
