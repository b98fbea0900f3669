"""Makes the page that `samara report` writes: the verdict on a bake and its reasons, in one self-contained HTML file."""

import base64
import io
import os
from collections.abc import Mapping
from typing import Any

import jinja2

from . import plot


def _svg(picture: Mapping[str, Any]) -> str:
    """A picture as the address of an image that holds it."""
    file = io.BytesIO()
    plot.write(plot.draw(picture), file, "svg")
    return "data:image/svg+xml;base64," + base64.b64encode(file.getvalue()).decode()


def page(data: Mapping[str, Any]) -> str:
    """Returns a report as HTML.

    `data`: name, below (a line under it), version, verdict (grade: good, limited or bad; headline, good_for, not_for,
    findings: what, text, grade) and parts: title, and blocks, each with one of text, list (texts), table (headings,
    rows of texts, whose first cell names the row) or picture (as samara.plot.draw() takes it) with its `words`; a block
    with a `summary` is folded. All texts are escaped. """
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(os.path.dirname(os.path.abspath(__file__))),
                                     autoescape=True,
                                     trim_blocks=True, lstrip_blocks=True, keep_trailing_newline=True,
                                     undefined=jinja2.StrictUndefined)
    environment.globals["svg"] = _svg
    return environment.get_template("report.html").render(data)
