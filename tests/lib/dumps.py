"""Text dumps of LAMMPS (dump custom, dump local), as arrays. The one reader of tests, but for those of the format itself."""

import pathlib

import numpy as np


class Frame(dict):
    """{column: array}, id and type whole numbers; step, time (None if the dump does not say it), table: all columns as one array, rows in the order of the file, or by ID"""

    def __init__(self, names, table, step, time):
        super().__init__((name, column.astype(int) if name in ("id", "type") else column) for name, column in zip(names, table.T))
        self.table, self.step, self.time = table, step, time


def frames(path, sort=False):
    """all of a dump; sort: by ID"""
    out, said, rows, lines, k = [], {}, None, pathlib.Path(path).read_text().splitlines(), 0
    while k < len(lines):
        item, k = lines[k], k + 1
        if item.startswith("ITEM: NUMBER OF "):
            rows, count = f"ITEM: {item[16:]} ", int(lines[k])
        elif item in ("ITEM: TIMESTEP", "ITEM: TIME"):
            said[item] = float(lines[k])
        elif rows and item.startswith(rows):
            names = item[len(rows):].split()
            table = np.array([line.split() for line in lines[k:k + count]], dtype=float).reshape(count, len(names))
            table = table[np.argsort(table[:, names.index("id")])] if sort else table
            out.append(Frame(names, table, int(said["ITEM: TIMESTEP"]), said.get("ITEM: TIME")))
            k += count
    return out


def read_dump(path, sort=False):
    """the last frame"""
    return frames(path, sort)[-1]


def vectors(frame, what):
    return np.stack([frame[what + c] for c in "xyz"], axis=1)


def named(frame, **computes):
    """{name: array}: x, v and f as (n, 3); R="drho de" are names for c_R[1], c_R[2] or c_R; S=None takes all of c_S[*] as one array"""
    out = dict(frame)
    for what in ("", "v", "f"):
        if what + "x" in frame:
            out[what or "x"] = vectors(frame, what)
            for name in {what + c for c in "xyz"} - {what or "x"}:
                del out[name]
    for c, names in computes.items():
        columns = [out.pop(name) for name in frame if name.split("[")[0] == f"c_{c}"]
        assert columns, f"no column c_{c} in the dump"
        out.update(zip(names.split(), columns) if names else {c: np.stack(columns, axis=1)})
    return out
