# Memory and time that a cluster is asked for. Rules that are not sized here take what the profile
# gives by default. Both grow with each attempt, so that a job that was too large runs again.

import math


def megapixels(surface, pixels_per_wavelength):
    """Points of a model surface's grid, in millions."""
    waves = math.ceil(surface["magnification"] * surface["window"])
    return (pixels_per_wavelength * waves) ** 2 / 1e6


def memory(arrays, size):
    """Memory [MB] for so many arrays of the grid, whose size [megapixels] depends on wildcards."""
    return lambda wildcards, attempt: attempt * math.ceil(550 + 10 * arrays * size(wildcards))


def minutes(seconds_per_megapixel, size, solutions):
    """Time [min] for a number of solutions, four times what a quiet processor takes."""
    return lambda wildcards, attempt: attempt * math.ceil(
        3 + solutions(wildcards) * (0.02 + seconds_per_megapixel * size(wildcards)) * 4 / 60
    )


def few_minutes(wildcards, attempt):
    """Time [min] for a job that takes seconds, of which there are many."""
    return 3 * attempt


def grid_size(wildcards):
    return megapixels(MODEL_SURFACES[wildcards.model_surface], int(wildcards.pixels))


def coarse_size(wildcards):
    return megapixels(MODEL_SURFACES[wildcards.model_surface], COARSE)


def comparison_size(wildcards):
    return megapixels(model_surface_of(wildcards.comparison), comparison_pixels(wildcards))


def adhesion_size(wildcards):
    case = case_of(wildcards)
    refine = ADHESION[wildcards.adhesion]["refine"]
    pixels = PLANS[case].settings.pixels_per_wavelength
    return megapixels(model_surface_of(case), pixels * refine)


def loop_size(wildcards):
    surface = MODEL_SURFACES[LOOPS[wildcards.loop]["surface"]]
    return megapixels(surface, FIDELITY["pixels_per_wavelength"])


def adhesive_states(wildcards):
    """Solutions in full of a file's seeds, and those without adhesion that they start from."""
    entry = ADHESION[wildcards.adhesion]
    laws = len(entry["range_over_h_rms"]) * len(entry["adhesion_length_over_range"])
    return size_of_part(wildcards) * len(entry["pressures"]) * (1 + laws)
