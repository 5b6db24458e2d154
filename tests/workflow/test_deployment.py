"""Jobs run in the environment of conda that their rules name."""

import os
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
