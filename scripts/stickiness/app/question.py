"""What the app is asked, and its answer: analyse, judge, and the files to keep."""

from __future__ import annotations

import json
import shlex
import shutil
from argparse import Namespace
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any, NamedTuple

from stickiness import Material, Surface, command
from stickiness.app.form import EXAMPLE, EXAMPLE_FILE, read_example
from stickiness.entries import check_material, check_surface, list_common_materials
from stickiness.pages.surface_page import draw_surface

SENT = "file-*/*"  #: where files of heights that were sent are kept
SOURCE = "typed into the app"  #: of values
HOW_TO_RUN = (
    "# In this folder: snakemake -s PROJECT/Snakefile -j2 surfaces --configfile config.yaml"
)
OWN = "own values"  #: in the list of common materials
MOST_KEPT = 4  #: surfaces, so that a return to one of them is not analysed again


class Question(NamedTuple):
    """A surface and materials, as entries of a configuration that are not checked."""

    surface: dict[str, Any]
    materials: list[dict[str, Any]]  #: the first is changed, the others are compared with it

    @classmethod
    def read(cls, form: Mapping[str, Any]) -> Question:
        """Read what the form sends; files of heights are in folders here.

        Raises
        ------
        ValueError
            If no file of heights was chosen.
        """
        kind = form["kind"]
        given = read_values(form["surface"])
        kept = [each for each in form["kept"] if each != form["material"]]
        labels = ["this material", *(f"kept material {n}" for n in range(len(kept), 0, -1))]
        materials = [
            read_material(each, label)
            for each, label in zip((form["material"], *kept), labels, strict=True)
        ]
        if kind not in (EXAMPLE, "measured"):
            texts = {"label": "the surface", "source": SOURCE}
            return cls({"kind": kind, **texts, **given}, materials)
        if given.get("height_factor") == 1:
            del given["height_factor"]
        if kind == EXAMPLE:
            file = Path(EXAMPLE_FILE)
            command.write_example(file)
            given = read_example("surface") | given
        else:
            # Only what was sent is known: no path leads to another file.
            file = Path(form.get("file", ""))
            if file not in Path().glob(SENT):
                raise ValueError("choose a file of heights")
        texts = {"label": command.name_page(file), "source": file.name}
        return cls({"kind": "measured", **texts, "file": str(file), **given}, materials)

    def answer(self, folder: Path) -> str:
        """Judge all materials, write the page and its data into a folder, and return the page."""
        # A mistyped material is told of before heights are analysed for seconds.
        checked = [check_material(entry) for entry in self.materials]
        entry = check_surface(self.surface)
        surface, drawn = analyse(json.dumps(self.surface))
        materials = {
            f"material_{number}": Material.from_entry(each)
            for number, each in enumerate(checked, 1)
        }
        verdicts = command.judge(materials, surface, with_page=True)
        options = Namespace(file=Path(entry.get("file", entry["kind"])), output=folder)
        page = command.make_page(options, surface, entry, materials, verdicts, drawn)
        return page.read_text(encoding="utf-8")

    def tell_command(self) -> str:
        """Return the line that asks the command the same; empty of a surface that is described."""
        if self.surface["kind"] != "measured":
            return ""
        name = Path(self.surface["file"]).name
        words = ["python", "-m", "stickiness", f"./{name}" if name.startswith("-") else name]
        given = {**self.surface, **self.materials[0]}
        for key in [key for key in given if key in command.OPTIONS and key != "label"]:
            sides = given[key] if isinstance(given[key], list) else [given[key]]
            words += [command.OPTIONS[key], " x ".join(map(str, sides))]
        return shlex.join(words)

    def configure(self, folder: Path) -> None:
        """Write a configuration of the workflow into a folder, with the file of heights."""
        import yaml

        for entry in self.materials:
            check_material(entry)
        check_surface(self.surface)
        surface = dict(self.surface)
        if "file" in surface:
            surface["file"] = Path(shutil.copy(surface["file"], folder)).name
        materials = {
            f"material_{number}": entry if "common" in entry else {"source": SOURCE} | entry
            for number, entry in enumerate(self.materials, 1)
        }
        contents: dict[str, dict[str, Any]] = {
            "config.yaml": {"materials": "materials.yaml", "surfaces": "surfaces.yaml"},
            "materials.yaml": {"materials": materials},
            "surfaces.yaml": {"surfaces": {command.SURFACE: surface}},
        }
        for name, content in contents.items():
            text = yaml.safe_dump(content, allow_unicode=True, sort_keys=False)
            if name == "config.yaml":
                text = f"{HOW_TO_RUN}\n{text}"
            (folder / name).write_text(text, encoding="utf-8")


@lru_cache(MOST_KEPT)
def analyse(entry: str) -> tuple[Surface, dict[str, Any]]:
    """Return the surface of an entry, as JSON, and its pictures."""
    surface = Surface.from_entry(check_surface(json.loads(entry)))
    return surface, draw_surface(surface.data)


def read_values(texts: Mapping[str, str]) -> dict[str, Any]:
    """Values that are given, by key, as the command reads them."""
    return {key: command.read_value(text.strip()) for key, text in texts.items() if text.strip()}


def read_material(form: Mapping[str, str], label: str) -> dict[str, Any]:
    """Entry of the material; of a common one its name and what was changed of it."""
    given = read_values({key: text for key, text in form.items() if key != "common"})
    if form["common"] == OWN:
        return {"label": label} | given
    common = list_common_materials()[form["common"]]
    changed = {key: each for key, each in given.items() if str(each) != str(common.get(key))}
    return {"common": form["common"]} | changed
