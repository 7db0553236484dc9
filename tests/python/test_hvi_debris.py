"""Debris below the spacing: what failed particles count for, in fragments and on the witness plate; and what a dump cannot know."""

import csv

import hvi
import numpy as np
import pytest
from hvi import cli
from hvi.analysis import debris
from hvi.analysis.distribution import cumulative

RHO = {1: 2000.0, 2: 1000.0}
# id, type, x, z, damage, spalled, fragsize: a sound pair; failed and larger than its particle, smaller, unknown; a sound one with a size that does not count
ROWS = [(1, 1, 0.0, 0.0, 0.0, 0, 0.0), (2, 1, 1.0, 0.0, 0.999, 0, 0.0), (3, 1, 2.0, 0.0, 1.0, 0, 1.5), (4, 1, 3.0, 0.0, 0.0, 1, 0.25),
        (5, 2, 4.0, 0.0, 0.0, 1, 0.5), (6, 2, 5.0, 0.0, 1.0, 1, 0.0), (7, 2, 9.0, 0.0, 0.0, 0, 0.01)]
VOLUME = np.pi / 6  # of a sphere with diameter 1
ARGUMENTS = ["--distance", "1.1", "--sound", "--density", "1=2000", "--density", "2=1000"]


def write(path, names="id type x y z vx vy vz mass damage spalled fragsize", columns=12):
    lines = ["ITEM: TIMESTEP", "0", "ITEM: NUMBER OF ATOMS", "7", "ITEM: BOX BOUNDS ff ff ff", *3 * ["-20 20"], "ITEM: ATOMS " + names]
    for i, kind, x, z, damage, spalled, size in ROWS:
        row = [i, kind, x, 0.0, z, 0.0, 0.0, 10.0 * kind, RHO[kind] * VOLUME, damage, spalled, size]
        lines.append(" ".join(map(repr, row[:columns])))
    path.write_text("\n".join(lines) + "\n")
    return hvi.Dump(path)[0]


def test_pieces_of_a_particle(tmp_path):
    """(d/s)^3 spheres where s < d, one where s >= d, none where s is unknown; the mass is all there"""
    frame = write(tmp_path / "a.dump")
    found = debris.estimate(frame, hvi.fragments.has_failed(frame), RHO)
    assert found.pieces == pytest.approx([1, 1, 1, 64, 8, 0, 1], rel=1e-12)
    assert found.size == pytest.approx([1, 1, 1, 0.25, 0.5, 0, 1], rel=1e-12)
    unit = VOLUME * 1000
    summary = found.summary
    assert summary["resolved_mass"] == pytest.approx(7 * unit) and summary["subparticle_mass"] == pytest.approx(3 * unit)
    assert summary["unknown_mass"] == pytest.approx(unit)
    assert sum(summary[f"{kind}_mass"] for kind in debris.KINDS) == pytest.approx(frame.m.sum(), rel=1e-15)
    assert summary["subparticle_pieces"] == pytest.approx(72) and summary["subparticle_size"] == pytest.approx((2 * 0.25 + 0.5) / 3)
    # a piece has the density of the matter
    below = found.pieces > 1
    rho = np.array([RHO[k] for k in frame["type"]])
    assert found.mass[below] / found.pieces[below] == pytest.approx(rho[below] * VOLUME * found.size[below] ** 3, rel=1e-12)
    nothing = debris.estimate(frame, np.zeros(7, dtype=bool), RHO).summary
    assert nothing["subparticle_mass"] == nothing["unknown_mass"] == nothing["subparticle_size"] == 0


def printed(capsys, *words):
    assert cli.main(list(words)) == 0
    out = capsys.readouterr().out
    return {line.split(": ", 1)[0]: line.split(": ", 1)[1] for line in out.splitlines() if ": " in line}


def lattice(path, shape, boundary, names="x y z"):
    """a lattice of failed particles, spacing 1, at 0.5 along directions with one of them"""
    sites = np.stack(np.meshgrid(*[np.arange(n) + 0.5 for n in shape], indexing="ij"), axis=-1).reshape(-1, 3)
    lines = ["ITEM: TIMESTEP", "0", "ITEM: NUMBER OF ATOMS", str(len(sites)), f"ITEM: BOX BOUNDS {boundary}", *3 * ["0 20"],
             f"ITEM: ATOMS id type {names} vx vy vz mass damage spalled fragsize mirror_none"]
    lines += [f"{i + 1} 1 {x} {y} {z} 0 0 1 {RHO[1]} 1 0 0.5 0" for i, (x, y, z) in enumerate(sites)]
    path.write_text("\n".join(lines) + "\n")
    return hvi.Dump(path)[0]


@pytest.mark.parametrize("shape, boundary, names, same", [
    ((20, 20, 1), "ff ff pp", "x y z", "z"), ((20, 20, 1), "ff ff pp", "xs ys zs", "z"), ((20, 1, 1), "ss ff ff", "x y z", "y and z"),
    ((20, 1, 1), "pp pp pp", "xu yu zu", "y and z"), ((1, 20, 1), "ff ff ff", "x y z", "x and z")], ids=str)
def test_planes_and_rows(tmp_path, capsys, shape, boundary, names, same):
    """a mass per length or area is no mass of spheres: an error, of a part of the frame too, however few; what needs no size is still found"""
    frame = lattice(tmp_path / "a.dump", shape, boundary, names)
    for part in (frame, frame.select(frame.ids == 3), frame.select(frame.ids > 3).whole()):
        with pytest.raises(hvi.HVIError, match=f"all particles have the same {same}\\."):
            debris.estimate(part, np.ones(len(part), dtype=bool), RHO)
    reach = ["--distance", "22" if names == "xs ys zs" else "1.1", "--sound"]  # scaled: by the box
    assert cli.main(["fragments", "a.dump", *reach, "--density", "1=2000"]) == 1
    assert "masses are per length or area" in capsys.readouterr().err
    assert printed(capsys, "fragments", "a.dump", *reach)["pieces_apart"] == "1"


@pytest.mark.parametrize("shape, boundary", [
    ((5, 5, 2), "ff ff pp"), ((2, 5, 1), "ff ff ff"), ((2, 2, 2), "pp pp pp"), ((2, 2, 1), "ff ff ff"), ((1, 1, 1), "pp pp pp")], ids=str)
def test_what_is_no_plane(tmp_path, shape, boundary):
    """two layers; up to 8 particles at one coordinate, which a scene with an axis has in three dimensions"""
    frame = lattice(tmp_path / "a.dump", shape, boundary)
    if shape == (2, 5, 1):
        frame.columns["z"][0] += 1e-6  # as little as dumps write
    found = debris.estimate(frame, np.ones(len(frame), dtype=bool), RHO)
    assert found.pieces == pytest.approx(6 / np.pi / 0.5**3)  # of a unit of volume


def test_number_above_a_mass():
    m, above, from_here = cumulative([1.0, 4.0, 1.0, 2.0], [3.0, 1.0, 2.5, 10.0])
    assert m.tolist() == [1, 2, 4] and above.tolist() == [11, 1, 0] and from_here.tolist() == [16.5, 11, 1]


def test_fragments_command(tmp_path, capsys):
    """both numbers, the three masses; rows say what they are; a second curve in the figure"""
    write(tmp_path / "a.dump")
    said = printed(capsys, "fragments", "a.dump", *ARGUMENTS, "--out", "f.csv", "--figure", "f.png")
    assert (said["fragments"], said["pieces_apart"]) == ("6", "2")
    assert float(said["largest_fragment_mass_fraction"]) == pytest.approx(4 / 11, rel=1e-5)
    assert float(said["largest_apart_mass_fraction"]) == pytest.approx(10 / 11, rel=1e-5)
    assert said["subparticle_pieces"] == "72" and float(said["unknown_mass"]) == pytest.approx(1000 * VOLUME, rel=1e-5)
    assert (tmp_path / "f.png").stat().st_size > 1000
    with open("f.csv", newline="") as stream:
        rows = {int(row["id"]): row for row in csv.DictReader(stream)}
    assert {i: row["kind"] for i, row in rows.items()} == {
        1: "resolved", 3: "resolved", 4: "subparticle", 5: "subparticle", 6: "unknown", 7: "resolved"}
    assert float(rows[4]["pieces"]) == pytest.approx(64) and float(rows[4]["piece_size"]) == pytest.approx(0.25)
    assert sum(float(row["mass"]) for row in rows.values()) == pytest.approx(11000 * VOLUME, rel=1e-12)
    # of one type; every frame
    said = printed(capsys, "fragments", "a.dump", *ARGUMENTS, "--type", "1", "--top", "0")
    assert (said["fragments"], said["pieces_apart"], said["unknown_mass"], said["subparticle_pieces"]) == ("3", "1", "0", "64")
    assert cli.main(["fragments", "a.dump", *ARGUMENTS, "--all", "--out", "all.csv"]) == 0
    with open("all.csv", newline="") as stream:
        row = next(csv.DictReader(stream))
    assert row["pieces_apart"] == "2" and float(row["subparticle_pieces"]) == pytest.approx(72)


def test_witness_plate(tmp_path, capsys):
    """masses and energies of what is resolved, below the spacing and unknown, of all images"""
    write(tmp_path / "a.dump")
    for words, copies, pieces in (((), 1, (6, 2)), (("--quarter",), 4, (19, 3))):  # all are on the mirror y = 0, two pieces on x = 0
        said = printed(capsys, "impacts", "a.dump", "--axis", "z", "--plane", "10", *ARGUMENTS, *words)
        got = {name: float(value) for name, value in said.items() if name != "model"}
        mass, energy = copies * 1000 * VOLUME, copies * 1000 * VOLUME * 50
        assert [got[f"{kind}_mass"] for kind in debris.KINDS] == pytest.approx([7 * mass, 3 * mass, mass], rel=1e-5), words
        assert [got[f"{kind}_kinetic_energy"] for kind in debris.KINDS] == pytest.approx([10 * energy, 6 * energy, 4 * energy], rel=1e-5), words
        assert sum(got[f"{kind}_kinetic_energy"] for kind in debris.KINDS) == pytest.approx(got["kinetic_energy"], rel=1e-5), words
        assert got["subparticle_pieces"] == pytest.approx(72 * copies) and got["subparticle_size"] == pytest.approx(1 / 3, rel=1e-5)
        assert (got["fragments"], got["pieces_apart"]) == pieces


def test_what_a_dump_does_not_know(tmp_path, capsys):
    write(tmp_path / "old.dump", "id type x y z vx vy vz mass c_state[2] c_state[3]", 11)
    write(tmp_path / "a.dump")
    failed = ["--failed-columns", "c_state[2]", "c_state[3]"]
    for command in (["fragments"], ["impacts", "--axis", "z", "--plane", "10"]):
        said = printed(capsys, command[0], "old.dump", *command[1:], *ARGUMENTS, *failed)
        assert said["fragments"] == "6" and "subparticle_mass" not in said, command
        assert said["debris below the spacing"].startswith("not known") and "fragsize" in said["debris below the spacing"], command
        said = printed(capsys, command[0], "a.dump", *command[1:], "--distance", "1.1", "--sound")
        assert said["debris below the spacing"] == "not counted: give --density TYPE=RHO" and "subparticle_mass" not in said, command
        said = printed(capsys, command[0], "a.dump", *command[1:], "--distance", "1.1")
        assert said["fragments"] == "2" and "pieces_apart" not in said and "debris below the spacing" not in said, command


@pytest.mark.parametrize("words, message", [
    (["--distance", "1.1", "--density", "1=2000"], "--density needs --sound"),
    (["--distance", "1.1", "--sound", "--density", "1=2000"], "no density for type 2; known are 1=2000"),
    (["--distance", "1.1", "--sound", "--failed-columns", "d_x"], "has no column d_x"),
    (["--column", "id", "--sound"], "sound pieces are found by distance"),
    ([*ARGUMENTS, "--size-column", "odd"], "column odd is no size: -1"),
    ([*ARGUMENTS, "--size-column", "none"], "none of particle 1 is nan"),
])
def test_wrong_input(tmp_path, capsys, words, message):
    write(tmp_path / "a.dump")
    text = (tmp_path / "a.dump").read_text().replace("fragsize\n1 1 0.0", "fragsize odd none\n1 1 0.0")
    head, rows = text.split("none\n")
    (tmp_path / "a.dump").write_text(head + "none\n" + rows.replace("\n", " -1 nan\n"))
    assert cli.main(["fragments", "a.dump", *words]) == 1
    assert message in capsys.readouterr().err
