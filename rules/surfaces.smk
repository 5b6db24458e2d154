# Random surfaces on a periodic cell: a file for a few seeds of a surface and grid (if not the preset's).


def pixels_of(wildcards):
    """Grid points per shortest wavelength of a surface's file, the preset's unless it says so."""
    return int(wildcards.grid.lstrip("@") or FIDELITY["pixels_per_wavelength"])


rule synthesise_surface:
    output:
        f"{RESULTS}/surfaces/{{model_surface}}{{grid}}/seeds{{part}}.nc",
    log:
        f"{RESULTS}/logs/synthesise_surface/surfaces/{{model_surface}}{{grid}}/seeds{{part}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/synthesise_surface/surfaces/{{model_surface}}{{grid}}/seeds{{part}}.tsv"
    # The longest jobs of a run wait for them.
    priority: 2
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=memory(9 + plan.SEEDS_A_FILE, surface_size),
        runtime=minutes(0.7, surface_size, lambda wildcards: len(plan.seeds_in(wildcards.part))),
    params:
        seeds=lambda wildcards: plan.seeds_in(wildcards.part),
        surface=lambda wildcards: MODEL_SURFACES[wildcards.model_surface],
        pixels_per_wavelength=pixels_of,
        code=source_hash("surfaces/synthesise_surface.py"),
    message:
        "Synthesise random surfaces: {wildcards.model_surface}{wildcards.grid}, seeds {wildcards.part}"
    script:
        "../scripts/surfaces/synthesise_surface.py"
