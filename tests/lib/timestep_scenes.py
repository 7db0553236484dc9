"""fix hvi/dt: what limits the step, what shows it, and a scene of particles of all kinds."""

from scenes import R_EQ

MAXIMUM, CONTACT, SPRING, APPROACH, GROWING, SIGNAL = range(6)
SHOW = "fix nve all nve\nthermo 1\nthermo_style custom step time dt f_step[*] f_step\nthermo_modify norm no format float %.16e\n"
C = 0.1


def three_pairs(sound=1.0, eps=1e-3, kappa=1e-3, more=""):
    """two SPH particles at rest, two in contact, two bonded: each would limit the step by itself"""
    text = "units lj\natom_style hybrid sph bond\natom_modify map array\nboundary f f f\nregion box block -9 9 -9 9 -9 9\n"
    text += "create_box 3 box bond/types 1 extra/bond/per/atom 2 extra/special/per/atom 4\nspecial_bonds lj/coul 1 1 1\n"
    for kind, y, r in ((1, -6, 1.0), (2, 0, 1.0), (3, 6, 1.3)):
        text += f"create_atoms {kind} single 0 {y} 0\ncreate_atoms {kind} single {r} {y} 0\n"
    text += "mass * 1.0\nset group all sph/rho 1.0\npair_style hybrid hvi/sph cubic hvi/contact\n"
    text += f"pair_coeff 1 1 hvi/sph eos tait 1.0 {sound} 7 h 1.2\npair_coeff 2* 2* hvi/contact {eps} 1.0\npair_coeff 1 2* none\n"
    text += f"bond_style hvi/spring\nbond_coeff 1 {kappa} {R_EQ!r} 1.5\nneighbor 0.3 bin\n"
    text += "create_bonds single/bond 1 5 6 special no\ngroup fluid type 1\nfix fluid fluid hvi/sph\n" + more
    return text + f"fix step all hvi/dt {C} max 1e3\n" + SHOW.replace("fix nve all nve\n", "group stiff subtract all fluid\nfix stiff stiff nve\n") + "run 0\n"
