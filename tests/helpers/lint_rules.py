"""Print what `snakemake --lint` finds in the rules, and fail if it finds anything.

One of its lints is left out: it wants input functions in a file of their own, far from the rules
that they belong to. Here a stage's file holds both.
"""

import re
import subprocess
import sys

LEFT_OUT = "Mixed rules and functions in same snakefile."


def find_lints(text):
    """Titles of lints, each with the rule or file that it is about."""
    about = "the workflow"
    for line in text.splitlines():
        if named := re.match(r"Lints for (.*):$", line):
            about = named[1]
        elif (title := re.match(r"    \* (.*?):?$", line)) and title[1] != LEFT_OUT:
            yield f"{about}: {title[1]}"


if __name__ == "__main__":
    command = [sys.executable, "-m", "snakemake", "--lint"]
    done = subprocess.run(command, capture_output=True, text=True)
    text = done.stdout + done.stderr
    if done.returncode and "Lints for" not in text:
        sys.exit(text)
    if lints := list(find_lints(text)):
        sys.exit("\n".join(lints))
