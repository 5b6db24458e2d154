"""Say whether a material sticks to a measured surface, on a page with the reasons."""

import argparse
import html
import json
import re
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path
from typing import Any, NoReturn

PROJECT = Path(__file__).resolve().parents[2]
MARK = "# Written by python -m stickiness, which writes it anew: to edit it, copy the folder.\n"
USAGE = "python -m stickiness FILE (--modulus … --work … | --tape …) [options]"
NOTES = """examples:
  python -m stickiness wall.al3d --modulus "0.2 MPa" --work "60 mJ/m^2"
  python -m stickiness wall.txt --length "2 mm" --height-unit um --tape tape.yaml

tape.yaml, for one material or several:
  materials:
    my_tape: {label: my tape, youngs_modulus: "0.2 MPa", poisson_ratio: 0.5,
              work_of_adhesion: "60 mJ/m^2", range: "0.3 nm", source: own measurement}

Values need their units. Files of instruments usually tell the size of the map and the unit of
its heights. The page is DIR/results/draft/report/surfaces/NAME.html, with NAME from that of FILE.
The next run on a FILE of this name replaces the page, and repeats only what has changed."""
# Options by the keys of the configuration that they set.
MATERIAL = {
    "youngs_modulus": ("--modulus", 'Young\'s modulus, "0.2 MPa"'),
    "work_of_adhesion": ("--work", 'of adhesion of the pair, "60 mJ/m^2"; no energy of peeling'),
    "poisson_ratio": ("--poisson", "Poisson's ratio (default: 0.5)"),
    "range": ("--range", 'range of the attraction (default: "0.3 nm")'),
    "thickness": ("--thickness", 'of a layer, "50 um" (default: infinitely deep)'),
    "backing": ("--backing", "bonded (default) or slip: how a layer meets its base"),
}
SURFACE = {
    "label": ("--label", "name of the surface for readers (default: that of FILE)"),
    "length": ("--length", 'side of the map along x, "2 mm"; or both, "2 mm x 1 mm"'),
    "pixel_size": ("--pixel-size", 'grid step, "0.5 um", instead of the length'),
    "height_unit": ("--height-unit", "unit of the heights: nm, um, mm or m"),
    "position_unit": ("--position-unit", "unit of the positions of a line profile"),
    "channel": ("--channel", "channel to read, by name or counted from 0"),
    "variable": ("--variable", "variable of a NetCDF file, or key of an npz file"),
    "format": ("--format", "text, numpy, netcdf, instrument, or the name of a format"),
    "missing_value": ("--missing-value", "number that marks missing points"),
    "missing": ("--missing", "missing points: fill (default), crop or refuse"),
    "max_missing": ("--max-missing", "largest share of missing points that is filled"),
    "detrend": ("--detrend", "what to subtract: plane (default), mean or quadratic"),
    "resolution": ("--resolution", "shortest wavelength that the instrument resolves"),
    "fit_to": ("--fit-to", "shortest wavelength of the fit to the spectrum"),
    "extend_to": ("--extend-to", "wavelength down to which the fitted spectrum is extended"),
    "plausibility": ("--plausibility", "ignore: give a verdict on implausible heights, too"),
}
OPTIONS = {key: option for key, (option, _) in (MATERIAL | SURFACE).items()}
# A key where an error speaks of it, and what separates it from its value.
BEFORE = r"^|: |\b(?:give|give its|leave|raise|or|and|as|by) |(?<!\w)(?=\w+: [a-z])"
KEY = re.compile(rf"({BEFORE})({'|'.join(OPTIONS)})\b( =|:)?")


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
    page = f"results/draft/report/surfaces/{name}.html"
    command = [sys.executable, "-m", "snakemake", "--snakefile", f"{PROJECT}/Snakefile"]
    command += ["--cores=1", "--quiet=all", "--", page]  # three jobs, one after another
    pipe, joined = subprocess.PIPE, subprocess.STDOUT
    try:
        run = subprocess.run(
            command, cwd=given.output, stdout=pipe, stderr=joined, encoding="utf-8", check=False
        )
    except KeyboardInterrupt:
        fail("stopped; the same command goes on")
    if run.returncode:
        fail(translate(find_reason(run.stdout), given))
    for line in read_answer(given.output / page):
        print(translate(line, given))
    print(f"Page: {given.output / page}")


def fail(text: str) -> NoReturn:
    """End the command with one line."""
    sys.exit(f"stickiness: {text}")


def read_options() -> argparse.Namespace:
    """Return what the command line gives, by the keys of the configuration."""
    style = argparse.RawDescriptionHelpFormatter
    parser = argparse.ArgumentParser(None, USAGE, __doc__, NOTES, formatter_class=style)
    parser.error = fail  # type: ignore[assignment, method-assign]
    parser.add_argument("file", type=Path, metavar="FILE", help="heights, of any instrument")
    parser.add_argument("--tape", type=Path, metavar="FILE", help="materials, as shown below")
    folder, text = Path("stickiness-results"), "for results (default: stickiness-results)"
    parser.add_argument("--output", type=Path, default=folder, metavar="DIR", help=text)
    for title, options in (("material", MATERIAL), ("surface", SURFACE)):
        group = parser.add_argument_group(title)
        for key, (option, text) in options.items():
            group.add_argument(option, dest=key, type=read_value, metavar="VALUE", help=text)
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
    return {
        key: value for key, value in vars(given).items() if key in options and value is not None
    }


def write_configuration(given: argparse.Namespace, name: str) -> None:
    """Write the files of the configuration, into a folder that holds nothing else."""
    folder, config = given.output, given.output / "config/config.yaml"
    own = config.is_file() and config.read_text(encoding="utf-8").startswith(MARK)
    if folder.is_file() or (not own and folder.is_dir() and any(folder.iterdir())):
        fail(f"--output {folder} holds something else; give a new folder")
    material = {"label": "the material", "source": "command line", "poisson_ratio": 0.5}
    surface = {"label": given.file.stem, "source": given.file.name, "kind": "measured"}
    surface |= {"file": str(given.file.absolute())} | choose(given, SURFACE)
    tape = str(given.tape.absolute()) if given.tape else "config/materials.yaml"
    files = {
        "config": {"fidelity": "draft", "materials": tape, "surfaces": "config/surfaces.yaml"},
        "materials": {
            "materials": {"material": material | {"range": "0.3 nm"} | choose(given, MATERIAL)}
        },
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


def translate(line: str, given: argparse.Namespace) -> str:
    """Return a line of the workflow in terms of the command line."""
    for path in filter(None, [given.file, given.tape]):
        line = line.replace(str(path.absolute()), str(path))
    options = SURFACE if given.tape else OPTIONS
    return KEY.sub(lambda key: key[1] + OPTIONS[key[2]] if key[2] in options else key[0], line)


def read_answer(page: Path) -> list[str]:
    """Return the lines with which a page begins."""
    parts = re.findall('<div class="answer">(.*?)</div>', page.read_text(encoding="utf-8"), re.S)
    lines = re.split("</(?:li|p)>", "".join(parts).replace("<sup>", "^"))
    texts = (" ".join(html.unescape(re.sub("<[^>]*>", "", line)).split()) for line in lines)
    return [text for text in texts if text]


if __name__ == "__main__":
    main()
