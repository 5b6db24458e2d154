"""Blocked convolutions of a real periodic field with an even kernel.

The transform of a large grid is bound by memory, not by arithmetic. Rows are therefore transformed
a block at a time, then a few wavenumbers at a time along the other axis, multiplied by the symbol
of the kernel and transformed back while they are in cache. Rows that hold nothing, or of which
nothing is wanted, are left out. Threads share the blocks (`sharing`).

All plans are made with ``FFTW_ESTIMATE``: by timing, last bits would depend on a busy machine.
"""

import threading
from functools import partial
from types import SimpleNamespace
from weakref import WeakValueDictionary

import numpy as np
import pyfftw

from stickiness.compiled import compiled
from stickiness.repulsive import sharing

_FLAGS = ("FFTW_ESTIMATE", "FFTW_DESTROY_INPUT")
_ROWS = 64  # rows transformed at a time along axis 1
_STRIP = 2**12  # numbers transformed at a time along axis 0 on either side of a mirror: 32 kB
_CACHED = 2**14  # complex numbers transformed at a time along axis 0: 256 kB
_ALIGNED = 64  # bytes
_U = np.uint64  # an index that cannot be negative: the compiler need not check


class _Count(threading.local):
    """Points of all convolutions of this thread so far."""

    points = 0


COUNT = _Count()


class _Spectra(threading.local):
    """Memory of the spectra of this thread's convolutions, by shape, while any of them lives."""

    def __init__(self):
        self.memory = WeakValueDictionary()


_SPECTRA = _Spectra()


class _Convolution:
    """Transforms of blocks of rows, into a `_spectrum` that subclasses multiply by the symbol."""

    _packed = False

    def __init__(self, shape, dtype, modes):
        self.shape, self._dtype, self._modes = shape, dtype, modes
        self._numbers = np.result_type(dtype, np.complex64)
        self._rows = min(shape[0], _ROWS)
        self._benches = {}  # one for each of the threads that share the work

    def _padded(self, rows, columns):
        return pyfftw.zeros_aligned((rows, _stride(columns)), self._numbers)

    def _share_spectrum(self, rows, columns):
        """Spectrum in memory of all convolutions of this shape: none uses it between calls."""
        size = rows * _stride(columns) * self._numbers.itemsize
        memory = _SPECTRA.memory.get(self.shape)
        if memory is None or memory.size < size:
            memory = _SPECTRA.memory[self.shape] = aligned_zeros(size, np.uint8)
        self._memory = memory  # a view would not keep it, but what it is a view of
        self._flat = memory[:size].view(self._numbers)
        return self._flat.reshape(rows, -1)

    def apply(self, symbol, field, out, rows_in=None, rows_out=None):
        """Convolve `field` into `out`, be it the same array, with what `symbol` returned.

        `rows_in`, `rows_out`: increasing indices of the rows that are not zero, and of those
        wanted, all by default. Both arrays may be the corner of the grid that holds these rows:
        `field` is zero beyond, and `out` gets no more.
        """
        COUNT.points += self.shape[0] * self.shape[1]
        rows_in = np.arange(len(field)) if rows_in is None else rows_in
        rows_out = np.arange(len(out)) if rows_out is None else rows_out
        if rows_in.size < self.shape[0]:
            sharing.evaluate(lambda: 0, self._flat)
        self._share(partial(self._forward, field), self._blocks(field, rows_in))
        self._share(partial(self._multiply, symbol), self._parts)
        self._share(partial(self._backward, out), self._blocks(out, rows_out))
        for bench in self._benches.values():  # whose plans would keep the fields in memory
            bench.rows_forward.update_arrays(bench.buffer, bench.half)
            bench.rows_backward.update_arrays(bench.half, bench.buffer)

    def _share(self, work, parts):
        def do(worker, part):
            if worker not in self._benches:
                self._benches[worker] = self._make_bench()
            work(self._benches[worker], part)

        sharing.share(do, parts, self.shape[0] * self.shape[1])

    def _make_bench(self):
        """Buffers and plans of one thread."""
        bench = SimpleNamespace(
            real=pyfftw.zeros_aligned((self._rows, self.shape[1]), self._dtype),
            half=self._padded(self._rows, self._modes)[:, : self._modes],
        )
        bench.buffer = bench.real.view(self._numbers) if self._packed else bench.real
        bench.rows_forward = _plan(bench.buffer, bench.half, "FFTW_FORWARD")
        bench.rows_backward = _plan(bench.half, bench.buffer, "FFTW_BACKWARD")
        return bench

    def _forward(self, field, bench, block):
        span, count, direct = block
        if direct:
            _run(bench.rows_forward, field[span].view(self._numbers), self._by_rows[span])
            return
        width = field.shape[1]
        bench.real[:count, :width] = field[span]
        bench.real[:count, width:] = 0
        _run(bench.rows_forward, bench.buffer, bench.half)
        self._by_rows[span] = bench.half[:count]

    def _backward(self, out, bench, block):
        span, count, direct = block
        if direct:
            _run(bench.rows_backward, self._by_rows[span], out[span].view(self._numbers))
            return
        bench.half[:count] = self._by_rows[span]
        _run(bench.rows_backward, bench.half, bench.buffer)
        out[span] = bench.real[:count, : out.shape[1]]

    def _blocks(self, field, rows):
        """Index of each block of rows, its size, and whether FFTW may work on it where it is."""
        step = field.strides[0]
        usable = self._packed and field.flags.c_contiguous and field.dtype == self._dtype
        usable = usable and field.shape == self.shape and field.ctypes.data % _ALIGNED == 0
        usable = usable and step * self._rows % _ALIGNED == 0
        for start in range(0, rows.size, self._rows):
            block = rows[start : start + self._rows]
            first, last = int(block[0]), int(block[-1])
            together, whole = last - first + 1 == block.size, block.size == self._rows
            direct = usable and together and whole and first * step % _ALIGNED == 0
            # A slice copies nothing.
            yield slice(first, last + 1) if together else block, block.size, direct


class Real(_Convolution):
    """Convolution on any grid; the spectrum is stored transposed."""

    def __init__(self, shape, dtype):
        n0, modes = shape[0], shape[1] // 2 + 1
        super().__init__(shape, dtype, modes)
        self._strip = max(1, min(modes, _CACHED // n0))
        self._spectrum = self._share_spectrum(-(-modes // self._strip) * self._strip, n0)[:, :n0]
        self._by_rows = self._spectrum[:modes].T
        starts = range(0, self._spectrum.shape[0], self._strip)
        self._parts = [slice(start, start + self._strip) for start in starts]

    def symbol(self, values):
        """Prepare a symbol for `apply`: normalised values ``(n1 // 2 + 1, n0 // 2 + 1)``.

        It is even along both axes, so that these are the wave numbers that are not negative.
        """
        padded = np.zeros((self._spectrum.shape[0], values.shape[1]), self._dtype)
        padded[: values.shape[0]] = values
        return padded

    def _make_bench(self):
        bench = super()._make_bench()
        bench.work = pyfftw.zeros_aligned((self._strip, self.shape[0]), self._numbers)
        first = self._spectrum[: self._strip]
        bench.columns_forward = _plan(first, bench.work, "FFTW_FORWARD")
        bench.columns_backward = _plan(bench.work, first, "FFTW_BACKWARD")
        return bench

    def _multiply(self, symbol, bench, strip):
        self._spectrum[max(strip.start, self._modes) : strip.stop] = 0
        _run(bench.columns_forward, self._spectrum[strip], bench.work)
        _scale(symbol[strip], bench.work.view(self._dtype))
        _run(bench.columns_backward, bench.work, self._spectrum[strip])


class Packed(_Convolution):
    """Convolution for an even number of columns, by transforms of complex rows of half the width.

    Neighbours along a row are the real and the imaginary part (Cooley, Lewis and Welch, J. Sound
    Vib. 12:315, 1970): transforms of complex numbers make better use of vector instructions. With
    ``z = p[:, ::2] + i p[:, 1::2]`` the convolution of p with the symbol S is ``z'_k = a z_k + i b
    conj(z_-k)`` where ``a = s - d sin t``, ``b = d cos t``, s and d are half the sum and half the
    difference of S at k and at k + n1/2, and ``t = 2 pi k1 / n1``.
    """

    _packed = True

    def __init__(self, shape, dtype):
        n0, modes = shape[0], shape[1] // 2
        super().__init__(shape, dtype, modes)
        groups = list(_mirrored(modes, max(8, _STRIP // n0)))
        self._widest = max(group.size for group in groups)
        ends = np.cumsum([group.size for group in groups]).tolist()  # of their rows in a symbol
        self._parts = [
            (group, slice(end - group.size, end)) for group, end in zip(groups, ends, strict=True)
        ]
        self._spectrum = self._share_spectrum(-(-n0 // 8) * 8, modes)
        self._by_rows = self._spectrum[:, :modes]

    def _make_bench(self):
        bench = super()._make_bench()
        n0 = self.shape[0]
        before, after, product = (self._padded(self._widest, n0) for _ in range(3))
        bench.columns_forward = _plan(before[:, :n0], after[:, :n0], "FFTW_FORWARD")
        bench.columns_backward = _plan(product[:, :n0], before[:, :n0], "FFTW_BACKWARD")
        bench.before, bench.after, bench.product = before, after, product
        return bench

    def symbol(self, values):
        """Prepare a symbol, as `Real.symbol` does."""
        modes, half = values.shape[0] - 1, values.shape[1]
        direct = np.empty((modes, half), self._dtype)
        crossed = np.empty((modes, half), self._dtype)
        # Half the sum, half the difference, and twice for a transform of half the points.
        for group, rows in self._parts:
            angle = np.pi * group[:, None] / modes
            difference = values[group] - values[modes - group]
            direct[rows] = values[group] + values[modes - group] - difference * np.sin(angle)
            crossed[rows] = difference * np.cos(angle)
        return direct, crossed

    def _multiply(self, symbol, bench, part):
        group, rows = part
        # Numbers that are only moved count as real ones of their size.
        spectrum, strip = self._spectrum.view(float), bench.before.view(float)
        _turn(spectrum, group, strip, False)
        bench.columns_forward.execute()
        factors = (factor[rows] for factor in symbol)
        _combine(*factors, bench.after, bench.product, self.shape[0])
        bench.columns_backward.execute()
        _turn(spectrum, group, strip, True)


@compiled
def _scale(symbol, values):
    """Multiply rows of complex numbers, real and imaginary parts in turn, by a symbol."""
    rows, half = symbol.shape
    n = values.shape[1] // 2
    for r in range(rows):
        for k in range(half):
            values[r, 2 * k] *= symbol[r, k]
            values[r, 2 * k + 1] *= symbol[r, k]
        for k in range(half, n):
            values[r, 2 * k] *= symbol[r, n - k]
            values[r, 2 * k + 1] *= symbol[r, n - k]


@compiled
def _turn(spectrum, group, strip, back):
    """Copy columns of a group into rows, or `back`, a cache line of each at a time."""
    for start in range(0, spectrum.shape[0], 8):
        for r in range(group.size):
            for k in range(8):
                at, column = _U(start + k), _U(group[r])
                if back:
                    spectrum[at, column] = strip[r, at]
                else:
                    strip[r, at] = spectrum[at, column]


@compiled
def _combine(direct, crossed, values, product, n):
    """``a z_k + i b conj(z_-k)`` of the first n numbers of the first rows of a group.

    A group is closed under k -> -k: its rows mirror one another in reverse.
    """
    rows, half = direct.shape
    for r in range(rows):
        a, b, z, back, out = direct[r], crossed[r], values[r], values[rows - 1 - r], product[r]
        mirror = back[0]
        for k in range(n):
            if k > 0:
                mirror = back[_U(n - k)]
            at = _U(k if k < half else n - k)
            out[k] = complex(
                a[at] * z[k].real + b[at] * mirror.imag, a[at] * z[k].imag + b[at] * mirror.real
            )


def aligned_zeros(size, dtype):
    """Field of zeros that transforms may work on where it is."""
    return pyfftw.zeros_aligned(size, dtype, n=_ALIGNED)


def choose(shape, dtype):
    """Convolution for a grid: `Packed` in single precision and an even number of columns."""
    kind = Packed if dtype == np.float32 and shape[1] % 2 == 0 else Real
    return kind(shape, np.dtype(dtype))


def _mirrored(modes, width):
    """Groups of wavenumbers closed under k -> -k modulo `modes`; each is the mirror of its end."""
    yield np.array([0])
    start = 1
    while 2 * (start + width) <= modes:
        first = np.arange(start, start + width)
        yield np.concatenate([first, modes - first[::-1]])
        start += width
    if start <= modes - start:
        yield np.arange(start, modes - start + 1)


def _plan(source, target, direction):
    return pyfftw.FFTW(source, target, axes=(1,), direction=direction, flags=_FLAGS, threads=1)


def _run(plan, source, target):
    plan.update_arrays(source, target)
    plan.execute()


def _stride(n):
    """Padded length of a row: aligned for vector instructions, and no multiple of 1 kB."""
    stride = -(-n // 8) * 8
    return stride + 8 if stride % 128 == 0 else stride
