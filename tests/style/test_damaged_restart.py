"""Restart files that are damaged, cut off or of another form: an error that names what is wrong, where the bytes are the package's own."""

import random
import struct

import pytest
from fem_scenes import STATE, start, strike_plate
from hvi.jobs import engine
from scenes import DUMP, collision, scene

MARK = struct.pack("<Q", 0x4856490000000001)[3:]  # "HVI" in the header of a section; the form is before it
HEADER = 32  # bytes: form, size, checksum, checksum of the header
BASE = 17  # numbers that atom_style sph has of a particle
SAID = "is damaged", "are damaged", "of another version", "Unexpected end of file", "checksum"


def elements(rest, read=None):
    """a plate of elements and a ball above it; read: a restart file to go on from"""
    mesh, strike_it = strike_plate(nx=2, ny=2, nz=1, core=0)
    text = start(mesh, every=1)
    if not read:
        return text + strike_it + rest
    head, body = text[:text.index("fix prop")], text[text.index("pair_style"):]
    newton = next(line for line in head.splitlines() if line.startswith("newton"))
    body = "\n".join(line for line in body.splitlines() if not line.startswith("read_data"))
    return f"{newton}\nread_restart {read}\nfix prop all property/atom rmass ghost yes\n" + body + "\n" + rest


def bonded(rest, read=None):
    """two blocks of bonded particles; likewise"""
    if not read:
        return scene(collision(3), "s.data", sort=False) + "fix nve all nve\nfix step all hvi/dt 0.1\ncompute book all hvi/energy\n" + rest
    return (f"read_restart {read}\nneighbor 0.3 bin\nneigh_modify every 1 delay 0 check yes\nfix nve all nve\nfix step all hvi/dt 0.1\n"
            "compute book all hvi/energy\nthermo_style custom step c_book[8]\n" + rest)


SCENES = {"elements": (elements, STATE.format("out")), "bonded": (bonded, DUMP.format("out"))}


@pytest.fixture(params=SCENES)
def written(request, lmp, tmp_path):
    """name, bytes of a restart file, input that goes on from the file 'now'"""
    text, out = SCENES[request.param]
    lmp(text("run 5\nwrite_restart good\n"))
    return request.param, (tmp_path / "good").read_bytes(), text("run 1\n" + out, read="now")


def sections(data):
    """(begin, end) of each section"""
    found, at = [], data.find(MARK)
    while at >= 0:
        size = struct.unpack_from("<Q", data, at + 5)[0]
        found.append((at - 3, at - 3 + HEADER + size))
        at = data.find(MARK, at + 1)
    return found


def records(data):
    """(begin, end) of what our fixes have of each particle, in the file of one rank of atom_style sph; fix property/atom is first"""
    end = len(data) - len(engine.END)
    at = next(at for at in range(sections(data)[-1][1], end) if at + 4 + 8 * struct.unpack_from("<i", data, at)[0] == end) + 4
    found = []
    while at < end:
        size, mine = int(struct.unpack_from("<d", data, at)[0]), at + 8 * BASE
        mine += 8 * int(struct.unpack_from("<d", data, mine)[0])
        found.append((mine, at + 8 * size))
        at += 8 * size
    assert at == end
    return found


def outcome(lmp, tmp_path, text, data, **how):
    """what is said of these bytes: '' if nothing"""
    (tmp_path / "now").write_bytes(data)
    r = lmp(text, **how)
    assert r.returncode in (0, 1) and "Sanitizer" not in r.stderr and "signal" not in r.stderr, str(r)
    return r.error


def flipped(data, at, bit):
    return data[:at] + bytes([data[at] ^ 1 << bit]) + data[at + 1:]


def test_what_is_written(lmp, tmp_path, written):
    """the file itself is read; its sections are where this test looks for them"""
    name, data, text = written
    assert outcome(lmp, tmp_path, text, data) == ""
    assert len(sections(data)) == {"elements": 7, "bonded": 5}[name]  # pair 2, bond, dt, ledger, sph, johnson-cook, fem


@pytest.mark.parametrize("seed", [1, pytest.param(2, marks=pytest.mark.long), pytest.param(3, marks=pytest.mark.long)])
def test_a_bit_of_ours(lmp, tmp_path, written, seed):
    """in the header and in the middle of each section, in records of each kind: an error"""
    name, data, text = written
    rng = random.Random(seed)
    places = [at for begin, end in sections(data) for at in (rng.randrange(begin, begin + HEADER), rng.randrange(begin + HEADER, end))]
    if name == "elements":
        places += [rng.randrange(*mine) for mine in rng.sample(records(data), 6 if seed == 1 else 40)]
    for at in places:
        bit = rng.randrange(8)
        said = outcome(lmp, tmp_path, text, flipped(data, at, bit), expect_fail=True)
        assert any(words in said for words in SAID) and "hvi/" in said, (at, bit, said)


def test_cut(lmp, tmp_path, written):
    """at each tenth, and before the mark at the end"""
    _, data, text = written
    for size in [*(k * len(data) // 10 for k in range(10)), len(data) - 20]:
        assert outcome(lmp, tmp_path, text, data[:size], expect_fail=True), size


def test_types_that_are_not_there(lmp, tmp_path):
    """LAMMPS takes them from a restart file as they are: an error before anything is looked up by them"""
    lmp(bonded("run 1\nwrite_restart good\nwrite_dump all custom p id type x y z modify format float %.17g\n"))
    data, text = (tmp_path / "good").read_bytes(), bonded("run 1\n", read="now")
    (number, _, *x), = [line.split() for line in (tmp_path / "p").read_text().splitlines()[9:10]]
    at = data.index(struct.pack("<3d", *map(float, x)))
    assert struct.unpack_from("<qq", data, at + 24) == (int(number), 1)
    said = outcome(lmp, tmp_path, text, data[:at + 32] + struct.pack("<q", 7) + data[at + 40:], expect_fail=True)
    assert f"Particle {number} is of type 7, but there are types 1 to 1: the restart file it is from is damaged" in said
    bond = next(k for k in range(at + 40, at + 400, 8) if 1 < struct.unpack_from("<q", data, k)[0] <= 12) + 8  # number of bonds after image, velocity, molecule
    assert struct.unpack_from("<q", data, bond)[0] == 1
    said = outcome(lmp, tmp_path, text, data[:bond] + struct.pack("<q", 5) + data[bond + 8:], expect_fail=True)
    assert f"A bond of particle {number} is of type 5, but there are types 1 to 1" in said


def test_what_lammps_cannot_know(lmp, tmp_path, lmp_stock):
    """a byte of a velocity that has changed is read as another number, with this package and without it: the limit that Howto_restart states"""
    text = ("units lj\nregion box block 0 4 0 4 0 4\nlattice sc 0.8\ncreate_box 1 box\ncreate_atoms 1 box\nmass 1 1\npair_style lj/cut 2.5\npair_coeff 1 1 1 1\n"
            "velocity all set 0.7182818 0 0 units box\nwrite_restart good\n")
    lmp(text, exe=lmp_stock)
    data = (tmp_path / "good").read_bytes()
    at = data.index(struct.pack("<d", 0.7182818))
    for exe in (lmp_stock, None):
        assert outcome(lmp, tmp_path, "read_restart now\nrun 0\n", flipped(data, at, 5), exe=exe) == ""


@pytest.mark.long
def test_any_bit(lmp, tmp_path, written):
    """of 150 bits anywhere: an error, or a byte of LAMMPS's own part"""
    _, data, text = written
    rng = random.Random(4711)
    mine = sections(data) + (records(data) if "hvi/fem" in text else [])
    for _ in range(150):
        at, bit = rng.randrange(len(data)), rng.randrange(8)
        (tmp_path / "now").write_bytes(flipped(data, at, bit))
        if any(begin <= at < end for begin, end in mine):
            assert lmp(text, expect_fail=True).error, (at, bit)
