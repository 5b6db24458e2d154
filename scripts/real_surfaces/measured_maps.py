"""Maps of heights that are pressed: as measured, and up to which wave number they are resolved."""

from dataclasses import dataclass

from stickiness.entries import list_measurements
from stickiness.measured.topography import Topography
from stickiness.verdicts.measured_surface import Measurement


@dataclass(frozen=True)
class MeasuredMap:
    """Levelled heights of one measurement of a surface."""

    heights: Topography
    cutoff: float  #: highest wave number that the instrument resolves [1/m]


def read_map(entry, index, finest, detrend=None):
    """Map of the measurement at the place `index` of an entry; None of a line profile.

    `finest` is the highest wave number [1/m] that any measurement of the surface resolves.
    `detrend` replaces what the entry subtracts from the heights.
    """
    entries = list_measurements(entry)
    chosen = entries[index] if detrend is None else entries[index] | {"detrend": detrend}
    measurement = Measurement.from_entry(chosen)
    if not isinstance(measurement.heights, Topography):
        return None
    if len(entries) == 1:
        return MeasuredMap(measurement.heights, finest)
    # Of several measurements each resolves waves of its own.
    spectrum, _ = measurement.find_spectrum()
    return MeasuredMap(measurement.heights, min(finest, spectrum.cutoff.q))
