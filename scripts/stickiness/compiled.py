"""Loops over grids, compiled when they are first called.

numpy passes over memory once for every operation, a compiled loop once for all operations that a
point needs. numba keeps what is compiled on disk: in ``NUMBA_CACHE_DIR`` (jobs of the workflow set
it), beside the source, or in the user's cache.
"""

from functools import wraps

# Sums may be taken in any order, so that vector instructions serve; nothing else is given up. What
# is kept on disk does not notice a change of this line: delete it then.
_FREEDOMS = {"reassoc", "contract", "nsz"}


def compiled(function):
    """Compile a function of arrays and numbers at its first call."""
    machine_code = None

    @wraps(function)
    def call(*arguments):
        nonlocal machine_code
        if machine_code is None:
            try:
                machine_code = _compile(function, cache=True)
                return machine_code(*arguments)
            # No folder, a full or a vanished one, found before the function runs.
            except (OSError, RuntimeError):
                machine_code = _compile(function, cache=False)
        return machine_code(*arguments)

    return call


def _compile(function, *, cache):
    import numba  # noqa: PLC0415 - most programs of a workflow solve nothing, and start faster

    return numba.njit(
        cache=cache,
        fastmath=_FREEDOMS,
        error_model="numpy",
        nogil=True,
        no_cfunc_wrapper=True,  # only Python calls these loops
    )(function)
