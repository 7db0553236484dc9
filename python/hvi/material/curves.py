# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Curves of a material file: Hugoniot, isentrope, temperature, yield stress, spall strength; the laws of lib/hvi/material in NumPy.

All in SI, or in the units of a file in units lj. tests/python/test_material.py holds them to what LAMMPS computes.
"""

import numpy as np

from ..errors import HVIError
from . import library

STEPS = 400  # of the isentrope, per unit of compression


class Eos:
    """The equation of state of a Material: p(rho, e), temperature, shocks and the isentrope from the reference state."""

    def __init__(self, material):
        self.law = material.laws("eos")[0]
        self.v = material.in_si(("eos", self.law))
        if self.law in ("table", "idealgas"):
            raise HVIError(f"{material.path}: no curves of eos {self.law}: " + ("LAMMPS checks tables when it reads them" if self.law == "table" else
                                                                                "a gas has no reference density to start from"))
        v = self.v
        self.rho0, self.cp, self.T0 = v["rho0"], v.get("cp", 0.0), v.get("T0", 300.0)
        stiff = library.STIFF.get(self.law)
        self.c0 = np.sqrt(v[stiff] / v["rho0"]) if stiff else v.get("C", v.get("c0"))

    def pressure(self, rho, e):
        v, rho, e = self.v, np.asarray(rho, float), np.asarray(e, float)
        mu, eta = rho / self.rho0 - 1.0, 1.0 - self.rho0 / rho
        if self.law == "linear":
            return v["K"] * mu + 0.0 * e
        if self.law == "tait":
            return self.rho0 * v["c0"] ** 2 / v["gamma"] * ((rho / self.rho0) ** v["gamma"] - 1.0) + 0.0 * e
        if self.law == "polynomial":
            gamma = np.where(mu > 0.0, v["B0"] + mu * (v["B1"] + mu * v["B2"]), v["B0"])
            cold = mu * (v["A1"] + mu * (v["A2"] + mu * v["A3"]))
            return self._expanded(rho, np.where(mu > 0.0, cold, mu * ((v["T1"] or v["A1"]) + mu * v["T2"])) + gamma * self.rho0 * e, v["B0"])
        if self.law == "tillotson":
            return self._tillotson(rho, e)
        g0, a = v["g0"], v.get("a", 0.0)
        k = max(2.0 * a / max(g0, 1e-30) - 1.0, 0.0)  # hvi_eos_gruneisen.h
        gamma = g0 + a * mu / (1.0 - k * np.minimum(mu, 0.0))
        stiff = self.rho0 * v["C"] ** 2
        squeezed = stiff * eta / self.ratio(eta) ** 2 * (1.0 - 0.5 * gamma * eta)
        return self._expanded(rho, np.where(eta > 0.0, squeezed, stiff * mu) + gamma * self.rho0 * e, max(g0 - a, 0.5 * g0))

    def _expanded(self, rho, p, thin):
        """hvi_eos_expansion.h; thin: Gamma rho/rho0 that the law's line has at density 0"""
        x, h = np.minimum(rho / self.rho0, 1.0), 2.0 / 3.0 / thin if 3.0 * thin > 2.0 / 3.0 else 3.0
        return p * np.where(p > 0.0, 1.0 - (1.0 - x) ** 2 * (1.0 + (2.0 - h) * x), 1.0)

    def ratio(self, eta):
        """C/Us of the cubic Hugoniot"""
        v = self.v
        return 1.0 - eta * (v["S1"] + eta * (v.get("S2", 0.0) + eta * v.get("S3", 0.0)))

    def _tillotson(self, rho, e):
        v, x = self.v, rho / self.rho0
        mu, z = x - 1.0, 1.0 / x - 1.0
        heat = v["b"] * rho * e / np.where(e > 0.0, 1.0 + e / (v["E0"] * x * x), 1.0)
        dense = v["a"] * rho * e + heat + mu * (v["A"] + v["B"] * mu)
        vapor = v["a"] * rho * e + (heat + v["A"] * mu * np.exp(-v["beta"] * z)) * np.exp(-v["alpha"] * z * z)
        part = np.where(x < 1.0, np.clip((e - v["Eiv"]) / (v["Ecv"] - v["Eiv"]), 0.0, 1.0), 0.0)
        return np.where(part > 0.0, part * vapor, 0.0) + (1.0 - part) * dense

    def last_eta(self):
        """the compression 1 - rho0/rho where the law ends: hvi_eos_hugoniot.h"""
        if "S1" not in self.v:
            return 0.999
        eta = np.linspace(0.0, 1.0, 10001)[:-1]
        ratio, gamma = self.ratio(eta), self.v["g0"] + self.v.get("a", 0.0) * eta / (1.0 - eta)
        past = np.flatnonzero((ratio[1:] <= 0.01) | (np.diff(ratio) > 0.0) | (gamma * eta >= 2.0)[1:])
        return eta[past[0]] if past.size else eta[-1]

    def hugoniot(self, up):
        """(Us, p, rho, e) behind shocks into the reference state, where the Rayleigh line meets the law; NaN where it does not"""
        up = np.asarray(up, float)
        low, high = np.zeros(up.shape), np.full(up.shape, self.last_eta())
        for _ in range(60):  # u is Us eta, and grows with eta
            eta = 0.5 * (low + high)
            if "S1" in self.v:  # u = C eta/(C/Us), and the law is made of that
                below = self.v["C"] * eta < up * self.ratio(eta)
            else:
                below = self.pressure(self.rho0 / (1.0 - eta), 0.5 * up * up) * eta < self.rho0 * up * up
            low, high = np.where(below, eta, low), np.where(below, high, eta)
        Us = np.where(high < self.last_eta(), up / eta, np.nan)
        return Us, self.rho0 * Us * up, self.rho0 / (1.0 - up / Us), 0.5 * up * up + 0.0 * Us

    def isentrope(self, eta):
        """(p, e, T) on the isentrope through the reference state at compressions eta >= 0, which increase; T is NaN without cp, all are where eta is"""
        def slope(x, e, T):
            rho = self.rho0 / (1.0 - x)
            de = 1e-6 * self.c0**2
            p, more, less = self.pressure(rho, np.array([e, e + de, e - de]))  # one call: most of the time is NumPy's overhead
            return p / self.rho0, (more - less) / (2.0 * de) / self.rho0 * T

        found, x, e, T = [], 0.0, 0.0, self.T0
        for end in np.atleast_1d(np.asarray(eta, float)):
            if np.isnan(end):
                found.append((np.nan,) * 3)
                continue
            n = max(int(np.ceil((end - x) * STEPS)), 1)
            d = (end - x) / n
            for _ in range(n):
                k1 = slope(x, e, T)
                k2 = slope(x + d / 2, e + d / 2 * k1[0], T + d / 2 * k1[1])
                k3 = slope(x + d / 2, e + d / 2 * k2[0], T + d / 2 * k2[1])
                k4 = slope(x + d, e + d * k3[0], T + d * k3[1])
                e += d / 6 * (k1[0] + 2 * (k2[0] + k3[0]) + k4[0])
                T += d / 6 * (k1[1] + 2 * (k2[1] + k3[1]) + k4[1])
                x += d
            found.append((float(self.pressure(self.rho0 / (1.0 - end), e)), e, T if self.cp else np.nan))
        return np.array(found).T

    def temperature(self, rho, e):
        """at densities that increase; below rho0 it is T0 + e/cp"""
        if not self.cp:
            return np.full(np.broadcast(rho, e).shape, np.nan)
        rho, e = np.broadcast_arrays(np.asarray(rho, float), np.asarray(e, float))
        _, es, Ts = self.isentrope(np.maximum(1.0 - self.rho0 / np.atleast_1d(rho), 0.0))
        return np.maximum(Ts.reshape(rho.shape) + (e - es.reshape(rho.shape)) / self.cp, 0.0)


def melting(law, v, eta=1.0):
    """melting temperature of a law of strength at rho = eta rho0; infinite where it has none"""
    if law == "steinberg-guinan":
        return v["Tm0"] * np.exp(2.0 * v["a"] * (1.0 - 1.0 / eta)) * eta ** (2.0 * (v["g0"] - v["a"] - 1.0 / 3.0))
    return v.get("Tm", np.inf)


def yield_stress(law, v, eps, rate, T=300.0, p=0.0, eta=1.0):
    """of a law of strength with values v, at plastic strain eps, its rate, temperature, pressure and rho = eta rho0"""
    eps, rate, T = np.broadcast_arrays(*(np.asarray(x, float) for x in (eps, rate, T)))
    hard = np.zeros(eps.shape)
    if law == "johnson-cook":
        faster = 1.0 + v["C"] * np.log(np.maximum(rate / v["epsdot0"], 1.0))
        if v.get("D"):
            faster = faster + (rate / v["D"]) ** (1.0 / v["p"])
        hard = (v["A"] + v["B"] * eps ** v["n"]) * faster * (1.0 - np.clip((T - v["Tref"]) / (v["Tm"] - v["Tref"]), 0.0, 1.0) ** v["m"])
    elif law == "steinberg-guinan":
        stiff = np.maximum(1.0 + v["A"] * p / eta ** (1.0 / 3.0) - v["B"] * (T - 300.0), 0.0)
        hard = np.minimum(v["Y0"] * (1.0 + v["beta"] * eps) ** v["n"], v["Ymax"]) * stiff
    elif law == "cowper-symonds":
        hard = v["Y0"] * (1.0 + (rate / v["D"]) ** (1.0 / v["p"]))
    elif law == "zerilli-armstrong":
        active = np.exp(np.minimum(T * (v["C4"] * np.log(np.maximum(rate / v["epsdot0"], 1.0)) - v["C3"]), 0.0))
        hard = v["C0"] + (v["C5"] * eps ** v["n"] if v["C5"] else 0.0) + (v["C1"] + v["C2"] * np.sqrt(eps)) * active
    elif law == "perfect":
        hard = v["Y"] + hard
    return np.where(T < melting(law, v, eta), hard, 0.0)


def at_rest(law, v):
    """the yield stress without strain, slow, at the law's reference temperature"""
    return float(yield_stress(law, v, 0.0, 0.0, v.get("Tref", 300.0)))


def borne(material, rate, sigma=None, steps=250):
    """largest tension that spall voids bears in matter without shear strength that is stretched by 1 + rate t; with sigma in place of the file's

    Equations (1) to (3) of hvi_spall_voids.h, implicit as there; the error of the steps is below 0.3 %.
    phi_c is the file's, whatever the spacing: delta_c is left out.
    """
    eos, v = Eos(material), material.in_si(("spall", "voids"))
    rate = np.asarray(rate, float)
    sigma = np.asarray(v["sigma"] if sigma is None else sigma, float)
    stretch = 1.5 * (sigma * (rate / v["rate"]) ** v["m"] / (eos.rho0 * eos.c0**2) + v["phi_c"]) / steps
    phi = D = e = most = np.zeros(np.broadcast(rate, sigma).shape)
    for k in range(1, steps + 1):
        rho, bears = eos.rho0 / (1.0 + k * stretch), sigma * np.maximum(1.0 - D, 1e-9)
        low, high = phi, np.maximum(phi, 1.0 - rho / eos.rho0)  # of the voids at the end of the step
        for _ in range(20):
            middle = 0.5 * (low + high)
            tension = np.maximum(-(1.0 - middle) * eos.pressure(rho / (1.0 - middle), e), 0.0)
            grows = bears * (np.log((1.0 - phi) / (1.0 - middle)) * rate / (stretch * v["rate"])) ** v["m"] < tension
            low, high = np.where(grows, middle, low), np.where(grows, high, middle)
        most = np.where(D < 1.0, np.maximum(most, tension), most)
        e = e + tension * stretch / eos.rho0
        phi, D = high, D + (high - phi) / v["phi_c"]
        if np.all(D >= 1.0):
            break
    return most


def sigma_for(material, strength, rate):
    """sigma of spall voids with which what is stretched at that rate bears that strength, phi_c as it is"""
    v = material.in_si(("spall", "voids"))
    sigma = strength * (v["rate"] / rate) ** v["m"]
    for _ in range(4):
        sigma = sigma * strength / borne(material, rate, sigma)
    return float(sigma)


def spall_strength(material, law, rate):
    """tension over strain rate at which a law of spall lets go, as Howto_laws has it"""
    v, rate = material.in_si(("spall", law)), np.asarray(rate, float)
    if law == "limit":
        return v["sigma_p"] + 0.0 * rate
    if law == "voids":
        return v["sigma"] * (rate / v["rate"]) ** v["m"]
    eos = Eos(material)
    stiff = eos.rho0 * eos.c0**2
    if law == "tuler-butcher":  # stress that grows as M rate t, M = rho0 c0^2
        return v["sigma_0"] + ((v["lambda"] + 1.0) * v["K"] * stiff * rate) ** (1.0 / (v["lambda"] + 1.0))
    strength = [name for name in material.laws("strength") if name != "none"]
    if not strength:
        raise HVIError(f"{material.path}: spall grady needs a section strength")
    return np.sqrt(2.0 * stiff * at_rest(strength[0], material.in_si(("strength", strength[0]))) * v["eps_c"]) + 0.0 * rate


def shock_table(material, n=8):
    """(names, rows) of the Hugoniot up to a particle velocity of 1.2 c0"""
    eos = Eos(material)
    up = np.linspace(0.0, 1.2 * eos.c0, n + 1)[1:]
    Us, p, rho, e = eos.hugoniot(up)
    T = eos.temperature(rho, e)
    si = material.units != "lj"
    names = ("u_m_s", "Us_m_s", "p_GPa", "rho_kg_m3", "T_K") if si else ("u", "Us", "p", "rho", "T")
    columns = (up, Us, p / (1e9 if si else 1.0), rho, T)[:5 if eos.cp else 4]
    return names[:len(columns)], [list(map(float, row)) for row in zip(*columns)]
