"""The local server of the app.

It listens on this computer alone. All addresses begin with a token, made anew at every start; what
does not know it is refused. Nothing is served but the form and answers. Files that are sent stay in
a temporary folder, where the server works, and which goes with it.
"""

from __future__ import annotations

import asyncio
import json
import logging
import re
import secrets
import shutil
import signal
import sys
import tempfile
import webbrowser
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import chdir, suppress
from pathlib import Path
from typing import Any

from tornado.httpserver import HTTPServer
from tornado.netutil import bind_sockets
from tornado.web import Application, HTTPError, RequestHandler

from stickiness import command
from stickiness.app.form import list_titles, make_form
from stickiness.app.question import OWN, Question
from stickiness.entries import list_common_materials
from stickiness.pages import rendering

HOST = "127.0.0.1"
MOST_BYTES = 50_000_000  #: of a file
LONGEST_NAME = 100  #: characters, of which the last are kept
#: Answers all questions of all tabs, one after the other: figures are drawn by one thread alone.
WORKER = ThreadPoolExecutor(1)
#: No other page may load or send anything; the answer is a part of the page.
POLICY = (
    "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)


class Handler(RequestHandler):
    """What the form asks: itself, to keep a file, and to answer."""

    def prepare(self) -> None:
        """Refuse what another page asks, or asks by another name of this computer."""
        here = self.application.settings["here"]
        origin = self.request.headers.get("Origin", f"http://{here}")
        if self.request.host != here or origin != f"http://{here}":
            raise HTTPError(403)
        self.set_header("Content-Security-Policy", POLICY)
        self.set_header("Referrer-Policy", "no-referrer")  # which would tell the token

    def get(self, what: str) -> None:
        """Send the form."""
        if what:
            raise HTTPError(403)
        template = rendering.make_environment(rendering.TEMPLATES).get_template("app.html.j2")
        common = list_common_materials()
        self.write(template.render(make_form(), common=common, own=OWN, most=MOST_BYTES))

    async def post(self, what: str) -> None:
        """Send what a task returns, or what is wrong in one line."""
        tasks: dict[str, Callable[[], Any]] = {
            "file": self.keep_file,
            "answer": self.answer,
            "page": self.save,
            "configuration": self.save,
        }
        if what not in tasks:
            raise HTTPError(403)
        try:
            answer = await asyncio.get_running_loop().run_in_executor(WORKER, tasks[what])
        except MemoryError:
            text = "not enough memory: take a part of the heights, or every second point"
            answer = {"error": text}
        except (ValueError, OSError, SystemExit) as error:  # the last ends the command
            answer = {"error": hide_folders(command.tell_error(error, list_titles()))}
        self.write(answer)

    def keep_file(self) -> dict[str, str]:
        """Keep a file that was sent, in a folder of its own; return its name there."""
        # Nothing that a system takes for more than a name.
        given = re.split(r"[/\\]", self.get_query_argument("name"))[-1]
        name = re.sub(r"[^\w.+() -]", "_", given).lstrip(".")[-LONGEST_NAME:] or "heights"
        file = Path(f"file-{secrets.token_hex(8)}", name)
        file.parent.mkdir()
        file.write_bytes(self.request.body)
        return {"file": str(file)}

    def answer(self) -> dict[str, str]:
        """Return the page, and the line that asks the command the same."""
        question = Question.read(json.loads(self.request.body))
        with tempfile.TemporaryDirectory(dir=".") as place:
            page = hide_folders(question.answer(Path(place)))
            return {"page": page, "command": question.tell_command()}

    def save(self) -> bytes:
        """Return an archive with the page and its data, or with a configuration."""
        question = Question.read(json.loads(self.request.body))
        with tempfile.TemporaryDirectory(dir=".") as place:
            folder = Path(place, "kept")
            folder.mkdir()
            if self.path_args[0] == "page":
                question.answer(folder)
            else:
                question.configure(folder)
            return Path(shutil.make_archive(f"{place}/archive", "zip", folder)).read_bytes()


def hide_folders(text: str) -> str:
    """Leave out the folders of files that were sent, which readers know by their names alone."""
    return re.sub(r"\bfile-[0-9a-f]{16}[/\\]", "", text)


class Refused(RequestHandler):
    """Refuses all that does not begin with the token."""

    def prepare(self) -> None:
        """Answer 403."""
        raise HTTPError(403)


def listen() -> tuple[HTTPServer, str]:
    """Listen at a free port with a new token; return the server and the address of the form."""
    token = secrets.token_urlsafe(16)
    (socket,) = bind_sockets(0, HOST)
    here = f"{HOST}:{socket.getsockname()[1]}"
    application = Application(
        [(rf"/{token}/(\w*)", Handler)],
        default_handler_class=Refused,
        here=here,
    )
    server = HTTPServer(application, max_buffer_size=2 * MOST_BYTES)
    server.add_socket(socket)
    return server, f"http://{here}/{token}/"


def serve() -> None:
    """Open the form of the app in the browser, and serve it until Ctrl-C."""
    logging.getLogger("tornado.access").setLevel(logging.ERROR)  # what is refused needs no line
    # Also where a script has started the app, in which Ctrl-C is ignored.
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.default_int_handler)
    with (
        suppress(KeyboardInterrupt),
        tempfile.TemporaryDirectory(prefix="stickiness-") as folder,
        chdir(folder),
    ):
        asyncio.run(_serve())
    command.say("The app has ended.")


async def _serve() -> None:
    _, address = listen()
    command.say(f"The app is at {address} (Ctrl-C ends it)")
    sys.stdout.flush()  # also where it goes to a file
    webbrowser.open(address)
    try:
        await asyncio.Event().wait()
    finally:
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # one Ctrl-C is enough
        WORKER.shutdown(wait=False, cancel_futures=True)
