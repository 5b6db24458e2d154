"""Probe one component of the library at the extremes of its parameters."""

import logging
import signal
import traceback
import warnings
from collections import Counter
from contextlib import contextmanager
from itertools import product
from pathlib import Path

import numpy as np
import xarray as xr

import stickiness
from common.job import start
from stability.components import COMPONENTS
from stickiness import datasets
from stickiness.plausibility import PlausibilityWarning
from stickiness.repulsive.solver import ConvergenceError

OUTCOMES = ("right", "refused", "not converged", "failed")
RIGHT, REFUSED, UNCONVERGED, FAILED = range(4)
TIME_LIMIT = 30  # seconds of computing for a point; most take less than 0.1


def main(job):
    name = job.wildcards.component
    probe, values = COMPONENTS[name]
    dataset = map_validity(probe, values)
    counts = Counter(OUTCOMES[k] for k in dataset.outcome.values.flat)
    logging.info("%s: %d points, %s", name, dataset.outcome.size, dict(counts))
    title = f"validity of {name} over its parameters"
    parameters = {"component": name, "outcomes": list(OUTCOMES), **counts}
    datasets.write(dataset, job.output[0], title=title, parameters=parameters)


def map_validity(probe, values):
    """Probe every combination of the values of the parameters."""
    results = []
    for combination in product(*values.values()):
        point = dict(zip(values, combination, strict=True))
        outcome, excess, text = probe_point(probe, **point)
        results.append((outcome, excess, text))
        if outcome != RIGHT:
            logging.info("%s: %s: %s", point, OUTCOMES[outcome], text)
    shape = [len(each) for each in values.values()]
    columns = (np.reshape(column, shape) for column in zip(*results, strict=True))
    data = {name: ([*values], column) for name, column in zip(RESULTS, columns, strict=True)}
    dataset = xr.Dataset(data, coords={name: list(each) for name, each in values.items()})
    dataset["outcome"] = dataset.outcome.astype("i1")
    longest = 160  # characters of a message that are kept
    dataset["text"] = dataset.text.str.replace(r"\s+", " ").str.slice(0, longest)
    labels_of_parameters = {
        "magnification": "magnification q1/q0",
        "hurst": "Hurst exponent",
        "pressure": "mean pressure over E* q0 h_rms",
        "range_over_h_rms": "range over h_rms",
        "adhesion_length_over_range": "adhesion length over range",
        "thickness": "thickness of a layer times q0",
        "poisson": "Poisson's ratio of a layer",
        "grid": "grid points a side",
        "variant": "kind of theory, law or layer",
    }
    labels = {name: ("1", labels_of_parameters[name]) for name in values}
    dataset = datasets.annotate(dataset, **RESULTS, **labels)
    dataset.outcome.attrs |= datasets.flags(OUTCOMES)
    return dataset


RESULTS = {
    "outcome": ("1", "worst outcome of all comparisons"),
    "excess": ("1", "largest error over what passes for right", "no finite result"),
    "text": ("1", "the message, or the check whose error is largest"),
}


@contextmanager
def stopped_after(seconds):
    """Stop what takes more processor time, on systems that have a timer for it: not on Windows."""

    def expire(*_):
        raise TimeoutError(f"took more than {seconds:g} s")

    if not hasattr(signal, "setitimer"):
        yield
        return
    before = signal.signal(signal.SIGPROF, expire)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)


def probe_point(probe, **point):
    """Outcome of one point, its largest error over the tolerance, and a message or a check."""
    try:
        with stopped_after(TIME_LIMIT), warnings.catch_warnings():
            warnings.simplefilter("error")
            warnings.simplefilter("ignore", PlausibilityWarning)  # coarse grids are the point
            names, excess = zip(*probe(**point), strict=True)
    except ConvergenceError as error:  # of adhesive contact, too
        return UNCONVERGED, np.nan, str(error)
    except Exception as error:  # whatever it is belongs on the map
        *_, last = traceback.extract_tb(error.__traceback__)
        in_library = Path(last.filename).is_relative_to(Path(stickiness.__file__).parent)
        outcome = REFUSED if isinstance(error, ValueError) and in_library else FAILED
        return outcome, np.nan, f"{type(error).__name__}: {error}"
    # A NaN must not hide behind a comparison that is false.
    excess = np.where(np.isfinite(excess), excess, np.inf)
    worst = int(np.argmax(excess))
    outcome = RIGHT if excess[worst] <= 1 else FAILED
    return outcome, excess[worst] if np.isfinite(excess[worst]) else np.nan, names[worst]


if __name__ == "__main__":
    main(start(globals()))
