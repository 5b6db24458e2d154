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
    files = sorted(path.relative_to(one) for path in one.rglob("*.nc"))
    found = {file: list_distances(one / file, other / file) for file in files}
    apart = {(file, name): d for file, of in found.items() for name, d in of.items() if d > 0}
    variables = sum(map(len, found.values()))
    same = variables - len(apart)
    print(f"{len(files)} files, {variables} variables, {same} of them the same bit by bit")
    for (file, name), distance in sorted(apart.items(), key=lambda item: -item[1])[:10]:
        print(f"  {file}: {name} apart by {distance:.1e} of its largest value")
    if not files or any(distance > ROUNDING for distance in apart.values()):
        sys.exit(f"FAILED: no files, or more than rounding ({ROUNDING:g})")


def list_distances(one, other):
    """Largest difference over the largest value of each variable, inf where they cannot compare."""
    if not other.is_file():
        return {"the whole file": np.inf}
    with xr.open_dataset(one) as a, xr.open_dataset(other) as b:
        names = {*a.variables, *b.variables}
        shared = a.variables.keys() & b.variables.keys()
        return {n: distance(a[n].values, b[n].values) if n in shared else np.inf for n in names}


def distance(a, b):
    number = a.dtype.kind in "fc" and a.dtype.kind == b.dtype.kind
    if a.shape == b.shape and np.array_equal(a, b, equal_nan=number):
        return 0.0
    if not number or a.shape != b.shape or not np.array_equal(np.isfinite(a), np.isfinite(b)):
        return np.inf
    finite = np.isfinite(a)
    return float(np.max(np.abs(a - b)[finite]) / np.max(np.abs(a)[finite]))


if __name__ == "__main__":
    main()
