"""How a material and a surface become a verdict.

What goes in:

- `rough_surface`: `Surface`, what is known of a rough surface; `measured_surface`, `analysis` and
  `parametric` make one of measured heights, a drawing or parameters, `surface_variables` lists what
  it stores
- `entries.material.Material`, the solid that touches it, and its adhesion

What happens to them:

- `scenarios`: all that a surface may be, a row each, with the error of the model
- `pair_roughness`: the roughness that a material meets on a surface, with layers and two rough
  solids
- `judgement`: `judge`, the only place where pairs become numbers; `pair_variables` lists these
- `curves`, `thresholds`: what it says of other moduli, heights, rates and dwells, and of what would
  make a pair stick
- `limits`: how all that a number may be becomes its value and its limits
- `verdict`: `verdict` and `thresholds` of one pair
"""

__all__ = [
    "analysis",
    "curves",
    "judgement",
    "limits",
    "measured_surface",
    "pair_roughness",
    "pair_variables",
    "parametric",
    "rough_ball",
    "rough_surface",
    "scenarios",
    "simulated_surface",
    "surface_variables",
    "thresholds",
    "verdict",
]
