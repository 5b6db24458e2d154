# Adhesion in the DMT limit: attraction summed over the gaps of the repulsive solution.


rule adhesion_dmt:
    input:
        library=library_of("adhesion_dmt.py"),
        ensemble=lambda wildcards: (
            f"{RESULTS}/ensembles/{ADHESION[wildcards.adhesion]['case']}.nc"
        ),
    output:
        f"{RESULTS}/adhesion/{{adhesion}}.nc",
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
    script:
        "../scripts/adhesion_dmt.py"
