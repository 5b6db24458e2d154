"""Fourier operators of a periodic elastic half-space, on one thread and reproducible.

The half-space responds to a pressure wave ``p_q`` (in units of E*) with the displacement
``u_q = 2 p_q / |q|`` for q != 0 (Johnson, *Contact Mechanics*, 1985, section 13.2; Stanley and
Kato, J. Tribol. 119:481, 1997, doi 10.1115/1.2833523). `HalfSpace` applies this compliance and its
inverse, the stiffness ``|q| / 2``, as convolutions. Both leave out the mean (q = 0).

A two-dimensional transform of a large grid is bound by memory, not by arithmetic. The
convolution is therefore blocked: blocks of rows are transformed and stored transposed; then a
few wavenumbers at a time are transformed along the other axis, multiplied by the symbol and
transformed back while they are in cache. Rows that hold nothing, or of which nothing is wanted,
are left out; for a contact of a few per cent of the area that saves up to half the work.

All plans are made with ``FFTW_ESTIMATE``: FFTW then never chooses an algorithm by timing, so that
the last bits of a result do not depend on how busy the machine was.
"""

import threading
from functools import cached_property, lru_cache

import numpy as np
import pyfftw

__all__ = ["HalfSpace", "half_space", "irfft2", "rfft2", "wavenumbers"]

_FLAGS = ("FFTW_ESTIMATE", "FFTW_DESTROY_INPUT")
_STRIP = 2**14  # complex numbers transformed at a time along axis 0: 256 kB, inside a cache
_ROWS = 64  # rows transformed at a time along axis 1: long runs in the transposed copies


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
        modes = n1 // 2 + 1
        self._rows = min(n0, _ROWS)
        self._strip = max(1, min(modes, _STRIP // n0))
        padded = -(-modes // self._strip) * self._strip
        # A row length that is no multiple of 4 kB avoids cache conflicts in the transposed copies.
        stride = -(-n0 // 8) * 8 + 8
        self._symbols(modes, padded)
        self._complex = np.result_type(self.dtype, np.complex64)
        self._spectrum_in = pyfftw.zeros_aligned((padded, stride), self._complex)
        # In double precision one array holds the spectrum before and after: memory before speed.
        self._spectrum_out = self._spectrum_in
        if self.dtype == np.float32:
            self._spectrum_out = pyfftw.zeros_aligned((padded, stride), self._complex)
        self._filled = np.zeros(n0, bool)
        self._plan(n0, n1, modes)

    def _symbols(self, modes, padded):
        n0, n1 = self.shape
        points = n0 * n1
        # FFTW does not normalise; the symbols carry the 1 / (n0 n1) of the inverse transform.
        q = wavenumbers(self.shape, self.lengths).T
        weight = np.full(modes, 2.0)
        weight[0] = 1.0
        if n1 % 2 == 0:
            weight[-1] = 1.0
        self.mean_stiffness = float(weight @ q.sum(axis=1)) / (2 * points)
        q[0, 0] = np.inf
        self._compliance = np.zeros((padded, n0), self.dtype)
        np.divide(2 / points, q, out=self._compliance[:modes], casting="same_kind")

    @cached_property
    def _stiffness(self):
        # Made on demand: in double precision the contact solvers rarely need it.
        n0, n1 = self.shape
        symbol = np.zeros(self._compliance.shape, self.dtype)
        q = wavenumbers(self.shape, self.lengths).T
        np.divide(q, 2 * n0 * n1, out=symbol[: q.shape[0]], casting="same_kind")
        return symbol

    def _plan(self, n0, n1, modes):
        self._real = pyfftw.zeros_aligned((self._rows, n1), self.dtype)
        # An even row length keeps every row aligned for vector instructions.
        half = pyfftw.zeros_aligned((self._rows, -(-modes // 8) * 8), self._complex)
        self._half = half[:, :modes]
        self._work = pyfftw.zeros_aligned((self._strip, n0), self._complex)
        first_in = self._spectrum_in[: self._strip, :n0]
        first_out = self._spectrum_out[: self._strip, :n0]

        def plan(source, target, direction, flags=_FLAGS):
            return pyfftw.FFTW(
                source, target, axes=(1,), direction=direction, flags=flags, threads=1
            )

        self._rows_forward = plan(self._real, self._half, "FFTW_FORWARD")
        self._rows_backward = plan(self._half, self._real, "FFTW_BACKWARD")
        # Rows that stay empty must remain zero: the stored spectrum may not be destroyed.
        self._columns_forward = plan(first_in, self._work, "FFTW_FORWARD", ("FFTW_ESTIMATE",))
        self._columns_backward = plan(self._work, first_out, "FFTW_BACKWARD")

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
        self._forward_rows(field, every if rows_in is None else rows_in)
        self._multiply_columns(symbol)
        self._backward_rows(out, every if rows_out is None else rows_out)
        self.pairs += 1
        return out

    def _forward_rows(self, field, rows):
        modes = self._half.shape[1]
        self._filled[rows] = False
        if self._filled.any():  # rows that an earlier call filled and this one does not
            if self._spectrum_in is self._spectrum_out:
                self._spectrum_in[...] = 0
            else:
                self._spectrum_in[:, np.flatnonzero(self._filled)] = 0
        self._filled[:] = self._spectrum_in is self._spectrum_out
        self._filled[rows] = True
        for start in range(0, rows.size, self._rows):
            block = rows[start : start + self._rows]
            count = block.size
            span = _span(block)
            self._real[:count] = field[span]
            self._rows_forward.execute()
            self._spectrum_in[:modes, span] = self._half[:count].T

    def _multiply_columns(self, symbol):
        n0 = self.shape[0]
        source, target, work = self._spectrum_in, self._spectrum_out, self._work
        for start in range(0, source.shape[0], self._strip):
            strip = slice(start, start + self._strip)
            self._columns_forward.update_arrays(source[strip, :n0], work)
            self._columns_forward.execute()
            np.multiply(work, symbol[strip], out=work)
            self._columns_backward.update_arrays(work, target[strip, :n0])
            self._columns_backward.execute()

    def _backward_rows(self, out, rows):
        modes = self._half.shape[1]
        for start in range(0, rows.size, self._rows):
            block = rows[start : start + self._rows]
            count = block.size
            span = _span(block)
            self._half[:count] = self._spectrum_out[:modes, span].T
            self._rows_backward.execute()
            out[span] = self._real[:count]


def _span(rows):
    """Index of some rows: a slice (quick, no copy) where they follow one another."""
    if rows[-1] - rows[0] + 1 == rows.size:
        return slice(int(rows[0]), int(rows[-1]) + 1)
    return rows


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
