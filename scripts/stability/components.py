"""Where in the space of parameters each part of the library is right, refuses, or fails.

A `Component` is probed at points of a grid. Each probe returns `Check`s, errors against something
that was obtained another way, and its outcome is one of `OUTCOMES`.
"""

from __future__ import annotations

import inspect
import re
import signal
import traceback
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import combinations, product
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

import stickiness
from stickiness import adhesive, criteria, dmt, equivalent_sphere
from stickiness import surface as synthesis
from stickiness.accuracy import choice, error_models, model_choice, multilevel, prediction
from stickiness.criteria import a_v_fit, a_v_table
from stickiness.measured import instrument_spectrum, psd, self_affine_fit, stitching
from stickiness.persson import theory
from stickiness.plausibility import PlausibilityWarning
from stickiness.remaining import prediction as remaining
from stickiness.repulsive import richardson, solver, subpixel
from stickiness.solids import layers, moduli
from stickiness.spectrum import direction, sums
from stickiness.spectrum import kinds as spectrum
from stickiness.spectrum.kinds import SelfAffine

RIGHT, REFUSED, UNCONVERGED, FAILED = range(4)
OUTCOMES = ("right", "refused", "not converged", "failed")
SCALED = 1e-9  # relative error allowed where only the unit or an overall factor differs
TIME_LIMIT = 30  # seconds of computing for a point; most take less than 0.1

_MODULES = (
    a_v_fit, a_v_table, adhesive, criteria, dmt, choice, direction, equivalent_sphere, error_models,
    instrument_spectrum, layers, model_choice, moduli, multilevel, prediction, psd, remaining,
    richardson, self_affine_fit, solver, spectrum, stitching, subpixel, sums, synthesis, theory,
)  # fmt: skip
_LIBRARY = Path(stickiness.__file__).parent


@dataclass(frozen=True)
class Axis:
    """A parameter, the values it is tried at and the one it has while others are."""

    label: str
    values: tuple[float, ...]
    reference: float


AXES = {
    "magnification": Axis("magnification q1/q0", (1.01, 2, 8, 64, 1e3, 1e6, 1e10), 64),
    "hurst": Axis("Hurst exponent", (0.05, 0.2, 0.5, 0.6, 0.8, 1.0), 0.8),
    "pressure": Axis(
        "mean pressure over E* q0 h_rms (on layers E*/S)",
        (1e-8, 1e-5, 1e-3, 0.03, 0.3, 3, 100, 1e6),
        0.03,
    ),
    "range_over_h_rms": Axis("range over h_rms", (1e-6, 1e-4, 1e-2, 0.3, 3, 30, 1e3), 0.3),
    "adhesion_length_over_range": Axis(
        "adhesion length over range (on layers of E*/S)", (1e-6, 1e-4, 1e-2, 0.1, 1, 10), 0.01
    ),
    "q0_h_rms": Axis("q0 times h_rms", (1e-9, 1e-6, 1e-3, 0.1, 1, 10), 0.1),
    "thickness": Axis(
        "thickness of a layer times q0", (1e-4, 1e-2, 0.1, 0.3, 1, 3, 30, 1e3, 1e4), 0.3
    ),
    "poisson": Axis("Poisson's ratio of a layer", (0, 0.3, 0.5), 0.5),
    "modulus_ratio": Axis(
        "modulus of the backing over that of the layer", (1e-6, 1e-3, 0.1, 1, 10, 1e3, 1e6), 0.1
    ),
    "anisotropy": Axis("ratio of correlation lengths", (1, 1 + 1e-6, 1.1, 2, 8, 100, 1e4), 2),
    "unit": Axis("1/q0 in units of length", (1e-9, 1e-6, 1e-3, 1, 1e3), 1),
    "grid": Axis("grid points a side", (2, 3, 4, 7, 16, 31, 32, 97, 128), 32),
    "frequency": Axis(
        "frequency times relaxation time",
        (1e-300, 1e-100, 1e-9, 1e-3, 0.1, 1, 30, 1e6, 1e100, 1e200, 1e300),
        1,
    ),
}


WIDE = {  # of closed forms, which no grid limits
    "range_over_h_rms": (1e-12, 1e-9, *AXES["range_over_h_rms"].values),
    "adhesion_length_over_range": (*AXES["adhesion_length_over_range"].values, 1e4, 1e7),
    "magnification": (1.001, *AXES["magnification"].values[1:]),
}


class Check(NamedTuple):
    """What was compared, its relative error and the largest that passes for right."""

    name: str
    error: float
    tolerance: float


def require(name: str, met: bool) -> Check:
    """Check of a condition."""
    return Check(name, float(not met), 0.5)


def compare(name: str, value, expected, tolerance: float = SCALED) -> Check:
    """Largest deviation of an array, relative to the largest of what is expected."""
    expected = np.asarray(expected, dtype=float)
    scale = float(np.max(np.abs(expected)))
    error = np.max(np.abs(np.asarray(value, dtype=float) - expected))
    return Check(name, float(error / scale) if scale > 0 else float(error), tolerance)


def compare_each(name: str, value, expected, tolerance: float = SCALED) -> Check:
    """Largest relative deviation of any element."""
    value, expected = np.asarray(value, dtype=float), np.asarray(expected, dtype=float)
    return Check(name, float(np.max(np.abs(value / expected - 1))), tolerance)


def model(
    hurst: float, magnification: float, q0_h_rms: float = 1.0, unit: float = 1.0
) -> SelfAffine:
    """Self-affine spectrum with 1/q0 = unit."""
    return SelfAffine(hurst=hurst, q0=1 / unit, q1=magnification / unit, h_rms=q0_h_rms * unit)


@dataclass(frozen=True)
class Component:
    """A part of the library and how it is probed.

    Attributes
    ----------
    probe : callable
        Takes the axes by name, and `variant` if there are any; returns checks.
    axes : sequence of str
        Names in `AXES`.
    pairs : sequence of (str, str), optional
        Axes that are tried together at all their values, the others at their reference; by default
        all pairs. An axis in no pair is tried alone.
    variants : sequence of str
        Kinds that are tried at every point.
    reference, values : mapping
        What differs from `AXES`.
    further : sequence of mapping
        Further points, by what they differ in from the reference.
    """

    probe: Callable[..., Iterable[Check]]
    axes: Sequence[str]
    pairs: Sequence[tuple[str, str]] | None = None
    variants: Sequence[str] = ()
    reference: Mapping[str, float] = field(default_factory=dict)
    values: Mapping[str, tuple[float, ...]] = field(default_factory=dict)
    further: Sequence[Mapping[str, float]] = ()

    def values_of(self, axis: str) -> tuple[float, ...]:
        """Values that an axis is tried at."""
        return tuple(self.values.get(axis, AXES[axis].values))

    def middle(self) -> dict[str, Any]:
        """The point that all others start from, of the first variant."""
        return self._reference() | ({"variant": self.variants[0]} if self.variants else {})

    def _reference(self) -> dict[str, float]:
        return {name: self.reference.get(name, AXES[name].reference) for name in self.axes}

    def points(self) -> list[dict[str, Any]]:
        """Every point once: the reference with one or two axes moved, for every variant."""
        reference = self._reference()
        pairs = combinations(self.axes, 2) if self.pairs is None else self.pairs
        moves = [
            dict(zip(moved, values, strict=True))
            for moved in [*pairs, *((name,) for name in self.axes)]
            for values in product(*map(self.values_of, moved))
        ]
        moves += self.further
        found = {tuple((reference | move).values()): reference | move for move in moves}
        if not self.variants:
            return list(found.values())
        return [p | {"variant": v} for p, v in product(found.values(), self.variants)]


class Result(NamedTuple):
    """Outcome of a point, its largest error over the tolerance, and what was said or compared."""

    outcome: int
    excess: float
    text: str


def probe_point(component: Component, point: Mapping[str, Any]) -> Result:
    """Outcome of one point."""
    try:
        with warnings.catch_warnings(), limit_time(TIME_LIMIT):
            warnings.simplefilter("error")
            warnings.simplefilter("ignore", PlausibilityWarning)  # coarse grids are the point
            checks = list(component.probe(**point))
    except solver.ConvergenceError as error:  # that of adhesive contact, too
        return Result(UNCONVERGED, np.nan, str(error))
    except Exception as error:  # whatever it is belongs on the map
        outcome = REFUSED if is_refusal(error) else FAILED
        return Result(outcome, np.nan, f"{type(error).__name__}: {error}")
    # A NaN must not hide behind a comparison that is false.
    excess = [c.error / c.tolerance if np.isfinite(c.error) else np.inf for c in checks]
    worst = int(np.argmax(excess))
    outcome = RIGHT if excess[worst] <= 1 else FAILED
    return Result(outcome, float(excess[worst]), checks[worst].name)


def is_refusal(error: Exception) -> bool:
    """Whether an error is the library's own and names an argument of its functions."""
    if not isinstance(error, ValueError):
        return False
    *_, last = traceback.extract_tb(error.__traceback__)
    words = set(re.findall(r"\w+", str(error)))
    return Path(last.filename).is_relative_to(_LIBRARY) and not words.isdisjoint(_ARGUMENTS)


def _list_arguments() -> Iterator[str]:
    """Names of all arguments of the library's public functions and classes."""
    for module in _MODULES:
        for name, value in vars(module).items():
            own = callable(value) and getattr(value, "__module__", "").startswith("stickiness")
            error = isinstance(value, type) and issubclass(value, Exception)
            if own and not error and not name.startswith("_"):
                yield from inspect.signature(value).parameters


# Less the words that any message may hold.
_ARGUMENTS = frozenset(_list_arguments()) - {"args", "error", "kwargs", "mean", "message", "value"}


@contextmanager
def limit_time(seconds: float) -> Iterator[None]:
    def expired(*_: Any) -> None:
        raise TimeoutError(f"took more than {seconds:g} s")

    before = signal.signal(signal.SIGPROF, expired)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)
