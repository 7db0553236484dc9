"""Hard cases of impacts for hard.py (which finds them in hard_solids.py): in.plate and in.hybrid of examples/single-plate, coarse; elements; discrete elements.

Settings of these inputs are further words of pair hvi/sph, or dicts of variables; "stock STYLE" is hard_stock.py.
"""

import pathlib

import hvi
import numpy as np
import plate_scenes
import yaml
from fem_mechanics_scenes import collision
from hard_cases import BOOKS, Case
from hard_stock import stock
from hvi.jobs import engine
from hvi.model import bodies, mesh_plate
from lammps_runs import Stopped
from solid_runs import material
from tensile_scenes import nearest

ROOT = pathlib.Path(__file__).resolve().parents[2]
ALUMINUM = ROOT / "potentials" / "Al6061-T6.hvi"
DENSITY = 2703.0
WORDS = {"riemann": "dissipation riemann", "viscosity": "viscosity 1 2"}
ART = {"riemann artificial stress": "dissipation riemann artstress 0.3 4"}
SPEEDS = {"Al6061-T6": (2703, 5240), "Cu-OFHC": (8930, 3940), "tungsten": (19235, 4029)}  # density, speed of sound, SI
TUNGSTEN = ("eos gruneisen rho0 19235 C 4029 S1 1.237 g0 1.54 a 0 cp 134 T0 300",  # of its weight: what matters here is the contrast
            "strength johnson-cook G 160e9 A 1506e6 B 177e6 n 0.12 C 0.016 m 1 epsdot0 1 Tref 300 Tm 1723",
            "spall voids sigma 2e9 rate 1e5 m 0.2 phi_c 0.1")


def fit(v0, t, p="Al6061-T6", target="Al6061-T6"):
    """hole in diameters of the sphere, of thin plates: Dh/d = 2.8 (rho_p/rho_t)^-0.035 (V/c_t)^0.335 (V/c_p)^0.113 (t/d)^0.516 + 0.6"""
    (rp, cp), (rt, ct) = SPEEDS[p], SPEEDS[target]
    return 2.8 * (rp / rt) ** -0.035 * (v0 / ct) ** 0.335 * (v0 / cp) ** 0.113 * t**0.516 + 0.6


def single_plate(lmp, folder, setting, v0=7000, t=2.0, p="Al6061-T6", body=None, wall=None, end_on=False, **variables):
    """in.plate, a sphere of 10 mm; body, wall: what makes their files, of the spacing; a wall of elements makes it in.hybrid. A dict of result.yaml and of
    what the last frame says"""
    v = dict(dx=0.667, Rplate=30, tstop=16, D=10)
    v.update(variables)
    v.update(setting if isinstance(setting, dict) else {"pair": setting})
    v.update(v0=v0, t=t, out=folder, material_p=ALUMINUM, material_t=ALUMINUM)
    if p != "Al6061-T6":
        v["material_p"] = material(folder / "tungsten.hvi", *TUNGSTEN, units="si") if p == "tungsten" else ROOT / "potentials" / f"{p}.hvi"
    quarter = "angle" not in v
    ball = body and body(folder / "ball.data", 1e-3 * v["dx"], quarter)
    if wall:
        v["plate"] = wall(folder / "wall.data", v)
        v.pop("Rplate")
        lmp(plate_scenes.FOLDER / "in.hybrid", vars=v)
    else:
        lmp(plate_scenes.text(quarter, body=ball, angle=not quarter, end_on=end_on), vars=v)
    r = yaml.safe_load((folder / "result.yaml").read_text())
    frame = hvi.Dump(folder / "plate.dump", mirror=["none"])[-1]
    x = np.column_stack([frame["x"], frame["y"], frame["z"]])
    sound = (frame["spalled"] == 0) & (frame["damage"] < 1)
    near = nearest(x)
    if quarter:
        near = np.minimum(near, 2 * x[:, :2].min(1))  # images
    ball = frame["type"] == 1
    hole = r["hole_diameter_mm"] / v["D"]
    return dict(energy=abs(r["energy_ratio"] - 1), momentum=r["momentum_error"], mass=abs(r["mass_error"]), hole=hole,
                fit=hole / fit(v0, t / v["D"], p), front=r["axial_velocity_ratio"],
                pairs=(near[sound] < 0.5e-3 * v["dx"]).mean() if sound.any() else 0.0,
                sideways=abs(x[ball, 1].mean()) / (1e-3 * v["D"]))


BOOKED = {**BOOKS, "mass": 1e-12}
EVEN = {**BOOKED, "pairs": 0.01}
HOLE = {**EVEN, "hole": (1.0, np.inf), "fit": (0.7, 1.3)}
BODY = {**EVEN, "hole": (1.0, 1.3 * fit(7000, 0.2))}
OBLIQUE = {**EVEN, "sideways": 0.05}


def impact(criteria=HOLE, **how):
    """a scene of single_plate() that says what the criteria ask for"""
    def scene(lmp, folder, setting):
        if isinstance(setting, str) and setting.startswith("stock"):
            return stock(lmp, folder, "plate", setting, v0=how.get("v0", 7000))
        o = single_plate(lmp, folder, setting, **how)
        return {m: o[m] for m in criteria}

    return scene


# bodies


def ball(fill, inner=0.0, jitter=0.0):
    """makes the file of a sphere of 10 mm; jitter: places off those of the lattice, in spacings, at random"""
    def write(path, dx, quarter):
        body = bodies.make(bodies.sphere(5e-3, inner, quarter), dx, fill)
        body.x[:] += jitter * dx * np.random.default_rng(5).uniform(-1, 1, body.x.shape)
        bodies.write(path, body, DENSITY)
        return path

    return write


def elements(path, v):
    """a wall of elements that hold particles up to 16 mm, free particles within 4 mm: less than the hole"""
    dx = 1e-3 * v["dx"]
    m = mesh_plate.plate(1e-3 * v["t"], 2 * dx, side=2e-3 * v["Rplate"], n=2, core=4e-3, hold=16e-3, growth=1.2, largest=4e-3, quarter=True, type=2,
                         node_type=3)
    m.write(path, DENSITY)
    return path


# time step


def too_long(lmp, folder, setting):
    """fix hvi/dt with C 1.8, three times the default"""
    try:
        single_plate(lmp, folder, setting, C=1.8, dx=1, tstop=2)
    except Stopped as why:
        return dict(caught="factor C" in str(why))
    r = yaml.safe_load((folder / "result.yaml").read_text())
    return dict(caught=abs(r["energy_ratio"] - 1) > 1e-3 or abs(r["energy_missed_ratio"]) > 1e-3)


# elements


def crumpled(lmp, folder, convert):
    """blocks of elements meet at 7 km/s"""
    o = collision(lmp, folder, "blocks", 3500.0, 400, convert=convert)
    return dict(energy=o["drift"], momentum=o["momentum"], hourglass=o["hourglass"], step=o["over"])


# discrete elements


def debris(lmp, folder, lattice):
    """examples/debris-cloud, coarse, at 20 km/s"""
    engine.Input(ROOT / "examples" / "debris-cloud" / "in.debris").copy_to(folder)
    lmp(folder / "in.debris", vars=dict(v0=20000, N=4000, tstop=4, frames=1, lattice=lattice, out=folder))
    r = yaml.safe_load((folder / "result.yaml").read_text())
    return dict(energy=abs(r["energy_ratio"] - 1), momentum=r["momentum_error"], mass=abs(r["mass_error"]), fragmentation=r["fragmentation"])


def overlapping(lmp, folder, start):
    """particles of hvi/contact, energy, size and mass 1, that begin in each other and fly apart"""
    make = {"lattices": "create_atoms 1 region here\nlattice sc 1.13 origin 0.31 0.31 0.31\ncreate_atoms 1 region here",
            "random": "create_atoms 1 random 300 4711 here"}[start]
    r = lmp(f"""units lj
boundary s s s
atom_style atomic
lattice sc 1.13
region here block 0 8 0 8 0 8 units box
create_box 1 here
{make}
mass 1 1.0
pair_style hvi/contact
pair_coeff 1 1 1.0 1.0
fix move all nve
fix step all hvi/dt 0.05
neighbor 0.3 bin
neigh_modify every 1 delay 0 check yes
compute book all hvi/energy
compute v all reduce sum vx vy vz
variable p atom sqrt(vx*vx+vy*vy+vz*vz)
compute all_p all reduce sum v_p
thermo 50
thermo_style custom step time dt atoms c_book[9] c_book[10] c_book[11] c_book[12] c_all_p pe ke
thermo_modify format float %.17g norm no
run 3000
""")
    t = r.thermo
    return dict(energy=np.abs(t["c_book[9]"] - 1).max(), momentum=max(np.abs(t[f"c_book[{k}]"]).max() for k in (10, 11, 12)) / t["c_all_p"][-1],
                apart=t["PotEng"][-1] / t["PotEng"][0])


STOCK = {"stock tlsph": "stock tlsph", "stock ulsph": "stock ulsph"}
BOTH = {**WORDS, **ART}
RIEMANN = ("riemann",)

# causes, each tried

CLUMPS = {"pairs": "neighbors in fragments in tension clump: artificial stress leaves 0.5 % at most"}
STRETCHES = {"fit": "without a law of damage the plate stretches and does not plug: damage yes has 1.1"}
TIED = {"run": "elements that are tied never fail, and one is crushed: refused by an error that names it"}

CASES = [
    Case("impact-1", "a sphere on a plate of t/D 0.2, 1 km/s", impact(v0=1000, tstop=30),
         {**WORDS, "viscosity damage": {"pair": WORDS["viscosity"], "damage": "yes"}, **STOCK}, HOLE, (),
         {"viscosity": STRETCHES, "riemann": {**STRETCHES, **CLUMPS}}),
    Case("impact-3", "the same, 3 km/s", impact(v0=3000, tstop=20), BOTH, HOLE, (), {"riemann": CLUMPS}),
    Case("impact-7", "the same, 7 km/s", impact(), {**WORDS, **STOCK}, HOLE),
    Case("impact-12", "the same, 12 km/s", impact(v0=12000, tstop=14), WORDS, HOLE),
    Case("impact-20", "the same, 20 km/s", impact(v0=20000, tstop=14), WORDS, HOLE, (), {"riemann": CLUMPS}),
    Case("thin-0.02", "t/D 0.02: a plate of 1 layer, 7 km/s", impact(t=0.2, dx=0.2, Rplate=12, tstop=6), BOTH, HOLE, (),
         {"riemann": CLUMPS}),
    Case("thin-0.1", "t/D 0.1, 7 km/s", impact(t=1.0, dx=0.5, Rplate=25), BOTH, HOLE, (),
         {"riemann": CLUMPS, "viscosity": CLUMPS}),
    Case("thick-0.5", "t/D 0.5, 7 km/s", impact(t=5.0, dx=0.625), BOTH, HOLE, (), {"riemann": CLUMPS}),
    Case("thick-2", "t/D 2, 7 km/s", impact(EVEN, t=20.0, dx=1, Rplate=35, tstop=20), BOTH, EVEN, (),
         {"riemann": CLUMPS, "viscosity": CLUMPS}),
    *[Case(f"oblique-{a}", f"{a} degrees from the normal, 7 km/s", impact(OBLIQUE, angle=a, dx=1, Rplate=25, tstop=12), BOTH, OBLIQUE,
           (), {"riemann": CLUMPS, **({"viscosity": CLUMPS} if a == 75 else {})}) for a in (45, 75)],
    Case("hollow", "a hollow sphere, 7 km/s", impact(BODY, dx=0.5, Rplate=20, tstop=10, body=ball("glass", 3.5e-3)), BOTH, BODY, (),
         {"riemann": CLUMPS}),
    Case("end-on", "a cylinder end-on, 7 km/s", impact(BODY, end_on=True), WORDS, BODY),
    Case("copper", "copper on aluminum, 3 km/s", impact(p="Cu-OFHC", v0=3000, tstop=20), WORDS, HOLE),
    Case("tungsten", "tungsten on aluminum, 3 km/s", impact(p="tungsten", v0=3000, tstop=20), WORDS, HOLE),
    Case("glass", "a sphere like glass on a plate of a lattice, 7 km/s", impact(body=ball("glass")), WORDS, HOLE),
    Case("random", "a sphere whose particles are off the lattice, by up to a quarter of a spacing each way, 7 km/s", impact(body=ball("lattice", jitter=0.25)), WORDS, HOLE),
    Case("step-factor", "fix hvi/dt with three times the factor", too_long, WORDS, {"caught": (1, np.inf)}, RIEMANN),
    Case("elements", "elements within the hole, 7 km/s", impact(dx=0.5, Rplate=20, tstop=10, wall=elements),
         {"hybrid": {}, "hybrid artificial stress": {"pair": "dissipation riemann artstress 0.3 4"}, "tied": {"fem": "strain 0.3 convert no"}}, HOLE, (), {"hybrid": CLUMPS, "tied": TIED}),
    Case("crumple", "blocks of elements meet at 7 km/s", crumpled, {"hybrid": "yes", "tied": "no"}, {**BOOKS, "hourglass": 0.1, "step": 1.0},
         ("hybrid", "tied"), {"tied": TIED}),
    Case("debris", "bonded discrete elements at 20 km/s", debris, {"discrete sc": "sc", "discrete fcc": "fcc"},
         {**BOOKED, "fragmentation": (0.3, 1.0)}),
    Case("overlap", "discrete elements that begin in each other", overlapping, {"two lattices": "lattices", "random": "random"},
         {**BOOKS, "apart": 0.01}, ("two lattices", "random"))]
