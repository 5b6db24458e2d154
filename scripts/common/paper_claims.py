"""Parameters that the paper's claims are about, and where the configuration differs from them.

A grade of a claim whose parameters differ would be a statement on something else.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from common.paper_panels import (
    C0_LINES,
    HURST,
    LOAD,
    LOADS_3B,
    PANELS,
    TOLERANCE,
    Parameter,
    find_values,
    write,
)

# Numbers of the paper's examples.
RANGE = 0.2e-9  # m
WORK_OF_ADHESION = 0.05  # J/m^2
PRINTED_MODULUS = 0.2  # MPa, of a block that sticks to asphalt
ASPHALT = {"q0": 1e3, "hurst": HURST, "C0": C0_LINES[0]}  # SI
STEEL = {"longest_wavelength": 1e-4, "h_rms": 1e-6}  # m, polished

# Ends of what the claims state or what their grades cover.
LOADS_OF_GAPS = (0.1, 0.001)  # at which mean gaps are 1 and 3 h_rms (claim 4)
LOADS_OF_A_V = (0.001, 0.1)  # over which a_V should be steady (claim 9)
ZETAS_OF_A_V = (1e3, 1e5)  # at which a_V should be about 3 (claim 8)
LENGTHS_4B = (1e-6, 1.0)  # six decades of l_a/range (claim 11)
RANGE_2 = 7.5e-3  # over h_rms, of the maps with adhesion in Figure 2 (claim 5)
LINEAR_LOADS = (LOAD, 0.15)  # up to an area of 30 % at kappa = 2 (claim 1)

# How the values of the configuration have to agree with those of a claim.
SAME = "same"
AMONG = "among"  # further values do no harm, because the claim selects its own
BETWEEN = "between"  # the claim's values lie within those of the configuration


class Need(NamedTuple):
    """A parameter of a claim, and how the configuration has to agree with it."""

    parameter: Parameter
    agree: str = SAME


def _panel(name: str) -> list[Need]:
    """Known parameters of a panel. Claims select Hurst exponents and magnifications by value."""
    known = [each for each in PANELS[name] if each.paper is not None]
    return [Need(each, AMONG if each.symbol in "Hζ" else SAME) for each in known]


def _hurst(*paths: str) -> list[Need]:
    """Hurst exponent of model surfaces, by what names them."""
    return [Need(Parameter("H", HURST, (f"{path}/surface/hurst",))) for path in paths]


def _load(*paths: str) -> list[Need]:
    """Load of the paper among the pressures of simulations."""
    return [Need(Parameter("p̂", LOAD, (f"{path}/pressures",)), AMONG) for path in paths]


def _covers(symbol: str, ends: tuple[float, float], *keys: str) -> list[Need]:
    """Range of values that the configuration has to cover, at every key by itself."""
    return [Need(Parameter(symbol, ends, (key,)), BETWEEN) for key in keys]


_BROAD_BAND = "roles/broad_band"
_WIDE_CELL = "roles/wide_cell"
_FIG2 = "adhesion/fig2"
_FIG4B = ("adhesion/fig4b_rough", "adhesion/fig4b_rough_near", "adhesion/fig4b_smooth")
_STEEL = "surfaces/polished_steel"
_ASPHALT = [
    Need(Parameter("H", ASPHALT["hurst"], ("surfaces/asphalt/hurst",))),
    Need(
        Parameter("λ_L", 2 * np.pi / ASPHALT["q0"], ("surfaces/asphalt/longest_wavelength",), "m")
    ),
    Need(Parameter("C0", ASPHALT["C0"], ("surfaces/asphalt/C0",), largest=True)),
]

#: Parameters by the number of a claim. The other claims are about closed forms, about any surface
#: (18), or about tables and experiments that the configuration does not parametrise (21, 22).
CLAIMS: dict[int, list[Need]] = {
    1: [
        *_hurst(_BROAD_BAND),
        Need(Parameter("ζ", 128, (f"{_BROAD_BAND}/surface/magnification",))),
        *_load(_BROAD_BAND),
        *_covers("p̂", LINEAR_LOADS, f"{_BROAD_BAND}/pressures"),
    ],
    2: _panel("1B"),
    3: _panel("3A"),
    4: [
        *_panel("3D"),
        *_hurst(_WIDE_CELL),
        *_covers("p̂", LOADS_OF_GAPS, f"{_WIDE_CELL}/pressures"),
    ],
    5: [
        *_hurst(f"{_FIG2}/case"),
        Need(Parameter("ε/h_rms", RANGE_2, (f"{_FIG2}/range_over_h_rms",)), AMONG),
        *_load(_FIG2),
    ],
    6: _panel("3A"),
    7: [
        *_panel("3B"),
        *_hurst(_WIDE_CELL),
        *_covers("p̂", (LOADS_3B[0], LOADS_3B[-1]), f"{_WIDE_CELL}/pressures"),
    ],
    8: [*_panel("3C"), *_covers("ζ", ZETAS_OF_A_V, "theory/sweeps/fig3c/magnification")],
    9: [
        *_panel("3D"),
        *_covers("p̂", LOADS_OF_A_V, "theory/sweeps/fig3d/pressure"),
    ],
    10: _hurst("loops/fig4a"),
    11: [
        *(need for need in _panel("4B") if need.parameter.symbol != "realisations"),
        *_load(*_FIG4B),
        *_covers("l_a/ε", LENGTHS_4B, *(f"{name}/adhesion_length_over_range" for name in _FIG4B)),
    ],
    12: [*_panel("5A"), *(need for need in _panel("5B") if need.parameter.symbol != "a_V")],
    14: _ASPHALT,
    15: [
        Need(Parameter("λ_L", STEEL["longest_wavelength"], (f"{_STEEL}/longest_wavelength",), "m")),
        Need(Parameter("h_rms", STEEL["h_rms"], (f"{_STEEL}/h_rms",), "m")),
    ],
    20: _ASPHALT,
}


def find_differences(
    config: Mapping[str, Any], surfaces: Mapping[str, Any]
) -> dict[int, list[dict[str, str]]]:
    """Find where a checked configuration differs from the parameters of the claims.

    Parameters
    ----------
    config : mapping
        Checked configuration, in SI units.
    surfaces : mapping
        Checked entries of the real surfaces.

    Returns
    -------
    dict
        By the number of the claim, for each parameter that differs: the `key` in the configuration,
        the text of its value `here`, and that of the `paper`.
    """
    whole = {**config, "surfaces": surfaces}
    return {
        number: [describe(whole, need.parameter) for need in needs if not is_met(whole, need)]
        for number, needs in CLAIMS.items()
    }


def is_met(config: Mapping[str, Any], need: Need) -> bool:
    """Whether the configuration has a parameter as the claim needs it."""
    here = find_values(config, need.parameter)
    paper = np.unique(np.asarray(need.parameter.paper, dtype=float))
    if not here.size:
        return False
    if need.agree == BETWEEN:
        low, high = paper[[0, -1]]
        return bool(here[0] <= low * (1 + TOLERANCE) and here[-1] >= high * (1 - TOLERANCE))
    near = np.isclose(here[:, None], paper, rtol=TOLERANCE, atol=0)
    return bool(near.any(axis=0).all() and (need.agree == AMONG or near.any(axis=1).all()))


def describe(config: Mapping[str, Any], parameter: Parameter) -> dict[str, str]:
    """Key of a parameter, its value in the configuration and in the paper."""
    paper = np.unique(np.asarray(parameter.paper, dtype=float))
    return {
        "key": ", ".join(key.replace("/", ".") for key in parameter.keys),
        "here": f"{parameter.symbol} = {write(find_values(config, parameter), parameter.unit)}",
        "paper": write(paper, parameter.unit),
    }
