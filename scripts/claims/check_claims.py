"""The claims ledger: every claim of the paper with its measured value and verdict."""

from pathlib import Path

import xarray as xr

from claims import adhesion_claims, contact_claims, criterion_claims, errata, remaining_claims
from claims.ledger import collect
from common import remaining_table
from common.job import start
from common.templates import make_environment, write_page
from stickiness import datasets, error_budget

CLAIMS = collect(contact_claims, adhesion_claims, criterion_claims, remaining_claims)
PROSE = ("statement", "quantity", "remark", "comment")
COLUMNS = {
    "statement": ("1", "what the paper claims"),
    "quantity": ("1", "what the value is, with its unit"),
    "value": (
        "1",
        "measured value, in the unit that `quantity` names",
        "nothing was known well enough",
    ),
    "comment": ("1", "what the errors are, or why they are not known or do not apply"),
    "claimed": ("1", "the paper's value", "the paper gives none"),
    "verdict": ("1", "verdict"),
    "remark": ("1", "qualification or reason"),
    "sources": ("1", "files that the value came from"),
}


def main(job):
    paths = find_paths(job.input, CLAIMS)
    files = {name: read(path) for name, path in paths.items()}
    recomputed = errata.recompute()
    rows = [examine(claim, files, paths, job.input.prose) for claim in CLAIMS]
    datasets.write(
        to_dataset(rows),
        job.output.dataset,
        title="claims of the paper, recomputed",
        parameters={"errata": recomputed},
    )
    write_page(job.input.page, job.output.table, claims=rows, recomputed=recomputed)


def find_paths(inputs, claims):
    """Paths, or lists of paths, by the names that the claims use."""
    wanted = {name: claim.number for claim in claims for name in claim.files}
    for name in wanted.keys() - inputs.keys():
        raise ValueError(
            f"claim {wanted[name]} reads {name!r}, which the rule check_claims does not give; it "
            f"gives {', '.join(sorted(inputs.keys()))}: add the file to ledger_inputs in rules/"
        )
    return {name: inputs[name] for name in wanted}


def read(path):
    if not isinstance(path, str):
        return [read(one) for one in path]
    return remaining_table.read(path) if path.endswith(".csv") else datasets.read(path)


def examine(claim, files, paths, prose):
    """A row of the ledger: the finding of a claim, its prose and the files behind it."""
    finding = claim(files)
    template = make_environment(Path(prose).parent).get_template(Path(prose).name)
    facts = {**finding.facts, "facts": finding.facts, "number": claim.number}
    texts = template.make_module(facts)
    groups = [paths[name] for name in claim.files]
    sources = [one for group in groups for one in ([group] if isinstance(group, str) else group)]
    return {
        "number": claim.number,
        "value": finding.value,
        "claimed": finding.claimed,
        "errors": finding.errors,
        "uncertainty": finding.uncertainty,
        "verdict": finding.verdict,
        "sources": list(dict.fromkeys(sources)),
        **{name: " ".join(str(getattr(texts, name)).split()) for name in PROSE},
    }


def to_dataset(rows):
    """Claims by number, with the error budget of their values."""
    columns = {name: ("claim", [row[name] for row in rows]) for name in COLUMNS}
    columns["sources"] = "claim", [" ".join(row["sources"]) for row in rows]
    dataset = xr.Dataset(columns, coords={"claim": [row["number"] for row in rows]})
    dataset = datasets.annotate(dataset, claim=("1", "number of the claim"), **COLUMNS)
    parts = {}
    for source in error_budget.SOURCES:
        error = xr.DataArray([row["errors"].get(source, 0.0) for row in rows], dims="claim")
        parts[source] = error_budget.ErrorComponent(error, "see the comment of each claim")
    return error_budget.with_budget(dataset, "value", **parts)


if __name__ == "__main__":
    main(start(globals(), "check_claims"))
