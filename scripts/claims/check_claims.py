"""The claims ledger: every claim of the paper with its measured value and verdict."""

import numpy as np
import xarray as xr

from pipeline.claims.ledger import CLAIMS
from pipeline.job import start
from pipeline.tables import table
from stickiness.core import budget, datasets
from stickiness.criteria.errata import ERRATA


def main(job):
    paths = ledger_files(job.input)
    files = {name: datasets.read(path) for name, path in paths.items()}
    claims = [judge(files) for judge in CLAIMS]
    sources = [source_paths(claim, paths) for claim in claims]
    datasets.write(
        to_dataset(claims, sources),
        job.output.dataset,
        title="claims of the paper, recomputed",
        parameters={"errata": {str(erratum.number): erratum.recompute() for erratum in ERRATA}},
    )
    with datasets.whole_file(job.output.table) as path:
        path.write_text(markdown(claims, sources), encoding="utf-8")


def ledger_files(inputs):
    """Files by the names that the claims use."""
    several = {"surfaces": "surface", "seeds": "seed", "library": None}
    paths = {name: inputs[name] for name in inputs.keys() if name not in several}  # noqa: SIM118
    for group, prefix in several.items():
        if prefix:
            paths |= {f"{prefix}:{path}": path for path in inputs[group]}
    return paths


def source_paths(claim, paths):
    """Files behind a claim, each once; one name may stand for a group of files."""
    groups = {"seeds": "seed:", "surfaces": "surface:"}
    found = []
    for name in claim.sources:
        if name in groups:
            found += [path for key, path in paths.items() if key.startswith(groups[name])]
        else:
            found.append(paths[name])
    return list(dict.fromkeys(found))


def to_dataset(claims, sources):

    def column(name, dtype=None):
        return "claim", np.array([getattr(claim, name) for claim in claims], dtype=dtype)

    dataset = xr.Dataset(
        {
            "statement": column("statement", object),
            "quantity": column("quantity", object),
            "value": column("value", float),
            "comment": column("comment", object),
            "claimed": column("claimed", float),
            "verdict": column("verdict", object),
            "remark": column("remark", object),
            "sources": ("claim", np.array([" ".join(files) for files in sources], dtype=object)),
        },
        coords={"claim": [claim.number for claim in claims]},
    )
    dataset = datasets.annotate(
        dataset,
        claim=("1", "number of the claim"),
        statement=("1", "what the paper claims"),
        quantity=("1", "what the value is, with its unit"),
        value=("1", "measured value, in the unit that `quantity` names"),
        comment=("1", "what the errors are, or why they are not known or do not apply"),
        claimed=("1", "the paper's value", "the paper gives none"),
        verdict=("1", "verdict"),
        remark=("1", "qualification or reason"),
        sources=("1", "files that the value came from"),
    )
    errors = {
        source: [claim.errors.get(source, 0.0) for claim in claims] for source in budget.SOURCES
    }
    parts = {
        source: budget.Part(xr.DataArray(error, dims="claim"), "see the comment of each claim")
        for source, error in errors.items()
    }
    return budget.with_budget(dataset, "value", **parts)


def markdown(claims, sources):
    rows = [
        (
            claim.number,
            claim.statement,
            f"**{claim.verdict}**",
            f"{claim.quantity}: {number(claim.value, claim.uncertainty)}",
            dominant(claim),
            "" if np.isnan(claim.claimed) else f"{claim.claimed:.4g}",
            claim.remark,
            "; ".join(files) or "closed form",
        )
        for claim, files in zip(claims, sources, strict=True)
    ]
    columns = ("#", "claim", "verdict", "measured", "error by", "claimed", "remark", "from")
    errata = [
        (e.number, e.subject, e.printed, e.correct, e.proof, numbers(e.recompute())) for e in ERRATA
    ]
    heads = ("#", "subject", "printed", "correct", "proof", "recomputed")
    return (
        "# Claims of the paper, recomputed\n\n"
        + table(columns, rows)
        + "\n# Errata of the manuscript\n\n"
        + table(heads, errata)
    )


def dominant(claim):
    """Largest source of the error; of those not known, all."""
    unknown = [source for source, error in claim.errors.items() if np.isnan(error)]
    if unknown:
        return f"{', '.join(unknown)} (not known)"
    return max(claim.errors, key=claim.errors.get) if claim.uncertainty else ""


def number(value, uncertainty):
    if uncertainty == 0:
        return f"{value:.4g} (exact)"
    error = "" if np.isnan(uncertainty) else f" ± {uncertainty:.2g}"
    return f"{value:.4g}{error}"


def numbers(recomputed):
    return ", ".join(f"{name} = {value:.4g}" for name, value in recomputed.items())


if __name__ == "__main__":
    main(start(globals(), "check_claims"))
