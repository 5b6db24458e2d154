# Random surfaces on a periodic window, one file per surface, grid if not the preset's, and seed.


rule synthesise_surface:
    input:
        library=library_of("surfaces/synthesise_surface.py"),
    output:
        f"{RESULTS}/surfaces/{{model_surface}}{{grid}}/seed{{seed}}.nc",
    log:
        f"{LOGS}/synthesise_surface/{{model_surface}}{{grid}}/seed{{seed}}.log",
    benchmark:
        f"{BENCHMARKS}/synthesise_surface/{{model_surface}}{{grid}}/seed{{seed}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=memory_of("synthesise_surface"),
        runtime=runtime_of("synthesise_surface"),
    params:
        surface=lambda wildcards: config["model_surfaces"][wildcards.model_surface],
        pixels_per_wavelength=pixels_of,
    script:
        "../scripts/surfaces/synthesise_surface.py"
