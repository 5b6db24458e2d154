"""Files of contact and adhesion say what a sign means, and how well every state is solved."""

import re

import numpy as np
import pytest

from stickiness import datasets

pytestmark = pytest.mark.workflow

# Kinds of files that hold states.
KINDS = ("contact/.*/seeds", "contact/.*/coarse", "contact/.*/maps", "adhesion/full/.*/seeds")
KINDS += ("adhesion/full/.*/maps", "adhesion/loops/")
SIGNED = r"(?!range)(\w+ ){0,3}(pressure|gap|tension|attraction)( over E| over h_rms|,| of a|$)"


@pytest.fixture(scope="module")
def files(finished):
    folders = [
        finished / "results" / name for name in ("tiny/contact", "tiny/adhesion", "real_surfaces")
    ]
    paths = [path for folder in folders for path in sorted(folder.rglob("*.nc"))]
    return {path.as_posix(): datasets.read(path) for path in paths}


def test_signs_are_stated_and_true(files):
    for file, data in files.items():
        for name, variable in data.variables.items():
            is_error = name.endswith(("_error", "_dominant"))
            if re.match(SIGNED, variable.attrs["long_name"]) and not is_error:
                assert variable.attrs.get("sign_convention"), (file, name)
            if re.fullmatch(r"(mean_|edge_)?gap", name):
                assert np.nanmin(variable.values) >= 0, (file, name)
        if "contact_pressure" in data:
            means = data[["contact_pressure", "gap"]].mean(["x", "y"], dtype=float)
            load = data.get("mean_pressure", data.pressure)
            np.testing.assert_allclose(means.contact_pressure, load, rtol=1e-5, err_msg=file)
            np.testing.assert_allclose(means.gap, data.mean_gap, rtol=1e-5, err_msg=file)
        if "pull_off_pressure" in data:
            assert (data.pull_off_pressure < 0).all(), file


def test_every_state_says_how_well_it_is_solved(files):
    for kind in KINDS:
        found = {file: data for file, data in files.items() if re.search(f"/tiny/{kind}", file)}
        assert found, kind
        for file, data in found.items():
            assert (data.converged == data.residual.notnull()).all(), file
            assert (data.iterations.notnull() == data.residual.notnull()).all(), file
            tolerance = float(re.search(r"at most (\S+),", data.converged.long_name)[1])
            assert data.residual.max() <= tolerance, file
            assert data.mean_gap.notnull().any(), file
