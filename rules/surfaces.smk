# Random surfaces on a periodic cell: a file for a few seeds of a model surface on one grid.


rule synthesise_surface:
    output:
        f"{RESULTS}/surfaces/{{model_surface}}@{{pixels}}/seeds{{part}}.nc",
    log:
        f"{RESULTS}/logs/synthesise_surface/surfaces/{{model_surface}}@{{pixels}}/seeds{{part}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/synthesise_surface/surfaces/{{model_surface}}@{{pixels}}/seeds{{part}}.tsv"
    # The longest jobs of a run wait for them.
    priority: 2
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=memory(9 + stored.SEEDS_A_FILE, grid_size),
        runtime=minutes(0.7, grid_size, size_of_part),
    params:
        seeds=lambda wildcards: held_in(wildcards).seeds,
        surface=lambda wildcards: MODEL_SURFACES[wildcards.model_surface],
        pixels_per_wavelength=lambda wildcards: int(wildcards.pixels),
        code=source_hash("surfaces/synthesise_surface.py"),
    message:
        "Synthesise random surfaces: {wildcards.model_surface}, seeds {wildcards.part}"
    script:
        "../scripts/surfaces/synthesise_surface.py"
