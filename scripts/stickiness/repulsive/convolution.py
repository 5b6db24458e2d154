"""Convolutions of a real periodic field with an even kernel.

A small grid is transformed at once. The transform of a large one is bound by memory, not by
arithmetic. Its rows are therefore transformed a block at a time, then a few wavenumbers at a time
along the other axis, multiplied by the symbol of the kernel and transformed back while they are in
cache. Rows that hold nothing, or of which nothing is wanted, are left out. Threads share the blocks
(`sharing`).

All plans are made with ``FFTW_ESTIMATE``: by timing, last bits would depend on a busy machine.
"""

import threading
from functools import partial
from itertools import product
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
# Points up to which a transform of the whole grid takes less time than blocks, packed or not.
_SMALL_PACKED = 2**15
_SMALL = 2**17
_U = np.uint64  # an index that cannot be negative: the compiler need not check


class _OfThread(threading.local):
    """Points of all convolutions of this thread so far, and memory of their spectra by shape."""

    def __init__(self):
        self.points = 0
        self.memory = WeakValueDictionary()


_OF_THREAD = _OfThread()


def count_points():
    """Points of all convolutions of this thread so far: differences measure its work."""
    return _OF_THREAD.points


def convolution(shape, dtype, mirrored=False):
    """Convolution on one grid, in single or double precision: mirrored, at once or in blocks."""
    if mirrored:
        return MirroredConvolution(shape, dtype)
    most_points = _SMALL_PACKED if _is_packed(shape, dtype) else _SMALL
    if shape[0] * shape[1] <= most_points:
        return WholeConvolution(shape, dtype)
    return BlockedConvolution(shape, dtype)


def _is_packed(shape, dtype):
    """Whether blocks take neighbours along a row for one complex number."""
    return dtype == np.float32 and shape[1] % 2 == 0


class WholeConvolution:
    """Convolution on a small grid, which is transformed at once."""

    def __init__(self, shape, dtype):
        self.shape = shape
        self._field = pyfftw.zeros_aligned(shape, dtype, n=_ALIGNED)
        numbers = np.result_type(dtype, np.complex64)
        self._spectrum = pyfftw.zeros_aligned((shape[0], shape[1] // 2 + 1), numbers, n=_ALIGNED)
        self._forward = _plan(self._field, self._spectrum, "FFTW_FORWARD", axes=(0, 1))
        self._backward = _plan(self._spectrum, self._field, "FFTW_BACKWARD", axes=(0, 1))

    def symbol(self, values):
        """Prepare a symbol for `apply`: normalised values ``(n1 // 2 + 1, n0 // 2 + 1)``.

        It is even along both axes, so that these are the wave numbers that are not negative.
        """
        not_negative = values.T
        negative = not_negative[(self.shape[0] - 1) // 2 : 0 : -1]
        both = [not_negative, negative]
        return np.concatenate(both, dtype=self._field.dtype, casting="same_kind")

    def apply(self, symbol, field, out, rows_in=None, rows_out=None):
        """Convolve `field` into `out`, as `BlockedConvolution.apply` does.

        `rows_in` saves nothing here: the field must be zero in all other rows.
        """
        _OF_THREAD.points += self.shape[0] * self.shape[1]
        if field.shape != self.shape:  # a corner, with nothing beyond
            self._field[...] = 0
        self._field[: field.shape[0], : field.shape[1]] = field
        # Multiply the spectrum by the symbol.
        self._forward.execute()
        self._spectrum *= symbol
        self._backward.execute()
        # Hand out the rows that are wanted.
        image = self._field[: out.shape[0], : out.shape[1]]
        if rows_out is None or rows_out.size == len(out):
            out[...] = image
        else:
            out[rows_out] = image[rows_out]


class MirroredConvolution:
    """Convolution of fields that go on as their mirror images at every side.

    The cosine transform X of a field is a Fourier transform V of its even points followed by the
    odd ones in reverse (Makhoul, IEEE Trans. Acoust. 28:27, 1980, doi 10.1109/TASSP.1980.1163351):
    along one axis ``2 X_k = e V_k + conj(e V_k)`` with ``e = exp(-i t)``, ``t = pi k / (2 n)``. So
    the convolution with the symbol S is ``V'_k = s V_k + d exp(2 i t) V_-k`` where s and d are half
    the sum and half the difference of S at k and at n - k, and S is 0 at n.
    """

    def __init__(self, shape, dtype):
        self.shape = shape
        self._points = pyfftw.zeros_aligned(shape, dtype, n=_ALIGNED)
        numbers = np.result_type(dtype, np.complex64)
        self._spectrum = pyfftw.zeros_aligned((shape[0], shape[1] // 2 + 1), numbers, n=_ALIGNED)
        self._forward = _plan(self._points, self._spectrum, "FFTW_FORWARD", axes=(0, 1))
        self._backward = _plan(self._spectrum, self._points, "FFTW_BACKWARD", axes=(0, 1))
        # Places of points: the first half of an axis has the even ones.
        first = [slice(0, (n + 1) // 2) for n in shape]
        rest = [slice(n, (n + 1) // 2 - 1, -1) for n in shape]
        even, odd = slice(0, None, 2), slice(1, None, 2)
        axes = [((one, even), (other, odd)) for one, other in zip(first, rest, strict=True)]
        self._in_order = [tuple(zip(*places, strict=True)) for places in product(*axes)]
        self._opposite = -np.arange(shape[0]) % shape[0]  # rows of opposite wave numbers

    def symbol(self, values):
        """Prepare a symbol for `apply`: normalised values ``(n1, n0)`` of cosine waves."""
        symbol = np.pad(values.T, (0, 1))
        rows, columns = self._spectrum.shape
        turn0 = np.exp(1j * np.pi / rows * np.arange(rows))[:, None]
        turn1 = np.exp(1j * np.pi / self.shape[1] * np.arange(columns))

        def combine(sign0, sign1):
            """Half the sums or differences along both axes."""
            along0 = symbol + sign0 * symbol[::-1]
            return (along0 + sign1 * along0[:, ::-1])[:rows, :columns] / 4

        numbers = self._spectrum.dtype
        return (
            combine(1, 1).astype(self._points.dtype),
            (turn0 * combine(-1, 1)).astype(numbers),
            (turn1 * combine(1, -1)).astype(numbers),
            (turn0 * turn1 * combine(-1, -1)).astype(numbers),
        )

    def apply(self, symbol, field, out, rows_in=None, rows_out=None):
        """Convolve `field` into `out`, both of all rows, whatever `rows_in` and `rows_out` are."""
        _OF_THREAD.points += self.shape[0] * self.shape[1]
        for ours, theirs in self._in_order:
            self._points[ours] = field[theirs]
        self._forward.execute()
        # Opposite waves along axis 1 are not kept: they are conjugate to those opposite along both.
        waves = self._spectrum
        opposite0 = waves[self._opposite]
        opposite = np.conj(waves)
        opposite1 = np.conj(opposite0)
        weight, *weights = symbol
        waves *= weight
        for others, weight in zip((opposite0, opposite1, opposite), weights, strict=True):
            others *= weight
            waves += others
        self._backward.execute()
        for ours, theirs in self._in_order:
            out[theirs] = self._points[ours]


class BlockedConvolution:
    """Convolution on a large grid, of which a block at a time is transformed.

    An even number of columns in single precision is *packed*: neighbours along a row are the real
    and the imaginary part (Cooley, Lewis and Welch, J. Sound Vib. 12:315, 1970), as transforms of
    complex numbers make better use of vector instructions. With ``z = p[:, ::2] + i p[:, 1::2]``
    the convolution of p with the symbol S is ``z'_k = a z_k + i b conj(z_-k)`` where ``a = s - d
    sin t``, ``b = d cos t``, s and d are half the sum and half the difference of S at k and at k +
    n1/2, and ``t = 2 pi k1 / n1``.
    """

    def __init__(self, shape, dtype):
        self.shape = shape
        self._dtype = np.dtype(dtype)
        self._packed = _is_packed(shape, self._dtype)
        self._modes = shape[1] // 2 + (not self._packed)
        self._numbers = np.result_type(dtype, np.complex64)
        self._rows = min(shape[0], _ROWS)
        self._benches = {}  # one for each of the threads that share the work
        group_columns = _mirrored if self._packed else _consecutive
        groups = list(group_columns(self._modes, shape[0]))
        self._widest = max(group.size for group in groups)
        ends = np.cumsum([group.size for group in groups]).tolist()  # of their rows in a symbol
        self._parts = [
            (group, slice(end - group.size, end)) for group, end in zip(groups, ends, strict=True)
        ]
        # Convolutions of a shape share the memory of their spectra: none uses it between calls.
        rows = -(-shape[0] // 8) * 8
        size = rows * _stride(self._modes) * self._numbers.itemsize
        memory = _OF_THREAD.memory.get(shape)
        if memory is None or memory.size < size:
            memory = _OF_THREAD.memory[shape] = aligned_zeros(size, np.uint8)
        self._memory = memory  # a view would not keep it, but what it is a view of
        self._flat = memory[:size].view(self._numbers)
        self._spectrum = self._flat.reshape(rows, -1)
        # Numbers of 8 bytes are moved as if they were real.
        self._moved = self._spectrum.view(float if self._numbers == np.complex64 else complex)

    def symbol(self, values):
        """Prepare a symbol for `apply`: normalised values ``(n1 // 2 + 1, n0 // 2 + 1)``.

        It is even along both axes, so that these are the wave numbers that are not negative.
        """
        if not self._packed:
            return np.ascontiguousarray(values, self._dtype)
        direct = np.empty((self._modes, values.shape[1]), self._dtype)
        crossed = np.empty_like(direct)
        # Half the sum, half the difference, and twice for a transform of half the points.
        for group, rows in self._parts:
            angle = np.pi * group[:, None] / self._modes
            difference = values[group] - values[self._modes - group]
            direct[rows] = values[group] + values[self._modes - group] - difference * np.sin(angle)
            crossed[rows] = difference * np.cos(angle)
        return direct, crossed

    def apply(self, symbol, field, out, rows_in=None, rows_out=None):
        """Convolve `field` into `out`, be it the same array, with what `symbol` returned.

        `rows_in`, `rows_out`: increasing indices of the rows that are not zero, and of those
        wanted, all by default. Both arrays may be the corner of the grid that holds these rows:
        `field` is zero beyond, and `out` gets no more.
        """
        _OF_THREAD.points += self.shape[0] * self.shape[1]
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
        n0, n1 = self.shape
        bench = SimpleNamespace(
            real=pyfftw.zeros_aligned((self._rows, n1), self._dtype),
            half=self._padded(self._rows, self._modes)[:, : self._modes],
            before=self._padded(self._widest, n0),
            after=self._padded(self._widest, n0),
        )
        bench.moved = bench.before.view(self._moved.dtype)
        bench.product = self._padded(self._widest, n0) if self._packed else bench.after
        bench.buffer = bench.real.view(self._numbers) if self._packed else bench.real
        bench.rows_forward = _plan(bench.buffer, bench.half, "FFTW_FORWARD")
        bench.rows_backward = _plan(bench.half, bench.buffer, "FFTW_BACKWARD")
        bench.columns_forward = _plan(bench.before[:, :n0], bench.after[:, :n0], "FFTW_FORWARD")
        bench.columns_backward = _plan(bench.product[:, :n0], bench.before[:, :n0], "FFTW_BACKWARD")
        return bench

    def _padded(self, rows, columns):
        return pyfftw.zeros_aligned((rows, _stride(columns)), self._numbers)

    def _forward(self, field, bench, block):
        span, count, direct = block
        if direct:
            _run(
                bench.rows_forward,
                field[span].view(self._numbers),
                self._spectrum[span, : self._modes],
            )
            return
        width = field.shape[1]
        bench.real[:count, :width] = field[span]
        bench.real[:count, width:] = 0
        _run(bench.rows_forward, bench.buffer, bench.half)
        self._spectrum[span, : self._modes] = bench.half[:count]

    def _backward(self, out, bench, block):
        span, count, direct = block
        if direct:
            _run(
                bench.rows_backward,
                self._spectrum[span, : self._modes],
                out[span].view(self._numbers),
            )
            return
        bench.half[:count] = self._spectrum[span, : self._modes]
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
            first = int(block[0])
            last = int(block[-1])
            together = last - first + 1 == block.size
            whole = block.size == self._rows
            direct = usable and together and whole and first * step % _ALIGNED == 0
            # A slice copies nothing.
            yield slice(first, last + 1) if together else block, block.size, direct

    def _multiply(self, symbol, bench, part):
        group, rows = part
        _turn(self._moved, group, bench.moved, False)
        bench.columns_forward.execute()
        if self._packed:
            direct, crossed = symbol
            _combine(direct[rows], crossed[rows], bench.after, bench.product, self.shape[0])
        else:
            n = self.shape[0]
            half = symbol.shape[1]
            values = bench.after[: group.size]
            values[:, :half] *= symbol[rows]
            values[:, half:n] *= symbol[rows, n - half : 0 : -1]
        bench.columns_backward.execute()
        _turn(self._moved, group, bench.moved, True)


@compiled
def _turn(spectrum, group, strip, back):
    """Copy columns of a group into rows, or `back`, a cache line of each at a time."""
    for start in range(0, spectrum.shape[0], 8):
        for r in range(group.size):
            for k in range(8):
                row = _U(start + k)
                column = _U(group[r])
                if back:
                    spectrum[row, column] = strip[r, row]
                else:
                    strip[r, row] = spectrum[row, column]


@compiled
def _combine(direct, crossed, values, product, n):
    """``a z_k + i b conj(z_-k)`` of the first n numbers of the first rows of a group.

    A group is closed under k -> -k: its rows mirror one another in reverse.
    """
    rows, half = direct.shape
    for r in range(rows):
        for k in range(n):
            a = direct[r, k if k < half else n - k]
            b = crossed[r, k if k < half else n - k]
            z = values[r, k]
            mirror = values[rows - 1 - r, n - k if k > 0 else 0]
            product[r, k] = complex(a * z.real + b * mirror.imag, a * z.imag + b * mirror.real)


def aligned_zeros(size, dtype):
    """Field of zeros that transforms may work on where it is."""
    return pyfftw.zeros_aligned(size, dtype, n=_ALIGNED)


def _consecutive(modes, length):
    """Groups of columns of a given length that are transformed together."""
    width = max(1, _CACHED // length)
    return np.split(np.arange(modes), range(width, modes, width))


def _mirrored(modes, length):
    """The same, closed under k -> -k modulo `modes`; each is the mirror of its end."""
    width = max(8, _STRIP // length)
    start = 1
    yield np.array([0])
    while 2 * (start + width) <= modes:
        first = np.arange(start, start + width)
        yield np.concatenate([first, modes - first[::-1]])
        start += width
    if start <= modes - start:
        yield np.arange(start, modes - start + 1)


def _plan(source, target, direction, axes=(1,)):
    return pyfftw.FFTW(source, target, axes=axes, direction=direction, flags=_FLAGS, threads=1)


def _run(plan, source, target):
    plan.update_arrays(source, target)
    plan.execute()


def _stride(n):
    """Padded length of a row: aligned for vector instructions, and no multiple of 1 kB."""
    stride = -(-n // 8) * 8
    return stride + 8 if stride % 128 == 0 else stride
