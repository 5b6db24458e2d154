"""Markdown tables."""


def table(columns, rows):
    """Markdown table with these column heads and rows of texts."""
    lines = [columns, ["---"] * len(columns), *rows]
    return "\n".join("| " + " | ".join(map(escape, line)) + " |" for line in lines) + "\n"


def escape(text):
    return str(text).replace("|", "\\|").replace("\n", " ")
