"""The claims ledger: every claim of the paper with its measured value and verdict."""

from pathlib import Path

import numpy as np
import xarray as xr

from claims import adhesion_claims, contact_claims, criterion_claims, errata, remaining_claims
from claims.ledger import collect
from common import remaining_table
from common.job import start
from common.templates import make_environment
from stickiness import datasets, error_budget

CLAIMS = collect(contact_claims, adhesion_claims, criterion_claims, remaining_claims)
PROSE = ("statement", "quantity", "remark", "comment")
COLUMNS = {
    "statement": ("what the paper claims",),
    "quantity": ("what the value is, with its unit",),
    "value": ("measured value, in the unit that `quantity` names", "nothing was known well enough"),
    "comment": ("what the errors are, or why they are not known or do not apply",),
    "claimed": ("the paper's value", "the paper gives none"),
    "verdict": ("verdict",),
    "remark": ("qualification or reason",),
    "sources": ("files that the value came from",),
}


def main(job):
    paths = find_paths(job.input, CLAIMS)
    files = {name: read(path) for name, path in paths.items()}
    environment = make_environment(Path(job.input.prose).parent)
    recomputed = errata.recompute()
    rows = [examine(claim, files, paths, environment) for claim in CLAIMS]
    datasets.write(
        to_dataset(rows),
        job.output.dataset,
        title="claims of the paper, recomputed",
        parameters={"errata": recomputed},
    )
    page = environment.get_template(Path(job.input.page).name).render(
        claims=rows, recomputed=recomputed
    )
    with datasets.whole_file(job.output.table) as path:
        path.write_text(page, encoding="utf-8")


def find_paths(inputs, claims):
    """Paths, or lists of paths, by the names that the claims use."""
    paths = {}
    for claim in claims:
        for name in claim.files:
            if name not in inputs.keys():  # noqa: SIM118  iterating gives paths
                known = ", ".join(sorted(inputs.keys()))
                raise ValueError(
                    f"claim {claim.number} reads {name!r}, which the rule check_claims does not "
                    f"give; it gives {known}: add the file to ledger_inputs in rules/"
                )
            paths[name] = inputs[name]
    return paths


def read(path):
    if not isinstance(path, str):
        return [read(one) for one in path]
    return remaining_table.read(path) if path.endswith(".csv") else datasets.read(path)


def examine(claim, files, paths, environment):
    """A row of the ledger: the finding of a claim, its prose and the files behind it."""
    finding = claim(files)
    return {
        "number": claim.number,
        "value": finding.value,
        "claimed_value": finding.claimed,
        "errors": finding.errors,
        "verdict": finding.verdict,
        "measured": write_measured(finding.value, finding.uncertainty),
        "dominant": name_dominant(finding),
        "claimed": "" if np.isnan(finding.claimed) else f"{finding.claimed:.4g}",
        "sources": find_sources(claim, paths),
        **write_prose(claim.number, finding.facts, environment),
    }


def write_prose(number, facts, environment):
    """Statement, quantity, remark and comment of a claim, each on one line."""
    template = environment.get_template("claims.j2")
    module = template.make_module({"facts": facts, **facts, "number": number})
    return {name: " ".join(str(getattr(module, name)).split()) for name in PROSE}


def find_sources(claim, paths):
    """Files behind a claim, each once; one name may stand for several files."""
    groups = (paths[name] for name in claim.files)
    found = [path for group in groups for path in ([group] if isinstance(group, str) else group)]
    return list(dict.fromkeys(found))


def to_dataset(rows):
    texts = {
        name: [row[name] for row in rows] for name in COLUMNS if name not in ("value", "claimed")
    }
    texts["sources"] = [" ".join(row["sources"]) for row in rows]
    numbers = {
        "value": [row["value"] for row in rows],
        "claimed": [row["claimed_value"] for row in rows],
    }
    columns = {name: np.array(column, object) for name, column in texts.items()}
    columns |= {name: np.array(column, float) for name, column in numbers.items()}
    dataset = xr.Dataset(
        {name: ("claim", columns[name]) for name in COLUMNS},
        coords={"claim": [row["number"] for row in rows]},
    )
    described = {name: ("1", *text) for name, text in COLUMNS.items()}
    dataset = datasets.annotate(dataset, claim=("1", "number of the claim"), **described)
    parts = {}
    for source in error_budget.SOURCES:
        error = xr.DataArray([row["errors"].get(source, 0.0) for row in rows], dims="claim")
        parts[source] = error_budget.Part(error, "see the comment of each claim")
    return error_budget.with_budget(dataset, "value", **parts)


def name_dominant(finding):
    """Source of the largest error; all sources that are not known, if there are any."""
    unknown = [source for source, error in finding.errors.items() if np.isnan(error)]
    if unknown:
        return f"{', '.join(unknown)} (not known)"
    return max(finding.errors, key=finding.errors.get) if finding.uncertainty else ""


def write_measured(value, uncertainty):
    if np.isnan(value):
        return "not known"
    if uncertainty == 0:
        return f"{value:.4g} (exact)"
    error = "" if np.isnan(uncertainty) else f" ± {uncertainty:.2g}"
    return f"{value:.4g}{error}"


if __name__ == "__main__":
    main(start(globals(), "check_claims"))
