# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi: the command line. hvi/commands/NAME.py has the options of a command, examples of it and what it does."""

import argparse
import decimal
import importlib
import os
import re
import sys
import textwrap
import unicodedata
import warnings

from .errors import HVIError, HVIWarning, missing, will_write
from .places import program
from .version import version

DESCRIPTION = """Asks whether a shield holds, runs studies, and looks at what LAMMPS has written of an impact: debris clouds, fragments,
velocity maps, side views."""

MOST = 2000  # characters of a message
OLDEST = (3, 9)  # Python, as pyproject.toml has it
NEGATIVE = re.compile(r"-(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d{1,2})?")

COMMANDS_BY_TASK = {
    "a shield of your own": {
        "shield": "does the wall hold? A case at several spacings and shifts of the lattice, one verdict; exit status 0 holds, 3 fails, 4 undecided",
        "judge": "the verdict on a folder of hvi shield --write that was run by hand; exit status as that of shield",
        "limit": "up to where does the wall hold? The limit over diameter, speed, angle, the thickness of a wall or a gap; exit status 0 found, 4 not in the range",
        "curve": "the limit over a list of speeds, gaps or angles: table, CSV, and a picture with ballistic-limit equations; exit status 0, 4 if one has none in the range",
        "ble": "ballistic-limit equations: critical diameter over speed for the shield of a case, or what they say of published shots",
        "report": "one HTML file of the folder of hvi shield, or of one of its runs: verdict, reasons, a scene in 3D, pictures, all numbers",
        "movie": "an animated GIF of a run of a shield from the side; frames: settings: {film: 1} of a case",
        "compare": "shields side by side: verdict, limits, margins, areal density, cost, and curves in one picture; or two runs: result.yaml (or its folder), or the same measures of two dumps",
    },
    "inputs of LAMMPS and bodies for them": {
        "sweep": "a LAMMPS input for many values of its variables, as study files say, with a table of all results",
        "plate": "a plate for SPH: lattice in layers, each turned by its angle, coarser outward, as a LAMMPS data file",
        "body": "a sphere, cylinder or box for SPH, hollow or not, with particles like in a glass or on a lattice, as a LAMMPS data file",
        "mesh": "hexahedra for fix hvi/fem, with particles in them and beside them, as a LAMMPS data file: plates, or the mesh of a file",
        "material": "checks material files, says what they have, lack and assume, and for which use; of one file the curves, too",
    },
    "what a run has written": {
        "info": "frames and columns of a dump",
        "cloud": "size and velocity of the debris cloud in every frame, as compute hvi/cloud measures it",
        "fragments": "table of the fragments of a frame, as compute hvi/fragment makes it, and N(>m)",
        "hole": "the hole in a plate, as compute hvi/hole measures it: diameters, center, area",
        "crater": "the crater in a thick target: depth, diameter, profile",
        "map": "axial velocity against position, as a map of mass (phase) or of its mean (field)",
        "impacts": "where a cloud will strike a wall: momentum and energy per area of particles that fly on freely",
        "view": "particles in 3D, of a run or of dumps, as a page that turns in a browser; with --figure from the side, as a picture",
        "export": "dumps for ParaView: a VTU file of each frame with units in the names, and a PVD file of all; or for OVITO: one dump with names of types",
        "measure": "what a run of an example has recorded, such as the free surface of in.spall, is measured and put into its result.yaml",
    },
    "how right the package is, and whether it is all there": {
        "limits": "published shields whose limit shots bracket: the measured limit, that of the simulation, and those of equations",
        "shots": "published shots on double walls: what was seen, what the simulation says, and what equations say",
        "calibrate": "how sure verdicts and limits are: makes records of hvi limits and hvi shots, and judges them by each other",
        "doctor": "is all there that hvi needs? LAMMPS with USER-HVI, MPI, Python's packages, materials, room; exit status 0 yes, 1 no",
    },
}
COMMANDS = {name: text for group in COMMANDS_BY_TASK.values() for name, text in group.items()}


def by_task():
    """Text of --help: all commands, those of a task together"""
    lines = []
    for task, commands in COMMANDS_BY_TASK.items():
        lines += ["", f"{task}:"]
        for name, text in commands.items():
            lines += textwrap.wrap(text, 80, initial_indent=f"  {name:<11}", subsequent_indent=" " * 13)
    return "\n".join(lines[1:])


def options(name=None):
    """The parser of the command line; with the name of a command it knows this one and its options alone, and no other is imported"""
    parser = argparse.ArgumentParser(prog=program(), description=DESCRIPTION, epilog=by_task(), formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--version", action="version", version=f"lammps-hvi {version()}")
    several = parser.add_subparsers(dest="command", metavar="COMMAND", required=True, help="one of those below; COMMAND --help says more, with examples")
    for command, text in {name: COMMANDS[name]}.items() if name in COMMANDS else COMMANDS.items():
        sub = several.add_parser(command)
        if command == name:
            module = importlib.import_module(f".commands.{name}", __package__)
            sub.description, sub.epilog = text[0].upper() + text[1:] + ".", "examples:\n" + module.EXAMPLES.replace("python3 -m hvi", program())
            sub.formatter_class = argparse.RawDescriptionHelpFormatter
            sub.set_defaults(run=module.main)
            module.add_arguments(sub)
    return parser


def join_negative(arguments):
    """-1e-3 as -0.001, --sbatch --mem=4G as --sbatch=--mem=4G: argparse takes the value for an option"""
    joined = []
    for word in arguments:
        if word.startswith("-") and joined[-1:] == ["--sbatch"]:
            joined[-1] += "=" + word
        else:
            joined.append(format(decimal.Decimal(word), "f") if NEGATIVE.fullmatch(word) else word)
    return joined


def parse(words):
    """what the words say, and in run the function that does it"""
    return options(next((word for word in words if not word.startswith("-")), None)).parse_args(join_negative(words))


def shown(text):
    """of a message that repeats what a file says: no more than can be read, nothing that a terminal would obey"""
    text = text if len(text) < MOST else f"{text[:MOST]} ..."
    return "".join(repr(c)[1:-1] if unicodedata.category(c) in ("Cc", "Cf", "Zl", "Zp") and c != "\n" else c for c in text)


def main(arguments=None):
    """Runs a command; returns the exit status: 0; 1 for wrong input, with one line on stderr; 130 when interrupted."""
    if sys.version_info < OLDEST:
        print(f"hvi: {sys.executable} is Python {sys.version.split()[0]}, {'.'.join(map(str, OLDEST))} or later is needed", file=sys.stderr)
        return 1
    with warnings.catch_warnings():
        warnings.showwarning = lambda message, kind, *_: (
            print(f"hvi: warning: {message}", file=sys.stderr) if issubclass(kind, HVIWarning) else None)
        try:
            args = parse(sys.argv[1:] if arguments is None else arguments)
            for option in ("out", "output", "figure"):  # what is written last, after minutes of reading
                if path := getattr(args, option, None):
                    will_write(path)
            status = args.run(args) or 0
            sys.stdout.flush()
            return status
        except HVIError as error:
            print(f"hvi: {shown(str(error)).replace('python3 -m hvi', program())}", file=sys.stderr)
        except ImportError as error:
            print(f"hvi: {missing(error)}", file=sys.stderr)
        except MemoryError:
            print("hvi: not enough memory: take fewer bins, particles or frames, or another machine", file=sys.stderr)
        except BrokenPipeError:  # as in  python3 -m hvi ... | head: nobody reads the rest
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        except OSError as error:
            print(f"hvi: {error}", file=sys.stderr)
        except KeyboardInterrupt:
            return 130
    return 1
