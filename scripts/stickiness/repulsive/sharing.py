"""Share work on parts of a grid among threads: the result is the same for any number of them.

The parts never depend on the number of threads, and none reads what another writes. Transforms,
compiled loops and numpy's operations on long arrays let other threads run meanwhile.
"""

import threading
from concurrent.futures import ThreadPoolExecutor, wait
from contextlib import contextmanager

import numpy as np

_LEAST = 2**17  # points of a grid below which waking a thread costs what it saves
_CHUNK = 2**15  # numbers of a field passed over at a time …
_ROWS = 32  # … or rows


class _Team(threading.local):
    """Threads that help this one."""

    helpers = 0
    pool = None


_TEAM = _Team()


@contextmanager
def threads(count):
    """Let `share` use this many threads, within a ``with`` block and for this thread only."""
    helpers_before = _TEAM.helpers
    pool_before = _TEAM.pool
    with ThreadPoolExecutor(max(1, count - 1)) as pool:  # starts no thread before its first task
        _TEAM.helpers = count - 1
        _TEAM.pool = pool
        try:
            yield
        finally:
            _TEAM.helpers = helpers_before
            _TEAM.pool = pool_before


def share(work, parts, points):
    """Results of ``work(worker, part)`` for each of the `parts` of a grid with so many points.

    No two threads are the same worker: they count from zero.
    """
    parts = list(parts)
    helpers = min(_TEAM.helpers, len(parts) - 1) if points >= _LEAST else 0
    if helpers <= 0:
        return [work(0, part) for part in parts]
    results = {}
    todo = iter(range(len(parts)))  # whoever is free takes the next

    def run(worker):
        for k in todo:
            results[k] = work(worker, parts[k])

    others = [_TEAM.pool.submit(run, worker + 1) for worker in range(helpers)]
    try:
        run(0)
    finally:  # nobody writes on once this returns, or raises
        wait(others)
    for other in others:
        other.result()
    return [results[k] for k in range(len(parts))]


def spread(work, size, width=None):
    """Results of ``work(chunk)`` for slices of so many numbers, or rows of a `width`."""
    length = _ROWS if width else _CHUNK
    chunks = (slice(start, min(start + length, size)) for start in range(0, size, length))
    return share(lambda _, chunk: work(chunk), chunks, size * (width or 1))


def find(test, size):
    """Indices among `size` numbers for which ``test(chunk)``, an array of truth values, holds."""
    return np.concatenate(spread(lambda c: np.flatnonzero(test(c)) + c.start, size))


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


def evaluate(function, out, *fields):
    """``out[:] = function(*fields)``, of flat arrays and point by point."""

    def work(chunk):
        np.copyto(out[chunk], function(*(field[chunk] for field in fields)), casting="same_kind")

    spread(work, out.size)
