"""Copy the workflow, with its tiny configuration, into a folder: copy_workflow.py FOLDER."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "workflow"))

from conftest import copied

folder = Path(sys.argv[1])
folder.mkdir(parents=True)
copied(folder)
