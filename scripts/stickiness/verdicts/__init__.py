"""How a material and a surface become a verdict.

What goes in:

- `rough_surface`: `Surface`, what is known of a rough surface; `analysis` makes one of measured
  heights, `surface_data` of a drawing or of parameters, and lists what it stores; `longer_waves`
  adds what a contact meets that is larger than a scan
- `entries.material.Material`, the solid that touches it, and its adhesion

What happens to them:

- `meeting`: a material meets a surface, in each spectrum that this may have
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
    "longer_waves",
    "meeting",
    "pair_variables",
    "rough_ball",
    "rough_surface",
    "simulated_surface",
    "surface_data",
    "thresholds",
    "verdict",
]
