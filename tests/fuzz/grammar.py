"""Random LAMMPS inputs out of the keywords of our styles, in random order, with values that are right as a rule.

    python3 tests/fuzz/grammar.py SEED [FOLDER]    writes one: in.fuzz, and the files that it reads

RULES has a rule for every keyword that the page of a style names under Syntax; tests/style/test_fuzz_inputs.py holds the two to each other.
"""

import pathlib
import random
import re
import sys

import mutate
import seeds
from seeds import ROOT

sys.path[1:1] = [str(ROOT / "tests"), str(ROOT / "tests" / "lib")]
import fem_scenes  # noqa: E402

PAGES = ROOT / "doc" / "src"
STEPS = 20
ODD = ["0", "-1", "1e-300", "1e30", "1e308", "nan", "inf", "-0", "2147483648", "1.5", "yes", "NULL", "all", "abc", "v_x", "*", "1*", "2*1", "", "'", "lo", "1e-3 1e-3"]


def keywords(page):
    """of the Syntax of a page: the words of its lines '* keyword = ...' and '* one or more NAMEs = ...', and those that have a value below"""
    text = (PAGES / f"{page}.rst").read_text()
    syntax = text[text.index("\nSyntax\n"):text.index("\nExamples\n")]
    lines = re.findall(r"^\* (?:keyword(?: after a material)?|one or more NAMEs) = ((?:.+\n?)(?:  \S.*\n)*)", syntax, re.M)
    return {word for line in lines for word in re.findall(r"\*([^*\s]+)\*", line)} | set(re.findall(r"^ +\*([\w/]+)\* values? = ", syntax, re.M))


def pick(*words):
    return lambda rng: rng.choice(words)


def between(low, high):
    return lambda rng: f"{rng.uniform(low, high):.4g}"


def each(*rules):
    return lambda rng: " ".join(rule(rng) for rule in rules)


YES = pick("yes", "no")
KERNELS = "lucy quadratic cubic quartic quintic gauss wendland2 wendland4".split()
SPALL = pick("none", "pressure", "principal", "zero", "voids", "tuler-butcher", "grady")
GROUP = pick("all", "one", "two", "none", "moving")
LISTS = pick("relative", "displacement")

# {page: {keyword: rule of what stands behind it}}; lengths in spacings, times in steps of about a tenth of a spacing over the speed of sound
RULES = {
    "pair_hvi_sph": {
        "dim": pick("1", "2", "3"), "form": pick("sum", "symmetric"), "viscosity": each(between(0, 2), between(0, 3)), "interface": pick("0", "0.3", "auto"),
        "dissipation": pick("monaghan", "riemann"), "artstress": each(pick("0", "0.3"), pick("0.5", "4", "2.55")), "h": pick("constant", "variable", "variable 0.7 1.1"),
        "mirror": each(pick("x", "y", "z"), pick("0", "-1", "9"), pick("lo", "hi")), "energy": YES, "stock": YES,
        "spacing": pick("1"), "volume": pick("1", "0.5"), "strength": pick("none"), "tension": YES},
    "pair_hvi_contact": {"prefactor": pick("1", "4"), "lists": LISTS},
    "fix_hvi_sph": {"walls": GROUP, "sleep": pick("exact", "no", "1e-8", "1e-4"), "lists": LISTS, "bad": pick("error", "freeze 5", "delete 5", "delete 1000")},
    "fix_hvi_johnson_cook": {
        "strength": pick("johnson-cook", "steinberg-guinan", "cowper-symonds", "zerilli-armstrong", "perfect", "none"), "damage": pick("yes", "no", "johnson-cook"),
        "spall": SPALL, "temperature": pick("energy", "work"), "thermal": YES, "melt": YES, "weibull": each(between(0.5, 20), pick("1", "4711")), "weibull_size": pick("0", "1")},
    "fix_hvi_balance": {"axis": pick("x", "y", "z")},
    "fix_hvi_debris": {"every": pick("1", "5", "20"), "most": pick("2", "3")},
    "fix_hvi_dt": {"min": pick("0", "1e-12"), "max": pick("0.1", "1e-6"), "floor": pick("0", "0.1"), "every": pick("1", "2", "7")},
    "fix_hvi_fem": {
        "probe": each(between(-2, 2), between(-2, 2), between(-1, 1)), "local": pick("1", "5"), "viscosity": each(between(0, 2), between(0, 1)),
        "hourglass/viscous": pick("0", "0.05"), "hourglass/stiffness": pick("0", "0.1"), "courant": pick("0.5", "0.9"), "convert": YES, "damage": YES, "spall": YES,
        "strain": pick("0", "0.05", "0.5"), "jacobian": pick("0.1", "0.5"), "edges": pick("2", "10"), "step": pick("0.1", "0.9")},
    "compute_hvi_atom": dict.fromkeys("p e T c h eps epsdot damage initiation spalled voids void_damage fragsize vm sxx syy szz sxy sxz syz asleep cost body nbonds".split(), pick("")),
    "compute_hvi_cloud": {"quantile": pick("0.6", "0.95", "1")},
    "compute_hvi_energy": {"clamps": GROUP},
    "compute_hvi_fragment": {"region": pick("half")},
    "compute_hvi_fragment_atom": {"damage": YES},
    "compute_hvi_hole": {"thickness": between(0.5, 5), "dr": between(0.3, 2), "fill": between(0.1, 0.9), "reference": between(0.5, 2), "sectors": pick("8", "64")},
    "compute_hvi_wall": {
        "wall": each(pick("1", "2", "1*2"), between(0, 5), between(0.5, 5)), "outer": pick("2"), "nodes": pick("3", "2"), "layers": pick("1", "3"), "radius": between(1, 9),
        "center": each(between(0, 9), between(0, 9)), "struck": each(between(0, 9), between(0, 9)), "pieces": pick("no", "1.3", "1.3 h")},
}


class Writer:
    """odd: words and lines are changed at the end; sane: no words that exclude each other, as far as is told here"""

    def __init__(self, seed, folder):
        self.rng, self.folder, self.names, self.kind = random.Random(f"grammar {seed}"), pathlib.Path(folder), [], "sph"
        self.odd = self.rng.random() < 0.25
        self.sane = self.rng.random() < 0.8

    def maybe(self, text, chance=0.5):
        return text if self.rng.random() < chance else ""

    def some(self, page, most, leave=()):
        """random keywords of a page, with values"""
        rules = RULES[page]
        names = [name for name in rules if name not in leave]
        chosen = [self.rng.choice(names) for _ in range(self.rng.randrange(most + 1))]
        return " ".join(f"{name} {rules[name](self.rng)}" for name in (chosen if self.rng.random() < 0.1 else dict.fromkeys(chosen)))

    # ------------------------------------------------------------------ scenes
    def sph(self):
        rng = self.rng
        dim = rng.choice([2, 3, 3, 3])
        si = rng.random() < 0.3
        a = 1e-3 if si else 1.0
        c = 5000.0 if si else 4.0
        self.a, self.dt = a, 0.1 * a / c
        boundary = " ".join(rng.choice("pfsm") for _ in range(3)) if rng.random() < 0.8 else "p p p"
        if dim == 2:
            self.kind = "2"
            boundary = boundary[:4] + "p"
        n = rng.choice([1, 2, 4, 6, 9])
        high = "0.5" if dim == 2 else "10"
        head = [f"units {'si' if si else 'lj'}", f"dimension {dim}", f"boundary {boundary}", f"newton {rng.choice(['on', 'off'])}", "atom_style sph",
                f"atom_modify map {rng.choice(['array', 'hash', 'yes'])} {self.maybe('sort 0 0')}", f"comm_style {rng.choice(['brick', 'tiled'])}",
                self.maybe("comm_modify vel yes"), self.maybe("processors * * 1", 0.2)]
        create = [f"lattice {'sq' if dim == 2 else 'sc'} {a:g} origin 0.5 0.5 {'0' if dim == 2 else '0.5'}",
                  f"region box block 0 20 0 10 {'-0.5' if dim == 2 else 0} {high}", "create_box 2 box",
                  f"region left block 1 {1 + n} 1 {1 + rng.choice([1, 3, n])} {'INF INF' if dim == 2 else f'1 {1 + rng.choice([1, 3, n])}'}",
                  f"region right block {1 + n} {1 + 2 * n} 1 {1 + n} {'INF INF' if dim == 2 else '1 5'}", "region half block INF 8 INF INF INF INF",
                  "create_atoms 1 region left", self.maybe("create_atoms 2 region right", 0.9)]
        m = (2700.0 if si else 1.0) * a**dim
        solid = self.maybe("hvi/johnson-cook " + self.some("fix_hvi_johnson_cook", 3, {"strength"} if self.sane and si else set()), 0.6)
        metals = ["Al6061-T6.hvi", "Cu-OFHC.hvi", "Al2024-T3.hvi"] if si and self.sane else ["Al6061-T6.hvi", "Cu-OFHC.hvi", "Al2024-T3.hvi", "Al-Tillotson.hvi", "PMMA.hvi", "Ta.hvi"] if si else ["m.hvi"]
        laws = ["file " + rng.choice(metals) for _ in range(3)] + (["eos tait 2700 5000 7"] if si else ["eos tait 1 4 7", "eos linear 1 16", "eos idealgas 1.4", "eos table x.table"])
        if self.sane and solid:
            laws = laws[:3]

        def material():
            law = rng.choice(laws)
            length = f"h {1.25 * a:g}" if self.sane and "idealgas" in law else rng.choice([f"h {1.25 * a:g}", f"spacing {a:g}", f"spacing {a:g} h {1.1 * a:g}"])
            return f"{law} {length} {self.maybe(self.some('pair_hvi_sph', 1, set(RULES['pair_hvi_sph']) - {'spacing', 'volume', 'strength'}), 0.2)}"

        pair = f"pair_style hvi/sph {rng.choice(KERNELS)} {self.some('pair_hvi_sph', 3, {'spacing', 'volume', 'strength', 'tension', 'mirror'} | ({'dim', 'stock'} if self.sane else set()))}"
        if self.sane and "riemann" in pair:
            pair = re.sub(r" (viscosity \S+ \S+|interface \S+|form symmetric|artstress \S+ \S+)", "", pair)
        pair += "" if self.sane and boundary[0] == "p" else self.maybe(f" mirror x {0 if rng.random() < 0.7 else a:g} lo", 0.25)
        if dim == 2:
            pair += self.maybe(" dim 2", 0.8)
        coeff = [f"pair_coeff * * {material()}"] if rng.random() < 0.4 else [f"pair_coeff {k} {k} {material()}" for k in (1, 2)]
        coeff += [self.maybe(f"pair_coeff 1 2 tension {rng.choice(['yes', 'no'])} {self.maybe('viscosity 0.5 1')}")]
        if self.sane and solid:
            pair = pair.replace("form symmetric", "")
        if rng.random() < (0.02 if self.sane else 0.2):
            pair = pair.replace("pair_style ", rng.choice(["pair_style hybrid ", "pair_style hybrid/overlay zero 1.0 ", "pair_style hybrid/scaled 1.0 "]))
            coeff = [re.sub(r"(pair_coeff \S+ \S+)", r"\1 hvi/sph", line) for line in coeff]
        state = [f"mass * {m:g}", f"set group all sph/rho {2700 if si else 1}", self.maybe(f"set group all sph/e {0.5 * m * c * c * 0.01:g}", 0.2)]
        v = c * rng.choice([0.01, 0.1, 0.5, 1.5])
        state += [f"velocity one set {v:g} 0 0 units box", self.maybe(f"velocity all create {1e-3 if not si else 300} 4711 loop geom", 0.2)]
        fixes = [f"fix move {rng.choice(['all', 'all', 'all', 'one'])} hvi/sph {self.some('fix_hvi_sph', 2)}",
                 solid and f"fix solid {GROUP(rng) if rng.random() < 0.3 and not self.sane else 'all'} {solid}"]
        if rng.random() < (0.3 if solid and dim == 3 else 0.02):  # pieces have masses of their own
            create.insert(create.index("create_box 2 box") + 1, "fix masses all property/atom rmass ghost yes")
            state.append(f"set group all mass {m:g}")
            fixes.append(f"fix debris {GROUP(rng)} hvi/debris {self.some('fix_hvi_debris', 2)}")
        return head, create, [pair, *coeff, *state, f"neighbor {rng.choice([0.1, 0.3, 1.0]) * a:g} {rng.choice(['bin', 'bin', 'nsq'])}",
                              f"neigh_modify every {rng.choice([1, 5])} delay 0 check yes"], fixes

    def dem(self):
        rng = self.rng
        self.a, self.dt = 1.12, 0.005
        boundary = "p p p" if rng.random() < 0.3 else " ".join(rng.choice("fspm") for _ in range(3))
        n = rng.choice([1, 2, 4, 6])
        self.kind = "dem"
        head = ["units lj", f"boundary {boundary}", f"newton {rng.choice(['on', 'off', 'on off', 'off on'])}", "atom_style bond", "atom_modify map yes",
                f"comm_style {rng.choice(['brick', 'tiled'])}", "special_bonds lj/coul 0 1 1"]
        create = ["lattice sc 0.7 origin 0.5 0.5 0.5", "region box block 0 20 0 10 0 10", f"create_box 2 box bond/types 1 extra/bond/per/atom {12 if self.sane else 2} extra/special/per/atom 12",
                  f"region left block 2 {2 + n} 2 {2 + n} 2 {2 + n}", f"region right block {4 + n} {4 + 2 * n} 2 {2 + n} 2 4", "region half block INF 8 INF INF INF INF",
                  "create_atoms 1 region left", self.maybe("create_atoms 2 region right", 0.9), "mass * 1"]
        styles = [f"pair_style hvi/contact {self.some('pair_hvi_contact', 2)}", f"pair_coeff * * {rng.choice(['1', '0.5'])} 1", self.maybe("pair_coeff 2 2 2 0.9", 0.3),
                  "bond_style hvi/spring", f"bond_coeff 1 {rng.choice([4, 27])} 1.12 {rng.choice([1.3, 1.5])}", f"neighbor {rng.choice([0.1, 0.3, 0.3, 0.3])} bin",
                  "create_bonds many one one 1 0.0 1.2", self.maybe("create_bonds many two two 1 0.0 1.2", 0.8), "special_bonds lj/coul 1 1 1",
                  f"velocity one set {rng.choice([0.1, 3, 15])} 0 0", self.maybe("velocity all create 1.0 4711 loop geom")]
        return head, create, styles, [rng.choice(["fix move all nve", "fix move all nve", "fix move all nve/limit 0.1"])]

    def fem(self):
        rng = self.rng
        self.a, self.dt = 1e-3, 2e-8
        if rng.random() < 0.5:
            mesh, strike = fem_scenes.strike_plate(v=rng.choice([100.0, 3000.0]), nx=rng.choice([3, 5]), ny=3, nz=rng.choice([1, 2]), core=rng.choice([0, 1.1]))
        else:
            mesh, strike = fem_scenes.plate(nx=3, ny=2, nz=1, core=0, n=rng.choice([2, 3])), ""
        text = fem_scenes.start(mesh, boundary=" ".join(rng.choice("sfm") for _ in range(3)), newton=rng.choice(["on", "off"]), comm=rng.choice(["brick", "tiled"]),
                                fem=self.some("fix_hvi_fem", 3, {"probe"}), spall=SPALL(rng), data=self.folder / "mesh.data")
        if self.odd:  # the part that fix hvi/fem reads
            whole, name, section = (self.folder / "mesh.data").read_bytes().partition(b"\nElements")
            (self.folder / "mesh.data").write_bytes(whole + name + mutate.mutated(rng, [section], seeds.NUMBERS))
        text = re.sub(r"thermo_style.*\n|thermo_modify.*\n|thermo 10\n|fix step.*\n", "", text.replace(str(self.folder) + "/", "").replace(str(fem_scenes.ALUMINUM), "Al6061-T6.hvi"))
        lines = text.splitlines()
        cut = next(k for k, line in enumerate(lines) if line.startswith("pair_style"))
        fix = next(k for k, line in enumerate(lines) if line.startswith("fix move"))
        end = next(k for k, line in enumerate(lines) if line.startswith("read_data"))
        head = lines[:cut]
        return head[:-6], head[-6:] + ["region half block INF 0 INF INF INF INF"], lines[cut:fix], lines[fix:end] + ["@" + lines[end], *("@" + line for line in lines[end + 1:]),
                                                                                   *("@" + line for line in strike.splitlines())]

    # ------------------------------------------------------------------ what looks on, and what happens between runs
    def computes(self):
        rng, a = self.rng, self.a
        axis, out, thermo = rng.choice("xyz"), [], []
        known = list(RULES["compute_hvi_atom"])
        if self.sane:
            known = ["nbonds"] if self.kind == "dem" else [name for name in known if name not in ("nbonds", "body")]
        names = [rng.choice(known) for _ in range(rng.randrange(1, 5))]
        made = [("atom", f"hvi/atom {' '.join(names)}"), ("cloud", f"hvi/cloud axis {axis} plane {a * 3:g} {self.some('compute_hvi_cloud', 1)}"),
                ("energy", f"hvi/energy {self.some('compute_hvi_energy', 1)}"),
                ("fragment", f"hvi/fragment {self.mode()} {self.some('compute_hvi_fragment', 1)}"), ("fragatom", f"hvi/fragment/atom {self.mode()}"),
                ("hole", f"hvi/hole axis {axis} centre {a * 3:g} {a * 3:g} plane {a * 3:g} {self.lengths('compute_hvi_hole')}"),
                ("wall", f"hvi/wall axis {axis} wall {rng.choice(['1', '2', '1*2'])} {a:g} {3 * a:g} {self.lengths('compute_hvi_wall')}")]
        if self.sane:
            made = [one for one in made if one[0] not in {"dem": ("wall", "hole"), "2": ("wall", "hole", "cloud")}.get(self.kind, ())]
        for name, words in rng.sample(made, min(rng.randrange(5), len(made))):
            out.append(f"compute {name} {'all' if name == 'energy' or rng.random() < 0.8 else GROUP(rng)} {words}")
            if name in ("atom", "fragatom"):
                self.names.append(f"c_{name}" + ("[1]" if name == "atom" and len(names) > 1 else ""))
                out.append(f"compute max{name} all reduce max {self.names[-1]}")
                thermo.append(f"c_max{name}")
            else:
                thermo.append({"wall": "c_wall[1][1]", "hole": "c_hole[1]", "cloud": "c_cloud[1]", "fragment": "c_fragment[1]", "energy": "c_energy[*]"}[name])
        return out, thermo

    def lengths(self, page):
        """the same, lengths times the spacing"""
        return re.sub(r"(thickness|dr|radius|pieces) ([\d.]+)(?! h)", lambda m: f"{m[1]} {float(m[2]) * self.a:g}", self.some(page, 3, {"wall"}))

    def mode(self):
        damage = self.maybe(" " + self.some("compute_hvi_fragment_atom", 1), 0.3)
        if self.sane:
            return "bonds" if self.kind == "dem" else self.rng.choice([f"distance {1.3 * self.a:g}", "distance 1.2 h"]) + damage
        return self.rng.choice(["bonds", f"distance {1.3 * self.a:g}{damage}", f"distance 1.2 h{damage}"])

    def between(self):
        """commands between two runs"""
        rng, a = self.rng, self.a
        known = ["reset_timestep 1000", "delete_atoms group two", "delete_atoms region half", "delete_atoms random fraction 0.3 yes all NULL 4711 compress yes", f"displace_atoms one move {a} 0 0 units box",
                 "velocity all zero linear", "unfix move", "fix move all hvi/sph", "unfix solid", "fix solid all hvi/johnson-cook damage no spall none", "write_restart now.restart", "write_data now.data",
                 "set group one type 2", "set group one sph/rho 1.01", "group moving clear", "group moving region half", "balance 1.0 shift xyz 5 1.1", "run 0", "run 3 pre no post no", "neighbor 0 bin",
                 "change_box all boundary p p p", f"change_box all x delta 0 {a} units box", "pair_coeff * * eos tait 1 4 7 h 1.25", f"timestep {self.dt / 2:g}", "timestep 1e10",
                 "replicate 2 1 1", "minimize 0 0 5 5", "newton off", "neigh_modify exclude group one two", "run_style respa 2 2", "special_bonds lj/coul 0 1 1", f"create_atoms 1 single {3 * a} {3 * a} {0} units box",
                 "write_dump all atom now.dump", "rerun now.dump dump x y z", "kim init x y", "reset_atoms id", "atom_modify sort 1 0", "comm_modify cutoff 3", "processors 1 1 *",
                 "delete_bonds all bond 1 remove", "clear\nread_restart now.restart", "suffix off", "set group all charge 1", "fix again all hvi/sph", "compute again all hvi/energy"]
        return [rng.choice(known) for _ in range(rng.randrange(4))]

    # ------------------------------------------------------------------
    def text(self):
        rng = self.rng
        head, create, styles, fixes = rng.choice([self.sph, self.sph, self.sph, self.dem, self.fem])()
        computes, thermo = self.computes()
        groups = ["group one type 1", "group two type 2", "group none empty", "group moving dynamic all region half every 1" if rng.random() < 0.2 else "group moving region half"]
        early, late = [line for line in fixes if not line.startswith("@")], [line[1:] for line in fixes if line.startswith("@")]
        more = [f"fix step all hvi/dt {rng.choice(['0.1', '0.3', '0.6'])} {self.some('fix_hvi_dt', 2, {'max'})}" if rng.random() < 0.6 else f"timestep {self.dt:g}",
                self.maybe(f"fix balance all balance {rng.choice([2, 5])} 1.0 shift {'xy' if self.kind == '2' else 'xyz'} 5 1.05", 0.3),
                self.maybe(f"fix columns all hvi/balance {rng.choice([2, 5])} 1.0 {self.some('fix_hvi_balance', 1)}", 0.0 if self.sane else 0.3), self.maybe("fix hold two setforce 0 0 0", 0.0 if self.sane and late else 0.2), self.maybe("fix frozen two sph/stationary", 0.0 if self.sane else 0.05)]
        if late:  # what reads data comes before groups and what looks on
            styles, early, more = [*styles, *early, *late[:1], *late[1:]], [], more
        block = [*early, *more, *computes]
        if rng.random() < 0.1:
            rng.shuffle(block)
        if rng.random() < 0.03:
            rng.shuffle(styles)
        out = ["thermo 5", f"thermo_style custom step time dt atoms ke press {' '.join(thermo)}", "thermo_modify norm no lost ignore" if rng.random() < 0.5 else "thermo_modify norm no",
               f"dump d all custom {rng.choice([1, 10])} fuzz.dump id type x y z vx fx {' '.join(self.names)}"]
        runs = [f"run {STEPS}"]
        if rng.random() < 0.5:
            runs += [*self.between(), f"run {STEPS // 2}"]
        split = next((k for k, line in enumerate(styles) if line.startswith(("create_bonds", "velocity", "set group"))), len(styles))
        lines = [*head, *create, *styles[:split], *groups, *styles[split:], *block, *out, *runs]
        lines = [line for line in lines if line.strip()]
        if self.odd:
            lines = self.changed(lines)
        return "\n".join(lines) + "\n"

    def changed(self, lines):
        """a few words replaced, lines lost, doubled, moved"""
        rng = self.rng
        for _ in range(rng.choice([1, 2, 4])):
            k = rng.randrange(4, len(lines))
            which = rng.randrange(8)
            if which == 0:
                del lines[k]
            elif which == 1:
                lines.insert(rng.randrange(4, len(lines)), lines[k])
            elif which == 2:
                lines.insert(rng.randrange(4, len(lines)), lines.pop(k))
            else:
                words = lines[k].split()
                words[rng.randrange(1, len(words)) if len(words) > 1 else 0] = rng.choice(ODD)
                lines[k] = " ".join(words)
        return lines


MATERIAL = """# UNITS: lj
eos gruneisen
rho0 1
C 4
S1 1.4
g0 2
a 0.5
cp 1
T0 300
strength johnson-cook
G 6
A 0.25
B 0.4
n 0.4
C 0.01
m 1
epsdot0 1
Tref 300
Tm 900
strength cowper-symonds
G 6
Y0 0.2
D 1
p 2
strength steinberg-guinan
G0 6
Y0 0.2
Ymax 1
beta 10
n 0.2
A 0.01
B 0.001
Tm0 900
g0 2
a 0.5
strength zerilli-armstrong
G 6
C0 0.1
C3 0.001
C4 0.0001
epsdot0 1
Tm 900
strength perfect
G 6
Y 0.2
damage johnson-cook
D1 0.02
D2 0.04
D3 -1.5
D4 0.01
D5 0.5
epsdot0 1
spall limit
sigma_p 1
spall voids
sigma 0.5
rate 1
m 0.2
phi_c 0.5
spall tuler-butcher
sigma_0 0.4
lambda 2
K 0.1
spall grady
eps_c 0.15
"""


def beside(folder):
    """files that inputs read"""
    (folder / "m.hvi").write_text(MATERIAL)
    (folder / "x.table").write_text(seeds.table().replace("UNITS: si", "UNITS: lj"))


def write(seed, folder):
    """in.fuzz and its files; returns (its path, number of ranks)"""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    beside(folder)
    writer = Writer(seed, folder)
    path = folder / "in.fuzz"
    ranks = random.Random(f"ranks {seed}").choice([1, 1, 1, 2, 3])
    path.write_text(f"# seed {seed}, ranks {ranks}\n" + writer.text())
    return path, ranks


if __name__ == "__main__":
    print(*write(sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else "."))
