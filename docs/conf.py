"""Sphinx configuration; `python3 dev.py docs` builds the pages, warnings are errors."""

from __future__ import annotations

import sys
from importlib.metadata import version as version_of
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE / "_ext"))

project = "railgrip"
author = "The railgrip authors"
project_copyright = "The railgrip authors, Apache-2.0"
release = version = version_of("railgrip")

extensions = [
    "catalogue",
    "state_diagram",
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx.ext.mathjax",
    "sphinx_gallery.gen_gallery",
]
exclude_patterns = ["_build", "_static", "gallery_src", "examples", "**/template.md"]
nitpicky = False
suppress_warnings = ["ref.python"]  # the words of a type, as (axle, time), are no references

html_theme = "furo"
html_title = "railgrip"
html_static_path = ["_static"]
html_show_sphinx = False
html_copy_source = False

myst_enable_extensions = ["colon_fence", "deflist", "dollarmath", "amsmath"]
myst_heading_anchors = 3

napoleon_google_docstring = False
napoleon_use_ivar = True
napoleon_use_param = False  # types are words such as "ndarray (axle)", not references
napoleon_use_rtype = False
napoleon_custom_sections = [("Checked by", "notes_style")]
autodoc_default_options = {"members": True, "member-order": "bysource"}
autodoc_typehints = "none"
autodoc_typehints_format = "short"

# Formulas are set by the part of MathJax that lies in _static, so pages open without a network.
mathjax_path = "mathjax/startup.js"
mathjax3_config = {
    "loader": {"load": ["core", "input/tex-base", "[tex]/ams", "output/chtml"]},
    "tex": {"packages": {"[+]": ["ams"]}},
}

sphinx_gallery_conf = {
    "examples_dirs": "gallery_src",
    "gallery_dirs": "gallery",
    "filename_pattern": r"/plot_",
    "abort_on_example_error": True,
    "write_computation_times": False,
    "show_memory": False,
    "remove_config_comments": True,
    "min_reported_time": 60,
    "download_all_examples": False,
    "within_subsection_order": "FileNameSortKey",
}
