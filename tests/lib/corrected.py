"""Forces, density and energy of solids, written out in NumPy for all pairs (doc/src/Howto_sph.rst).

Each particle has its own kernel, grad W(r, h_i) = F_i x_ij, and the weight w = V (rho/rho0)^(1/3), V = m/rho. Sums over those who hang together
with i ("own") are M_i = - sum w_j x_ij (x) grad W_i, L_i = - sum w_j v_ij (x) grad W_i, nu_i = w_i W(0, h_i) + sum w_j W(r, h_i); "all" has
besides other bodies and rubble that come nearer or push, and the rubble in rubble. With inverses K of M,

  T_i = V_i/w_i ((S_i - s_i) K_own - q_i K_all),  P_i = - V_i/w_i q_i K_all,  f_ij = w_i w_j (T_i F_i + T_j F_j) x_ij (others, while they push: P)
  drho_i = - rho_i tr(L_all K_all),  de_i = V_i ((S_i - s_i) : L_own K_own - q_i tr(L_own K_all)), and what the push of others does.

q_i = p_i - s_i; s_i = M^4 : S_i/tr M^4 in contact, M of the others, times min(1, 4 nu_others/nu_all). Artificial stress acts on the mean of
both gradients, with volumes as weights and the mean of h; the dissipation of density at interfaces likewise.
"""

from dataclasses import dataclass

import numpy as np
from sph_scenes import SUPPORT, norm, shape


@dataclass
class Solid:
    """a state of particles; S: deviators (n, 3, 3); c: of longitudinal waves; box: period by direction, 0 for none"""

    x: np.ndarray
    v: np.ndarray
    m: np.ndarray
    rho: np.ndarray
    rho0: np.ndarray
    p: np.ndarray
    S: np.ndarray
    c: np.ndarray
    h: np.ndarray
    kind: np.ndarray
    failed: np.ndarray
    box: np.ndarray
    kernel: str = "cubic"
    dim: int = 3

    def mirrored(self, k, at):
        """with the images of all in the plane x_k = at"""
        flip = np.ones(3)
        flip[k] = -1
        new = {a: np.concatenate([getattr(self, a)] * 2) for a in ("m", "rho", "rho0", "p", "c", "h", "kind", "failed")}
        x = np.concatenate([self.x, self.x * flip + 2 * at * (1 - flip) / 2])
        return Solid(x=x, v=np.concatenate([self.v, self.v * flip]), S=np.concatenate([self.S, self.S * np.outer(flip, flip)]), **new,
                     box=self.box, kernel=self.kernel, dim=self.dim)


def inverse(M, nu, full, dim):
    """of M/nu, over nu: where an eigenvalue is below 0.3 less and less, below 0.15 not at all; 1 of what is nearly alone; and the eigenvalues"""
    value, axis = np.linalg.eigh(M[:, :dim, :dim] / nu[:, None, None])
    s = np.clip((value - 0.15) / 0.15, 0, 1)
    s = s * s * (3 - 2 * s)
    g = 1 - s + s / np.maximum(value, 0.15)
    out = np.zeros_like(M)
    out[:, :dim, :dim] = np.einsum("nak,nk,nbk->nab", axis, g, axis) / nu[:, None, None]
    counts = np.clip((full - 0.2) / 0.15, 0, 1)
    counts = (counts**2 * (3 - 2 * counts))[:, None, None]
    out[:, :dim, :dim] = counts * out[:, :dim, :dim] + (1 - counts) * np.eye(dim)
    return out, value


def artificial(S, p):
    """of the whole stress the tensile principal part (Gray, Monaghan & Swift 2001), by its eigenvalues"""
    value, axis = np.linalg.eigh(S - p[:, None, None] * np.eye(3))
    return np.einsum("nak,nk,nbk->nab", axis, np.maximum(value, 0), axis)


def rates(s, tension=True, visc=(1.0, 2.0), art=None, alpha=None):
    """f, drho, de, and the eigenvalues of M/nu of those who hang together; alpha: of the interface, a number or "auto"; art: eps, n, and the h of pair_coeff, of each particle"""
    n, V = len(s.x), s.m / s.rho
    w = V * np.cbrt(s.rho / s.rho0)
    reach = SUPPORT[s.kernel] * s.h
    i, j = np.nonzero(close(s, reach.max()))
    d = s.x[i] - s.x[j]
    d -= s.box * np.round(d / np.where(s.box > 0, s.box, np.inf))
    r = np.sqrt((d**2).sum(1))
    near = r < np.maximum(reach[i], reach[j])
    i, j, d, r = i[near], j[near], d[near], r[near]
    scale = norm(s.kernel, s.dim) / s.h**s.dim
    W_i = scale[i] * shape(s.kernel, r / s.h[i])[0]
    F_i, F_j = (scale[k] / s.h[k] * shape(s.kernel, r / s.h[k])[1] / r for k in (i, j))
    u = s.v[i] - s.v[j]
    ur = (u * d).sum(1)

    together = np.full(len(i), True) if tension else s.kind[i] == s.kind[j]
    own = together & ~s.failed[i] & ~s.failed[j]
    stiff = s.rho * s.c**2
    pushed = (s.p[i] + s.p[j]) / (np.abs(s.p[i]) + np.abs(s.p[j]) + 1e-6 * (stiff[i] + stiff[j]))
    nearing = -ur / (1e-6 * r * np.maximum(s.c[i], s.c[j]))
    others = ~own * np.clip(np.maximum(np.maximum(pushed, nearing), together & s.failed[i] & s.failed[j]), 0, 1)

    def total(a):
        out = np.zeros((n,) + a.shape[1:])
        np.add.at(out, i, a)
        return out

    def sums(who):
        g = (-w[j] * F_i * who)[:, None, None]
        L, M = (total(g * a[:, :, None] * d[:, None, :]) for a in (u, d))
        nu = w * scale * shape(s.kernel, np.zeros(n))[0] + total(w[j] * W_i * who)
        return L, M, nu, *inverse(M, nu, V / w * nu, s.dim)

    L_own, _, _, K_own, value = sums(own)
    L_all, M_all, nu_all, K_all, _ = sums(own + others)
    _, M_others, nu_others, _, _ = sums(others)
    nu_others -= w * scale * shape(s.kernel, np.zeros(n))[0]
    fourth = np.linalg.matrix_power(M_others, 4)
    size = np.trace(fourth, axis1=1, axis2=2)
    normal = np.einsum("nab,nab->n", fourth, s.S) / np.where(size > 0, size, 1.0) * np.minimum(1, 4 * nu_others / nu_all)
    pushing = s.p - np.where((nu_others > 0) & ~s.failed, normal, 0.0)
    rest = s.S + (pushing - s.p)[:, None, None] * np.eye(3)
    P = -(V / w * pushing)[:, None, None] * K_all
    T = (V / w)[:, None, None] * rest @ K_own + P
    push = others * (pushing[i] + pushing[j] > 0)

    def apply(A, k, F):  # w_i w_j F_k A_k x_ij
        return (w[i] * w[j] * F)[:, None] * np.einsum("kab,kb->ka", A[k], d)

    f = own[:, None] * (apply(T, i, F_i) + apply(T, j, F_j)) + push[:, None] * (apply(P, i, F_i) + apply(P, j, F_j))
    work = push * (apply(P, i, F_i) * u).sum(1)

    # Monaghan's viscosity, with the means of h, of grad W, of c and of rho
    h = 0.5 * (s.h[i] + s.h[j])
    mu = np.where(ur < 0, h * ur / (r**2 + 0.01 * h**2), 0.0)
    Pi = (-visc[0] * 0.5 * (s.c[i] + s.c[j]) * mu + visc[1] * mu**2) / (0.5 * (s.rho[i] + s.rho[j]))
    q = s.m[i] * s.m[j] * Pi * 0.5 * (F_i + F_j)
    de = V * (np.einsum("nab,nab->n", rest, L_own @ K_own) - pushing * np.einsum("nab,nab->n", L_own, K_all))
    out = dict(f=total(f - q[:, None] * d), drho=-s.rho * np.einsum("nab,nab->n", L_all, K_all), de=de + total(0.5 * q * ur - work), own=value)
    F = 0.5 * (F_i + F_j)
    if art:
        eps, power, h0 = art
        R = -eps * artificial(s.S, s.p) / (shape(s.kernel, (s.m / s.rho0) ** (1 / s.dim) / h0)[0] ** power)[:, None, None]
        factor = (own * V[i] * V[j] * F * shape(s.kernel, r / h)[0] ** power)[:, None]
        f_i, f_j = (factor * np.einsum("kab,kb->ka", R[k], d) for k in (i, j))
        out["f"] += total(f_i + f_j)
        out["de"] -= total((f_i * u).sum(1))
    if alpha:
        c, z, dp = 0.5 * (s.c[i] + s.c[j]), s.rho * s.c, s.p[i] - s.p[j]
        alpha_i = alpha
        if alpha == "auto":
            wave = together * np.minimum(z[i], z[j]) * np.sqrt((u**2).sum(1))
            alpha_i = 2 * s.rho[i] * c / (z[i] + z[j]) * np.maximum(0, np.abs(dp) - wave) / np.where(dp == 0, 1, np.abs(dp))
        out["drho"] += total(alpha_i * dp / c * V[j] * F * r * (together | (s.p[i] + s.p[j] > 0)))
    return out


def close(s, reach):
    """pairs (n, n) not farther from each other than reach, by coordinates"""
    near = ~np.eye(len(s.x), dtype=bool)
    for a in range(3):
        d = s.x[:, None, a] - s.x[None, :, a]
        if s.box[a] > 0:
            d -= s.box[a] * np.round(d / s.box[a])
        near &= np.abs(d) < reach
    return near
