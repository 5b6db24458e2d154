"""Environment in which Python is as on Windows, see `as_on_windows/sitecustomize.py`."""

import os
from pathlib import Path

HERE = Path(__file__).parent
AS_ON_WINDOWS = {
    "PYTHONPATH": os.pathsep.join(map(str, (HERE / "as_on_windows", HERE.parents[1] / "scripts"))),
    "PYTHONWARNDEFAULTENCODING": "1",
}
