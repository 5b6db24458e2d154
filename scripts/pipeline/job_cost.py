"""What a job costs, from the size of its grid and the number of its solutions.

Measured on results of two fidelities and on 4096 by 4096 points. Memory is that of the whole grid in so many arrays; time grows with
pixels times solutions, since conjugate gradients need hardly more iterations on finer grids, those
with adhesion a few more: their rate is that of the largest grid. Rules that are not listed do not
depend on a grid.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

COARSE = 2  # pixels per shortest wavelength of the coarse solutions, as in solve_repulsive.py
SNAKEMAKE_MB = 350  # of the processes around a job: one for the batch script, one for its step
MEMORY_MARGIN, TIME_MARGIN = 1.25, 4.0  # asked for over what the model says
SHORTEST = 2  # minutes: loading libraries from a busy file system may take that long


@dataclass(frozen=True)
class Work:
    """Size of a job: points of its finest grid, points solved on, number of solutions on them."""

    stored: int
    solved: int
    solutions: int


@dataclass(frozen=True)
class Cost:
    """Cost of a rule: memory [MB] = base + arrays of the grid; time [s] = sum of three parts."""

    base_mb: float
    arrays: float
    per_megapixel: float  # s, of one solution
    per_solution: float = 0.01  # s
    start: float = 2.0  # s


COSTS = {
    "synthesise_surface": Cost(base_mb=130, arrays=9, per_megapixel=1.0),
    "solve_repulsive": Cost(base_mb=140, arrays=17, per_megapixel=1.1),
    "solve_coarse": Cost(base_mb=138, arrays=14, per_megapixel=1.05, per_solution=0.012),
    "solve_ensemble": Cost(base_mb=175, arrays=17, per_megapixel=1.1, per_solution=0.02, start=5.0),
    "contact_maps": Cost(base_mb=135, arrays=22, per_megapixel=1.0),
    "solve_adhesive": Cost(base_mb=160, arrays=27, per_megapixel=4.1),
    "adhesive_maps": Cost(base_mb=160, arrays=27, per_megapixel=4.1),
    "follow_loop": Cost(base_mb=135, arrays=36, per_megapixel=0.5),
}


def work(config: Mapping[str, Any], rule: str, **wildcards: str) -> Work:
    """Size of a job of one of the rules in `COSTS`.

    Parameters
    ----------
    config : mapping
        The checked configuration.
    rule, **wildcards
        The job.
    """
    return _WORK[rule](config, **wildcards)


def memory_mb(rule: str, size: Work) -> int:
    """Memory that a job's own process takes at most [MB]."""
    cost = COSTS[rule]
    return math.ceil(cost.base_mb + cost.arrays * 8e-6 * size.stored)


def seconds(rule: str, size: Work) -> float:
    """Processor time that a job takes at most [s]."""
    cost = COSTS[rule]
    each = cost.per_megapixel * 1e-6 * size.solved + cost.per_solution
    return cost.start + each * size.solutions


def asked_mb(rule: str, size: Work) -> int:
    """Memory to ask a cluster for [MB]: with a margin, and what Snakemake itself takes."""
    return math.ceil(MEMORY_MARGIN * memory_mb(rule, size)) + SNAKEMAKE_MB


def asked_minutes(rule: str, size: Work) -> int:
    """Time to ask a cluster for [min], with a margin for slower and for shared machines."""
    return SHORTEST + math.ceil(TIME_MARGIN * seconds(rule, size) / 60)


def pixels(config: Mapping[str, Any], surface: str, per_wavelength: float | None = None) -> int:
    """Points of a model surface's grid, but for those that the Fourier transform adds."""
    if per_wavelength is None:
        per_wavelength = config["fidelities"][config["fidelity"]]["pixels_per_wavelength"]
    return _points(config["model_surfaces"][surface], per_wavelength)


def _points(surface: Mapping[str, Any], per_wavelength: float) -> int:
    waves = math.ceil(surface["magnification"] * surface.get("window", 1.0) - 1e-9)
    return round(per_wavelength * waves) ** 2


def _surface(config: Mapping[str, Any], model_surface: str, **_: str) -> Work:
    points = pixels(config, model_surface)
    return Work(points, points, 1)


def _repulsive(config: Mapping[str, Any], case: str, **_: str) -> Work:
    points = pixels(config, config["cases"][case]["surface"])
    return Work(points, points, len(config["cases"][case]["pressures"]))


def _coarse(config: Mapping[str, Any], case: str, **_: str) -> Work:
    asked = config["cases"][case]
    seeds = config["fidelities"][config["fidelity"]].get("coarse_seeds", 64)
    solved = pixels(config, asked["surface"], COARSE)
    return Work(4 * solved, solved, seeds * len(asked["pressures"]))


def _ensemble(config: Mapping[str, Any], comparison: str) -> Work:
    asked = config["comparisons"]["surfaces"][comparison]
    fidelity = config["fidelities"][config["fidelity"]]["pixels_per_wavelength"]
    per_wavelength = min(asked.get("pixels_per_wavelength", fidelity), fidelity)
    points = _points(asked, per_wavelength)
    coarse = asked.get("coarse_seeds", 0) * (COARSE / per_wavelength) ** 2
    loads = len(config["comparisons"]["pressures"])
    return Work(points, points, math.ceil((asked["seeds"] + coarse) * loads))


def _maps(config: Mapping[str, Any], case: str) -> Work:
    points = pixels(config, config["cases"][case]["surface"])
    return Work(points, points, len(config["cases"][case].get("maps", [])))


def _adhesive(config: Mapping[str, Any], adhesion: str, **_: str) -> Work:
    asked = config["adhesion"][adhesion]
    points = pixels(config, config["cases"][asked["case"]]["surface"])
    points *= asked.get("refine", 1) ** 2
    laws = len(asked["range_over_h_rms"]) * len(asked["adhesion_length_over_range"])
    return Work(points, points, len(asked["pressures"]) * (1 + laws))  # 1: no adhesion


def _adhesive_maps(config: Mapping[str, Any], adhesion: str) -> Work:
    asked = config["adhesion"][adhesion]
    points = pixels(config, config["cases"][asked["case"]]["surface"])
    return Work(points, points, len(asked["maps"]["pressures"]))


def _loop(config: Mapping[str, Any], loop: str) -> Work:
    asked = config["loops"][loop]
    points = pixels(config, asked["surface"])
    states = 200  # about as many on either grid, under either control
    return Work(points, points, 2 * states * len(asked["adhesion_length_over_range"]))


_WORK = {
    "synthesise_surface": _surface,
    "solve_repulsive": _repulsive,
    "solve_coarse": _coarse,
    "solve_ensemble": _ensemble,
    "contact_maps": _maps,
    "solve_adhesive": _adhesive,
    "adhesive_maps": _adhesive_maps,
    "follow_loop": _loop,
}
