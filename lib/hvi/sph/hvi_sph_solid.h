/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_SPH_SOLID_H
#define LMP_HVI_SPH_SOLID_H

#include "hvi_sph_riemann.h"
#include "hvi_sph_touching.h"

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
   Either sweep goes twice over the neighbors of a particle: what is one number of a pair is worked out for LANES pairs
   at a time; what has components, pair by pair with these in one vector, which adds to records as they are.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   First sweep: sums over the n near neighbors of particle i, with weights w and F x_ij = grad W(r, h_i),

     L_i = - sum_j w_j v_ij (x) F x_ij,  H_i = - sum_j w_j x_ij (x) F x_ij

   of the middle of the step, all of them (but for h), where x is x - dt/2 v: with F and w of the end density behind a
   shock is wrong in proportion to the step.  v.x is 0 there where r stays, so density stays in whatever turns, however
   few.  And, at the end of the step, M like H and nu_i = sum_j w_j W(r, h_i).  Sums of what hangs together with it
   to gradv; of others that are pushed or come nearer, and of rubble in rubble, to touching.
------------------------------------------------------------------------- */

template <class Kernel, int SCENE>
static inline void sph_gradients(int i, const SphPlace &pi, const SphState *state, int n,
                                 const SphRows &laws, SphNear &near, SphGradV *gradv,
                                 SphTouching *touching, SphGradV &total)
{
  const int nlanes = sph_fill_up<Kernel>(i, pi, n, near);
  const SphTwoKernels<Kernel, SCENE> kernels(laws, pi);
  const SphState si = state[i];
  const double weight = gradv[i].weight;
  const Vec zero = {};
  SphBonds bonds(si, laws.row_tension);
  bool touches = false;

  for (int m = 0; m < nlanes; m += LANES) {
    const int *const j = near.j + m;
    Vec d[4], first[4], middle[3];
    read_columns(near.d + m, IN_TURN, 0, d);
    read_columns(state, j, 0, first);
    for (int k = 0; k < LANES; k++) {
      __builtin_prefetch(gradv + j[k], 1);
      __builtin_prefetch(&gradv[j[k]].zx, 1);
      __builtin_prefetch(&gradv[j[k]].mxx, 1);
    }
    const Vec v[3] = {si.vx - first[0], si.vy - first[1], si.vz - first[2]};
    for (int k = 0; k < 3; k++) middle[k] = d[k] - laws.half_step * v[k];
    const Vec r = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    const Vec r_middle =
        sqrt(middle[0] * middle[0] + middle[1] * middle[1] + middle[2] * middle[2]);
    Vec F_i, F_j, H_i, H_j, W_i, W_j, spread_i, spread_j;
    kernels.F(r_middle, d[3], H_i, H_j);
    kernels.F(r, d[3], F_i, F_j);
    kernels.W(r, d[3], W_i, W_j, spread_i, spread_j);
    Vec w_j = first[3], w_i = zero + si.w;
    if (SCENE & SPH_BODIES) {
      Vec second[4];
      read_columns(state, j, 1, second);
      bonds.find(second[3]);
      Vec share = bonds.bonded;
      if (any(share < 1.0)) {
        const Vec rdotv = d[0] * v[0] + d[1] * v[1] + d[2] * v[2];
        const Vec touching_share = bonds.touching(si, second[0], second[1], second[2], r, rdotv);
        touches = touches || any(touching_share > 0.0);
        share += touching_share;
      }
      *(Vec *) (near.bonded + m) = bonds.bonded;
      *(Vec *) (near.share + m) = share;
      w_j *= share;
      w_i *= share;
    }
    *(Vec *) (near.middle_i + m) = -w_j * H_i;    // but for the weight of j
    *(Vec *) (near.middle_j + m) = -weight * w_i * H_j;
    *(Vec *) (near.weight_i + m) = -w_j * F_i;
    *(Vec *) (near.weight_j + m) = -w_i * F_j;
    *(Vec *) (near.nu_i + m) = w_j * W_i;
    *(Vec *) (near.nu_j + m) = w_i * W_j;
  }

  // a record: rows of v (x) x, each with a product of H, which are off its diagonal; x (x) x on it, and W; M

  const Vec4 v_i = part(&si, 0);
  Vec4 own[6] = {};
  const auto add = [&](bool bonded, const auto &record) {
    for (int m = 0; m < n; m++) {
      if ((SCENE & SPH_BODIES) && (near.share[m] == 0.0 || (near.bonded[m] > 0.0) != bonded))
        continue;
      const int j = near.j[m];
      const Vec4 d = near.d[m], v = v_i - part(&state[j], 0), x = d - laws.half_step * v;
      const Vec4 with_y = with_last(x, x[1]), with_z = with_last(x, x[2]);
      const Vec4 row[6] = {
          with_last(of_four(v[0]), x[0]) * with_y, with_last(of_four(v[1]), x[0]) * with_z,
          with_last(of_four(v[2]), x[1]) * with_z, with_last(x * x, 1.0),
          with_last(d, d[0]) * with_last(d, d[1]), d * Vec4{d[2], d[2], 0.0, 0.0}};
      const Vec4 middle_i = of_four(near.middle_i[m]) * of_four(gradv[j].weight),
                 middle_j = of_four(near.middle_j[m]);
      const Vec4 end_i = of_four(near.weight_i[m]), end_j = of_four(near.weight_j[m]);
      const Vec4 on_i[6] = {middle_i, middle_i, middle_i, with_last(middle_i, near.nu_i[m]),
                            end_i,    end_i},
                 on_j[6] = {middle_j, middle_j, middle_j, with_last(middle_j, near.nu_j[m]),
                            end_j,    end_j};
      SphGradV *const other = record(j);
      for (int k = 0; k < 6; k++) {
        own[k] += on_i[k] * row[k];
        part(other, k) += on_j[k] * row[k];
      }
    }
  };
  add(true, [=](int j) {
    return gradv + j;
  });
  for (int k = 0; k < 6; k++) part(&total, k) += own[k];
  if (!touches) return;
  for (Vec4 &sum : own) sum = Vec4{};
  add(false, [=](int j) {
    return &touching->at(j).sums;
  });
  for (int k = 0; k < 6; k++) part(&touching->at(i).sums, k) += own[k];
}

/* ----------------------------------------------------------------------
   Second sweep: all pairs of particle i with its n near neighbors.  With T of SphTraction,
   f_i = w_i w_j (T_i grad W(r, h_i) + T_j grad W(r, h_j)); between bodies, while they push, with
   the part of T that is a pressure.  i gains what T_i works, j what T_j works.  Dissipation acts
   along the pair; it goes by the velocity in the middle of the step, as L does: of the leapfrog.
------------------------------------------------------------------------- */

// T d, and the same of what pushes; the last place has nothing that means anything

HVI_INLINE Vec4 sph_times(const SphTraction &T, const Vec4 &d)
{
  return part(&T, 0) * of_four(d[0]) + part(&T, 1) * of_four(d[1]) + part(&T, 2) * of_four(d[2]);
}

HVI_INLINE Vec4 sph_times(const SphPush &P, const Vec4 &d)
{
  const Vec4 x = {P.xx, P.xy, P.xz, 0.0}, y = {P.xy, P.yy, P.yz, 0.0}, z = {P.xz, P.yz, P.zz, 0.0};
  return x * of_four(d[0]) + y * of_four(d[1]) + z * of_four(d[2]);
}

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
  Vec overlaps = zero, heat = zero, fastest = near.fastest;

  for (int m = 0; m < nlanes; m += LANES) {
    const int *const j = near.j + m;
    Vec d[4], first[4], second[4];
    read_columns(near.d + m, IN_TURN, 0, d);
    read_columns(records.state, j, 0, first);
    read_columns(records.state, j, 1, second);
    for (int k = 0; k < LANES; k++) __builtin_prefetch(records.rates + j[k], 1);
    const Vec c_j = second[1], rho_j = second[2];
    const Vec ww = si.w * first[3];
    const Vec rsq = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    const Vec r = sqrt(rsq);
    const Vec rdotv =
        d[0] * (si.vx - first[0]) + d[1] * (si.vy - first[1]) + d[2] * (si.vz - first[2]);
    overlaps += rsq > 0.0 ? zero : one;
    Vec F_i, F_j;
    kernels.F(r, d[3], F_i, F_j);

    Vec a = zero + laws.a, b = zero + laws.b, share = one;
    if (SCENE & SPH_BODIES) {
      bonds.find(second[3]);
      *(Vec *) (near.bonded + m) = share = bonds.bonded;
      for (int k = 0; k < LANES && !(SCENE & SPH_RIEMANN); k++) {
        const int jtype = SphState::type_of(second[3][k]);
        a[k] = laws.row_a[jtype];
        b[k] = laws.row_b[jtype];
      }
      if (any(share < 1.0)) {
        Vec push = zero + records.touching->of(i).push.p;
        for (int k = 0; k < LANES; k++) push[k] += records.touching->of(j[k]).push.p;
        if (any(push > 0.0))
          share += push > 0.0 ? bonds.touching(si, second[0], c_j, rho_j, r, rdotv) : zero;
      }
    }
    *(Vec *) (near.weight_i + m) = share * ww * F_i;
    *(Vec *) (near.weight_j + m) = share * ww * F_j;

    const Vec h = pi.h - 0.5 * d[3], soft = rsq + 0.01 * h * h;
    const Vec c_most = sph_speed(laws.unlike, si, c_j, rho_j, first[3]);
    if (SCENE & SPH_RIEMANN)
      sph_signal(h, r, rdotv, c_most, fastest);
    else
      sph_signal(h, r, soft, rdotv, c_most, a, b, fastest);

    // dissipation: a pressure between the two, on the area 2 V_i V_j |grad W|

    Vec pull = zero, qheat = zero;
    if (any(rdotv < 0.0)) {
      Vec q;
      if (SCENE & SPH_RIEMANN) {
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
        const Vec p = T_i.p - read_column(records.traction, j, &SphTraction::p);
        Vec z_i, z_j;
        sph_impedances(rho_i, c_i, rho_j, c_j, r, u, p, z_i, z_j);
        const Vec c = r * (c_i < c_j ? zero + c_i : c_j);
        const Vec trace_j = -(L[0] + L[1] + L[2]);
        const double trace_i = -(L_i.xx + L_i.yy + L_i.zz);
        const Vec most = trace_i > trace_j ? zero + trace_i : trace_j;
        const Vec steep =
            c + STEEP * (u < 0.0 ? -u : zero) + COMPRESSION * rsq * (most > 0.0 ? most : zero);
        const Vec all = (z_i + z_j) * rsq, inverse = 1.0 / (steep * all);
        const Vec keep = 0.5 * c * inverse * all;
        const Vec both = keep * (limited(u, ahead_i - u) + limited(u, ahead_j - u));
        const Vec known = u < 0.0 ? both : u;
        const Vec jump = known > u ? known - u : zero;    // what comes apart is not held
        q = z_i * z_j * inverse * steep * jump;
      } else
        q = 0.5 * rho_i * rho_j * sph_viscosity(h, soft, rdotv, c_i + c_j, rho_i + rho_j, a, b);
      const Vec V_j = read_column(records.traction, j, &SphTraction::volume);
      Vec v_j[4];
      read_columns(records.traction, j, 3, v_j);
      pull = -0.5 * q * V_i * V_j * (F_i + F_j);
      qheat =
          -pull * (d[0] * (T_i.vx - v_j[0]) + d[1] * (T_i.vy - v_j[1]) + d[2] * (T_i.vz - v_j[2]));
      heat += qheat;
    }
    *(Vec *) (near.pull + m) = pull;
    *(Vec *) (near.heat + m) = qheat;
  }

  const Vec4 v_i = part(&T_i, 3);
  Vec4 force = {}, energy = {};
  for (int m = 0; m < n; m++) {
    const int j = near.j[m];
    const Vec4 d = near.d[m], half = of_four(near.pull[m]) * d;
    Vec4 f_i = half, f_j = half;
    if (!(SCENE & SPH_BODIES) || near.bonded[m] > 0.0) {
      f_i += of_four(near.weight_i[m]) * sph_times(T_i, d);
      f_j += of_four(near.weight_j[m]) * sph_times(records.traction[j], d);
    } else if (near.weight_i[m] != 0.0 || near.weight_j[m] != 0.0) {
      f_i += of_four(near.weight_i[m]) * sph_times(records.touching->of(i).push, d);
      f_j += of_four(near.weight_j[m]) * sph_times(records.touching->of(j).push, d);
    }
    const Vec4 f = with_last(f_i + f_j, 0.0), v = v_i - part(&records.traction[j], 3);
    near.f[m] = f;
    force += f;
    energy -= f_i * v;
    SphRates *const other = records.rates + j;
    part(other, 0) -= f;
    part(other, 1) -= with_last(f_j * v, -near.heat[m]);
  }

  near.fastest = fastest;
  part(&total, 0) += force;
  part(&total, 1) += with_last(energy, sum(heat));
  return sum(overlaps) > 0.0;
}

}    // namespace HVI

#endif
