"""Fail if a surface could not be read, after the tables of all others are made."""

from pathlib import Path

from common.job import start
from stickiness import datasets


def main(job):
    unread = datasets.read(job.input[0]).attrs.get("unread", "")
    if unread:
        raise ValueError(f"surfaces that are not judged, since they could not be read: {unread}")
    Path(job.output[0]).touch()


if __name__ == "__main__":
    main(start(globals()))
