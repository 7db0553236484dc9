"""Every mistake with elements ends with an error that says what is wrong: no crash, no hang, no silent wrong number."""

from concurrent.futures import ThreadPoolExecutor

import pytest
from fem_scenes import start, strike_plate

ROWS = "Elements\n\n"


@pytest.fixture
def good(lmp, tmp_path):
    mesh, strike_it = strike_plate(nx=4, ny=4)
    mesh.write(tmp_path / "plain.data", 2703.0)
    return start(mesh, data="mesh.data") + strike_it + "run 2\n"


@pytest.fixture
def attempt(lmp, tmp_path, good):
    """Runs all cases (what to replace in the input or in the data file, by what, what the error says) side by side"""
    mesh_file = (tmp_path / "mesh.data").read_text()

    def one(k, nranks, old, new, says):
        folder = tmp_path / f"{k}.{nranks}"
        folder.mkdir()
        text, data = good, mesh_file
        assert (text.count(old) == 1) != (data.count(old) == 1), old
        if text.count(old) == 1:
            text = text.replace(old, new)
        else:
            data = data.replace(old, new)
        (folder / "mesh.data").write_text(data)
        try:
            r = lmp(text, cwd=folder, nranks=nranks, expect_fail=True, timeout=120)
        except pytest.fail.Exception as failure:  # no error, or no end
            return f"{new!r}: {failure}"
        error = " ".join(r.error.split())
        if not 0 < r.returncode < 128 or "Signal" in r.stderr:
            return f"{new!r}: a crash: {r}"
        return None if says in error else f"{new!r}: says {error!r}, not {says!r}"

    def run(cases, nranks=1):
        with ThreadPoolExecutor(4) as pool:
            wrong = list(pool.map(lambda a: one(a[0], nranks, *a[1]), enumerate(cases)))
        assert not any(wrong), "\n".join(w for w in wrong if w)

    run.data = mesh_file
    return run


def test_the_scene_is_right_otherwise(lmp, good):
    assert lmp(good).thermo["Step"][-1] == 2


FIX = "fix wall all hvi/fem nodes 3 "


def words(new, says):
    return (FIX, f"fix wall all hvi/fem {new} ", says)


def test_keywords(attempt):
    number = [(key, top) for key, top in (("hourglass/viscous", 1), ("hourglass/stiffness", 1), ("courant", 1), ("strain", 100), ("jacobian", 1),
                                          ("edges", 1000), ("step", 1))]
    attempt([
        words("", "needs the types of its nodes: nodes TYPE"),
        words("nodes", "missing argument"),
        words("nodes 4", "out of bounds"),
        words("nodes 3 springs 2", "Unknown fix hvi/fem keyword: springs"),
        words("nodes 3 probe 1 2", "missing argument"),
        words("nodes 3 viscosity 1", "missing argument"),
        words("nodes 3 viscosity -1 0", "viscosity must not be negative: -1"),
        words("nodes 3 convert maybe", "maybe"),
        words("nodes 3 courant 0", "courant must be above 0"),
        words("nodes 3 hourglass/viscous 0.126", "hourglass/viscous times courant must be at most 0.1"),
        words("nodes 3 hourglass/viscous 0.06 courant 1 hourglass/viscous 0.101", "hourglass/viscous times courant must be at most 0.1"),
        *(words(f"nodes 3 {key} {1.001 * top + 0.1}", f"{key} must be from") for key, top in number),
        *(words(f"nodes 3 {key} nonsense", "nonsense") for key, _ in number[:2]),
    ])


def test_what_it_needs(attempt):
    run_line = "run 2\n"
    attempt([
        ("fix prop all property/atom rmass ghost yes\n", "", "property/atom rmass"),
        ("atom_modify map yes sort 0 0\n", "atom_modify sort 0 0\n", "atom_modify map yes"),
        ("fix prop all", FIX + "\nfix prop all", "before simulation box is defined"),
        (FIX, "group ball type 1\nfix wall ball hvi/fem nodes 3 ", "must be of group all, not ball"),
        ("fix solid all hvi/johnson-cook damage no spall none\n", "", "needs fix hvi/johnson-cook"),
        ("fix move all hvi/sph\n", "", "needs fix hvi/sph"),
        ("fix move all hvi/sph\nfix solid all hvi/johnson-cook damage no spall none\n" + FIX + "\n",
         "fix solid all hvi/johnson-cook damage no spall none\n" + FIX + "\nfix move all hvi/sph\n", "must come after fix hvi/sph"),
        (FIX + "\n", FIX + "\nfix more all hvi/fem nodes 3\n", "More than one fix hvi/fem"),
        ("fix move all hvi/sph\n", "group some empty\nfix move some hvi/sph\n", "is not in the group of fix hvi/sph"),
        ("pair_coeff 3 3 nodes\n", "pair_coeff 3 3 node\n", "node"),
        (run_line, "run_style respa 2 2\nrun 2\n", "respa"),
        (run_line, "minimize 1e-6 1e-6 10 10\n", "minimization"),
        (run_line, "group nodes type 3\ndelete_atoms group nodes\nrun 2\n", "not there"),
        (run_line, "run 1\ngroup one id 1\ndelete_atoms group one compress no\nrun 1\n", "node 1 of element 1 is not there"),
        (run_line, "run 1\ngroup one id 14\ndelete_atoms group one compress no\nrun 1\n", "not there"),
        (run_line, "run 1\ngroup one id 100\ndelete_atoms group one compress no\nrun 1\n", "particle 100 is not there"),
        (run_line, "run 1\ngroup one id 100\ndelete_atoms group one\nrun 1\n", "have IDs changed? Use delete_atoms with compress no"),
        (run_line, "run 1\ngroup one id 1\ndelete_atoms group one\nrun 1\n", "is not there"),
        (run_line, "run 1\ngroup one id 100\ngroup wall_embedded clear\ngroup wall_embedded union one\nrun 1\n", "was in another group"),
        (run_line, "run 1\ngroup some id 100\nreset_atoms id sort yes\nrun 1\n", "Fix hvi/fem"),
        (run_line, "run 1\ngroup one id 100\nset group one type 1\nrun 1\n", "has type 1"),
        (run_line, "run 1\ngroup one id 14\nset group one mass 1e-6\nrun 1\n", "node 14 has mass"),
        (run_line, "run 1\ngroup one id 100\nset group one mass 1e-6\nrun 1\n", "particle 100 has mass"),
        (run_line, "create_atoms 3 single 0 0 -0.0015 units box\nrun 1\n", "1 nodes belong to no element"),
    ])


def test_data_files(attempt):
    lines = attempt.data[attempt.data.index("Elements\n"):].split("\n")[2:]
    row = lines[0].split()

    def changed(**what):
        new = list(row)
        for k, v in what.items():
            new[int(k[1:])] = str(v)
        return " ".join(new)

    count = len([line for line in lines if line])
    flipped = [row[0], row[1], *row[6:10], *row[2:6], *row[10:]]
    attempt([
        (" fix wall elements Elements", "", "Unknown identifier in data file"),
        (f"{count} elements", "0 elements", "no elements in the header"),
        (f"{count} elements", f"{count + 1} elements", "Unexpected end of data file"),
        (lines[0], " ".join(row[:-1]), "another number of columns"),
        (lines[0], changed(c0=0), "IDs of elements must be positive"),
        (lines[0], changed(c0=2), "two elements have the ID 2"),
        (lines[0], changed(c2=0), "IDs of nodes and particles must be positive"),
        (lines[0], changed(c11=0), "IDs of nodes and particles must be positive"),
        (lines[0], changed(c2=100000), "have a first node that is not there"),
        (lines[0], changed(c1=4), "there is no such type"),
        (lines[0], changed(c1=3), "type 3"),
        (lines[0], changed(c1=1), "has type 2"),
        (lines[0], changed(c10=9), "n must be from 0 to 8"),
        (lines[0], changed(c10=-1), "n must be from 0 to 8"),
        (lines[0], changed(c5=100000), "node 100000 is not there"),
        (lines[0], changed(c5=100), "node 100 is not there"),
        (lines[0], changed(c11=1), "is not there"),
        (lines[0], changed(c11=lines[1].split()[11]), "is in two elements"),
        (lines[0], changed(c10=3), "is in two elements"),
        (lines[0], " ".join(flipped), "turned inside out"),
        (lines[0], changed(c3=row[2]), "turned inside out or has no volume"),
        (lines[0], "1 2 x" + " ".join(row[3:]), "wrong row of section Elements"),
    ])


def test_on_ranks(attempt):
    """the same errors on three ranks: none waits for others"""
    lines = attempt.data[attempt.data.index("Elements\n"):].split("\n")[2:]
    run_line = "run 2\n"
    attempt([
        (run_line, "run 1\ngroup one id 14\ndelete_atoms group one compress no\nrun 1\n", "not there"),
        (run_line, "run 1\ngroup one id 100\ndelete_atoms group one\nrun 1\n", "compress no"),
        (run_line, "run 1\ngroup one id 100\nset group one mass 1e-6\nrun 1\n", "particle 100 has mass"),
        (lines[0], lines[0].replace(" 2 ", " 4 ", 1), "there is no such type"),
    ], nranks=3)


def test_unfix(lmp, good):
    """nodes without the fix are particles without a material"""
    r = lmp(good + "thermo_style custom step\nunfix wall\nrun 1\n", expect_fail=True)
    assert "type 3 has no material" in r.error
