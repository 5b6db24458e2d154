"""The app, without a browser: its form, its server, and its answers beside the command's."""

import asyncio
import json
import re
import shlex
import sys
import zipfile
from html import unescape
from io import BytesIO

import numpy as np
import pytest
from tornado.httpclient import AsyncHTTPClient, HTTPRequest

from stickiness import __main__, command, entries, surface
from stickiness.app import form, server
from stickiness.app.question import OWN, Question
from stickiness.spectrum import SelfAffine

pytestmark = pytest.mark.usefixtures("coarse_simulation")
TAPE = {"youngs_modulus": "0.5 MPa", "work_of_adhesion": "60 mJ/m^2", "range": "0.3 nm"}
SIZE = {"length": "1 mm", "height_unit": "um"}


@pytest.fixture(scope="module")
def heights():
    """A text of heights in um, which tells neither its size nor its unit."""
    wall = SelfAffine(hurst=0.8, q0=2 * np.pi, q1=2 * np.pi * 32, q_rolloff=8 * np.pi, h_rms=0.02)
    text = BytesIO()
    np.savetxt(text, 1e3 * surface.synthesise(wall, 64, 1.0, seed=1), fmt="%.4f")
    return text.getvalue()


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    """The server works in its temporary folder."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


def ask(*requests):
    """Codes and bodies of what a server answers to paths behind its token, with their options."""

    async def talk():
        made, address = server.listen()
        fetch = AsyncHTTPClient().fetch
        try:
            answers = []
            for path, options in requests:
                here = address.rsplit("/", 2)[0]
                url = path.replace("HERE", here) if "HERE" in path else address + path
                request = HTTPRequest(url, request_timeout=300, **options)
                told = await fetch(request, raise_error=False)
                answers.append((told.code, told.body))
            return answers
        finally:
            made.stop()
            await made.close_all_connections()

    return asyncio.run(talk())


def post(what, content):
    """What the server answers to a question or a file."""
    body = content if isinstance(content, bytes) else json.dumps(content)
    ((code, told),) = ask((what, {"method": "POST", "body": body}))
    assert code == 200
    return told if what in ("page", "configuration") else json.loads(told)


def make_question(kind="measured", file="", material=TAPE, kept=(), common=OWN, **values):
    material = {"common": common, **material}
    return {"kind": kind, "file": file, "surface": values, "material": material, "kept": [*kept]}


def ask_command(line, monkeypatch, capsys):
    """What the command prints."""
    words = [*shlex.split(line)[3:], "--no-page"]
    monkeypatch.setattr(sys, "argv", ["stickiness", *words])
    capsys.readouterr()
    command.answer()
    return capsys.readouterr().out


def show(text):
    """Text of a page as readers see it."""
    return unescape(re.sub("<[^>]*>", "", text)).replace("\xa0", " ")


@pytest.mark.parametrize(
    ("common", "material", "values"),
    [
        (OWN, TAPE, {}),
        (OWN, TAPE | {"thickness": "20 um", "poisson_ratio": "0.49"}, {}),
        (OWN, TAPE | {"pressed": "100 kPa"}, {"contact": "3 mm", "height_factor": "0.5"}),
        ("psa", {"work_of_adhesion": "50 mJ/m^2"}, {"height_factor": "1"}),
    ],
)
def test_answers_are_those_of_the_command(heights, common, material, values, monkeypatch, capsys):
    file = post("file?name=wall.txt", heights)["file"]
    question = make_question(file=file, material=material, common=common, **SIZE, **values)
    answer = post("answer", question)
    monkeypatch.chdir(file.partition("/")[0])
    told = ask_command(answer["command"], monkeypatch, capsys).replace("\xa0", " ")
    page = show(answer["page"])
    share = re.search(r": (.*work of adhesion remains)", told)[1]
    threshold = re.search(r"^sticks .*$", told, re.MULTILINE)[0]
    pull_off = re.search(r"^pull-off stress: (.*)$", told, re.MULTILINE)[1]
    for said in (share, threshold, pull_off):
        assert said in page
    assert ("--height-factor 0.5" in answer["command"]) == ("0.5" in values.values())


def test_height_factor_is_that_of_higher_heights(heights, monkeypatch, capsys):
    higher = post(
        "file?name=higher.txt",
        b"\n".join(
            b" ".join(b"%.6f" % (1.5 * float(word)) for word in line.split())
            for line in heights.splitlines()
        ),
    )["file"]
    file = post("file?name=wall.txt", heights)["file"]
    pages = [
        show(post("answer", make_question(file=name, **SIZE, **factor))["page"])
        for name, factor in ((file, {"height_factor": "1.5"}), (higher, {}))
    ]
    answers = [re.search(r"(This material|For this material) .*", page)[0] for page in pages]
    assert answers[0] == answers[1]


@pytest.mark.parametrize("kind", ["self_affine", "surface_texture", "example"])
def test_every_kind_is_answered_as_it_stands(kind):
    _, fields, more = form.make_form()["surfaces"][kind]
    at_first = {field.key: field.text for field in (*fields, *more)}
    answer = post("answer", make_question(kind, **at_first))
    assert re.search(r"material (sticks|does not|adheres|it depends)", show(answer["page"]))
    assert answer["command"].startswith("python -m stickiness example_wall.txt") == (
        kind == "example"
    )


def test_materials_side_by_side():
    kept = [{"common": "psa"}, {"common": OWN, **TAPE, "youngs_modulus": "1 GPa"}]
    page = post("answer", make_question("self_affine", kept=kept, hurst="0.8", h_rms="1 um",
        longest_wavelength="0.2 mm", shortest_wavelength="1 nm"))["page"]  # fmt: skip
    rows = re.findall(r'<th scope="row">(.*?)<br>', page)[:3]
    labels = ["this material", entries.list_common_materials()["psa"]["label"], "kept material 1"]
    assert list(map(show, rows)) == labels


@pytest.mark.parametrize(
    ("values", "title", "option"),
    [
        ({"youngs_modulus": "3"}, "Young's modulus", "--modulus"),
        ({"work_of_adhesion": "60 J/m^2"}, "Work of adhesion", "--work"),
        ({"poisson_ratio": "0.7"}, "Poisson's ratio", "--poisson"),
        ({"length": ""}, "Length", "--length"),
        ({"height_unit": "kg"}, "Height unit", "--height-unit"),
    ],
)
def test_errors_are_those_of_the_command(heights, values, title, option, monkeypatch, capsys):
    file = post("file?name=wall.txt", heights)["file"]
    material = TAPE | {key: text for key, text in values.items() if key in form.MATERIAL}
    given = SIZE | {key: text for key, text in values.items() if key not in form.MATERIAL}
    question = make_question(file=file, material=material, **given)
    (error,) = post("answer", question).values()
    line = Question.read(question).tell_command()
    monkeypatch.chdir(file.partition("/")[0])
    with pytest.raises(SystemExit) as ended:
        ask_command(line, monkeypatch, capsys)
    told = str(ended.value).removeprefix("stickiness: ")
    assert option in told
    assert title in error
    for key, name in form.list_titles().items():
        told = told.replace(command.OPTIONS.get(key, key), name) if key in values else told
    assert error.split()[:3] == told.split()[:3]


def test_files_stay_in_folders_of_their_own(folder):
    outside = folder.parent / "outside.txt"
    outside.write_text("1 2", encoding="utf-8")
    sent = [
        post(f"file?name={name}", b"1 2")["file"]
        for name in ("..", ".", "%2F", "", "a%00b", 300 * "n")
    ]
    sent.append(post("file?name=..%2F..%5Cevil%2Fpicture.txt", b"\x89PNG no heights")["file"])
    for file in sent:
        path = (folder / file).resolve()
        assert path.is_file()
        assert path.parent.parent == folder.resolve()
    assert "picture.txt" in post("answer", make_question(file=sent[-1], **SIZE))["error"]
    assert "file-" not in post("answer", make_question(file=sent[-1], **SIZE))["error"]
    for file in ("", "../outside.txt", str(outside), f"{sent[0]}/../../../outside.txt"):
        told = post("answer", make_question(file=file, **SIZE))
        assert told == {"error": "choose a file of heights"}


def test_files_to_keep(heights, folder):
    file = post("file?name=wall.txt", heights)["file"]
    question = make_question(file=file, kept=[{"common": "psa"}], **SIZE)
    kept = folder / "kept"
    with zipfile.ZipFile(BytesIO(post("configuration", question))) as archive:
        archive.extractall(kept)
    assert (kept / "wall.txt").read_bytes() == heights
    materials = entries.read_materials(kept / "materials.yaml")
    expected = map(entries.check_material, Question.read(question).materials)
    for material, entry in zip(materials.values(), expected, strict=True):
        assert entries.without_texts(material) == entries.without_texts(entry)
    with zipfile.ZipFile(BytesIO(post("page", question))) as archive:
        page = archive.read("wall.html").decode()
        assert {"wall/surface.nc", "wall/verdicts.nc"} < {*archive.namelist()}
    assert "acrylic pressure-sensitive adhesive" in page.lower()
    left = {path.name for path in folder.iterdir()} - {"kept"}
    assert left == {file.partition("/")[0]}  # nothing else stays
    wrong = question | {"material": question["material"] | {"youngs_modulus": "abc"}}
    for what in ("page", "configuration"):
        ((code, told),) = ask((what, {"method": "POST", "body": json.dumps(wrong)}))
        assert (code, "Young's modulus 'abc'" in json.loads(told)["error"]) == (200, True)


@pytest.mark.parametrize(
    ("path", "options", "code"),
    [
        ("", {}, 200),
        ("answer", {}, 403),
        ("unknown", {"method": "POST", "body": ""}, 403),
        ("x/../../etc/passwd", {}, 403),
        ("HERE/", {}, 403),
        ("HERE/wrong/", {}, 403),
        ("", {"headers": {"Host": "evil.example"}}, 403),
        ("", {"headers": {"Origin": "http://evil.example"}}, 403),
        ("answer", {"method": "POST", "body": "{}", "headers": {"Origin": "null"}}, 403),
    ],
)
def test_only_the_page_of_the_app_is_served(path, options, code):
    ((found, body),) = ask((path, options))
    assert found == code
    assert (b"<form" in body) == (code == 200)


def test_too_large_a_file_is_not_taken(folder, monkeypatch):
    monkeypatch.setattr(server, "MOST_BYTES", 1000)
    ((code, _),) = ask(("file?name=large.txt", {"method": "POST", "body": b"1 " * 2000}))
    assert code != 200
    assert not list(folder.iterdir())


def test_token_is_new_at_every_start():
    async def listen_twice():
        for _ in range(2):
            made, address = server.listen()
            made.stop()
            yield address.split("/")[-2]

    async def collect():
        return [token async for token in listen_twice()]

    first, second = asyncio.run(collect())
    assert first != second
    assert len(first) > 20


def test_command_takes_nothing_beside_the_app(monkeypatch):
    monkeypatch.setattr(sys, "argv", ["stickiness", "wall.txt", "--app"])
    with pytest.raises(SystemExit, match="--app takes no file"):
        __main__.main()


def test_fields_are_those_of_the_schema():
    texts = entries.describe_keys("material")
    units = {"youngs_modulus": "Pa", "work_of_adhesion": "J/m^2", "range": "m", "thickness": "m"}
    described = form.make_form()
    keys = {field.key for field in (*described["material"], *described["more_fields"])}
    assert keys == {"label", *command.TEXTS["material"]} - {"common"}
    _, fields, more = described["surfaces"]["measured"]
    assert {field.key for field in (*fields, *more)} == {*command.TEXTS["surface"]} - {"label"}
    for field in described["material"]:
        assert field.description == texts[field.key]
        assert field.unit == units.get(field.key, field.unit)
        assert field.ends is None or field.ends[0] < field.ends[1]
