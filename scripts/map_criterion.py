"""Figure 5: roughness at the threshold of stickiness over range and adhesion length, and slopes."""

import numpy as np
import xarray as xr

from _criteria import measured_a_v
from _job import start
from _model import logarithmic_grid
from stickiness import criteria, datasets


def main(job):
    asked = job.params.map
    a_v = measured_a_v(job.input, job.params.pressure)
    dataset = limits(asked, a_v)
    dataset = dataset.merge(slopes(asked["slope_parameter"], asked["slope_a_v"]))
    datasets.write(
        annotated(dataset),
        job.output[0],
        title="map of the stickiness criterion",
        parameters={**asked, "pressure": job.params.pressure},
    )


def limits(asked, a_v):
    """Largest h_rms/range that sticks, by measured and printed coefficient, and the DMT limit.

    With the range as unit of length only range q0 and l_a/range remain.
    """
    q0 = xr.DataArray(logarithmic_grid(asked["range_times_q0"]), dims="range_times_q0")
    length = logarithmic_grid(asked["adhesion_length_over_range"])
    length = xr.DataArray(length, dims="adhesion_length_over_range")
    q0, length = xr.broadcast(q0, length)
    curves = {
        "h_rms_limit": a_v.value,
        "h_rms_limit_low": a_v.low,
        "h_rms_limit_high": a_v.high,
        "h_rms_limit_printed": criteria.PRINTED_A_V,
    }
    data = {
        name: (q0.dims, criteria.h_rms_limit(q0.values, length.values, 1.0, value))
        for name, value in curves.items()
    }
    data["jtb_limit"] = (q0.dims, criteria.jtb_limit(q0.values, length.values, 1.0))
    coords = {
        "range_times_q0": q0.isel(adhesion_length_over_range=0).values,
        "adhesion_length_over_range": length.isel(range_times_q0=0).values,
    }
    scalars = {"a_v": a_v.value, "a_v_low": a_v.low, "a_v_high": a_v.high}
    return xr.Dataset(data | scalars, coords=coords)


def slopes(parameters, a_v):
    """Angle of the area-load line against h_rms/range for range q0/(l_a/range) = parameter."""
    roughness = np.geomspace(0.1, 100, 301)
    angles = [
        criteria.slope_angle(
            criteria.inverse_kappa(criteria.inverse_kappa_ad(roughness, parameter, 1.0, 1.0, a_v))
        )
        for parameter in parameters
    ]
    return xr.Dataset(
        {"slope_angle": (("slope_parameter", "h_rms_over_range"), np.degrees(angles))},
        coords={"slope_parameter": list(parameters), "h_rms_over_range": roughness},
    )


def annotated(dataset):
    limit = "largest h_rms/range that sticks"
    return datasets.annotate(
        dataset,
        range_times_q0=("1", "range times lowest wave number"),
        adhesion_length_over_range=("1", "adhesion length over range"),
        h_rms_limit=("1", f"{limit}, a_V of a broad spectrum"),
        h_rms_limit_low=("1", f"{limit}, a_V at its low end"),
        h_rms_limit_high=("1", f"{limit}, a_V at its high end"),
        h_rms_limit_printed=("1", f"{limit}, coefficient 9/4 as printed"),
        jtb_limit=("1", "smallest h_rms/range at which the DMT limit holds"),
        a_v=("1", "a_V of the derived criterion"),
        a_v_low=("1", "a_V less its error"),
        a_v_high=("1", "a_V plus its error"),
        slope_parameter=("1", "range q0/(adhesion length/range)"),
        h_rms_over_range=("1", "rms height over range"),
        slope_angle=("degree", "angle of the area-load line against the load axis"),
    )


if __name__ == "__main__":
    main(start(globals(), "map_criterion"))
