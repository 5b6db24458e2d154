"""What the paper states of its figures and claims, and where the configuration has the same.

The paper is Violano, Afferrante, Papangelo & Ciavarella, On stickiness of multiscale randomly rough
surfaces, J. Adhesion (2019), doi:10.1080/00218464.2019.1685384.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from stickiness.formatting import amount, number

A_V = 3.0  # to which a_V converges; Figures 3A, 5A and 5B
A_V_FIG4B = 2.8  # of the formula in Figure 4B
C0_LINES = (1e-3, 1e-5)  # m^0.4, of the two lines of Figure 6
HURST = 0.8  # of all panels but 3C
HURST_3C = (0.7, 0.8, 0.9)
MEAN_GAP_1B = 1.37  # over h_rms
LOAD = 0.065  # over E* q0 h_rms, of Figures 3A and 3C
CRYSTAL = 0.05  # l_a/range of a crystal on itself, to which these limits belong:
H_RMS_LIMITS = {1e-6: 1e3, 1e-9: 6.7e4, 1e-12: 1e6}  # range q0: largest h_rms/range that sticks

# Entries of the configuration that name others, and the tables of these.
REFERENCES = {"case": "cases", "surface": "model_surfaces", "fidelity": "fidelities"}
MOST_VALUES = 6  # of a list that is written out
TOLERANCE = 1e-3  # relative, within which a parameter is the paper's


class Parameter(NamedTuple):
    """A parameter of a panel or claim: the paper's values, None if unknown, and our keys."""

    symbol: str
    paper: Any
    keys: tuple[str, ...]
    unit: str = ""
    largest: bool = False  # the panel shows the largest of several values


def _of_sweep(name: str, **paper: Any) -> list[Parameter]:
    """Parameters of a sweep of theory, by its keys."""
    symbols = {"hurst": "H", "magnification": "ζ", "pressure": "p̂", "mean_gap": "ū/h_rms"}
    return [
        Parameter(symbols[key], value, (f"theory/sweeps/{name}/{key}",))
        for key, value in paper.items()
    ]


def _of_line(set_: str, near: tuple[str, ...], magnification: int, h_rms: float) -> list[Parameter]:
    """Parameters of one of the two surfaces of Figure 4B."""
    key = f"adhesion/{set_}"
    ranges = tuple(f"adhesion/{name}/range_over_h_rms" for name in (set_, *near))
    return [
        Parameter("H", HURST, (f"{key}/case/surface/hurst",)),
        Parameter("ζ", magnification, (f"{key}/case/surface/magnification",)),
        Parameter("h_rms", h_rms, (f"{key}/h_rms",), "m"),
        Parameter("L", 1e-4, (f"{key}/window",), "m"),
        Parameter("ε/h_rms", (1, 1 / 10, 1 / 50, 1 / 100), ranges),
    ]


_FIG2 = "adhesion/fig2"
_FIG2_SURFACE = [
    Parameter("H", None, (f"{_FIG2}/case/surface/hurst",)),
    Parameter("ζ", None, (f"{_FIG2}/case/surface/magnification",)),
]
_MAPS = f"{_FIG2}/maps"
ZETAS_3A = (10, 100, 500, 1000, 5000, 1e4, 2e4, 5e4)
ZETA_3B = 1000
ZETA_3D = 1000
LOADS_3B = (0.0065, 0.03, 0.07, 0.13, 0.20, 0.26, 0.33, 0.39, 0.46, 0.52)

#: Parameters by the paper's panel.
PANELS: dict[str, list[Parameter]] = {
    "1A": _of_sweep("fig1a", hurst=HURST, magnification=(10, 100, 1000), mean_gap=2),
    "1B": _of_sweep("fig1b", hurst=HURST, magnification=None, mean_gap=MEAN_GAP_1B),
    "2A": _FIG2_SURFACE,
    "2B": [
        Parameter("ε/h_rms", None, (f"{_MAPS}/range_over_h_rms",)),
        Parameter("l_a/ε", None, (f"{_MAPS}/adhesion_length_over_range",)),
        Parameter("q0 h_rms", None, (f"{_FIG2}/q0_h_rms",)),
    ],
    "2C": [
        Parameter("ε/h_rms", None, (f"{_FIG2}/range_over_h_rms",)),
        Parameter("l_a/ε", None, (f"{_FIG2}/adhesion_length_over_range",)),
    ],
    "2D–F": [Parameter("p̂", None, (f"{_FIG2}/case/maps",))],
    "2G–I": [
        Parameter("ε/h_rms", 7.5e-3, (f"{_MAPS}/range_over_h_rms",)),
        Parameter("l_a/ε", 0.2, (f"{_MAPS}/adhesion_length_over_range",), largest=True),
    ],
    "3A": _of_sweep("fig3a", hurst=HURST, magnification=ZETAS_3A, pressure=LOAD),
    "3B": _of_sweep("fig3b", hurst=HURST, magnification=ZETA_3B, pressure=LOADS_3B),
    "3C": _of_sweep("fig3c", hurst=HURST_3C, magnification=None, pressure=LOAD),
    "3D": _of_sweep("fig3d", hurst=HURST, magnification=ZETA_3D, pressure=None),
    "4A": [
        Parameter("ζ", None, ("loops/fig4a/surface/magnification",)),
        Parameter("ε/h_rms", None, ("loops/fig4a/range_over_h_rms",)),
        Parameter("l_a/ε", None, ("loops/fig4a/adhesion_length_over_range",)),
    ],
    "4B": [
        *_of_line("fig4b_rough", ("fig4b_rough_near",), 64, 5e-6),
        *_of_line("fig4b_smooth", (), 128, 1e-7),
        Parameter("realisations", 8, ("fidelity/seeds",)),
    ],
    "5A": [
        Parameter("H", HURST, ("criteria/map/hurst",)),
        Parameter("a_V", A_V, ("criteria/map/slope_a_v",)),
    ],
    "5B": [
        Parameter("a_V", A_V, ("criteria/map/slope_a_v",)),
        Parameter(
            "εq0/(l_a/ε)", (1, 3 / 4, 1 / 2, 1 / 4, 1 / 10), ("criteria/map/slope_parameter",)
        ),
    ],
    "6": [],
}


def compare_panels(config: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Compare the parameters of every panel with those of a checked configuration.

    Returns
    -------
    list of dict
        For each of the paper's panels, `panel` and its `parameters`. Each of these has the `text`
        of the value here, the `key` that sets it, the text of the `paper`'s value (empty if we do
        not know it), and whether both values are `equal`.
    """
    return [
        {"panel": panel, "parameters": [compare(config, each) for each in parameters]}
        for panel, parameters in PANELS.items()
    ]


def compare(config: Mapping[str, Any], parameter: Parameter) -> dict[str, Any]:
    """Texts of a parameter here and in the paper, and whether both are equal."""
    here = find_values(config, parameter)
    row = {
        "text": f"{parameter.symbol} = {write(here, parameter.unit)}",
        "key": ", ".join(key.replace("/", ".") for key in parameter.keys),
    }
    if parameter.paper is None:
        return row | {"paper": "", "equal": False}
    paper = np.unique(np.asarray(parameter.paper, dtype=float))
    equal = here.shape == paper.shape and np.allclose(here, paper, rtol=TOLERANCE, atol=0)
    return row | {"paper": write(paper, parameter.unit), "equal": bool(equal)}


def find_values(config: Mapping[str, Any], parameter: Parameter) -> np.ndarray:
    """Values of a parameter in the configuration, in increasing order, each of them once."""
    found = [np.atleast_1d(np.asarray(look_up(config, key), float)) for key in parameter.keys]
    values = np.unique(np.concatenate(found))
    return values[-1:] if parameter.largest else values


def look_up(config: Mapping[str, Any], path: str) -> Any:
    """Value at a path of keys with slashes between them; names of other entries are followed."""
    value: Any = config
    previous = ""
    for key in path.split("/"):
        if isinstance(value, str):
            table = "cases" if previous in config["roles"] else REFERENCES[previous]
            value = config[table][value]
        # A key that is left out, such as the loads of maps, has no values.
        value = value.get(key)
        if value is None:
            return []
        previous = key
    return value


def write(values: np.ndarray, unit: str) -> str:
    """Values of one parameter as text; of many, the ends and how many there are."""
    if not values.size:
        return "–"
    shown = values if values.size <= MOST_VALUES else values[[0, -1]]
    texts = [amount(value, unit) if unit else number(value) for value in shown]
    if values.size > MOST_VALUES:
        return f"{' … '.join(texts)} ({values.size} values)"
    return ", ".join(texts)
