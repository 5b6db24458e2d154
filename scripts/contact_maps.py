"""Keep the gap and pressure fields of one realisation at a few loads, for pictures."""

import numpy as np
import xarray as xr

from _job import start
from _model import DESCRIBED
from stickiness import datasets, repulsive


def main(job):
    surface = datasets.read(job.input.surface, ["height", "window_length"])
    pressures = np.sort(job.params.pressures)
    contacts = list(
        repulsive.load_path(
            surface.height.values,
            float(surface.window_length),
            pressures,
            tol=job.params.tolerance,
        )
    )
    dims = ("pressure", "x", "y")
    dataset = xr.Dataset(
        {
            "gap": (dims, [contact.gap for contact in contacts]),
            "contact_pressure": (dims, [contact.pressure for contact in contacts]),
            "residual": ("pressure", [contact.residual for contact in contacts]),
        },
        coords={"pressure": pressures, "x": surface.x, "y": surface.y},
    )
    datasets.write(
        datasets.annotate(
            dataset,
            pressure=DESCRIBED["pressure"],
            gap=DESCRIBED["gap"],
            contact_pressure=("1", "contact pressure over E* q0 h_rms"),
            residual=("1", "complementarity residual over h_rms"),
        ),
        job.output[0],
        title="gap and pressure fields of one realisation",
        parameters={**datasets.parameters(surface), "case": job.wildcards.case},
    )


if __name__ == "__main__":
    main(start(globals(), "contact_maps", case="H0.8_zeta64"))
