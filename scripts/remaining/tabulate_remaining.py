"""Table of the adhesion that remains: every simulated value beside what is predicted of it."""

from pathlib import Path

import pandas as pd

from common.conventions import Q0
from common.job import start
from stickiness import datasets
from stickiness.formatting import number, table
from stickiness.remaining.roughness import Roughness

QUOTED = ("approach", "separation", "bound", "pull_off")
SIMULATED = (
    *(*QUOTED, "area_at_zero_load", "gap_at_zero_load", "jumps", "pixels_in_zone"),
    *(f"{name}_grid_error" for name in QUOTED),
)
COMMENT = """\
# Adhesion that remains, simulated (target remaining_measured), with predictions beside it. To
# take a new measurement over, copy it here. approach, separation and bound are over the work of
# adhesion, lengths over h_rms, wave numbers over q0, stresses over E* q0 h_rms.
"""
HEAD = """\
Shares of the work of adhesion, means over simulations by w/U_full: at widths of the cohesive zone
q0 range^2/l_a up to 0.1, of surfaces of two by two waves and more.

"""


def main(job):
    frame = pd.DataFrame([row for path in job.input for row in list_rows(path)])
    text = COMMENT + frame.to_csv(index=False, float_format="%.5g")
    for output, content in zip(job.output, (text, HEAD + summarise(frame)), strict=True):
        with datasets.whole_file(output) as path:
            path.write_text(content, encoding="utf-8")


def list_rows(path):
    """Rows of one file: its points, in h_rms and q0, with the prediction."""
    data = datasets.read(path, SIMULATED)
    setting = datasets.parameters(data)
    energy = float(data.full_contact_energy)
    slope = float(data.rms_slope)
    rough = Roughness(
        h_rms=1.0,
        q0=Q0 * (setting["rolloff"] or 1.0),
        elastic_energy=energy,
        q1=Q0 * setting["magnification"],
        rms_slope=slope,
    )
    along = next(name for name in ("zone", "range_over_h_rms") if name in data.dims)
    points = data.stack(point=("energy", along, "squeeze")).dropna("point", subset=["bound"])
    identity = ("hurst", "magnification", "window", "points", "seed")
    for index in range(points.sizes["point"]):  # where the grid was fine enough
        point = points.isel(point=index)
        ratio = float(point.energy)
        length = float(point.adhesion_length)
        range_ = float(point["range"])
        share, low, high = map(float, rough.limit_share(length, range_))
        yield {
            "set": Path(path).parent.name,
            **{name: setting[name] for name in identity},
            "full_contact_energy": energy,
            "rms_slope": slope,
            "energy_ratio": ratio,
            "pressed": float(point["squeeze"]),
            "zone": rough.q0 * range_**2 / length,
            "range": range_,
            "adhesion_length": length,
            **{name: float(point[name]) for name in SIMULATED},
            "predicted": share,
            "predicted_low": low,
            "predicted_high": high,
            "predicted_pull_off": float(rough.tension(length, range_)),
            "full_contact": max(1 - 1 / ratio, 0.0),
        }


def summarise(frame):
    """Means of simulation and theories by w/U_full, as a table in Markdown."""
    tough = frame[(frame.zone < 0.11) & (frame.window > 1)]
    bins = (0.3, 0.4, 0.6, 0.8, 1.1, 1.5, 2.5)  # of w/U_full, of the table of means
    summarised = ("approach", "separation", "bound", "predicted", "full_contact")
    rows = [
        (number(g.energy_ratio.mean(), 2), len(g), *(f"{g[n].mean():.3f}" for n in summarised))
        for _, g in tough.groupby(pd.cut(tough.energy_ratio, bins), observed=True)
    ]
    return table(("w/U_full", "points", *(n.replace("_", " ") for n in summarised)), rows)


if __name__ == "__main__":
    main(start(globals()))
