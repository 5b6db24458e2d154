"""Preconditioned conjugate gradients for the pressure that closes a gap on a set of points."""

import numpy as np

_RESOLVED = 1e-4  # largest reduction of the gap asked of a correction in single precision


def close_gap(contact, residual, goal, largest, limit):
    """Change of pressure, of zero sum, that closes the gap on a set of points.

    In single precision until the rms residual (or the `largest`) is down to `goal`. `contact` has
    the `compliance` on these points and is, when called, a preconditioner. Overwrites `residual`.

    Returns
    -------
    change : numpy.ndarray
        Of the pressure, in single precision.
    count : int
        Iterations, at least one.
    """
    change, count = np.zeros(residual.size, np.float32), 1
    if residual.size == 1 or not residual.any():
        return change, count
    goal = max(goal, _RESOLVED)
    direction, product = None, 1.0
    while True:
        z = contact(residual)
        z -= z.mean()
        previous, product = product, float(residual @ z)
        if not product > 0:  # nothing but rounding is left
            break
        if direction is None:
            direction = z
        else:
            direction *= np.float32(product / previous)
            direction += z
        image = contact.compliance(direction)
        step = np.float32(product / float(direction @ image))
        change += step * direction
        image *= step
        residual -= image
        residual -= residual.mean()
        norm = np.abs(residual).max() if largest else np.sqrt(np.mean(residual**2))
        if norm <= goal or count >= limit:
            break
        count += 1
    return change, count
