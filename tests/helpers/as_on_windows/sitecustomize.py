"""Python as on Windows: without modules and functions of POSIX, and with a word on every text whose
encoding is left to the locale.

Found in ``PYTHONPATH`` by scripts of the workflow and by the command. Snakemake itself, which knows
Windows, keeps its Python.
"""

import os
import signal
import sys
import warnings

MISSING = ("fcntl", "resource", "pwd", "grp", "termios")
OURS = r"stickiness|common|campaigns|limits|contact|adhesion|criteria|__main__"

if any("stickiness" in word or ".snakemake" in word for word in sys.orig_argv):
    sys.modules.update(dict.fromkeys(MISSING))
    for module, name in ((os, "fork"), (os, "getuid"), (signal, "setitimer"), (signal, "SIGPROF")):
        if hasattr(module, name):
            delattr(module, name)
    warnings.filterwarnings("error", category=EncodingWarning, module=OURS)
