"""Probe one component of the library at the extremes of its parameters."""

import logging
from collections import Counter

import numpy as np
import xarray as xr

from common.job import start
from stability.components import COMPONENTS, LABELS, OUTCOMES, probe_point
from stickiness import datasets

LONGEST = 160  # characters of a message that are kept


def main(job):
    name = job.wildcards.component
    dataset = map_validity(COMPONENTS[name])
    counts = Counter(OUTCOMES[k] for k in dataset.outcome.values)
    logging.info("%s: %d points, %s", name, dataset.sizes["point"], dict(counts))
    title = f"validity of {name} over its parameters"
    parameters = {"component": name, "outcomes": list(OUTCOMES), **counts}
    datasets.write(dataset, job.output[0], title=title, parameters=parameters)


def map_validity(component):
    """Probe every point of a component."""
    points, results = component.points(), []
    for point in points:
        results.append(probe_point(component, point))
        if results[-1].outcome:
            logging.info("%s: %s: %s", point, OUTCOMES[results[-1].outcome], results[-1].text)
    data = {name: ("point", [float(p[name]) for p in points]) for name in component.values}
    data["variant"] = ("point", [p.get("variant", "") for p in points])
    data["outcome"] = ("point", np.array([r.outcome for r in results], dtype="i1"))
    data["excess"] = ("point", [r.excess if np.isfinite(r.excess) else np.nan for r in results])
    data["text"] = ("point", [" ".join(r.text.split())[:LONGEST] for r in results])
    return datasets.annotate(
        xr.Dataset(data),
        **{name: ("1", LABELS[name]) for name in component.values},
        variant=("1", "kind of theory, law or layer"),
        outcome=("1", ", ".join(f"{k} {name}" for k, name in enumerate(OUTCOMES))),
        excess=("1", "largest error over what passes for right", "no finite result"),
        text=("1", "the message, or the check whose error is largest"),
    )


if __name__ == "__main__":
    main(start(globals(), "probe_stability", component="spectrum"))
