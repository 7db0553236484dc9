# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi export: dumps as VTU files for ParaView, a PVD file of all with their times; units are in the names."""

import base64
import pathlib
from xml.sax.saxutils import quoteattr

import numpy as np

from .. import progress
from .. import units as unit_systems
from ..errors import HVIError
from ..shield.run import runs_of
from . import dumps

EXAMPLES = """  python3 -m hvi export runs/emi/dx-0.2_shift-0.0
  python3 -m hvi export debris.dump --data debris.data --out debris"""

PRESSURES, SPECIFIC = {"p", "vm"}, {"e"}  # columns of compute hvi/atom in in.shield, as in SI
LEFT_OUT = {"x", "y", "z", "xu", "yu", "zu", "xs", "ys", "zs", "xsu", "ysu", "zsu", "ix", "iy", "iz", "vx", "vy", "vz"}
KINDS = {"f": ("Float64", "<f8"), "i": ("Int64", "<i8"), "u": ("UInt8", "u1"), "b": ("UInt8", "u1")}
QUANTITY = {"mass": "mass", "fragsize": "distance", "h": "distance"}


def add_arguments(parser):
    parser.add_argument("files", nargs="+", metavar="DUMP|DIR", help="dump files of one run, or a folder as of hvi report")
    parser.add_argument("--out", metavar="NAME", help="NAME.pvd, and NAME.0000.vtu ... beside it (default: the name of the dump; in a folder: shield)")
    parser.add_argument("--part", action="store_true", help="of a half or quarter model only the part that was computed, not the whole")
    dumps.add_reading(parser)


def name_of(column, units):
    """of a column, with its unit where it is known: fragsize (m)"""
    unit = unit_systems.name(QUANTITY.get(column), units)
    if units == "si":
        unit = "Pa" if column in PRESSURES else "J/kg" if column in SPECIFIC else unit
    return f"{column} ({unit})" if unit else column


def fields(frame):
    """{name: (n,) or (n, 3)} of a frame; columns of words are left out, as those that say what the header says"""
    found = {}
    if all(name in frame for name in ("vx", "vy", "vz")):
        found[f"velocity ({unit_systems.name('velocity', frame.units)})"] = frame.v
    for name, column in frame.columns.items():
        if name in LEFT_OUT or column.dtype.kind == "U" or name.startswith(("time_", "mirror_")):
            continue
        found[name_of(name, frame.units)] = column
    if "mass" not in frame and frame.type_masses:
        found[name_of("mass", frame.units)] = frame.m
    return found


def array(values, name=""):
    """a DataArray of VTK's XML: in binary, which is text in base 64, after its length in bytes"""
    kind, form = KINDS[values.dtype.kind]
    data = np.ascontiguousarray(values, dtype=form).tobytes()
    several = f' NumberOfComponents="{values.shape[1]}"' if values.ndim > 1 else ""
    title = f" Name={quoteattr(name)}" if name else ""
    return f'<DataArray type="{kind}"{title}{several} format="binary">{base64.b64encode(len(data).to_bytes(8, "little") + data).decode()}</DataArray>'


def write(path, frame):
    """A frame as points of a VTU file, each a vertex"""
    n = len(frame)
    lines = ['<?xml version="1.0"?>', '<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">', "<UnstructuredGrid>",
             f'<Piece NumberOfPoints="{n}" NumberOfCells="{n}">', "<Points>", array(frame.x), "</Points>", "<Cells>", array(np.arange(n), "connectivity"),
             array(np.arange(1, n + 1), "offsets"), array(np.ones(n, dtype=np.uint8), "types"), "</Cells>", "<PointData>",
             *(array(values, name) for name, values in fields(frame).items()), "</PointData>", "</Piece>", "</UnstructuredGrid>", "</VTKFile>", ""]
    pathlib.Path(path).write_text("\n".join(lines), encoding="utf-8")


def sources(args):
    """(Dump, default name) of the options"""
    first = pathlib.Path(args.files[0])
    if not first.is_dir():
        return dumps.opened(args, args.files), first.name.removesuffix(".gz").removesuffix(".dump")
    if len(args.files) > 1:
        raise HVIError("give one folder, or the dumps of one run")
    run = runs_of(first)[1][0]
    return dumps.opened(args, run.frames().paths), str(first / "shield")


def main(args):
    dump, name = sources(args)
    out = pathlib.Path(args.out or name)
    out = out.with_suffix("") if out.suffix == ".pvd" else out
    if out.name in ("", ".."):
        raise HVIError(f"--out {args.out} is a folder: it must be a name, as {pathlib.Path(args.out, 'shield')}")
    rows = []
    try:
        with progress.bar(len(dump), "frames") as bar:
            for k, frame in enumerate(dump):
                path = out.with_name(f"{out.name}.{k:04d}.vtu")
                write(path, frame if args.part else frame.whole())
                time = float(k) if frame.time is None else frame.time
                rows.append(f'    <DataSet timestep="{time:.12g}" part="0" file={quoteattr(path.name)}/>')
                bar.update()
        text = "\n".join(['<?xml version="1.0"?>', '<VTKFile type="Collection" version="0.1" byte_order="LittleEndian">', "  <Collection>", *rows, "  </Collection>", "</VTKFile>", ""])
        out.with_name(out.name + ".pvd").write_text(text)
    except OSError as problem:
        raise HVIError(f"cannot write {problem.filename or out}: {problem.strerror}") from None
    unit = unit_systems.name("distance", dump.units)
    print(f"exported: {out}.pvd, {len(rows)} frames, lengths in {unit}, times in {unit_systems.name('time', dump.units) if dump.time(0) is not None else 'frames'}")
    return 0
