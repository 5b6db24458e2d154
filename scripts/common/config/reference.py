"""Write docs/configuration.md, the reference of every key, from the JSON schemas of the models.

PYTHONPATH=scripts python -m common.config.reference
PYTHONPATH=scripts python -m common.config.reference --json-schema materials

The second prints a JSON schema of config, materials, surfaces or experiments, by which editors
check and complete a file.
"""

import json
import sys
from pathlib import Path

from common.config.load import TABLES
from common.config.models import MODELS
from common.templates import make_environment

PROJECT = Path(__file__).parents[3]
PAGE = PROJECT / "docs/configuration.md"


def page() -> str:
    """Return the page; a section that several files have stands with the first."""
    found, files = set(), {}
    for name in ("config", *TABLES):
        schema = MODELS[name].model_json_schema()
        models = schema.get("$defs", {})
        sections = {section["title"]: section for section in (schema, *models.values())}
        files[name] = models, [sections[title] for title in sections if title not in found]
        found |= sections.keys()
    environment = make_environment(PROJECT / "report")
    return environment.get_template("configuration.md.j2").render(files=files)


if __name__ == "__main__":
    match sys.argv[1:]:
        case []:
            PAGE.write_text(page(), encoding="utf-8")
        case ["--json-schema", name] if name in MODELS:
            print(json.dumps(MODELS[name].model_json_schema(), indent=1))
        case _:
            sys.exit(__doc__)
