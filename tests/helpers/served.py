"""Ask `serve.py` to run commands, without the start of Python and its libraries."""

import atexit
import json
import os
import subprocess
import sys
import tempfile
from functools import cache
from pathlib import Path


@cache
def server(program):
    command = [sys.executable, Path(__file__).with_name("serve.py"), program]
    started = subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, encoding="utf-8"
    )
    atexit.register(started.communicate)  # which ends it
    return started


def run(program, folder, *arguments, together=False, **environment):
    """Run a command to its end; with `together`, its output holds its errors, too."""
    arguments = list(map(str, arguments))
    with tempfile.TemporaryDirectory() as place:
        output = Path(place, "output")
        errors = output if together else Path(place, "errors")
        order = {
            "folder": str(folder),
            "arguments": arguments,
            "environment": os.environ | environment,
            "output": str(output),
            "errors": str(errors),
        }
        server(program).stdin.write(json.dumps(order) + "\n")
        server(program).stdin.flush()
        code = int(server(program).stdout.readline())
        texts = [file.read_text(encoding="utf-8") for file in (output, errors)]
    return subprocess.CompletedProcess([program, *arguments], code, *texts)
