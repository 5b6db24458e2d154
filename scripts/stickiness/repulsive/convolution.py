"""Blocked convolutions of a real periodic field with an even kernel, on one thread.

The transform of a large grid is bound by memory, not by arithmetic. Rows are therefore transformed
a block at a time, then a few wavenumbers at a time along the other axis, multiplied by the symbol
of the kernel and transformed back while they are in cache. Rows that hold nothing, or of which
nothing is wanted, are left out.

All plans are made with ``FFTW_ESTIMATE``: FFTW then never chooses an algorithm by timing, so that
the last bits of a result do not depend on how busy the machine was.
"""

import threading

import numpy as np
import pyfftw

from stickiness.compiled import compiled

_FLAGS = ("FFTW_ESTIMATE", "FFTW_DESTROY_INPUT")
_ROWS = 64  # rows transformed at a time along axis 1
_STRIP = 2**12  # numbers transformed at a time along axis 0 on either side of a mirror: 32 kB
_CACHED = 2**14  # complex numbers transformed at a time along axis 0: 256 kB
_ALIGNED = 64  # bytes


class _Count(threading.local):
    """Points of all convolutions of this thread so far."""

    points = 0


COUNT = _Count()


class _Rows:
    """Transforms of blocks of rows of fields of a `dtype` on a grid `shape`."""

    def __init__(self, shape, dtype, modes):
        self.shape, self._dtype = shape, dtype
        self._numbers = np.result_type(dtype, np.complex64)
        self._rows = min(shape[0], _ROWS)
        self._real = pyfftw.zeros_aligned((self._rows, shape[1]), dtype)
        self._half = self._zeros(self._rows, modes)
        packed = 2 * modes == shape[1]
        rows = self._real.view(self._numbers) if packed else self._real
        self._rows_forward = _plan(rows, self._half, "FFTW_FORWARD")
        self._rows_backward = _plan(self._half, rows, "FFTW_BACKWARD")

    def _zeros(self, rows, columns):
        return pyfftw.zeros_aligned((rows, _stride(columns)), self._numbers)[:, :columns]


class Real(_Rows):
    """Convolution on any grid; the spectrum is stored transposed."""

    def __init__(self, shape, dtype):
        n0, modes = shape[0], shape[1] // 2 + 1
        super().__init__(shape, dtype, modes)
        self._strip = max(1, min(modes, _CACHED // n0))
        self._spectrum = self._zeros(-(-modes // self._strip) * self._strip, n0)
        self._work = pyfftw.zeros_aligned((self._strip, n0), self._numbers)
        first = self._spectrum[: self._strip]
        self._columns_forward = _plan(first, self._work, "FFTW_FORWARD")
        self._columns_backward = _plan(self._work, first, "FFTW_BACKWARD")

    def symbol(self, values):
        """Prepare a symbol, normalised values of shape ``(n1 // 2 + 1, n0)``, for `apply`."""
        padded = np.zeros(self._spectrum.shape, self._dtype)
        padded[: values.shape[0]] = values
        return padded

    def apply(self, symbol, field, out, rows_in, rows_out):
        """Convolve `field` into `out` with what `symbol` returned.

        `rows_in`, `rows_out`: increasing indices of the rows that are not zero, and of those
        wanted. Both arrays may be the corner of the grid that holds these rows: `field` is zero
        beyond, and `out` gets no more.
        """
        COUNT.points += self.shape[0] * self.shape[1]
        modes = self._half.shape[1]
        if rows_in.size < self.shape[0]:
            self._spectrum[...] = 0
        for block, span in _blocks(rows_in, self._rows):
            _pad(field[span], self._real)
            self._rows_forward.execute()
            self._spectrum[:modes, span] = self._half[: block.size].T
        for start in range(0, self._spectrum.shape[0], self._strip):
            strip = slice(start, start + self._strip)
            self._columns_forward.update_arrays(self._spectrum[strip], self._work)
            self._columns_forward.execute()
            np.multiply(self._work, symbol[strip], out=self._work)
            self._columns_backward.update_arrays(self._work, self._spectrum[strip])
            self._columns_backward.execute()
        for block, span in _blocks(rows_out, self._rows):
            self._half[: block.size] = self._spectrum[:modes, span].T
            self._rows_backward.execute()
            out[span] = self._real[: block.size, : out.shape[1]]


class Packed(_Rows):
    """Convolution for an even number of columns, by transforms of complex rows of half the width.

    Neighbours along a row are the real and the imaginary part (Cooley, Lewis and Welch, J. Sound
    Vib. 12:315, 1970): transforms of complex numbers make better use of vector instructions. With
    ``z = p[:, ::2] + i p[:, 1::2]`` the convolution of p with the symbol S is ``z'_k = a z_k + i b
    conj(z_-k)`` where ``a = s - d sin t``, ``b = d cos t``, s and d are half the sum and half the
    difference of S at k and at k + n1/2, and ``t = 2 pi k1 / n1``.
    """

    def __init__(self, shape, dtype):
        n0, modes = shape[0], shape[1] // 2
        super().__init__(shape, dtype, modes)
        self._groups = list(_mirrored(modes, max(8, _STRIP // n0)))
        widest = max(sum(s.stop - s.start for s in group) for group in self._groups)
        self._spectrum = self._zeros(n0, modes)
        self._before, self._after, self._product = (
            pyfftw.zeros_aligned((widest, n0), self._numbers) for _ in range(3)
        )
        self._mirror = np.empty(2 * n0, dtype)
        self._columns_forward = _plan(self._before, self._after, "FFTW_FORWARD")
        self._columns_backward = _plan(self._product, self._before, "FFTW_BACKWARD")

    def symbol(self, values):
        """Prepare a symbol, as `Real.symbol` does."""
        modes, n0 = values.shape[0] - 1, values.shape[1]
        direct = np.empty((modes, n0), self._dtype)
        crossed = np.empty((modes, n0), self._dtype)
        start = 0
        # Half the sum, half the difference, and twice for a transform of half the points.
        for strip in (strip for group in self._groups for strip in group):
            k = np.arange(strip.start, strip.stop)
            rows = slice(start, start + k.size)
            angle = np.pi * k[:, None] / modes
            difference = values[k] - values[modes - k]
            direct[rows] = values[k] + values[modes - k] - difference * np.sin(angle)
            crossed[rows] = difference * np.cos(angle)
            start += k.size
        return direct, crossed

    def apply(self, symbol, field, out, rows_in, rows_out):
        """Convolve, as `Real.apply` does; `field` and `out` must be two arrays."""
        COUNT.points += self.shape[0] * self.shape[1]
        if rows_in.size < self.shape[0]:
            self._spectrum[...] = 0
        plan = self._rows_forward
        for block, span, direct in self._blocks(field, rows_in):
            if direct:
                plan.update_arrays(field[span].view(self._numbers), self._spectrum[span])
                plan.execute()
                continue
            _pad(field[span], self._real)
            plan.update_arrays(self._real.view(self._numbers), self._half)
            plan.execute()
            self._spectrum[span] = self._half[: block.size]
        self._multiply(symbol)
        plan = self._rows_backward
        for block, span, direct in self._blocks(out, rows_out):
            if direct:
                plan.update_arrays(self._spectrum[span], out[span].view(self._numbers))
                plan.execute()
                continue
            self._half[: block.size] = self._spectrum[span]
            plan.update_arrays(self._half, self._real.view(self._numbers))
            plan.execute()
            out[span] = self._real[: block.size, : out.shape[1]]

    def _blocks(self, field, rows):
        """Blocks of rows, how to index them, and whether FFTW may work on them where they are."""
        usable = field.flags.c_contiguous and field.dtype == self._real.dtype
        usable = usable and field.shape == self.shape and field.ctypes.data % _ALIGNED == 0
        usable = usable and field.strides[0] * self._rows % _ALIGNED == 0
        for block, span in _blocks(rows, self._rows):
            direct = usable and block.size == self._rows and isinstance(span, slice)
            if direct:
                direct = span.start * field.strides[0] % _ALIGNED == 0
            yield block, span, direct

    def _multiply(self, symbol):
        direct, crossed = symbol
        start = 0
        for group in self._groups:
            count = 0
            for strip in group:
                width = strip.stop - strip.start
                self._before[count : count + width] = self._spectrum[:, strip].T
                count += width
            self._columns_forward.execute()
            rows = slice(start, start + count)
            values, product = (field.view(self._dtype) for field in (self._after, self._product))
            _combine(direct[rows], crossed[rows], values, product, self._mirror)
            self._columns_backward.execute()
            start, count = start + count, 0
            for strip in group:
                width = strip.stop - strip.start
                self._spectrum[:, strip] = self._before[count : count + width].T
                count += width


@compiled
def _combine(direct, crossed, values, product, mirror):
    """``a z_k + i b conj(z_-k)`` of the first rows of a group; real and imaginary parts in turn.

    A group is closed under k -> -k: its rows mirror one another in reverse. Reversing real and
    imaginary parts along with the numbers turns z into i conj(z).
    """
    rows, n = direct.shape
    for r in range(rows):
        mirror[0], mirror[1] = values[rows - 1 - r, 1], values[rows - 1 - r, 0]
        for t in range(2, 2 * n):
            mirror[t] = values[rows - 1 - r, 2 * n + 1 - t]
        for k in range(n):
            for t in (2 * k, 2 * k + 1):
                product[r, t] = direct[r, k] * values[r, t] + crossed[r, k] * mirror[t]


def aligned_zeros(size, dtype):
    """Field of zeros that transforms may work on where it is."""
    return pyfftw.zeros_aligned(size, dtype, n=_ALIGNED)


def choose(shape, dtype):
    """Convolution for a grid: `Packed` in single precision and an even number of columns."""
    kind = Packed if dtype == np.float32 and shape[1] % 2 == 0 else Real
    return kind(shape, np.dtype(dtype))


def _mirrored(modes, width):
    """Groups of wavenumbers, each closed under k -> -k modulo `modes`, as tuples of slices."""
    yield (slice(0, 1),)
    start = 1
    while 2 * (start + width) <= modes:
        yield slice(start, start + width), slice(modes - start - width + 1, modes - start + 1)
        start += width
    if start <= modes - start:
        yield (slice(start, modes - start + 1),)


def _plan(source, target, direction):
    return pyfftw.FFTW(source, target, axes=(1,), direction=direction, flags=_FLAGS, threads=1)


def _stride(n):
    """Padded length of a row: aligned for vector instructions, and no multiple of 1 kB."""
    stride = -(-n // 8) * 8
    return stride + 8 if stride % 128 == 0 else stride


def _pad(block, rows):
    """Copy a block into the first of the rows of a buffer, with zeros to their end."""
    count, width = block.shape
    rows[:count, :width] = block
    rows[:count, width:] = 0


def _blocks(rows, size):
    """Blocks of rows, each with its index: a slice (no copy) where they follow one another."""
    for start in range(0, rows.size, size):
        block = rows[start : start + size]
        first, last = int(block[0]), int(block[-1])
        yield block, slice(first, last + 1) if last - first + 1 == block.size else block
