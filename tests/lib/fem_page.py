"""The input of Howto_fem, "An input", with other meshes and words.

    python3 tests/lib/fem_page.py --lmp build/lmp run "mesh=--core 18e-3 --hold 19e-3" "fem=strain 0.1"

mesh: options in place of those of the page; without: one to leave out; fem: further words of fix hvi/fem. Prints, of the last line of output, elements gone, hole in mm,
heat of conversion and hourglass energy over the energy of the start, and how well energy is kept.
"""

import pathlib
import re
import shlex
import sys

TESTS = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS), str(TESTS.parent / "python")]
import numpy as np  # noqa: E402
from hvi import cli  # noqa: E402
from lammps_runs import command_line  # noqa: E402

PAGE, POTENTIALS = TESTS.parent / "doc" / "src" / "Howto_fem.rst", TESTS.parent / "potentials"


def block(first):
    """of the page: from the line that begins so to the next that is not indented"""
    return re.search(rf"^   {re.escape(first)}.*?(?=^\S)", PAGE.read_text(), re.S | re.M)[0]


def run(lmp, folder, mesh="", without="", fem=""):
    words = shlex.split(block("build/hvi mesh wall").replace("\\\n", ""))[1:]
    words[words.index("wall.data")] = str(folder / "wall.data")
    words[words.index("--material") + 1] = str(POTENTIALS / "Al6061-T6.hvi")
    if without:
        k = words.index(without)
        del words[k:k + 2]
    more = shlex.split(mesh)
    for name, value in zip(more[::2], more[1::2]):
        words[words.index(name) + 1] = value
    if cli.main(words):
        sys.exit("no mesh")
    text = block("# a ball of 3 mm").replace("Al6061-T6.hvi", str(POTENTIALS / "Al6061-T6.hvi"))
    line = re.search(r"fix +wall all hvi/fem.*", text)[0]
    t = lmp(text.replace(line, f"{line} {fem}")).thermo
    energy = t["c_book[1]"][0]
    return dict(elements=t["f_wall"][0], gone=t["f_wall"][0] - t["f_wall"][-1], hole=1e3 * t["c_hole[1]"][-1], heat=t["f_wall[7]"][-1] / energy,
                hourglass=t["f_wall[8]"][-1] / energy, drift=np.abs(t["c_book[9]"] - 1).max(), end=1e6 * t["Time"][-1])


if __name__ == "__main__":
    command_line(__doc__, (run,))
