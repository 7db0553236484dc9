/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_SPH_SOLID_H
#define LMP_HVI_SPH_SOLID_H

#include "hvi_sph_riemann.h"

// solids, with corrected gradients: forces that bear full stress where neighbors are missing.  The
// equations are in doc/src/Howto_sph.rst

namespace HVI {

/* ----------------------------------------------------------------------
   What hangs together: sound particles of one body, as SphState::body says, and of types with tension between them.
------------------------------------------------------------------------- */

struct SphBonds {
  Vec bonded = {};    // 1: hang together
  Vec rubble = {};    // 1: would, but both have failed
  bool failed;
  Bits own;
  const double *tension;    // by type of the neighbor
  double own_tension;

  SphBonds(const SphState &i, const double *tension_in) :
      failed(i.is_rubble()), own(all_lanes(SphState::bits_of(i.body))), tension(tension_in),
      own_tension(tension ? tension[i.type()] : 1.0)
  {
  }
  inline void find(const Vec &body_j)
  {
    const Bits code = (Bits) body_j, apart = code ^ own;
    Vec tied = Vec{} + own_tension;
    if (any((apart & SphState::TYPE) != 0))
      for (int k = 0; k < LANES; k++) tied[k] = tension[SphState::type_of(body_j[k])];
    if (failed)
      rubble = where((code & SphState::RUBBLE) != 0, tied);
    else
      bonded = where((apart & (SphState::LABEL | SphState::RUBBLE)) == 0, tied);
  }

  // how much of what does not hang together counts: all of it under pressure, or while it comes
  // nearer, and of rubble in rubble; smoothly to nothing within LITTLE of rho c^2, and of c

  inline Vec touching(const SphState &i, const Vec &p_j, const Vec &c_j, const Vec &rho_j,
                      const Vec &r, const Vec &rdotv) const
  {
    static constexpr double LITTLE = 1.0e-6;
    const Vec zero = {}, one = zero + 1.0;
    const Vec c = c_j > i.c ? c_j : zero + i.c;
    const Vec stiff = i.rho * i.c * i.c + rho_j * c_j * c_j;
    Vec pushed = (i.p + p_j) / (abs(zero + i.p) + abs(p_j) + LITTLE * stiff);
    Vec nearing = -rdotv / (LITTLE * r * c + 1.0e-300);
    pushed = pushed > nearing ? pushed : nearing;
    pushed = pushed > rubble ? pushed : rubble;
    return (one - bonded) * (pushed < 0.0 ? zero : (pushed > 1.0 ? one : pushed));
  }
};

/* ----------------------------------------------------------------------
   First sweep: sums over the n near neighbors of particle i, with weights w,

     L_i = - sum_j w_j v_ij (x) F (x_ij - dt/2 v_ij),  M_i = - sum_j w_j x_ij (x) F x_ij,
     nu_i = sum_j w_j W(r, h_i),  F x_ij = grad W(r, h_i)

   with v of the middle of the step, which L belongs to: r does not change where v.(x - dt/2 v) = 0, so
   density does not in whatever turns, however few.  Sums
   of what hangs together with it to gradv; of others that are pushed or come nearer to contact,
   and of rubble in rubble.
------------------------------------------------------------------------- */

template <class Kernel, int SCENE>
static inline void sph_gradients(int i, const SphPlace &pi, const SphState *state, int n,
                                 const SphRows &laws, SphNear &near, SphGradV *gradv,
                                 SphGradV *contact, SphGradV &total)
{
  const int nlanes = sph_fill_up<Kernel>(i, pi, n, near);
  const SphTwoKernels<Kernel, SCENE> kernels(laws, pi);
  const SphState si = state[i];
  const Vec zero = {}, one = zero + 1.0;
  Vec sum_i[16] = {};
  SphBonds bonds(si, laws.row_tension);

  for (int m = 0; m < nlanes; m += LANES) {
    static constexpr int in_turn[4] = {0, 1, 2, 3};
    int j[LANES];    // what is written may be near.j for all the compiler knows
    for (int k = 0; k < LANES; k++) j[k] = near.j[m + k];
    Vec d[4], first[4];
    read_columns(near.d + m, in_turn, 0, d);
    read_columns(state, j, 0, first);
    for (int k = 0; k < LANES; k++) {
      __builtin_prefetch(gradv + j[k], 1);
      __builtin_prefetch(&gradv[j[k]].zz, 1);
    }
    const Vec r = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    Vec F_i, F_j, W_i, W_j;
    kernels.F(r, d[3], F_i, F_j);
    Vec spread_i, spread_j;
    kernels.W(r, d[3], W_i, W_j, spread_i, spread_j);
    const Vec a[6] = {si.vx - first[0], si.vy - first[1], si.vz - first[2], d[0], d[1], d[2]};

    const auto add = [&](const Vec &part_of, SphGradV *to, Vec *sums_i) {
      static constexpr int row[15] = {0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 4, 5, 3, 3, 4};
      static constexpr int column[15] = {0, 1, 2, 0, 1, 2, 0, 1, 2, 3, 4, 5, 4, 5, 5};
      const Vec w_j = part_of * first[3], w_i = part_of * si.w;
      const Vec wF_i = -w_j * F_i, wF_j = -w_i * F_j;
      Vec g_i[6], g_j[6], on_j[16];
      for (int k = 0; k < 3; k++) {
        const Vec middle = d[k] - laws.half_step * a[k];
        g_i[k] = wF_i * middle;
        g_j[k] = wF_j * middle;
        g_i[k + 3] = wF_i * d[k];
        g_j[k + 3] = wF_j * d[k];
      }
      for (int k = 0; k < 15; k++) {
        sums_i[k] += a[row[k]] * g_i[column[k]];
        on_j[k] = a[row[k]] * g_j[column[k]];
      }
      sums_i[15] += w_j * W_i;
      on_j[15] = w_i * W_j;
      for (int k = 0; k < 4; k++) add_columns(to, j, k, on_j + 4 * k);
    };

    if (SCENE & SPH_BODIES) {
      Vec second[4];
      read_columns(state, j, 1, second);
      bonds.find(second[3]);
      if (any(bonds.bonded > 0.0)) add(bonds.bonded, gradv, sum_i);
      if (any(bonds.bonded < 1.0)) {
        const Vec rdotv = d[0] * a[0] + d[1] * a[1] + d[2] * a[2];
        Vec sum_c[16] = {};
        add(bonds.touching(si, second[0], second[1], second[2], r, rdotv), contact, sum_c);
        for (int k = 0; k < 4; k++) part(contact + i, k) += sums(sum_c + 4 * k);
      }
    } else
      add(one, gradv, sum_i);
  }
  for (int k = 0; k < 4; k++) part(&total, k) += sums(sum_i + 4 * k);
}

/* ----------------------------------------------------------------------
   Second sweep: all pairs of particle i with its n near neighbors.  With T of SphTraction,
   f_i = w_i w_j (T_i grad W(r, h_i) + T_j grad W(r, h_j)); between bodies, while they push, with
   the part of T that is a pressure.  i gains what T_i works, j what T_j works.  Dissipation acts
   along the pair; it goes by the velocity in the middle of the step, as L does: of the leapfrog.
------------------------------------------------------------------------- */

template <class Kernel, int SCENE>
static inline bool sph_solid(int i, const SphPlace &pi, const SphView &records, int n,
                             const SphRows &laws, SphNear &near, SphRates &total)
{
  // where the solid is compressed, extrapolation goes with 1/(1 + COMPRESSION |tr L| r/c): any overshoot
  // of a shock would unload the solid from its yield surface

  static constexpr double COMPRESSION = 300.0;

  const int nlanes = sph_fill_up<Kernel>(i, pi, n, near);
  const SphTwoKernels<Kernel, SCENE> kernels(laws, pi);
  const SphState si = records.state[i];
  const SphTraction T_i = records.traction[i];
  const Symmetric L_i = SCENE & SPH_RIEMANN ? records.gradv[i].stretch() : Symmetric{};
  const double c_i = si.c, rho_i = si.rho, V_i = T_i.volume;
  SphBonds bonds(si, laws.row_tension);

  const Vec zero = {}, one = zero + 1.0;
  Vec fx = zero, fy = zero, fz = zero, de = zero, heat = zero, overlaps = zero;
  Vec fastest = near.fastest;

  for (int m = 0; m < nlanes; m += LANES) {
    static constexpr int in_turn[4] = {0, 1, 2, 3};
    int j[LANES];    // what is written may be near.j for all the compiler knows
    for (int k = 0; k < LANES; k++) j[k] = near.j[m + k];
    Vec d[4], first[4], second[4], T[16];
    read_columns(near.d + m, in_turn, 0, d);
    read_columns(records.state, j, 0, first);
    read_columns(records.state, j, 1, second);
    for (int k = 0; k < 4; k++) read_columns(records.traction, j, k, T + 4 * k);
    for (int k = 0; k < LANES; k++) __builtin_prefetch(records.rates + j[k], 1);
    const Vec c_j = second[1], rho_j = second[2], p_j = T[9], V_j = T[13];
    const Vec ww = si.w * first[3];
    const Vec dv[3] = {si.vx - first[0], si.vy - first[1], si.vz - first[2]};
    const Vec dv_work[3] = {T_i.vx - T[10], T_i.vy - T[11], T_i.vz - T[12]};
    const Vec rsq = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    const Vec r = sqrt(rsq);
    const Vec rdotv = d[0] * dv[0] + d[1] * dv[1] + d[2] * dv[2];
    overlaps += rsq > 0.0 ? zero : one;
    Vec F_i, F_j;
    kernels.F(r, d[3], F_i, F_j);
    const Vec F = 0.5 * (F_i + F_j);

    Vec a = zero + laws.a, b = zero + laws.b, bonded = one;
    if (SCENE & SPH_BODIES) {
      bonds.find(second[3]);
      bonded = bonds.bonded;
      for (int k = 0; k < LANES && !(SCENE & SPH_RIEMANN); k++) {
        const int jtype = SphState::type_of(second[3][k]);
        a[k] = laws.row_a[jtype];
        b[k] = laws.row_b[jtype];
      }
    }

    const Vec wF_i = bonded * ww * F_i, wF_j = bonded * ww * F_j;
    const Vec f_i[3] = {wF_i * (T_i.xx * d[0] + T_i.xy * d[1] + T_i.xz * d[2]),
                        wF_i * (T_i.yx * d[0] + T_i.yy * d[1] + T_i.yz * d[2]),
                        wF_i * (T_i.zx * d[0] + T_i.zy * d[1] + T_i.zz * d[2])};
    const Vec f_j[3] = {wF_j * (T[0] * d[0] + T[1] * d[1] + T[2] * d[2]),
                        wF_j * (T[3] * d[0] + T[4] * d[1] + T[5] * d[2]),
                        wF_j * (T[6] * d[0] + T[7] * d[1] + T[8] * d[2])};
    Vec f[3], de_i = zero, de_j = zero;
    const auto act = [&](const Vec *t_i, const Vec *t_j) {
      for (int k = 0; k < 3; k++) {
        f[k] += t_i[k] + t_j[k];
        de_i -= t_i[k] * dv_work[k];
        de_j -= t_j[k] * dv_work[k];
      }
    };
    for (Vec &component : f) component = zero;
    act(f_i, f_j);

    const Vec h = pi.h - 0.5 * d[3], soft = rsq + 0.01 * h * h;
    const Vec c_most = c_i > c_j ? zero + c_i : c_j;
    keep_fastest(SCENE & SPH_RIEMANN ? sph_signal(h, r, rdotv, c_most)
                                     : sph_signal(h, r, soft, rdotv, c_most, a, b),
                 fastest);

    // dissipation: a pressure between the two, on the area 2 V_i V_j |grad W|

    const bool nearing = any(rdotv < 0.0);
    Vec q = zero;
    if (nearing && (SCENE & SPH_RIEMANN)) {
      Vec L[8];    // as in Symmetric
      for (int k = 0; k < 2; k++) read_columns(records.gradv, j, k, L + 4 * k);
      const Vec &u = rdotv;
      const auto along = [&](const auto &xx, const auto &yy, const auto &zz, const auto &xy,
                             const auto &xz, const auto &yz) {
        return 2.0 *
            (d[0] * (xx * d[0] + 2.0 * (xy * d[1] + xz * d[2])) +
             d[1] * (yy * d[1] + 2.0 * yz * d[2]) + zz * d[2] * d[2]);
      };
      const Vec ahead_i = along(L_i.xx, L_i.yy, L_i.zz, L_i.xy, L_i.xz, L_i.yz);
      const Vec ahead_j = along(L[0], L[1], L[2], L[3], L[4], L[5]);
      const Vec p = T_i.p - p_j;
      Vec z_i, z_j;
      sph_impedances(rho_i, c_i, rho_j, c_j, r, u, p, z_i, z_j);
      const Vec c = r * (c_i < c_j ? zero + c_i : c_j);
      const Vec trace_j = -(L[0] + L[1] + L[2]);
      const double trace_i = -(L_i.xx + L_i.yy + L_i.zz);
      const Vec most = trace_i > trace_j ? zero + trace_i : trace_j;
      const Vec steep =
          c + STEEP * (u < 0.0 ? -u : zero) + COMPRESSION * rsq * (most > 0.0 ? most : zero);
      const Vec z_sum = z_i + z_j;
      const Vec inverse = 1.0 / (steep * z_sum * rsq);
      const Vec keep = 0.5 * c * inverse * rsq * z_sum;
      const Vec both = keep * (limited(u, ahead_i - u) + limited(u, ahead_j - u));
      const Vec known = u < 0.0 ? both : u;
      const Vec jump = known > u ? known - u : zero;    // what comes apart is not held
      q = z_i * z_j * inverse * steep * jump;
    } else if (nearing) {
      const Vec Pi = sph_viscosity(h, soft, rdotv, c_i + c_j, rho_i + rho_j, a, b);
      q = 0.5 * rho_i * rho_j * Pi;
    }
    const Vec VVF = 2.0 * V_i * V_j * F;
    const Vec visc = -q * VVF;
    const Vec half[3] = {0.5 * visc * d[0], 0.5 * visc * d[1], 0.5 * visc * d[2]};
    const Vec qheat = -(half[0] * dv_work[0] + half[1] * dv_work[1] + half[2] * dv_work[2]);
    act(half, half);

    if (SCENE & SPH_BODIES) {
      if (any(bonded < 1.0)) {
        const SphPush P_i = records.push[i];
        Vec P[8];
        for (int k = 0; k < 2; k++) read_columns(records.push, j, k, P + 4 * k);
        const Vec acts = P_i.p + P[6] > 0.0 ? bonds.touching(si, second[0], c_j, rho_j, r, rdotv)
                                            : zero;
        const Vec cF_i = acts * ww * F_i, cF_j = acts * ww * F_j;
        const Vec t_i[3] = {cF_i * (P_i.xx * d[0] + P_i.xy * d[1] + P_i.xz * d[2]),
                            cF_i * (P_i.xy * d[0] + P_i.yy * d[1] + P_i.yz * d[2]),
                            cF_i * (P_i.xz * d[0] + P_i.yz * d[1] + P_i.zz * d[2])};
        const Vec t_j[3] = {cF_j * (P[0] * d[0] + P[3] * d[1] + P[4] * d[2]),
                            cF_j * (P[3] * d[0] + P[1] * d[1] + P[5] * d[2]),
                            cF_j * (P[4] * d[0] + P[5] * d[1] + P[2] * d[2])};
        act(t_i, t_j);
      }
    }
    *(Vec *) (near.fx + m) = f[0];
    *(Vec *) (near.fy + m) = f[1];
    *(Vec *) (near.fz + m) = f[2];
    fx += f[0];
    fy += f[1];
    fz += f[2];
    de += de_i;
    heat += qheat;
    Vec on_j[4] = {-f[0], -f[1], -f[2], de_j};
    add_columns(records.rates, j, 0, on_j);
    Vec more[4] = {zero, qheat, zero, zero};
    add_columns(records.rates, j, 1, more);
  }

  near.fastest = fastest;
  total.fx += sum(fx);
  total.fy += sum(fy);
  total.fz += sum(fz);
  total.de += sum(de);
  total.heat += sum(heat);
  return sum(overlaps) > 0.0;
}

}    // namespace HVI

#endif
