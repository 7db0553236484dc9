# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Ballistic-limit equations: the diameter from which on a shield of one or two aluminum walls fails, as engineers compute it.

Units as published: cm, g/cm^3, ksi, km/s, degrees from the normal.

[C91]   Christiansen, Shield Sizing and Response Equations, NASA JSC SN3-91-42 (1991)
[C93]   Christiansen, Int. J. Impact Engng. 14, 145 (1993)
[CK01]  Christiansen & Kerr, Int. J. Impact Engng. 26, 93 (2001)
[R06]   Reimerdes, Noelke & Schaefer, Int. J. Impact Engng. 33, 645 (2006)
[C09]   Christiansen et al., Handbook for Designing MMOD Protection, NASA/TM-2009-214785 (2009)
[RC09]  Ryan & Christiansen, Ballistic Limit Analysis Program, NASA/TM-2009-214789 (2010)
[RC11]  Ryan & Christiansen, Acta Astronautica 69, 245 (2011)
[RS24]  Ryan & Schonberg, Int. J. Impact Engng. 187, 104899 (2024), as it is coded in pyBLOSSUM 2024-08-26
"""

import dataclasses
import functools
import math
import re
import sys
from typing import Optional
import typing

from .. import tables
from ..errors import HVIError
from ..material import library

CAP = 65.0  # degrees: beyond, fragments of the bumper decide; d_c is that of 65 degrees [C09] (4-26)
HIGH = 7.0  # km/s, normal component, from which on the projectile melts [C09]
SPHERE = math.pi / 6  # mass = SPHERE rho d^3. pyBLOSSUM has pi/8; 3.918 = (0.16 SPHERE^(1/3))^(-2/3) says pi/6


@dataclasses.dataclass(frozen=True)
class Shield:
    """One wall, or a bumper and a rear wall: cm, g/cm^3, ksi, km/s. standoff: from the rear of the bumper to the front of the wall"""

    wall_thickness_cm: float
    wall_density: float
    projectile_density: float
    wall_yield_ksi: Optional[float] = None  # equations of two walls need it
    bumper_thickness_cm: Optional[float] = None  # None: one wall only
    bumper_density: Optional[float] = None
    standoff_cm: Optional[float] = None
    wall_brinell: Optional[float] = None  # these two for the equation of one wall
    wall_sound_km_s: Optional[float] = None
    aluminum: bool = True  # all of it

    @property
    def walls(self):
        return 1 if self.bumper_thickness_cm is None else 2


# density, yield strength (ksi), speed of sound (km/s), Brinell hardness: [RC09] table 1; from the last line on material_data.csv of pyBLOSSUM, MPa / 6.895
PROPERTIES = {
    "Al1100-O": (2.71, 5, 5.05, 23), "Al1100-H14": (2.71, 17, 5.05, 32), "Al2024-T3": (2.77, 50, 5.11, 120), "Al2024-T4": (2.77, 47, 5.11, 120),
    "Al2024-T351": (2.77, 47, 5.11, 120), "Al2219-T87": (2.84, 57, 5.10, 130), "Al2219-T851": (2.84, 51, 5.10, 130), "Al2219-T852": (2.84, 54, 5.10, 115),
    "Al3003-O": (2.73, 6, 5.06, 28), "Al3003-H12": (2.73, 18, 5.06, 35), "Al3003-H14": (2.73, 21, 5.06, 40), "Al6061-O": (2.70, 8, 5.05, 30),
    "Al6061-T6": (2.70, 40, 5.05, 95), "Al7075-T6": (2.80, 73, 5.04, 150), "Al7075-T73": (2.80, 63, 5.04, 135), "Al7178-T6": (2.83, 78, 5.03, 160),
    "Al99.9%": (2.70, None, None, 15), "Al2017-T4": (2.80, 39.9, None, 105), "Al5083-H116": (2.66, 33.1, None, 85), "Al5456-H116": (2.66, 37.0, None, 90)}


def _cos(angle):
    return math.cos(math.radians(min(angle, CAP)))


def bisect(function, low, high):
    """where an increasing function changes its sign; a jump counts. The function is not asked for its values at low and high"""
    below = set()  # is a value below 0
    for _ in range(200):
        middle = 0.5 * (low + high)
        if middle in (low, high):
            break
        value = function(middle)
        low, high = (middle, high) if value < 0 else (low, middle)
        below.add(value < 0)
        if len(below) == 2:
            from scipy.optimize import brentq  # slow to load, and most calls of hvi need no equation
            return brentq(function, low, high, xtol=1e-300, rtol=4 * sys.float_info.epsilon, maxiter=10000)
    return 0.5 * (low + high)


def _between(speed, low_speed, high_speed, low, high):
    """d_c over the speed: low(V), high(V), and a line from one to the other"""
    if speed <= low_speed:
        return low(speed)
    if speed >= high_speed:
        return high(speed)
    share = (speed - low_speed) / (high_speed - low_speed)
    return (1 - share) * low(low_speed) + share * high(high_speed)


# new non-optimum

def _low(shield, cos, speed):
    """[C09] (4-24)"""
    wall = shield.wall_thickness_cm * math.sqrt(shield.wall_yield_ksi / 40)
    return ((wall + shield.bumper_thickness_cm) / (0.6 * cos ** (5 / 3) * math.sqrt(shield.projectile_density) * speed ** (2 / 3))) ** (18 / 19)


def _high(shield, cos, speed):
    """[C09] (4-23)"""
    return (3.918 * shield.wall_thickness_cm ** (2 / 3) * (shield.standoff_cm * shield.wall_yield_ksi / 70) ** (1 / 3)
            / (shield.projectile_density ** (1 / 3) * shield.bumper_density ** (1 / 9) * (speed * cos) ** (2 / 3)))


def _nno(shield, speed, angle):
    c = _cos(angle)
    return _between(speed, 3 / c, HIGH / c, lambda v: _low(shield, c, v), lambda v: _high(shield, c, v))


# modified by bumper thickness

def _ck(shield, speed, angle, factor):
    """[CK01] (1) to (3)"""
    c = _cos(angle)
    x = shield.bumper_thickness_cm / (shield.wall_thickness_cm ** (2 / 3) * shield.standoff_cm ** (1 / 3))
    wall = shield.wall_thickness_cm * math.sqrt(shield.wall_yield_ksi / 40) + 0.37 * shield.bumper_thickness_cm * shield.bumper_density

    def low(v):
        return 1.9 * wall / (c ** (11 / 6) * math.sqrt(shield.projectile_density) * v ** (2 / 3))

    def high(v):
        return (factor(x) * shield.projectile_density ** (-1 / 3) * (v * c) ** (-2 / 3) * shield.bumper_density ** (-1 / 9) * math.sqrt(shield.standoff_cm)
                * (shield.wall_thickness_cm * shield.wall_density) ** (2 / 3) * (shield.wall_yield_ksi / 70) ** (1 / 3))
    return _between(speed, 3 / c**1.5, HIGH / c, low, high)


def _ck01(shield, speed, angle):
    return _ck(shield, speed, angle, lambda x: 7.451 * x + 0.411 if x < 0.126 else 1.35)


def _modnno(shield, speed, angle):
    return _ck(shield, speed, angle, lambda x: 1.35 if x < 0.126 else 7.451 * x + 0.411)


# thin bumpers: F2*

def _thick_enough(shield, d):
    """t_b/d that breaks all of a projectile [RC11]; jumps at S/d = 30"""
    return 0.20 if shield.standoff_cm >= 30 * d else 0.25


def _thick_enough_mod(shield, d):
    """the same in one line, for the ratio of densities too [RS24]"""
    return min(0.25, max(0.20, 0.25 - 0.05 / 15 * (shield.standoff_cm / d - 15))) * shield.projectile_density / shield.bumper_density


def _walls_jsc(shield, cos, speed, d):
    """(t_w without bumper, t_w with one that is thick enough) [C09] (4-24), (4-22)"""
    alone = 0.6 * d ** (19 / 18) * cos ** (5 / 3) * math.sqrt(shield.projectile_density) * speed ** (2 / 3) / math.sqrt(shield.wall_yield_ksi / 40)
    mass = SPHERE * shield.projectile_density * d**3
    behind = (0.16 * math.sqrt(d) * (shield.projectile_density * shield.bumper_density) ** (1 / 6) * mass ** (1 / 3) * speed * cos
              / math.sqrt(shield.standoff_cm) * math.sqrt(70 / shield.wall_yield_ksi))
    return alone, behind


def _walls_reimerdes(shield, cos, speed, d):
    """[R06] (8), (9) and (3)"""
    mass = SPHERE * shield.projectile_density * d**3
    alone = 1.8 * 0.42 * mass**0.352 * shield.projectile_density ** (1 / 6) * (speed * cos) ** (2 / 3)
    behind = 0.178 * math.sqrt(mass) * shield.bumper_density ** (1 / 6) * speed * cos / math.sqrt(shield.standoff_cm) * math.sqrt(70 / shield.wall_yield_ksi)
    return alone, behind


def _derated(shield, cos, speed, ratio_at, walls, thick_enough):
    """d with d F2*(d)^(2/3) = d_c of NNO [RC11] (31), (32); the left side rises with d, and jumps where thick_enough does"""
    full = _high(shield, cos, speed)

    def excess(d):
        q = shield.bumper_thickness_cm / d / thick_enough(shield, d)
        if q >= 1:
            return d - full
        alone, behind = walls(shield, cos, ratio_at, d)
        return d * (1 + (alone / behind - 1) * (1 - q) ** 2) ** (2 / 3) - full
    top = full
    while excess(top) < 0:
        top *= 2
    return bisect(excess, 0, top)


def _onset(low, of, cos):
    """V from which on a projectile of d_c breaks: V cos = of(d_c)"""
    return bisect(lambda v: v * cos - of(low(v)), 1e-3, 1e3)


def _piekutowski(shield, d):
    ratio = shield.bumper_thickness_cm / d
    return 2.60 if ratio >= 0.16 else 1.436 * ratio ** (-1 / 3)


def _jsc(shield, speed, angle, ratio_at=lambda v, high: high, thick_enough=_thick_enough):
    c = _cos(angle)

    def low(v):
        return _low(shield, c, v)
    return _between(speed, min(_onset(low, lambda d: _piekutowski(shield, d), c), HIGH / c), HIGH / c, low,
                    lambda v: _derated(shield, c, v, ratio_at(v, HIGH / c), _walls_jsc, thick_enough))


def _modjsc(shield, speed, angle):
    return _jsc(shield, speed, angle, lambda v, high: v, _thick_enough_mod)


def _reimerdes(shield, speed, angle):
    c = _cos(angle)

    def low(v):
        """[R06] (10), no perforation"""
        return ((shield.wall_thickness_cm / 1.8 + shield.bumper_thickness_cm)
                / (0.796 * 0.42 * shield.projectile_density**0.518 * (v * c) ** (2 / 3))) ** (18 / 19)
    onset = _onset(low, lambda d: 1.853 + 0.397 * (shield.bumper_thickness_cm / d) ** -0.565, c)
    return _between(speed, min(onset, HIGH / c), HIGH / c, low, lambda v: _derated(shield, c, v, HIGH / c, _walls_reimerdes, _thick_enough))


# one wall

def crater_depth(shield, diameter_cm, velocity_km_s, angle_deg=0.0):
    """cm, in a target as thick as it takes: [C09] (4-1), (4-2)"""
    ratio = shield.projectile_density / shield.wall_density
    return 5.24 * diameter_cm ** (19 / 18) * shield.wall_brinell**-0.25 * ratio ** (2 / 3 if ratio >= 1.5 else 0.5) \
        * (velocity_km_s * math.cos(math.radians(angle_deg)) / shield.wall_sound_km_s) ** (2 / 3)


def _cour_palais(factor):
    def d_c(shield, speed, angle):
        """[C09] (4-3) to (4-6); (4-2) solved for d has the exponent 2/3, too, where [RC09] (7) prints 3/2"""
        return (shield.wall_thickness_cm / (factor * crater_depth(shield, 1.0, speed, angle))) ** (18 / 19)
    return d_c


@dataclasses.dataclass(frozen=True)
class Equation:
    title: str
    source: str
    d_c: typing.Callable  # of shield, speed, angle
    valid: dict  # {what: (least, most, source)} of quantities(); beyond them it is an extrapolation
    walls: int = 2
    note: str = ""


# published tests: [RC09] table 10 and its text (S/d, t_b/d: [RC11] 3.2.1), [C93] p. 149, [CK01] p. 96; table 2 of [RC09] for one wall
_SHOTS = {"velocity_km_s": (2.5, 8, "RC09"), "angle_deg": (0, 85, "RC09"), "d_cm": (0.04, 1.9, "RC09"), "S/d": (13, 96, "RC11")}
_NNO = {**_SHOTS, "S/d": (15, 96, "C93, RC11"), "t_b rho_b/(d rho_p)": (0.18, math.inf, "C93")}
_CK = {"velocity_km_s": (2, 8, "CK01"), "angle_deg": (0, 75, "CK01"), "d_cm": (0.02, 1.9, "CK01"), "S/d": (3, 140, "CK01"), "t_b/d": (0.05, 1, "CK01")}
_JSC = {**_SHOTS, "t_b/d": (0.08, 0.64, "RC11")}
_ONE = {"velocity_km_s": (0, 8, "RC09"), "angle_deg": (0, 85, "RC09"), "d_cm": (0.05, 1.27, "RC09")}

EQUATIONS = {
    "NNO": Equation("Christiansen, new non-optimum", "C93, C09", _nno, _NNO),
    "CK01": Equation("modified NNO, as printed", "CK01", _ck01, _CK),
    "modNNO": Equation("modified NNO, as coded in pyBLOSSUM", "CK01, RS24", _modnno, _CK, note="k_h rises with thick bumpers, [CK01] has it fall with thin ones"),
    "JSC": Equation("JSC Whipple 2011", "RC11", _jsc, _JSC),
    "modJSC": Equation("JSC Whipple, modified", "RS24", _modjsc, _JSC),
    "Reimerdes": Equation("Reimerdes, no perforation", "R06", _reimerdes, {**_JSC, "angle_deg": (0, 0, "RC09")}),
    "CP-perforation": Equation("Cour-Palais, one wall: perforated", "C91, C09", _cour_palais(1.8), _ONE, walls=1),
    "CP-detached-spall": Equation("Cour-Palais, one wall: detached spall", "C91, C09", _cour_palais(2.2), _ONE, walls=1),
    "CP-attached-spall": Equation("Cour-Palais, one wall: attached spall", "C91, C09", _cour_palais(3.0), _ONE, walls=1)}


def quantities(shield, d, velocity_km_s, angle_deg):
    """what ranges of validity are of"""
    found = {"velocity_km_s": velocity_km_s, "angle_deg": angle_deg, "d_cm": d}
    if shield.walls == 2:
        found.update({"S/d": shield.standoff_cm / d, "t_b/d": shield.bumper_thickness_cm / d})
        if velocity_km_s * _cos(angle_deg) > 3:  # where the bumper is to break it
            found["t_b rho_b/(d rho_p)"] = found["t_b/d"] * shield.bumper_density / shield.projectile_density
    return found


def equations(shield):
    """names of those for a shield of so many walls"""
    return [name for name, equation in EQUATIONS.items() if equation.walls == shield.walls]


def beyond(name, shield, d, velocity_km_s, angle_deg):
    """[(what, its value or None, which limit it is beyond)]: which ranges of validity are left by a diameter"""
    found = [] if shield.aluminum else [("not all of it is aluminum", None, "")]
    here = quantities(shield, d, velocity_km_s, angle_deg)
    for what, (least, most, source) in EQUATIONS[name].valid.items():
        if what in here and not least * (1 - 1e-9) <= here[what] <= most * (1 + 1e-9):
            found.append((what, here[what], f"below {least:g} [{source}]" if here[what] < least else f"above {most:g} [{source}]"))
    return found


def critical_diameter(name, shield, velocity_km_s, angle_deg=0.0):
    """(d_c in cm: from there on the shield fails; which ranges of validity are left, as texts)"""
    equation = EQUATIONS.get(name)
    if equation is None:
        raise HVIError(f"no equation {name}; there are: {', '.join(EQUATIONS)}")
    if equation.walls != shield.walls:
        raise HVIError(f"{name} is for {equation.walls} wall{'s' * (equation.walls > 1)}, not {shield.walls}")
    if not (velocity_km_s > 0 and 0 <= angle_deg < 90):
        raise HVIError(f"{name}: speed must be above 0 and angle from 0 to below 90 degrees, not {velocity_km_s:g} km/s and {angle_deg:g}")
    if missing := [key for key in (("yield_ksi",) if shield.walls == 2 else ("brinell", "sound_km_s")) if not getattr(shield, f"wall_{key}")]:
        raise HVIError(f"{name} needs {' and '.join(missing)} among the keys of the last wall: the table of standard values has none for its material")
    d = equation.d_c(shield, velocity_km_s, angle_deg)
    return d, [what if value is None else f"{what} {value:.3g} is {limit}" for what, value, limit in beyond(name, shield, d, velocity_km_s, angle_deg)]


def curve(shield, name, speeds, angle):
    """[(d_c in mm, what is beyond its range)] over speeds"""
    found = []
    for speed in speeds:
        d, _ = critical_diameter(name, shield, speed, angle)
        found.append((10 * d, beyond(name, shield, d, speed, angle)))
    return found


def curves(shield, names, speeds, angle):
    """{equation: [(d_c in mm, is it within its ranges), ...]} over speeds"""
    return {name: [(d, not beyond) for d, beyond in curve(shield, name, speeds, angle)] for name in names}


def properties(stem):
    """(density, yield strength in ksi, speed of sound in km/s, Brinell hardness) of a material by its name, None where not known"""
    found = [key for key in PROPERTIES if re.match(re.escape(key) + r"(?![0-9A-Za-z])", stem)]
    return PROPERTIES[max(found, key=len)] if found else (None,) * 4


def _density(name):
    """g/cm^3 of a material file"""
    return 1e-3 * library.density_of(library.of_case(name), si=True)[0]


def from_case(case):
    """The Shield of a case of hvi shield. Densities: of the material files; yield_ksi, brinell, sound_km_s: of the last wall, or the table's"""
    if len(case.walls) > 2:
        raise HVIError(f"ballistic-limit equations are for one or two walls, {case.name} has {len(case.walls)}")
    if case.not_modelled:
        raise HVIError(f"the ballistic-limit equations here do not have what {case.name} names in not_modelled: {', '.join(case.not_modelled)}")
    wall, names = case.walls[-1], [library.stem(name) for name in (case.material, *(w.material for w in case.walls))]
    _, strength, sound, brinell = properties(names[-1])
    bumper = {} if len(case.walls) == 1 else {"bumper_thickness_cm": 0.1 * case.walls[0].thickness_mm, "bumper_density": _density(case.walls[0].material),
                                              "standoff_cm": 0.1 * wall.gap_mm}
    return Shield(wall_thickness_cm=0.1 * wall.thickness_mm, wall_density=_density(wall.material), projectile_density=_density(case.material),
                  wall_yield_ksi=wall.yield_ksi or strength, wall_brinell=wall.brinell or brinell, wall_sound_km_s=wall.sound_km_s or sound,
                  aluminum=all(re.match(r"Al(?:-|[0-9]{4}|99)", name) for name in names), **bumper)


# ---------------------------------------------------------------------- beside a simulation
def beside(function, *given):
    """what function(*given) says, or why equations say nothing: for tables that have more in them"""
    try:
        return function(*given)
    except HVIError as problem:
        return f"none: {problem}"


def predictions(case):
    """{equation: critical diameter, that of the case over it, what it predicts, which ranges of validity are left} of a case"""
    shield, found = from_case(case), {}
    for name in equations(shield):
        d, left = critical_diameter(name, shield, case.speed_km_s, case.angle_deg)
        ratio = 0.1 * case.diameter_mm / d
        found[name] = {"critical_diameter_mm": round(10 * d, 4), "d_over_critical": round(ratio, 4), "predicted": "fails" if ratio > 1 else "holds", "outside": left}
    return found


def said(found):
    """lines for the eye of predictions(), or of the reason why there are none"""
    if isinstance(found, str):
        return [f"equations: {found}"]
    rows = [(name, f"{of['critical_diameter_mm']:.2f}", f"{of['d_over_critical']:.2f}" + "*" * bool(of["outside"]), of["predicted"]) for name, of in found.items()]
    lines = tables.text(("equation", "critical_mm", "d/critical", "predicted"), rows).split("\n")
    lines += [f"  * {name}: {', '.join(of['outside'])}" for name, of in found.items() if of["outside"]]
    return lines + [f"  {name}: {EQUATIONS[name].note}" for name in found if EQUATIONS[name].note]


def limits(case_at, low, high, samples=200):
    """{equation: limits, low_side, outside}: values between low and high where the case is just held, below the first of them it holds or fails

    case_at: value -> case. Over speed there may be several.
    """
    @functools.cache
    def at(value):
        case = case_at(value)
        return from_case(case), case.speed_km_s, case.angle_deg, 0.1 * case.diameter_mm

    def excess(name, value):
        shield, speed, angle, diameter = at(value)
        return critical_diameter(name, shield, speed, angle)[0] - diameter

    found, values = {}, [low + (high - low) * k / samples for k in range(samples + 1)]
    for name in equations(at(low)[0]):
        holds, places = [excess(name, value) >= 0 for value in values], []
        for k in range(samples):
            if holds[k] != holds[k + 1]:
                sign = -1 if holds[k] else 1
                places.append(bisect(lambda value: sign * excess(name, value), values[k], values[k + 1]))
        left = []
        for value in places:
            shield, speed, angle, _ = at(value)
            left += critical_diameter(name, shield, speed, angle)[1]
        found[name] = {"limits": [round(value, 5) for value in places], "low_side": "holds" if holds[0] else "fails", "outside": list(dict.fromkeys(left))}
    return found


def said_of_limits(found, unit):
    """lines for the eye of limits(), or of the reason why there are none"""
    if isinstance(found, str):
        return [f"equations: {found}"]
    lines = []
    for name, of in found.items():
        state, parts = of["low_side"], []
        for value in of["limits"]:
            parts.append(f"{state} below {value:.4g} {unit}")
            state = "fails" if state == "holds" else "holds"
        lines.append(f"equation {name}: " + ", ".join([*parts, f"{state} {'above' if parts else 'throughout'}"])
                     + (f" (beyond its ranges: {', '.join(of['outside'])})" if of["outside"] else ""))
    return lines
