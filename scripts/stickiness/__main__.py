"""Say whether a material sticks to a measured surface, on a page with the reasons."""

import argparse
import html
import json
import re
import subprocess
import sys
import tomllib
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from typing import Any, NoReturn

PROJECT = Path(__file__).resolve().parents[2]
MARK = "# Written by python -m stickiness, which writes it anew: to edit it, copy the folder.\n"
TEXTS = tomllib.loads(Path(__file__).with_name("command.toml").read_text(encoding="utf-8"))
MATERIAL, SURFACE = TEXTS["material"], TEXTS["surface"]  # options by key of the configuration
OPTIONS = {key: option for key, (option, _) in (MATERIAL | SURFACE).items()}
# A key where an error speaks of it, and what separates it from its value.
BEFORE = r"^|[:;] |\(|\b(?:correct|give|give its|leave|raise|or|and|as|by) |(?<!\w)(?=\w+: [a-z])"
KEY = re.compile(rf"(?m)({BEFORE})({'|'.join(OPTIONS)})\b( =|:)?")


def main() -> None:
    """Make the page, and print what it says first and where it is."""
    given = read_options()
    if not (PROJECT / "Snakefile").is_file() or find_spec("snakemake") is None:
        fail(
            "this is the library without the workflow, which makes the page: run make install in "
            "the folder of the project, and this command with its .venv/bin/python"
        )
    for path in filter(None, [given.file, given.tape]):
        if not path.is_file():
            fail(f"{path}: {'a folder; give a file' if path.is_dir() else 'no such file'}")
    name = re.sub("[^A-Za-z0-9-]+", "_", given.file.stem).strip("_-") or "surface"
    write_configuration(given, name)
    target = f"results/draft/report/surfaces/{name}.html"
    command = [sys.executable, "-m", "snakemake", "--snakefile", f"{PROJECT}/Snakefile"]
    command += ["--cores=1", "--quiet=all", "--", target]  # three jobs, one after another
    try:
        run = subprocess.run(command, cwd=given.output, capture_output=True, encoding="utf-8")
    except KeyboardInterrupt:
        fail("stopped; the same command goes on")
    if run.returncode:
        fail(translate(find_reason(run.stdout + run.stderr), given))
    page = given.output / target
    print(translate(read_answer(page.read_text(encoding="utf-8")), given))
    print(f"Page: {page}")


def fail(text: str) -> NoReturn:
    """End the command with one line."""
    sys.exit(f"stickiness: {text}")


def read_options() -> argparse.Namespace:
    """Return what the command line gives, by the keys of the configuration."""
    style = partial(argparse.RawDescriptionHelpFormatter, max_help_position=30, width=100)
    texts = TEXTS["usage"], __doc__, TEXTS["notes"]
    parser = argparse.ArgumentParser(None, *texts, formatter_class=style)
    parser.error = fail  # type: ignore[assignment, method-assign]
    parser.add_argument("file", type=Path, metavar="FILE", help="heights, of any instrument")
    parser.add_argument("--tape", type=Path, metavar="FILE", help="materials, as shown below")
    folder, text = Path("stickiness-results"), "for results (default: stickiness-results)"
    parser.add_argument("--output", type=Path, default=folder, metavar="DIR", help=text)
    for title in ("material", "surface"):
        group = parser.add_argument_group(title)
        for key, (option, text) in TEXTS[title].items():
            kind = str if key == "label" else read_value
            group.add_argument(option, dest=key, type=kind, metavar="VALUE", help=text)
    given = parser.parse_args()
    used = [OPTIONS[key] for key in choose(given, MATERIAL)]
    if given.tape and used:
        fail(f"--tape describes the material: leave out {', '.join(used)}")
    if not given.tape and not {"--modulus", "--work"} <= {*used}:
        fail('give --modulus "0.2 MPa" and --work "60 mJ/m^2", or --tape; see --help')
    return given


def read_value(text: str) -> Any:
    """Return a number, a list of two values around an x, or the text."""
    try:
        return json.loads(text)
    except ValueError:
        both = re.split(r"\s*[x×]\s*(?=\d)", text)
        return both if len(both) == 2 else text


def choose(given: argparse.Namespace, options: dict[str, Any]) -> dict[str, Any]:
    """Return the values of those options that are given."""
    return {key: vars(given)[key] for key in options if vars(given)[key] is not None}


def write_configuration(given: argparse.Namespace, name: str) -> None:
    """Write the files of the configuration, into a folder that holds nothing else."""
    folder, config = given.output, given.output / "config/config.yaml"
    own = config.is_file() and config.read_text(encoding="utf-8").startswith(MARK)
    if folder.is_file() or (not own and folder.is_dir() and any(folder.iterdir())):
        fail(f"--output {folder} holds something else; give a new folder")
    material = {"label": "the material", "source": "command line", "poisson_ratio": 0.5}
    material |= {"range": "0.3 nm"} | choose(given, MATERIAL)
    surface = {"label": given.file.stem, "source": given.file.name, "kind": "measured"}
    surface |= {"file": str(given.file.absolute())} | choose(given, SURFACE)
    tape = str(given.tape.absolute()) if given.tape else "config/materials.yaml"
    files = {
        "config": {"fidelity": "draft", "materials": tape, "surfaces": "config/surfaces.yaml"},
        "materials": {"materials": {"material": material}},
        "surfaces": {"surfaces": {name: surface}},
    }
    config.parent.mkdir(parents=True, exist_ok=True)
    for table, content in files.items():  # YAML includes JSON
        text = MARK + json.dumps(content, ensure_ascii=False, indent=2)
        (config.parent / f"{table}.yaml").write_text(text, encoding="utf-8")


def find_reason(said: str) -> str:
    """Return why the workflow failed, from what it said."""
    failed = re.findall(r"^  failed +\S+: (?:[\w.]+: )?(.*) \(log: .*\)$", said, re.M)
    line = [*said.strip().splitlines(), *failed][-1]
    return re.sub(r"^config/\w+\.yaml: \w+\.[\w-]+[.:] ?", "", line)


def read_answer(page: str) -> str:
    """Return the text with which a page begins, a paragraph a line."""
    answer = page.partition('<div class="answer">')[2].partition("</div>")[0]
    lines = re.split("</(?:li|p)>", answer.replace("<sup>", "^"))
    texts = (" ".join(html.unescape(re.sub("<[^>]*>", "", line)).split()) for line in lines)
    return "\n".join(filter(None, texts))


def translate(text: str, given: argparse.Namespace) -> str:
    """Return what the workflow says in terms of the command line."""
    for path in filter(None, [given.file, given.tape]):
        text = text.replace(str(path.absolute()), str(path))
    options = SURFACE if given.tape else OPTIONS
    return KEY.sub(lambda key: key[1] + OPTIONS[key[2]] if key[2] in options else key[0], text)


if __name__ == "__main__":
    main()
