"""Keep the gap and pressure fields of one realisation in adhesive contact, for pictures."""

import numpy as np

from common.adhesion_sets import STATE, roughness, scaled_law
from common.job import start
from common.model_surfaces import gather_fields, read_first
from stickiness import adhesive, datasets

TOLERANCE = 1e-6  # of the residual: far below what a picture shows


def main(job):
    surface = read_first(job.input.surfaces)
    adhesion, shown = job.params.adhesion, job.params.adhesion["maps"]
    heights, length = surface.height.values, float(surface.window_length)
    given = {name: shown[name] for name in ("adhesion_length_over_range", "range_over_h_rms")}
    law = scaled_law(adhesion, adhesion["law"], **given)
    pressures = np.sort(np.array(shown["pressures"], dtype=float))
    # Loads grow: each state is where a press would find it on loading.
    states = []
    for pressure in pressures:
        given_load = {"pressure": pressure, "start": states[-1] if states else None}
        states.append(adhesive.solve(heights, length, law, **given_load, tol=TOLERANCE))
    text = "repulsion less attraction over E* q0 h_rms"
    texts = {"contact_pressure": text, **{n: STATE[n] for n in ("residual", "iterations")}}
    dataset = gather_fields(states, pressures, surface, TOLERANCE, **texts)
    title = "gap and pressure fields of one realisation in adhesive contact"
    made = {"law": adhesion["law"], "q0_h_rms": roughness(adhesion), **given}
    parameters = {**datasets.parameters(surface), **made}
    datasets.write(dataset, job.output[0], title=title, parameters=parameters)


if __name__ == "__main__":
    main(start(globals(), "adhesive_maps", adhesion="fig2"))
