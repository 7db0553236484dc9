"""fix hvi/sph: densities of the materials, before the first run"""

HEAD = """units si
region box block 0 1 0 1 0 1
create_box 3 box
"""
SPH = "atom_style sph\natom_modify map array\n"


def test_known_before_the_first_run(lmp, root):
    r = lmp(SPH + HEAD + """pair_style hvi/sph cubic
fix move all hvi/sph
print "none: $(f_move[1])"
pair_coeff 1 1 file Al6061-T6.hvi h 0.1
pair_coeff 2 2 eos idealgas 1.4 h 0.1
pair_coeff 3 3 eos tait 1000 1480 7 h 0.1
print "all: $(f_move[1]) $(f_move[2]) $(f_move[3])"
""", env={"LAMMPS_POTENTIALS": str(root / "potentials")})
    assert "none: 0\n" in r.log
    assert "all: 2703 0 1000\n" in r.log


def test_there_are_as_many_as_types(lmp):
    r = lmp(SPH + HEAD + """pair_style hvi/sph cubic
pair_coeff * * eos tait 1000 1480 7 h 0.1
fix move all hvi/sph
print "$(f_move[4])"
""", expect_fail=True)
    assert "out-of-range" in r.error
