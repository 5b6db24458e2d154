"""Validate the continuum limit: sub-pixel edges, extrapolation and its error, against 4096 points.

Solves surfaces on nested grids from 2 points per shortest wavelength up to 64 (32 at magnification
128), keeps areas, gaps and edges, and prints what `repulsive.richardson` and `repulsive.subpixel`
are built on: orders of convergence, gain over counting pixels, coverage of the error estimate.
Coefficients were fitted on the cases called *calibration*; coverage is that of the *validation*.
Example, half an hour on one core and 2 GB; cases already in the file are not solved again::

    python benchmarks/continuum.py --file benchmarks/results/continuum.nc
    python benchmarks/continuum.py --file benchmarks/results/continuum.nc --tables-only
"""

import argparse
import os
from pathlib import Path

for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[variable] = "1"

import numpy as np  # noqa: E402 - the number of threads must be set before numpy is loaded
import xarray as xr  # noqa: E402

from stickiness import dmt, repulsive, spectrum, surface  # noqa: E402
from stickiness.repulsive import richardson, subpixel  # noqa: E402

RANGES = 10.0 ** (np.arange(-64, 17) / 16)  # over h_rms, as in config.yaml
YASTREBOV = (np.pi - 1 + np.log(2)) / 24
SHOWN = (0.0003, 0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1.0)
LOADS = (0.003, 0.02, 0.1, 0.3)
SCALARS = ("counted_area", "area_fraction", "mean_gap", "edges", "edge_gap")
CURVES = ("counted_attractive_area", "attractive_area")
MANY = (0.003, 0.01, 0.02, 0.05, 0.1, 0.3, 0.5)
# role, Hurst exponents, magnifications, seeds, points of the finest grid, p/(E* q0 h_rms)
SETS = (
    ("calibration", (0.8,), (16,), (41, 42, 43, 44, 45, 46), 1024, LOADS),
    ("calibration", (0.8,), (32,), (11, 12, 13, 14), 2048, MANY),
    ("calibration", (0.8,), (32,), (21, 22, 23, 24), 2048, (0.001, 0.0065, 0.03, 0.13, 0.4)),
    ("calibration", (0.8,), (64,), (31, 32, 33, 34), 2048, (0.003, 0.03, 0.3)),
    ("validation", (0.8,), (64, 128), (1, 2, 3), 4096, LOADS),
    ("validation", (0.8,), (64,), (4, 5), 4096, (0.0065, 0.05, 0.2)),
    ("validation", (0.8,), (128,), (4,), 4096, (0.0065, 0.05, 0.2)),
    ("validation", (0.5,), (64,), (1, 2), 2048, LOADS),
    ("validation", (0.7, 0.9), (64,), (1,), 2048, LOADS),
)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--file", type=Path, default=Path("benchmarks/results/continuum.nc"))
    parser.add_argument("--tables-only", action="store_true", help="solve nothing")
    chosen = parser.parse_args()
    data = read(chosen.file)
    if not chosen.tables_only:
        data = solve(data, chosen.file)
    print_tables(data)


# --- solutions -----------------------------------------------------------------------------


def cases():
    for role, hursts, magnifications, seeds, points, loads in SETS:
        for hurst in hursts:
            for magnification in magnifications:
                for seed in seeds:
                    for load in loads:
                        yield role, hurst, magnification, seed, points, load


def name_of(hurst, magnification, seed, load):
    return f"H{hurst}_zeta{magnification}_seed{seed}_p{load}"


def read(path):
    return xr.load_dataset(path) if path.exists() else None


def solve(data, path):
    path.parent.mkdir(parents=True, exist_ok=True)
    for role, hurst, magnification, seed, points, load in cases():
        name = name_of(hurst, magnification, seed, load)
        if data is not None and name in data.case.values:
            continue
        heights = heights_of(hurst, magnification, seed, points)
        row = nested(heights, load, magnification).expand_dims(case=[name])
        row = row.assign_coords(
            role=("case", [role]),
            hurst=("case", [hurst]),
            magnification=("case", [magnification]),
            seed=("case", [seed]),
            pressure=("case", [load]),
        )
        data = row if data is None else xr.concat([data, row], "case", join="outer")
        data.to_netcdf(path, encoding={name: {"zlib": True} for name in CURVES})
        print(name, flush=True)
    return data


def heights_of(hurst, magnification, seed, points):
    band = spectrum.SelfAffine(hurst=hurst, q0=1.0, q1=float(magnification), h_rms=1.0)
    return surface.synthesise(band, n=points, length=2 * np.pi, seed=seed)


def nested(heights, load, magnification):
    """Solve on every grid from 2 points per shortest wavelength, the coarsest, upwards."""
    points = len(heights)
    sizes = [2 * magnification]
    while sizes[-1] < points:
        sizes.append(2 * sizes[-1])
    grids = []
    for n in sizes:
        sampled = np.ascontiguousarray(heights[:: points // n, :: points // n])
        contact = repulsive.solve(sampled, 2 * np.pi, load)
        grids.append(reduced(contact.gap, contact.pressure > 0))
    return xr.concat(grids, xr.DataArray(np.array(sizes) // magnification, dims="pixels"))


def reduced(gap, touching):
    values = {
        "counted_area": touching.mean(),
        "area_fraction": touching.mean() - subpixel.boundary_strip(touching),
        "mean_gap": gap.mean(),
        "edges": float(subpixel.edge_count(touching)),
        "edge_gap": subpixel.edge_gap(gap, touching),
        "counted_attractive_area": ("range", dmt.attractive_area(gap, RANGES, touching)),
        "attractive_area": ("range", subpixel.attractive_area(gap, RANGES, touching)),
    }
    return xr.Dataset(values, coords={"range": RANGES})


# --- quantities ----------------------------------------------------------------------------


def quantities(data):
    """Every quantity: its rule, range, values with sub-pixel edges, counted, and their parts."""
    area_part = data.area_fraction - data.counted_area
    yield "A_rep", "area_fraction", None, data.area_fraction, data.counted_area, area_part
    yield "mean gap", "mean_gap", None, data.mean_gap, data.mean_gap, area_part * data.edge_gap
    part = data.attractive_area - data.counted_attractive_area
    for eps in SHOWN:
        at = {"range": eps, "method": "nearest"}
        fine, counted = data.attractive_area.sel(**at), data.counted_attractive_area.sel(**at)
        yield f"A_ad({eps:g})", "attractive_area", eps, fine, counted, part.sel(**at)
    for eps in SHOWN[1:]:
        i = int(np.argmin(abs(RANGES - eps)))
        fine, counted = (slope(data[name], i) for name in reversed(CURVES))
        share = (part / data.attractive_area).isel(range=i)
        yield f"P({eps:g})", "gap_density", eps, fine, counted, fine * share


def slope(area, i):
    """P(u) as the mean slope over one step of ranges, as `average_ensemble.py` takes it."""
    return (area.isel(range=i + 1) - area.isel(range=i)) / (RANGES[i + 1] - RANGES[i])


def finest(values):
    """Value on the finest grid that a case has, and the change from the one before."""
    last = values.isel(pixels=-1, drop=True)
    before = values.isel(pixels=-2, drop=True)
    first = values.isel(pixels=-3, drop=True)
    change = (last - before).fillna(before - first)
    return last.fillna(before), abs(change)


def rms(values):
    return float(np.sqrt((values**2).mean()))


# --- tables --------------------------------------------------------------------------------


def print_tables(data):
    data = data.transpose("case", "pixels", "range")
    validation = data.isel(case=(data.role == "validation").values)
    print_reference(data)
    print_orders(data)
    print_coverage(validation)
    print_ensembles(data)
    print_gain(data)
    print_cheapest(validation)


def print_reference(data):
    print(
        "\nthe reference, sub-pixel at 64 points per wavelength, against counts of 32 and 64 points"
        "\nextrapolated with order one: difference, scatter, the reference's own last change [%]"
    )
    data = data.isel(case=np.isfinite(data.area_fraction.sel(pixels=64)).values)
    for name, _, _, fine, counted, _ in quantities(data):
        if name.startswith("P"):
            continue
        own = fine.sel(pixels=64)
        counts = richardson.extrapolate(counted.sel(pixels=32), counted.sel(pixels=64))
        difference = 100 * (own / counts - 1)
        change = 100 * rms(own / fine.sel(pixels=32) - 1)
        print(
            f"{name:12s}{float(difference.mean()):9.3f}{float(difference.std()):9.3f}{change:9.3f}"
        )


def observed_order(coarse, middle, fine):
    """Power of the pixel size with which three grids converge: log2 of the ratio of changes.

    Arrays of cases are pooled by the rms of their changes along the first axis: the ratio of two
    changes of random sign means nothing alone.
    """
    first, second = (
        np.sqrt(np.mean(np.atleast_1d(change) ** 2, axis=0))
        for change in (np.subtract(middle, coarse), np.subtract(fine, middle))
    )
    return np.log2(first / second)


def print_orders(data):
    print("\nrms change [%] to each resolution; order from the last but one pair (all cases)")
    pixels = [4, 8, 16, 32]
    print(f"{'':12s}{'':10s}" + "".join(f"{p:>9d}" for p in pixels) + "   order 4-8-16  8-16-32")
    for name, _, _, fine, counted, _ in quantities(data):
        for label, values in (("sub-pixel", fine), ("counted", counted)):
            relative = values / finest(fine)[0]
            by = [relative.sel(pixels=p).values for p in (2, *pixels)]
            change = [100 * np.sqrt(np.nanmean((b - a) ** 2)) for a, b in zip(by, by[1:])]  # noqa: B905
            orders = (observed_order(*by[i : i + 3]) for i in (1, 2))
            print(
                f"{name:12s}{label:10s}"
                + "".join(f"{c:9.3f}" for c in change)
                + "   "
                + "".join(f"{float(order):10.2f}" for order in orders)
            )


def print_coverage(data):
    print(
        "\nvalidation: share of cases covered, with the reference's own change in quadrature "
        "(without),\nrms true error, mean estimated error [%]; gain: rms error of the count over it"
    )
    for grids in ((2, 4), (4, 8), (8, 16), (2, 4, 8), (4, 8, 16)):
        print(f"  {'+'.join(map(str, grids))} points per wavelength")
        for name, rule, eps, fine, counted, part in quantities(data):
            at = {"pixels": grids[-1]}
            climbs = np.inf if eps is None else eps / data.edge_gap.sel(**at)
            found = richardson.estimate(
                rule,
                [fine.sel(pixels=p) for p in grids],
                part.sel(**at),
                data.edges.sel(**at),
                climbs,
            )
            true, own = finest(fine)
            miss = abs(found.value - true)
            covered = float((miss <= np.hypot(found.error, own)).mean())
            strictly = float((miss <= found.error).mean())
            gain = rms(counted.sel(**at) / true - 1) / rms(miss / true)
            print(
                f"    {name:12s}{100 * covered:5.0f} ({100 * strictly:3.0f})"
                f"{100 * rms(miss / true):9.3f}{100 * float((found.error / true).mean()):9.3f}"
                f"{gain:8.1f}"
            )


def print_ensembles(data):
    print("\nmeans over seeds at one load (two or more): covered of all, rms error, estimate [%]")
    groups = data.groupby(["hurst", "magnification", "pressure", "role"])
    ensembles = [data.isel(case=index) for index in groups.groups.values() if len(index) > 1]
    for grids in ((4, 8), (8, 16)):
        for name in ("A_rep", "mean gap", "A_ad(0.003)", "A_ad(0.01)", "A_ad(0.1)", "P(0.03)"):
            misses, errors = [], []
            for members in ensembles:
                row = next(q for q in quantities(members) if q[0] == name)
                _, rule, eps, fine, _, part = row
                at = {"pixels": grids[-1]}
                mean_gap = members.edge_gap.sel(**at).mean("case")
                found = richardson.estimate(
                    rule,
                    [fine.sel(pixels=p).mean("case") for p in grids],
                    part.sel(**at).mean("case"),
                    members.edges.sel(**at).sum("case"),
                    np.inf if eps is None else eps / mean_gap,
                )
                true = float(finest(fine)[0].mean())
                misses.append(abs(float(found.value) / true - 1))
                errors.append(float(found.error) / true)
            misses, errors = np.array(misses), np.array(errors)
            print(
                f"  {grids[0]}+{grids[1]:<3d}{name:12s}"
                f"{np.sum(misses <= errors):4d} of {misses.size}"
                f"{100 * np.sqrt(np.mean(misses**2)):9.3f}{100 * errors.mean():9.3f}"
            )


def print_gain(data):
    print("\nattractive area at 8 points per wavelength: rms error [%] by range over edge gap")
    print(f"{'range/edge gap':>18s}{'cases':>7s}{'counted':>9s}{'strip':>9s}{'sub-pixel':>11s}")
    true, _ = finest(data.attractive_area)
    grid = data.sel(pixels=8)
    points = (8 * grid.magnification) ** 2
    strip = grid.counted_attractive_area + YASTREBOV * grid.edges / points
    climbs = grid["range"] / grid.edge_gap
    for low, high in ((0.03, 0.1), (0.1, 0.3), (0.3, 1), (1, 3), (3, 10), (10, 100)):
        inside = (climbs >= low) & (climbs < high)
        errors = [
            100 * rms((values / true - 1).where(inside))
            for values in (grid.counted_attractive_area, strip, grid.attractive_area)
        ]
        print(
            f"{low:8g} - {high:<7g}{int(inside.sum()):7d}"
            f"{errors[0]:9.1f}{errors[1]:9.1f}{errors[2]:11.2f}"
        )


def print_cheapest(data):
    print("\nrms true error [%] by finest grid, counted / Richardson on counts / sub-pixel")
    wanted = ("A_rep", "mean gap", "A_ad(0.01)", "A_ad(0.03)", "P(0.03)")
    for name, _, _, fine, counted, _ in quantities(data):
        if name not in wanted:
            continue
        true, _ = finest(fine)
        cells = []
        for p in (4, 8, 16):
            steps = [counted.sel(pixels=q) for q in (p // 2, p)]
            three = (steps[1], richardson.extrapolate(*steps), fine.sel(pixels=p))
            cells.append(" / ".join(f"{100 * rms(value / true - 1):7.3f}" for value in three))
        print(f"  {name:12s}" + "   ".join(cells))


if __name__ == "__main__":
    main()
