# Contact without adhesion, by boundary elements. One job per case and seed walks the whole load
# path, others walk it for many more seeds on a coarse grid; together they give the case's means.
# Surfaces that theory alone is compared with take one job for all of it.

COARSE_BLOCK = 32  # coarse seeds in a file


def realisations(wildcards):
    """Fine solutions of a case, which an earlier case on the same surface may hold."""
    folder = f"{RESULTS}/contact/{PLANS[wildcards.case].owner}"
    return [f"{folder}/seed{seed}.nc" for seed in seeds_of(wildcards.case)]


def coarse_solutions(wildcards):
    """Coarse solutions behind a case's means, in files of a fixed number of seeds, so that more
    seeds leave those that are solved as they are."""
    planned = PLANS[wildcards.case]
    count = planned.settings.coarse_seeds
    ends = [(first, min(first + COARSE_BLOCK, count)) for first in range(0, count, COARSE_BLOCK)]
    return [f"{RESULTS}/contact/{planned.owner}/coarse{first}-{end}.nc" for first, end in ends]


def gaps_of(wildcards):
    """Ranges at which a case's attractive areas are taken; none if it does not want any."""
    return GAPS if PLANS[wildcards.case].gaps else None


def comparison_pixels(wildcards):
    asked = COMPARISONS[wildcards.comparison]
    preset = FIDELITY["pixels_per_wavelength"]
    return min(asked.get("pixels_per_wavelength", preset), preset)


def comparison_solutions(wildcards):
    """Fine solutions of a comparison, and its coarse ones by what they cost beside these."""
    asked = COMPARISONS[wildcards.comparison]
    coarse = asked.get("coarse_seeds", 0) * (2 / comparison_pixels(wildcards)) ** 2
    return (asked["seeds"] + coarse) * len(config["comparisons"]["pressures"])


rule solve_repulsive:
    input:
        surface=lambda wildcards: surface_of(wildcards.case),
    output:
        f"{RESULTS}/contact/{{case}}/seed{{seed}}.nc",
    resources:
        mem_mb=memory(17, case_size),
        runtime=minutes(1.1, case_size, lambda wildcards: len(pressures_of(wildcards.case))),
    params:
        pressures=lambda wildcards: pressures_of(wildcards.case),
        tolerance=lambda wildcards: PLANS[wildcards.case].settings.tolerance,
        pixels_per_wavelength=lambda wildcards: (
            PLANS[wildcards.case].settings.pixels_per_wavelength
        ),
        gaps=gaps_of,
    script:
        "../scripts/contact/solve_repulsive.py"


rule solve_coarse:
    output:
        f"{RESULTS}/contact/{{case}}/coarse{{first}}-{{end}}.nc",
    wildcard_constraints:
        first=r"\d+",
        end=r"\d+",
    resources:
        mem_mb=memory(4 * 14, coarse_size),
        runtime=minutes(
            1.1, coarse_size, lambda wildcards: COARSE_BLOCK * len(pressures_of(wildcards.case))
        ),
    params:
        surface=lambda wildcards: model_surface_of(wildcards.case),
        pressures=lambda wildcards: pressures_of(wildcards.case),
        tolerance=lambda wildcards: PLANS[wildcards.case].settings.tolerance,
        gaps=gaps_of,
        after=lambda wildcards: int(wildcards.first),
        seeds=lambda wildcards: int(wildcards.end),
        descriptor_seeds=config["sampling"]["descriptor_seeds"],
    script:
        "../scripts/contact/solve_coarse.py"


rule contact_maps:
    input:
        surface=lambda wildcards: surface_of(wildcards.case).format(seed=1),
    output:
        f"{RESULTS}/contact/{{case}}/maps.nc",
    resources:
        mem_mb=memory(22, case_size),
    params:
        pressures=lambda wildcards: CASES[wildcards.case].get("maps", []),
        tolerance=lambda wildcards: PLANS[wildcards.case].settings.tolerance,
    script:
        "../scripts/contact/contact_maps.py"


rule average_ensemble:
    input:
        laws=ERROR_MODELS,
        realisations=realisations,
        coarse=coarse_solutions,
    output:
        f"{RESULTS}/contact/ensembles/{{case}}.nc",
    params:
        pressures=lambda wildcards: PLANS[wildcards.case].pressures,
        quantities=lambda wildcards: PLANS[wildcards.case].quantities,
    script:
        "../scripts/contact/average_ensemble.py"


rule solve_ensemble:
    input:
        laws=ERROR_MODELS,
    output:
        f"{RESULTS}/contact/ensembles/{{comparison}}.nc",
    resources:
        mem_mb=memory(17, comparison_size),
        runtime=minutes(1.1, comparison_size, comparison_solutions),
    params:
        surface=lambda wildcards: model_surface_of(wildcards.comparison),
        pressures=config["comparisons"]["pressures"],
        seeds=lambda wildcards: COMPARISONS[wildcards.comparison]["seeds"],
        coarse_seeds=lambda wildcards: COMPARISONS[wildcards.comparison].get("coarse_seeds", 0),
        descriptor_seeds=config["sampling"]["descriptor_seeds"],
        tolerance=FIDELITY["tolerance"],
        pixels_per_wavelength=comparison_pixels,
        gaps=GAPS,
    script:
        "../scripts/contact/solve_ensemble.py"
