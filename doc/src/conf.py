# Sphinx settings of the documentation: `make doc`, or  python3 -m sphinx -W -b html doc/src OUTPUT

import pathlib
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
PACKAGE = HERE.parents[1] / "src" / "USER-HVI"
sys.path.insert(0, str(HERE.parent / "ext"))

project = "lammps-hvi"
copyright = "2026, the lammps-hvi developers"
author = "the lammps-hvi developers"
release = version = re.search(r'HVI_VERSION\[\] = "([^"]+)"', (PACKAGE / "hvi_version.h").read_text()).group(1)

# mathml: formulas without scripts or remote hosts; stylepages: every style has its page, in LAMMPS's order; materials: the table of all files
extensions = ["sphinx.ext.extlinks", "lammpslexer", "materials", "mathml", "stylepages"]
stylepages_headers = str(PACKAGE)
extlinks = {"lammps": ("https://docs.lammps.org/%s.html", "%s")}  # :lammps:`pair_coeff`
extlinks_detect_hardcoded_links = False

highlight_language = "none"
numfig = True
math_number_all = False
smartquotes = False
html_math_renderer = "mathml"

try:
    import sphinx_rtd_theme  # noqa: F401

    extensions.append("sphinx_rtd_theme")
    html_theme = "sphinx_rtd_theme"
    html_theme_options = {"navigation_depth": 2}
except ImportError:
    html_theme = "alabaster"

html_static_path = ["_static"]
html_css_files = ["hvi.css"]
html_title = f"lammps-hvi {release}"
html_show_sphinx = False
html_copy_source = False
html_show_sourcelink = False
