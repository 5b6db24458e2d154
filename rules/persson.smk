# Persson's theory: on continuous spectra for the paper's sweeps, on the lattice spectrum that the
# window of a simulated case really holds, and on the spectra of real surfaces.


rule persson_sweep:
    input:
        library=library_of("persson/persson_sweep.py"),
        laws=config["tradeoff"]["table"],
    output:
        f"{RESULTS}/persson/sweeps/{{sweep}}.nc",
    log:
        f"{LOGS}/persson_sweep/{{sweep}}.log",
    benchmark:
        f"{BENCHMARKS}/persson_sweep/{{sweep}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=1000,
    params:
        sweep=lambda wildcards: SWEEPS[wildcards.sweep],
        variants=config["theory"]["variants"],
        gamma=config["theory"]["gamma"],
        gaps=config["gaps"],
    script:
        "../scripts/persson/persson_sweep.py"


rule persson_lattice:
    input:
        library=library_of("persson/persson_lattice.py"),
        laws=config["tradeoff"]["table"],
    output:
        f"{RESULTS}/persson/lattice/{{compared}}.nc",
    log:
        f"{LOGS}/persson_lattice/{{compared}}.log",
    benchmark:
        f"{BENCHMARKS}/persson_lattice/{{compared}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=1000,
    params:
        surface=lambda wildcards: COMPARED[wildcards.compared][0],
        pressures=lambda wildcards: COMPARED[wildcards.compared][1],
        variants=config["theory"]["variants"],
        gamma=config["theory"]["gamma"],
        gaps=config["gaps"],
    script:
        "../scripts/persson/persson_lattice.py"


rule persson_surface:
    input:
        library=library_of("persson/persson_surface.py"),
        laws=config["tradeoff"]["table"],
        surface=f"{RESULTS}/real_surfaces/{{real_surface}}.nc",
    output:
        f"{RESULTS}/persson/surfaces/{{real_surface}}.nc",
    log:
        f"{LOGS}/persson_surface/{{real_surface}}.log",
    benchmark:
        f"{BENCHMARKS}/persson_surface/{{real_surface}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=500,
    params:
        gamma=config["theory"]["gamma"],
        pressure=config["criteria"]["a_v"]["pressure"],
        ranges=config["criteria"]["ranges"],
    script:
        "../scripts/persson/persson_surface.py"


rule persson_table:
    input:
        library=library_of("persson/persson_table.py"),
        laws=config["tradeoff"]["table"],
    output:
        f"{RESULTS}/persson/table.nc",
    log:
        f"{LOGS}/persson_table.log",
    benchmark:
        f"{BENCHMARKS}/persson_table.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=1000,
        runtime=20,
    params:
        table=config["theory"]["table"],
        gamma=config["theory"]["gamma"],
    script:
        "../scripts/persson/persson_table.py"
