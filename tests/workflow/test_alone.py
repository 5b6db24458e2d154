"""Scripts run alone, in an editor or a terminal, on the jobs that Snakemake would give to them."""

import json

import pytest

from stickiness import datasets

pytestmark = pytest.mark.workflow

DESCRIBE = """
import json
from common.job import mock

job = mock("answer_case", configfiles=["config/tiny.yaml"], case="H0.7_zeta64")
print(json.dumps([job.output.answer, job.wildcards.case, job.config["fidelity"]]))
"""


def run_alone(workflow, script, *files):
    tiny = ("--configfile", "config/tiny.yaml")
    return workflow.python(f"scripts/{script}", *files, *tiny)


@pytest.mark.parametrize(
    ("script", "file"),
    [
        ("contact/solve_repulsive.py", "contact/H0.7_zeta64@*/seeds1-2_*.nc"),
        ("figures/plot_fig4.py", "figures/fig4.png"),
    ],
)
def test_a_script_alone_makes_what_it_makes_in_a_run(copy_of_finished, script, file):
    (path,) = (copy_of_finished / "results/tiny").glob(file)
    made = path.rename(path.with_name(f"of_run{path.suffix}"))
    done = run_alone(copy_of_finished, script, path.relative_to(copy_of_finished.folder))
    assert done.returncode == 0, done.stderr
    if path.suffix == ".png":
        assert path.read_bytes() == made.read_bytes()
    else:
        again = datasets.read(path)
        made.replace(path)
        assert again.identical(datasets.read(path))


def test_without_a_file_the_first_job_of_a_run_is_taken(copy_of_finished):
    done = run_alone(copy_of_finished, "persson/persson_sweep.py")
    assert done.stderr.startswith("scripts/persson/persson_sweep.py: makes results/tiny/persson/")


@pytest.mark.parametrize(
    ("file", "message"),
    [
        ("fig4.png", "makes none of the files wanted"),
        ("fig0.png", "No rule to produce results/tiny/figures/fig0"),
        ("fig3.png", "is not made yet; run: snakemake -j1 results/"),
    ],
)
def test_what_a_script_alone_cannot_make(fresh, file, message):
    done = run_alone(fresh, "figures/plot_fig3.py", f"results/tiny/figures/{file}")
    assert done.returncode == 1
    (line,) = done.stderr.splitlines()
    assert message in line


def test_a_rule_with_wildcards_gives_its_job(finished):
    done = finished.python("-c", DESCRIBE)
    assert done.returncode == 0, done.stderr
    output = "results/tiny/cases/H0.7_zeta64.nc"
    assert json.loads(done.stdout) == [output, "H0.7_zeta64", "tiny"]
