"""Sphinx's settings of the site; ./dev docs copies this file beside the pages that make_site.py prepares."""

project = "samara"
author = "the samara project"
copyright = "the owner of samara"
root_doc = "index"
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.mathjax"]
exclude_patterns = []

myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4
suppress_warnings = ["myst.header"]  # a page of a study may begin at any heading

html_theme = "furo"
html_title = "samara"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_extra_path = ["_extra"]
html_show_sphinx = False
html_copy_source = False
mathjax_path = "tex-svg.js"

autodoc_member_order = "bysource"
autodoc_default_options = {"members": True, "undoc-members": True, "show-inheritance": True}
autodoc_typehints = "signature"
