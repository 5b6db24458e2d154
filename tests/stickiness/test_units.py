"""Numbers with units in texts: what is read, what is asked back, and what is refused."""

import math
import re

import pytest

from stickiness.units import Quantity, si, si_of_unit

READ = {
    "m": {
        1e-7: ["0.1 um", "0.1um", "0.1 µm", "0.1 μm", "0.1 micron", "1e-1 microns", "0.1 mu"],
        1.5e-3: ["1 500 um", "1\u202f500 um", "1\xa0500 um", "1'500 um", "1’500 um", "1_500 um"],
        1.5005e-3: ["1 500.5 um", "1 500 500 nm", "1500.5 um", "+1.5005e-3 m", "1.5005E−3 m"],
        1.92e-4: ["192 mkm", "192 мкм", "192 ㎛", "192 Âµm", "192 Î¼m", "１９２ μm"],  # noqa: RUF001
        2e-5: ["2·10^-5 m", "2*10**-5 m", "2 x 10^-5 m", "2×10⁻⁵ m", "2⋅10^(-5) m"],
        5e-4: ["1/2 mm", "500000 nm"],
        -5e-6: ["−5 um", "-5 um"],
        5.08e-5: ["2 mil", "2 mils", "2 thou", "0.002 inch", "0.002 in"],
        5e-8: ["500 Angstrom", "500 angstroms", "500 Å", "500 \u212b", "500 Ang"],
    },
    "Pa": {
        1.2e6: ["1 200 000 Pa", "1.2 MPa", "1.2 N/mm²", "1.2 N/mm2", "1.2 MN/m^2", "12 bar"],
        2e5: ["2e6 erg/cm^3", "2E6 erg/cm3", "2e6erg/cc", "2e6 dyn/cm²", "2×10⁵ Pa", "200 kPa"],
        1e5: ["10^5 Pa", "10⁵ Pa", "10**5 Pa", "1e5 Pa", "1 x 10^5 Pa", "10² kPa", "10^-1 MPa"],
        137895.146: ["20 psi", "20 PSI", "20 Psi", "0.02 ksi", "20 lbf/in^2"],
        98066.5: ["1 kgf/cm^2", "1 kp/cm2"],
    },
    "J/m^2": {
        0.05: ["50 mJ/m^2", "50 mJ/m2", "50 mJ/m²", "50 mJ m⁻²", "50 mJ m-2", "50 mJ.m-2"],
        0.06: ["60 erg/cm^2", "60 ergs/cm2", "60 dyn/cm", "60 dyne/cm", "60 mN/m", "0.06 N/m"],
    },
    "Hz": {
        1.0: [
            "1 Hz",
            "1/s",
            "1 1/s",
            "1 s^-1",
            "60 1/min",
            "60/min",
            "60 rpm",
            "6.283185307 rad/s",
        ],
    },
    "1/m": {
        2e3 * math.pi: ["1 cycle/mm", "1 cycles/mm"],
        1e3: ["1e3 1/m", "1 000 1/m", "1 1/mm", "1 mm⁻¹", "1/mm"],
    },
    "m^0.4": {1e-3: ["1e-3 m^0.4"]},
    "Pa*s": {1e-3: ["1 mPa*s", "1 mPa·s", "1e-3 Pa s"]},
    "": {0.2: ["20 %", "20%"]},
}
#: What is asked or said, by what is typed.
REFUSED = {
    "m": {
        "1,500 um": "did you mean '1.5 um' or '1500 um'?",
        "2,5 nm": "holds a comma, where a decimal point is wanted; did you mean '2.5 nm'?",
        "0,500 um": "did you mean '0.5 um'?",
        "1,500,000 nm": "did you mean '1500000 nm'?",
        "1.500,5 um": "did you mean '1500.5 um'?",
        **dict.fromkeys(["1 50 um", "15 00 um", "1500 000 um", "1.500.000 um"], "no single number"),
        **dict.fromkeys(["1 500'000 um", "5 1 um", "3-5 um", "5 ± 1 um"], "no single number"),
        **dict.fromkeys(["512 px", "512 pixels", "100 point", "2 dots"], "a screen or of print"),
        "2 Mm": "Mm is megametre, a thousand kilometres; did you mean '2 mm'?",
        **dict.fromkeys(["192*144 um", "2 x 22 um", "3 ppm um", "2x105 um", "2×10 5 um"], "single"),
        **dict.fromkeys(
            ["10 mim", "5 ?m", "5 \ufffdm", "5 $m", "3 umm", "2.10^5 um"],
            "cannot be read: a length is wanted",
        ),
        **dict.fromkeys(
            ["20 g/m^2", "20 gsm"], "is a mass per area (divided by the density a thick"
        ),
        "10 Um": "did you mean '10 um'?",
        "5 kg": "is in kg; a length is wanted",
        "20 %": "has no unit",
        **dict.fromkeys(["5", "5 K", "five m", "", "5 mm^2", "m m m 3"], "a length is wanted"),
        **dict.fromkeys(
            ["1 2 m m", "1e", "1/0 m", "5 um/25", "5 m**9**9**9", 0.1, None], "a length is wanted"
        ),
        "nan m": "not finite",
        "inf m": "not finite",
    },
    "Pa": {
        "30 kpa": "cannot be read: did you mean '30 kPa'?",
        "30 mPa": ": mPa is millipascal, a thousandth of a pascal; did you mean '30 MPa'?",
        "2 mm": "is a length; a pressure is wanted, e.g. '2 MPa'",
        "3 kg*m": "is in kg·m; a pressure is wanted",
        **dict.fromkeys(["2+1 MPa", "5% MPa", "0x10 MPa", "5 percent MPa", "2 x 1 MPa"], "single"),
        **dict.fromkeys(["200 Pas", "20000 mPas", "200 Pa s", "192 cP", "3 kPa·s"], "a viscosity"),
        "70 Shore A": "is a hardness: give Young's modulus (by Gent's relation about 5.5 MPa)",
        "Shore A 50": "about 2.5 MPa",
        "40 Shore D": "is a hardness: give Young's modulus",
    },
    "J/m^2": {
        "5 mN": "is a force; an energy per area is wanted, e.g. '50 mJ/m^2'",
        "2 x 22 mJ/m^2": "is no single number with a unit",
        "50 mj/m2": "did you mean '50 mJ/m^2'?",
        **dict.fromkeys(["10 N/25mm", "10 N / 25 mm", "5 N/inch", "5 N/in", "4 lb/in"], "peeling"),
        **dict.fromkeys(["30 g/25mm", "5 N/cm", "400 cN/cm", "20 ozf/in", "2 pli"], "peeling"),
    },
    "N": {"5 Ns": "is in N·s; a force is wanted"},
    "1/m": {"1 lp/mm": "cannot be read: a wave number is wanted"},
    "m^0.4": {"1e-3": "has no unit; a number in m^0.4 is wanted, e.g. '1e-3 m^0.4'"},
}


def spread(table):
    return [(unit, *row) for unit, rows in table.items() for row in rows.items()]


@pytest.mark.parametrize(("unit", "value", "texts"), spread(READ))
def test_texts_of_one_value(unit, value, texts):
    assert [si(text, unit) for text in texts] == pytest.approx([value] * len(texts), rel=1e-9)


@pytest.mark.parametrize(("unit", "text", "message"), spread(REFUSED))
def test_a_text_that_can_mean_anything_else_is_asked_back_in_words(unit, text, message):
    with pytest.raises(ValueError, match=re.escape(message)) as caught:
        si(text, unit)
    assert str(caught.value).startswith(repr(text))
    assert "\n" not in str(caught.value)
    assert "[" not in str(caught.value)  # no dimensions as pint prints them


@pytest.mark.parametrize(
    ("unit", "value"), [("um", 1e-6), ("0.1 nm", 1e-10), ("Å", 1e-10), (" µm ", 1e-6)]
)
def test_a_unit_may_have_a_factor(unit, value):
    assert si_of_unit(unit, "m") == pytest.approx(value)


@pytest.mark.parametrize(
    ("text", "meant"),
    {
        "200.000 Pa": "'200 Pa' or '200000 Pa'",
        "1.500 Pa": "'1.5 Pa' or '1500 Pa'",
        "-2.350 MPa": "'-2.35 MPa' or '-2350 MPa'",
    }.items(),
)
def test_a_person_is_asked_for_thousands(text, meant):
    with pytest.raises(ValueError, match=re.escape(f"did you mean {meant}?")):
        Quantity.read(text, "Pa")


@pytest.mark.parametrize("text", ["0.200 Pa", "1.953 Pa", "1234.500 Pa", "2.000e5 Pa", "1.50 Pa"])
def test_decimals_that_are_no_thousands_are_read(text):
    assert Quantity.read(text, "Pa") == si(text, "Pa")
