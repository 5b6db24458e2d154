"""Sums between a periodic grid and one half as fine, whose points are every other one of it.

A coarse point takes the fine points around it with the weights 1, 2 and 1 along each axis,
``B^T field``. Its transpose ``B`` is four times the linear interpolation. A grid of an odd number
of points is continued by a row or column of zeros.
"""

import numpy as np

from stickiness.compiled import compiled
from stickiness.repulsive import sharing


def gather(field):
    """Sums over the points around each coarse one, ``B^T field``, in single precision."""
    field = np.ascontiguousarray(_complete(field), np.float32)
    coarse = np.empty([n // 2 for n in field.shape], np.float32)
    sharing.spread(lambda rows: _gather_rows(rows.start, field, coarse[rows]), *coarse.shape)
    return coarse


def spread(coarse, out):
    """Add to each point the sums over the coarse points around it, ``B coarse``."""
    whole = _complete(out)

    def fill(rows):
        row = np.empty(coarse.shape[1] + 1, np.float32)
        _spread_rows(rows.start, coarse, whole[rows], row)

    sharing.spread(fill, *whole.shape)
    if whole is not out:
        out[...] = whole[: out.shape[0], : out.shape[1]]


def _complete(field):
    """The field, with a row or column of zeros more where it has an odd number."""
    odd = [n % 2 for n in field.shape]
    return np.pad(field, [(0, more) for more in odd]) if any(odd) else field


@compiled
def _gather_rows(first, field, coarse):
    """Fill in rows of the coarse grid, from a first one on."""
    last = field.shape[1] - 1
    for i in range(coarse.shape[0]):
        at = 2 * (first + i)
        before = (at if at > 0 else field.shape[0]) - 1
        left = field[before, last] + field[at, last] + field[at, last] + field[at + 1, last]
        for j in range(coarse.shape[1]):
            k = 2 * j
            middle = field[before, k] + field[at, k] + field[at, k] + field[at + 1, k]
            right = (
                field[before, k + 1] + field[at, k + 1] + field[at, k + 1] + field[at + 1, k + 1]
            )
            coarse[i, j] = left + middle + middle + right
            left = right


@compiled
def _spread_rows(first, coarse, out, row):
    """Add to rows of the fine grid, from a first one on; `row` is scratch."""
    rows, half = coarse.shape
    for i in range(out.shape[0]):
        left = (first + i) // 2
        right = (first + i + 1) // 2 % rows
        for j in range(half):
            row[j] = coarse[left, j] + coarse[right, j]
        row[half] = row[0]
        for j in range(half):
            out[i, 2 * j] += row[j] + row[j]
            out[i, 2 * j + 1] += row[j] + row[j + 1]
