"""Average the adhesive realisations of a set: slopes of the area-load relation, and DMT's error.

With kappa = 2 without adhesion, 1/kappa = 1/2 - 1/kappa_ad. Full simulation gives the latter by how
much less pressure than without adhesion goes with the area, relative to that pressure; the DMT
limit by the attraction over the gaps without adhesion.
"""

import xarray as xr

from _adhesion import DESCRIBED as ADHESION_DESCRIBED
from _adhesion import MISSING, dmt_valid
from _errors import described, with_errors
from _job import start
from _model import DESCRIBED
from stickiness import cohesive_zone, datasets

AVERAGED = {
    "external_pressure": "mean pressure over E* q0 h_rms",
    "repulsive_area": "repulsive contact area over nominal area",
    "attractive_area": "area within the range of attraction, not in contact, over nominal area",
    "inverse_kappa": "1/kappa = p_ext A_nom/(A_rep E* h'_rms)",
    "inverse_kappa_fit": "1/kappa fitted through the origin over all loads",
    "inverse_kappa_ad": "1/kappa_ad, from the fall of 1/kappa relative to that without adhesion",
    "inverse_kappa_ad_direct": "p_ad/(2 p_rep) of the adhesive contact",
    "inverse_kappa_ad_dmt": "p_ad/(2 p_rep) over the gaps without adhesion (DMT)",
    "dmt_ratio": "1/kappa_ad of the full simulation over that of the DMT limit",
}


def main(job):
    files = [datasets.read(path, ["external_pressure"]) for path in job.input.realisations]
    made = datasets.parameters(files[0])
    seeds = [datasets.parameters(file)["seed"] for file in files]
    states = xr.concat(files, xr.DataArray(seeds, dims="seed", name="seed"))
    # A mean over the seeds that happen to be solved would leave out the stickiest ones.
    states.attrs = files[0].attrs
    whole = states.external_pressure.isel(resolution=-1).notnull().all("seed")
    wide = zone_width(states) >= cohesive_zone.NARROWEST * made["pixel"]
    states = with_slopes(states)
    for name in AVERAGED:
        states[name] = states[name].where(whole & wide)
    dataset = xr.Dataset({"q0_h_rms": made["q0_h_rms"]})
    for name in AVERAGED:
        dataset = with_errors(dataset, name, states[name], plain=True)
    dataset["residual"] = states.residual.max(["seed", "resolution"])
    dataset["iterations"] = states.iterations.isel(resolution=-1, drop=True).mean("seed")
    dataset["dmt_valid"] = dmt_valid(
        made["q0_h_rms"], states.adhesion_length_over_range, states.range_over_h_rms
    )
    dataset["zone_strength"] = zone_strength(states, made["q0_h_rms"])
    made.pop("seed")
    datasets.write(
        annotated(dataset),
        job.output[0],
        title="adhesive contact averaged over realisations",
        parameters={**made, "seeds": seeds, "model": "full boundary elements"},
    )


def with_slopes(states):
    """Add what compares area and load with and without adhesion."""
    alone = states.pressure / states.area_alone
    held = states.external_pressure / states.repulsive_area
    area = states.repulsive_area * states.rms_slope
    direct = states.attraction / states.repulsive_pressure / 2
    dmt = states.attraction_dmt / states.pressure / 2
    full = (1 - held / alone) / 2
    fit = (states.external_pressure * area).sum("pressure", skipna=False)
    fit = fit / (area**2).sum("pressure", skipna=False)
    return states.assign(
        inverse_kappa=held / states.rms_slope,
        inverse_kappa_fit=fit,
        inverse_kappa_ad=full,
        inverse_kappa_ad_direct=direct,
        inverse_kappa_ad_dmt=dmt,
        dmt_ratio=full / dmt.where(dmt > 0),
    )


def zone_width(states):
    """Mean width of the zone of attraction without adhesion, times q0."""
    edge = states.edge_gap.isel(resolution=-1, drop=True).mean("seed")
    edge, range_ = xr.broadcast(edge, states.range_over_h_rms)
    width = cohesive_zone.zone_width(
        datasets.parameters(states)["pixel"], edge.values, range_.values
    )
    return edge.copy(data=width)


def zone_strength(states, q0_h_rms):
    """Width of the zone of attraction over epsilon^2/l_a: small where attraction bends little."""
    strength = states.adhesion_length_over_range / q0_h_rms
    return zone_width(states) * strength / states.range_over_h_rms


def annotated(dataset):
    texts = {}
    for name, text in AVERAGED.items():
        for key, value in described(name, text, plain=True).items():
            texts[key] = (*value[:2], MISSING)
    return datasets.annotate(
        dataset,
        pressure=DESCRIBED["pressure"],
        residual=("1", "largest residual of all realisations", MISSING),
        iterations=("1", "mean iterations on the fine grid", MISSING),
        dmt_valid=("1", "1 where the JTB condition for the DMT limit holds"),
        zone_strength=("1", "width of the zone of attraction over range^2/adhesion length"),
        **ADHESION_DESCRIBED,
        **texts,
    )


if __name__ == "__main__":
    main(start(globals(), "average_adhesive", adhesion="fig4b_rough"))
