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
    for file in files:
        with xr.open_dataset(one / file) as a, xr.open_dataset(other / file) as b:
            assert {*a.variables} == {*b.variables}, file
            for name in a.variables:
                compare(a[name].values, b[name].values, f"{file}: {name}")
    print(f"{len(files)} files are the same up to rounding")
    sys.exit(0 if files else "FAILED: no files")


def compare(a, b, name):
    if a.dtype.kind not in "fc":
        np.testing.assert_array_equal(a, b, name, strict=True)
        return
    largest = np.max(np.abs(a), initial=0.0, where=np.isfinite(a))
    np.testing.assert_allclose(b, a, 0, ROUNDING * largest, err_msg=name, strict=True)


if __name__ == "__main__":
    main()
