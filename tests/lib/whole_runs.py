"""Small runs that together go through most of the package: discrete elements, liquid, solids, elements. For tests that watch a program from outside."""

from fem_scenes import STATE, start, strike_plate
from scenes import impact


def dem(root):
    """bonds that break, particles that leave, restart files"""
    return impact(n=500, rp=10.0, tstop=1.0, sort="sort 0 0") + """fix lists all balance 50 1.01 rcb
compute book all hvi/energy
compute whole all hvi/fragment bonds
compute cloud all hvi/cloud axis z plane 0.0
compute state all hvi/atom nbonds
thermo_style custom step c_book[*] c_whole[*] c_cloud[*]
thermo_modify norm no lost ignore
fix move all nve
fix step all hvi/dt 0.1
run 60
write_restart half
clear
read_restart half
fix move all nve
fix step all hvi/dt 0.1
compute book all hvi/energy
thermo_style custom step c_book[*]
run 20
"""


def solid(root):
    """examples/single-plate, a quarter: solids, mirror planes, riemann, holes, pieces, balance"""
    return (root / "examples/single-plate/in.plate").read_text()


def liquid(root):
    return (root / "examples/standard-shocks/in.sod").read_text()


def elements(root):
    """elements that fail and become particles; data and restart files"""
    mesh, fall = strike_plate()
    first = start(mesh, fem="strain 0.1", spall="voids") + fall
    return first + "run 30\n" + STATE.format("end.dump") + "write_restart half\nwrite_data end.data\n"


VARIABLES = {solid: dict(dx=1.25, D=10, v0=3000, t=1.25, Rplate=15, tstop=0.6, material_p="Al2017-T4.hvi", frame=1), liquid: dict(n=400, tstop=0.004)}
WHOLE_RUNS = (dem, liquid, solid, elements)
