"""Jobs in an environment of conda, and the files that a container holds."""

import os
import re
import shutil
import subprocess
import sys

import pytest
from helpers.copy_workflow import ROOT

pytestmark = pytest.mark.workflow

TARGET = "results/tiny/real_surfaces/asphalt.nc"
# As much of conda as Snakemake asks for. Its environments hold the Python that runs this test.
STAND_IN = """#!/bin/sh
echo "$@" >> {folder}/calls
case "$1 $2" in
  "info --json") echo '{{"conda_prefix": "{folder}", "platform": "linux-64"}}' ;;
  "--version "*) echo "conda 25.1.1" ;;
  "config "*) echo '{{"get": {{"channel_priority": "strict"}}}}' ;;
  "clean "*) ;;
  "env create")
    while [ $# -gt 1 ]; do
      [ "$1" = --file ] && cp "$2" {folder}/created.yaml
      [ "$1" = --prefix ] && prefix=$2
      shift
    done
    mkdir -p "$prefix/bin" "$prefix/conda-meta"
    starter="$prefix/bin/python"
    printf '#!/bin/sh\\necho started >> {folder}/python\\nexec {python} "$@"\\n' > $starter
    chmod +x $starter ;;
  *) exit 1 ;;
esac
"""


def test_jobs_run_in_the_environment_of_the_project(fresh, tmp_path_factory, monkeypatch):
    folder = tmp_path_factory.mktemp("conda")
    (folder / "bin").mkdir()
    command = folder / "bin/conda"
    command.write_text(STAND_IN.format(folder=folder, python=sys.executable), encoding="utf-8")
    command.chmod(0o755)
    (folder / "bin/activate").write_text('export PATH="$1/bin:$PATH"\n', encoding="utf-8")
    monkeypatch.setenv("PATH", f"{folder / 'bin'}:{os.environ['PATH']}")
    done = fresh.snakemake(TARGET, "--sdm", "conda")
    assert done.returncode == 0, done.stdout
    assert (fresh / TARGET).exists()
    created = (folder / "created.yaml").read_text(encoding="utf-8")
    assert created == (ROOT / "envs/environment.yaml").read_text(encoding="utf-8")
    assert "started" in (folder / "python").read_text()
    assert (folder / "calls").read_text().count("env create") == 1


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("conda") is None, reason="conda is not installed here")
def test_conda_makes_the_environment(fresh):
    done = fresh.snakemake(TARGET, "--sdm", "conda")
    assert done.returncode == 0, done.stdout
    assert (fresh / TARGET).exists()


def test_a_container_holds_what_a_run_needs(tmp_path):
    """The files that the recipe copies, in a folder of their own, run from another folder."""
    text = (ROOT / "envs/Containerfile").read_text(encoding="utf-8")
    held, work = tmp_path / "held", tmp_path / "work"
    work.mkdir()
    for *sources, target in map(str.split, re.findall(r"^COPY (.*)$", text, re.M)):
        for source in sources:
            place = held / target if target == source else held / target / source.split("/")[-1]
            place.parent.mkdir(parents=True, exist_ok=True)
            if (ROOT / source).is_dir():
                ignore = shutil.ignore_patterns("__pycache__")
                shutil.copytree(ROOT / source, place, ignore=ignore)
            else:
                shutil.copy2(ROOT / source, place)
    (entry,) = re.findall(r'^ENTRYPOINT \["snakemake", "--snakefile", "(.*)"\]$', text, re.M)
    home = re.findall(r"^WORKDIR (.*)$", text, re.M)[0]
    done = subprocess.run(
        [sys.executable, "-m", "snakemake", "--snakefile", entry.replace(home, str(held)), "-n"],
        cwd=work,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=300,
        check=False,
    )
    assert done.returncode == 0, done.stdout
    assert "write_report" in done.stdout
