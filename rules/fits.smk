# a_V and kappa_rep from simulation and theory, with their errors and what the fit interval does to
# them; where theory departs from simulation; a_V in a table.

# Where the attractive areas behind a fit of a_V come from.
A_V_SOURCES = {
    "ensembles": "contact/ensembles",
    "sweeps": "persson/sweeps",
    "lattice": "persson/lattice",
}

# Whatever is simulated for every quantity, with which theory is compared.
SIMULATED = [*COMPLETE, *COMPARISONS]


rule fit_a_v:
    input:
        laws=ERROR_MODELS,
        areas=lambda wildcards: f"{RESULTS}/{A_V_SOURCES[wildcards.source]}/{wildcards.name}.nc",
    output:
        f"{RESULTS}/fits/a_v/{{source}}/{{name}}.nc",
    wildcard_constraints:
        source=choices(A_V_SOURCES),
        name="[^/]+",
    params:
        windows=config["a_v"]["windows"],
    script:
        "../scripts/fits/fit_a_v.py"


rule fit_kappa:
    input:
        laws=ERROR_MODELS,
        ensemble=f"{RESULTS}/contact/ensembles/{{case}}.nc",
        theory=f"{RESULTS}/persson/lattice/{{case}}.nc",
    output:
        f"{RESULTS}/fits/kappa/{{case}}.nc",
    script:
        "../scripts/fits/fit_kappa.py"


rule compare_theory:
    input:
        ensemble=f"{RESULTS}/contact/ensembles/{{compared}}.nc",
        theory=f"{RESULTS}/persson/lattice/{{compared}}.nc",
    output:
        f"{RESULTS}/fits/theory/{{compared}}.nc",
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
