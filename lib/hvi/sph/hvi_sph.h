/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_SPH_H
#define LMP_HVI_SPH_H

#include "hvi_sph_records.h"

// what SPH particles do to each other; no LAMMPS in here

namespace HVI {

// what a scene adds to plain hydrodynamics with one h; bits of a template parameter

enum SphScene {
  SPH_OWN_H = 1,         // particles differ in h
  SPH_BODIES = 2,        // pairs of types differ: bodies without tension, own viscosities
  SPH_DENSITY = 4,       // interface density dissipation
  SPH_RIEMANN = 8,       // Riemann problems instead of viscosity and that
  SPH_STRENGTH = 16,     // deviatoric stress; with SPH_RIEMANN only if corrected
  SPH_ARTSTRESS = 32,    // artificial stress; with SPH_STRENGTH only
  SPH_CORRECTED = 64,    // forces of stress with M^-1; with SPH_STRENGTH only
  SPH_SPACINGS = 128     // types differ in spacing; with SPH_RIEMANN without SPH_STRENGTH only
};

// laws of pairs: uniform, or from tables of type pairs (row of one type) in a scene with SPH_BODIES

struct SphLaws {
  double norm;    // of the kernel in this dimension
  int dim;
  double h;                                     // if all have the same
  double a, b;                                  // Monaghan's viscosity
  double alpha;                                 // interface density dissipation: the constant,
  int automatic;                                // or from the states on both sides
  int symmetric;                                // form of the equations
  int stock;                                    // energy split as in the package SPH
  double art_eps, art_n;                        // artificial stress
  double half;                                  // of the time step, with SPH_CORRECTED only
  const double *row_a, *row_b, *row_tension;    // by type of the neighbor; tension: 0 or 1
  const double *row_ratio, *row_weight;         // with SPH_SPACINGS only: see sph_spacings()
};

// LANES pairs, from the loop over them for the one after it, with SPH_STRENGTH only

struct SphPairs {
  Vec dx, dy, dz, dvx, dvy, dvz, w_j;
  Vec F;        // 0 where bodies are without tension between them
  Vec force;    // of pressure and viscosity, along d
  Vec de_j, drho_j, qheat;
  Vec art;    // factor of the artificial stress, with SPH_ARTSTRESS only
};

// neighbors of one particle within reach, as many as fit

struct alignas(64) SphNear {
  static constexpr int MAX = 128, SIZE = MAX + LANES;
  Vec4 d[SIZE];                           // from the neighbor to the particle; difference in h
  double force[SIZE];                     // on i along d, opposite on j
  double fx[SIZE], fy[SIZE], fz[SIZE];    // all of it, with SPH_STRENGTH only
  int j[SIZE];
  SphPairs pairs[SIZE / LANES];
  Vec fastest;    // see sph_signal(), of all pairs there have been
};

// whole vectors: fill up with particles out of reach, to which nothing happens

template <class Kernel> inline int sph_fill_up(int i, const SphPlace &pi, int n, SphNear &near)
{
  const int nlanes = (n + LANES - 1) & ~(LANES - 1);
  for (int m = n; m < nlanes; m++) {
    near.j[m] = i;
    near.d[m] = Vec4{2.0 * Kernel::support * pi.h};
  }
  return nlanes;
}

/* ----------------------------------------------------------------------
   For the time step, of pairs that approach: (c + approach + viscosity)/h, Monaghan 1992 eq 4.5 with
   the speed at which the pair approaches in place of |v|, which depends on the frame.  soft is r^2 +
   0.01 h^2, rdotv is r times the speed.
------------------------------------------------------------------------- */

HVI_INLINE Vec sph_signal(const Vec &h, const Vec &r, const Vec &soft, const Vec &rdotv,
                          const Vec &c, const Vec &a, const Vec &b)
{
  const Vec all = c * (1.0 + 0.6 * a) * r * soft - rdotv * (soft + 0.6 * b * h * r);
  return rdotv < 0.0 ? all / (h * r * soft) : Vec{};
}

// the same of Riemann problems, whose viscosity is that with a = 1 and, of shocks that are faster by
// 1.2 |u|, h mu/r = 0.6 |u| in place of b mu: particles that nearly touch do not make it larger

HVI_INLINE Vec sph_signal(const Vec &h, const Vec &r, const Vec &rdotv, const Vec &c)
{
  const Vec all = 1.6 * c * r - 1.36 * rdotv;
  return rdotv < 0.0 ? all / (h * r) : Vec{};
}

HVI_INLINE void keep_fastest(const Vec &rate, Vec &fastest)
{
  fastest = rate > fastest ? rate : fastest;
}

// grad W = F (dx,dy,dz)

template <class Kernel, int SCENE> class SphGradient {
 public:
  SphGradient(const SphLaws &laws, const SphPlace &pi) :
      norm(laws.norm), h_i(pi.h), two(laws.dim > 1), three(laws.dim > 2), h0(laws.h),
      hinv0(1.0 / laws.h), scale0(scale(hinv0))
  {
  }
  inline Vec F(const Vec &r, const Vec &dh, Vec &h) const
  {
    if (SCENE & SPH_OWN_H) {
      h = h_i - 0.5 * dh;
      const Vec hinv = 1.0 / h;
      return scale(hinv) * Kernel::template dw_q<Vec>(r * hinv);
    }
    h = Vec{} + h0;
    return scale0 * Kernel::template dw_q<Vec>(r * hinv0);
  }

 private:
  const double norm, h_i, two, three, h0, hinv0, scale0;

  // norm/h^(dim+2), without a choice
  template <class T> inline T scale(const T &hinv) const
  {
    return norm * hinv * hinv * hinv * (two * hinv + (1.0 - two)) * (three * hinv + (1.0 - three));
  }
};

/* ----------------------------------------------------------------------
   What stress adds to the pairs in near.pairs, and what they do in all to neighbors.  A loop of its
   own: in one loop with the long chain of roots and quotients from d to the
   force, processors do not see far enough ahead to keep busy.
------------------------------------------------------------------------- */

template <int SCENE>
inline void sph_strength(int i, int nlanes, double w_i, SphNear &near, SphRates *rates,
                         SphRates &total, const SphStress *stress, SphGradV *gradv,
                         const SphStress *art)
{
  const Vec zero = {};
  Vec fx = zero, fy = zero, fz = zero, de = zero;
  Vec grad[16] = {};
  const SphStress Si = stress[i];
  const SphStress Ri = SCENE & SPH_ARTSTRESS ? art[i] : SphStress{};

  for (int m = 0; m < nlanes; m += LANES) {
    int j[LANES];    // what is written may be near.j for all the compiler knows
    for (int k = 0; k < LANES; k++) j[k] = near.j[m + k];
    const SphPairs &pair = near.pairs[m / LANES];
    const Vec dx = pair.dx, dy = pair.dy, dz = pair.dz;
    const Vec dvx = pair.dvx, dvy = pair.dvy, dvz = pair.dvz;

    Vec S[8], on_j[16];
    read_columns(stress, j, 0, S);
    read_columns(stress, j, 1, S + 4);
    const Vec VVF = w_i * pair.w_j * pair.F;
    Vec S_i[6] = {zero + Si.xx, zero + Si.yy, zero + Si.zz,
                  zero + Si.xy, zero + Si.xz, zero + Si.yz};
    if (SCENE & SPH_ARTSTRESS) {
      Vec R[8];
      read_columns(art, j, 0, R);
      read_columns(art, j, 1, R + 4);
      const double R_i[6] = {Ri.xx, Ri.yy, Ri.zz, Ri.xy, Ri.xz, Ri.yz};
      for (int k = 0; k < 6; k++) {
        S[k] += pair.art * R[k];
        S_i[k] += pair.art * R_i[k];
      }
    }
    const Vec ti[3] = {S_i[0] * dx + S_i[3] * dy + S_i[4] * dz,
                       S_i[3] * dx + S_i[1] * dy + S_i[5] * dz,
                       S_i[4] * dx + S_i[5] * dy + S_i[2] * dz};
    const Vec tj[3] = {S[0] * dx + S[3] * dy + S[4] * dz, S[3] * dx + S[1] * dy + S[5] * dz,
                       S[4] * dx + S[5] * dy + S[2] * dz};
    const Vec f[3] = {pair.force * dx + VVF * (ti[0] + tj[0]),
                      pair.force * dy + VVF * (ti[1] + tj[1]),
                      pair.force * dz + VVF * (ti[2] + tj[2])};
    *(Vec *) (near.fx + m) = f[0];
    *(Vec *) (near.fy + m) = f[1];
    *(Vec *) (near.fz + m) = f[2];
    fx += f[0];
    fy += f[1];
    fz += f[2];
    de -= VVF * (ti[0] * dvx + ti[1] * dvy + ti[2] * dvz);

    Vec first[4] = {-f[0], -f[1], -f[2],
                    pair.de_j - VVF * (tj[0] * dvx + tj[1] * dvy + tj[2] * dvz)};
    Vec second[4] = {pair.drho_j, pair.qheat, zero, zero};
    add_columns(rates, j, 0, first);
    add_columns(rates, j, 1, second);

    // on i with the weight of j, on j with that of i

    const Vec a[6] = {dvx, dvy, dvz, dx, dy, dz};
    const Vec F_i = -pair.w_j * pair.F, F_j = -w_i * pair.F;
    const Vec gi[3] = {F_i * dx, F_i * dy, F_i * dz}, gj[3] = {F_j * dx, F_j * dy, F_j * dz};
    static constexpr int row[15] = {0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 4, 5, 3, 3, 4};
    static constexpr int column[15] = {0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 1, 2, 2};
    for (int k = 0; k < 15; k++) {
      grad[k] += a[row[k]] * gi[column[k]];
      on_j[k] = a[row[k]] * gj[column[k]];
    }
    on_j[15] = zero;
    for (int k = 0; k < 4; k++) add_columns(gradv, j, k, on_j + 4 * k);
  }

  total.fx += sum(fx);
  total.fy += sum(fy);
  total.fz += sum(fz);
  total.de += sum(de);
  for (int k = 0; k < 4; k++) part(gradv + i, k) += sums(grad + 4 * k);
}

/* ----------------------------------------------------------------------
   All pairs of particle i with its n near neighbors, LANES at a time.  Adds what
   happens to i to total and what happens to its neighbors to rates.  near is filled
   up to whole vectors with particles out of reach, for which all comes out as 0.
   Returns whether a neighbor is at the same place.

   With V = m/rho, g = v_ij.grad W_ij, form sum (Zisis et al. eqs 9, 13, with
   q = rho_i rho_j Pi for the viscosity) and form symmetric (as in the package
   SPH) differ in weights only:

     sum:       f_i = - V_i V_j (p_i + p_j) grad W - m_i m_j Pi grad W
                dE_i = V_i V_j p_i g + m_i m_j Pi g / 2      drho_i = rho_i V_j g
     symmetric: f_i = - m_i m_j (p_i/rho_i^2 + p_j/rho_j^2) grad W - m_i m_j Pi grad W
                dE_i = m_i m_j p_i/rho_i^2 g + m_i m_j Pi g / 2     drho_i = m_j g

   so that the internal energies of a pair gain what its kinetic energy loses.
   The package SPH gives either particle half of it (stock).

   Solids (form sum only) have the deviatoric stress S besides, tension positive:
     f_i += V_i V_j (S_i + S_j) grad W     dE_i -= V_i V_j v_ij.S_i grad W
     L_i -= V_j v_ij (x) grad W            M_i -= V_j x_ij (x) grad W
   With SPH_ARTSTRESS, S + w(r)^n art takes the place of S in the first line: art has the
   factor w(dp)^-n of f^n in it.
------------------------------------------------------------------------- */

template <class Kernel, int SCENE>
inline bool sph_interact(int i, const SphPlace &pi, const SphState *state, int n,
                         const SphLaws &laws, SphNear &near, SphRates *rates, SphRates &total,
                         const SphStress *stress = nullptr, SphGradV *gradv = nullptr,
                         const SphStress *art = nullptr)
{
  const int nlanes = sph_fill_up<Kernel>(i, pi, n, near);
  const SphGradient<Kernel, SCENE> gradient(laws, pi);

  // weights of the two forms: rho V/w, p/P and V/w are 1 or a power of rho

  const double sym = laws.symmetric, add = 1.0 - sym;
  const double own = laws.stock ? 0.5 : 1.0, others = 1.0 - own;

  const SphState si = state[i];
  const double w_i = si.w, P_i = si.p, c_i = si.c, rho_i = si.rho, z_i = rho_i * c_i;
  const double rhow_i = add * rho_i + sym;
  const double p_i = P_i * (add + sym * rho_i * rho_i);
  const double V_i = w_i * (add + sym / rho_i);

  const Vec zero = {}, one = zero + 1.0;
  Vec fx = zero, fy = zero, fz = zero, de = zero, drho = zero, heat = zero, overlaps = zero;
  Vec fastest = near.fastest;

  for (int m = 0; m < nlanes; m += LANES) {
    static constexpr int in_turn[4] = {0, 1, 2, 3};
    const int *const j = near.j + m;
    Vec d[4], first[4], second[4];
    read_columns(near.d + m, in_turn, 0, d);
    read_columns(state, j, 0, first);
    read_columns(state, j, 1, second);
    if (SCENE & SPH_STRENGTH)
      for (int k = 0; k < LANES; k++) {
        __builtin_prefetch(rates + j[k], 1);
        __builtin_prefetch(stress + j[k]);
        __builtin_prefetch(gradv + j[k], 1);
        __builtin_prefetch(&gradv[j[k]].zz, 1);
      }
    const Vec w_j = first[3], P_j = second[0], c_j = second[1], rho_j = second[2];
    const Vec dx = d[0], dy = d[1], dz = d[2];
    const Vec rsq = dx * dx + dy * dy + dz * dz;
    const Vec r = sqrt(rsq);
    overlaps += rsq > 0.0 ? zero : one;

    Vec h;
    const Vec F = gradient.F(r, d[3], h);

    const Vec dvx = si.vx - first[0], dvy = si.vy - first[1], dvz = si.vz - first[2];
    const Vec rdotv = dx * dvx + dy * dvy + dz * dvz;
    const Vec g = rdotv * F;
    const Vec rhow_j = add * rho_j + sym;
    const Vec p_j = P_j * (add + sym * rho_j * rho_j);

    // bodies without tension between them push, but do not pull, nor do they stretch each other

    Vec a = zero + laws.a, b = zero + laws.b, bonded = one, acts = one, stretch = one;
    if (SCENE & SPH_BODIES) {
      for (int k = 0; k < LANES; k++) {
        const int jtype = static_cast<int>(second[3][k]);
        a[k] = laws.row_a[jtype];
        b[k] = laws.row_b[jtype];
        bonded[k] = laws.row_tension[jtype];
      }
      acts = p_i + p_j > 0.0 ? one : bonded;
      stretch = rdotv < 0.0 ? one : acts;
    }

    // Monaghan 1992, for pairs that approach: mu = h v.x/(r^2 + 0.01 h^2),
    // Pi = (b mu^2 - a c_ij mu)/rho_ij; the means over i and j and all quotients in one

    const Vec hv = h * (rdotv < 0.0 ? rdotv : zero);
    const Vec soft = rsq + 0.01 * h * h;
    const Vec Pi = hv * (2.0 * b * hv - a * (c_i + c_j) * soft) / (soft * soft * (rho_i + rho_j));
    const Vec visc = w_i * rhow_i * w_j * rhow_j * Pi;
    keep_fastest(sph_signal(h, r, soft, rdotv, c_i > c_j ? zero + c_i : c_j, a, b), fastest);

    const Vec ww = acts * w_i * w_j;
    const Vec press_i = ww * P_i, press_j = ww * P_j;
    const Vec force = -(press_i + press_j + visc) * F;
    const Vec qheat = 0.5 * visc * g;
    *(Vec *) (near.force + m) = force;

    Vec drho_i = stretch * rhow_i * w_j * g, drho_j = stretch * rhow_j * w_i * g;
    if (SCENE & SPH_DENSITY) {
      // Zisis et al. eqs 22-25 with a constant; or what the contact of the acoustic Riemann
      // problem between i and j moves, less what is a wave within a body, |dp| = z |dv|
      const Vec V_j = w_j * (add + sym / rho_j);
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

    de += (own * press_i + others * press_j) * g + qheat;
    drho += drho_i;
    heat += qheat;
    const Vec de_j = (others * press_i + own * press_j) * g + qheat;

    if (SCENE & SPH_STRENGTH) {
      Vec art_factor = zero;
      if (SCENE & SPH_ARTSTRESS) art_factor = pow(Kernel::template w<Vec>(r / h), laws.art_n);
      near.pairs[m / LANES] = {dx,         dy,    dz,   dvx,    dvy,   dvz,       w_j,
                               bonded * F, force, de_j, drho_j, qheat, art_factor};
      continue;
    }
    const Vec f[3] = {force * dx, force * dy, force * dz};
    fx += f[0];
    fy += f[1];
    fz += f[2];
    for (int k = 0; k < 3; k++) first[k] = -f[k];
    first[3] = de_j;
    second[0] = drho_j;
    second[1] = qheat;
    second[2] = second[3] = zero;
    add_columns(rates, j, 0, first);
    add_columns(rates, j, 1, second);
  }
  if (SCENE & SPH_STRENGTH)
    sph_strength<SCENE>(i, nlanes, w_i, near, rates, total, stress, gradv, art);

  near.fastest = fastest;
  total.fx += sum(fx);
  total.fy += sum(fy);
  total.fz += sum(fz);
  total.de += sum(de);
  total.drho += sum(drho);
  total.heat += sum(heat);
  return sum(overlaps) > 0.0;
}

}    // namespace HVI

#endif
