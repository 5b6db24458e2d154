"""Sums between a periodic grid and one half as fine, whose points are every other one of it.

A coarse point takes the fine points around it with the weights 1, 2 and 1 along each axis,
``B^T field``. Its transpose ``B`` is four times the linear interpolation. A grid of an odd number
of points is continued by a row or column of zeros.
"""

import numpy as np

from stickiness.compiled import compiled
from stickiness.repulsive import sharing

_ROWS = 256  # that one thread fills at a time


def gather(field):
    """Sums over the points around each coarse one, ``B^T field``, in single precision."""
    field = np.ascontiguousarray(_complete(field), np.float32)
    coarse = np.empty([n // 2 for n in field.shape], np.float32)

    def fill(_, rows):
        row = np.empty(field.shape[1] + 1, np.float32)
        _gather_rows(rows.start, field, coarse[rows], row)

    sharing.share(fill, _parts(coarse), coarse.size)
    return coarse


def spread(coarse, out, weight=1):
    """Add the sums over the coarse points around each point, ``B coarse``, to `weight` times it."""
    whole = _complete(out)

    def fill(_, rows):
        row = np.empty(coarse.shape[1] + 1, np.float32)
        _spread_rows(rows.start, coarse, np.float32(weight), whole[rows], row)

    sharing.share(fill, _parts(whole), whole.size)
    if whole is not out:
        out[...] = whole[: out.shape[0], : out.shape[1]]


def _complete(field):
    """The field, with a row or column of zeros more where it has an odd number."""
    odd = (field.shape[0] % 2, field.shape[1] % 2)
    return field if odd == (0, 0) else np.pad(field, [(0, odd[0]), (0, odd[1])])


def _parts(field):
    """Rows of a field for each call of a loop."""
    return [slice(start, start + _ROWS) for start in range(0, len(field), _ROWS)]


@compiled
def _gather_rows(first, field, coarse, row):
    """Fill in rows of the coarse grid, from a first one on; `row` is scratch."""
    columns = field.shape[1]
    for i in range(coarse.shape[0]):
        at = 2 * (first + i)
        before = (at if at > 0 else field.shape[0]) - 1
        for j in range(columns):
            row[j + 1] = field[before, j] + field[at, j] + field[at, j] + field[at + 1, j]
        row[0] = row[columns]
        for j in range(coarse.shape[1]):
            coarse[i, j] = row[2 * j] + row[2 * j + 1] + row[2 * j + 1] + row[2 * j + 2]


@compiled
def _spread_rows(first, coarse, weight, out, row):
    """Add to weighted rows of the fine grid, from a first one on; `row` is scratch."""
    rows, half = coarse.shape
    for i in range(out.shape[0]):
        upper = (first + i) // 2
        lower = upper + (first + i) % 2
        lower = lower if lower < rows else 0
        for j in range(half):
            row[j] = coarse[upper, j] + coarse[lower, j]
        row[half] = row[0]
        for j in range(half):
            out[i, 2 * j] = row[j] + row[j] + weight * out[i, 2 * j]
            out[i, 2 * j + 1] = row[j] + row[j + 1] + weight * out[i, 2 * j + 1]
