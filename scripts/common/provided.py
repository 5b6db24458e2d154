"""Materials and surfaces that come with the project; a user's entries are shown before them."""

MATERIALS = ("psa", "pdms", "natural_rubber", "pmma", "steel", "crystal", "soft_block")
SURFACES = ("upper_line", "lower_line", "asphalt", "sandblasted_pmma", "ground_steel")
SURFACES += ("polished_steel", "uncd_diamond")


def user_defined_first(names, provided):
    """The names, those that do not come with the project first."""
    return sorted(names, key=lambda name: name in provided)


def choose_mine(pairs):
    """Rows of the user's materials on the user's surfaces, or on all where one kind is missing."""
    of_materials = [pair for pair in pairs if pair["key"] not in MATERIALS]
    of_surfaces = [pair for pair in pairs if pair["name"] not in SURFACES]
    both = [pair for pair in of_materials if pair["name"] not in SURFACES]
    return both or of_materials or of_surfaces
