/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_SPH_FLUID_H
#define LMP_HVI_SPH_FLUID_H

#include "hvi_sph_pairs.h"

// fluids with viscosity, form sum

namespace HVI {

/* ----------------------------------------------------------------------
   All pairs of particle i with its n near neighbors, LANES at a time.  Adds what
   happens to i to total and what happens to its neighbors to rates.  near is filled
   up to whole vectors with particles out of reach, for which all comes out as 0.
   Returns whether a neighbor is at the same place.

   With V = m/rho, g = v_ij.grad W_ij (Zisis et al. eqs 9, 13, with q = rho_i rho_j Pi for
   the viscosity):

     f_i = - V_i V_j (p_i + p_j) grad W - m_i m_j Pi grad W
     dE_i = V_i V_j p_i g + m_i m_j Pi g / 2      drho_i = rho_i V_j g

   so that the internal energies of a pair gain what its kinetic energy loses.
------------------------------------------------------------------------- */

template <class Kernel, int SCENE>
static inline bool sph_fluid(int i, const SphPlace &pi, const SphState *state, int n,
                             const SphRows &laws, SphNear &near, SphRates *rates, SphRates &total)
{
  const int nlanes = sph_fill_up<Kernel>(i, pi, n, near);
  const SphMeanKernel<Kernel, SCENE> kernel(laws, pi);
  const SphState si = state[i];
  const double V_i = si.w, p_i = si.p, c_i = si.c, rho_i = si.rho, z_i = rho_i * c_i;

  const Vec zero = {}, one = zero + 1.0;
  Vec fx = zero, fy = zero, fz = zero, de = zero, drho = zero, heat = zero, overlaps = zero;
  Vec fastest = near.fastest;

  for (int m = 0; m < nlanes; m += LANES) {
    const int *const j = near.j + m;
    Vec d[4], first[4], second[4];
    read_columns(near.d + m, IN_TURN, 0, d);
    read_columns(state, j, 0, first);
    read_columns(state, j, 1, second);
    const Vec V_j = first[3], p_j = second[0], c_j = second[1], rho_j = second[2];
    const Vec dx = d[0], dy = d[1], dz = d[2];
    const Vec rsq = dx * dx + dy * dy + dz * dz;
    const Vec r = sqrt(rsq);
    overlaps += rsq > 0.0 ? zero : one;

    Vec h;
    const Vec F = kernel.F(r, d[3], h);

    const Vec dvx = si.vx - first[0], dvy = si.vy - first[1], dvz = si.vz - first[2];
    const Vec rdotv = dx * dvx + dy * dvy + dz * dvz;
    const Vec g = rdotv * F;

    // bodies without tension between them push, but do not pull, nor do they stretch each other

    Vec a = zero + laws.a, b = zero + laws.b, bonded = one, acts = one, stretch = one;
    if (SCENE & SPH_BODIES) {
      for (int k = 0; k < LANES; k++) {
        const int jtype = SphState::type_of(second[3][k]);
        a[k] = laws.row_a[jtype];
        b[k] = laws.row_b[jtype];
        bonded[k] = laws.row_tension[jtype];
      }
      acts = p_i + p_j > 0.0 ? one : bonded;
      stretch = rdotv < 0.0 ? one : acts;
    }

    const Vec soft = rsq + 0.01 * h * h;
    const Vec Pi = sph_viscosity(h, soft, rdotv, c_i + c_j, rho_i + rho_j, a, b);
    const Vec visc = V_i * rho_i * V_j * rho_j * Pi;
    sph_signal(h, r, soft, rdotv, sph_speed(laws.unlike, si, c_j, rho_j, V_j), a, b, fastest);

    const Vec VV = acts * V_i * V_j;
    const Vec press_i = VV * p_i, press_j = VV * p_j;
    const Vec force = -(press_i + press_j + visc) * F;
    const Vec qheat = 0.5 * visc * g;
    *(Vec *) (near.force + m) = force;

    Vec drho_i = stretch * rho_i * V_j * g, drho_j = stretch * rho_j * V_i * g;
    if (SCENE & SPH_DENSITY) {
      // Zisis et al. eqs 22-25 with a constant; or what the contact of the acoustic Riemann
      // problem between i and j moves, less what is a wave within a body, |dp| = z |dv|
      const Vec z_j = rho_j * c_j, dp = p_i - p_j, size = abs(dp);
      const Vec dv = sqrt(dvx * dvx + dvy * dvy + dvz * dvz);
      const Vec wave = bonded * (z_i < z_j ? zero + z_i : z_j) * dv;
      const Vec excess = (size > wave ? size - wave : zero) / (size + 1.0e-300);
      const Vec by_states = laws.automatic * excess / (z_i + z_j);
      const Vec constant = laws.alpha / (c_i + c_j);
      const Vec phi = 2.0 * acts * dp * F * r;
      drho_i += phi * V_j * (constant + by_states * rho_i);
      drho_j -= phi * V_i * (constant + by_states * rho_j);
    }

    const Vec f[3] = {force * dx, force * dy, force * dz};
    fx += f[0];
    fy += f[1];
    fz += f[2];
    de += press_i * g + qheat;
    drho += drho_i;
    heat += qheat;
    for (int k = 0; k < 3; k++) first[k] = -f[k];
    first[3] = drho_j;
    second[0] = press_j * g + qheat;
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
