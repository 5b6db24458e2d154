"""Published experiments: works of approach and separation and pull-off, beside what was seen.

Everything that is not known is swept: each input between its plausible ends, the others in their
middle, and all corners. Corners matter where two unknown inputs move a prediction the same way.
"""

from dataclasses import dataclass
from functools import cache
from itertools import product

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from common import experiment_outcomes as outcomes
from common.config.entries import CONDITIONS, OBSERVED, conditions_of
from common.experiment_outcomes import COMPATIBLE, GRADES, MARKS, MISSED, OUTCOMES, SILENT, SOME
from common.job import start
from common.templates import write_page
from experiments import plot_experiments
from stickiness import datasets
from stickiness.criteria.a_v_table import surface_a_v
from stickiness.criteria.pair import Pair
from stickiness.criteria.registry import CRITERIA
from stickiness.criteria.verdict import describe_surface
from stickiness.error_budget import ErrorComponent, not_applicable, with_budget
from stickiness.remaining import sphere
from stickiness.remaining.prediction import DEFAULT_SHARE, LATE
from stickiness.spectrum.kinds import SelfAffine
from stickiness.traction_laws import EXPONENTIAL, find_strength
from stickiness.units import si

SHAPE = ("hurst", "longest_wavelength", "shortest_wavelength", "rolloff_wavelength")
MOMENTS = ("q0", "rms_slope", "rms_curvature", "elastic_energy")
MIDDLE = 0  # index of the combination with every input in the middle
SIGNS = (-1, 0, 1)  # low limit, value, high limit
OF_SPHERES = {"relative_pull_off": "relative", "work_of_separation": "work"}  # `SpherePullOff`
ROUGHNESS = np.geomspace(1e-11, 1e-3, 121)  # rms heights [m] along which adhesion is followed
# Margins are nearly powers of the rms height: between points as far apart as these they are read
# off to better than 1 %.
COARSE = ROUGHNESS[::4]
FACTOR = 4.0  # between the adhesion that a criterion requires and the actual one, if it is right
LARGEST_EFFECT = 1e9  # of an input, instead of an infinite one

_QUANTITY = "the quantity observed, in its SI unit"
_CURVE = "pull-off over that from a smooth surface"
_LOWEST, _HIGHEST = (f"{end} limit over all that is plausible" for end in ("lowest", "highest"))
_BEYOND = "looks at no roughness, or beyond the heights followed"
VARIABLES = {
    "case": ("1", "experiment and case"),
    "criterion": ("1", "stickiness criterion"),
    "roughness": ("m", "rms height"),
    "quantity": ("1", "what was observed"),
    "observed_low": ("1", f"{_QUANTITY}, low limit; 1 or 0 if the pair sticks or not"),
    "observed_high": ("1", f"{_QUANTITY}, high limit; 1 or 0 if the pair sticks or not"),
    "predicted": ("1", f"prediction of {_QUANTITY}, or the share of the adhesion that remains"),
    "predicted_lowest": ("1", f"prediction, {_LOWEST}"),
    "predicted_highest": ("1", f"prediction, {_HIGHEST}"),
    "pull_off_curve": ("1", _CURVE),
    "pull_off_curve_lowest": ("1", f"{_CURVE}, {_LOWEST}"),
    "pull_off_curve_highest": ("1", f"{_CURVE}, {_HIGHEST}"),
    "outcome": ("1", "outcome"),
    "value_inside": ("1", "1 where the value itself agrees, every input in the middle"),
    "by_relation": ("1", "1 where a relation was observed, evaluated with the inputs"),
    "tests": ("1", "1 where a published number or answer is compared with the prediction"),
    "known": ("1", "how the least known input is known"),
    "observed_known": ("1", "how the observation is known"),
    "waves_in_contact": ("1", "longest waves across the contact at pull-off", "flat on flat"),
    "h_rms": ("m", "rms height, given or limiting"),
    "most_effective_input": ("1", "input within whose limits the prediction changes most"),
    "effect_of_input": ("1", "factor that it changes, at most 1e9", "nothing is predicted"),
    "criterion_outcome": ("1", "outcome by a criterion"),
    "criterion_roughness": ("m", "rms height up to which a criterion says sticky", _BEYOND),
}


def main(job):
    experiments = job.params.experiments
    dataset = predict_all(experiments)
    title, parameters = "published experiments, predicted", {"experiments": experiments}
    datasets.write(dataset, job.output.dataset, title=title, parameters=parameters)
    write_page(
        job.input.template,
        job.output.table,
        **outcomes.describe(dataset, experiments),
        wanted=DEFAULT_SHARE,
        factor=FACTOR,
        fewest_waves=outcomes.FEWEST_WAVES,
        criteria=[criterion.label for criterion in CRITERIA.values()],
        survivals=[
            (experiments[name]["label"], *map(MARKS.get, codes))
            for name, *codes in find_survivals(dataset).itertuples()
        ],
    )
    plot_experiments.draw(dataset, experiments, (job.output.png, job.output.pdf))


def find_survivals(dataset):
    """Worst outcome of every criterion by experiment; `SILENT` where nothing is tested."""
    frame = dataset.criterion_outcome.transpose("case", "criterion").to_pandas()
    experiments = frame.index.str.partition("/").get_level_values(0)
    worst = frame.where(frame != SILENT).groupby(experiments, sort=False).min()
    return worst.fillna(SILENT).astype(int)


@dataclass(frozen=True)
class Observation:
    """One observation, and the conditions it was made under.

    `inputs` has, by name, arrays of one value for every combination of what is plausible: first all
    inputs in the middle, then each of `swept` at its low and high end, the others in the middle,
    then all corners.
    """

    place: str  # experiment and case
    quantity: str
    observed: dict  # as the configuration states it
    limits: NDArray  # low and high, of what was observed or of the factor of the relation
    inputs: dict[str, NDArray]
    swept: tuple[str, ...]
    law: str  # name of the traction law
    known: int  # place in `GRADES` of the least known input or of what was observed
    tests: bool  # whether a published number or answer is compared with the prediction

    def pair(self, h_rms: NDArray) -> Pair:
        """`Pair` at rms heights ``(combination, n)``, for as many of the first combinations."""
        inputs = {name: values[: len(h_rms), None] for name, values in self.inputs.items()}
        shape = [inputs[name][:, 0] for name in SHAPE if name in inputs]
        moments, a_v = zip(*map(describe_shape, *shape), strict=True)
        q0, slope, curvature, energy = (values[:, None] for values in np.transpose(moments))
        ratios = inputs["range"] / h_rms
        at = [found.at(ratio)[0] for found, ratio in zip(a_v, ratios, strict=True)]
        return Pair(
            h_rms=h_rms,
            q0=q0,
            rms_slope=slope * h_rms,
            rms_curvature=curvature * h_rms,
            elastic_energy=energy * h_rms**2,
            **{name: inputs[name] for name in ("modulus", "work_of_adhesion", "range")},
            a_v=np.array(at),
            law=self.law,
        )

    def press(self, pair: Pair) -> list[sphere.SpherePullOff] | None:
        """Pull-off of the sphere, low limit, value and high limit; None between flats."""
        if "radius" not in self.inputs:
            return None
        at = self.inputs["radius"][:, None], pair.adhesion_length, pair.range
        return [sphere.pull_off(pair, *at, sign) for sign in SIGNS]


@cache
def describe_shape(hurst, longest, shortest, rolloff=None):
    """`MOMENTS` of a self-affine spectrum of unit rms height, wavelengths in m, and its a_V."""
    waves = {"q0": longest, "q1": shortest, "q_rolloff": rolloff}
    band = {name: 2 * np.pi / wave for name, wave in waves.items() if wave is not None}
    spectrum = SelfAffine(hurst=hurst, h_rms=1.0, **band)
    known = describe_surface(spectrum)
    return tuple(known[name] for name in MOMENTS), surface_a_v(spectrum, known)


def read_observation(experiment, name, entry):
    """One case of an experiment of the configuration, in SI units."""
    case = entry["cases"][name]
    observed, conditions = case["observed"], conditions_of(entry, case)
    ends = {key: read_ends(given, CONDITIONS[key][0]) for key, given in conditions.items()}
    swept = tuple(key for key, found in ends.items() if len(found) > 1)
    inputs = combine_inputs(ends, swept)
    if "plane_strain_modulus" in inputs:
        inputs["modulus"] = inputs["plane_strain_modulus"]
    else:
        inputs["modulus"] = inputs["youngs_modulus"] / (1 - inputs["poisson_ratio"] ** 2)
    quantity, by_relation = observed["quantity"], "relation" in observed
    limits = observed["factor"] if by_relation else read_ends(observed, OBSERVED[quantity][0])
    return Observation(
        place=f"{experiment}/{name}",
        quantity=quantity,
        observed=observed,
        limits=np.array([limits[0], limits[-1]], dtype=float),
        inputs=inputs,
        swept=swept,
        law=case.get("law", entry.get("law", EXPONENTIAL)),
        known=max(GRADES.index(given["known"]) for given in (observed, *conditions.values())),
        tests=entry.get("published", True) and not by_relation,
    )


def read_ends(given, unit):
    """The value, or both limits."""
    values = given["between"] if "between" in given else [given["value"]]
    return np.array([float(value) if unit is None else si(value, unit) for value in values])


def combine_inputs(ends, swept):
    """Values of every input for all combinations; see `Observation`."""
    middle = {key: found[0] for key, found in ends.items()}
    for key in swept:
        low, high = ends[key]
        middle[key] = np.sqrt(low * high) if low > 0 else high / 2
    rows = [middle, *(middle | {key: end} for key in swept for end in ends[key])]
    for corner in product(*(ends[key] for key in swept)):
        rows.append(middle | dict(zip(swept, corner, strict=True)))
    return {key: np.array([row[key] for row in rows]) for key in ends}


def predict(observation):
    """Prediction and curve, the pair, and longest waves across the contact of a sphere.

    The prediction ``(sign, combination)`` is of the quantity observed. The curve ``(sign,
    combination, roughness)`` is the relative pull-off of a sphere, or the share that remains
    between flats. The pair is at the rms heights given or, where a limit was observed, predicted.
    """
    quantity, h_rms = observation.quantity, observation.inputs.get("h_rms")
    rough = observation.pair(np.tile(ROUGHNESS, (len(observation.inputs["hurst"]), 1)))
    spheres = observation.press(rough)
    curve = [one.relative for one in spheres] if spheres else list(map(rough.remaining, SIGNS))
    if quantity == "limiting_roughness":
        level = observation.observed.get("level", DEFAULT_SHARE)
        limit = np.array([[find_fall(ROUGHNESS, row, level) for row in rows] for rows in curve])
        if np.isnan(limit).any():
            raise ValueError(
                f"{observation.place.replace('/', '.cases.')}: adhesion falls to {level:g} at no "
                f"rms height from {ROUGHNESS[0]:g} to {ROUGHNESS[-1]:g} m; correct the level or "
                "inputs"
            )
        h_rms = limit[1] if h_rms is None else h_rms
    pair = observation.pair(h_rms[:, None])
    spheres, length, reach = observation.press(pair), pair.adhesion_length, pair.range
    found = np.array([pair.remaining(sign) for sign in SIGNS])
    if quantity == "limiting_roughness":
        found = limit[..., None]
    elif spheres and quantity in OF_SPHERES:
        found = np.array([getattr(one, OF_SPHERES[quantity]) for one in spheres])
    elif quantity == "relative_pull_off":
        stress = np.array([pair.tension(length, reach, sign) for sign in SIGNS])
        found = np.minimum(stress * reach / length / find_strength(observation.law), 1.0)
    elif quantity == "work_of_approach":
        found[0] /= LATE
    elif quantity == "work_of_separation":
        found = np.array([pair.separation(length, reach, sign) for sign in SIGNS])
    if quantity.startswith("work_of"):
        found = found * pair.work_of_adhesion
    waves = 2 * spheres[1].zone_radius * pair.q0 / (2 * np.pi) if spheres else pair.q0 * np.nan
    return found[..., 0], np.array(curve), pair, float(waves[MIDDLE, 0])


def find_fall(heights, values, level):
    """Rms height [m] at which values fall to a level for good; NaN if that is not among them."""
    above = np.flatnonzero(values > level)
    if not above.size or above[-1] == values.size - 1:
        return float("nan")
    here = slice(above[-1], above[-1] + 2)
    ends = values[here]
    first, last = ends - level if ends.min() == 0 else np.log(ends / level)
    low, high = np.log(heights[here])
    return float(np.exp(low + first / (first - last) * (high - low)))


def find_observed(observation, pair):
    """Low and high limit ``(end, combination)`` of what was observed, by its relation if any."""
    factors = observation.limits[:, None] * np.ones(len(pair.h_rms))
    relation = observation.observed.get("relation")
    if relation is None:
        return factors
    work, energy = pair.work_of_adhesion[:, 0], (pair.elastic_energy * pair.modulus)[:, 0]
    if relation == "energy_ratio":
        return (pair.h_rms[:, 0] * np.sqrt(work / (factors * energy)))[::-1]
    found = (2 if relation == "cycle_loss" else 1) * factors * work - energy
    error = si(observation.observed.get("error", "0 J/m^2"), "J/m^2")
    return np.maximum(found + np.array([[-1], [1]]) * error, 0.0)


def agrees(observation, observed, least, most):
    """Whether limits of the prediction overlap with those observed, by combination."""
    if observation.quantity == "sticks":
        return most >= DEFAULT_SHARE if observation.limits[0] else least < DEFAULT_SHARE
    return (most >= observed[0]) & (least <= observed[1])


def summarise(right):
    """Place in `OUTCOMES` of what is right for all, some or no combination of the inputs."""
    return COMPATIBLE if np.all(right) else SOME if np.any(right) else MISSED


def judge_criteria(observation, observed, pair):
    """Place in `OUTCOMES` of every criterion, or `SILENT`.

    Where a limiting roughness was observed, a criterion is right if it requires there an adhesion
    within `FACTOR` of the actual one; elsewhere if it says whether the pair was seen to stick.
    """
    limiting, found = observation.quantity == "limiting_roughness", []
    if limiting:
        pair = observation.pair(observed.T)
    else:
        of_work = observation.quantity.startswith("work_of")
        low, high = observed / (observation.inputs["work_of_adhesion"] if of_work else 1.0)
        sticks = low >= DEFAULT_SHARE
        decided = sticks | (high <= DEFAULT_SHARE)
    for name, criterion in CRITERIA.items():
        right = np.array([])
        if not limiting:
            says = np.broadcast_to(criterion.margin(pair), pair.h_rms.shape)[:, 0] > 1
            right = (says == sticks)[decided]
        elif criterion.has_length:
            ratio = criterion.adhesion_length_threshold(pair) / pair.adhesion_length
            right = (ratio[:, 0] <= FACTOR) & (ratio[:, 1] >= 1 / FACTOR)
        silent = not right.size or name in observation.observed.get("silent", ())
        found.append(SILENT if silent else summarise(right))
    return np.array(found, dtype="i1")


def find_roughness(observation):
    """Rms height [m] up to which every criterion says sticky; NaN if it looks at no roughness."""
    rough = observation.pair(COARSE[None])
    return [
        find_fall(COARSE, criterion.margin(rough)[0], 1.0) if criterion.has_length else np.nan
        for criterion in CRITERIA.values()
    ]


def find_effect(observation, value):
    """Swept input that changes a prediction most, the others in the middle, and the factor."""
    effects = {} if observation.swept else {"": 1.0}
    for place, name in enumerate(observation.swept):
        along = value[[1 + 2 * place, MIDDLE, 2 + 2 * place]]
        if along.max() > 0:
            with np.errstate(divide="ignore"):
                effects[name] = float(along.max() / along.min())
    most = max(effects, key=effects.get, default="")
    return most, min(effects.get(most, np.nan), LARGEST_EFFECT)


def predict_case(observation):
    """Prediction, observation and outcome of one case."""
    predicted, curve, pair, waves = predict(observation)
    observed = find_observed(observation, pair)
    low, value, high = predicted
    most, effect = find_effect(observation, value)
    data = {
        "case": observation.place,
        "quantity": observation.quantity,
        "observed_low": observed[0, MIDDLE],
        "observed_high": observed[1, MIDDLE],
        "predicted": value[MIDDLE],
        "predicted_lowest": low.min(),
        "predicted_highest": high.max(),
        "model": max(high[MIDDLE] - value[MIDDLE], value[MIDDLE] - low[MIDDLE]),
        "pull_off_curve": ("roughness", curve[1, MIDDLE]),
        "pull_off_curve_lowest": ("roughness", curve[0].min(axis=0)),
        "pull_off_curve_highest": ("roughness", curve[2].max(axis=0)),
        "outcome": np.int8(summarise(agrees(observation, observed, low, high))),
        "value_inside": np.int8(agrees(observation, observed, value, value)[MIDDLE]),
        "by_relation": np.int8("relation" in observation.observed),
        "tests": np.int8(observation.tests),
        "known": np.int8(observation.known),
        "observed_known": np.int8(GRADES.index(observation.observed["known"])),
        "waves_in_contact": waves,
        "h_rms": pair.h_rms[MIDDLE, 0],
        "most_effective_input": most,
        "effect_of_input": effect,
        "criterion_outcome": ("criterion", judge_criteria(observation, observed, pair)),
        "criterion_roughness": ("criterion", find_roughness(observation)),
    }
    axes = {"criterion": list(CRITERIA), "roughness": ROUGHNESS}
    return xr.Dataset(data, axes).set_coords("case")


def predict_all(experiments):
    dataset = xr.concat(
        [
            predict_case(read_observation(name, case, entry))
            for name, entry in experiments.items()
            for case in entry["cases"]
        ],
        "case",
    )
    value, model = dataset.predicted, dataset.model
    reach = np.maximum(dataset.predicted_highest - value, value - dataset.predicted_lowest)
    inputs = np.sqrt(np.maximum(reach**2 - model**2, 0.0))
    dataset = datasets.annotate(dataset.drop_vars("model"), **VARIABLES)
    dataset.outcome.attrs |= datasets.flags(OUTCOMES)
    dataset.criterion_outcome.attrs |= datasets.flags(("nothing decided", *OUTCOMES), first=SILENT)
    for name in ("known", "observed_known"):
        dataset[name].attrs |= datasets.flags(GRADES)
    parts = dict.fromkeys(("discretisation", "solver"), not_applicable("closed form"))
    parts["bandwidth"] = not_applicable("the spectrum is swept with the inputs")
    parts["sampling"] = ErrorComponent(inputs, "of all that is plausible of the inputs")
    parts["model"] = ErrorComponent(model, "larger side of its limits")
    return with_budget(dataset, "predicted", **parts)


if __name__ == "__main__":
    main(start(globals(), "predict_experiments"))
