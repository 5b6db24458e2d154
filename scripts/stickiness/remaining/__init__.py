"""How much adhesion remains on a rough surface: simulated, or predicted from the spectrum.

- `measurement`: works of approach and separation and pull-off of given heights, simulated
- `zero_load`: share that remains at zero load on given heights, simulated without a path
- `share`: share of the work of adhesion that remains, from weak to tough, in closed form
- `roughness`: the same with limits, and the adhesion that a share needs
- `solid_response`: how layers, films and skins take full contact
- `prediction`: what remains, predicted from a spectrum
- `full_contact`: elastic energy of full contact, of a spectrum or of heights
- `sphere`: pull-off of a sphere from a rough surface
"""

from importlib import import_module

from stickiness.remaining.prediction import Prediction, predict
from stickiness.remaining.roughness import Roughness

__all__ = ["Prediction", "Remaining", "Roughness", "measure", "predict"]  # noqa: PLE0604


def __getattr__(name: str):
    # Predictions need no solver: it is loaded with the first simulation.
    if name in ("Remaining", "measure"):
        return getattr(import_module("stickiness.remaining.measurement"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
