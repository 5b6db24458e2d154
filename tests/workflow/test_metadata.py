"""Files of contact and adhesion say what the sign of a number means, and how well it is solved."""

import re

import numpy as np
import pytest

from stickiness import datasets

pytestmark = pytest.mark.workflow

# Kinds of files that hold states, by their folders and the beginnings of their names.
KINDS = {
    *("contact/seeds", "contact/coarse", "contact/maps", "adhesion/full/seeds"),
    *("adhesion/full/maps", "adhesion/loops", "real_surfaces/contact"),
    *("real_surfaces/pictures", "real_surfaces/pull_off"),
}
SIGNED = re.compile(r"(\w+ ){0,3}(pressure|gap|tension|attraction)( over E| over h_rms|,| of a|$)")


def kind_of(file):
    """Folder of a file of results without the name of its case, and seeds, coarse or maps."""
    folders, name = file.split("/")[:-1], re.match(r"(seeds|coarse|maps)?", file.split("/")[-1])[0]
    return "/".join([*(folders[:-1] if name else folders), *([name] if name else [])])


@pytest.fixture(scope="module")
def files(finished):
    results = finished / "results/tiny"
    paths = sorted(
        p
        for part in ("contact", "adhesion", "real_surfaces")
        for p in (results / part).rglob("*.nc")
    )
    return {path.relative_to(results).as_posix(): datasets.read(path) for path in paths}


def test_signs_are_stated_and_true(files):
    signed = 0
    for file, data in files.items():
        for name, variable in data.variables.items():
            if name.endswith(("_error", "_dominant")):
                continue
            if SIGNED.match(variable.attrs["long_name"]):
                assert variable.attrs.get("sign_convention"), (file, name)
                signed += 1
            if re.fullmatch(r"(mean_|edge_)?gap", name):
                assert np.nanmin(variable.values) >= 0, (file, name)
    assert signed > 100


def test_fields_have_the_stated_load_and_mean_gap(files):
    """Compression is positive, and the mean times the area is the load."""
    checked = set()
    for file, data in files.items():
        kind = kind_of(file)
        if "contact_pressure" in data:
            mean = data[["contact_pressure", "gap"]].mean(["x", "y"], dtype=float)
            load = data.get("mean_pressure", data.pressure)
            np.testing.assert_allclose(mean.contact_pressure, load, rtol=1e-5, err_msg=file)
            np.testing.assert_allclose(mean.gap, data.mean_gap, rtol=1e-5, err_msg=file)
        elif "mean_traction" in data:
            assert -data.mean_traction.min() >= data.squeeze_pressure, file
            assert data.mean_traction.max() >= data.pull_off * (1 - 1e-9), file
            assert data.modulus > 1e3, file
        elif "pull_off_pressure" in data:  # at the end of the curve the press pulls
            assert (data.pull_off_pressure < 0).all(), file
            assert (data.mean_pressure.max() > 0).all(), file
        else:
            continue
        checked.add(kind)
    assert checked >= {
        "contact/maps",
        "adhesion/full/maps",
        "adhesion/loops",
        "real_surfaces/pictures",
    }


def test_every_state_says_how_well_it_is_solved(files):
    seen = set()
    for file, data in files.items():
        kind = kind_of(file)
        if kind not in KINDS or data.attrs.get("left_out"):
            continue
        for residual in (name for name in data if name.endswith("residual")):
            prefix = residual.removesuffix("residual")
            solved = data[residual].notnull()
            assert (data[f"{prefix}converged"] == solved).all(), (file, residual)
            assert (data[f"{prefix}iterations"].notnull() == solved).all(), (file, residual)
            tolerance = float(
                re.search(r"at most ([\de.+-]+),", data[f"{prefix}converged"].long_name)[1]
            )
            assert float(data[residual].max()) <= tolerance, (file, residual)
            seen.add(kind)
    assert seen >= KINDS - {"real_surfaces/pull_off"}
