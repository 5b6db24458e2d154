"""Points of the attraction at the edges of contact that are certain enough to say something."""

import pandas as pd

from stickiness import datasets

COLUMNS = ["attractive_over_contact", "edge_strength"]
COLUMNS += ["effect", "over_model", "over_model_total_error"]
LARGEST_ERROR = 0.25  # of a point that is drawn; covers 90 %


def select_certain(files):
    """Points of all files with a small enough error, one a row, with their surface."""
    tables = []
    for data in files:
        parameters = datasets.parameters(data)
        surface = {
            "magnification": parameters["magnification"],
            "roughness": f"{parameters['q0_h_rms']:.2g}",
        }
        table = data[COLUMNS].to_dataframe(list(data.effect.dims))[COLUMNS]
        tables.append(table.assign(**surface))
    points = pd.concat(tables, ignore_index=True)
    return points[points.over_model_total_error < LARGEST_ERROR]
