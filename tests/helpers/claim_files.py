"""Made-up files behind the claims, for which the verdict and the number are known."""

import functools
import itertools
import json

import numpy as np
import pandas as pd
import xarray as xr
from helpers.entries import model_surface
from helpers.experiments import EXPERIMENTS, make_dataset

from adhesion.follow_loop import add_quoted
from common import conventions
from common.config.conditions import CONDITIONS
from common.paper import LOAD
from stickiness import criteria, surface
from stickiness import error_budget as budget
from stickiness.criteria.registry import REMAINING
from stickiness.spectrum import SelfAffine
from stickiness.verdicts.limits import LIMITS

LOADS = np.array([0.001, 0.0065, 0.03, LOAD, 0.13, 0.52])
RANGES = np.geomspace(1e-4, 10, 81)
GAPS = np.sqrt(RANGES[1:] * RANGES[:-1])
WINDOWS = [[0.01, 0.1], [0.003, 0.03], [0.03, 0.3]]


def made_by(dataset, **parameters):
    return dataset.assign_attrs(parameters=json.dumps(parameters))


def case(zeta, **more):
    return {"case": f"made up {zeta}", **model_surface(magnification=zeta), **more}


def with_errors(dataset, *names, model=0.0):
    """Sampling errors of 3 % and discretisation errors of 4 %: 5 % in all, but for the model's."""
    none = budget.not_applicable("made up")
    for name in names:
        value = dataset[name] = dataset[name].assign_attrs(units="1", long_name="made up")
        parts = {"discretisation": 0.04, "sampling": 0.03, "model": model}
        parts = {
            source: budget.ErrorComponent(part * value, "made up") for source, part in parts.items()
        }
        dataset = budget.with_budget(dataset, name, solver=none, bandwidth=none, **parts)
    return dataset


def kappa(zeta, fall=0.0, level=2.0, **more):
    """kappa that falls in proportion to ln p, `level` at the paper's load."""
    values = level * (1 - fall * np.log(LOADS / LOAD))
    data = xr.Dataset(
        {
            "area_fraction": ("pressure", LOADS * values / 2),
            "kappa": ("pressure", values),
            "kappa_fit": values[-1],
        },
        coords={"pressure": LOADS},
    )
    return made_by(with_errors(data, "kappa", "kappa_fit"), **case(zeta, **more))


def ensemble(zeta, separation=1.0, power=1.0, **more):
    """Simulation with p = exp(-2 separation u) and A_ad proportional to p^power."""
    area = 0.9 * LOADS[:, None] ** power * RANGES ** (2 / 3)
    data = xr.Dataset(
        {
            "mean_gap_mean": ("pressure", -np.log(LOADS) / (2 * separation)),
            "attractive_area_mean": (("pressure", "range"), area),
        },
        coords={"pressure": LOADS, "range": RANGES},
    )
    return made_by(with_errors(data, "mean_gap_mean"), **case(zeta, **more))


def lattice():
    data = ensemble(32)[["mean_gap_mean", "attractive_area_mean"]]
    data = data.rename(mean_gap_mean="mean_gap", attractive_area_mean="attractive_area")
    data["kappa"] = "pressure", 0 * LOADS + 2.4
    return data.expand_dims(variant=[conventions.VARIANT])


def sweep(zetas=(1000.0,), hursts=(0.8,), loads=(LOAD,), exponent=-1 / 3, power=1.0):
    """Theory whose P(u) falls as a power law, as p^power, with p = exp(-2 u)."""
    dims = ("variant", "hurst", "magnification", "load")
    shape = (1, len(hursts), len(zetas), len(loads))
    pressure = np.broadcast_to(loads, shape)
    scale = 3.0 * pressure[..., None] ** power
    area = scale * RANGES ** (1 + exponent) / (1 + exponent)
    return xr.Dataset(
        {
            "pressure": (dims, pressure),
            "mean_gap": (dims, -np.log(pressure) / 2),
            "attractive_area": ((*dims, "range"), area),
            "gap_density": ((*dims, "gap"), scale * GAPS**exponent),
        },
        coords={
            "variant": [conventions.VARIANT],
            "hurst": list(hursts),
            "magnification": list(zetas),
            "range": RANGES,
            "gap": GAPS,
        },
    )


def fit(of, *slopes):
    """a_V of a sweep or ensemble, one value for each window."""
    area = of.attractive_area if "attractive_area" in of else of.attractive_area_mean
    one = xr.ones_like(area.isel(range=0, drop=True))
    a_v = xr.concat([one * slope for slope in slopes], "window")
    low, high = np.transpose(WINDOWS)
    data = xr.Dataset({"a_v": a_v, "window_low": ("window", low), "window_high": ("window", high)})
    data["a_v_mean"] = data.a_v
    return with_errors(data, "a_v", "a_v_mean").assign_attrs(of.attrs)


def adhesion(zeta, q0_h_rms=0.1):
    """A_ad by the formula with a_V = 2.8, which makes the threshold independent of load."""
    axes = {
        "pressure": LOADS,
        "adhesion_length_over_range": [0.1, 0.5, 1.0],
        "range_over_h_rms": [0.0075, 0.1],
    }
    length, range_ = (xr.DataArray(axes[n], dims=n, coords={n: axes[n]}) for n in list(axes)[1:])
    inverse = 0.75 * 2.8 / q0_h_rms * length * range_ ** (2 / 3)
    inverse = inverse * xr.ones_like(xr.DataArray(LOADS, dims="pressure", coords=[LOADS]))
    data = xr.Dataset({"inverse_kappa_ad": inverse, "q0_h_rms": q0_h_rms})
    data["attraction"] = 2 * inverse * data.pressure
    return made_by(with_errors(data, "inverse_kappa_ad"), **case(zeta))


def adhesive(zeta, q0_h_rms=0.1, scale=1.0):
    """Full simulation that follows the formula up to a factor."""
    data = adhesion(zeta, q0_h_rms=q0_h_rms).drop_attrs(deep=False)
    data = data[["inverse_kappa_ad", "q0_h_rms"]]
    data["inverse_kappa_ad"] = scale * data.inverse_kappa_ad
    data = with_errors(data, "inverse_kappa_ad")
    data["inverse_kappa_ad_net"] = 0.9 * data.inverse_kappa_ad
    data["inverse_kappa_ad_direct"] = 0.8 * data.inverse_kappa_ad
    data["inverse_kappa"] = 0.5 - data.inverse_kappa_ad
    data["inverse_kappa_net"] = 1.1 * data.inverse_kappa
    data["inverse_kappa_fit"] = data.inverse_kappa.mean("pressure")
    data["repulsive_area"] = 0.5 * data.adhesion_length_over_range + 0 * data.inverse_kappa
    data["model"] = xr.full_like(data.inverse_kappa, "full", dtype="U4")
    slopes = "inverse_kappa", "inverse_kappa_net", "inverse_kappa_fit", "inverse_kappa_ad_net"
    data = with_errors(data, *slopes)
    return made_by(data, **case(zeta))


def loop(pull_off=-0.02, area=0.03, wider=1.5):
    """Area on loading 2 p, on unloading `wider` times that from the pull-off on."""
    there, back = np.linspace(0, 0.1, 61), np.linspace(0.1, pull_off, 61)
    back_area = np.interp(back, [pull_off, 0, 0.02, 0.1], [area, area, 0.04 * wider, 0.2])
    values = {
        "mean_pressure": np.concatenate([there, back]),
        "repulsive_area_fraction": np.concatenate([2 * there, back_area]),
        "net_repulsive_area_fraction": np.concatenate([2 * there, 0.75 * back_area]),
        "separating": np.repeat([0.0, 1.0], 61),
        "jumped": np.zeros(122),
        "residual": np.zeros(122),
        "work": np.full(122, 1.0),
        "dissipated": np.full(122, 0.25),
    }
    dims = "resolution", "control", "adhesion_length_over_range", "state"
    coords = [4.0, 8.0], ["mean_gap", "pressure"], [0.05, 0.1], np.arange(122)
    data = xr.Dataset(
        {name: (dims, np.broadcast_to(value, (2, 2, 2, 122))) for name, value in values.items()},
        coords=dict(zip(dims, coords, strict=True)),
    )
    return made_by(add_quoted(data), range_over_h_rms=0.1, q0_h_rms=0.1, **case(32))


def stickiness_map():
    dims = "range_times_q0", "adhesion_length_over_range"
    q0, length = np.geomspace(1e-12, 1e-2, 11), np.array([0.01, 0.1])
    limit = 1 / np.sqrt(q0[:, None]) * length
    factors = {"h_rms_threshold": (1.0, 1.0, 1.0), "h_rms_threshold_edges": (1.0, 2.0, 3.0)}
    limits = {
        name: (("limit", *dims), np.multiply.outer(three, limit)) for name, three in factors.items()
    }
    limits |= {"weak_limit": (dims, 4 * limit), "a_v": 3.5, "a_v_total_error": 1.0}
    roughness, parameters = np.geomspace(0.1, 100, 301), np.array([1, 0.5])
    inverse = criteria.inverse_kappa_ad(roughness, parameters[:, None], 1.0, 1.0, 3.0)
    angles = np.degrees(criteria.slope_angle(criteria.inverse_kappa(inverse)))
    limits |= {"slope_angle": (("slope_parameter", "h_rms_over_range"), angles)}
    coords = {"slope_parameter": parameters, "h_rms_over_range": roughness, "limit": list(LIMITS)}
    data = xr.Dataset(limits, coords=coords | {dims[0]: q0, dims[1]: length})
    return made_by(data, hurst=0.8, slope_a_v=3.0, shortest_over_range=4)


def real_surface(name, kind="self_affine", q0=1e3, c0=1e-3, h_rms=1e-6):
    values = {name: ("end", [c0 / 10, c0]) for name in ("C0", "C0_reference_upper")}
    values |= {"h_rms": ("end", [h_rms / 10, h_rms]), "rms_slope": ("end", [0.1, 1.0])}
    values |= {"elastic_energy": ("end", [q0 * h_rms**2 / 150, q0 * h_rms**2 / 1.5])}
    values |= {"q0": q0, "q1": 2 * np.pi / 1e-6, "hurst": 0.8}
    data = xr.Dataset(values, coords={"end": ["smooth", "rough"]})
    return made_by(data, kind=kind, surface=name)


def verdicts(**margins):
    """Verdicts of materials by name, of which claims read the margin of the JTB condition alone."""
    dims = "material", "surface", "end"
    margin = np.broadcast_to(np.reshape([*margins.values()], (-1, 1, 1)), (len(margins), 1, 2))
    coords = dict(zip(dims, ([*margins], ["polished_steel"], ["smooth", "rough"]), strict=True))
    labels = {"terrain": "rough terrain", "steel": "steel"}
    return made_by(xr.Dataset({"jtb_margin": (dims, margin)}, coords=coords), labels=labels)


def generated(seed, zeta=16, stretch=1.0):
    """A surface as the pipeline makes it; `stretch` spoils its isotropy."""
    asked = case(zeta, seed=seed)
    spectrum = SelfAffine(hurst=0.8, q0=1.0, q1=zeta, h_rms=1.0)
    heights = surface.synthesise(spectrum, 3 * zeta, 2 * np.pi, seed)
    k = np.fft.fftfreq(3 * zeta, 1 / (3 * zeta))
    damped = np.fft.ifft2(np.fft.fft2(heights) * np.exp(-(((stretch - 1) * k / zeta) ** 2))).real
    data = xr.Dataset({"height": (("x", "y"), damped), "window_length": 2 * np.pi})
    return made_by(data.expand_dims(seed=[seed]), **asked)


def fig3c():
    return sweep((10.0, 100.0, 1e4, 1e5, 1e6), hursts=(0.7, 0.8, 0.9))


def remaining(growth=0.0, late=0.0):
    """Energy gained by two surfaces; finer waves raise the energy of full contact.

    By `growth` up to a magnification of 32, and of one surface by `late` from there to 320. A wider
    zone with fewer magnifications gains twice as much.
    """
    rows = []
    made = (1, 4, 0), (1, 32, growth), (2, 4, 0), (2, 32, growth), (1, 320, growth + late)
    for hurst, (seed, magnification, more) in itertools.product((0.5, 0.8), made):
        energy = 0.4 * (1 + more)
        same = {"hurst": hurst, "seed": seed, "magnification": magnification, "window": 2}
        same |= {"full_contact_energy": energy}
        for ratio, zone in itertools.product((0.5, 1.0, 2.0), (0.1, 0.2)):
            row = {"adhesion_length": ratio * energy, "bound": 2.5 * zone * ratio, "zone": zone}
            if zone == 0.1 or magnification == 4:
                rows.append(same | row)
    return pd.DataFrame(rows)


ABSENT = dict.fromkeys([*CONDITIONS, "missed"])
RUBBER_CASES = {"one_MPa": ABSENT | {"label": "rubber of 1 MPa"}}
RUBBER = {"label": "rubber spheres", "short": "Rubber 1975", "citation": "no source"}
RUBBER = {"fuller_tabor": ABSENT | RUBBER | {"cases": RUBBER_CASES}}


def experiments(outcomes=(2, 2, 2), limit=40e-6, grades=(1, 1, 1), tests=(1, 1, 1)):
    """Rubber that has lost its adhesion at 1 um, a limiting roughness, a pair that does not stick.

    By case `outcomes` of the paper's criterion, `grades` of what was observed and whether it
    `tests`; `limit` of the rubber's roughness by the paper's criterion.
    """
    rubber = {
        "quantity": "relative_pull_off",
        "observed": (0.0, 0.1),
        "predicted": (0.2, 0.05, 0.6),
        "limits": {"violano": limit, REMAINING: 2e-6},
    }
    ball = {"quantity": "limiting_roughness", "observed": (1e-6, 4e-6), "predicted": (2e-6,) * 3}
    steel = {"quantity": "sticks", "observed": (0.0, 0.0), "predicted": (0.0, 0.0, 0.01)}
    cases = {"fuller_tabor/one_MPa": rubber, "ball/limit": ball, "plate/steel": steel}
    rows = {
        name: case
        | {"criteria": {"violano": outcome, REMAINING: 2}, "observed_known": grade, "tests": test}
        for (name, case), outcome, grade, test in zip(
            cases.items(), outcomes, grades, tests, strict=True
        )
    }
    return make_dataset(rows, EXPERIMENTS | RUBBER)


def files_by_name():
    """Files of a world in which the paper's power laws hold, to be changed at will."""
    return {
        name: list(made) if isinstance(made, list) else made.copy()
        for name, made in make_files().items()
    }


@functools.cache
def make_files():
    broad = (1000.0, 1e4, 5e4)
    wide, narrow = ensemble(32, window=4), ensemble(128)
    fig3a = sweep(broad)
    fig3d = sweep(loads=(0.001, 0.01, LOAD, 0.1, 0.5))
    return {
        "kappa_middle_band": kappa(64, seeds=[1, 2, 3]),
        "kappa_broad_band": kappa(128),
        "kappa_wide_cell": kappa(32, window=4),
        "ensemble_wide_cell": wide,
        "lattice_broad_band": lattice(),
        "lattice_wide_cell": lattice(),
        "fit_bem_wide_cell": fit(wide, 2.9, 3.0, 3.1),
        "fit_bem_middle_band": fit(ensemble(64), 2.9, 3.0, 3.1),
        "fit_bem_broad_band": fit(narrow, 2.9, 3.0, 3.1),
        "fit_lattice_broad_band": fit(lattice(), 3.0, 3.0, 3.0),
        "fig1b": sweep((100.0, 1e4, 1e6)),
        "fig3a": fig3a,
        "fig3b": sweep(loads=(0.0065, 0.03, 0.13, 0.52)),
        "fig3d": fig3d,
        "fit_fig3a": fit(fig3a, 3.0, 3.0, 3.0),
        "fit_fig3c": fit(fig3c(), 3.0, 2.9, 3.2),
        "fit_fig3d": fit(fig3d, 3.0, 3.0, 3.0),
        "loop": loop(),
        "adhesive_fig2": adhesive(64),
        "adhesive_sets": [adhesive(zeta, h) for zeta, h in ((64, 0.3), (64, 0.3), (128, 0.006))],
        "adhesion_fig2": adhesion(64),
        "adhesion_sets": [adhesion(zeta, h) for zeta, h in ((64, 0.3), (64, 0.3), (128, 0.006))],
        "map": stickiness_map(),
        "verdicts": verdicts(crystal=24.0, gel=0.001),
        "asphalt": real_surface("asphalt"),
        "polished_steel": real_surface("polished steel", q0=2 * np.pi / 1e-4),
        "measured_surfaces": [real_surface("terrain", kind="measured", c0=0.07)],
        "remaining": remaining(),
        "experiments": experiments(),
        "seeds": [generated(seed) for seed in (1, 2, 3)],
    }
