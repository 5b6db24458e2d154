"""Published experiments: works of approach and separation and pull-off, beside what was seen.

Everything that is not known is swept: each input between its plausible ends, the others in their
middle, and all corners. Corners matter where two unknown inputs move a prediction the same way.
"""

from dataclasses import dataclass
from functools import cache, partial
from itertools import product

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from common import experiment_outcomes as outcomes
from common.config.conditions import conditions_of
from common.experiment_outcomes import COMPATIBLE, GRADES, MARKS, MISSED, OUTCOMES, SILENT, SOME
from common.job import start
from experiments import plot_experiments
from stickiness import datasets
from stickiness.criteria.a_v_theory import surface_a_v
from stickiness.criteria.pair import Pair
from stickiness.criteria.registry import CRITERIA
from stickiness.error_budget import ErrorComponent, not_applicable, with_budget
from stickiness.pages.rendering import write_page
from stickiness.remaining import errors, sphere
from stickiness.remaining.errors import BALL, PATH, SUMMITS
from stickiness.remaining.roughness import Roughness
from stickiness.remaining.trial_states import DEFAULT_SHARE
from stickiness.spectrum.kinds import SelfAffine
from stickiness.traction_laws import find_strength

MIDDLE = 0  # index of the combination with every input in the middle
ROUGHNESS = np.geomspace(1e-11, 1e-3, 121)  # rms heights [m] along which adhesion is followed
# Margins are nearly powers of the rms height: between points as far apart as these they are read
# off to better than 1 %.
COARSE = ROUGHNESS[::4]
FACTOR = 4.0  # between the adhesion that a criterion requires and the actual one, if it is right

_QUANTITY = "the quantity observed, in its SI unit"
_CURVE = "pull-off over that from a smooth surface"
_LOWEST = "lowest limit over all that is plausible"
_HIGHEST = "highest limit over all that is plausible"
_BEYOND = "looks at no roughness, or beyond the heights followed"
EXPERIMENT_VARIABLES = {
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
    title = "published experiments, predicted"
    parameters = {"experiments": experiments}
    datasets.write(dataset, job.output.dataset, title=title, parameters=parameters)
    write_page(
        job.input.template,
        job.output.table,
        **outcomes.describe(dataset, experiments),
        wanted=DEFAULT_SHARE,
        factor=FACTOR,
        fewest_waves=sphere.FEWEST_WAVES,
        criteria=[criterion.label for criterion in CRITERIA.values()],
        survivals=[
            (experiments[name]["label"], *map(MARKS.get, codes))
            for name, *codes in find_survivals(dataset).itertuples()
        ],
    )
    plot_experiments.draw(dataset, experiments, (job.output.png, job.output.pdf))


def find_survivals(dataset):
    """Find the worst outcome of every criterion by experiment; `SILENT` where nothing is tested."""
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
        shape_names = ("hurst", "longest_wavelength", "shortest_wavelength", "rolloff_wavelength")
        columns = [inputs[name][:, 0] for name in shape_names if name in inputs]
        shapes = [describe_shape(*row) for row in zip(*columns, strict=True)]
        prefactors = [
            shape["a_v"].at(ratio)[0]
            for shape, ratio in zip(shapes, inputs["range"] / h_rms, strict=True)
        ]

        def column(name):
            return np.array([shape[name] for shape in shapes])[:, None]

        rough = Roughness(
            h_rms=h_rms,
            q0=column("q0"),
            q1=column("q1"),
            rms_slope=column("rms_slope") * h_rms,
            elastic_energy=column("elastic_energy") * h_rms**2,
            law=self.law,
        )
        return Pair(
            rough=rough,
            modulus=inputs["modulus"],
            work_of_adhesion=inputs["work_of_adhesion"],
            range=inputs["range"],
            rms_curvature=column("rms_curvature") * h_rms,
            a_v=np.array(prefactors),
        )

    def press(self, pair: Pair) -> list[sphere.SpherePullOff] | None:
        """Pull-off of the sphere, low limit, value and high limit; None between flats.

        Unlike `rough_ball`, it counts waves below the roll-off that are longer than the zone. They
        take 4 % of the force at most in the experiments, and to leave them out for every height and
        combination would take an hour.
        """
        if "radius" not in self.inputs:
            return None
        pull_off = partial(
            sphere.pull_off,
            radius=self.inputs["radius"][:, None],
            adhesion_length=pair.adhesion_length,
            range=pair.range,
        )
        summits = SUMMITS.spread.value
        zone = pull_off(rough=sphere.narrow(pair.rough, waves=1.0, summits=summits)).zone_radius
        # The longest waves across the zone.
        waves = np.asarray(zone) * pair.q0 / np.pi
        rough = sphere.narrow(pair.rough, waves=waves, summits=summits)
        return limit(rough, lambda each: pull_off(rough=each, error=BALL.spread.high))


@cache
def describe_shape(hurst, longest, shortest, rolloff=None):
    """What criteria need of a self-affine spectrum of unit rms height, wavelengths in m."""
    spectrum = SelfAffine(
        hurst=hurst,
        h_rms=1.0,
        q0=2 * np.pi / longest,
        q1=2 * np.pi / shortest,
        q_rolloff=None if rolloff is None else 2 * np.pi / rolloff,
    )
    moments = {
        "q0": spectrum.q_longest,
        "h_rms": spectrum.h_rms,
        "rms_slope": spectrum.rms_slope,
        "rms_curvature": spectrum.rms_curvature,
    }
    return moments | {
        "q1": spectrum.q1,
        "elastic_energy": spectrum.elastic_energy(),
        "a_v": surface_a_v(spectrum, moments),
    }


def read_observation(experiment, name, entry):
    """One case of an experiment of the configuration, in SI units."""
    case = entry["cases"][name]
    observed = case["observed"]
    conditions = conditions_of(entry, case)
    ends = {key: read_ends(entries) for key, entries in conditions.items()}
    swept = tuple(key for key, limits_of_input in ends.items() if len(limits_of_input) > 1)
    inputs = combine_inputs(ends, swept)
    if "plane_strain_modulus" in inputs:
        inputs["modulus"] = inputs["plane_strain_modulus"]
    else:
        inputs["modulus"] = inputs["youngs_modulus"] / (1 - inputs["poisson_ratio"] ** 2)
    quantity = observed["quantity"]
    by_relation = observed["relation"] is not None
    limits = observed["factor"] if by_relation else read_ends(observed)
    return Observation(
        place=f"{experiment}/{name}",
        quantity=quantity,
        observed=observed,
        limits=np.array([limits[0], limits[-1]], dtype=float),
        inputs=inputs,
        swept=swept,
        law=case["law"] or entry["law"],
        known=max(GRADES.index(entries["known"]) for entries in (observed, *conditions.values())),
        tests=entry["published"] and not by_relation,
    )


def read_ends(entry):
    """Read the value of an entry, or both of its limits."""
    return np.array(entry["between"] or [entry["value"]], dtype=float)


def combine_inputs(ends, swept):
    """List the values of every input for all combinations; see `Observation`."""
    middle = {key: limits[0] for key, limits in ends.items()}
    for key in swept:
        low, high = ends[key]
        middle[key] = np.sqrt(low * high) if low > 0 else high / 2
    rows = [middle, *(middle | {key: end} for key in swept for end in ends[key])]
    for corner in product(*(ends[key] for key in swept)):
        rows.append(middle | dict(zip(swept, corner, strict=True)))
    return {key: np.array([row[key] for row in rows]) for key in ends}


@dataclass(frozen=True)
class Prediction:
    """What is predicted of one observation; signs are low limit, value and high limit."""

    quantity: NDArray  # (sign, combination), of the quantity observed
    #: (sign, combination, roughness): relative pull-off of a sphere, or the share that remains
    #: between flats.
    curve: NDArray
    pair: Pair  # at the rms heights given or, where a limit was observed, predicted
    waves: float  # longest waves across the contact of a sphere, NaN between flats


def predict(observation):
    """Predict the quantity observed, and the curve of adhesion against roughness."""
    # Along the roughness, for every combination of the inputs.
    combinations = len(observation.inputs["hurst"])
    rough = observation.pair(np.tile(ROUGHNESS, (combinations, 1)))
    spheres = observation.press(rough)
    if spheres:
        curve = np.array([pull_off.relative for pull_off in spheres])
    else:
        curve = predict_remaining(rough)

    # At the rms heights given, or else at those to which roughness is limited.
    limiting = observation.quantity == "limiting_roughness"
    limits = find_limits(observation, curve) if limiting else None
    h_rms = observation.inputs.get("h_rms")
    if h_rms is None:
        h_rms = limits[1]
    pair = observation.pair(h_rms[:, None])
    spheres = observation.press(pair)
    quantity = limits if limiting else predict_quantity(observation, pair, spheres)[..., 0]
    waves = np.nan
    if spheres:
        _, value, _ = spheres
        waves = float((2 * value.zone_radius * pair.q0 / (2 * np.pi))[MIDDLE, 0])
    return Prediction(quantity=quantity, curve=curve, pair=pair, waves=waves)


def find_limits(observation, curve):
    """Rms heights [m], (sign, combination), at which adhesion falls to the level observed."""
    level = observation.observed["level"]
    limits = np.array([[find_fall(ROUGHNESS, row, level) for row in rows] for rows in curve])
    if np.isnan(limits).any():
        raise ValueError(
            f"{observation.place.replace('/', '.cases.')}: adhesion falls to {level:g} at no "
            f"rms height from {ROUGHNESS[0]:g} to {ROUGHNESS[-1]:g} m; correct the level or "
            "inputs"
        )
    return limits


def predict_quantity(observation, pair, spheres):
    """Predict a pull-off, a work or the share that remains, (sign, combination, 1)."""
    quantity = observation.quantity
    length = pair.adhesion_length
    range_ = pair.range
    of_spheres = {"relative_pull_off": "relative", "work_of_separation": "work"}  # `SpherePullOff`
    if spheres and quantity in of_spheres:
        predicted = np.array([getattr(pull_off, of_spheres[quantity]) for pull_off in spheres])
    elif quantity == "relative_pull_off":
        stress = np.array(limit(pair.rough, lambda each: each.tension(length, range_)))
        predicted = np.minimum(stress * range_ / length / find_strength(observation.law), 1.0)
    elif quantity == "work_of_separation":
        predicted = np.array(limit(pair.rough, lambda each: each.separation(length, range_)))
    else:
        predicted = predict_remaining(pair)
        if quantity == "work_of_approach":
            predicted[0] *= np.exp(PATH.spread.low)
    if quantity.startswith("work_of"):
        predicted = predicted * pair.work_of_adhesion
    return predicted


def predict_remaining(pair):
    """Share of the work of adhesion that remains, (sign, combination, 1)."""
    return np.array(limit(pair, lambda each: each.remaining))


def limit(model, evaluate):
    """Low limit, value and high limit of what is evaluated of a model."""
    value, low, high = errors.find_limits(model, evaluate)
    return [low, value, high]


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
    factors = observation.limits[:, None] * np.ones(len(pair.h_rms))  # observed, if no relation
    relation = observation.observed["relation"]
    if relation is None:
        return factors
    work = pair.work_of_adhesion[:, 0]
    energy = (pair.elastic_energy * pair.modulus)[:, 0]
    if relation == "energy_ratio":
        return (pair.h_rms[:, 0] * np.sqrt(work / (factors * energy)))[::-1]
    works = (2 if relation == "cycle_loss" else 1) * factors * work - energy
    error = observation.observed["error"] or 0.0
    return np.maximum(works + np.array([[-1], [1]]) * error, 0.0)


def agrees(observation, observed, least, most):
    """Whether limits of the prediction overlap with those observed, by combination."""
    if observation.quantity == "sticks":
        return most >= DEFAULT_SHARE if observation.limits[0] else least < DEFAULT_SHARE
    return (most >= observed[0]) & (least <= observed[1])


def summarise(right):
    """Place in `OUTCOMES` of what is right for all, some or no combination of the inputs."""
    if np.all(right):
        return COMPATIBLE
    return SOME if np.any(right) else MISSED


def judge_criteria(observation, observed, pair):
    """Place in `OUTCOMES` of every criterion, or `SILENT`.

    Where a limiting roughness was observed, a criterion is right if it requires there an adhesion
    within `FACTOR` of the actual one; elsewhere if it says whether the pair was seen to stick.
    """
    limiting = observation.quantity == "limiting_roughness"
    codes = []
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
        silent = not right.size or name in (observation.observed["silent"] or ())
        codes.append(SILENT if silent else summarise(right))
    return np.array(codes, dtype="i1")


def find_roughness(observation):
    """Rms height [m] up to which every criterion says sticky; NaN if it looks at no roughness."""
    rough = observation.pair(COARSE[None])
    return [
        find_fall(COARSE, criterion.margin(rough)[0], 1.0) if criterion.has_length else np.nan
        for criterion in CRITERIA.values()
    ]


def find_effect(observation, value):
    """Find the swept input that changes a prediction most, and the factor; others in the middle."""
    effects = {} if observation.swept else {"": 1.0}
    for place, name in enumerate(observation.swept):
        along = value[[1 + 2 * place, MIDDLE, 2 + 2 * place]]
        if along.max() > 0:
            with np.errstate(divide="ignore"):
                effects[name] = float(along.max() / along.min())
    most_effective = max(effects, key=effects.get, default="")
    largest_effect = 1e9  # of an input, instead of an infinite one
    return most_effective, min(effects.get(most_effective, np.nan), largest_effect)


def predict_case(observation):
    """Prediction, observation and outcome of one case."""
    prediction = predict(observation)
    pair = prediction.pair
    observed = find_observed(observation, pair)
    low, value, high = prediction.quantity
    lowest_curve, curve, highest_curve = prediction.curve
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
        "pull_off_curve": ("roughness", curve[MIDDLE]),
        "pull_off_curve_lowest": ("roughness", lowest_curve.min(axis=0)),
        "pull_off_curve_highest": ("roughness", highest_curve.max(axis=0)),
        "outcome": np.int8(summarise(agrees(observation, observed, low, high))),
        "value_inside": np.int8(agrees(observation, observed, value, value)[MIDDLE]),
        "by_relation": np.int8(observation.observed["relation"] is not None),
        "tests": np.int8(observation.tests),
        "known": np.int8(observation.known),
        "observed_known": np.int8(GRADES.index(observation.observed["known"])),
        "waves_in_contact": prediction.waves,
        "h_rms": pair.h_rms[MIDDLE, 0],
        "most_effective_input": most,
        "effect_of_input": effect,
        "criterion_outcome": ("criterion", judge_criteria(observation, observed, pair)),
        "criterion_roughness": ("criterion", find_roughness(observation)),
    }
    axes = {"criterion": list(CRITERIA), "roughness": ROUGHNESS}
    return xr.Dataset(data, axes).set_coords("case")


def predict_all(experiments):
    """Predict every case of every experiment."""
    dataset = xr.concat(
        [
            predict_case(read_observation(name, case, entry))
            for name, entry in experiments.items()
            for case in entry["cases"]
        ],
        "case",
    )
    value = dataset.predicted
    model = dataset.model
    reach = np.maximum(dataset.predicted_highest - value, value - dataset.predicted_lowest)
    inputs = np.sqrt(np.maximum(reach**2 - model**2, 0.0))
    dataset = datasets.annotate(dataset.drop_vars("model"), **EXPERIMENT_VARIABLES)
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
    main(start(globals()))
