"""ask.py SOCKET SCRIPT: ask the process that listens to run a script, as `python SCRIPT`.

It takes the folder, environment and streams of this process, and answers with the exit code.
"""

import json
import os
import socket
import sys

address, script = sys.argv[1:]
with socket.socket(socket.AF_UNIX) as asked:
    asked.connect(address)
    socket.send_fds(asked, [b"\n"], [0, 1, 2])
    order = {"folder": os.getcwd(), "script": script, "environment": dict(os.environ)}
    asked.sendall(json.dumps(order).encode())
    asked.shutdown(socket.SHUT_WR)
    code = asked.recv(8)  # nothing, if the script was killed
sys.exit(int(code or 1))
