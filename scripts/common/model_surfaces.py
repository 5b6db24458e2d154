"""Model surfaces of the configuration, in units of `conventions`, and files of realisations."""

from itertools import compress, groupby

import numpy as np
import xarray as xr
from scipy.fft import next_fast_len

from common.conventions import Q0, add_convergence, annotate
from stickiness import datasets
from stickiness.spectrum.kinds import SelfAffine
from stickiness.surface import synthesise

SOLVED = ("mean_gap", "residual", "iterations")  # of the states whose fields are kept


def model_spectrum(surface):
    """Spectrum of a model surface of the configuration, in units of q0 and h_rms."""
    rolloff = surface["rolloff"]
    return SelfAffine(
        hurst=surface["hurst"],
        q0=Q0,
        q1=Q0 * surface["magnification"],
        h_rms=1.0,
        q_rolloff=None if rolloff is None else Q0 * rolloff,
        anisotropy=surface["anisotropy"],
        angle=np.radians(surface["angle"]),
    )


def make_spectrum(hurst, magnification):
    """Isotropic self-affine spectrum without a roll-off, in units of q0 and h_rms."""
    return SelfAffine(hurst=hurst, q0=Q0, q1=Q0 * magnification, h_rms=1.0)


def cell_size(surface):
    """Side of a model surface's periodic cell, in units of 1/q0."""
    return surface["window"] * 2 * np.pi / Q0


def waves_across(surface):
    """Shortest wavelengths along the side of a model surface's cell."""
    return surface["magnification"] * surface["window"]


def make_heights(surface, points, seed):
    """Heights over h_rms of one realisation of a model surface on a grid of `points` a side."""
    return synthesise(
        model_spectrum(surface),
        points,
        cell_size(surface),
        int(seed),
        surface["amplitudes"],
        skewness_of(surface),
    )


def skewness_of(surface):
    """Skewness of the heights of a model surface; 0 if they are Gaussian."""
    return surface["heights"]["skewness"] if "heights" in surface else 0.0


def grid_points(surface, pixels_per_wavelength):
    """Number of grid points, good for the FFT, with at least this many pixels per wave."""
    # A multiple of the number for one pixel: the coarser grids of the solutions are part of it.
    waves = int(np.ceil(waves_across(surface) - 1e-9))
    return pixels_per_wavelength * next_fast_len(waves, real=True)


def pixels(surface):
    """Grid points per shortest wavelength of a surface's file, as realised by the grid."""
    parameters = datasets.parameters(surface)
    return parameters["grid_points"] / waves_across(parameters)


def each_seed(solve, paths, seeds):
    """What `solve` makes of the surface of every seed, with the rms slope of its heights.

    The surfaces are in one file or several, of which one at a time is in memory. The attributes of
    the result are theirs.
    """
    solved = {}
    for path in paths:
        surfaces = datasets.read(path, ["height", "window_length", "rms_slope"])
        for seed in set(seeds) & set(surfaces.seed.values.tolist()):
            surface = surfaces.sel(seed=seed, drop=True)
            slope = surface.rms_slope.sel(source="heights", drop=True)
            solved[seed] = solve(surface).assign(rms_slope=slope)
    if missing := set(seeds) - solved.keys():
        raise datasets.DatasetError(f"{' and '.join(paths)}: no surface of seed {min(missing)}")
    rows = [solved[seed] for seed in seeds]
    dataset = xr.concat(rows, xr.DataArray(list(seeds), dims="seed", name="seed"))
    return dataset.assign_attrs(surfaces.attrs)


def read_first(paths):
    """The first surface of the first file."""
    surfaces = datasets.read(paths[0], ["height", "window_length"])
    return surfaces.isel(seed=0).copy(deep=True)  # frees the others


def read_block(paths, variables, seeds, pressures=None):
    """Solutions of every seed, at every pressure if there are any, from the files that hold them.

    A file may hold other seeds and pressures, too. Seeds are NaN on a grid that their file lacks.
    Attributes are those of the first file.
    """
    files = [datasets.read(path, variables) for path in paths]
    held = [set(file.seed.values.tolist()) for file in files]
    rows = []
    # Seeds that the same files hold are read from these together.
    for holds, group in groupby(seeds, lambda seed: tuple(seed in each for each in held)):
        members = list(group)
        parts = [file.sel(seed=members) for file in compress(files, holds)]
        if not parts:
            raise datasets.DatasetError(f"{' and '.join(paths)}: no solution of seed {members[0]}")
        if pressures is None:
            rows.append(parts[0])
        else:
            rows.append(join_pressures(parts, pressures, f"seed {members[0]} in {paths}"))
    return xr.concat(rows, "seed", join="outer")


def join_pressures(parts, pressures, where):
    """Join what solutions of the same seeds hold at each of some pressures."""
    rows = []
    left = list(pressures)
    for part in parts:
        held = set(part.pressure.values.tolist())
        rows.append(part.sel(pressure=[pressure for pressure in left if pressure in held]))
        left = [pressure for pressure in left if pressure not in held]
    if left:
        raise datasets.DatasetError(f"{where}: no solution at pressure {left[0]!r}")
    rows = [row for row in rows if row.sizes["pressure"]]
    # What does not depend on the pressure is the same in all.
    joined = xr.concat(rows, "pressure", data_vars="minimal", coords="minimal", compat="override")
    return joined.sel(pressure=list(pressures))


def gather_fields(states, pressures, surface, tolerance, **texts):
    """Fields of one state a pressure, and how well it is solved; `texts` describe variables."""
    dims = ("pressure", "x", "y")
    dataset = xr.Dataset(
        {
            "gap": (dims, [state.gap for state in states]),
            "contact_pressure": (dims, [state.pressure for state in states]),
            **{n: ("pressure", [getattr(state, n) for state in states]) for n in SOLVED},
        },
        coords={"pressure": pressures, "x": surface.x, "y": surface.y},
    )
    return add_convergence(annotate(dataset, **texts), tolerance)
