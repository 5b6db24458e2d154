"""Keep the gap and pressure fields of one realisation in adhesive contact, for pictures."""

import numpy as np

from common.adhesion_sets import STATE, scaled_law
from common.job import start
from common.model_surfaces import gather_fields, read_first
from stickiness import adhesive, datasets

TOLERANCE = 1e-6  # of the residual: far below what a picture shows


def main(job):
    surface = read_first(job.input.surfaces)
    adhesion = job.params.adhesion
    shown = adhesion["maps"]
    heights = surface.height.values
    length = float(surface.window_length)
    point = {name: shown[name] for name in ("adhesion_length_over_range", "range_over_h_rms")}
    law = scaled_law(adhesion, adhesion["law"], **point)
    pressures = np.sort(np.array(shown["pressures"], dtype=float))
    # Loads grow: each state is where a press would find it on loading.
    states = []
    for pressure in pressures:
        previous = states[-1] if states else None
        state = adhesive.solve(
            heights, length, law, pressure=pressure, start=previous, tol=TOLERANCE
        )
        states.append(state)
    text = "repulsion less attraction over E* q0 h_rms"
    texts = {"contact_pressure": text, **{n: STATE[n] for n in ("residual", "iterations")}}
    dataset = gather_fields(states, pressures, surface, TOLERANCE, **texts)
    title = "gap and pressure fields of one realisation in adhesive contact"
    settings = {"law": adhesion["law"], "q0_h_rms": adhesion["q0_h_rms"], **point}
    parameters = {**datasets.parameters(surface), **settings}
    datasets.write(dataset, job.output[0], title=title, parameters=parameters)


if __name__ == "__main__":
    main(start(globals()))
