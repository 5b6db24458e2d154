"""The app: a form with sliders and the page of its answer, for `python -m stickiness --app`.

- `server`: the server, which this computer alone can reach, and only with the token in the address
- `form`: what the form asks, made from the schema of materials and surfaces
- `question`: what was asked, and its answer: analyse, judge, and the files to keep
"""

from stickiness.app.server import serve

__all__ = ["serve"]
