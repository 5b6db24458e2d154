"""Names of cases and model surfaces are free: nothing but the configuration knows them."""

import os
import shutil

import matplotlib.image
import netCDF4
import numpy as np
import pytest
import yaml

from stickiness import datasets

pytestmark = pytest.mark.workflow

FIGURES = ("fig3", "fig4", "fig5", "fig8", "fig10")
# Folders of results in which files, or folders, have the name of a case or of a surface.
OF_SURFACES = ("surfaces", "contact")
OF_CASES = ("cases", "contact/ensembles", "persson/lattice")
OF_CASES += ("fits/kappa", "fits/theory", "fits/a_v/ensembles", "fits/a_v/lattice")


def rename(workflow):
    """Give every case and every model surface another name, one unlike the other."""
    path = workflow / "config/config.yaml"
    config = yaml.safe_load(path.read_text(encoding="utf-8"))
    surfaces = {name: f"ground{i}" for i, name in enumerate(config["model_surfaces"])}
    cases = {name: f"press{i}" for i, name in enumerate(config["cases"])}
    config["cases"] = {
        cases[name]: entry | {"surface": surfaces[entry["surface"]]}
        for name, entry in config["cases"].items()
    }
    config["roles"] = {role: cases[name] for role, name in config["roles"].items()}
    for file, content in (
        (path, config),
        (
            workflow / "config/tiny.yaml",
            yaml.safe_load((workflow / "config/tiny.yaml").read_text()),
        ),
    ):
        content["model_surfaces"] = {
            surfaces[name]: entry for name, entry in content["model_surfaces"].items()
        }
        file.write_text(yaml.safe_dump(content, sort_keys=False), encoding="utf-8")
    return cases, surfaces


def move(path, old, new):
    """Give a file of results another name, or a folder and what it holds; datasets know theirs."""
    path = path.rename(path.with_name(path.name.replace(old, new)))
    for file in path.rglob("*.nc") if path.is_dir() else [path]:
        times = file.stat().st_atime_ns, file.stat().st_mtime_ns
        with netCDF4.Dataset(file, "a") as dataset:
            dataset.written_as = dataset.written_as.replace(f"/{old}", f"/{new}")
            dataset.parameters = dataset.parameters.replace(f'"{old}"', f'"{new}"')
        os.utime(file, ns=times)


def test_the_same_jobs_are_planned(fresh):
    before = fresh.planned()
    rename(fresh)
    assert fresh.planned() == before
    assert "H0." not in fresh.dry_run("fig4").stdout


def test_figures_and_claims_of_renamed_results_are_the_same(copy_of_finished):
    """The results get the new names as well, so that nothing is simulated again."""
    results = copy_of_finished / "results/tiny"
    pictures = {name: results / f"figures/{name}.png" for name in FIGURES}
    drawn = {name: matplotlib.image.imread(path) for name, path in pictures.items()}
    claims = datasets.read(results / "claims/claims.nc")
    cases, surfaces = rename(copy_of_finished)
    renamed = dict.fromkeys(OF_CASES, cases) | dict.fromkeys(OF_SURFACES, surfaces)
    for folder, names in renamed.items():
        for old, new in names.items():
            for path in (results / folder).glob(f"{old}*"):
                if path.name.removesuffix(".nc").partition("@")[0] == old:
                    move(path, old, new)
    shutil.rmtree(results / "figures")
    made = [f"results/tiny/figures/{name}.png" for name in FIGURES]
    made += ["results/tiny/claims/claims.nc"]
    done = copy_of_finished.snakemake(*made, "--force", "--rerun-triggers", "mtime")
    assert done.returncode == 0, done.stdout
    for name, picture in drawn.items():
        np.testing.assert_array_equal(matplotlib.image.imread(pictures[name]), picture, name)
    again = datasets.read(results / "claims/claims.nc")
    for name in ("value", "value_error", "verdict", "quantity", "remark", "comment"):
        np.testing.assert_array_equal(again[name], claims[name])
