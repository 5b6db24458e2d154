"""Probe one component of the library over its grid of parameters: right, refused or failed."""

import logging
from collections import Counter

import numpy as np
import xarray as xr

from common.job import start
from stability.adhesion_components import ADHESION
from stability.components import AXES, OUTCOMES, probe_point
from stability.contact_components import CONTACT
from stability.direction_components import DIRECTION
from stability.inputs_components import INPUTS
from stability.layer_contact_components import LAYER_CONTACT
from stability.layers_components import LAYERS
from stability.theory_components import THEORY
from stability.verdicts_components import VERDICTS
from stickiness import datasets

COMPONENTS = THEORY | INPUTS | CONTACT | ADHESION | VERDICTS | LAYERS | LAYER_CONTACT | DIRECTION
LONGEST = 160  # characters of a message that are kept


def main(job):
    name = job.wildcards.component
    component = COMPONENTS[name]
    dataset = map_validity(component)
    counts = Counter(OUTCOMES[k] for k in dataset.outcome.values)
    logging.info("%s: %d points, %s", name, dataset.sizes["point"], dict(counts))
    datasets.write(
        dataset,
        job.output[0],
        title=f"validity of {name} over its parameters",
        parameters={
            "component": name,
            "outcomes": list(OUTCOMES),
            "pairs": [list(pair) for pair in component.pairs or []] or "all",
            **counts,
        },
    )


def map_validity(component):
    """Every point of a component with its outcome."""
    points = component.points()
    results = []
    for point in points:
        results.append(probe_point(component, point))
        if results[-1].outcome:
            logging.info("%s: %s: %s", point, OUTCOMES[results[-1].outcome], results[-1].text)
    data = {name: ("point", [float(p[name]) for p in points]) for name in component.axes}
    data["variant"] = ("point", [p.get("variant", "") for p in points])
    data["outcome"] = ("point", np.array([r.outcome for r in results], dtype="i1"))
    data["excess"] = ("point", [r.excess if np.isfinite(r.excess) else np.nan for r in results])
    data["text"] = ("point", [" ".join(r.text.split())[:LONGEST] for r in results])
    return datasets.annotate(
        xr.Dataset(data),
        **{name: ("1", AXES[name].label) for name in component.axes},
        variant=("1", "kind of theory, law or control"),
        outcome=("1", ", ".join(f"{k} {name}" for k, name in enumerate(OUTCOMES))),
        excess=("1", "largest error over what passes for right", "no finite result"),
        text=("1", "what was said, or the check whose error is largest"),
    )


if __name__ == "__main__":
    main(start(globals(), "probe_stability", component="spectrum"))
