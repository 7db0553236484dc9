#!/usr/bin/env python3
"""How long python/hvi takes for one large frame: PYTHONPATH=python python3 bench/reading.py [--particles 740000] [--peer]

Writes a dump of two frames of a cubic lattice (id type x y z vx vy vz, LAMMPS's %g) with bonds, and times what users do
with it. --peer: also MDAnalysis's own reader of LAMMPS dumps, which keeps no other columns.
"""

import argparse
import os
import resource
import tempfile
import time

import numpy as np

import hvi
from hvi.io.bonds import BondDump

HEAD = "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF {}\n{}\nITEM: BOX BOUNDS ff ff ff\n-1 200\n-1 200\n-1 200\nITEM: {}\n"


def write(folder, n):
    """A dump of particles and one of bonds, two frames each; returns their paths."""
    side = int(np.ceil(n ** (1 / 3)))
    grid = np.arange(side**3).reshape(side, side, side)
    pairs = [np.stack([np.delete(grid, -1, k), np.delete(grid, 0, k)], -1).reshape(-1, 2) for k in range(3)]
    pairs = np.concatenate(pairs) + 1
    pairs = pairs[(pairs <= n).all(axis=1)]
    rng = np.random.default_rng(1)
    pairs = pairs[rng.random(len(pairs)) < 0.5]
    x = np.stack(np.unravel_index(np.arange(n), grid.shape), axis=1) + rng.uniform(-0.1, 0.1, (n, 3))
    rows = np.column_stack([np.arange(1, n + 1), 1 + np.arange(n) % 2, x, rng.normal(0.0, 1000.0, (n, 3))])
    atoms, bonds = os.path.join(folder, "atoms.dump"), os.path.join(folder, "bonds.dump")
    with open(atoms, "w") as one, open(bonds, "w") as two:
        for step in (0, 1000):
            one.write(HEAD.format(step, "ATOMS", n, "ATOMS id type x y z vx vy vz"))
            np.savetxt(one, rows, fmt="%d %d" + 6 * " %g")
            two.write(HEAD.format(step, "ENTRIES", len(pairs), "ENTRIES index c_b[1] c_b[2]"))
            np.savetxt(two, np.column_stack([np.arange(1, len(pairs) + 1), pairs]), fmt="%d %d %d")
    return atoms, bonds


def timed(what, work):
    """Runs work(), prints its wall and processor time."""
    wall, cpu = time.perf_counter(), time.process_time()
    result = work()
    print(f"{what:42s} {time.perf_counter() - wall:7.2f} s wall  {time.process_time() - cpu:7.2f} s cpu", flush=True)
    return result


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--particles", type=int, default=740000)
    parser.add_argument("--peer", action="store_true")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        atoms, bonds = write(folder, args.particles)
        print(f"{args.particles} particles, {os.path.getsize(atoms) / 2e6:.0f} MB per frame, "
              f"load {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")
        dump = timed("find the frames", lambda: hvi.Dump(atoms, masses={1: 1.0, 2: 1.0}))
        frame = timed("read a frame of 8 columns", lambda: dump[1])
        timed("cloud measures", lambda: hvi.measure(frame, "z", 20.0))
        bonds = BondDump(bonds)
        found = timed("read bonds, find fragments, table", lambda: hvi.find(frame, bonds=bonds))
        timed("fragments by distance", lambda: hvi.find(frame, distance=1.05))
        print(f"{len(found.table)} fragments; {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024:.0f} MB at most so far")
        timed("import MDAnalysis", lambda: hvi.universe)

        universe = timed("open a Universe", lambda: hvi.open(atoms, masses={1: 1.0, 2: 1.0}))
        timed("its next frame", lambda: universe.trajectory[1])
        timed("open a Universe with bonds", lambda: hvi.open(atoms, masses={1: 1.0, 2: 1.0}, bonds=bonds))
        if args.peer:
            import MDAnalysis

            how = {"format": "LAMMPSDUMP", "topology_format": "LAMMPSDUMP"}
            peer = timed("MDAnalysis LAMMPSDUMP, open", lambda: MDAnalysis.Universe(atoms, **how))
            timed("its next frame", lambda: peer.trajectory[1])


if __name__ == "__main__":
    main()
