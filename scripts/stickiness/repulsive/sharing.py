"""Share work on parts of a grid among threads: the result is the same for any number of them.

The parts never depend on the number of threads, and none reads what another writes. Transforms,
compiled loops and numpy's operations on long arrays let other threads run meanwhile.
"""

import threading
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager

import numpy as np

_LEAST = 2**16  # points of a grid below which waking a thread takes longer than it saves
_CHUNK = 2**15  # numbers of a field passed over at a time …
_ROWS = 32  # … or rows


class _Team(threading.local):
    """Threads that help this one."""

    helpers, pool = 0, None


_TEAM = _Team()


@contextmanager
def threads(count):
    """Let `share` use this many threads, within a ``with`` block and for this thread only."""
    before = _TEAM.helpers, _TEAM.pool
    with ThreadPoolExecutor(max(1, count - 1)) as pool:  # starts no thread before its first task
        _TEAM.helpers, _TEAM.pool = count - 1, pool
        try:
            yield
        finally:
            _TEAM.helpers, _TEAM.pool = before


def share(work, parts, points, tools=None):
    """Call ``work(part)`` once for each of the `parts` of a grid with so many points.

    `tools`: list of what no two threads may use at once, for ``work(tool, part)``, and a function
    that makes another; each thread gets one.
    """
    helpers = _TEAM.helpers if points >= _LEAST else 0
    todo = iter(list(parts))  # what the next thread that is free takes

    def run(*tool):
        for part in todo:
            work(*tool, part)

    hands = [()] * (helpers + 1)
    if tools is not None:
        ready, make = tools
        while len(ready) <= helpers:
            ready.append(make())
        hands = [(tool,) for tool in ready]
    others = [_TEAM.pool.submit(run, *hands[k + 1]) for k in range(helpers)]
    run(*hands[0])
    for other in others:
        other.result()


def spread(work, size, points=None):
    """Call ``work(chunk)`` for slices of so many numbers, or of rows of a grid of `points`."""
    share(work, _chunks(size, _CHUNK if points is None else _ROWS), points or size)


def fill(field, value):
    """``field[:] = value``."""
    spread(lambda chunk: field[chunk].fill(value), field.size)


def find(test, size):
    """Indices among `size` numbers for which ``test(chunk)``, an array of truth values, holds."""
    chunks, found = _chunks(size), {}

    def look(chunk):
        found[chunk.start] = np.flatnonzero(test(chunk)) + chunk.start

    share(look, chunks, size)
    return np.concatenate([found[chunk.start] for chunk in chunks])


def take(field, points):
    """``field[points]``."""
    values = np.empty(points.size, field.dtype)

    def move(chunk):
        values[chunk] = field[points[chunk]]

    spread(move, points.size)
    return values


def put(field, points, values):
    """``field[points] = values``, of an array or one number; no point twice."""

    def move(chunk):
        field[points[chunk]] = values[chunk] if np.ndim(values) else values

    spread(move, points.size)


def _chunks(size, length=_CHUNK):
    return [slice(start, min(start + length, size)) for start in range(0, size, length)]
