# Which files hold the surfaces and solutions that are wanted. What lies on disk is used whichever case
# it was made for, and only the rest is made: see scripts/common/stored.py. No rule stands here.

from collections import defaultdict
from functools import cache

from common import stored
from stickiness.accuracy.error_models import COARSE

# Results as they lie on disk: Snakemake puts the prefix of a module before paths of rules alone.
PLACE = workflow.modifier.path_modifier.replace_prefix(RESULTS)

# Simulated cases by what their solutions depend on, beside seeds and loads: the model surface, pixels
# per wavelength and tolerance.
CASES_ON = defaultdict(lambda: defaultdict(list))
for name, planned in PLANS.items():
    if planned.simulated:
        settings = planned.settings
        grid = (settings.pixels_per_wavelength, settings.tolerance)
        CASES_ON[planned.surface][grid].append(name)


def store(folder, *options):
    """Files of one kind in a folder of the results."""
    return stored.Store(f"{RESULTS}/{folder}", stored.list_names(f"{PLACE}/{folder}"), *options)


def solved_folder(surface, pixels, tolerance):
    """Folder of the solutions on one grid; absolute numbers outlive any change of presets."""
    return f"contact/{surface}@{pixels}_{tolerance!r}"


@cache
def solutions_on(surface, pixels, tolerance):
    """Solutions on the grids of some cases, of all seeds and loads that any of them wants."""
    cases = CASES_ON[surface][pixels, tolerance]
    wanted = [(seeds_of(case), PLANS[case].pressures) for case in cases]
    return store(solved_folder(surface, pixels, tolerance), "seeds", wanted)


@cache
def coarse_on(surface, tolerance):
    """Solutions on the coarse grid, which is the same for cases on all grids."""
    grids = CASES_ON[surface].items()
    cases = [case for grid, some in grids if grid[1] == tolerance for case in some]
    wanted = [(coarse_seeds_of(case), PLANS[case].pressures) for case in cases]
    folder = solved_folder(surface, COARSE, tolerance)
    return store(folder, "coarse", wanted, stored.COARSE_SEEDS_A_FILE)


@cache
def maps_on(surface, pixels, tolerance):
    """Fields of the first realisation, at all loads at which any case keeps them."""
    cases = CASES_ON[surface][pixels, tolerance]
    wanted = [([1], CASES[case]["maps"] or []) for case in cases]
    return store(solved_folder(surface, pixels, tolerance), "maps", wanted)


@cache
def states_of(adhesion):
    """Full solutions of an adhesive set. Its loads stay together: states start from each other."""
    return store(f"adhesion/full/{adhesion}", "seeds", [(seeds_in_full(adhesion), stored.NO_LOAD)])


@cache
def surfaces_on_grid(surface, pixels):
    """Surfaces of all solutions in use, the first for maps and loops."""
    grids = [grid for grid in CASES_ON[surface] if grid[0] == pixels]
    cases = {case for grid in grids for case in CASES_ON[surface][grid]}
    sets = [name for name, entry in ADHESION.items() if entry["case"] in cases]
    files = [part for grid in grids for part in solutions_on(surface, *grid).used]
    files += [part for name in sets for part in states_of(name).used]
    # Files on disk may hold more seeds than any case still wants.
    wanted = [(part.seeds, stored.NO_LOAD) for part in files]
    return store(f"surfaces/{surface}@{pixels}", "seeds", [*wanted, ([1], stored.NO_LOAD)])


def seeds_of(case):
    return range(1, PLANS[case].settings.seeds + 1)


def coarse_seeds_of(case):
    return range(1, PLANS[case].settings.coarse_seeds + 1)


def grid_of(case):
    """Model surface of a case, its pixels per wavelength and its tolerance."""
    settings = PLANS[case].settings
    return PLANS[case].surface, settings.pixels_per_wavelength, settings.tolerance


def surfaces_of(case, seeds=(1,)):
    """Files of surfaces of a case on its grid, by default of the first one."""
    return surfaces_on_grid(*grid_of(case)[:2]).find(seeds)


def solutions_of(case, seeds=None):
    """Files of fine solutions of a case at all its loads, by default of all its seeds."""
    seeds = seeds_of(case) if seeds is None else seeds
    return solutions_on(*grid_of(case)).find(seeds, PLANS[case].pressures)


def coarse_of(case):
    """Files of coarse solutions behind a case's means; none for plain means."""
    surface, _, tolerance = grid_of(case)
    return coarse_on(surface, tolerance).find(coarse_seeds_of(case), PLANS[case].pressures)


def maps_of(case):
    """Files of fields of a case's first realisation."""
    return maps_on(*grid_of(case)).find([1], CASES[case]["maps"] or [])


def held_in(wildcards):
    """Seeds and loads of a file, by its name."""
    return stored.Part.of(wildcards.part)


def size_of_part(wildcards):
    """Surfaces or solutions in a file."""
    return held_in(wildcards).size
