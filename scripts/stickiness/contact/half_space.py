"""Fourier operators of a periodic elastic half-space, on one thread and reproducible.

The half-space responds to a pressure wave ``p_q`` (in units of E*) with the displacement
``u_q = 2 p_q / |q|`` for q != 0 (Johnson, *Contact Mechanics*, 1985, section 13.2; Stanley and
Kato, J. Tribol. 119:481, 1997, doi 10.1115/1.2833523). `HalfSpace` applies this compliance and its
inverse, the stiffness ``|q| / 2``, as convolutions. Both leave out the mean (q = 0).
"""

import threading
from functools import cached_property, lru_cache

import numpy as np

from stickiness.contact import convolution

__all__ = ["HalfSpace", "clear_caches", "half_space", "keep_per_thread", "wavenumbers"]

_CACHES = []  # of all functions that `keep_per_thread` decorates


def keep_per_thread(most):
    """Decorate a function of hashable arguments: keep the `most` last results of each thread.

    The operators own their plans and buffers, so that no two threads may share one.
    """

    def decorate(make):
        @lru_cache(maxsize=most)
        def kept(thread, *arguments):
            return make(*arguments)

        def of_this_thread(*arguments):
            return kept(threading.get_ident(), *arguments)

        _CACHES.append(kept)
        return of_this_thread

    return decorate


def clear_caches():
    """Free the plans and buffers that functions decorated with `keep_per_thread` hold."""
    for kept in _CACHES:
        kept.cache_clear()


def wavenumbers(shape, lengths):
    """Magnitudes of the wavevectors of a real transform.

    Parameters
    ----------
    shape : tuple of int
        Grid points along both axes.
    lengths : tuple of float
        Sides of the periodic cell, any unit.

    Returns
    -------
    numpy.ndarray
        ``|q|`` of shape ``(shape[0], shape[1] // 2 + 1)``, in 1/unit of length.
    """
    q0 = 2 * np.pi * np.fft.fftfreq(shape[0], lengths[0] / shape[0])
    q1 = 2 * np.pi * np.fft.rfftfreq(shape[1], lengths[1] / shape[1])
    return np.hypot(q0[:, None], q1[None, :])


class HalfSpace:
    """Compliance and stiffness of a periodic half-space on a regular grid.

    The object owns its buffers: it must not be used by two threads at once (`half_space` hands
    every thread its own).

    Parameters
    ----------
    shape : tuple of int
        Grid points ``(n0, n1)``; even, odd and prime numbers work.
    lengths : tuple of float
        Sides of the cell; displacements come out in this unit.
    dtype : data-type, optional
        Of the real fields: double precision, or single at about half the cost for large grids.

    Attributes
    ----------
    pairs : int
        Convolutions (a forward and a backward transform each) since construction.
    mean_stiffness : float
        Diagonal of the stiffness matrix: pressure under a pixel lifted alone, per unit of lift.
    """

    def __init__(self, shape, lengths, dtype=np.float64):
        self.dtype = np.dtype(dtype)
        self.shape = tuple(int(n) for n in shape)
        self.lengths = tuple(float(a) for a in lengths)
        self.pairs = 0
        n0, n1 = self.shape
        packed = self.dtype == np.float32 and n1 % 2 == 0
        self._convolution = (convolution.Packed if packed else convolution.Real)(
            self.shape, self.dtype
        )
        # FFTW does not normalise; the symbols carry the 1 / (n0 n1) of the inverse transform.
        q = wavenumbers(self.shape, self.lengths).T
        weight = np.full(q.shape[0], 2.0)
        weight[0] = 1.0
        if n1 % 2 == 0:
            weight[-1] = 1.0
        self.mean_stiffness = float(weight @ q.sum(axis=1)) / (2 * n0 * n1)
        q[0, 0] = np.inf
        np.divide(2 / (n0 * n1), q, out=q)
        self._compliance = self._convolution.symbol(q)

    @cached_property
    def _stiffness(self):
        # Made on demand: in double precision the contact solvers rarely need it.
        q = wavenumbers(self.shape, self.lengths).T
        q /= 2 * self.shape[0] * self.shape[1]
        return self._convolution.symbol(q)

    def compliance(self, pressure, out=None, rows_in=None, rows_out=None):
        """Displacement of the surface under a pressure field.

        Parameters
        ----------
        pressure : numpy.ndarray
            Pressure in units of E*, shape of the grid.
        out : numpy.ndarray, optional
            Where to write the displacement.
        rows_in : numpy.ndarray of int, optional
            Increasing indices of the only rows with non-zero pressure (default: all).
        rows_out : numpy.ndarray of int, optional
            Rows of the displacement that are wanted; others are left as they are in `out`.

        Returns
        -------
        numpy.ndarray
            Displacement of zero mean, in the unit of `lengths`.
        """
        return self._convolve(pressure, self._compliance, out, rows_in, rows_out)

    def stiffness(self, displacement, out=None, rows_in=None, rows_out=None):
        """Pressure that causes a displacement field, the inverse of `compliance`.

        Parameters
        ----------
        displacement : numpy.ndarray
            Displacement in the unit of `lengths`, shape of the grid.
        out, rows_in, rows_out
            As in `compliance`.

        Returns
        -------
        numpy.ndarray
            Pressure of zero mean, in units of E*.
        """
        return self._convolve(displacement, self._stiffness, out, rows_in, rows_out)

    def _convolve(self, field, symbol, out, rows_in, rows_out):
        if field.shape != self.shape:
            raise ValueError(f"field has shape {field.shape}, the half-space {self.shape}")
        if out is None:
            empty = np.empty if rows_out is None else np.zeros
            out = empty(self.shape, self.dtype)
        every = np.arange(self.shape[0])
        rows_in = every if rows_in is None else rows_in
        rows_out = every if rows_out is None else rows_out
        self._convolution.apply(symbol, field, out, rows_in, rows_out)
        self.pairs += 1
        return out


def half_space(shape, lengths, dtype=np.float64):
    """`HalfSpace` of a grid (arguments as there), kept for the next call of the same thread."""
    return _kept_half_space(tuple(shape), tuple(lengths), np.dtype(dtype))


_kept_half_space = keep_per_thread(24)(HalfSpace)
