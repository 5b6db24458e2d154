"""The claims ledger: every claim of the paper with its measured value and verdict."""

import numpy as np
import xarray as xr

from claims.all_claims import CLAIMS
from common import remaining_table
from common.formatting import table
from common.job import start
from stickiness import datasets
from stickiness import error_budget as budget
from stickiness.criteria.errata import ERRATA

COLUMNS = {
    "statement": ("what the paper claims",),
    "quantity": ("what the value is, with its unit",),
    "value": (
        "measured value, in the unit that `quantity` names",
        "nothing was known well enough",
    ),
    "comment": ("what the errors are, or why they are not known or do not apply",),
    "claimed": ("the paper's value", "the paper gives none"),
    "verdict": ("verdict",),
    "remark": ("qualification or reason",),
    "sources": ("files that the value came from",),
}
NUMBERS = ("value", "claimed")  # all other columns are texts


def main(job):
    paths = input_paths(job.input, CLAIMS)
    files = {name: read(path) for name, path in paths.items()}
    findings = [claim(files) for claim in CLAIMS]
    sources = [source_paths(claim, paths) for claim in CLAIMS]
    datasets.write(
        to_dataset(CLAIMS, findings, sources),
        job.output.dataset,
        title="claims of the paper, recomputed",
        parameters={"errata": {str(erratum.number): erratum.recompute() for erratum in ERRATA}},
    )
    with datasets.whole_file(job.output.table) as path:
        path.write_text(to_markdown(CLAIMS, findings, sources), encoding="utf-8")


def input_paths(inputs, claims):
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


def source_paths(claim, paths):
    """Files behind a claim, each once; one name may stand for several files."""
    groups = (paths[name] for name in claim.files)
    found = [path for group in groups for path in ([group] if isinstance(group, str) else group)]
    return list(dict.fromkeys(found))


def to_dataset(claims, findings, sources):
    columns = {name: [getattr(finding, name, None) for finding in findings] for name in COLUMNS} | {
        "statement": [claim.statement for claim in claims],
        "sources": map(" ".join, sources),
    }
    dataset = xr.Dataset(
        {
            name: ("claim", np.array(list(column), float if name in NUMBERS else object))
            for name, column in columns.items()
        },
        coords={"claim": [claim.number for claim in claims]},
    )
    texts = {name: ("1", *texts) for name, texts in COLUMNS.items()}
    dataset = datasets.annotate(dataset, claim=("1", "number of the claim"), **texts)
    parts = {}
    for source in budget.SOURCES:
        error = [finding.errors.get(source, 0.0) for finding in findings]
        error = xr.DataArray(error, dims="claim")
        parts[source] = budget.Part(error, "see the comment of each claim")
    return budget.with_budget(dataset, "value", **parts)


def to_markdown(claims, findings, sources):
    rows = [
        (
            claim.number,
            claim.statement,
            f"**{found.verdict}**",
            f"{found.quantity}: {with_error(found.value, found.uncertainty)}",
            name_dominant(found),
            "" if np.isnan(found.claimed) else f"{found.claimed:.4g}",
            found.remark,
            "; ".join(files) or "closed form",
        )
        for claim, found, files in zip(claims, findings, sources, strict=True)
    ]
    columns = ("#", "claim", "verdict", "measured", "error by", "claimed", "remark", "from")
    errata = [
        (e.number, e.subject, e.printed, e.correct, e.proof)
        + (", ".join(f"{name} = {value:.4g}" for name, value in e.recompute().items()),)
        for e in ERRATA
    ]
    heads = ("#", "subject", "printed", "correct", "proof", "recomputed")
    of_claims, of_errata = table(columns, rows), table(heads, errata)
    return (
        f"# Claims of the paper, recomputed\n\n{of_claims}\n"
        f"# Errata of the manuscript\n\n{of_errata}"
    )


def name_dominant(finding):
    """Largest source of the error; of those not known, all."""
    unknown = [source for source, error in finding.errors.items() if np.isnan(error)]
    if unknown:
        return f"{', '.join(unknown)} (not known)"
    return max(finding.errors, key=finding.errors.get) if finding.uncertainty else ""


def with_error(value, uncertainty):
    if np.isnan(value):
        return "not known"
    if uncertainty == 0:
        return f"{value:.4g} (exact)"
    error = "" if np.isnan(uncertainty) else f" ± {uncertainty:.2g}"
    return f"{value:.4g}{error}"


if __name__ == "__main__":
    main(start(globals(), "check_claims"))
