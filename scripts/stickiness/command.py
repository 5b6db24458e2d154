"""Say whether a material sticks to a measured surface, and make a page with the reasons."""

import argparse
import gc
import json
import logging
import os
import platform
import re
import shlex
import sys
import tomllib
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from difflib import get_close_matches
from functools import partial
from importlib.metadata import version
from itertools import count
from pathlib import Path
from typing import Any, NoReturn, TextIO

from stickiness import __version__
from stickiness.formatting import printable, relative_path

SURFACE = "surface"  #: name of the one that is judged, in files
TEXTS = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
#: Names that Windows keeps for devices.
DEVICES = re.compile(r"con|prn|aux|nul|(com|lpt)[0-9¹²³]", re.IGNORECASE)
#: Options by the keys of the configuration, for which they stand.
OPTIONS = {key: option for group in ("material", "surface") for key, option in TEXTS[group].items()}


def run(task: Callable[[], None]) -> None:
    """Do what the command line asks; end with one line if the answer cannot be written."""
    # Before numpy is loaded: on such grids the threads of linear algebra wait more than they work.
    for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
        os.environ.setdefault(name, "1")
    # Files are written whole under names of their own; locks only fail where there are none.
    os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")
    sys.stdout.reconfigure(errors="backslashreplace")  # type: ignore[union-attr]
    try:
        task()
        sys.stdout.flush()
    except OSError as error:
        # What is left in the buffer would fail once more at the end.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        if not isinstance(error, BrokenPipeError):  # whoever reads the output has read enough
            fail(str(error))
    except MemoryError as error:
        fail(f"not enough memory ({error}): take a part of the heights, or every second point")


def say(text: str, file: TextIO | None = None) -> None:
    """Print a text for readers."""
    print(printable(text), file=file)


def answer() -> None:
    """Analyse the heights, judge the materials on them, print the verdicts, and make the page."""
    # Arrays are freed without the collector of cycles, which takes 7 % of a run, and more of the
    # first one, which compiles loops. Peak memory on 2048² heights is the same.
    gc.disable()
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
        say(f"Example: python -m stickiness {shlex.join(arguments)}", file=progress)
    for path in filter(None, [options.file, options.tape]):
        if not path.is_file():
            kind = "a folder" if path.is_dir() else "no file of data"
            fail(f"{path}: {kind}; give a file" if path.exists() else f"{path}: no such file")
    if not options.no_page:
        check_output(options.output)
    elif "--output" in {word.partition("=")[0] for word in arguments}:
        fail("--output names the folder of the page: leave out --no-page, or --output")
    materials = read_materials(options)
    radius = None if options.radius is None else read_radius(options.radius, materials)
    surface, entry = analyse(options)
    verdicts = judge(materials, surface, with_page=not options.no_page)
    balls = find_balls(surface, materials, radius)
    print_verdicts(verdicts, balls, as_json=options.json)
    if not options.json:
        for steps in surface.steps:
            say(f"Done to the heights of {steps}")
        for choice in surface.choices:
            source, others = choice.split(" | ")
            say(f"This is {source}; the file also holds {others} (--channel, --variable)")
    if not options.no_page:
        page = make_page(options, surface, entry, materials, verdicts)
        say(f"Page: {page}", file=progress)


def print_materials() -> None:
    """Print the common materials, a line each."""
    from stickiness.entries import list_common_materials

    for name, entry in list_common_materials().items():
        say(
            f"{name:<24} E = {entry['youngs_modulus']}, nu = {entry['poisson_ratio']:g}, "
            f"work = {entry['work_of_adhesion']}, range = {entry['range']}; "
            + ". ".join(filter(None, (entry["source"], entry["note"])))
        )


def fail(text: str) -> NoReturn:
    """End the command with one line."""
    sys.exit(printable(f"stickiness: {text}"))


def spell_out_example(arguments: list[str]) -> list[str]:
    """Replace `--example` by what it stands for; a material that is given stays."""
    others = [word for word in arguments if word != "--example"]
    names = {word.partition("=")[0] for word in others}
    example = TEXTS["example"]
    is_given = names & {"--material", "--tape", "--modulus", "--shear-modulus"}
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
    from stickiness.entries import describe_keys

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
    parser.add_argument("--app", action="store_true", help="open a page with sliders")
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
        help="for the page and its data (default: stickiness-results)",
    )
    for title in ("material", "surface"):
        group = parser.add_argument_group(title)
        texts = describe_keys(title)
        for key, option in TEXTS[title].items():
            kind = str if key == "label" else read_value
            text = texts[key].replace("%", "%%")
            if key in TEXTS["defaults"]:
                text = f"{text} (default: {TEXTS['defaults'][key]})"
            value: dict[str, Any] = {"type": kind, "metavar": "VALUE"}
            if key in TEXTS["flags"][title]:
                value = {"action": "store_const", "const": True}
            group.add_argument(option, dest=key, help=text, **value)
    options, unknown = parser.parse_known_args(join_negative(arguments))
    if unknown:
        fail(tell_unknown(unknown, re.findall(r"--[a-z-]+", parser.format_help())))
    used = [OPTIONS[key] for key in choose_given(options, "material")]
    if options.tape and used:
        fail(f"--tape describes the material: leave out {', '.join(used)}")
    has_modulus = not {"--modulus", "--shear-modulus"}.isdisjoint(used)
    if not (options.tape or options.common) and not (has_modulus and "--work" in used):
        fail('give --modulus "0.2 MPa" and --work "60 mJ/m^2", --material or --tape; see --help')
    return options


def tell_unknown(words: list[str], options: list[str]) -> str:
    """Return what is not known of the command line, and the option that may be meant."""
    close = [
        match
        for word in words
        if word.startswith("--")
        for match in get_close_matches(word.partition("=")[0], options, n=1)
    ]
    hint = f"; did you mean {close[0]}?" if close else ""
    return f"unrecognized arguments: {' '.join(words)}{hint}"


def join_negative(arguments: list[str]) -> list[str]:
    """Join options to negative numbers behind them, which else look like options themselves."""
    joined: list[str] = []
    for word in arguments:
        if re.match(r"-\.?\d", word) and joined and re.fullmatch(r"--[a-z-]+", joined[-1]):
            word = f"{joined.pop()}={word}"
        joined.append(word)
    return joined


def describe_version() -> str:
    """What a report of a bug should tell: versions, and the system."""
    codes = ", ".join(f"{name} {version(name)}" for name in ("numpy", "scipy", "numba"))
    system = f"{platform.system()} {platform.machine()}"
    return f"stickiness {__version__} (Python {platform.python_version()}, {codes}; {system})"


def read_radius(text: str, materials: dict[str, Any]) -> float:
    """Return the radius of `--radius` in m, of a ball on these materials."""
    from stickiness.units import Quantity
    from stickiness.verdicts.rough_ball import check_ball

    try:
        radius = float(Quantity.read(text, "m"))
    except ValueError as error:
        fail(f"--radius {error}")
    if not radius > 0:
        fail(f"--radius {text!r}: must be positive")
    for name, material in materials.items():
        try:
            check_ball(material, radius)
        except ValueError as error:
            fail(f"--{error}" if len(materials) == 1 else f"{name}: --{error}")
    return radius


def read_value(text: str) -> Any:
    """Return a number, or what else JSON has, or the text."""
    try:
        return json.loads(text)
    except ValueError:
        if re.fullmatch(r"[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?", text, re.IGNORECASE):
            return float(text)  # .5, which is no JSON
        return text


def choose_given(options: argparse.Namespace, group: str) -> dict[str, Any]:
    """Return the values of the options of a group that are given, by key."""
    values = vars(options)
    return {key: values[key] for key in TEXTS[group] if values[key] is not None}


@contextmanager
def one_line() -> Iterator[None]:
    """End the command with one line, in the words of its options, where values are wrong."""
    try:
        yield
    except (ValueError, OSError) as error:
        fail(tell_error(error, OPTIONS))


def tell_error(error: BaseException, names: dict[str, str]) -> str:
    """Return what is wrong in one line, with names of keys as users know them."""
    from stickiness.entries import EntryError
    from stickiness.measured.topography import UntoldError

    if isinstance(error, EntryError):
        name = names.get(error.key.partition("[")[0])
        message = name_keys(error.message, names)
        return str(error) if name is None else f"{name} {error.value!r}: {message}"
    if isinstance(error, UntoldError):
        return error.tell(names)
    return name_keys(" ".join(str(error).split()), names)


def name_options(text: str) -> str:
    """Return advice on a surface with options in place of the keys that it names."""
    return name_keys(text, OPTIONS)


def name_keys(text: str, names: dict[str, str]) -> str:
    """Return advice on a surface with other names in place of the keys.

    Keys that are words, too, are told by what stands before them.
    """
    known = [key for key in TEXTS["surface"] if key in names]
    keys = "|".join(sorted(known, key=len, reverse=True))
    before = "(?<=give )|(?<=correct )|(?<=or )|(?<=by )|(?<=leave )|(?<=with )|(?<=set )"
    named = rf"(?:\b(?=\w+_)|{before})({keys})\b(?:: (\S+))?"
    return re.sub(named, lambda m: " ".join(filter(None, (names[m[1]], m[2]))), text)


def read_materials(options: argparse.Namespace) -> dict[str, Any]:
    """Return the materials of the options or of the tape, by name."""
    from stickiness import Material, entries

    defaults = TEXTS["defaults"] if options.common is None else {}
    with one_line():
        if options.tape:
            checked = entries.read_materials(options.tape)
        else:
            given = defaults | choose_given(options, "material")
            checked = {"material": entries.check_material(given)}
        return {name: Material.from_entry(entry) for name, entry in checked.items()}


def analyse(options: argparse.Namespace) -> tuple[Any, dict[str, Any]]:
    """Return the `Surface` of the file, and its entry as the configuration would have it."""
    from stickiness import Surface, entries

    # Texts name the file, and should not tell of the machine.
    file = relative_path(options.file, Path()) if options.file.is_absolute() else options.file
    described = {
        "label": name_page(options.file),
        "source": printable(options.file.name),
        "kind": "measured",
        "file": str(file),
    }
    with one_line():
        given = described | choose_given(options, "surface")
        entry = entries.check_surface(given)
        return Surface.from_entry(entry), entry


def judge(materials: dict[str, Any], surface: Any, with_page: bool) -> Any:
    """Return what `stickiness.judge` says of all materials; a page shows more of it."""
    import stickiness

    more = {"curves": with_page, "thresholds": with_page}
    return stickiness.judge(materials, {SURFACE: surface}, **more)


def find_balls(surface: Any, materials: dict[str, Any], radius: float | None) -> list:
    """Return the pull-off of a ball for every material; None without a radius."""
    from stickiness.verdicts.rough_ball import pull_off_of_ball

    if radius is None:
        return [None] * len(materials)
    return [pull_off_of_ball(surface, material, radius) for material in materials.values()]


def print_verdicts(verdicts: Any, balls: list, as_json: bool) -> None:
    """Print the verdict on every material, for readers or as JSON.

    Several are a list in JSON, with the names of their materials.
    """
    from stickiness.verdicts.verdict import StickinessVerdict

    listed = []
    for index, ball in enumerate(balls):
        cell = verdicts.isel(material=index, surface=0)
        verdict = StickinessVerdict(cell)
        label = cell.material_label.item()
        if not as_json:
            say(f"{label[0].upper()}{label[1:]}: {name_options(str(verdict))}")
            if ball:
                say(name_options(str(ball)))
        name = {"material": label} if len(balls) > 1 else {}
        listed.append(name | verdict.to_dict() | ({"ball": ball.to_dict()} if ball else {}))
    if as_json:
        contents: Any = listed if len(listed) > 1 else listed[0]
        is_unicode = sys.stdout.encoding.lower().startswith("utf")
        say(json.dumps(contents, indent=1, ensure_ascii=not is_unicode, allow_nan=False))


def make_page(
    options: argparse.Namespace,
    surface: Any,
    entry: dict[str, Any],
    materials: dict[str, Any],
    verdicts: Any,
    drawn: Any = None,
) -> Path:
    """Write page and data, and return the path of the page; `drawn` as of `draw_surface`."""
    logging.getLogger("matplotlib").setLevel(logging.ERROR)  # no word where it cannot keep fonts
    from stickiness import datasets
    from stickiness.entries import without_texts
    from stickiness.pages.contact_figure import Simulated
    from stickiness.pages.surface_page import write_surface_page
    from stickiness.verdicts.meeting import find_family, find_roughness

    source = relative_path(options.file.resolve(), options.output.resolve())
    place = {"file": source} if entry["kind"] == "measured" else {}
    parameters = without_texts(entry) | place
    contents = {"surface": surface.data, "verdicts": verdicts}
    met = {
        name: find_roughness(material, surface, find_family(material, surface))
        for name, material in materials.items()
    }
    simulated = {
        name: Simulated(rough.simulated, rough.lacking)
        for name, rough in met.items()
        if rough.simulated is not None
    }
    name = claim_name(options.output, name_page(options.file), source)
    try:
        files = {each: options.output / name / f"{each}.nc" for each in contents}
        for each, path in files.items():
            title = f"{each} of {name}"
            datasets.write(contents[each], path, title=title, parameters=parameters)
        page = options.output / f"{name}.html"
        write_surface_page(
            page,
            entry=entry,
            surface=surface.data,
            verdicts=verdicts,
            files=files,
            simulated=simulated,
            drawn=drawn,
        )
    except OSError as error:
        with suppress(OSError):
            (options.output / name).rmdir()  # where nothing could be written
        fail(f"no page: --output {options.output}: {error}")
    return page


def name_page(file: Path) -> str:
    """Return the name of a file without its ending, unless that is a number, as of scan.001.

    Windows keeps some names for devices: these get a line below.
    """
    name = printable(file.name if file.suffix[1:].isdigit() else file.stem)
    return f"{name}_" if DEVICES.fullmatch(name.split(".")[0].rstrip()) else name


def claim_name(folder: Path, stem: str, source: str) -> str:
    """Return the name of a page: that of the file, with a number if another file has it.

    `source` is the path of the file from the folder, which the data of a page record. The folder
    of a new name is made at once, so that no other run takes the same.
    """
    from stickiness import datasets

    for number in count(1):
        name = stem if number == 1 else f"{stem}-{number}"
        try:
            if not (folder / f"{name}.html").exists():
                with suppress(FileExistsError):
                    (folder / name).mkdir(parents=True)
                    return name
        except OSError as error:
            fail(f"--output {folder} cannot be written ({error.strerror}); give another folder")
        with suppress(datasets.DatasetError):
            data = datasets.read(folder / name / "surface.nc")
            if datasets.parameters(data).get("file") == source:
                return name
    raise AssertionError("numbers do not end")


def check_output(folder: Path) -> None:
    """End the command if the folder for the page cannot be written."""
    # Of a drive that Windows does not have, nothing exists.
    existing = next((path for path in (folder, *folder.parents) if path.exists()), folder)
    if not existing.is_dir():
        fail(f"--output {folder}: {existing} is no folder; give another")
    if not os.access(existing, os.W_OK):
        fail(f"--output {folder} cannot be written; give another folder")
