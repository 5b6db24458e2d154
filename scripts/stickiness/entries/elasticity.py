"""Elasticity and adhesion of a pair, in the forms in which they may be given."""

from typing import Annotated, Any, ClassVar, Self

from pydantic import BeforeValidator, Field, Strict, model_validator

from stickiness.entries import fields as f
from stickiness.entries.fields import Section, needed, optional
from stickiness.solids import moduli

POISSON_RATIO = 0.5  #: of most soft solids, which hardly change their volume


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


def _write_table(value: Any) -> Any:
    """Return a table of the library as an entry."""
    if isinstance(value, moduli.Table):
        return list(zip(value.frequencies, value.moduli, strict=True))
    return value


class PronyEntry(Section):
    """Prony series of Young's modulus, e.g. `[["0.3 MPa", "1 ms"]]` for its terms."""

    equilibrium: f.Modulus = needed('modulus at rest, e.g. "30 kPa"')
    terms: f.Several[Annotated[tuple[f.Modulus, f.Time], Strict(False)]] = needed(
        "pairs of modulus and relaxation time"
    )


TableEntry = Annotated[
    f.AtLeastTwo[Annotated[tuple[f.Frequency, f.Modulus], Strict(False)]],
    BeforeValidator(_write_table),
]
SeriesEntry = Annotated[PronyEntry, BeforeValidator(_write_series)]
