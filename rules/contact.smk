# Contact without adhesion, by boundary elements. A job walks a load path of a few seeds of a model
# surface, others walk it for many more on a coarse grid; together they give the means and the slope
# of area against load. A surface with which theory alone is compared takes one job.


def surfaces_to_solve(wildcards):
    """Surfaces of a file of solutions."""
    surfaces = surfaces_on_grid(wildcards.model_surface, int(wildcards.pixels))
    return surfaces.find(held_in(wildcards).seeds)


def comparison_pixels(wildcards):
    """Grid points per shortest wavelength of a comparison: its own at most."""
    preset = FIDELITY["pixels_per_wavelength"]
    most = COMPARISONS[wildcards.comparison]["pixels_per_wavelength"]
    return preset if most is None else min(most, preset)


def comparison_solutions(wildcards):
    """Fine solutions of a comparison, and its coarse ones by what they cost beside these."""
    comparison = COMPARISONS[wildcards.comparison]
    coarse = comparison["coarse_seeds"] * (2 / comparison_pixels(wildcards)) ** 2
    return (comparison["seeds"] + coarse) * len(config["comparisons"]["pressures"])


rule solve_repulsive:
    input:
        surfaces=surfaces_to_solve,
    output:
        f"{RESULTS}/contact/{{model_surface}}@{{pixels}}_{{tolerance}}/seeds{{part}}.nc",
    log:
        f"{RESULTS}/logs/solve_repulsive/contact/{{model_surface}}@{{pixels}}_{{tolerance}}/seeds{{part}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/solve_repulsive/contact/{{model_surface}}@{{pixels}}_{{tolerance}}/seeds{{part}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=memory(17 + stored.SEEDS_A_FILE, grid_size),
        runtime=minutes(1.1, grid_size, size_of_part),
    params:
        seeds=lambda wildcards: held_in(wildcards).seeds,
        pressures=lambda wildcards: held_in(wildcards).loads,
        tolerance=lambda wildcards: float(wildcards.tolerance),
        pixels_per_wavelength=lambda wildcards: int(wildcards.pixels),
        gaps=GAPS,
        code=source_hash("contact/solve_repulsive.py"),
    message:
        "Solve contact without adhesion: {wildcards.model_surface}, seeds and loads {wildcards.part}"
    script:
        "../scripts/contact/solve_repulsive.py"


rule solve_coarse:
    output:
        f"{RESULTS}/contact/{{model_surface}}@{COARSE}_{{tolerance}}/coarse{{part}}.nc",
    log:
        f"{RESULTS}/logs/solve_coarse/contact/{{model_surface}}@{COARSE}_{{tolerance}}/coarse{{part}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/solve_coarse/contact/{{model_surface}}@{COARSE}_{{tolerance}}/coarse{{part}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=memory(4 * 14, coarse_size),
        runtime=minutes(1.1, coarse_size, size_of_part),
    params:
        surface=lambda wildcards: MODEL_SURFACES[wildcards.model_surface],
        seeds=lambda wildcards: held_in(wildcards).seeds,
        pressures=lambda wildcards: held_in(wildcards).loads,
        tolerance=lambda wildcards: float(wildcards.tolerance),
        gaps=GAPS,
        code=source_hash("contact/solve_coarse.py"),
    message:
        "Solve contact on a coarse grid: {wildcards.model_surface}, seeds and loads {wildcards.part}"
    script:
        "../scripts/contact/solve_coarse.py"


rule contact_maps:
    input:
        surfaces=surfaces_to_solve,
    output:
        f"{RESULTS}/contact/{{model_surface}}@{{pixels}}_{{tolerance}}/maps{{part}}.nc",
    log:
        f"{RESULTS}/logs/contact_maps/contact/{{model_surface}}@{{pixels}}_{{tolerance}}/maps{{part}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/contact_maps/contact/{{model_surface}}@{{pixels}}_{{tolerance}}/maps{{part}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=memory(22 + stored.SEEDS_A_FILE, grid_size),
    params:
        pressures=lambda wildcards: held_in(wildcards).loads,
        tolerance=lambda wildcards: float(wildcards.tolerance),
        code=source_hash("contact/contact_maps.py"),
    message:
        "Map gaps and pressures of one realisation: {wildcards.model_surface}, loads {wildcards.part}"
    script:
        "../scripts/contact/contact_maps.py"


rule solve_ensemble:
    input:
        laws=ERROR_MODELS,
    output:
        f"{RESULTS}/contact/ensembles/{{comparison}}.nc",
    log:
        f"{RESULTS}/logs/solve_ensemble/contact/ensembles/{{comparison}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/solve_ensemble/contact/ensembles/{{comparison}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=memory(17, comparison_size),
        runtime=minutes(1.1, comparison_size, comparison_solutions),
    params:
        surface=lambda wildcards: model_surface_of(wildcards.comparison),
        pressures=config["comparisons"]["pressures"],
        seeds=lambda wildcards: COMPARISONS[wildcards.comparison]["seeds"],
        coarse_seeds=lambda wildcards: COMPARISONS[wildcards.comparison]["coarse_seeds"],
        descriptor_seeds=config["sampling"]["descriptor_seeds"],
        tolerance=FIDELITY["tolerance"],
        pixels_per_wavelength=comparison_pixels,
        gaps=GAPS,
        code=source_hash("contact/solve_ensemble.py"),
    message:
        "Solve contact that theory is compared with: {wildcards.comparison}"
    script:
        "../scripts/contact/solve_ensemble.py"
