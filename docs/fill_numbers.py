"""Write the numbers of results into README.md and docs, and into docs/numbers.yaml.

python docs/fill_numbers.py    # needs results/standard, and results/draft for its times

A page holds a number between two marks that readers do not see: `<!--name-->text<!--/-->`. A table
stands between marks on lines of their own. What a name stands for: `scripts/pipeline/quoted`.
"""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import yaml

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "scripts"))

from pipeline.quoted import quote_all  # noqa: E402
from pipeline.quoted.sources import Sources  # noqa: E402

TARGET = ROOT / "docs/numbers.yaml"
HEAD = """\
# Numbers in README.md and docs that are results. Written by docs/fill_numbers.py; do not edit.
"""
PAGES = [ROOT / "README.md", *(p for p in sorted(ROOT.glob("docs/*.md")) if p.stem != "config")]
MARKED = re.compile(r"<!--([\w.]+)-->(.*?)<!--/-->", re.S)


def names_in(page: str) -> list[str]:
    """Names of the numbers that a page holds."""
    return [name for name, _ in MARKED.findall(page)]


def fill(page: str, numbers: Mapping[str, str]) -> str:
    """The page with the text of every number in it; ValueError if one is not known."""

    def replace(found: re.Match[str]) -> str:
        name = found[1]
        if name not in numbers:
            raise ValueError(f"no number is called {name!r}; see scripts/pipeline/quoted")
        indent = re.search(r"[^\n]*\Z", page[: found.start()])[0]
        return f"<!--{name}-->{place(numbers[name], indent)}<!--/-->"

    return MARKED.sub(replace, page)


def place(text: str, indent: str) -> str:
    """A number as it is; a table as a block of its own, behind the indent of its mark."""
    if "\n" not in text:
        return text
    lines = "\n".join(indent + line for line in text.strip().splitlines())
    return f"\n\n{lines}\n\n{indent}"


def describe_run(sources: Sources) -> dict[str, Any]:
    """What results the numbers are of."""
    claims = sources.read("claims/claims")
    written = (sources.results / "claims/claims.nc").stat().st_mtime
    return {
        "fidelity": sources.results.name,
        "version": claims.attrs["version_stickiness"],
        "date": datetime.fromtimestamp(written, UTC).date().isoformat(),
    }


def as_yaml(run: Mapping[str, Any], numbers: Mapping[str, str]) -> str:
    """The committed file; tables line by line."""
    plain = {"results": dict(run), "numbers": dict(sorted(numbers.items()))}
    return HEAD + yaml.dump(
        plain, Dumper=Lines, sort_keys=False, allow_unicode=True, width=float("inf")
    )


class Lines(yaml.SafeDumper):
    """Writes texts of several lines as such."""


def represent_text(dumper: yaml.SafeDumper, text: str) -> yaml.ScalarNode:
    """A text as YAML, as a block if it has several lines."""
    style = "|" if "\n" in text else None
    return dumper.represent_scalar("tag:yaml.org,2002:str", text, style=style)


Lines.add_representer(str, represent_text)


def main() -> None:
    """Fill all pages and write the committed file."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--results", type=Path, default=ROOT / "results/standard")
    parser.add_argument("--draft", type=Path, default=ROOT / "results/draft")
    options = parser.parse_args()
    for folder, command in ((options.results, "make reproduce"), (options.draft, "make draft")):
        if not (folder / "claims/claims.nc").exists():
            sys.exit(f"{folder}: no claims/claims.nc; run {command} first")
    sources = Sources(options.results, options.draft, ROOT)
    numbers = quote_all(sources)
    pages = {path: path.read_text(encoding="utf-8") for path in PAGES}
    used = {name for page in pages.values() for name in names_in(page)}
    if unused := numbers.keys() - used:
        sys.exit(f"no page quotes {', '.join(sorted(unused))}: quote or remove them")
    for path, page in pages.items():
        path.write_text(fill(page, numbers), encoding="utf-8")
    TARGET.write_text(as_yaml(describe_run(sources), numbers), encoding="utf-8")


if __name__ == "__main__":
    main()
