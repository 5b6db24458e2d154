# Random surfaces on a periodic cell: one file a surface, grid (if not the preset's) and seed.


def pixels_of(wildcards):
    """Grid points per shortest wavelength of a surface's file, the preset's unless it says so."""
    return int(wildcards.grid.lstrip("@") or FIDELITY["pixels_per_wavelength"])


rule synthesise_surface:
    output:
        f"{RESULTS}/surfaces/{{model_surface}}{{grid}}/seed{{seed}}.nc",
    resources:
        mem_mb=memory(9, surface_size),
    params:
        surface=lambda wildcards: MODEL_SURFACES[wildcards.model_surface],
        pixels_per_wavelength=pixels_of,
    script:
        "../scripts/surfaces/synthesise_surface.py"
