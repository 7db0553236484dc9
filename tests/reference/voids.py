"""Matter without shear strength in which voids grow, stretched at a constant rate: ordinary differential equations, independent of the C++ sources.

The equation of state is Grueneisen's as written in Howto_laws, with the constants of potentials/Al6061-T6.hvi.
"""

import numpy as np
from scipy.integrate import solve_ivp

RHO0, C0, G0, A = 2703.0, 5240.0, 1.97, 0.48  # of potentials/Al6061-T6.hvi
SHEAR, S1 = 27.6e9, 1.40
CL = np.sqrt(C0**2 + 4 / 3 * SHEAR / RHO0)


def constants(root, metal="Al6061-T6"):
    """sigma, rate, m, phi_c of the section spall voids of potentials/METAL.hvi"""
    words = [line.split("#")[0].split() for line in (root / "potentials" / f"{metal}.hvi").read_text().splitlines()]
    words = [w for w in words if w]
    start = words.index(["spall", "voids"])
    section = {}
    for w in words[start + 1:]:
        if w[0] in ("eos", "strength", "damage", "spall", "thermal"):
            break
        section[w[0]] = float(w[1])
    return section


def law(k, epsdot):
    """matter without shear strength that is stretched by 1 + epsdot t: largest tension, energy per volume at rest when D = 1, strain then

    phi is the voids' part of the volume, p = (1 - phi) p_eos(rho/(1 - phi), e),
    phi'/(1 - phi) = rate (-p/(sigma (1 - D)))^(1/m), D' = phi'/phi_c.
    """

    def pressure(t, y):
        phi, D, e = y
        mu = 1 / ((1 + epsdot * t) * (1 - phi)) - 1
        cold = RHO0 * C0**2 * mu
        if mu > 0:
            eta = mu / (1 + mu)
            cold *= (1 + (1 - G0 / 2) * mu - A / 2 * mu**2) / ((1 + mu) * (1 - S1 * eta)) ** 2
        return (1 - phi) * (cold + (G0 + A * mu) * RHO0 * e)

    def slope(t, y):
        p = pressure(t, y)
        grow = (1 - y[0]) * k["rate"] * (max(-p, 0.0) / (k["sigma"] * max(1 - y[1], 1e-9))) ** (1 / k["m"])
        return [grow, grow / k["phi_c"], -p * epsdot / RHO0]

    def failed(t, y):
        return y[1] - (1 - 1e-6)

    failed.terminal = True
    s = solve_ivp(slope, (0, 0.5 / epsdot), [0, 0, 0], "Radau", events=failed, rtol=1e-8, atol=[1e-14, 1e-12, 1e-8], max_step=1e-4 / epsdot)
    assert s.t_events[0].size
    p = [pressure(t, y) for t, y in zip(s.t, s.y.T)]
    return -min(p), RHO0 * s.y[2, -1], epsdot * s.t[-1]
