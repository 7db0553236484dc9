# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""A case as a LAMMPS input, read from top to bottom: in.shield begins, in.continue differs from it in read_restart.

Both end a run by LAMMPS's fix halt: at the time `until`, or when the event is over, and write the restart file `to`.
"""

import functools
import itertools
import math
import pathlib
import re
import shutil

from ..jobs.engine import yaml_of
from ..material import library
from . import elements, geometry, projectile

BEGIN, CONTINUE, CASE = "in.shield", "in.continue", "case.yaml"
OFTEN, MOST = 20, 200  # steps between rows of walls.dat; most between rows of pieces.dat and history.dat, and between looks whether the event is over
LOOKS = 25  # rows of those in the time that is enough, about
FEW = 10  # particles of the whole shield, mirror images counted: fewer that are apart behind a wall without a hole say nothing of it
LATELY = 5  # of these rows: what has changed lately is the difference of the last one to their mean
BULGE = 30.0  # m/s: a bulge that grows by less has ended. A plate that rings at its yield stress Y moves at up to sqrt(3) Y/(rho c), 40 m/s for 6061-T6; 30 m/s do work for a strain of 0.4 %
STILL = 0.03  # of its momentum in a tenth of the time that is enough: a wall that changes by less is not pushed any more
LONGER = 3  # times the time that is enough for what fails: the end at the latest, for what neither fails nor comes to rest
# when an event is over: still to come, of what the last wall has been given, and of the impact, as the verdict has it; changes of its momentum and its bulge, a tenth
# less than the verdict spares, which knows times and not the last time step alone; plastic work of all walls per us, of the impact
OVER = {"share": 0.03, "coming": 1e-4, "push": 0.9 * STILL, "bulge": 0.9 * BULGE, "plastic": 1e-3}
COLUMNS = "id type mass x y z vx vy vz v_dumped c_state[*]"
STATE = ("p", "damage", "spalled", "vm", "e", "eps", "fragsize")
HANGS = 1.5  # spacings: what is closer hangs together
ETA = 1.2  # of pair_coeff ... spacing: smoothing length in spacings
FRICTION = 3 * 5300.0  # m/s: a wave keeps exp(-3) of its amplitude on the way through an absorbing rim and back


BALL = "ball.data"  # the projectile, if it is no lattice


def make(path, **words):
    """a data file of what is not on a lattice: words of Shield.files()"""
    (projectile if pathlib.Path(path).name == BALL else elements).write(path, **words)


def longest(case):
    """times tstop that a run takes at most"""
    return 1 if case.setting("tstop") else LONGER


def number(value):
    """as short as its digits allow"""
    return f"{value:.10g}"


def fraction(value):
    """what is above a whole number, below 1 as it is written, too"""
    return number(float(number(value - math.floor(value))) % 1)


def types(numbers):
    """a range of consecutive types, as LAMMPS writes it"""
    return f"{numbers[0]}" if len(numbers) == 1 else f"{numbers[0]}*{numbers[-1]}"


def alike(rows):
    """[([type, ...], what), ...] of neighboring types with the same what, rows: [(type, what), ...]"""
    found = []
    for kind, what in rows:
        if found and found[-1][1] == what and found[-1][0][-1] == kind - 1:
            found[-1][0].append(kind)
        else:
            found.append(([kind], what))
    return found


class Text:
    """lines of an input: command, arguments, comment"""

    def __init__(self):
        self.lines, self.last = [], None

    def __call__(self, command, arguments, comment=""):
        line = f"{command:<15} {arguments}"
        self.lines.append(f"{line:<80} # {comment}" if comment else line)

    def lattice(self, arguments, comment=""):
        """one that is not that of before"""
        if arguments != self.last:
            self("lattice", arguments, comment)
        self.last = arguments

    def say(self, comment):
        self.lines += ["", f"# {comment}"]


class Shield:
    """The inputs of one run of a case: spacing number `which` of the case, a shift of the projectile's lattice."""

    def __init__(self, case, which, shift, settings):
        self.case, self.which, self.shift, self.settings = case, which, shift, settings
        self.geometry = geometry.of(case, which)
        self.walls = self.geometry.walls
        self.n = len(self.walls)
        self.images = 4 if self.geometry.quarter else 1
        self.elements = [k for k, wall in enumerate(case.walls, 1) if wall.method != "sph"]
        self.own_masses = bool(self.elements) or settings["debris"] == "yes"  # of each particle: nodes, and pieces of particles, have less
        self.outers = [k for k, wall in enumerate(self.walls, 1) if wall.core]  # walls with an outer part of coarser particles
        self.seldom = OFTEN * max(1, min(MOST // OFTEN, round(self.steps() / LOOKS / OFTEN)))

    @functools.cached_property
    def rho(self):
        """kg/m^3 of the projectile and of the walls, from their material files"""
        return [library.density_of(library.of_case(name), si=True)[0] for name in (self.case.material, *(wall.material for wall in self.case.walls))]

    @property
    def energy(self):
        """J, of the projectile"""
        return 0.5 * self.mass() * (1e3 * self.case.speed_km_s) ** 2

    def mass(self):
        """kg, of the projectile"""
        return 1e-9 * self.rho[0] * self.case.projectile.volume_mm3

    @property
    def matter(self):
        """types that are no nodes"""
        return " ".join([f"1:{1 + self.n}", *(str(self.outer_type(k)) for k in self.outers)])

    def in_projectile(self):
        """particles of the whole projectile, about"""
        return self.case.projectile.volume_mm3 / (1e3 * self.geometry.a) ** 3

    def steps(self):
        """about, until the end at the latest: a wave or the projectile crosses a spacing in 1.5 steps; later steps are longer"""
        g = self.geometry
        return 1e-6 * g.tstop_us * (5300 + 1e3 * self.case.speed_km_s) / min([g.a, *(wall.spacing for wall in g.walls)])

    @functools.cached_property
    def of_walls(self):
        """[(free particles, embedded particles, nodes), ...] of the model, about"""
        return [elements.size(self.case, k, self.which) if k in self.elements else (wall.particles / self.images, 0.0, 0.0)
                for k, wall in enumerate(self.walls, 1)]

    def embedded(self):
        """about, of the model"""
        return sum(held for _, held, _ in self.of_walls)

    def nodes(self):
        """about, of the model"""
        return sum(nodes for *_, nodes in self.of_walls)

    def particles(self):
        """about, of the model, embedded ones, too, which may become free; no nodes"""
        return self.in_projectile() / self.images + sum(free + held for free, held, _ in self.of_walls)

    def outer_type(self, k):
        """of the particles in the outer part of wall k; None: it has none"""
        return 2 + self.n + (self.n if self.elements else 0) + self.outers.index(k) if k in self.outers else None

    def hold(self, k):
        """m from its middle: debris meets elements of wall k up to there, since those beyond hold no particles; None where there are none of these"""
        return elements.of_wall(self.case, k, self.which).get("hold") if k in self.elements else None

    def files(self):
        """{file: words of make()} of what is not on a lattice"""
        found = elements.of_case(self.case, self.which)
        body = self.case.projectile
        if body.in_data:
            found[BALL] = {**body.plain(self.case.file(self.which) if body.files else None), "spacing": self.geometry.a, "shift": self.shift, "density": self.rho[0], "quarter": self.geometry.quarter}
        return found

    # ------------------------------------------------------------------ parts of the input
    def head(self, text, new):
        case, walls = self.case, self.case.walls
        name = re.sub(r"[^\w.+ -]", "-", case.name, flags=re.A)
        text.lines += [f"# {name}: a {case.projectile} at {case.speed_km_s:g} km/s on {len(walls)} wall{'s' * (len(walls) > 1)}, "
                       f"{1e3 * self.geometry.a:g} mm between particles; written by python3 -m hvi shield",
                       f"#   mpirun -np 2 lmp -in {BEGIN if new else CONTINUE}    then: python3 -m hvi judge .", ""]
        text("variable", f"until index {number(self.latest_us)}", "us: end of the run, if the event is not over before")
        if not new:
            text("variable", "from index shield.restart", "to go on from")
        text("variable", f"to index shield.restart{'' if new else '.next'}", "written at the end")
        text("hvi/variables", f"known until{'' if new else ' from'} to", "any other -var is an error")
        text.lines.append("")

    def begin(self, text):
        """box, particles, materials, velocity"""
        g, s, n = self.geometry, self.settings, self.n
        text("units", "si")
        text("atom_style", "sph")
        text("atom_modify", "map array sort 1000 0.0")
        text("boundary", "f f fs", "what flies on behind the last wall stays in the box")
        text("processors", "* * 1", "ranks share the walls, not the flight")
        text.say("bodies on lattices; a quarter of them lies at x > 0, y > 0")
        box = g.box
        low = [0.0, 0.0] if g.quarter else [box[0], box[2]]
        text("region", f"box block {number(low[0])} {number(box[1])} {number(low[1])} {number(box[3])} {number(box[4])} {number(g.walls[-1].rear + g.a)} units box")
        kinds = 1 + n + (n if self.elements else 0) + len(self.outers)
        text("create_box", f"{kinds} box", "types: projectile, walls" + (", nodes of walls" if self.elements else "") + (", outer parts of walls" if self.outers else ""))
        body = self.case.projectile.in_data
        if not body:
            self.projectile(text)
        for k, (wall, of) in enumerate(zip(g.walls, self.case.walls), 1):
            if of.method == "sph":
                self.wall(text, k, wall)
        if body:  # read_data shrinks the box to what is in it, so walls come before
            self.projectile(text)
        if g.quarter:
            text("change_box", f"all x final {number(-g.a)} {number(box[1])} y final {number(-g.a)} {number(box[3])} units box", "no face on a mirror plane: nodes of elements may be there")
        text.say("what moves how")
        text("group", "ball type 1")
        if self.elements:
            text("group", f"matter type {self.matter}", "without nodes")
        if self.own_masses:
            text("fix", "masses all property/atom rmass ghost yes", f"{'nodes' if self.elements else 'pieces of particles'} have masses of their own")
        mirrors = " mirror x 0 lo mirror y 0 lo" if g.quarter else ""
        text("pair_style", f"hvi/sph {s['kernel']} {s['pair']}{mirrors}")
        rows = [(1, f"{pathlib.Path(self.case.material).name} {self.lengths(g.a, g.a)}")]
        rows += [(1 + k, f"{pathlib.Path(of.material).name} {self.lengths(wall.spacing, wall.dz)}") for k, (wall, of) in enumerate(zip(g.walls, self.case.walls), 1)]
        rows += [(self.outer_type(k), f"{pathlib.Path(self.case.walls[k - 1].material).name} {self.lengths(g.walls[k - 1].outer.spacing, g.walls[k - 1].outer.dz)}") for k in self.outers]
        for (kinds, what), comment in itertools.zip_longest(alike(rows), ["smoothing length, masses, densities follow from spacings"]):
            text("pair_coeff", f"{types(kinds)} {types(kinds)} file {what}", comment or "")
        if self.elements:
            text("pair_coeff", f"{n + 2}*{2 * n + 1} {n + 2}*{2 * n + 1} nodes")
        for k in self.outers:
            text("pair_coeff", f"{1 + k} {self.outer_type(k)} tension yes", "the two parts of a wall are one body")
        self.masses(text)
        v, angle = 1e3 * self.case.speed_km_s, math.radians(self.case.angle_deg)
        text("velocity", f"ball set {number(round(v * math.sin(angle), 6))} 0 {number(round(v * math.cos(angle), 6))} units box")
        text.lines.append("")

    def lengths(self, spacing, high):
        """words of pair_coeff; particles of a cell that is no cube have a volume of their own"""
        longest, eta = max(spacing, high), float(self.settings["eta"])
        return (f"spacing {number(longest)}" + ("" if eta == ETA else f" h {number(eta * longest)}")
                + ("" if abs(high / spacing - 1) < 1e-9 else f" volume {number(spacing**2 * high)}"))

    def projectile(self, text):
        """a cubic lattice about its center, or a file"""
        g = self.geometry
        if self.case.projectile.in_data:
            text("read_data", f"{BALL} add append shift 0 0 {number(-g.R)}")
            return
        origin = 0.5 + self.shift - g.R / g.a
        text.lattice(f"sc {number(g.a)} origin 0.5 0.5 {fraction(origin)}")
        for line in self.case.projectile.regions(number):
            text(*line)
        text("create_atoms", "1 region ball")

    def wall(self, text, k, wall):
        """layers of squares between its faces; if it has a core, these in a square of its middle, and cells of twice the size around it, face to face"""
        disc = f"cylinder z {number(wall.middle)} 0 {number(wall.radius)} {number(wall.front)} {number(wall.rear)} units box"
        if not wall.core:
            self.cells(text, wall)
            text("region", f"wall{k} {disc}")
            text("create_atoms", f"{1 + k} region wall{k}")
            return
        square = (f"block {number(wall.core_lo)} {number(wall.core_hi)} {number(-wall.core)} {number(wall.core)} "
                  f"{number(wall.front)} {number(wall.rear)} units box")
        self.cells(text, wall)
        text("region", f"wall{k} {square}")
        text("create_atoms", f"{1 + k} region wall{k}")
        self.cells(text, wall.outer)
        text("region", f"disc{k} {disc}")
        text("region", f"around{k} {square} side out")
        text("region", f"outer{k} intersect 2 disc{k} around{k}")
        text("create_atoms", f"{self.outer_type(k)} region outer{k}")

    def cells(self, text, wall):
        """the lattice of a wall"""
        text.lattice(f"custom {number(wall.spacing)} a1 1 0 0 a2 0 1 0 a3 0 0 {number(wall.dz / wall.spacing)} basis 0.5 0.5 0.5 origin 0 0 {fraction(wall.front / wall.dz)}", "layers between faces")

    def masses(self, text):
        """the particles of the projectile share its mass; those of walls have that of their cells from pair_coeff, unless each has its own beside elements"""
        share = f"$({number(self.mass())}/{self.images}/count(ball))" if self.images > 1 else f"$({number(self.mass())}/count(ball))"
        if not self.own_masses:
            text("mass", f"1 {share}", "the mass of the projectile over its particles")
            return
        text("set", f"type 1 mass {share}", "the mass of the projectile over its particles")
        rows = [(1 + k, number(self.rho[k] * wall.spacing**2 * wall.dz)) for k, wall in enumerate(self.walls, 1) if k not in self.elements]
        rows += [(self.outer_type(k), number(self.rho[k] * self.walls[k - 1].outer.spacing**2 * self.walls[k - 1].outer.dz)) for k in self.outers]
        for kinds, mass in alike(rows):
            text("set", f"type {types(kinds)} mass {mass}")
        text("mass", f"* {number(self.mass())}", "of no use: each particle has its own")
        for kinds, rho in alike([(1 + k, rho) for k, rho in enumerate(self.rho)] + [(self.outer_type(k), self.rho[k]) for k in self.outers]):
            text("set", f"type {types(kinds)} sph/rho {number(rho)}")

    def model(self, text, new):
        """fixes that move and load"""
        g, s = self.geometry, self.settings
        text("fix", "move all hvi/sph")
        text("fix", f"solid all hvi/johnson-cook {s['solid']}")
        if self.elements:
            text("fix", f"fem all hvi/fem nodes {self.n + 2}*{2 * self.n + 1} {s['fem']}{' convert no' if self.case.method() == 'tied' else ''}")
            if new:
                for k in self.elements:
                    wall = g.walls[k - 1]
                    text("read_data", f"{elements.file_of(k)} add append fix fem elements Elements shift {number(wall.middle)} 0 {number(wall.front)}")
                rows = [(1 + k, number(self.rho[k])) for k in self.elements]
                for kinds, rho in alike(rows):
                    text("set", f"type {types(kinds)} sph/rho {rho}")
                text("group", f"matter type {self.matter}")
        text("fix", f"step all hvi/dt {s['C']}", "time step; f_step[2] is the time")
        if s["skin"]:
            skin = float(s["skin"]) * g.widest
            text("neighbor", f"{number(1.000001e-3 if abs(skin - 1e-3) < 1e-9 else skin)} bin", "1 mm itself is LAMMPS's default" if abs(skin - 1e-3) < 1e-9 else "")
        text("compute", "cost all hvi/atom cost", "matter at rest costs little")
        text("variable", "cost atom c_cost")
        text("fix", "share all balance 50 1.05 shift xy 20 1.02 weight var cost")
        kind, rim = self.settings["edge"], 1e-3 * float(self.settings["rim"])
        if new and kind != "free":
            self.rim(text, rim)
        if s["debris"] == "yes":
            self.debris(text)
        text("compute", f"book all hvi/energy{' clamps rim' if kind != 'free' else ''}", "energy and momentum balance")
        if kind == "clamp":
            text("fix", "rim rim setforce 0 0 0")
        elif kind == "absorb":
            text("variable", f"rate equal {number(FRICTION / rim)}", "absorbs waves, the same in particles and nodes of any mass")
            for x in "xyz":
                text("variable", f"drag{x} atom -v_rate*mass*v{x}")
            text("fix", "rim rim addforce v_dragx v_dragy v_dragz")

    def debris(self, text):
        """what flies becomes as many particles as fragments; rims, which do not, stay as they are"""
        flies = [1, *(1 + k for k in range(1, self.n)), *(self.outer_type(k) for k in self.outers if k < self.n)]
        text("group", f"flies type {' '.join(map(str, flies))}")
        if self.settings["edge"] != "free":
            text("group", "loose subtract flies rim")
        text("fix", f"debris {'flies' if self.settings['edge'] == 'free' else 'loose'} hvi/debris", "what fails into fragments smaller than particles flies on as these")

    def rim(self, text, rim):
        """the group of what is no farther than that from the edge of a wall, of elements a square"""
        for k, wall in enumerate(self.walls, 1):
            if k in self.elements:
                half = 0.5 * elements.of_wall(self.case, k, self.which)["side"] - rim
                inner = f"block {number(wall.middle - half)} {number(wall.middle + half)} {number(-half)} {number(half)}"
            else:
                inner = f"cylinder z {number(wall.middle)} 0 {number(wall.radius - rim)}"
            text("region", f"rim{k} {inner} {number(wall.front - wall.thickness)} {number(wall.rear + wall.thickness)} side out units box")
            text("group", f"beyond region rim{k}")
            text("group", f"wall type {1 + k}" + (f" {1 + self.n + k}" if k in self.elements else "") + (f" {self.outer_type(k)}" if k in self.outers else ""))
            text("group", f"rim{k} intersect beyond wall")
            text("group", "beyond delete")
            text("group", "wall delete")
        text("group", "rim union " + " ".join(f"rim{k}" for k in range(1, self.n + 1)))

    def measures(self, text):
        """what is written while it runs; when it ends"""
        g = self.geometry
        rows = []
        for k, wall in enumerate(g.walls, 1):
            nodes = f" nodes {1 + self.n + k}" if k in self.elements else f" outer {self.outer_type(k)}" if k in self.outers else ""
            rows.append(f"wall {1 + k} {number(wall.front)} {number(wall.thickness)}{nodes} layers {wall.layers} radius {number(self.hold(k) or wall.radius)}"
                        + (f" center {number(wall.middle)} 0 struck {number(wall.struck)} 0" if self.case.angle_deg else ""))
        text.say("what happens to the walls: a row of walls.dat and pieces.dat for each")
        text("compute", " &\n                ".join(["walls all hvi/wall axis z", *rows]))
        text("compute", f"pieces all hvi/wall like walls pieces {number(HANGS / float(self.settings['eta']))} h", "what hangs together: smoothing lengths")
        text("compute", f"state all hvi/atom {' '.join(STATE)}")
        text("variable", "us equal 1e6*f_step[2]")
        text("fix", f"walls all ave/time {OFTEN} 1 {OFTEN} c_walls[*] mode vector append walls.dat format \" %.10g\"")
        text("fix", f"pieces all ave/time {self.seldom} 1 {self.seldom} c_pieces[*] mode vector append pieces.dat format \" %.10g\"")
        names = "v_us f_step[2] c_book[*]" + (" f_fem f_fem[*]" if self.elements else "")
        text("fix", f"history all ave/time {self.seldom} 1 {self.seldom} {names} append history.dat format \" %.13g\"")
        self.over(text)
        matter = "matter" if self.elements else "all"
        text("variable", "dumped atom time", "dumps say when, and where mirror planes are")
        mirrors = " v_plane v_plane" if g.quarter else " v_plane"
        text("variable", "plane atom 0")
        modify = ("sort id format 10 %.9g colname v_dumped time_si " + " ".join(f"colname c_state[{k}] {name}" for k, name in enumerate(STATE, 1))
                  + (" colname -2 mirror_x_lo colname -1 mirror_y_lo" if g.quarter else " colname v_plane mirror_none"))
        text("variable", f"columns string '{COLUMNS}{mirrors}'")
        text("variable", f"names string '{modify}'")
        film = self.settings["film"]  # us between frames
        if film:
            text("dump", f"film {matter} custom {10**9} film.*.dump ${{columns}}")
            skip = ""
            if self.case.setting("film") == 0:  # as many as have room on the disk
                text("variable", f"late equal v_us>{number(self.geometry.tstop_us)}", "no frames after the time that is enough but the last, of the end")
                skip = " skip v_late"
            text("dump_modify", f"film every/time {number(1e-6 * film)} first yes pad 9{skip} ${{names}}")
        text("thermo", f"{self.seldom}")
        text("thermo_style", f"custom step v_us dt atoms f_move c_walls[{self.n}][2] c_walls[{self.n}][4] c_book[9]")
        text("thermo_modify", "lost ignore", "what is thrown back leaves the box; the ledger counts it")
        text("run", f"{10**9}")
        text("unfix", "over")
        text("write_dump", f"{matter} custom shield.dump ${{columns}} modify ${{names}}")
        text("run", "0 post no", "the ledger counts what write_restart would lose")
        text("write_restart", "${to}")

    def over(self, text):
        """The last wall has failed, and there was time for its hole to open; or nothing strikes a wall any more, pushes it, makes it flow or bulge; or it is late."""
        g, n = self.geometry, self.n
        limit, tstop, last = self.energy / self.images, number(g.tstop_us), f"f_pieces[{n}]"
        power = "+".join(f"c_walls[{k}][6]" for k in range(1, n + 1))
        span = f"{(LATELY - 1) * self.seldom // 2}*dt"  # s, to the middle of the rows of lately
        text("fix", f"lately all ave/time {self.seldom} 1 {self.seldom} f_pieces[33] f_pieces[4] mode vector ave window {LATELY}", "bulge, momentum")
        text("variable", f'quiet equal "v_us > {number(g.arrival_us + g.passage_us + g.crossing_us)} && c_walls[{n}][2] < {number(OVER["share"])}*c_walls[{n}][5]+{number(OVER["coming"] * limit)} && '
             f'1e-6*({power}) < {number(OVER["plastic"] * limit)} && elapsed >= {(LATELY - 1) * self.seldom} && '
             f'abs({last}[4]-f_lately[{n}][2]) < {number(OVER["push"] / (1e-7 * g.enough_us))}*{span}*abs({last}[4])+1e-12 && '
             f'abs({last}[33]-f_lately[{n}][1]-{span}*{last}[4]/{last}[16]) < {number(OVER["bulge"])}*{span}"',
             "nothing comes, pushes, flows or bulges: Howto_front, When it ends")
        text("variable", f'over equal "v_us >= v_until || v_us >= {tstop} && ({last}[32] >= {self.few} || {last}[32] > 0 && {last}[36] > 0) || v_quiet && (v_us >= {tstop} || {last}[32] == 0 && {last}[36] == 0)"',
             "columns 32, 36: particles apart, hole")
        text("fix", f"over all halt {self.seldom} v_over > 0 error continue message no")

    @property
    def few(self):
        """particles of the model: fewer that are apart say nothing, unless there is a hole"""
        return -(-FEW // self.images)

    @property
    def latest_us(self):
        """end of the run, whatever happens: what the case says, or longer than what is usually enough"""
        return self.geometry.tstop_us * longest(self.case)

    def text(self, new=True):
        text = Text()
        self.head(text, new)
        if new:
            self.begin(text)
        else:
            text("processors", "* * 1")
            text("read_restart", "${from}")
            if self.own_masses:
                text("fix", "masses all property/atom rmass ghost yes")
            text.lines.append("")
        self.model(text, new)
        self.measures(text)
        return "\n".join(text.lines) + "\n"

    def write(self, folder):
        """the inputs and their data files"""
        folder = pathlib.Path(folder)
        folder.mkdir(parents=True, exist_ok=True)
        self.copy_to(folder)
        for name, words in self.files().items():
            make(folder / name, **words)

    def copy_to(self, folder):
        """what the data files are made of, and the inputs"""
        for name, text in self.texts().items():
            (folder / name).write_text(text)
        if self.case.projectile.files:
            shutil.copy(self.case.file(self.which), folder)

    def texts(self):
        """{file: text}: the inputs, the material files, so that LAMMPS alone can run the folder, and the case of this run, for judge"""
        names = dict.fromkeys((self.case.material, *(wall.material for wall in self.case.walls)))
        return {BEGIN: self.text(), CONTINUE: self.text(new=False), **{pathlib.Path(name).name: library.text_of(name) for name in names},
                CASE: yaml_of(self.case.one(self.which, self.shift).mapping())}
