"""The claims ledger: every claim of the paper with its measured value and verdict."""

from pathlib import Path

import pandas as pd
import xarray as xr

from claims import adhesion_claims, contact_claims, criterion_claims, errata
from claims.ledger import DIFFERS, collect
from common import remaining_table
from common.job import start
from stickiness import datasets, error_budget
from stickiness.pages.rendering import make_environment, write_page

CLAIMS = collect(contact_claims, adhesion_claims, criterion_claims)
PROSE = ("statement", "quantity", "remark", "comment", "difference")
COLUMNS = {
    "claim": ("1", "number of the claim"),
    "statement": ("1", "what the paper claims"),
    "quantity": ("1", "what the value is, with its unit"),
    "value": ("1", "measured value, in the unit of `quantity`", "nothing was known well enough"),
    "comment": ("1", "what the errors are, or why they are not known or do not apply"),
    "claimed": ("1", "the paper's value", "the paper gives none"),
    "verdict": ("1", "verdict"),
    "difference": ("1", "parameters of the claim that the configuration sets otherwise"),
    "remark": ("1", "qualification or reason"),
    "sources": ("1", "files that the value came from"),
}


def main(job):
    inputs = job.input
    recomputed = errata.recompute()
    paths = {name: inputs[name] for claim in CLAIMS for name in claim.files}
    files = {name: read(path) for name, path in paths.items()}
    rows = [
        examine(claim, files, paths, inputs.prose, job.params.differences.get(claim.number, []))
        for claim in CLAIMS
    ]
    title = "claims of the paper, recomputed"
    parameters = {"errata": recomputed}
    datasets.write(to_dataset(rows), job.output.dataset, title=title, parameters=parameters)
    write_page(inputs.page, job.output.table, claims=rows, recomputed=recomputed)


def read(path):
    """Read the dataset or table of a path, or of every path in a list."""
    if not isinstance(path, str):
        return [read(member) for member in path]
    return remaining_table.read(path) if path.endswith(".csv") else datasets.read(path)


def examine(claim, files, paths, prose, differences):
    """Make a row of the ledger: the finding of a claim, its prose and the files behind it.

    With `differences` of the configuration from the claim (`common.paper`), it has no grade.
    """
    finding = claim(files)
    template = make_environment(Path(prose).parent).get_template(Path(prose).name)
    facts = {**finding.facts, "facts": finding.facts, "number": claim.number}
    facts["differences"] = differences
    texts = template.make_module(facts)
    groups = [paths[name] for name in claim.files]
    sources = [
        source for group in groups for source in ([group] if isinstance(group, str) else group)
    ]
    return {
        "number": claim.number,
        **{name: getattr(finding, name) for name in ("value", "claimed", "errors")},
        "verdict": DIFFERS if differences else finding.verdict,
        "uncertainty": finding.uncertainty,
        "sources": list(dict.fromkeys(sources)),
        **{name: " ".join(str(getattr(texts, name)).split()) for name in PROSE},
    }


def to_dataset(rows):
    """Claims by number, with the error budget of their values."""
    frame = pd.DataFrame(rows).rename(columns={"number": "claim"}).set_index("claim")
    frame["sources"] = frame.sources.str.join(" ")
    dataset = xr.Dataset(frame[[name for name in COLUMNS if name != "claim"]])
    none = dict.fromkeys(error_budget.SOURCES, 0.0)
    errors = pd.DataFrame([none | errors_of_claim for errors_of_claim in frame.errors], frame.index)
    errors = xr.DataArray(errors.rename_axis(columns="source"))
    texts = dict.fromkeys(error_budget.SOURCES, "see the comment of each claim")
    dataset = datasets.annotate(dataset, **COLUMNS)
    return error_budget.with_budget(dataset, "value", **error_budget.split(errors, texts))


if __name__ == "__main__":
    main(start(globals()))
