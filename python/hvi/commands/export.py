# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi export: dumps as VTU files for ParaView, a PVD file of all with their times; or as one dump for OVITO. Units are in the names, types have names, halves and quarters are whole."""

import base64
import pathlib
import re
from xml.sax.saxutils import quoteattr

import numpy as np

from .. import progress, texts
from .. import units as unit_systems
from ..errors import HVIError
from ..shield.run import runs_of
from . import dumps

EXAMPLES = """  python3 -m hvi export runs/emi/dx-0.2_shift-0.0
  python3 -m hvi export runs/emi --to ovito
  python3 -m hvi export debris.dump --data debris.data --names sphere plate --out debris"""

PRESSURES, SPECIFIC = {"p", "vm"}, {"e"}  # columns of compute hvi/atom in in.shield, as in SI
LEFT_OUT = {"x", "y", "z", "xu", "yu", "zu", "xs", "ys", "zs", "xsu", "ysu", "zsu", "ix", "iy", "iz", "vx", "vy", "vz"}
KINDS = {"f": ("Float64", "<f8"), "i": ("Int64", "<i8"), "u": ("UInt8", "u1"), "b": ("UInt8", "u1")}
QUANTITY = {"mass": "mass", "fragsize": "distance", "h": "distance"}


def add_arguments(parser):
    parser.add_argument("files", nargs="+", metavar="DUMP|DIR", help="dump files of one run, or a folder as of hvi report")
    parser.add_argument("--to", choices=("paraview", "ovito"), default="paraview", help="paraview: a VTU file for each frame and a PVD file; ovito: one dump of all frames (default: paraview)")
    parser.add_argument("--out", metavar="NAME", help="NAME.pvd, and NAME.0000.vtu ... beside it; or NAME.lammpstrj (default: the name of the dump, of X.lammpstrj X.ovito.lammpstrj; in a folder: shield)")
    parser.add_argument("--names", nargs="+", action="extend", default=[], metavar="NAME", help="of types 1, 2, ... (default: in a folder projectile, wall 1, ... with their materials)")
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


def field_data(frame, names):
    """Values of the whole frame, as numbers with names, since not all readers know texts: the time, by the name that VTK gives it, and the types"""
    found = [] if frame.time is None else [array(np.array([frame.time]), "TimeValue")]
    found += [array(np.array([kind]), f"type {kind}: {name}") for kind, name in names.items()]
    return ["<FieldData>", *(text.replace("<DataArray", '<DataArray NumberOfTuples="1"') for text in found), "</FieldData>"] if found else []


def array(values, name=""):
    """a DataArray of VTK's XML: in binary, which is text in base 64, after its length in bytes"""
    kind, form = KINDS[values.dtype.kind]
    data = np.ascontiguousarray(values, dtype=form).tobytes()
    several = f' NumberOfComponents="{values.shape[1]}"' if values.ndim > 1 else ""
    title = f" Name={quoteattr(name)}" if name else ""
    return f'<DataArray type="{kind}"{title}{several} format="binary">{base64.b64encode(len(data).to_bytes(8, "little") + data).decode()}</DataArray>'


def write_vtu(path, frame, names):
    """A frame as points of a VTU file, each a vertex"""
    n = len(frame)
    length = unit_systems.name("distance", frame.units)
    lines = ['<?xml version="1.0"?>', '<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">', "<UnstructuredGrid>",
             *field_data(frame, names), f'<Piece NumberOfPoints="{n}" NumberOfCells="{n}">', "<Points>", array(frame.x, f"position ({length})"), "</Points>", "<Cells>", array(np.arange(n), "connectivity"),
             array(np.arange(1, n + 1), "offsets"), array(np.ones(n, dtype=np.uint8), "types"), "</Cells>", "<PointData>",
             *(array(values, name) for name, values in fields(frame).items()), "</PointData>", "</Piece>", "</UnstructuredGrid>", "</VTKFile>", ""]
    pathlib.Path(path).write_text("\n".join(lines), encoding="utf-8")


def write_frame(stream, frame, names):
    """A frame of a dump as LAMMPS writes it, and OVITO reads it: units, time, types with names, columns with units"""
    box, n = frame.box, len(frame)
    if frame.number == 0:
        stream.write(f"ITEM: UNITS\n{frame.units}\n")
    if frame.time is not None:
        stream.write(f"ITEM: TIME\n{frame.time:.9g}\n")
    faces = " ".join("pp" if periodic else "ff" for periodic in box.periodic)
    if np.any(box.vectors - np.diag(np.diag(box.vectors))):
        title, rows = "abc origin " + faces, np.column_stack([box.vectors, box.origin])
    else:
        title, rows = faces, np.column_stack([box.origin, box.origin + np.diag(box.vectors)])
    bounds = "".join(" ".join(f"{value:.9g}" for value in row) + "\n" for row in rows)
    columns = {"id": frame.ids, "type": frame["type"]} if "type" in frame else {"id": frame.ids}
    if "type" in frame and names:
        columns["element"] = np.array([names.get(int(kind), str(int(kind))) for kind in frame["type"]])
    columns.update({name + "u" * any(box.periodic): frame.x[:, k] for k, name in enumerate("xyz")})
    columns.update({name: frame[name] for name in ("vx", "vy", "vz") if name in frame})
    for name, column in fields(frame).items():
        if column.ndim == 1 and name not in ("id", "type"):
            columns["mass" if name.startswith("mass (") else re.sub(r" \((.*)\)$", r"_\1", name).replace(" ", "_")] = column
    stream.write(f"ITEM: TIMESTEP\n{frame.step}\nITEM: NUMBER OF ATOMS\n{n}\nITEM: BOX BOUNDS {title}\n{bounds}ITEM: ATOMS {' '.join(columns)}\n")
    texts = [[f"{value:.9g}" for value in column.tolist()] if column.dtype.kind == "f" else column.astype(str).tolist() for column in columns.values()]
    stream.writelines(" ".join(row) + "\n" for row in zip(*texts))


def sources(args):
    """(Dump, default name, {type: name}) of the options"""
    first = pathlib.Path(args.files[0])
    if not all(name.strip() for name in args.names):
        raise HVIError("--names: a name is empty: give each type one, in the order of their numbers")
    names = dict(enumerate(args.names, 1))
    if not first.is_dir():
        name = first.name.removesuffix(".gz").removesuffix(".dump")
        if args.to == "ovito" and name.endswith(".lammpstrj"):  # it would be the dump itself, or the one that was packed
            name = name.removesuffix(".lammpstrj") + ".ovito"
        return dumps.opened(args, args.files), name, names
    if len(args.files) > 1:
        raise HVIError("give one folder, or the dumps of one run")
    run = runs_of(first)[1][0]
    return dumps.opened(args, run.frames().paths), str(first / "shield"), names or run.type_names()


def frames_of(dump, args):
    """all frames, whole or as they are, with a bar"""
    with progress.bar(len(dump), "frames") as bar:
        for frame in dump:
            if args.names and "type" in frame and frame["type"].dtype.kind == "U":
                raise HVIError(f"--names: types have labels already in {dump.paths[0]}, such as {frame['type'][0]}: leave --names out")
            yield frame if args.part else frame.whole()
            bar.update()


def check_other(path, dump, args):
    """Refuses to write a file that is read: the frames of a dump are read while others are written"""
    for source in (*dump.paths, *([args.data] if args.data else [])):
        if path.exists() and path.samefile(source):
            raise HVIError(f"{path} is read here and cannot be written: give another --out")


def to_paraview(dump, args, out, names):
    """the name of the file to open"""
    out, rows = out.with_suffix("") if out.suffix == ".pvd" else out, []
    opens = out.with_name(out.name + ".pvd")
    check_other(opens, dump, args)
    for k, frame in enumerate(frames_of(dump, args)):
        path = out.with_name(f"{out.name}.{k:04d}.vtu")
        check_other(path, dump, args)
        write_vtu(path, frame, names)
        time = float(k) if frame.time is None else frame.time
        rows.append(f'    <DataSet timestep="{time:.12g}" part="0" file={quoteattr(path.name)}/>')
    text = "\n".join(['<?xml version="1.0"?>', '<VTKFile type="Collection" version="0.1" byte_order="LittleEndian">', "  <Collection>", *rows, "  </Collection>", "</VTKFile>", ""])
    opens.write_text(text)
    return opens


def to_ovito(dump, args, out, names):
    """the name of the file"""
    path = out if out.suffix == ".lammpstrj" else out.with_name(out.name + ".lammpstrj")
    words = {kind: re.sub(r"\s+", "", name.replace(", ", "_")) for kind, name in names.items()}  # a column of words between blanks
    check_other(path, dump, args)
    with texts.whole(path) as stream:
        for frame in frames_of(dump, args):
            write_frame(stream, frame, words)
    return path


def main(args):
    dump, name, names = sources(args)
    out = pathlib.Path(args.out or name)
    if out.name in ("", ".."):
        raise HVIError(f"--out {args.out} is a folder: it must be a name, as {pathlib.Path(args.out, 'shield')}")
    try:
        path = (to_ovito if args.to == "ovito" else to_paraview)(dump, args, out, names)
    except OSError as problem:
        raise HVIError(f"cannot write {problem.filename2 or problem.filename or out}: {problem.strerror}") from None
    unit = unit_systems.name("distance", dump.units)
    print(f"exported: {path}, {len(dump)} frames, lengths in {unit}, times in {unit_systems.name('time', dump.units) if dump.time(0) is not None else 'frames'}"
          + (f"; types: {'; '.join(f'{kind} {what}' for kind, what in names.items())}" if names else ""))
    return 0
