"""Does a cloud of lumps harm a wall more than the same cloud of fragments? The matter on its way to the last wall is handed on as n^3 pieces per particle.

    hvi shield A635.yaml --write run; cd run/*; lmp -in in.shield -var until 7.0     # with write_data cloud.data before its last run
    python3 hand_on.py . OUT --pieces 2 --spread; cd OUT; lmp -in in.wall

Mass, momentum and energy per mass are those of the particles; pieces lie on a cube of the size of the particle, or with --spread within a sphere that reaches
half-way to the sixth neighbor, with velocities in addition as if all had come from one place. All have the smoothing length of the whole. README.md has what came of it.
"""

import argparse
import pathlib
import re

import numpy as np
from scipy.spatial import cKDTree

SECTIONS = ("Masses", "Atoms", "Velocities", "move", "move_rates", "move_step", "solid", "solid_forces", "solid_voids")
FIX = "fix move NULL NULL fix move NULL move_rates fix move NULL move_step fix solid NULL NULL fix solid NULL solid_forces fix solid NULL solid_voids"


def sections(lines):
    """{title: rows of words}, and their title lines"""
    heads = {line.split()[0]: k for k, line in enumerate(lines) if line.split() and line.split()[0] in SECTIONS and (line.startswith(("Masses", "Atoms", "Velocities")) or "#" in line)}
    found = {}
    for name, at in heads.items():
        end = next((k for k in range(at + 2, len(lines)) if not lines[k].strip()), len(lines))
        found[name] = [line.split() for line in lines[at + 2:end]]
    return found, {name: lines[at] for name, at in heads.items()}


def add(row, first, values):
    for k, value in enumerate(values):
        row[first + k] = repr(float(row[first + k]) + float(value))


def hand_on(lines, n, spread, time, front):
    """lines of the data file with the cloud (types 1 and 2, front of the bumper behind it, m) in pieces of types 5 and 6"""
    tables, titles = sections(lines)
    rows = {name: {row[0]: row for row in table} for name, table in tables.items()}
    masses = {int(row[0]): float(row[1]) for row in tables["Masses"]}
    at = {tag: np.array(row[5:8], dtype=float) for tag, row in rows["Atoms"].items()}
    cloud = [tag for tag, row in rows["Atoms"].items() if int(row[1]) < 3 and at[tag][2] > front and float(rows["Velocities"][tag][3]) > 500]
    far = dict(zip(cloud, cKDTree([at[tag] for tag in cloud]).query([at[tag] for tag in cloud], k=7)[0][:, 6]))
    random, N, top = np.random.default_rng(1), n**3, max(map(int, at))
    grid = (np.stack(np.meshgrid(*[np.arange(n)] * 3, indexing="ij"), -1).reshape(-1, 3) + 0.5) / n - 0.5
    new = {name: [] for name in titles if name != "Masses"}
    for tag in rows["Atoms"]:
        if tag not in far or N == 1 and not spread:
            for name, table in new.items():
                table.append(rows[name][tag])
            continue
        size = (masses[int(rows["Atoms"][tag][1])] / 2750) ** (1 / 3)
        places = grid * size
        if spread:
            places = random.normal(size=(N, 3))
            places *= 0.5 * max(far[tag], size) * random.random((N, 1)) ** (1 / 3) / np.linalg.norm(places, axis=1, keepdims=True)
            places -= places.mean(axis=0)
        for k, place in enumerate(places):
            top, name = (top + 1, str(top + 1)) if k else (top, tag)
            piece = {title: [name, *rows[title][tag][1:]] for title in new}
            x, v = at[tag] + place, place / time if spread else np.zeros(3)
            piece["Atoms"][1] = str(4 + int(rows["Atoms"][tag][1]))
            piece["Atoms"][3] = repr(float(piece["Atoms"][3]) / N)
            piece["Atoms"][5:8] = map(repr, map(float, np.concatenate([abs(x[:2]), x[2:]])))  # a quarter: beyond a plane it is the image of another
            v[:2] *= x[:2] > 0
            add(piece["Velocities"], 1, v)
            piece["move"][4] = repr(float(piece["move"][4]) / N)
            add(piece["move"], 5, v)
            piece["move_rates"][2] = repr(float(piece["move_rates"][2]) / N)
            add(piece["move_step"], 1, v)
            if spread:
                piece["solid"][9] = "1"  # spalled
            for title, row in piece.items():
                new[title].append(row)
    box = [line for line in lines[:12] if line.endswith("hi")]
    head = ["LAMMPS data file: a cloud in pieces, units = si", "", f"{len(new['Atoms'])} atoms", "6 atom types", "", *box, "", "Masses", ""]
    head += [f"{k} {m!r}" for k, m in sorted({**masses, 5: masses[1] / N, 6: masses[2] / N}.items())]
    return head + [line for name, table in new.items() for line in ("", titles[name], "", *(" ".join(row) for row in table))]


def continued(lines, n, time):
    """in.wall: the input from the data file on"""
    first, second = (next(k for k, line in enumerate(lines) if line.startswith(mark)) for mark in ("# bodies", "# what moves"))
    fixes = [line for line in lines if line.startswith(("fix             move", "fix             solid"))]
    kept = [line for line in lines[second:] if line not in fixes and line.split()[:1] not in ([w] for w in "velocity mass dump dump_modify write_restart write_data group".split())]
    for kind in (1, 2):
        coeff = next(line for line in lines if line.startswith(f"pair_coeff      {kind} {kind} "))
        spacing, volume = float(re.search(r"spacing (\S+)", coeff)[1]), re.search(r"volume (\S+)", coeff)
        of = re.sub(r" *#.*| volume \S+", "", coeff).replace(f"{kind} {kind} ", f"{4 + kind} {4 + kind} ", 1)
        kept.insert(kept.index(coeff) + 1, f"{of} volume {(float(volume[1]) if volume else spacing**3) / n**3!r}")
    text = "\n".join([*lines[:first], "region small block 0 1e-3 0 1e-3 0.02 0.021 units box", "create_box 6 small", *fixes, f"read_data cloud.data add merge {FIX}", *kept]) + "\n"
    return re.sub(r"(v_us >=? )([\d.]+)", lambda m: m[1] + f"{float(m[2]) - 1e6 * time:.6g}", text)  # time begins anew


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", type=pathlib.Path, help="folder of in.shield and cloud.data")
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--pieces", type=int, default=1, help="to an edge of a particle")
    parser.add_argument("--spread", action="store_true")
    parser.add_argument("--time", type=float, default=7e-6, help="s since the impact")
    parser.add_argument("--front", type=float, default=4e-3, help="m, where the cloud begins")
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    data = hand_on((args.run / "cloud.data").read_text().splitlines(), args.pieces, args.spread, args.time, args.front)
    (args.out / "cloud.data").write_text("\n".join(data) + "\n")
    (args.out / "in.wall").write_text(continued((args.run / "in.shield").read_text().splitlines(), args.pieces, args.time))
    for path in args.run.glob("*.hvi"):
        (args.out / path.name).write_bytes(path.read_bytes())


if __name__ == "__main__":
    main()
