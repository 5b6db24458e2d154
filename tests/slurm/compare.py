"""Compare all variables of all NetCDF files of a run with those of another: compare.py RUN OTHER.

Ends with an error if the other has no such file, if a variable is missing on either side, or if
values are apart by more than rounding. What else the other holds, and attributes (parameters,
versions of the codes), are left alone.
"""

import sys
from pathlib import Path

import numpy as np
import xarray as xr

ROUNDING = 1e-9  # relative to the largest value of a variable


def main():
    one, other = map(Path, sys.argv[1:3])
    files = {path.relative_to(one) for path in one.rglob("*.nc")}
    missing = sorted(str(file) for file in files if not (other / file).is_file())
    if missing or not files:
        sys.exit(f"{other} has no {', '.join(missing)}" if missing else f"no .nc file in {one}")
    apart = {}
    variables = 0
    for file in sorted(files):
        for name, distance in distances(one / file, other / file):
            variables += 1
            if distance > 0:
                apart[f"{file}: {name}"] = distance
    same = variables - len(apart)
    print(f"{len(files)} files, {variables} variables, {same} of them the same bit by bit")
    for where, distance in sorted(apart.items(), key=lambda item: -item[1])[:10]:
        print(f"  {where} apart by {distance:.1e} of its largest value")
    if any(distance > ROUNDING for distance in apart.values()):
        sys.exit(f"FAILED: more than rounding ({ROUNDING:g})")


def distances(one, other):
    """Name and largest difference of each variable of two files, inf where they cannot compare."""
    with xr.open_dataset(one) as a, xr.open_dataset(other) as b:
        for name in sorted(set(a.variables) | set(b.variables)):
            if name not in a.variables or name not in b.variables:
                yield name, np.inf
                continue
            yield name, distance(a[name].values, b[name].values)


def distance(a, b):
    """Largest difference over the largest value; inf if shape, type or missing values differ."""
    if a.shape != b.shape or a.dtype.kind != b.dtype.kind:
        return np.inf
    if a.dtype.kind not in "fc":
        return 0.0 if np.array_equal(a, b) else np.inf
    if np.array_equal(a, b, equal_nan=True):
        return 0.0
    if not np.array_equal(np.isfinite(a), np.isfinite(b)):
        return np.inf
    finite = np.isfinite(a)
    return float(np.max(np.abs(a - b)[finite]) / np.max(np.abs(a)[finite]))


if __name__ == "__main__":
    main()
