# Persson's theory: on continuous spectra for the paper's sweeps, and on the discrete spectrum that the
# cell of a simulated case really holds.


rule persson_sweep:
    input:
        laws=ERROR_MODELS,
    output:
        f"{RESULTS}/persson/sweeps/{{sweep}}.nc",
    params:
        sweep=lambda wildcards: SWEEPS[wildcards.sweep],
        variants=config["theory"]["variants"],
        gamma=GAMMA,
        gaps=GAPS,
    script:
        "../scripts/persson/persson_sweep.py"


rule persson_lattice:
    input:
        laws=ERROR_MODELS,
    output:
        f"{RESULTS}/persson/lattice/{{compared}}.nc",
    params:
        surface=lambda wildcards: model_surface_of(wildcards.compared),
        pressures=lambda wildcards: pressures_of(wildcards.compared),
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
