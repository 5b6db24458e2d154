"""Say whether a material sticks to a measured surface, and make a page with the reasons."""

import argparse
import json
import os
import re
import subprocess
import sys
import tomllib
import warnings
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from typing import Any, NoReturn

PROJECT = Path(__file__).resolve().parents[2]
#: First line of the files that this command writes, and may replace.
MARK = "# Written by python -m stickiness, which writes it anew: to edit it, copy the folder.\n"
TEXTS = tomllib.loads(Path(__file__).with_name("command.toml").read_text(encoding="utf-8"))
#: Options by the keys of the configuration, for which they stand.
OPTIONS = {
    key: option for group in ("material", "surface") for key, (option, _) in TEXTS[group].items()
}


def main() -> None:
    """Print the verdict, then make the page and print where it is."""
    options = read_options()
    for path in filter(None, [options.file, options.tape]):
        if not path.is_file():
            fail(f"{path}: {'a folder; give a file' if path.is_dir() else 'no such file'}")
    material_texts, surface_texts = describe_pair(options)
    if not options.no_page:
        check_output(options.output)
    verdicts = judge_entries(options, material_texts, surface_texts)
    if options.json:
        print_json(verdicts)
    else:
        for verdict in verdicts:
            label = verdict.material.label
            print(f"{label[0].upper()}{label[1:]}: {verdict}")
        for choice in verdicts[0].surface.choices:
            source, others = choice.split(" | ")
            print(f"This is {source}; the file also holds {others} (--channel, --variable)")
    if not options.no_page:
        page = make_page(options, material_texts, surface_texts)
        print(f"Page: {page}", file=sys.stderr if options.json else sys.stdout)


def fail(text: str) -> NoReturn:
    """End the command with one line."""
    sys.exit(f"stickiness: {text}")


def read_options() -> argparse.Namespace:
    """Return what the command line gives, by the keys of the configuration."""
    style = partial(argparse.RawDescriptionHelpFormatter, max_help_position=30, width=100)
    parser = argparse.ArgumentParser(
        usage=TEXTS["usage"],
        description=__doc__,
        epilog=TEXTS["notes"],
        formatter_class=style,
        allow_abbrev=False,
    )
    parser.error = fail  # type: ignore[assignment, method-assign]
    parser.add_argument("file", type=Path, metavar="FILE", help="heights, of any instrument")
    parser.add_argument("--tape", type=Path, metavar="FILE", help="materials, as shown below")
    parser.add_argument("--json", action="store_true", help="print numbers in SI units as JSON")
    parser.add_argument("--no-page", action="store_true", help="print the verdict alone")
    parser.add_argument(
        "--output",
        type=Path,
        default=Path("stickiness-results"),
        metavar="DIR",
        help="for the page and its results (default: stickiness-results)",
    )
    for title in ("material", "surface"):
        group = parser.add_argument_group(title)
        for key, (option, text) in TEXTS[title].items():
            kind = str if key == "label" else read_value
            group.add_argument(option, dest=key, type=kind, metavar="VALUE", help=text)
    options = parser.parse_args()
    used = [OPTIONS[key] for key in choose_given(options, "material")]
    if options.tape and used:
        fail(f"--tape describes the material: leave out {', '.join(used)}")
    if not options.tape and not {"--modulus", "--work"} <= {*used}:
        fail('give --modulus "0.2 MPa" and --work "60 mJ/m^2", or --tape; see --help')
    return options


def read_value(text: str) -> Any:
    """Return a number, a list of two values around an x, or the text."""
    try:
        return json.loads(text)
    except ValueError:
        sides = re.split(r"\s*[x×]\s*(?=\d)", text)
        return sides if len(sides) == 2 else text


def choose_given(options: argparse.Namespace, group: str) -> dict[str, Any]:
    """Return the values of the options of a group that are given, by key."""
    values = vars(options)
    return {key: values[key] for key in TEXTS[group] if values[key] is not None}


def describe_pair(options: argparse.Namespace) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return the material and the surface as entries of the configuration, values as given."""
    material = {
        "label": "the material",
        "source": "command line",
        "poisson_ratio": 0.5,
        "range": "0.3 nm",
    }
    surface = {
        "label": options.file.stem,
        "source": options.file.name,
        "kind": "measured",
        "file": str(options.file),
    }
    return material | choose_given(options, "material"), surface | choose_given(options, "surface")


def judge_entries(
    options: argparse.Namespace, material_texts: dict[str, Any], surface_texts: dict[str, Any]
) -> list:
    """Return a `StickinessVerdict` for every material; end the command where values are wrong."""
    from stickiness import Material, Surface, verdict
    from stickiness.entries import EntryError, check_material, check_surface, read_materials
    from stickiness.measured.topography import UntoldError
    from stickiness.plausibility import PlausibilityWarning

    try:
        if options.tape:
            entries = read_materials(options.tape)
        else:
            entries = {"material": check_material(material_texts, numbers=False)}
        surface = Surface.from_entry(check_surface(surface_texts, numbers=False))
        materials = [Material.from_entry(entry) for entry in entries.values()]
    except EntryError as error:
        fail(tell_entry_error(error))
    except UntoldError as error:
        fail(error.tell(OPTIONS))
    except (ValueError, OSError) as error:
        fail(" ".join(str(error).split()))
    with warnings.catch_warnings():
        # Every verdict has the doubts about its pair.
        warnings.simplefilter("ignore", PlausibilityWarning)
        return [verdict(surface, material) for material in materials]


def tell_entry_error(error: Any) -> str:
    """Return what is wrong with a value, by the option that gave it."""
    option = OPTIONS.get(error.key)
    return str(error) if option is None else f"{option} {error.value!r}: {error.message}"


def print_json(verdicts: list) -> None:
    """Print the numbers of one verdict, or of several as a list with the names of materials."""
    if len(verdicts) == 1:
        contents: Any = verdicts[0].to_dict()
    else:
        contents = [{"material": each.material.label, **each.to_dict()} for each in verdicts]
    print(json.dumps(contents, indent=1, ensure_ascii=False, allow_nan=False))


def make_page(
    options: argparse.Namespace, material_texts: dict[str, Any], surface_texts: dict[str, Any]
) -> Path:
    """Run the workflow in the folder for results, and return the path of the page."""
    if not (PROJECT / "Snakefile").is_file() or find_spec("snakemake") is None:
        fail(
            "no page, for this is the library without the workflow: give --no-page, or run make "
            "install in the folder of the project and this command with its .venv/bin/python"
        )
    name = re.sub("[^A-Za-z0-9-]+", "_", options.file.stem).strip("_-") or "surface"
    write_configuration(options, name, material_texts, surface_texts)
    target = f"results/draft/report/surfaces/{name}.html"
    command = [
        *(sys.executable, "-m", "snakemake", "--snakefile", f"{PROJECT}/Snakefile"),
        *("--cores=1", "--quiet=all", "--", target),  # one job after another
    ]
    try:
        run = subprocess.run(command, cwd=options.output, capture_output=True, encoding="utf-8")
    except KeyboardInterrupt:
        fail("stopped; the same command goes on")
    if run.returncode:
        lines = (run.stdout + run.stderr).strip().splitlines()
        fail(f"no page: {lines[-1] if lines else 'the workflow failed'}")
    return options.output / target


def check_output(folder: Path) -> None:
    """End the command if the folder for the page holds something else or cannot be written."""
    config = folder / "config/config.yaml"
    is_ours = config.is_file() and config.read_text(encoding="utf-8").startswith(MARK)
    if folder.is_file() or (not is_ours and folder.is_dir() and any(folder.iterdir())):
        fail(f"--output {folder} holds something else; give a new folder")
    existing = next(path for path in (folder, *folder.absolute().parents) if path.is_dir())
    if not os.access(existing, os.W_OK):
        fail(f"--output {folder} cannot be written; give another folder")


def write_configuration(
    options: argparse.Namespace,
    name: str,
    material_texts: dict[str, Any],
    surface_texts: dict[str, Any],
) -> None:
    """Write the files of the configuration."""
    tape = str(options.tape.absolute()) if options.tape else "config/materials.yaml"
    surface_texts = surface_texts | {"file": str(options.file.absolute())}
    files = {
        "config": {"fidelity": "draft", "materials": tape, "surfaces": "config/surfaces.yaml"},
        "materials": {"materials": {"material": material_texts}},
        "surfaces": {"surfaces": {name: surface_texts}},
    }
    try:
        (options.output / "config").mkdir(parents=True, exist_ok=True)
    except OSError as error:
        fail(f"--output {options.output} cannot be written ({error.strerror}); give another folder")
    for table, content in files.items():  # YAML includes JSON
        text = MARK + json.dumps(content, ensure_ascii=False, indent=2)
        (options.output / f"config/{table}.yaml").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    try:
        main()
    except BrokenPipeError:  # whoever reads the output has read enough
        sys.stderr.close()
