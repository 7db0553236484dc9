"""Elements that become particles, and probes: nothing is lost, and a probe stays with its element."""

import numpy as np
import pytest
from fem_scenes import ALUMINUM
from hvi.model.mesh import block
from hvi.model.mesh_plate import plate

START = """
units         si
atom_style    sph
atom_modify   map yes
boundary      s s s
fix           prop all property/atom rmass ghost yes
lattice       sc 2.5e-4 origin 0.5 0.5 0.5
region        box block 0 23e-3 0 23e-3 -8e-3 8e-3 units box
create_box    3 box
pair_style    hvi/sph cubic {pair}
pair_coeff    1*2 1*2 file Al6061-T6.hvi h 3e-4
pair_coeff    3 3 nodes
mass          * $(2703*2.5e-4^3)
fix           move all hvi/sph
fix           solid all hvi/johnson-cook spall voids
fix           wall all hvi/fem nodes 3 {fem}
""".replace("Al6061-T6.hvi", str(ALUMINUM))

IMPACT = START.format(pair="mirror x 0 lo mirror y 0 lo dissipation riemann", fem="") + """
region        ball sphere 0 0 -1.5001e-3 1.5e-3 units box
region        quarter block 0 INF 0 INF INF INF
region        here intersect 2 ball quarter
create_atoms  1 region here
set           group all sph/rho 2703
group         ball type 1
read_data     wall.data add append fix wall elements Elements
velocity      ball set 0 0 5000 units box
fix           step all hvi/dt 0.6
compute       book all hvi/energy
variable      pz equal c_book[12]-c_book[26]
neighbor      1.8e-4 bin
thermo        5
thermo_style  custom step dt f_wall f_wall[11] c_book[9] v_pz c_book[26]
thermo_modify format float %.15g
run           150
"""


@pytest.mark.parametrize("n, nranks", [(2, 1), (4, 1), (2, 3)])
def test_books_are_kept(lmp, n, nranks):
    """with 4^3 particles elements beside those that fail were out of reach of what is free until then; one of three ranks has
    particles of elements, but no elements"""
    plate(1e-3, n * 0.25e-3, side=20e-3, core=2.5e-3, hold=6e-3, n=n, quarter=True, type=2, node_type=3).write("wall.data", 2703.0)
    balance = "comm_style tiled\nfix balance all balance 20 1.05 rcb\n" if nranks > 1 else ""
    thermo = lmp(IMPACT.replace("run  ", balance + "run  "), nranks=nranks).thermo
    assert thermo["f_wall"][-1] <= thermo["f_wall"][0] - n**2 / 3
    assert np.abs(thermo["v_pz"] / thermo["c_book[26]"]).max() < 1e-12
    assert abs(thermo["c_book[9]"][-1] - 1) < 2e-6
    assert np.all(thermo["f_wall[11]"] < 1.1 * thermo["f_wall[11]"][0])  # of all elements, not of new ones only


BARS = START.format(pair="", fem="probe 1.5e-3 0.25e-3 0.25e-3 probe 1.5e-3 5.25e-3 0.25e-3") + """
read_data     bar.data add append fix wall elements Elements
read_data     bar.data add append shift 0 5e-3 0 fix wall elements Elements
variable      vx atom 1e6*x*(1+(y>2e-3))
velocity      all set v_vx 0 0
timestep      1e-9
thermo_style  custom step f_wall f_wall[1][9] f_wall[2][9]
thermo_modify format float %.15g
"""


def test_probes_of_two_walls(lmp):
    """one data file after the other: no element has the ID of another; 1e6 x at 1.25 or 1.75 mm, twice that in the second"""
    block(8, 1, 1, 0.5e-3, n=0, type=2, node_type=3).write("bar.data", 2703.0)
    thermo = lmp(BARS + "run 0").thermo
    assert thermo["f_wall"][0] == 16
    assert thermo["f_wall[2][9]"][0] / thermo["f_wall[1][9]"][0] == pytest.approx(2, rel=1e-12)


def test_probes_in_the_middle_of_a_step(lmp):
    """fix balance asks for them when particles are about to go to other ranks, one of which has no elements: they are those that were known last"""
    block(8, 1, 1, 0.5e-3, n=0, type=2, node_type=3).write("bar.data", 2703.0)
    ask = "variable v equal f_wall[1][9]\nvariable w atom 1+0*v_v\ncomm_style tiled\nfix even all balance 1 1.0 rcb weight var w\ntimestep"
    text = BARS.replace("boundary      s s s", "boundary      f f f\nprocessors    2 1 1").replace("thermo_style  custom step", "thermo_style  custom step v_v").replace("timestep", ask)
    thermo = lmp(text + "run 3\nrun 3", nranks=2, timeout=60).thermo
    assert thermo["v_v"][-1] == pytest.approx(thermo["f_wall[1][9]"][-1], rel=1e-12) and thermo["Step"][-1] == 6


def test_probes_stay_over_a_restart(lmp):
    """where elements have moved by more than their length"""
    block(8, 1, 1, 0.5e-3, n=0, type=2, node_type=3).write("bar.data", 2703.0)
    columns = ("f_wall[1][9]", "f_wall[2][9]")
    end = lmp(BARS.replace("1e6*x*(1+(y>2e-3))", "1e5+1e5*x*(1+(y>2e-3))").replace("1e-9", "1e-8") + "run 1\nwrite_restart bar.restart\nvariable n equal count(all)\nrun 1\n").thermo
    again = lmp("""
    atom_modify   map yes
    read_restart  bar.restart
    fix           prop all property/atom rmass ghost yes
    fix           move all hvi/sph
    fix           solid all hvi/johnson-cook spall voids
    fix           wall all hvi/fem nodes 3 probe 1.5e-3 0.25e-3 0.25e-3 probe 1.5e-3 5.25e-3 0.25e-3
    thermo_style  custom step f_wall f_wall[1][9] f_wall[2][9]
    thermo_modify format float %.15g
    run           1
    """).thermo
    for c in columns:
        assert list(again[c]) == list(end[c])
