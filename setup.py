"""The page of the package in an index: README.md without what needs the files beside it."""

import re
from pathlib import Path

from setuptools import setup

readme = Path(__file__).with_name("README.md").read_text(encoding="utf-8")
# The workflow, and the pages that later sections lead to, are not in the package.
page = readme.partition("\n## Reproduce the paper\n")[0]
# Pictures with the captions below them go, and links to files become plain words.
page = re.sub(r"!\[.*\]\(.*\)\n\n\*.*\*\n\n", "", page)
page = re.sub(r"\[([^]]*)\]\((?!https://)[^)]*\)", r"\1", page)
# From an index instead of this folder.
page = page.replace("In this folder, install", "Install").replace("install .", "install stickiness")

setup(long_description=page, long_description_content_type="text/markdown")
