"""Fourier operators of a periodic elastic half-space, on one thread and reproducible.

The half-space responds to a pressure wave ``p_q`` (in units of E*) with the displacement
``u_q = 2 p_q / |q|`` for q != 0 (Johnson, *Contact Mechanics*, 1985, section 13.2; Stanley and
Kato, J. Tribol. 119:481, 1997, doi 10.1115/1.2833523). `HalfSpace` applies this compliance and its
inverse, the stiffness ``|q| / 2``, as convolutions. Both leave out the mean (q = 0).
"""

import threading
from functools import cached_property, lru_cache

import numpy as np
import pyfftw

from stickiness.contact import convolution

__all__ = ["HalfSpace", "half_space", "irfft2", "rfft2", "wavenumbers"]


_SHORT = 0.9  # stiffness of all short waves over that of the shortest


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


def rfft2(field):
    """Unnormalised real two-dimensional transform, reproducible and on one thread.

    Parameters
    ----------
    field : numpy.ndarray
        Real array ``(n0, n1)``.

    Returns
    -------
    numpy.ndarray
        Complex array ``(n0, n1 // 2 + 1)``.
    """
    return pyfftw.interfaces.numpy_fft.rfft2(field, threads=1, planner_effort="FFTW_ESTIMATE")


def irfft2(spectrum, shape):
    """Inverse of `rfft2`, normalised by the number of points.

    Parameters
    ----------
    spectrum : numpy.ndarray
        Complex array ``(n0, n1 // 2 + 1)``.
    shape : tuple of int
        ``(n0, n1)``.

    Returns
    -------
    numpy.ndarray
        Real array of that shape.
    """
    return pyfftw.interfaces.numpy_fft.irfft2(
        spectrum, s=shape, axes=(0, 1), threads=1, planner_effort="FFTW_ESTIMATE"
    )


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


class CoarseStiffness:
    """Part of an approximate stiffness that a grid half as fine along both axes carries.

    With ``B`` the incidence of the points of the fine grid and the four, not always different,
    coarse points around each, ``constant + B apply B^T`` approximates ``|q| / 2`` in single
    precision: exactly for long waves (but for aliases), by the constant for short ones.

    Parameters
    ----------
    shape : tuple of int
        Points of the fine grid along both axes, even numbers.
    lengths : tuple of float
        Sides of the cell.

    Attributes
    ----------
    constant : float
        Stiffness of the shortest waves.
    applications : int
        Convolutions on the coarse grid since construction.
    """

    def __init__(self, shape, lengths):
        self.shape = tuple(n // 2 for n in shape)
        self.applications = 0
        # Squared transfer of full weighting, summed over the aliases along each axis.
        weights = [(1 + np.cos(np.pi * np.fft.fftfreq(n)) ** 2) / 2 for n in self.shape]
        q = wavenumbers(self.shape, lengths)
        shortest = np.pi * np.hypot(shape[0] / lengths[0], shape[1] / lengths[1])
        constant = _SHORT * shortest / 2
        symbol = (q / 2 - constant) / np.outer(weights[0], weights[1][: q.shape[1]])
        # full weighting is B^T / 16 and interpolation B / 4
        symbol /= 64 * self.shape[0] * self.shape[1]
        self.constant = np.float32(constant)
        kind = convolution.Packed if self.shape[1] % 2 == 0 else convolution.Real
        self._convolution = kind(self.shape, np.dtype(np.float32))
        self._symbol = self._convolution.symbol(symbol.T)
        self._every = np.arange(self.shape[0])
        self._image = pyfftw.zeros_aligned(self.shape, np.float32)

    def apply(self, field):
        """Convolve.

        Parameters
        ----------
        field : numpy.ndarray
            Values at all points of the coarse grid, in single precision.

        Returns
        -------
        numpy.ndarray
            As many values; overwritten by the next call.
        """
        field = field.reshape(self.shape)
        self._convolution.apply(self._symbol, field, self._image, self._every, self._every)
        self.applications += 1
        return self._image.ravel()


def half_space(shape, lengths, dtype=np.float64):
    """`HalfSpace` of a grid, with plans and buffers kept for the next call.

    Parameters
    ----------
    shape : tuple of int
        Grid points along both axes.
    lengths : tuple of float
        Sides of the cell.
    dtype : data-type, optional
        Of the real fields.

    Returns
    -------
    HalfSpace
        One object per grid and thread.
    """
    return _cached(tuple(shape), tuple(lengths), np.dtype(dtype), threading.get_ident())


@lru_cache(maxsize=24)
def _cached(shape, lengths, dtype, thread):
    return HalfSpace(shape, lengths, dtype)


def coarse_stiffness(shape, lengths):
    """`CoarseStiffness` of a grid, kept for the next call; None for a grid it does not suit."""
    if min(shape) < 4 or shape[0] % 2 or shape[1] % 2:
        return None
    return _cached_coarse(tuple(shape), tuple(lengths), threading.get_ident())


@lru_cache(maxsize=12)
def _cached_coarse(shape, lengths, thread):
    return CoarseStiffness(shape, lengths)


def clear_caches():
    """Free the plans and buffers kept by `half_space` and `coarse_stiffness`."""
    _cached.cache_clear()
    _cached_coarse.cache_clear()
