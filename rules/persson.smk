# Persson's theory: on continuous spectra for the paper's sweeps, and on the discrete spectrum that the
# cell of a simulated case really holds; a_V fitted to both.


rule persson_sweep:
    input:
        laws=ERROR_MODELS,
    output:
        theory=f"{RESULTS}/persson/sweeps/{{sweep}}.nc",
        a_v=f"{RESULTS}/fits/a_v/sweeps/{{sweep}}.nc",
    params:
        sweep=lambda wildcards: SWEEPS[wildcards.sweep],
        variants=config["theory"]["variants"],
        gamma=GAMMA,
        gaps=GAPS,
        windows=config["a_v"]["windows"],
    script:
        "../scripts/persson/persson_sweep.py"


rule persson_lattice:
    input:
        laws=ERROR_MODELS,
    output:
        theory=f"{RESULTS}/persson/lattice/{{compared}}.nc",
        a_v=f"{RESULTS}/fits/a_v/lattice/{{compared}}.nc",
    params:
        surface=lambda wildcards: model_surface_of(wildcards.compared),
        pressures=lambda wildcards: pressures_of(wildcards.compared),
        windows=config["a_v"]["windows"],
        simulated=lambda wildcards: wildcards.compared in SIMULATED,
        variants=config["theory"]["variants"],
        gamma=GAMMA,
        gaps=GAPS,
    script:
        "../scripts/persson/persson_lattice.py"


rule persson_table:
    input:
        laws=ERROR_MODELS,
    output:
        f"{RESULTS}/persson/table.nc",
    resources:
        runtime=20,
    params:
        table=config["theory"]["table"],
        gamma=GAMMA,
    script:
        "../scripts/persson/persson_table.py"
