"""Every material on both ends of every surface: what remains, margins, thresholds, edges."""

import numpy as np

from criteria.joint import BY_END, ENDS, join, take_surface
from stickiness import criteria
from stickiness.criteria.pair import Pair, classify_edges
from stickiness.criteria.registry import CRITERIA
from stickiness.criteria.verdict import BROAD_A_V
from stickiness.solids import Film

DIMS = ("material", "surface", "end")
LIMITS = {"": 0, "_low": -1, "_high": 1}


def join_all(materials, surfaces, own):
    """`Joint` of every pair, a row for every material; `own` has surfaces of rough materials."""
    smooth = [take_surface(surface) for surface in surfaces.values()]
    return [
        [
            join(material, surface, plain, own.get(material.surface))
            for surface, plain in zip(surfaces.values(), smooth, strict=True)
        ]
        for material in materials.values()
    ]


def gather_pairs(materials, joints) -> Pair:
    """`Pair` of arrays on the dimensions `DIMS`; `joints` of `join_all`."""
    shape = len(materials), len(joints[0]), len(ENDS)
    solids = materials.values()
    of_solids = {
        name: np.reshape([getattr(solid, name) for solid in solids], (-1, 1, 1))
        for name in ("modulus", "work_of_adhesion", "range")
    }
    of_surfaces = {
        name: np.array([[getattr(joint, name) for joint in row] for row in joints])
        for name in (*BY_END, "deep_energy")
    }
    for name in ("q0", "softness", "widening"):
        numbers = [[getattr(joint, name) for joint in row] for row in joints]
        of_surfaces[name] = np.array(numbers)[..., None]
    found = [
        [joint.a_v_at(solid.range) for joint in row]
        for solid, row in zip(solids, joints, strict=True)
    ]
    of_pairs = dict(zip(("a_v", "a_v_low", "a_v_high"), np.moveaxis(found, -1, 0), strict=True))
    every = of_solids | of_surfaces | of_pairs
    return Pair(
        **{name: np.broadcast_to(value, shape) for name, value in every.items()},
        constant_a_v=BROAD_A_V,
    )


def find_margins(pair):
    """Margin and threshold of E* by every criterion, with the criteria along the last axis."""
    dims = (*DIMS, "criterion")
    every = CRITERIA.values()
    margins = [criterion.margin(pair) for criterion in every]
    moduli = [criterion.modulus_threshold(pair) for criterion in every]
    return {
        "margin": (dims, np.stack(margins, axis=-1)),
        "threshold_by_criterion": (dims, np.stack(moduli, axis=-1)),
    }


def describe_joints(pair, joints):
    """Roughness of every pair, and what the thickness of a layer does to it."""
    names = ("stiffening", "layer_strain")
    of_joints = {
        name: (DIMS, np.array([[getattr(joint, name) for joint in row] for row in joints]))
        for name in names
    }
    moments = ("h_rms", "q0", "rms_slope", "rms_curvature")
    return of_joints | {f"pair_{name}": (DIMS, getattr(pair, name)) for name in moments}


def describe_remaining(pair, materials):
    """What remains of adhesion on every pair, the margin's limits, thresholds of E*, pull-off.

    There is no threshold with an elastic backing: the modulus of the layer alone cannot change
    without changing what the layer does.
    """
    known = [1.0 if is_scalable(solid) else np.nan for solid in materials.values()]
    known = np.reshape(known, (-1, 1, 1))
    low, high = pair.margin_limits()
    lowest, value, highest = (
        known * pair.work_of_adhesion / pair.remaining_threshold(sign) for sign in (-1, 0, 1)
    )
    stresses = [stress * pair.modulus for stress in pair.pull_off()]
    values = {
        **{f"remaining{end}": pair.remaining(sign) for end, sign in LIMITS.items()},
        **{f"pull_off{end}": x for end, x in zip(LIMITS, stresses, strict=True)},
        "energy_ratio": pair.adhesion_length / pair.elastic_energy,
        "margin_low": low,
        "margin_high": high,
        "modulus_threshold": value,
        "modulus_threshold_low": lowest,
        "modulus_threshold_high": highest,
    }
    return {name: (DIMS, value) for name, value in values.items()}


def is_scalable(material):
    """Whether all that deforms goes with the material's modulus: it has no elastic backing."""
    return not isinstance(getattr(material.solid, "backing", None), Film)


def describe_edges(pair):
    """State of the edges of every pair."""
    found = pair.attraction()
    validity = criteria.dmt_validity(pair.h_rms, pair.q0, pair.adhesion_length, pair.range)
    values = {
        "pair_a_v": pair.a_v,
        "pair_a_v_low": pair.a_v_low,
        "pair_a_v_high": pair.a_v_high,
        "range_over_h_rms": pair.range / pair.h_rms,
        "edge_strength": found.strength,
        "attractive_over_contact": found.attractive_over_contact,
        "over_dmt": found.effect,
        "regime": classify_edges(found).astype("i1"),
        "simulated": found.simulated.astype("i1"),
        "jtb_margin": validity.margin,
    }
    return {name: (DIMS, value) for name, value in values.items()}


def follow_rates(materials, frequencies):
    """Modulus at every frequency; beyond a material's table there is none."""
    solids = materials.values()
    moduli = np.array([np.atleast_1d(m.plane_strain.storage(frequencies)) for m in solids])
    return {
        "frequency": ("frequency", frequencies),
        "modulus": (("material", "frequency"), moduli),
        "modulus_quoted": ("material", [m.modulus for m in solids]),
        "depends_on_rate": ("material", [int(m.depends_on_rate) for m in solids]),
    }
