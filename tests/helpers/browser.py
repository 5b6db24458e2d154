"""A real browser without a window, that tests steer: Chromium by its DevTools protocol."""

import asyncio
import base64
import json
import re
import shutil
import subprocess
import time
from contextlib import asynccontextmanager

from tornado.websocket import websocket_connect

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
CHROMIUM = next(filter(None, map(shutil.which, NAMES)), None)
FLAGS = (
    "--headless --no-sandbox --disable-gpu --disable-quic --disable-dev-shm-usage --no-first-run"
)
FLAGS += " --disable-sync --disable-background-networking --disable-component-update"
FLAGS += " --hide-scrollbars --remote-debugging-port=0 --remote-allow-origins=*"
# Names from outside are not found, so that nothing can be loaded from there.
FLAGS = [*FLAGS.split(), "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1"]


class Tab:
    """A tab of the browser."""

    def __init__(self, socket):
        self.socket = socket
        self.count = 0
        self.logged = []  # errors on the console

    async def call(self, method, **parameters):
        """Result of a method of the protocol."""
        self.count += 1
        order = {"id": self.count, "method": method, "params": parameters}
        await self.socket.write_message(json.dumps(order))
        while True:
            told = json.loads(await self.socket.read_message())
            if told.get("method") == "Runtime.exceptionThrown":
                self.logged.append(told["params"]["exceptionDetails"]["text"])
            if told.get("id") == self.count:
                assert "error" not in told, told
                return told["result"]

    async def run(self, code):
        """Value of JavaScript, as JSON can hold it."""
        options = {"returnByValue": True, "awaitPromise": True}
        told = await self.call("Runtime.evaluate", expression=code, **options)
        assert "exceptionDetails" not in told, told
        return told["result"].get("value")

    async def wait_for(self, code, seconds=60):
        """The first value of JavaScript that is true, and how long it took."""
        start = time.monotonic()
        while time.monotonic() < start + seconds:
            if value := await self.run(code):
                return value, time.monotonic() - start
            await asyncio.sleep(0.05)
        shown = await self.run("document.body.innerText")
        raise AssertionError(f"not within {seconds} s: {code}; the page shows: {shown}")

    async def resize(self, width, height):
        options = {"deviceScaleFactor": 1, "mobile": width < 600}
        await self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, **options)

    async def shoot(self, path):
        """Write a picture of the whole page."""
        told = await self.call("Page.captureScreenshot", captureBeyondViewport=True)
        path.write_bytes(base64.b64decode(told["data"]))


@asynccontextmanager
async def open_tab(folder, address):
    """Open an address in a browser of its own, with a profile in a folder."""
    command = [CHROMIUM, *FLAGS, f"--user-data-dir={folder}", "about:blank"]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    try:
        lines = iter(process.stderr.readline, "")
        port = next(found[1] for line in lines if (found := re.search(r"ws://[^:]+:(\d+)/", line)))
        listed = f"http://127.0.0.1:{port}/json/new?about:blank"
        done = await asyncio.to_thread(
            subprocess.run, ["curl", "-s", "-X", "PUT", listed], capture_output=True, check=True
        )
        target = json.loads(done.stdout)["webSocketDebuggerUrl"]
        tab = Tab(await websocket_connect(target, max_message_size=10**8))
        await tab.call("Runtime.enable")
        await tab.call("Page.enable")
        await tab.call("Page.navigate", url=address)
        yield tab
        tab.socket.close()
        await asyncio.sleep(0.1)  # for the answer of the browser
    finally:
        process.terminate()
        process.communicate()
