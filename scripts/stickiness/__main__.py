"""Say whether a material sticks to a measured surface, and make a page with the reasons."""

import argparse
import errno
import fcntl
import json
import os
import platform
import re
import shlex
import subprocess
import sys
import tempfile
import tomllib
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path
from typing import Any, NoReturn

from stickiness import __version__

PROJECT = Path(__file__).resolve().parents[2]
#: First line of the files that this command writes, and may replace.
MARK = "# Written by python -m stickiness, which writes it anew: to edit it, copy the folder.\n"
TEXTS = tomllib.loads(Path(__file__).with_name("command.toml").read_text(encoding="utf-8"))
#: Options by the keys of the configuration, for which they stand.
OPTIONS = {
    key: option for group in ("material", "surface") for key, (option, _) in TEXTS[group].items()
}


def main() -> None:
    """Answer the command line; end with one line if the answer cannot be written."""
    # Before numpy is loaded: on such grids the threads of linear algebra wait more than they work.
    for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
        os.environ.setdefault(name, "1")
    try:
        answer()
        sys.stdout.flush()
    except OSError as error:
        # What is left in the buffer would fail once more at the end.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        if not isinstance(error, BrokenPipeError):  # whoever reads the output has read enough
            fail(str(error))


def answer() -> None:
    """Print the verdict, then make the page and print where it is."""
    arguments = sys.argv[1:]
    if "--materials" in arguments:
        print_materials()
        return
    is_example = "--example" in arguments
    if is_example:
        arguments = spell_out_example(arguments)
    options = read_options(arguments)
    progress = sys.stderr if options.json else sys.stdout
    if is_example:
        write_example(options.file)
        print(f"Example: python -m stickiness {shlex.join(arguments)}", file=progress)
    for path in filter(None, [options.file, options.tape]):
        if not path.is_file():
            fail(f"{path}: {'a folder; give a file' if path.is_dir() else 'no such file'}")
    material_texts, surface_texts = describe_pair(options)
    if not options.no_page:
        check_output(options.output)
    radius = None if options.radius is None else read_radius(options.radius)
    verdicts = judge_entries(options, material_texts, surface_texts)
    balls = find_balls(verdicts, radius)
    if options.json:
        print_json(verdicts, balls)
    else:
        for verdict, ball in zip(verdicts, balls, strict=True):
            label = verdict.material.label
            print(f"{label[0].upper()}{label[1:]}: {verdict}")
            if ball:
                print(ball)
        for choice in verdicts[0].surface.choices:
            source, others = choice.split(" | ")
            print(f"This is {source}; the file also holds {others} (--channel, --variable)")
    if not options.no_page:
        # All verdicts are on one surface.
        page = make_page(options, material_texts, surface_texts, verdicts[0].surface)
        print(f"Page: {page}", file=progress)


def print_materials() -> None:
    """Print the common materials, a line each."""
    from stickiness.entries import list_common_materials

    for name, entry in list_common_materials().items():
        print(
            f"{name:<24} E = {entry['youngs_modulus']}, nu = {entry['poisson_ratio']:g}, "
            f"work = {entry['work_of_adhesion']}, range = {entry['range']}; "
            + ". ".join(filter(None, (entry["source"], entry["note"])))
        )


def fail(text: str) -> NoReturn:
    """End the command with one line."""
    sys.exit(f"stickiness: {text}")


def spell_out_example(arguments: list[str]) -> list[str]:
    """Replace `--example` by what it stands for; a material that is given stays."""
    others = [word for word in arguments if word != "--example"]
    names = {word.partition("=")[0] for word in others}
    example = TEXTS["example"]
    is_given = names & {"--material", "--tape", "--modulus"}
    return [*example["surface"], *([] if is_given else example["material"]), *others]


def write_example(file: Path) -> None:
    """Write the heights of the example, unless a file of this name is there."""
    from stickiness import example_wall
    from stickiness.datasets import whole_file

    if file.exists():
        return
    try:
        with whole_file(file) as temporary:
            example_wall.write(temporary)
    except OSError as error:
        fail(f"--example: {error}")


def read_options(arguments: list[str]) -> argparse.Namespace:
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
    parser.add_argument("--example", action="store_true", help="judge the heights of an example")
    parser.add_argument("--tape", type=Path, metavar="FILE", help="materials, as shown below")
    parser.add_argument("--materials", action="store_true", help="list the common materials")
    parser.add_argument(
        "--radius", metavar="VALUE", help='of a ball, "1 mm": print its pull-off force, too'
    )
    parser.add_argument("--version", action="version", version=describe_version())
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
    options = parser.parse_args(arguments)
    used = [OPTIONS[key] for key in choose_given(options, "material")]
    if options.tape and used:
        fail(f"--tape describes the material: leave out {', '.join(used)}")
    if not (options.tape or options.common) and not {"--modulus", "--work"} <= {*used}:
        fail('give --modulus "0.2 MPa" and --work "60 mJ/m^2", --material or --tape; see --help')
    return options


def describe_version() -> str:
    """What a report of a bug should tell: versions, and the system."""
    codes = ", ".join(f"{name} {version(name)}" for name in ("numpy", "scipy", "numba"))
    system = f"{platform.system()} {platform.machine()}"
    return f"stickiness {__version__} (Python {platform.python_version()}, {codes}; {system})"


def read_radius(text: str) -> float:
    """Return the radius of `--radius` in m."""
    from stickiness.units import Quantity

    try:
        radius = float(Quantity.read(text, "m"))
    except ValueError as error:
        fail(f"--radius {error}")
    if not radius > 0:
        fail(f"--radius {text!r}: must be positive")
    return radius


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
    material: dict[str, Any] = {}
    if options.common is None:
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


def find_balls(verdicts: list, radius: float | None) -> list:
    """Return the pull-off of a ball for every verdict; None without a radius."""
    from stickiness.verdicts.rough_ball import pull_off_of_ball

    if radius is None:
        return [None] * len(verdicts)
    try:
        return [pull_off_of_ball(each.surface, each.material, radius) for each in verdicts]
    except ValueError as error:
        fail(f"--{error}")


def print_json(verdicts: list, balls: list) -> None:
    """Print the numbers of one verdict, or of several as a list with the names of materials."""
    listed = []
    for verdict, ball in zip(verdicts, balls, strict=True):
        name = {"material": verdict.material.label} if len(verdicts) > 1 else {}
        listed.append(name | verdict.to_dict() | ({"ball": ball.to_dict()} if ball else {}))
    contents: Any = listed if len(listed) > 1 else listed[0]
    print(json.dumps(contents, indent=1, ensure_ascii=False, allow_nan=False))


def make_page(
    options: argparse.Namespace,
    material_texts: dict[str, Any],
    surface_texts: dict[str, Any],
    surface: Any,
) -> Path:
    """Run the workflow in the folder for results, and return the path of the page."""
    if not (PROJECT / "Snakefile").is_file() or find_spec("snakemake") is None:
        fail(
            "no page, for this is the library without the workflow: give --no-page, or run make "
            "install in the folder of the project and this command with its .venv/bin/python"
        )
    name = re.sub("[^A-Za-z0-9-]+", "_", options.file.stem).strip("_-") or "surface"
    # The page shows the path, and should not tell of the machine.
    file = os.path.relpath(options.file.resolve(), options.output.resolve())
    surface_texts = surface_texts | {"file": file}
    target = f"results/draft/report/surfaces/{name}.html"
    command = [
        *(sys.executable, "-m", "snakemake", "--snakefile", f"{PROJECT}/Snakefile"),
        *("--cores=1", "--nolock", "--quiet", "host", "progress", "rules", "reason"),
        *("--", target),  # one job after another
    ]
    with hold_folder(options.output) as descriptor:
        fill_folder(options, name, material_texts, surface_texts, surface)
        try:
            run = subprocess.run(
                command,
                cwd=options.output,
                env=os.environ | find_cache(options.output),
                pass_fds=[descriptor],  # the folder is held as long as the workflow runs
                capture_output=True,
                encoding="utf-8",
            )
        except KeyboardInterrupt:
            fail("stopped; the same command goes on")
    if run.returncode:
        fail(f"no page: {find_reason(run.stdout + run.stderr, options.output)}")
    return options.output / target


@contextmanager
def hold_folder(folder: Path) -> Iterator[int]:
    """Keep other runs of the command out of a folder, also after this one was killed.

    The lock of Snakemake would remain of a run that was killed, and does not cover the
    configuration. Yields the descriptor of the folder.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        descriptor = os.open(folder, os.O_RDONLY)
    except OSError as error:
        fail(f"--output {folder} cannot be written ({error.strerror}); give another folder")
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        yield descriptor
    except BlockingIOError:
        fail(
            f"no page: another run of this command holds --output {folder}: wait until it ends, "
            "or give another folder"
        )
    finally:
        os.close(descriptor)


def find_cache(folder: Path) -> dict[str, str]:
    """Return where Snakemake keeps sources, if it cannot in the user's cache."""
    cache = Path(os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache"))
    try:
        cache.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=cache).close()
    except OSError:
        return {"XDG_CACHE_HOME": str(folder.absolute() / ".snakemake/cache")}
    return {}


def find_reason(output: str, folder: Path) -> str:
    """Return why the workflow failed, in one line."""
    if os.strerror(errno.ENOSPC) in output:
        return f"the disk of --output {folder} is full: make room and run the same command again"
    lines = [line.strip() for line in output.splitlines() if line.strip()]
    # The workflow repeats the errors of its jobs at its end, and every line is indented by a word.
    failed = [line.removeprefix("failed").strip() for line in lines if line.startswith("failed  ")]
    return (failed or lines or ["the workflow failed"])[-1]


def check_output(folder: Path) -> None:
    """End the command if the folder for the page holds something else or cannot be written."""
    config = folder / "config/config.yaml"
    is_ours = config.is_file() and config.read_text(encoding="utf-8").startswith(MARK)
    if folder.is_file() or (not is_ours and folder.is_dir() and any(folder.iterdir())):
        fail(f"--output {folder} holds something else; give a new folder")
    existing = next(path for path in (folder, *folder.absolute().parents) if path.is_dir())
    if not os.access(existing, os.W_OK):
        fail(f"--output {folder} cannot be written; give another folder")


def fill_folder(
    options: argparse.Namespace,
    name: str,
    material_texts: dict[str, Any],
    surface_texts: dict[str, Any],
    surface: Any,
) -> None:
    """Write what the workflow starts from; end the command where that cannot be written."""
    try:
        write_configuration(options, name, material_texts, surface_texts)
        keep_analysis(options, name, surface_texts, surface)
    except OSError as error:
        fail(f"no page: --output {options.output}: {error}")


def write_configuration(
    options: argparse.Namespace,
    name: str,
    material_texts: dict[str, Any],
    surface_texts: dict[str, Any],
) -> None:
    """Write the files of the configuration."""
    tape = str(options.tape.absolute()) if options.tape else "config/materials.yaml"
    files = {
        "config": {"fidelity": "draft", "materials": tape, "surfaces": "config/surfaces.yaml"},
        "materials": {"materials": {"material": material_texts}},
        "surfaces": {"surfaces": {name: surface_texts}},
    }
    from stickiness.datasets import whole_file

    for table, content in files.items():  # YAML includes JSON
        text = MARK + json.dumps(content, ensure_ascii=False, indent=2)
        with whole_file(options.output / f"config/{table}.yaml") as file:
            file.write_text(text, encoding="utf-8")


def keep_analysis(
    options: argparse.Namespace, name: str, surface_texts: dict[str, Any], surface: Any
) -> None:
    """Write the surface as it was judged where the workflow expects it.

    So the workflow does not analyse it again. An equal file stays, so that nothing is repeated.
    """
    from stickiness import datasets
    from stickiness.entries import check_surface, without_texts
    from stickiness.verdicts.rough_surface import Surface, describe_file

    # The page names the file as the configuration does, in remarks and doubts, too.
    given = re.compile(rf"(?<!\S){re.escape(str(options.file))}(?=[:;]| \||$)", re.MULTILINE)
    texts = {
        key: given.sub(lambda _: surface_texts["file"], text)
        for key, text in surface.data.attrs.items()
    }
    named = Surface(surface.data.assign_attrs(texts))
    entry = without_texts(check_surface(surface_texts, numbers=False))
    contents = describe_file(name, entry)
    path = options.output / f"results/draft/real_surfaces/{name}.nc"
    if not datasets.holds(path, named.data, contents["parameters"]):
        named.write(path, **contents)


if __name__ == "__main__":
    main()
