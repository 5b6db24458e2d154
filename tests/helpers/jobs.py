"""A made-up job, as Snakemake hands it to the `main` of a rule's script."""

from types import SimpleNamespace


def make_job(output, params=(), wildcards=(), **inputs):
    """Job with one output, a file that need not exist yet."""
    output.parent.mkdir(parents=True, exist_ok=True)
    return SimpleNamespace(
        input=SimpleNamespace(**inputs),
        output=[str(output)],
        params=SimpleNamespace(**dict(params)),
        wildcards=SimpleNamespace(**dict(wildcards)),
    )
