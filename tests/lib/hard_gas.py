"""Hard cases of gases and liquids, for hard.py: methods, criteria, what is known to miss. Scenes: hard_gas_rows.py, hard_gas_flows.py.

Criteria from before the first run, but for those of table-room. Against exact solutions: the bounds of shock_scenes.py, that is what three
smoothing lengths on both sides smear, or 1 % of a plateau. At rest: a row 2 % of the largest error, a plane 5 %; the noise of disordered particles
3 to 5 % rms. Symmetry 1e-6 of a spacing. Paired: at most 1 % of the particles have a neighbor nearer than half of the spacing that their density
says (on_row in two and three dimensions: a quarter, since shocks squeeze the lattice in one direction).
"""

from hard_cases import BOOKS, Case
from hard_gas_flows import contrast, faces, impact, kelvin_helmholtz, random_rest, shear, spacings, spinning, twins, vortices
from hard_gas_known import KNOWN
from hard_gas_rows import ColdBlast, ColdNoh, Dome, HotGas, Release, Spaced, SpacedRest, Spalled, bounds_of, long_step, on_row, tabled
from shock_scenes import CASES as SHOCKS
from shock_scenes import Interface

ROW = {"monaghan": "monaghan", "interface": "interface", "riemann": "riemann", "stock sph": "stock"}
FLOW = {"monaghan": "viscosity 1 2", "interface": "viscosity 1 2 interface auto", "riemann": "dissipation riemann", "stock sph": "stock"}
KERNELS = {"cubic": 1.2, "quartic": 1.2, "quintic": 1.2, "gauss": 1.2, "wendland2": 1.6, "wendland4": 2.0}
DISSIPATIONS = {"monaghan": "viscosity 0.1 0.2", "riemann": "dissipation riemann"}
WENDLAND4 = {f"{k} wendland4": ("wendland4", 2.0, FLOW[k]) for k in ("monaghan", "riemann")}
LUCY = {"monaghan lucy": ("lucy", 3.2, FLOW["monaghan"])}  # the same reach, but twice the viscosity, as h is the reach
ULSPH = {"stock ulsph": "ulsph"}
FINER = {"monaghan 0.1 0.2": "viscosity 0.1 0.2", "riemann finer": (FLOW["riemann"], 96)}
HVI_ROW = {k: v for k, v in ROW.items() if v != "stock"}
MIRROR, PAIRS = {"symmetry": 1e-6}, {"paired": 0.01}


def some(methods, *names):
    return {k: methods[k] for k in names}


def one_body(methods, stock=True):
    """without interface, which has nothing to do inside one body"""
    return some(methods, "monaghan", "riemann", *(["stock sph"] if stock else []))


def rounded(bounds):
    return {k: float(f"{b:.4g}") for k, b in bounds.items()}


def standard(name, title, methods, short=()):
    """of shock_scenes.py"""
    n, bounds = bounds_of(name)
    return Case(name, title, on_row(SHOCKS[name], n), methods, {**bounds, **BOOKS, **MIRROR, **PAIRS}, short)


THOUSAND = Interface(1000, (200,), (200,))


def on_row_case(case, title, criteria, methods, short=("riemann",), n=200, at_rest=None):
    return Case(case.name, title, on_row(case, n, at_rest), methods, {**criteria, **BOOKS, **MIRROR, **PAIRS}, short)


CASES = [
    standard("blast-left", "blast, pressures 1000 : 0.01", one_body(ROW), ("riemann",)),
    standard("blast-right", "blast, pressures 0.01 : 100", one_body(ROW), ("riemann",)),
    standard("woodward-colella", "two blasts that meet (Woodward and Colella)", one_body(ROW)),
    standard("noh-1d", "Noh's implosion, plane", one_body(ROW), ("riemann",)),
    standard("noh-2d", "Noh's implosion, cylinder", one_body(ROW)),
    standard("noh-3d", "Noh's implosion, sphere", one_body(ROW)),
    standard("sedov-2d", "point explosion, cylinder (Sedov)", one_body(ROW)),
    standard("sedov-3d", "point explosion, sphere (Sedov)", one_body(ROW)),
    on_row_case(ColdNoh(200), "Noh's implosion, plane, without any energy at the start", bounds_of("noh-1d")[1], one_body(ROW)),
    on_row_case(ColdBlast(200), "blast into gas without pressure and energy", rounded(ColdBlast(200).bounds(200)), one_body(ROW)),
    on_row_case(Release(200), "gas into nothing", Release(200).criteria(200), one_body(ROW)),
    on_row_case(Spalled(4000.0, 200), "plates of aluminum meet at 4 km/s, and the shocks come out at the rear", {"surface": 0.01, "double": 0.03},
                one_body(ROW)),
    on_row_case(Dome(100e9, 200), "aluminum (Tillotson) of 100 GPa into nothing", {"isentrope": 0.02, "back": 0.02, "surface": 0.01}, one_body(ROW)),
    *[on_row_case(Dome(p * 1e9, 200, (5,)), f"aluminum (Tillotson) of {p} GPa into nothing{word}", {"isentrope": 0.02, "back": 0.02},
                  one_body(ROW), ())
      for p, word in ((400, ""), (2000, ", to vapor"))],
    on_row_case(HotGas(200), "gas of 1e5 bar beside cold aluminum", {"p": 0.01, "rho": 0.01, "u": 0.01, "p_gas": 0.01}, ROW),
    standard("interface-100", "shock into a gas that is 100 times as dense", ROW),
    on_row_case(THOUSAND, "shock into a gas that is 1000 times as dense", rounded(THOUSAND.bounds(200)), ROW, ()),
    *[Case(f"contrast-{k}-rest", f"density {k} : 1 at equal pressure, at rest", contrast(k), FLOW,
           {"speed": 0.03, "p": 0.03, "rho": 0.01, **BOOKS, **PAIRS}, ("riemann",)) for k in (100, 1000)],
    *[on_row_case(SpacedRest(k, 100), f"spacing {k} : 1 on a row, at rest", {"rho": 0.02, "p": 0.02, "u": 0.02}, HVI_ROW,
                  ("monaghan", "riemann"), n=100, at_rest=1.18) for k in (2, 4)],
    *[on_row_case(Spaced(k, 200), f"spacing {k} : 1 on a row, a shock of Mach 3 passes", rounded(Spaced(k, 200).bounds(200)), HVI_ROW, ("riemann",) if k == 4 else ())
      for k in (2, 4)],
    *[Case(f"spacing-{k}-rest-2d", f"spacing {k} : 1 in a plane, at rest", spacings(k), FLOW,
           {"rho": 0.05, "p": 0.05, "u": 0.05, **BOOKS, **PAIRS}, ("riemann",) if k == 4 else ())
      for k in (2, 4)],
    *[Case(f"spacing-{k}-shock-2d", f"spacing {k} : 1 in a plane, a shock of Mach 1.2 passes", spacings(k, 1.2), FLOW,
           {"p_fine": 0.05, "u_fine": 0.05, "p_coarse": 0.05, "u_coarse": 0.05, **BOOKS, **PAIRS}, ("riemann",) if k == 2 else ()) for k in (2, 4)],
    Case("shear", "shear layer, Mach 0.1, one crossing", shear, {**one_body(FLOW), **WENDLAND4},
         {"lost": 0.2, "v": 0.1, **BOOKS, **PAIRS}),
    Case("kelvin-helmholtz", "layers of density 1 and 2 slide on each other (Kelvin and Helmholtz)", kelvin_helmholtz, {**FLOW, **FINER},
         {"grows": (0.5, 1.2), **MIRROR, **BOOKS, **PAIRS}),
    Case("spinning-disc", "disc of liquid, free, one turn", spinning("disc"), {**one_body(FLOW), **ULSPH, **WENDLAND4, **LUCY},
         {"angular": 1e-10, "v": 0.1, "pieces": 1, **BOOKS, **PAIRS}),
    Case("spinning-square", "square of liquid, free, a quarter turn", spinning("square", turns=0.25), {**one_body(FLOW), **ULSPH, **LUCY},
         {"angular": 1e-10, "pieces": 1, **BOOKS, **PAIRS}, ("riemann",)),
    *[Case(f"twins-{d:g}", f"two particles {d:g} spacings apart, in a gas at rest", twins(d), one_body(FLOW),
           {"u": 0.5, "rho": 0.05, **BOOKS}, ("monaghan", "riemann"))
      for d in (1e-6, 1e-12)],
    Case("long-step", "time steps three times those of the limit", long_step, one_body(ROW), {"silent": 0.0}, ("riemann",)),
    *[Case(name, f"table of a gas, {word}; and beyond", tabled(margin), some(ROW, "monaghan", "riemann"),
           {"differs": 1e-3, "silent": 0.0, **BOOKS}, ("riemann",), since=since)
      for name, margin, word, since in (("table-edge", 1.05, "to densities 5 % above those of the flow", "first"),
                                        ("table-room", 1.2, "to densities 20 % above those of the flow", "after"))],
    Case("faces", "a cloud of gas crosses faces of kinds f, s, m", faces, one_body(FLOW),
         {"lost": (0.2, 1.0), "kept": 0.0, "count": 0.0, **BOOKS}, ("riemann",)),
    Case("random-rest", "gas at rest of particles at random places", random_rest(0.5), one_body(FLOW),
         {"speed": 0.05, "p": 0.05, "rho": 0.05, **BOOKS, **PAIRS}, ("riemann",)),
    *[Case(f"{fill}-impact", f"liquid plates meet at 5 km/s, particles {word}", impact(fill), one_body(FLOW),
           {"sigma": 0.01, "rho": 0.01, "u": 0.01, "scatter": 0.05, **BOOKS})
      for fill, word in (("lattice", "on a lattice"), ("glass", "like glass"))],
    Case("vortices", "vortices of disordered particles (Taylor and Green)", vortices(),
         {f"{k} {w}": (k, h, words) for k, h in KERNELS.items() for w, words in DISSIPATIONS.items()},
         {"rho": 0.1, **BOOKS, **PAIRS}, ("wendland2 riemann",)),
]

for _case in CASES:
    _case.known = KNOWN.get(_case.name, {})
