# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""The commands of python3 -m hvi; each takes the parsed options, prints, and returns the exit status or None for 0."""

import os

import numpy as np

from .. import progress, tables
from ..analysis import cloud as clouds
from ..analysis import debris as below
from ..analysis import distribution, fragments as pieces
from ..errors import HVIError
from ..io import mirror
from ..io import bonds as bond_sources
from ..io.data import DataFile
from ..io.dump import Dump
from ..io.scan import open_binary
from ..jobs import compare as comparison


def _open(args, paths=None, data=None):
    dump = Dump(paths or args.files, data=data or args.data, masses=dict(args.mass or ()), units=args.units,
                mirror=args.mirror, dt=args.dt, interval=args.interval, progress=progress.bar)
    if dump.mirror(-1):
        print(f"model: {mirror.text(dump.mirror(-1))}; what follows is of the whole")
    return dump


def _moment(frame):
    return f"frame {frame.number}, step {frame.step}" + ("" if frame.time is None else f", time {frame.time:.6g}")


def _save(figure, name):
    from ..figures import save

    for path in save(figure, name):
        print(f"figure: {path}")


def _has_rule(args):
    return any(rule is not None for rule in (args.column, args.bonds, args.distance))


def _rule(args, bonds=None):
    """What is a fragment, as the options say: keywords of fragments.find()"""
    if not _has_rule(args):
        raise HVIError("what is a fragment? give --column, --bonds or --distance")
    bonds = bond_sources.source(bonds or args.bonds, args.bond_columns, progress.bar)
    where = {} if args.plane is None else {"axis": args.axis, "plane": args.plane}
    failed = list(args.failed_columns) if args.sound else None
    return {"column": args.column, "bonds": bonds, "distance": args.distance, "failed": failed, **where}


def _of_types(args, frame):
    return frame if args.type is None else frame.select(np.isin(frame["type"], args.type))


def _debris(args, frame):
    """(Debris of the particles of a frame or None, why there is none)"""
    if args.density and not args.sound:
        raise HVIError("what is below the spacing are pieces of failed particles: --density needs --sound")
    if not args.sound:
        return None, None
    if args.size_column not in frame:
        return None, f"not known: the dump has no column {args.size_column} (compute hvi/atom fragsize)"
    if not args.density:
        return None, "not counted: give --density TYPE=RHO"
    return below.estimate(frame, pieces.has_failed(frame, args.failed_columns), dict(args.density), args.size_column), None


def _print(summary, missing=None):
    for name, value in summary.items():
        print(f"{name}: {tables.number(value)}")
    if missing:
        print(f"debris below the spacing: {missing}")


def _time(frame):
    return float("nan") if frame.time is None else frame.time


def info(args):
    dump = Dump(args.files, progress=progress.bar)
    first = dump.headers[0]
    print(f"{len(dump)} frames, {first.n} {(first.label or '').lower()} in the first, units {first.units or 'not said'}")
    print(f"columns: {' '.join(dump.columns)}")
    print(f"model: {mirror.text(dump.mirror(0))}")
    rows = [(k, h.step, "-" if h.time is None else h.time, h.n) for k, h in enumerate(dump.headers)]
    print(tables.text(("frame", "step", "time", "rows"), rows))


def cloud(args):
    dump = _open(args)
    numbers = range(len(dump)) if args.frame is None else [dump.number(k) for k in args.frame]
    with progress.bar(len(numbers), "cloud") as bar:
        rows = []
        for row in clouds.series((dump[k] for k in numbers), args.axis, args.plane, args.quantile):
            rows.append(row)
            bar.update()
    table = clouds.table(rows)
    names = [name for name in table.dtype.names if args.out or name not in ("time", "front_displacement_velocity")
             or np.isfinite(table[name]).any()]
    print(tables.text(names, table[names].tolist(), dict(clouds.SERIES), dump.units))
    if args.out:
        tables.write_csv(args.out, names, table[names].tolist())
    if args.figure:
        from .. import figures

        _save(figures.cloud(table, dump.units), args.figure)


def fragments(args):
    dump = _open(args)
    rule = _rule(args)
    if args.all:
        return _all_fragments(args, dump, rule)
    frame = _of_types(args, dump[args.frame])
    found, summary = pieces.both(frame, **rule)
    debris, missing = _debris(args, found.frame)
    print(_moment(frame))
    _print({**summary, **(debris.summary if debris else {})}, missing)
    names, rows = found.table.dtype.names, found.table.tolist()
    number, kind = np.ones(len(rows)), np.zeros(len(rows), dtype=int)
    if debris:  # a failed particle is a row of its own, under its own ID
        alone = np.searchsorted(found.frame.ids, found.table["id"])
        number, kind = debris.pieces[alone], debris.kind[alone]
        names, rows = (*names, "kind", "pieces", "piece_size"), [
            (*row, below.KINDS[k], n, size) for row, k, n, size in zip(
                rows, kind, number, np.where(found.table["count"] > 1, found.table["size"], debris.size[alone]))]
    if args.top > 0 and len(rows):
        print()
        print(tables.text(names, rows[:args.top], pieces.COLUMN_QUANTITIES, dump.units))
    resolved = found.table["mass"][kind == 0]
    fits = _fits(args, resolved, found.unit, found.images(kind == 0))
    if fits:
        print()
    for fit in fits:
        print(fit)
    if args.out:
        tables.write_csv(args.out, names, rows)
    if args.figure:
        from .. import figures

        known = kind < 2
        small = (found.table["mass"][known] / number[known], number[known]) if debris else None
        _save(figures.distribution(resolved, fits, dump.units, small), args.figure)


def _all_fragments(args, dump, rule):
    """One row per frame: when, and the summary"""
    if args.fit or args.figure:
        raise HVIError("--all makes a table; for a fit or a figure choose one frame with --frame")
    rows = []
    with progress.bar(len(dump), "fragments") as bar:
        for frame in dump:
            found, summary = pieces.both(_of_types(args, frame), **rule)
            debris, missing = _debris(args, found.frame)
            rows.append({"frame": frame.number, "step": frame.step, "time": _time(frame), **summary, **(debris.summary if debris else {})})
            bar.update()
    names, rows = list(rows[0]), [tuple(row.values()) for row in rows]
    quantities = {"time": "time", "subparticle_size": "distance",
                  **{name: "mass" for name in ("mass", "single_particles_mass", *(f"{kind}_mass" for kind in below.KINDS))}}
    print(tables.text(names, rows, quantities, dump.units))
    _print({}, missing)
    if args.out:
        tables.write_csv(args.out, names, rows)


def _fits(args, masses, unit, images):
    """Both laws on the same range, so that their likelihoods can be compared"""
    laws = {None: (), "both": distribution.LAWS}.get(args.fit, (args.fit,))
    fits, start = [], args.mmin
    for law in laws:
        fits.append(distribution.fit(masses, law, start, args.mmax, unit, images))
        start = fits[0].m_min
    return fits


def hole(args):
    from ..analysis import hole as holes

    def look(frame):
        return holes.measure(frame, args.axis, args.center, args.plane, thickness=args.thickness, dr=args.dr, fill=args.fill,
                             reference=args.reference, sectors=args.sectors, types=args.type, distance=args.distance)

    if _is_dump(args.files[0]):
        frames = _open(args)
    else:
        frames = [_of_data(args)]
    if args.all:
        return _all_holes(args, frames, look)
    frame = frames[args.frame]
    found = look(frame)
    print(_moment(frame))
    print(f"hole: {holes.SAID[found.values['found']]}")
    _print({name: value for name, value in found.values.items() if found.values["found"] >= 0 or name in ("share", "layer", "reference", "spacing", "found")})
    if args.out:
        tables.write_csv(args.out, list(found.values), [list(found.values.values())])
    if args.figure:
        from .. import figures

        _save(figures.hole(frame, found, args.axis), args.figure)
    return 0 if found.values["found"] >= 0 else 1


def _of_data(args):
    """The Frame of a data file"""
    if len(args.files) > 1 or args.data or args.dt or args.interval:
        raise HVIError(f"{args.files[0]} is no dump: one data file, without --data, --dt and --interval, or dumps")
    frame = DataFile(args.files[0]).frame(dict(args.mass or ()), args.units, mirror.of_words(args.mirror))
    if frame.planes:
        print(f"model: {mirror.text(frame.planes)}; what follows is of the whole")
    return frame


def _all_holes(args, frames, look):
    """One row per frame: when, and all values"""
    if args.figure:
        raise HVIError("--all makes a table; for a figure choose one frame with --frame")
    rows = []
    with progress.bar(len(frames), "hole") as bar:
        for frame in frames:
            rows.append({"frame": frame.number, "step": frame.step, "time": _time(frame), **look(frame).values})
            bar.update()
    names, rows = list(rows[0]), [tuple(row.values()) for row in rows]
    lengths = ("diameter", "smallest", "largest", "layer", "spacing", *(name for name in names if name.startswith("center")))
    print(tables.text(names, rows, {"time": "time", **dict.fromkeys(lengths, "distance")}, frames[0].units))
    if args.out:
        tables.write_csv(args.out, names, rows)


def map(args):
    from .. import figures

    draw = {"phase": figures.phase, "field": figures.field}[args.kind]
    bins = {"bins": tuple(args.bins)} if args.bins else {}
    _save(draw(_open(args)[args.frame], args.axis, args.plane, **bins), args.figure)


def plate(args):
    from ..model import bodies, plates

    if args.fill == "glass":
        if args.layers is not None or args.angles != [0.0] or args.zones:
            raise HVIError("a plate of glass has no --layers, --angles and --zones: those are of lattices")
        return _fill(args, bodies.cylinder(args.radius, args.thickness, quarter=args.quarter, middle=0.5 * args.thickness), "plate")
    made = plates.make(args.radius, args.thickness, args.spacing, args.layers, args.angles, args.zones, args.quarter)
    density, units = _density(args)
    plates.write(args.file, made, density, " ".join(os.path.basename(args.file).split()))
    count = np.bincount(made.type, minlength=len(made.volume) + 1)[1:]
    print(f"particles: {len(made.x)}")
    print(f"angles: {' '.join(f'{a:g}' for a in made.angles)}")
    print(f"density: {density:.10g}" + (f" (units {units})" if units else ""))
    print(f"mass: {density * (count @ made.volume):.6g}")
    rows = [(k + 1, count[k], made.spacing[k], made.step, density * made.volume[k]) for k in range(len(count))]
    print(tables.text(("type", "particles", "spacing", "step", "mass"), rows))


PLATE = ("thickness", "element", "layers", "core", "hold", "circle", "growth", "largest", "quarter", "center", "bottom")


def mesh(args):
    from ..model import mesh_import, mesh_plate

    given = {name: getattr(args, name) for name in PLATE if getattr(args, name) is not None}
    common = {"n": args.particles, "type": args.type, "node_type": args.node_type}
    inverted = 0
    if args.import_:
        if given:
            raise HVIError(f"--{next(iter(given))} is of plates, not of imported meshes")
        made, inverted = mesh_import.load(args.import_, cells=args.set, scale=args.scale or 1.0, move=args.move or (0.0, 0.0, 0.0), **common)
    else:
        for name in ("thickness", "element"):
            if name not in given:
                raise HVIError(f"a plate needs --{name}")
        for name in ("set", "scale", "move"):
            if getattr(args, name) is not None:
                raise HVIError(f"--{name} is of imported meshes, not of plates")
        side = None if args.side is None else args.side if len(args.side) > 1 else args.side[0]
        made = mesh_plate.plate(side=side, radius=args.radius, **given, **common)
    density, units = _density(args)
    made.write(args.file, density, " ".join(os.path.basename(args.file).split()))
    found = made.quality()
    _print({**found, "mass": density * found["volume"]})
    if inverted:
        print(f"elements that were inside out: {inverted}")
    print(f"density: {density:.10g}" + (f" (units {units})" if units else ""))
    print(tables.text(("type", "mass", "of"), [(k, m, "nodes" if k == made.node_type else "material") for k, m in made.masses(density).items()]))


def body(args):
    from ..model import bodies

    needed = {"sphere": {"radius"}, "cylinder": {"radius", "length"}, "box": {"size"}}[args.shape]
    given = {name for name in ("radius", "inner", "length", "size") if getattr(args, name) is not None}
    allowed = needed | ({"inner"} if "radius" in needed else set())
    if not needed <= given <= allowed:
        words = " and ".join("--" + name for name in sorted(needed, reverse=True))
        raise HVIError(f"a {args.shape} has {words}{' and may have --inner' if 'inner' in allowed else ''}, nothing else, not "
                       f"{' '.join('--' + name for name in sorted(given)) or 'none of these'}")
    if args.periodic and args.shape != "box":
        raise HVIError(f"--periodic is for boxes, not for a {args.shape}")
    sizes = {name: getattr(args, name) for name in given}
    if args.periodic:
        sizes["periodic"] = ["xyz".index(c) for c in args.periodic]
    _fill(args, getattr(bodies, args.shape)(**sizes, quarter=args.quarter), "body")


def _density(args):
    """(density, units or None)"""
    from ..model import plates

    return (args.density, None) if args.material is None else plates.density_of(args.material)


def _fill(args, shape, what):
    """fills a shape, writes it, and says how even it is"""
    from ..model import bodies

    density, units = _density(args)
    made = bodies.make(shape, args.spacing, args.fill, args.seed)
    bodies.write(args.file, made, density, f"{what} {' '.join(os.path.basename(args.file).split())}, {args.fill}")
    print(f"particles: {len(made.x)}")
    print(f"spacing: {made.spacing:.10g}")
    if made.step is not None:
        print("step: " + " ".join(f"{s:.10g}" for s in made.step))
    print(f"density: {density:.10g}" + (f" (units {units})" if units else ""))
    print(f"mass: {density * shape.volume:.10g}")
    print("center: " + " ".join(f"{c:.6g}" for c in shape.center))
    _print(bodies.measure(made))


def impacts(args):
    from ..analysis import maps

    frame = _open(args)[args.frame]
    found = maps.impacts(frame, args.axis, args.plane, args.bins, args.after, args.reach)
    debris, missing = _debris(args, found.frame)
    print(_moment(frame))
    _print(found.summary)
    if _has_rule(args):
        rule = {**_rule(args), "axis": None, "plane": None}  # the plane is that of the wall
        _print({name: value for name, value in pieces.both(found.frame, **rule)[1].items() if name not in ("mass", "particles")})
    if debris:
        summary = debris.summary
        shares = {f"{kind}_kinetic_energy": share for kind, share in zip(below.KINDS, debris.shares(found.kinetic))}
        _print({**summary, **shares})
    _print({}, missing)
    if args.figure:
        from .. import figures

        _save(figures.impacts(frame, found, args.axis), args.figure)


def view(args):
    from .. import figures

    frame = _open(args)[args.frame]
    found = None
    if args.color == "fragment":
        found = pieces.find(frame, **_rule(args))
    elif args.plane is not None:
        frame = frame.select(clouds.beyond(frame, args.axis, args.plane))
    _save(figures.side(frame, args.axis, args.up, args.color, args.thickness, found, args.diameter), args.figure)


def _is_dump(path):
    if os.path.isdir(path):
        return False
    with open_binary(path) as stream:
        return stream.read(5) == b"ITEM:"


def compare(args):
    runs = args.a, args.b
    kinds = [_is_dump(path) for path in runs]
    if kinds[0] != kinds[1]:
        raise HVIError(f"cannot compare a dump with a result.yaml: {runs[0]} and {runs[1]}")
    if kinds[0]:
        if args.plane is None:
            raise HVIError("to compare two dumps give --plane, and --axis if it is not z")
        both = [_measures(args, path, k) for k, path in enumerate(runs)]
    else:
        both = [comparison.read_result(path) for path in runs]
    if args.keys:
        unknown = [key for key in args.keys if not any(key in result for result in both)]
        if unknown:
            raise HVIError(f"there is no {' '.join(unknown)}; there are: {' '.join(both[0])}")
        both = [{key: result[key] for key in args.keys if key in result} for result in both]
    table = comparison.rows(*both)
    names = ("", "A", "B", "B - A", "relative")
    print(tables.text(names, [[comparison.cut(value) for value in row] for row in table]))
    for key, left, right, *_ in table:
        if (left, right) != (comparison.cut(left), comparison.cut(right)):
            print(key)
            for name, value in (("A", left), ("B", right)):
                print(f"  {name}: " + "\n     ".join(tables.number(value).split("; ")))
    if args.out:
        tables.write_csv(args.out, ("key", *names[1:]), table)
    if args.rtol is not None and not comparison.largest(table) <= args.rtol:
        print(f"larger than {args.rtol:g}: {', '.join(row[0] for row in table if comparison.largest([row]) > args.rtol)}")
        return 1
    return 0


def _measures(args, path, which):
    """Cloud and, if there is a rule for them, fragments of the cloud in one of two dumps"""
    frame = _open(args, path, args.data and args.data[which])[args.frame]
    result = {"step": frame.step}
    if frame.time is not None:
        result["time"] = frame.time
    result.update(clouds.measure(frame, args.axis, args.plane, args.quantile))
    if _has_rule(args):
        summary = pieces.both(frame, **_rule(args, args.bonds and args.bonds[which]))[1]
        result.update({name: value for name, value in summary.items() if name not in ("mass", "particles")})
    return result


def material(args):
    from ..material import curves, files as materials

    found = [materials.read(name) for name in args.files]
    if len(found) > 1:
        if args.figure:
            raise HVIError("--figure draws one file")
        rows = [materials.row(one) for one in found]
        print(tables.text(("file", "eos", "strength", "damage", "spall", "assumed"),
                          [[row["file"], row["eos"].partition(":")[0], row["strength"], row["damage"], row["spall"], sum(len(keys) for keys in one.assumed().values())]
                           for one, row in zip(found, rows)]))
        if args.out:
            tables.write_csv(args.out, rows[0], [list(row.values()) for row in rows])
        return
    one = found[0]
    print(f"{one.path}: {one.title}\nunits {one.units}, {'of ' + one.date if one.date else 'no date'}\n")
    for kind in materials.WANTED:
        why = one.lacks().get(kind)
        print(f"  {kind:9} {', '.join(one.laws(kind)) or 'none' + (f': {why}' if why else '; the file does not say why')}")
    for section, keys in one.assumed().items():
        for key, note in keys.items():
            print(f"  assumed   {' '.join(section)} {key} {one.sections[section][key]:g}: {note}")
    print("\nfor")
    for use, words, missing in materials.uses(one):
        print(f"  {'no ' if missing else 'yes'} {use}" + (f" ({words})" if words else "") + (f": it has no {', no '.join(missing)}" if missing else ""))
    if one.laws("eos")[0] in ("table", "idealgas"):
        print(f"\nno curves of eos {one.laws('eos')[0]}")
    else:
        if "voids" in one.laws("spall"):
            v, (pascal, hertz) = one.in_si(("spall", "voids")), ("", "") if one.units == "lj" else (" Pa", " 1/s")
            bears = curves.borne(one, v["rate"])
            print(f"\nspall voids, stretched at {v['rate']:g}{hertz}: bears {bears:.4g}{pascal}, {bears / v['sigma']:.3f} of sigma;"
                  f" to bear sigma itself takes a sigma of {curves.sigma_for(one, v['sigma'], v['rate']):.4g}{pascal}"
                  + (" (without delta_c, which lowers phi_c for large particles)" if v["delta_c"] else ""))
        names, rows = curves.shock_table(one)
        print("\nshocks into the reference state\n" + tables.text(names, rows))
        if args.out:
            tables.write_csv(args.out, names, rows)
    if args.figure:
        from ..figures.material import draw

        _save(draw(one), args.figure)
