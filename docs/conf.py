"""How Sphinx makes the guide of the pages in docs/ (./dev docs). Nothing is fetched, neither here nor when a page is read."""

import os
import re
import sys
from pathlib import Path

from pygments.lexers.special import TextLexer

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent
sys.path[:0] = [str(HERE / "_sphinx"), str(ROOT / "python")]

project = "slapstick"
version = release = re.search(r"project\(slapstick VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)
copyright = "the slapstick authors, MIT licence"

extensions = [
    "myst_parser",
    "breathe",
    "sphinx.ext.autodoc",
    "sphinx.ext.mathjax",
    "sphinx_copybutton",
    "sphinx_design",
    "side_by_side",
    "plain_docstrings",
    "public_headers",
    "repository_links",
]
exclude_patterns = ["_sphinx", "README.md"]
default_role = "literal"  # of docstrings: `name` is code
toc_object_entries = False  # every page would copy thousands of declarations

myst_enable_extensions = ["amsmath", "colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 4
myst_dmath_double_inline = True

mathjax_path = "mathjax/tex-svg.js"  # of the package in mathjax_alone.txt, put there by ./dev docs
mathjax3_config = {"startup": {"typeset": True}, "options": {"enableMenu": False}}
html_static_path = ["_sphinx/static", os.environ["SLAPSTICK_DOCS_STATIC"]]

html_theme = "furo"
html_title = f"slapstick {release}"
html_css_files = ["guide.css"]
html_show_sourcelink = False
html_copy_source = False
copybutton_prompt_text = r"\$ |> "
copybutton_prompt_is_regexp = True
copybutton_only_copy_prompt_lines = True

breathe_projects = {"slapstick": os.environ["SLAPSTICK_DOCS_XML"]}
breathe_default_project = "slapstick"
breathe_default_members = ("members",)
cpp_id_attributes = ["alignas"]

autodoc_mock_imports = ["slapstick._core"]  # the compiled part: the guide is built without it
autodoc_typehints = "signature"
autodoc_member_order = "bysource"


def setup(app):
    app.add_lexer("csv", TextLexer)
