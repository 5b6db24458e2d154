"""Elasticity and adhesion of a pair, in the forms in which they may be given."""

import re
from pathlib import Path
from typing import Annotated, Any, ClassVar, Self

import numpy as np
from pydantic import BeforeValidator, Field, Strict, ValidationInfo, model_validator

from stickiness.entries import fields as f
from stickiness.entries.fields import Section, needed, optional
from stickiness.measured.readers.columns import read_columns
from stickiness.solids import moduli

POISSON_RATIO = 0.5  #: of most soft solids, which hardly change their volume

# Columns of a rheometer's file, by the keys that take it.
_PRIME = "['′’´]"  # noqa: RUF001
_WORDS = "(?:storage modulus|speichermodul)"
_STORAGE = {
    "youngs_modulus_table": (
        rf"E ?{_PRIME}|E[ _]prime|(?:tensile |young'?s )?{_WORDS}(?:,? E ?{_PRIME})?"
    ),
    "shear_modulus_table": rf"G ?{_PRIME}|G[ _]prime|(?:shear )?{_WORDS}(?:,? G ?{_PRIME})?",
}
_FREQUENCY = r"(?:angular |kreis)?(?:frequency|freq\.?|frequenz)|f|ω|omega"


class ElasticPair(Section):
    """Elasticity and adhesion of a pair of solids."""

    one_of: ClassVar[tuple[tuple[str, ...], ...]] = (("plane_strain_modulus", "youngs_modulus"),)

    plane_strain_modulus: f.Modulus = optional('E* of the pair, e.g. "2 MPa"')
    youngs_modulus: f.Maybe[f.Modulus] = optional('Young\'s modulus, e.g. "3 GPa"')
    poisson_ratio: f.Maybe[Annotated[float, Field(gt=-1, le=0.5)]] = optional(
        f"Poisson's ratio; default {POISSON_RATIO:g}, unless E* is given"
    )
    work_of_adhesion: f.Energy = needed(
        'work of adhesion of the pair, e.g. "50 mJ/m^2"; no energy of peeling'
    )
    range: f.Range = needed('range of the attraction, e.g. "0.2 nm"')

    @model_validator(mode="after")
    def complete_elasticity(self) -> Self:
        """Fill in Poisson's ratio, which E* has in itself."""
        if self.plane_strain_modulus is not None:
            self.fill_in("poisson_ratio", None)
        elif self.poisson_ratio is None:
            self.fill_in("poisson_ratio", POISSON_RATIO)
        return self


def _write_series(value: Any) -> Any:
    """Return a series of the library as an entry."""
    if isinstance(value, moduli.Prony):
        return {"equilibrium": value.equilibrium, "terms": list(value.terms)}
    return value


def _write_table(value: Any, info: ValidationInfo) -> Any:
    """Return a table of the library, or a file of a rheometer, as an entry."""
    if isinstance(value, moduli.Table):
        return list(zip(value.frequencies, value.moduli, strict=True))
    if isinstance(value, str | Path):
        return _read_table(Path(value), str(info.field_name))
    return value


def _read_table(path: Path, key: str) -> list[tuple[str, str]]:
    """Pairs of frequency and storage modulus, with the units that their columns tell."""
    patterns = {"frequency": _FREQUENCY, "modulus": _STORAGE[key]}
    columns = read_columns(path, patterns)
    wanted = "E' [Pa]" if key == "youngs_modulus_table" else "G' [Pa]"
    if len(columns) < 2 or not all(unit for _, unit, _ in columns.values()):
        raise ValueError(
            f"needs columns of the frequency and of a storage modulus, named with their units, "
            f"e.g. Frequency [Hz], {wanted}; E' goes with youngs_modulus_table, G' with "
            "shear_modulus_table"
        )
    name, unit, frequencies = columns["frequency"]
    is_angular = re.match("(?i)ang|kreis|ω|omega", name)
    if is_angular and "rad" not in unit:
        raise ValueError(f"the {name} is in {unit}: write rad/s")
    _, modulus_unit, storage = columns["modulus"]
    pairs = zip(frequencies.tolist(), storage.tolist(), strict=True)
    known = sorted(pair for pair in pairs if np.isfinite(pair).all())
    return [(f"{f:.12g} {unit}", f"{modulus:.12g} {modulus_unit}") for f, modulus in known]


class PronyEntry(Section):
    """Prony series of Young's modulus, e.g. `[["0.3 MPa", "1 ms"]]` for its terms."""

    equilibrium: f.Modulus = needed('modulus at rest, e.g. "30 kPa"')
    terms: f.Several[Annotated[tuple[f.Modulus, f.Time], Strict(False)]] = needed(
        "pairs of modulus and relaxation time"
    )


_Pairs = f.AtLeastTwo[Annotated[tuple[f.Frequency, f.Modulus], Strict(False)]]
TableEntry = Annotated[_Pairs, BeforeValidator(_write_table, json_schema_input_type=_Pairs | str)]
SeriesEntry = Annotated[PronyEntry, BeforeValidator(_write_series)]
