"""The app as a real browser shows it, with the server of the command."""

import asyncio
import base64
import json
import os
import re
import signal
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest
import scipy.io
import xarray as xr
from helpers.browser import CHROMIUM, open_tab

from stickiness import example_wall, surface
from stickiness.spectrum import SelfAffine

pytestmark = [
    pytest.mark.workflow,
    pytest.mark.skipif(CHROMIUM is None, reason="no chromium on the path (apt install chromium)"),
]
SCRIPTS = Path(example_wall.__file__).parents[1]
ENVIRONMENT = os.environ | {"PYTHONPATH": str(SCRIPTS), "BROWSER": "true"}
WIDTHS = "[innerWidth, document.documentElement.scrollWidth]"
IS_ANSWERED = "!isAsking && (document.querySelector('#answer main, #answer [role=alert]'))"
ANSWER = f"{IS_ANSWERED} && answer.innerText.replaceAll('\\u00a0', ' ')"
DROP = """
((name, content) => {
  const bytes = Uint8Array.from(atob(content), (letter) => letter.charCodeAt(0));
  const dataTransfer = new DataTransfer();
  dataTransfer.items.add(new File([bytes], name));
  document.dispatchEvent(new DragEvent("drop", { dataTransfer, cancelable: true }));
})(%s, %s)
"""


@contextmanager
def started(folder):
    """The server of the app, and the address of its page."""
    environment = ENVIRONMENT | {"TMPDIR": str(folder)}
    command = [sys.executable, "-m", "stickiness", "--app"]
    streams = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    server = subprocess.Popen(command, **streams, text=True, env=environment, cwd=folder)
    try:
        yield server, re.search(r"http\S+", server.stdout.readline())[0]
    finally:
        server.kill()
        server.communicate()


def write_formats(folder):
    """One map in five formats, and the options that each needs."""
    wall = SelfAffine(hurst=0.8, q0=2e3 * np.pi, q1=64e3 * np.pi, q_rolloff=8e3 * np.pi, h_rms=2e-5)
    # Rounded as the formats of text are: no format holds finer waves than another.
    heights = np.round(surface.synthesise(wall, 64, 1e-3, seed=1) * 1e6, 4) * 1e-6
    x = (np.arange(64) + 0.5) / 64 * 1e-3
    size = {"length": "1 mm", "height_unit": "m"}
    np.savetxt(folder / "wall.txt", heights.T * 1e6, fmt="%.4f")
    np.save(folder / "wall.npy", heights.T)
    scipy.io.savemat(folder / "wall.mat", {"z": heights.T})
    points = np.stack([*np.meshgrid(x, x, indexing="ij"), heights], axis=-1).reshape(-1, 3)
    np.savetxt(folder / "wall.csv", points * 1e6, delimiter=",", fmt="%.4f", header="x,y,z")
    named = xr.DataArray(heights, {"x": x, "y": x}, ("x", "y"), "heights", {"units": "m"})
    for axis in ("x", "y"):
        named[axis].attrs["units"] = "m"
    named.to_netcdf(folder / "wall.nc")
    micrometres = {"height_unit": "um", "position_unit": "um"}
    return {
        "wall.txt": {"length": "1 mm", "height_unit": "um"},
        "wall.npy": size,
        "wall.mat": size,
        "wall.csv": micrometres,
        "wall.nc": {},
    }


def ask_command(line, folder):
    words = [sys.executable, *line.split(" ", 1)[1:], "--no-page"]
    shell = " ".join(words)
    told = subprocess.run(
        shell, shell=True, cwd=folder, env=ENVIRONMENT, capture_output=True, text=True
    )
    assert told.returncode == 0, told.stderr
    return told.stdout.replace("\xa0", " ")


async def drop(tab, file):
    content = base64.b64encode(file.read_bytes()).decode()
    await tab.run(DROP % (json.dumps(file.name), json.dumps(content)))


async def type_texts(tab, texts, kind="material"):
    for key, text in texts.items():
        field = f"form.querySelector('[data-group={kind}][name={key}]')"
        await tab.run(f"{field}.value = {json.dumps(text)}")
        await tab.run(f"{field}.dispatchEvent(new Event('change', {{ bubbles: true }}))")


async def press(tab, key, code):
    for kind in ("keyDown", "keyUp"):
        known = {"key": key, "code": key, "windowsVirtualKeyCode": code}
        await tab.call("Input.dispatchKeyEvent", type=kind, **known)


def test_app_in_a_browser(tmp_path):
    asyncio.run(asyncio.wait_for(use(tmp_path), 500))


async def use(folder):
    place = folder / "temporary"
    place.mkdir()
    formats = write_formats(folder)
    with started(place) as (server, address):
        async with (
            open_tab(folder / "profile", address) as tab,
            open_tab(folder / "other", address) as other,
        ):
            for width in (1280, 390):
                await tab.resize(width, 900)
                await tab.wait_for(ANSWER, 200)
                assert await tab.run(WIDTHS) == [width, width]
            first, _ = await other.wait_for(ANSWER, 200)
            await move_every_slider(tab)
            assert await other.run(ANSWER) == first  # the other tab has its own answer

            shares = set()
            await type_texts(tab, {"youngs_modulus": "40 kPa", "thickness": "", "pressed": ""})
            for name, options in formats.items():
                # What was told of another file is asked anew.
                await drop(tab, folder / name)
                await type_texts(tab, options, "measured")
                answer, _ = await tab.wait_for(
                    f"(({ANSWER}) || '').includes({json.dumps(name)}) && {ANSWER}"
                )
                told = ask_command(await tab.run("line.textContent"), folder)
                share = re.search(r": (.*work of adhesion remains)", told)[1]
                assert share in answer
                shares.add(share)
            assert len(shares) == 1

            wrong = folder / "wrong.txt"
            wrong.write_text("no heights", encoding="utf-8")
            await drop(tab, wrong)
            await tab.wait_for(f"(({ANSWER}) || '').includes('wrong.txt')")
            assert tab.logged == []

            # A page of another origin learns nothing, though it knows the address.
            await other.call("Page.navigate", url="data:text/html,other")
            request = f"fetch('{address}answer', {{ method: 'POST', body: '{{}}' }})"
            read = ".then((told) => told.text()).catch(() => 'refused')"
            assert await other.run(request + read) == "refused"

            assert list(place.glob("stickiness-*"))
            server.send_signal(signal.SIGINT)
            output, errors = server.communicate(timeout=60)
            assert output == "The app has ended.\n"
            assert errors == ""
            assert not list(place.glob("stickiness-*"))
            await type_texts(tab, {"youngs_modulus": "50 kPa"})
            await tab.wait_for(f"(({ANSWER}) || '').includes('The app has ended')")


async def move_every_slider(tab):
    """Move each slider by its key, on a described surface, and see the answer change."""
    await tab.run("form.kind.value = 'self_affine'")
    await type_texts(tab, {"h_rms": "1 um"}, "self_affine")
    shown = "[...form.querySelectorAll('.slider')].filter((e) => e.offsetParent)"
    names = await tab.run(f"{shown}.map((e) => e.ariaLabel)")
    assert len(names) == 5
    for number, name in enumerate(names):
        await tab.run("form.kind.dispatchEvent(new Event('change', { bubbles: true }))")
        await tab.wait_for(ANSWER)
        before = await tab.run("[question(), word.textContent]")
        await tab.run(f"{shown}[{number}].focus()")
        for _ in range(3):
            await press(tab, "ArrowRight", 39)
        changed = f"!isAsking && question() != {json.dumps(before[0])} && word.textContent"
        after, seconds = await tab.wait_for(changed)
        assert seconds < 20  # a second on a machine that does nothing else
        assert name.endswith(", slider")
        assert await tab.run(f"{shown}[{number}].getAttribute('aria-valuetext')") != "not given"
        assert "remains" in after
