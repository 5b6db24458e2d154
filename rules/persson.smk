# Persson's theory: on continuous spectra for the paper's sweeps, and on the discrete spectrum that the
# cell of a simulated case really holds; a_V fitted to both.


rule persson_sweep:
    input:
        laws=ERROR_MODELS,
    output:
        theory=f"{RESULTS}/persson/sweeps/{{sweep}}.nc",
        a_v=f"{RESULTS}/fits/a_v/sweeps/{{sweep}}.nc",
    log:
        f"{RESULTS}/logs/persson_sweep/persson/sweeps/{{sweep}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/persson_sweep/persson/sweeps/{{sweep}}.tsv"
    conda:
        "../envs/environment.yaml"
    params:
        sweep=lambda wildcards: SWEEPS[wildcards.sweep],
        variants=config["theory"]["variants"],
        gamma=GAMMA,
        gaps=GAPS,
        windows=config["a_v"]["windows"],
        code=source_hash("persson/persson_sweep.py"),
    script:
        "../scripts/persson/persson_sweep.py"


rule persson_lattice:
    input:
        laws=ERROR_MODELS,
    output:
        theory=f"{RESULTS}/persson/lattice/{{compared}}.nc",
        a_v=f"{RESULTS}/fits/a_v/lattice/{{compared}}.nc",
    log:
        f"{RESULTS}/logs/persson_lattice/persson/lattice/{{compared}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/persson_lattice/persson/lattice/{{compared}}.tsv"
    conda:
        "../envs/environment.yaml"
    params:
        surface=lambda wildcards: model_surface_of(wildcards.compared),
        pressures=lambda wildcards: pressures_of(wildcards.compared),
        windows=config["a_v"]["windows"],
        simulated=lambda wildcards: wildcards.compared in SIMULATED,
        variants=config["theory"]["variants"],
        gamma=GAMMA,
        gaps=GAPS,
        code=source_hash("persson/persson_lattice.py"),
    script:
        "../scripts/persson/persson_lattice.py"


rule persson_table:
    input:
        laws=ERROR_MODELS,
    output:
        f"{RESULTS}/persson/table.nc",
    log:
        f"{RESULTS}/logs/persson_table/persson/table.log",
    benchmark:
        f"{RESULTS}/benchmarks/persson_table/persson/table.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        runtime=20,
    params:
        table=config["theory"]["table"],
        gamma=GAMMA,
        code=source_hash("persson/persson_table.py"),
    script:
        "../scripts/persson/persson_table.py"
