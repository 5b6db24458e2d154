"""Moments of a simulated approach and separation that pictures name."""

import numpy as np


def moments(dataset):
    """Indices of the states at four moments, by their names, in the order of time.

    Unloaded on approach, if that occurs; squeezed; pull-off; the last contact.
    """
    tension = dataset.mean_traction.values
    back = np.flatnonzero(dataset.separating.values)
    there = np.flatnonzero(dataset.separating.values == 0)
    attracted = there[tension[there] > 0]
    around = np.arange(attracted[-1], min(attracted[-1] + 2, len(there))) if attracted.size else []
    touching = back[dataset.contact_area.values[back] > 0]
    found = {
        "unloaded": int(min(around, key=lambda index: abs(tension[index]), default=-1)),
        "squeezed": int(there[-1]),
        "pull-off": int(back[np.argmax(tension[back])]),
        "last contact": int(touching[-1]) if touching.size else -1,
    }
    return {name: index for name, index in found.items() if index >= 0}
