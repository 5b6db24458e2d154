"""Time and memory of Snakemake itself on a campaign: a dry-run of many cases, before any job.

    python benchmarks/dag_cost.py --jobs 1000 3000 10000

Each case is a surface of its own with 8 seeds. With `--batch N` only the first of N batches of the
cases' ensembles is looked at (`snakemake --batch`), with `--case` one case is asked for by name.
"""

import argparse
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import yaml

ROOT = Path(__file__).parents[1]
SEEDS = 8
JOBS_PER_CASE = 2 * SEEDS + 6  # surfaces, solutions, coarse ones, means, theory, three fits
LOADS = [0.0065, 0.03, 0.065, 0.13, 0.3]
MAGNIFICATION = 512  # at standard fidelity 4096 points a side


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--jobs", type=int, nargs="+", default=[1000, 3000, 10_000])
    parser.add_argument("--batch", type=int, help="look at the first of so many batches")
    parser.add_argument("--case", action="store_true", help="look at one case of the campaign")
    parser.add_argument("--limit", type=float, default=600.0, help="longest dry-run [s]")
    chosen = parser.parse_args()
    for jobs in chosen.jobs:
        print(measured(round(jobs / JOBS_PER_CASE), chosen), flush=True)


def campaign(cases, results):
    """Configuration of so many cases beside those of the paper."""
    names = [f"campaign{number:05d}" for number in range(cases)]
    surfaces = {
        name: {"hurst": round(0.5 + 0.4 * number / cases, 6), "magnification": MAGNIFICATION}
        for number, name in enumerate(names)
    }
    return {
        "results": results,
        "model_surfaces": surfaces,
        "cases": {name: {"surface": name, "pressures": LOADS, "seeds": SEEDS} for name in names},
    }


def measured(cases, chosen):
    """One line: jobs, time, processor time and memory of a dry-run."""
    with tempfile.TemporaryDirectory() as folder:
        extra = Path(folder) / "campaign.yaml"
        extra.write_text(yaml.safe_dump(campaign(cases, folder)))
        command = [sys.executable, "-m", "snakemake", "-n", "--quiet", "rules", "host"]
        command += ["--configfile", "config/config.yaml", str(extra)]
        if chosen.batch:
            command += ["--batch", f"plot_fig3=1/{chosen.batch}"]
        if chosen.case:
            command += ["--", f"{folder}/standard/fits/theory/campaign00000.nc"]
        before, begin = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
        try:
            done = subprocess.run(
                command, cwd=ROOT, text=True, capture_output=True, timeout=chosen.limit, check=False
            )
        except subprocess.TimeoutExpired:
            return f"{cases * JOBS_PER_CASE} jobs: more than {chosen.limit:.0f} s"
        seconds = time.perf_counter() - begin
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if done.returncode:
            sys.exit(done.stdout + done.stderr)
        jobs = next(line.split()[1] for line in done.stdout.splitlines() if line[:5] == "total")
        spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        return (
            f"{cases} cases, {jobs} jobs: {seconds:.1f} s, {spent:.1f} s of processor time, "
            f"{1e3 * seconds / int(jobs):.2f} ms a job, at most {after.ru_maxrss / 1e3:.0f} MB"
        )


if __name__ == "__main__":
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    main()
