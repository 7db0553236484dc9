"""Exact solution of the shock tube in an ideal gas (E. F. Toro, Riemann Solvers and Numerical Methods for Fluid Dynamics,
chapter 4)."""

import numpy as np


def star(left, right, gamma=1.4):
    """pressure and velocity between the waves; left, right: (rho, u, p)"""

    def change(p, state):
        """of velocity across the wave from p_k to p, and its derivative; p > p_k: shock, else rarefaction"""
        rho, _, pk = state
        if p > pk:
            a, b = 2 / ((gamma + 1) * rho), (gamma - 1) / (gamma + 1) * pk
            root = np.sqrt(a / (p + b))
            return (p - pk) * root, root * (1 - 0.5 * (p - pk) / (p + b))
        c = np.sqrt(gamma * pk / rho)
        power = (p / pk) ** ((gamma - 1) / (2 * gamma))
        return 2 * c / (gamma - 1) * (power - 1), power * c / (gamma * p)

    p = 0.5 * (left[2] + right[2])
    for _ in range(100):  # Newton; the function is concave and rises
        (f, df), (g, dg) = change(p, left), change(p, right)
        step = (f + g + right[1] - left[1]) / (df + dg)
        p = max(p - step, 1e-3 * p)
        if abs(step) < 1e-14 * p:
            break
    return p, 0.5 * (left[1] + right[1] + change(p, right)[0] - change(p, left)[0])


def solution(s, left, right, gamma=1.4):
    """rho, u, p at the speeds s = (x - x0)/t"""
    ps, us = star(left, right, gamma)
    s = np.asarray(s, dtype=float)
    # the right half is the left half of the mirrored problem
    out = np.empty((3, len(s)))
    for (rho, u, p), sign in ((left, 1), (right, -1)):
        half = s <= us if sign > 0 else s > us
        x, u, um = sign * s[half], sign * u, sign * us
        c = np.sqrt(gamma * p / rho)
        if ps > p:
            q, g = ps / p, (gamma - 1) / (gamma + 1)
            behind = x > u - c * np.sqrt((gamma + 1) / (2 * gamma) * q + (gamma - 1) / (2 * gamma))
            now = np.where(behind, [[rho * (q + g) / (g * q + 1)], [um], [ps]], [[rho], [u], [p]])
        else:
            cm = c * (ps / p) ** ((gamma - 1) / (2 * gamma))
            inside = np.clip(2 / (gamma + 1) + (gamma - 1) / ((gamma + 1) * c) * (u - x), cm / c, 1)
            fan_u = u + 2 * c / (gamma - 1) * (1 - inside)
            now = np.array([rho * inside ** (2 / (gamma - 1)), fan_u, p * inside ** (2 * gamma / (gamma - 1))])
        out[:, half] = now * np.array([[1], [sign], [1]])
    return out
