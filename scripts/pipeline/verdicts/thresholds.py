"""Adhesion length from which on each criterion calls a contact sticky."""

# Margins grow with the adhesion length as these powers (Pastewka and Robbins' width of the
# attraction grows with its root).
POWERS = {
    "violano": 3 / 5,
    "violano_constant": 3 / 5,
    "violano_printed": 3 / 5,
    "pastewka_robbins": 5 / 6,
    "fuller_tabor": 1.0,
    "bearing_area": 1.0,
    "persson_tosatti": 1.0,
}


def threshold(criterion, margin, adhesion_length):
    """Adhesion length at which a margin, known at another adhesion length, is 1."""
    return adhesion_length * margin ** (-1 / POWERS[criterion])
