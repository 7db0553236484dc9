/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_SPH_RIEMANN_H
#define LMP_HVI_SPH_RIEMANN_H

#include "hvi_sph_pairs.h"

// dissipation riemann: the equations are in doc/src/Howto_sph.rst

namespace HVI {

// of types of the neighbors: their h to that of i's, and by how much they count more than i itself in
// its density, w_j/w_i: see PairHVISPH::find_weights()

template <int SCENE>
static inline void sph_spacings(const SphRows &laws, const Vec &body_j, Vec &ratio, Vec &weight)
{
  ratio = weight = Vec{} + 1.0;
  if (SCENE & SPH_SPACINGS)
    for (int k = 0; k < LANES; k++) {
      const int jtype = SphState::type_of(body_j[k]);
      ratio[k] = laws.row_ratio[jtype];
      weight[k] = laws.row_weight[jtype];
    }
}

/* ----------------------------------------------------------------------
   Sums for the gradients of particle i and its n near neighbors, as sph_fluid:
     d_a v_b = - sum_j V_j v_ij,b d_a W_ij,  d_a p = - sum_j V_j (p_i - p_j) d_a W_ij
   with the mean of both kernels.  Not normalized: where neighbors are missing gradients are too
   small, and dissipation is larger.
------------------------------------------------------------------------- */

template <class Kernel, int SCENE>
static inline void sph_slopes(int i, const SphPlace &pi, const SphState *state, int n,
                              const SphRows &laws, SphNear &near, SphSlopes *slopes,
                              SphSlopes &total)
{
  const int nlanes = sph_fill_up<Kernel>(i, pi, n, near);
  const SphTwoKernels<Kernel, SCENE> kernels(laws, pi);
  const SphState si = state[i];
  Vec sum_i[SphSlopes::SENT] = {};

  for (int m = 0; m < nlanes; m += LANES) {
    const int *const j = near.j + m;
    Vec d[4], first[4], second[4];
    read_columns(near.d + m, IN_TURN, 0, d);
    read_columns(state, j, 0, first);
    read_columns(state, j, 1, second);
    const Vec r = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    Vec F_i, F_j, W_i, W_j, spread_i = {}, spread_j = {};
    Vec ratio, weight;
    sph_spacings<SCENE>(laws, second[3], ratio, weight);
    kernels.F(r, d[3], F_i, F_j, ratio);
    kernels.W(r, d[3], W_i, W_j, spread_i, spread_j, ratio);
    const Vec F = -0.5 * (F_i + F_j);
    const Vec vx = F * (si.vx - first[0]), vy = F * (si.vy - first[1]), vz = F * (si.vz - first[2]);
    const Vec p = F * (si.p - second[0]);
    const Vec product[9] = {vx * d[0],
                            vy * d[1],
                            vz * d[2],
                            0.5 * (vx * d[1] + vy * d[0]),
                            0.5 * (vx * d[2] + vz * d[0]),
                            0.5 * (vy * d[2] + vz * d[1]),
                            p * d[0],
                            p * d[1],
                            p * d[2]};
    const Vec w_j = first[3];
    Vec on_j[9];
    for (int k = 0; k < 9; k++) {
      sum_i[k] += w_j * product[k];
      on_j[k] = si.w * product[k];
    }
    add_columns(slopes, j, 0, on_j);
    add_columns(slopes, j, 1, on_j + 4);
    add_column(slopes, j, &SphSlopes::pz, on_j[8]);
    if (SCENE & SPH_SPACINGS) {
      const Vec less = 1.0 / weight;
      W_i *= weight;
      W_j *= less;
      spread_i *= weight;
      spread_j *= less;
    }
    sum_i[9] += W_i;
    add_column(slopes, j, &SphSlopes::n, W_j);
    if (SCENE & SPH_OWN_H) {
      sum_i[10] += spread_i;
      add_column(slopes, j, &SphSlopes::spread, spread_j);
    }
  }

  double *const sums = &total.xx;
  for (int k = 0; k < SphSlopes::SENT; k++) sums[k] += sum(sum_i[k]);
}

// van Leer's monotonized central limiter: the mean of both differences, at most twice either, 0 if
// their signs differ

static inline Vec limited(const Vec &a, const Vec &b)
{
  const Vec least = abs(a) < abs(b) ? abs(a) : abs(b), mean = 0.5 * abs(a + b);
  const Vec size = mean < 2.0 * least ? mean : 2.0 * least;
  return a * b > 0.0 ? (a > 0.0 ? size : -size) : Vec{};
}

// less extrapolation of velocity in shocks, against overshoot

static constexpr double STEEP = 1.5;

/* ----------------------------------------------------------------------
   Impedances of either side, times r: each is hit by a shock of the velocity which the problem of sounds would
   give, and shocks are faster by A |velocity|: (gamma + 1)/2 = 1.2 in diatomic gas, 1.2 to 1.5 in metals.
   u = r (U_i - U_j), p = p_i - p_j.
------------------------------------------------------------------------- */

HVI_INLINE void sph_impedances(double rho_i, double c_i, const Vec &rho_j, const Vec &c_j,
                               const Vec &r, const Vec &u, const Vec &p, Vec &z_i, Vec &z_j)
{
  static constexpr double A = 1.2;
  const Vec zero = {};
  const Vec za_i = zero + rho_i * c_i, za_j = rho_j * c_j, zainv = 1.0 / (za_i + za_j);
  const Vec push_i = -zainv * (za_j * u + p * r), push_j = zainv * (p * r - za_i * u);
  z_i = za_i * r + rho_i * A * (push_i > 0.0 ? push_i : zero);
  z_j = za_j * r + rho_j * A * (push_j > 0.0 ? push_j : zero);
}

/* ----------------------------------------------------------------------
   All pairs of particle i with its n near neighbors, as sph_fluid.

   Half-way between i and j meet the states which either extrapolates: U, velocity
   along d, and p.  Of their acoustic Riemann problem, with impedances
   z = rho (c + A |speed into the shock|), come p* and v*.  With delta = v* - (v_i + v_j)/2 along
   d, and with G_i = w_j V_i/(n_i Omega_i) grad W(r, h_i), n_i = sum_j w_j W(x_ij, h_i),
   Omega_i = 1 + h_i/(dim n_i) sum_j w_j dW/dh(x_ij, h_i), volumes U_i = V_i/w_i:

     f_i = - p* (G_i + G_j)
     dE_i = p* (G_i.v_ij - (G_i + G_j).delta)
     drho_i/rho_i = (G_i/V_i).v_ij - w_j K.delta/Omega_i
     K = 2 Q_i Q_j/(Q_i + Q_j) (grad W(r, h_i) + grad W(r, h_j))

   Without delta, drho_i/rho_i is dn_i/n_i with the changes of h; what delta moves is
   antisymmetric, times the weights w.  These are constants of types, 1 but with SPH_SPACINGS.
   So density behind a shock is that of the particles there, however sharp the shock, which is
   not so with volumes V_j as weights; and forces and energies follow from it (Hu & Adams,
   J. Comput. Phys. 213 (2006) 844, have them for h = const).
------------------------------------------------------------------------- */

template <class Kernel, int SCENE>
static inline bool sph_riemann(int i, const SphPlace &pi, const SphState *state,
                               const SphSlopes *slopes, int n, const SphRows &laws, SphNear &near,
                               SphRates *rates, SphRates &total)
{
  const int nlanes = sph_fill_up<Kernel>(i, pi, n, near);
  const SphTwoKernels<Kernel, SCENE> kernels(laws, pi);
  const SphState si = state[i];
  const SphSlopes own = slopes[i];
  const double V_i = si.w, rho_i = si.rho, c_i = si.c, p_i = si.p;

  const Vec zero = {}, one = zero + 1.0;
  Vec fx = zero, fy = zero, fz = zero, de = zero, drho = zero, heat = zero, overlaps = zero;
  Vec fastest = near.fastest;

  for (int m = 0; m < nlanes; m += LANES) {
    const int *const j = near.j + m;
    Vec d[4], first[4], second[4], other[8];
    read_columns(near.d + m, IN_TURN, 0, d);
    read_columns(state, j, 0, first);
    read_columns(state, j, 1, second);
    for (int k = 0; k < 2; k++) read_columns(slopes, j, k, other + 4 * k);
    const Vec other_pz = read_column(slopes, j, &SphSlopes::pz);
    const Vec dx = d[0], dy = d[1], dz = d[2];
    const Vec V_j = first[3], p_j = second[0], c_j = second[1], rho_j = second[2];
    const Vec rsq = dx * dx + dy * dy + dz * dz;
    const Vec r = sqrt(rsq);
    overlaps += rsq > 0.0 ? zero : one;
    Vec F_i, F_j, ratio, weight;
    sph_spacings<SCENE>(laws, second[3], ratio, weight);
    kernels.F(r, d[3], F_i, F_j, ratio);

    const Vec h = SCENE & SPH_OWN_H ? pi.h - 0.5 * d[3] : zero + laws.h;

    // velocities along d times r: u = r (U_i - U_j); and the differences beyond i and beyond j

    const Vec u = dx * (si.vx - first[0]) + dy * (si.vy - first[1]) + dz * (si.vz - first[2]);
    sph_signal(h, r, u, c_i > c_j ? zero + c_i : c_j, fastest);
    const Vec p = p_i - p_j;
    const Vec xx = 2.0 * dx * dx, yy = 2.0 * dy * dy, zz = 2.0 * dz * dz;
    const Vec xy = 4.0 * dx * dy, xz = 4.0 * dx * dz, yz = 4.0 * dy * dz;
    const Vec ahead_i =
        own.xx * xx + own.yy * yy + own.zz * zz + own.xy * xy + own.xz * xz + own.yz * yz;
    const Vec ahead_j = other[0] * xx + other[1] * yy + other[2] * zz + other[3] * xy +
        other[4] * xz + other[5] * yz;
    const Vec ahead_pi = 2.0 * (own.px * dx + own.py * dy + own.pz * dz);
    const Vec ahead_pj = 2.0 * (other[6] * dx + other[7] * dy + other_pz * dz);

    Vec z_i, z_j;
    sph_impedances(rho_i, c_i, rho_j, c_j, r, u, p, z_i, z_j);

    // all other quotients in one

    const Vec c = r * (c_i < c_j ? zero + c_i : c_j);
    const Vec steep = c + STEEP * (u < 0.0 ? -u : zero), z_sum = z_i + z_j;
    const Vec V_sum = SCENE & SPH_SPACINGS ? weight * V_i + V_j : V_i + V_j;
    const Vec left = steep * z_sum, right = rsq * V_sum, inverse = 1.0 / (left * right);
    const Vec keep = 0.5 * c * inverse * right * z_sum;    // c/steep
    const Vec zinv = inverse * right * steep;              // 1/z_sum
    const Vec squareinv = inverse * left * V_sum;          // 1/r^2
    const Vec Vinv = inverse * left * rsq;                 // 1/V_sum

    const Vec u_i = keep * limited(u, ahead_i - u), u_j = keep * limited(u, ahead_j - u);
    const Vec dp_i = 0.5 * limited(p, ahead_pi - p), dp_j = 0.5 * limited(p, ahead_pj - p);

    // p* and delta r

    const Vec jump = u_i + u_j - u;
    const Vec viscous = z_i * z_j * zinv * squareinv * jump;
    Vec pstar = zinv * (z_j * (p_i - dp_i) + z_i * (p_j + dp_j)) + viscous;
    Vec delta = zinv * (0.5 * (z_i - z_j) * u + z_j * u_j - z_i * u_i + rsq * (dp_i + dp_j - p));

    // bodies without tension between them push, but do not pull, nor do they stretch each other

    Vec stretch = u;
    if (SCENE & SPH_BODIES) {
      Vec bonded;
      for (int k = 0; k < LANES; k++) bonded[k] = laws.row_tension[SphState::type_of(second[3][k])];
      const Vec acts = pstar > 0.0 ? one : bonded;
      pstar *= acts;
      delta *= acts;
      stretch = u < 0.0 ? u : acts * u;
    }

    const double by_n_i = own.by_n_omega(), by_omega_i = SCENE & SPH_OWN_H ? own.by_omega() : 1.0;
    const Vec by_n_j = read_column(slopes, j, SphSlopes::BY_N_OMEGA);
    const Vec by_omega_j = SCENE & SPH_OWN_H ? read_column(slopes, j, SphSlopes::BY_OMEGA) : one;
    const Vec counts_i = SCENE & SPH_SPACINGS ? weight * F_i : F_i;
    const Vec counts_j = SCENE & SPH_SPACINGS ? F_j / weight : F_j;
    const Vec G_i = V_i * by_n_i * counts_i, G_j = V_j * by_n_j * counts_j, G = G_i + G_j;
    const Vec force = -pstar * G;
    *(Vec *) (near.force + m) = force;
    const Vec E_i = pstar * (G_i * u - G * delta), E_j = pstar * (G_j * u + G * delta);
    const Vec flow = 2.0 * V_i * V_j * Vinv * (F_i + F_j) * delta;
    const Vec qheat = 0.5 * viscous * G * u;
    const Vec f[3] = {force * dx, force * dy, force * dz};
    fx += f[0];
    fy += f[1];
    fz += f[2];
    de += E_i;
    const Vec flow_i = SCENE & SPH_SPACINGS ? weight * flow : flow;
    drho += rho_i * (by_n_i * counts_i * stretch - by_omega_i * flow_i);
    heat += qheat;

    for (int k = 0; k < 3; k++) first[k] = -f[k];
    first[3] = rho_j * (by_n_j * counts_j * stretch + by_omega_j * flow);
    second[0] = E_j;
    second[1] = second[2] = zero;
    second[3] = qheat;
    add_columns(rates, j, 0, first);
    add_columns(rates, j, 1, second);
  }

  near.fastest = fastest;
  total.fx += sum(fx);
  total.fy += sum(fy);
  total.fz += sum(fz);
  total.de_x += sum(de);
  total.drho += sum(drho);
  total.heat += sum(heat);
  return sum(overlaps) > 0.0;
}

}    // namespace HVI

#endif
