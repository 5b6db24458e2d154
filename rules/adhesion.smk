# Adhesion in the DMT limit, summed over the gaps of the repulsive solution, and in full, by boundary
# elements with a traction law, at the points where the former is not known to be good enough.


rule adhesion_dmt:
    input:
        library=library_of("adhesion/adhesion_dmt.py"),
        laws=config["tradeoff"]["table"],
        ensemble=lambda wildcards: (
            f"{RESULTS}/contact/ensembles/{ADHESION[wildcards.adhesion]['case']}.nc"
        ),
    output:
        f"{RESULTS}/adhesion/dmt/{{adhesion}}.nc",
    log:
        f"{LOGS}/adhesion_dmt/{{adhesion}}.log",
    benchmark:
        f"{BENCHMARKS}/adhesion_dmt/{{adhesion}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=500,
    params:
        adhesion=lambda wildcards: ADHESION[wildcards.adhesion],
        dmt_error=lambda wildcards: model_of(wildcards.adhesion).dmt_error.tolist(),
        jtb=lambda wildcards: model_of(wildcards.adhesion).jtb.tolist(),
    script:
        "../scripts/adhesion/adhesion_dmt.py"


rule solve_adhesive:
    input:
        library=library_of("adhesion/solve_adhesive.py"),
        surface=lambda wildcards: surface_of(adhesive_case(wildcards)),
    output:
        f"{RESULTS}/adhesion/full/{{adhesion}}/seed{{seed}}.nc",
    log:
        f"{LOGS}/solve_adhesive/{{adhesion}}/seed{{seed}}.log",
    benchmark:
        f"{BENCHMARKS}/solve_adhesive/{{adhesion}}/seed{{seed}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=memory_of("solve_adhesive"),
        runtime=runtime_of("solve_adhesive"),
    params:
        adhesion=solved_in_full,
        full=lambda wildcards: model_of(wildcards.adhesion).full.tolist(),
    script:
        "../scripts/adhesion/solve_adhesive.py"


rule average_adhesive:
    input:
        library=library_of("adhesion/average_adhesive.py"),
        limit=f"{RESULTS}/adhesion/dmt/{{adhesion}}.nc",
        ensemble=lambda wildcards: (
            f"{RESULTS}/contact/ensembles/{ADHESION[wildcards.adhesion]['case']}.nc"
        ),
        realisations=adhesive_realisations,
    output:
        f"{RESULTS}/adhesion/full/{{adhesion}}.nc",
    log:
        f"{LOGS}/average_adhesive/{{adhesion}}.log",
    benchmark:
        f"{BENCHMARKS}/average_adhesive/{{adhesion}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=500,
    params:
        full=lambda wildcards: model_of(wildcards.adhesion).full.tolist(),
    script:
        "../scripts/adhesion/average_adhesive.py"


rule compare_edges:
    input:
        library=library_of("adhesion/compare_edges.py"),
        averages=f"{RESULTS}/adhesion/full/{{adhesion}}.nc",
        realisations=adhesive_realisations,
        alone=lambda wildcards: [
            f"{RESULTS}/contact/{ADHESION[wildcards.adhesion]['case']}/{os.path.basename(path)}"
            for path in adhesive_realisations(wildcards)
        ],
    output:
        f"{RESULTS}/adhesion/edges/{{adhesion}}.nc",
    log:
        f"{LOGS}/compare_edges/{{adhesion}}.log",
    benchmark:
        f"{BENCHMARKS}/compare_edges/{{adhesion}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=500,
    script:
        "../scripts/adhesion/compare_edges.py"


# The committed table is a copy of this one, so that models can be chosen before anything is solved.
rule tabulate_dmt_error:
    input:
        library=library_of("adhesion/tabulate_dmt_error.py"),
        adhesive=[f"{RESULTS}/adhesion/full/{name}.nc" for name in ("dmt_error", "dmt_error_zeta128")],
    output:
        f"{RESULTS}/adhesion/dmt_error.csv",
    log:
        f"{LOGS}/tabulate_dmt_error.log",
    benchmark:
        f"{BENCHMARKS}/tabulate_dmt_error.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=500,
    script:
        "../scripts/adhesion/tabulate_dmt_error.py"


rule adhesive_maps:
    input:
        library=library_of("adhesion/adhesive_maps.py"),
        surface=lambda wildcards: surface_of(adhesive_case(wildcards)).format(seed=1),
    output:
        f"{RESULTS}/adhesion/full/{{adhesion}}/maps.nc",
    log:
        f"{LOGS}/adhesive_maps/{{adhesion}}.log",
    benchmark:
        f"{BENCHMARKS}/adhesive_maps/{{adhesion}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=memory_of("adhesive_maps"),
        runtime=runtime_of("adhesive_maps"),
    params:
        adhesion=lambda wildcards: ADHESION[wildcards.adhesion],
    script:
        "../scripts/adhesion/adhesive_maps.py"


rule follow_loop:
    input:
        library=library_of("adhesion/follow_loop.py"),
        surface=lambda wildcards: (
            f"{RESULTS}/surfaces/{LOOPS[wildcards.loop]['surface']}/seed1.nc"
        ),
    output:
        f"{RESULTS}/adhesion/loops/{{loop}}.nc",
    log:
        f"{LOGS}/follow_loop/{{loop}}.log",
    benchmark:
        f"{BENCHMARKS}/follow_loop/{{loop}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=memory_of("follow_loop"),
        runtime=runtime_of("follow_loop"),
    params:
        loop=lambda wildcards: LOOPS[wildcards.loop],
        pixels_per_wavelength=FIDELITY["pixels_per_wavelength"],
    script:
        "../scripts/adhesion/follow_loop.py"
