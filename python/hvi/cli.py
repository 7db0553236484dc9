# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi: the command line. options() holds what commands share; each command is a function in commands.py."""

import argparse
import functools
import importlib
import os
import pathlib
import sys
import textwrap
import warnings

from .analysis.debris import COLUMN
from .analysis.fragments import FAILED
from .commands import dumps as commands
from .errors import HVIError, HVIWarning
from .units import MVV2E
from .version import version

DESCRIPTION = """Asks whether a shield holds, runs studies, and looks at what LAMMPS has written of an impact: debris clouds, fragments,
velocity maps, side views."""

EXAMPLES = {
    "shield": """  python3 -m hvi shield emi.yaml --dry-run
  python3 -m hvi shield emi.yaml --jobs 2 --ranks 1
  python3 -m hvi shield emi.yaml --write emi""",
    "judge": """  python3 -m hvi judge emi/dx-0.267_shift-0.0""",
    "limit": """  python3 -m hvi limit emi.yaml --on D
  python3 -m hvi limit emi.yaml --on thickness2 --from 0.5 --to 3 --step 0.1 --jobs 2 --ranks 1""",
    "curve": """  python3 -m hvi curve emi.yaml --speeds 3:9:4 --from 2 --to 8 --step 0.5 --jobs 2 --ranks 1""",
    "ble": """  python3 -m hvi ble emi.yaml --figure limit
  python3 -m hvi ble emi.yaml --speeds 3:9:13 --equation JSC --equation Reimerdes --out limit.csv
  python3 -m hvi ble --shots examples/whipple-shield/shots/shots.csv""",
    "sweep": """  python3 -m hvi sweep studies/parameters.yaml
  python3 -m hvi sweep studies/*.yaml --jobs 2 --ranks 1""",
    "report": """  python3 -m hvi report runs/emi
  python3 -m hvi report . --out shield.html""",
    "movie": "  python3 -m hvi movie runs/emi --color speed",
    "export": """  python3 -m hvi export runs/emi/dx-0.2_shift-0.0
  python3 -m hvi export debris.dump --data debris.data --out debris""",
    "shots": """  python3 -m hvi shots examples/whipple-shield/shots/chosen.yaml --jobs 2 --ranks 1
  python3 -m hvi shots mine.csv --equations
  python3 -m hvi shots all.yaml --only 2053 P-34B --dry-run""",
    "info": "  python3 -m hvi info debris.dump",
    "cloud": """  python3 -m hvi cloud debris.dump --data debris.data --axis z --plane 4.05e-3
  python3 -m hvi cloud debris.dump --mass 1=5e-7 --mass 2=5e-7 --axis z --plane 4.05e-3 --interval 3e-6 \\
      --out cloud.csv --figure cloud""",
    "fragments": """  python3 -m hvi fragments debris.dump --data debris.data --bonds bonds.dump --axis z --plane 4.05e-3 \\
      --fit both --figure masses --out fragments.csv
  python3 -m hvi fragments debris.dump --data debris.data --bonds bonds.dump --axis z --plane 4.05e-3 --all --out f.csv
  python3 -m hvi fragments sph.dump --column c_frag --frame 3
  python3 -m hvi fragments quarter.dump --column c_frag --distance 6e-4 --mirror x=0 --mirror y=0
  python3 -m hvi fragments sph.dump --distance 0.45 --units lj --mass 1=1
  python3 -m hvi fragments frame.40.dump --distance 7.15e-4 --sound --density 1=2790 --density 2=2703 --plane 0.953e-3""",
    "map": """  python3 -m hvi map debris.dump --data debris.data --axis z --figure phase
  python3 -m hvi map debris.dump --data debris.data --axis z --kind field --figure field.png""",
    "hole": """  python3 -m hvi hole frame.10.dump --plane 0.5e-3 --type 2 --figure hole
  python3 -m hvi hole shield.dump --center 2.5e-3 0 --plane 31.4e-3 --type 3 --distance 0.4e-3 --thickness 1
  python3 -m hvi hole frame.*.dump --plane 0.5e-3 --type 2 --all --out holes.csv
  python3 -m hvi hole wall.data --quarter --plane 0.5e-3""",
    "view": """  python3 -m hvi view debris.dump --data debris.data --axis z --thickness 8e-3 --figure side
  python3 -m hvi view debris.dump --data debris.data --axis z --plane 4.05e-3 \\
      --color fragment --bonds bonds.dump --figure pieces""",
    "plate": """  python3 -m hvi plate wall.data --radius 20e-3 --thickness 0.8e-3 --spacing 0.2e-3 --layers 8 --angles 0 45 \\
      --material potentials/Al2024-T3.hvi
  python3 -m hvi plate far.data --radius 140e-3 --thickness 0.8e-3 --spacing 0.2e-3 --zones 20e-3 40e-3 80e-3 \\
      --density 2785 --quarter
  python3 -m hvi plate thin.data --radius 20e-3 --thickness 0.8e-3 --spacing 0.2e-3 --fill glass --density 2785""",
    "mesh": """  python3 -m hvi mesh wall.data --side 300e-3 --thickness 1e-3 --element 0.5e-3 --core 8e-3 --hold 12e-3 --circle \\
      --growth 1.2 --largest 5e-3 --quarter --material potentials/Al2024-T3.hvi
  python3 -m hvi mesh plate.data --radius 20e-3 --thickness 1e-3 --element 0.5e-3 --particles 2 --density 2785
  python3 -m hvi mesh part.data --import part.inp --scale 1e-3 --particles 2 --set STRUCK --density 2785""",
    "body": """  python3 -m hvi body ball.data --shape sphere --radius 5e-3 --spacing 0.5e-3 --material potentials/Al6061-T6.hvi
  python3 -m hvi body shell.data --shape sphere --radius 5e-3 --inner 3e-3 --spacing 0.5e-3 --density 2785 --quarter
  python3 -m hvi body rod.data --shape cylinder --radius 2e-3 --length 10e-3 --spacing 0.4e-3 --density 2785 --seed 7
  python3 -m hvi body block.data --shape box --size 4e-3 4e-3 8e-3 --spacing 0.4e-3 --fill lattice --density 2785""",
    "impacts": """  python3 -m hvi impacts cloud1.dump --axis z --plane 60.8e-3 --figure witness
  python3 -m hvi impacts old.dump --axis z --plane 60.8e-3 --quarter --after 0 --bins 60 --figure witness.png
  python3 -m hvi impacts cloud1.dump --axis z --plane 60.8e-3 --after 0.8e-3 --distance 0.6e-3 --sound \\
      --density 1=2785 --density 2=2785""",
    "material": """  python3 -m hvi material Al7075-T6.hvi --figure Al7075-T6
  python3 -m hvi material potentials/*.hvi""",
    "measure": """  python3 -m hvi measure .
  python3 -m hvi measure runs/*""",
    "compare": """  python3 -m hvi compare run1/result.yaml run2/result.yaml
  python3 -m hvi compare run1 run2 --rtol 0.05 --keys length_ratio fragmentation
  python3 -m hvi compare run1/debris.dump run2/debris.dump --mass 1=5e-7 --mass 2=5e-7 --axis z --plane 4.05e-3 \\
      --bonds run1/bonds.dump run2/bonds.dump""",
}


def by_type(text, what="MASS", like="1=2.5e-7"):
    """(type, value) of TYPE=VALUE"""
    kind, found, value = text.partition("=")
    try:
        kind, value = int(kind), float(value)
    except ValueError:
        found = ""
    if not found or not 0.0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"{text} is not TYPE={what}, like {like}")
    return kind, value


def density(text):
    return by_type(text, "RHO", "1=2785")


def positive(text):
    try:
        value = float(text)
    except ValueError:
        value = -1.0
    if not 0.0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"{text} is not a number > 0")
    return value


class _OneOrTwo(argparse.Action):
    def __call__(self, parser, namespace, values, option_string=None):
        if len(values) > 2:
            parser.error(f"{option_string} takes one or two numbers, not {len(values)}")
        setattr(namespace, self.dest, values)


def _files(parser):
    parser.add_argument("files", nargs="+", metavar="FILE", help="dump file, or several of one run (plain or .gz)")


def _reading(parser, several=False):
    group = parser.add_argument_group("what the dump does not say")
    group.add_argument("--data", metavar="FILE", nargs=2 if several else None, help="data file (write_data): masses, bonds")
    group.add_argument("--mass", action="append", type=by_type, metavar="TYPE=MASS",
                       help="mass of the particles of a type; repeat")
    group.add_argument("--units", choices=sorted(MVV2E),
                       help="LAMMPS units (default: the dump's or the data file's, else si)")
    group.add_argument("--mirror", action="append", metavar="D=C[,SIDE]",
                       help="mirror plane of a half or quarter model, like x=0 or y=1e-3,hi (all is above it: lo, default; below "
                       "it: hi); repeat; or none (default: what the dump or the data file says)")
    group.add_argument("--quarter", action="store_const", const=["x=0", "y=0"], dest="mirror", help="--mirror x=0 --mirror y=0")
    group.add_argument("--dt", type=positive, metavar="T", help="time per step, for dumps without time")
    group.add_argument("--interval", type=positive, metavar="T", help="time between frames (dump_modify every/time)")


def _cloud(parser, needed, plane=True):
    group = parser.add_argument_group("the cloud: all particles beyond a plane")
    group.add_argument("--axis", choices="xyz", required=needed, default=None if needed else "z",
                       help="direction of the impact" + ("" if needed else " (default: z)"))
    if plane:
        group.add_argument("--plane", type=float, metavar="X", required=needed,
                           help="coordinate of the plane" + ("" if needed else " (default: all particles)"))


def _filling(parser, default, text):
    parser.add_argument("--fill", choices=("glass", "lattice"), default=default, help=f"{text} (default: {default})")
    parser.add_argument("--seed", type=int, default=1, metavar="N", help="of glass: another one, another glass (default: 1)")
    group = parser.add_mutually_exclusive_group(required=True)
    group.add_argument("--density", type=positive, metavar="RHO", help="of the material, in units of the run")
    group.add_argument("--material", metavar="FILE.hvi", help="material file; the run must have its units")


def _rules(parser, several=False):
    group = parser.add_argument_group("what is a fragment (one of; at mirror planes --distance, too)")
    group.add_argument("--column", metavar="NAME", help="column with fragment IDs (compute hvi/fragment/atom)")
    group.add_argument("--bonds", metavar="FILE", nargs=2 if several else None,
                       help="dump local with batom1 batom2 of every frame, or a data file")
    group.add_argument("--distance", type=positive, metavar="R", help="particles closer than R hang together")
    group.add_argument("--bond-columns", nargs=2, metavar="NAME",
                       help="columns with the two atom IDs (default: the last two)")
    group.add_argument("--sound", action="store_true",
                       help="with --distance: failed particles stay alone (damage yes); without, what has come apart")
    group.add_argument("--failed-columns", nargs="+", metavar="NAME", default=FAILED,
                       help="a particle with 1 or more in one of these has failed (default: damage spalled)")


def _debris(parser):
    group = parser.add_argument_group("debris below the spacing, with --sound")
    group.add_argument("--density", action="append", type=density, metavar="TYPE=RHO",
                       help="of the solid matter of a type; repeat. Failed particles count as pieces of the size in the column fragsize")
    group.add_argument("--size-column", metavar="NAME", default=COLUMN, help="that column, if it has another name")


def _frame(parser):
    parser.add_argument("--frame", type=int, default=-1, metavar="K",
                        help="which frame, from 0; negative from the end (default: -1)")


def _output(parser, figure, required=False, out=True):
    if out:
        parser.add_argument("--out", metavar="FILE.csv", help="write the table with all digits")
    parser.add_argument("--figure", metavar="NAME", required=required,
                        help=f"draw {figure}: NAME.png and NAME.pdf, or only the one that NAME ends in")


def _count(text):
    try:
        value = int(text)
    except ValueError:
        value = 0
    if value < 1:
        raise argparse.ArgumentTypeError(f"{text} is not a whole number from 1 on")
    return value


def _runs(parser):
    group = parser.add_argument_group("how LAMMPS is run; call again to go on where it stopped")
    group.add_argument("--runs", type=pathlib.Path, default="runs", metavar="DIR", help="folder for the runs (default: runs)")
    group.add_argument("--jobs", type=_count, default=1, metavar="N", help="runs at a time (default: 1)")
    group.add_argument("--ranks", type=_count, metavar="R", help="MPI ranks of a run (default: the study's, or 2)")
    group.add_argument("--timeout", type=positive, metavar="S", help="end a run after this many seconds (default: the study's, or never)")
    group.add_argument("--lmp", metavar="FILE", help="LAMMPS with USER-HVI (default: $HVI_LMP, or build/lmp of the source tree)")
    group.add_argument("--mpirun", default="mpirun", metavar="FILE", help="how ranks are started (default: mpirun)")
    group.add_argument("--dry-run", action="store_true", help="show what would be run")


def _case(parser):
    parser.add_argument("case", metavar="CASE.yaml", help="projectile, speed, angle, walls, spacings")
    usual = parser.format_help
    parser.format_help = lambda: usual() + "\n" + _keys() + "\n"


def _range(parser):
    for name, text, default in (("from", "lowest value", "half of the case's"), ("to", "highest value", "twice the case's"), ("step", "between values that are tried", "a 20th of the case's")):
        parser.add_argument("--" + name, dest=name + "_", type=positive, metavar="X", help=f"{text}, mm or km/s (default: {default})")


def _keys():
    """what a case may say"""
    from . import tables
    from .shield import case

    rows = [(name, default, line) for name, default, text in case.rows_of_keys() for name, default, line in _wrapped(name, default, text)]
    return "keys of CASE.yaml:\n" + tables.text(("key", "default", "what it is"), rows, left=True)


def _wrapped(name, default, text):
    for k, line in enumerate(textwrap.wrap(text, 80) or [""]):
        yield (name, default, line) if k == 0 else ("", "", line)


def _speeds(text):
    """(first, last, number) of A:B:N"""
    try:
        first, last, number = text.split(":")
        first, last, number = positive(first), positive(last), _count(number)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text} is not FIRST:LAST:NUMBER, like 1:15:15") from None
    if first >= last:
        raise argparse.ArgumentTypeError(f"{text}: the first speed must be below the last")
    return first, last, number


MODULES = {"judge": "commands.judge", "limit": "shield.limit", "curve": "commands.curve", "ble": "commands.ble", "sweep": "jobs.sweep", "report": "report.report", "movie": "commands.movie",
           "export": "commands.export", "shots": "shield.shots", "shield": "shield.decision", "measure": "jobs.measures"}


def _main_of(name, args):
    """main() of the module of that name, which needs PyYAML"""
    return importlib.import_module("." + MODULES[name], __package__).main(args)


def options():
    """The parser of the command line."""
    parser = argparse.ArgumentParser(prog="python3 -m hvi", description=DESCRIPTION,
                                     epilog="python3 -m hvi COMMAND --help says more, with examples.")
    parser.add_argument("--version", action="version", version=f"lammps-hvi {version()}")
    several = parser.add_subparsers(dest="command", metavar="COMMAND", required=True)

    def command(name, text):
        sub = several.add_parser(name, help=text, description=text[0].upper() + text[1:] + ".",
                                 epilog="examples:\n" + EXAMPLES[name],
                                 formatter_class=argparse.RawDescriptionHelpFormatter)
        sub.set_defaults(run=getattr(commands, name, None) or functools.partial(_main_of, name))
        return sub

    sub = command("shield", "does the wall hold? A case at several spacings and shifts of the lattice, one verdict; exit status 0 holds, "
                  "3 fails, 4 undecided")
    _case(sub)
    sub.add_argument("--write", type=pathlib.Path, metavar="DIR", help="only write in.shield of all runs, complete folders for LAMMPS alone, and say how to run them")
    _runs(sub)

    sub = command("judge", "the verdict on a folder of hvi shield --write that was run by hand; exit status as that of shield")
    sub.add_argument("folder", metavar="DIR", help="with walls.dat, pieces.dat, history.dat and logs of the run")

    sub = command("limit", "up to where does the wall hold? The limit over diameter, speed or the thickness of a wall; exit status 0 found, "
                  "4 not in the range")
    _case(sub)
    sub.add_argument("--on", required=True, metavar="WHAT", help="D, speed, thickness1, thickness2, ...")
    _range(sub)
    _runs(sub)

    sub = command("curve", "the limit over a list of speeds: table, CSV, and a picture with ballistic-limit equations; exit status 0, 4 if a speed has none in the range")
    _case(sub)
    sub.add_argument("--speeds", type=_speeds, default=(3.0, 9.0, 7), metavar="A:B:N", help="first, last, number of speeds, km/s (default: 3:9:7)")
    sub.add_argument("--on", default="D", metavar="WHAT", help="D, or thickness1, thickness2, ... (default: D)")
    _range(sub)
    _runs(sub)

    sub = command("ble", "ballistic-limit equations: critical diameter over speed for the shield of a case, or what they say of published shots")
    sub.add_argument("case", metavar="CASE.yaml", nargs="?", help="as of hvi shield; spacings_mm are not needed")
    sub.add_argument("--shots", metavar="FILE.csv", help="instead of a case: a list of double-wall shots, as of hvi shots; how often each equation is right")
    sub.add_argument("--speeds", type=_speeds, default=(1.0, 15.0, 15), metavar="A:B:N", help="first, last, number of speeds, km/s (default: 1:15:15)")
    sub.add_argument("--equation", action="append", metavar="NAME", help="only this equation; repeat (default: all)")
    _output(sub, "critical diameter over speed, dashed where beyond ranges of validity, and the case")

    sub = command("sweep", "a LAMMPS input for many values of its variables, as study files say, with a table of all results")
    sub.add_argument("study", nargs="+", metavar="STUDY.yaml", help="input, variables, and the grid of what varies")
    sub.add_argument("--full", action="store_true", help="the study's full size; runs go to DIR/NAME-full")
    _runs(sub)

    sub = command("report", "one HTML file of the folder of hvi shield, or of one of its runs: verdict, reasons, pictures, all numbers")
    sub.add_argument("folder", metavar="DIR", help="folder with verdict.yaml (runs/CASE of hvi shield), or with result.yaml")
    sub.add_argument("--out", metavar="FILE.html", help="default: report.html in DIR")

    sub = command("movie", "an animated GIF of a run of a shield from the side; frames: settings: {film: 1} of a case")
    sub.add_argument("folder", metavar="DIR", help="as of hvi report: of several runs the finest")
    sub.add_argument("--out", metavar="FILE.gif", help="default: movie.gif in DIR")
    sub.add_argument("--color", choices=("body", "speed"), default="body", help="of the particles (default: body)")
    sub.add_argument("--rate", type=positive, default=5.0, metavar="N", help="frames per second (default: 5)")

    sub = command("export", "dumps for ParaView: a VTU file of each frame with units in the names, and a PVD file of all")
    sub.add_argument("files", nargs="+", metavar="DUMP|DIR", help="dump files of one run, or a folder as of hvi report")
    sub.add_argument("--out", metavar="NAME", help="NAME.pvd, and NAME.0000.vtu ... beside it (default: the name of the dump; in a folder: shield)")
    sub.add_argument("--part", action="store_true", help="of a half or quarter model only the part that was computed, not the whole")
    _reading(sub)
    sub = command("shots", "a list of shots on double walls: what was seen, what the simulation says, and what equations say")
    sub.add_argument("study", metavar="FILE", help="study (YAML), or a list of shots (CSV) that is run as examples/whipple-shield/shots/all.yaml says")
    sub.add_argument("--only", nargs="+", metavar="SHOT", help="only these shots of it")
    sub.add_argument("--equations", action="store_true", help="the equations alone, nothing is run")
    _runs(sub)

    sub = command("info", "frames and columns of a dump")
    _files(sub)

    sub = command("cloud", "size and velocity of the debris cloud in every frame, as compute hvi/cloud measures it")
    _files(sub)
    _cloud(sub, needed=True)
    sub.add_argument("--quantile", type=float, default=0.99, metavar="Q",
                     help="share of the mass inside an edge (default: 0.99)")
    sub.add_argument("--frame", type=int, action="append", metavar="K", help="only this frame; repeat (default: all)")
    _reading(sub)
    _output(sub, "the measures over time")

    sub = command("fragments", "table of the fragments of a frame, as compute hvi/fragment makes it, and N(>m)")
    _files(sub)
    _rules(sub)
    _debris(sub)
    _frame(sub)
    _cloud(sub, needed=False)
    sub.add_argument("--type", type=int, nargs="+", metavar="TYPE", help="only particles of these types count and connect (default: all)")
    sub.add_argument("--all", action="store_true", help="the summary of every frame instead of the table of one")
    sub.add_argument("--top", type=int, default=10, metavar="N", help="rows to print (default: 10)")
    sub.add_argument("--fit", choices=("power", "exponential", "both"), help="fit N(>m): A m^-b, N0 exp(-m/mu)")
    sub.add_argument("--mmin", type=positive, metavar="M",
                     help="fit from this mass on (default: where the law fits best)")
    sub.add_argument("--mmax", type=positive, default=float("inf"), metavar="M", help="and up to this one")
    _reading(sub)
    _output(sub, "N(>m)")

    sub = command("hole", "the hole in a plate, as compute hvi/hole measures it: diameters, center, area")
    sub.add_argument("files", nargs="+", metavar="FILE", help="dump file, or several of one run (plain or .gz); or one data file (write_data)")
    sub.add_argument("--axis", choices="xyz", default="z", help="direction in which the plate is looked at (default: z)")
    sub.add_argument("--center", type=float, nargs=2, default=(0.0, 0.0), metavar=("X", "Y"),
                     help="a point in the plate across the axis, at best in the middle of the hole (default: 0 0)")
    sub.add_argument("--plane", type=float, required=True, metavar="Z", help="coordinate of the plate's middle plane along the axis")
    sub.add_argument("--type", type=int, nargs="+", metavar="TYPE", help="only particles of these types: the plate (default: all)")
    sub.add_argument("--distance", type=positive, metavar="R", help="only the largest piece of these, of particles closer than R: what drifts in the hole is "
                     "no plate (default: all)")
    sub.add_argument("--thickness", type=positive, metavar="H", help="of the layer around the plane that is looked at (default: it is measured)")
    sub.add_argument("--dr", type=positive, metavar="D", help="spacing of the map (default: it is measured)")
    sub.add_argument("--fill", type=float, default=0.5, metavar="F", help="share of the intact plate's mass per area that makes plate (default: 0.5)")
    sub.add_argument("--reference", type=positive, metavar="M", help="mass per area of the intact plate (default: it is measured)")
    sub.add_argument("--sectors", type=int, default=36, metavar="N", help="for the smallest and largest diameter (default: 36)")
    sub.add_argument("--all", action="store_true", help="a row for every frame instead of the values of one")
    _frame(sub)
    _reading(sub)
    _output(sub, "the map of mass per area with the edge of the hole")

    sub = command("map", "axial velocity against position, as a map of mass (phase) or of its mean (field)")
    _files(sub)
    _frame(sub)
    _cloud(sub, needed=False)
    sub.add_argument("--kind", choices=("phase", "field"), default="phase",
                     help="phase: mass over position and velocity; field: mean velocity over position and radius "
                     "(default: phase)")
    sub.add_argument("--bins", type=int, nargs=2, metavar="N", help="bins to the right and upwards")
    _reading(sub)
    _output(sub, "the map", required=True, out=False)

    sub = command("view", "particles from the side, colored by type, fragment, velocity or any column")
    _files(sub)
    _frame(sub)
    _cloud(sub, needed=False)
    sub.add_argument("--up", choices="xyz", help="direction that points up (default: the next after the axis)")
    sub.add_argument("--color", default="type", metavar="WHAT",
                     help="type, velocity, axial, fragment or a column (default: type)")
    sub.add_argument("--thickness", type=positive, metavar="D",
                     help="only a slice through the center of mass (default: all)")
    sub.add_argument("--diameter", type=positive, metavar="D", help="of the dots (default: the spacing of the particles)")
    _rules(sub)
    _reading(sub)
    _output(sub, "the view", required=True, out=False)

    sub = command("plate", "a plate for SPH: lattice in layers, each turned by its angle, coarser outward, as a LAMMPS data file")
    sub.add_argument("file", metavar="FILE", help="data file to write (atom_style sph; read_data FILE add append)")
    for name, text in (("radius", "of the plate"), ("thickness", "of the plate"), ("spacing", "of particles in the plane")):
        sub.add_argument("--" + name, type=positive, required=True, metavar=name[0].upper(), help=text)
    sub.add_argument("--layers", type=int, metavar="N", help="particles through the thickness (default: as wide as in the plane)")
    sub.add_argument("--angles", type=float, nargs="+", default=[0.0], metavar="DEG",
                     help="one for all layers, one per layer, or a set that is stacked symmetric and balanced (default: 0)")
    sub.add_argument("--zones", type=positive, nargs="+", default=[], metavar="R",
                     help="beyond each of these radii the spacing doubles and the type is the next")
    sub.add_argument("--quarter", action="store_true", help="only x > 0, y > 0, for mirrors")
    _filling(sub, "lattice", "lattice in layers, or glass: without layers, angles and zones")

    sub = command("body", "a sphere, cylinder or box for SPH, hollow or not, with particles like in a glass or on a lattice, as a LAMMPS data file")
    sub.add_argument("file", metavar="FILE", help="data file to write (atom_style sph; read_data FILE add append); the center is at 0 0 0")
    sub.add_argument("--shape", choices=("sphere", "cylinder", "box"), required=True, help="a cylinder is along z")
    sub.add_argument("--radius", type=positive, metavar="R", help="of a sphere or cylinder")
    sub.add_argument("--inner", type=positive, metavar="R", help="radius inside, of a hollow one")
    sub.add_argument("--length", type=positive, metavar="L", help="of a cylinder")
    sub.add_argument("--size", type=positive, nargs=3, metavar=("X", "Y", "Z"), help="of a box")
    sub.add_argument("--periodic", nargs="+", choices="xyz", default=[], metavar="D", help="directions of a box in which it goes on periodically")
    sub.add_argument("--spacing", type=positive, required=True, metavar="S", help="of particles: as many as cubes of it have the volume of the body")
    sub.add_argument("--quarter", action="store_true", help="only x > 0, y > 0, for mirrors")
    _filling(sub, "glass", "even, without rows, or a cubic lattice about the center")

    sub = command("mesh", "hexahedra for fix hvi/fem, with particles in them and beside them, as a LAMMPS data file: plates, or the mesh of a file")
    sub.add_argument("file", metavar="FILE", help="data file to write (atom_style sph; read_data FILE fix ID elements Elements)")
    group = sub.add_mutually_exclusive_group(required=True)
    group.add_argument("--side", type=positive, nargs="+", action=_OneOrTwo, metavar="L", help="of a square plate, or both of a rectangle")
    group.add_argument("--radius", type=positive, metavar="R", help="of a round plate")
    group.add_argument("--import", dest="import_", metavar="MESH", help="hexahedra of a file that meshio reads (Abaqus, Gmsh, VTK, ...)")
    sub.add_argument("--particles", type=int, default=2, metavar="N", help="per edge of an element that holds some; 0: none does (default: 2)")
    sub.add_argument("--type", type=int, default=1, metavar="TYPE", help="of the material (default: 1)")
    sub.add_argument("--node-type", type=int, metavar="TYPE", help="of the nodes (default: the next)")
    group = sub.add_mutually_exclusive_group(required=True)
    group.add_argument("--density", type=positive, metavar="RHO", help="of the material, in units of the run")
    group.add_argument("--material", metavar="FILE.hvi", help="material file; the run must have its units")
    group = sub.add_argument_group("plates, across z")
    group.add_argument("--thickness", type=positive, metavar="T", help="of the plate")
    group.add_argument("--element", type=positive, metavar="E", help="edge of elements in the plane")
    group.add_argument("--layers", type=int, metavar="N", help="elements through the thickness (default: as thick as wide)")
    group.add_argument("--core", type=positive, metavar="R", help="free particles, E/N apart, instead of elements up to this radius")
    group.add_argument("--circle", action="store_true", default=None, help="the core is a circle with rings of elements around it, not cells of a lattice")
    group.add_argument("--hold", type=positive, metavar="R", help="elements hold particles up to this radius (default: all)")
    group.add_argument("--growth", type=positive, metavar="G", help="beyond, elements grow by this ratio from one to the next (default: 1)")
    group.add_argument("--largest", type=positive, metavar="E", help="up to this size")
    group.add_argument("--quarter", action="store_true", default=None, help="only x > 0, y > 0, for mirrors")
    group.add_argument("--center", type=float, nargs=2, metavar=("X", "Y"), help="of the plate (default: 0 0)")
    group.add_argument("--bottom", type=float, metavar="Z", help="the plate is from Z to Z + T (default: 0)")
    group = sub.add_argument_group("imported meshes")
    group.add_argument("--scale", type=positive, metavar="S", help="units of the run per unit of the file (default: 1)")
    group.add_argument("--move", type=float, nargs=3, metavar=("X", "Y", "Z"), help="after that (default: 0 0 0)")
    group.add_argument("--set", metavar="NAME", help="only elements of this set of cells hold particles (default: all)")

    sub = command("impacts", "where a cloud will strike a wall: momentum and energy per area of particles that fly on freely")
    _files(sub)
    _frame(sub)
    _cloud(sub, needed=True)
    sub.add_argument("--after", type=float, metavar="X", help="only particles beyond this coordinate (default: all before the wall)")
    sub.add_argument("--bins", type=int, default=80, metavar="N", help="bins across the map (default: 80)")
    sub.add_argument("--reach", type=positive, metavar="R", help="half width of the map (default: where 99 %% of the energy is)")
    _rules(sub)
    _debris(sub)
    _reading(sub)
    _output(sub, "both maps", out=False)

    sub = command("material", "checks material files, says what they have, lack and assume, and for which use; of one file the curves, too")
    sub.add_argument("files", nargs="+", metavar="FILE.hvi", help="material file, here or in LAMMPS_POTENTIALS; of several a table")
    _output(sub, "Hugoniot, isentrope, yield stress and spall strength of one file")

    sub = command("measure", "what a run of an example has recorded, such as the free surface of in.spall, is measured and put into its result.yaml")
    sub.add_argument("folders", nargs="+", metavar="DIR", help="folder of a run, with result.yaml; what is measured is told by its files: surface.dat")

    sub = command("compare", "two runs side by side: result.yaml (or its folder), or the same measures of two dumps")
    for name in "AB":
        sub.add_argument(name.lower(), metavar=name, help="result.yaml, folder with one, or dump")
    sub.add_argument("--keys", nargs="+", metavar="KEY", help="only these (default: all)")
    sub.add_argument("--rtol", type=float, metavar="T", help="exit status 1 if a relative difference is larger than T")
    sub.add_argument("--out", metavar="FILE.csv", help="write the table with all digits")
    _frame(sub)
    _cloud(sub, needed=False)
    sub.add_argument("--quantile", type=float, default=0.99, metavar="Q",
                     help="share of the mass inside an edge (default: 0.99)")
    _rules(sub, several=True)
    _reading(sub, several=True)
    return parser


def join_negative(arguments):
    """--plane -1e-3 as --plane=-1e-3: argparse takes the number for an option"""
    joined = []
    for word in arguments:
        try:
            negative = word.startswith("-") and float(word) <= 0.0
        except ValueError:
            negative = False
        if negative and joined and joined[-1].startswith("--") and "=" not in joined[-1]:
            joined[-1] += "=" + word
        else:
            joined.append(word)
    return joined


def main(arguments=None):
    """Runs a command; returns the exit status: 0; 1 for wrong input, with one line on stderr; 130 when interrupted."""
    args = options().parse_args(join_negative(sys.argv[1:] if arguments is None else arguments))
    with warnings.catch_warnings():
        warnings.showwarning = lambda message, kind, *_: (
            print(f"hvi: warning: {message}", file=sys.stderr) if issubclass(kind, HVIWarning) else None)
        try:
            status = args.run(args) or 0
            sys.stdout.flush()
            return status
        except HVIError as error:
            print(f"hvi: {error}", file=sys.stderr)
        except ImportError as error:
            print(f"hvi: {error}: see Howto_python for what is needed", file=sys.stderr)
        except MemoryError:
            print("hvi: not enough memory for this frame", file=sys.stderr)
        except BrokenPipeError:  # as in  python3 -m hvi ... | head: nobody reads the rest
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        except OSError as error:
            print(f"hvi: {error}", file=sys.stderr)
        except KeyboardInterrupt:
            return 130
    return 1
