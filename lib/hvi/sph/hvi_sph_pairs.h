/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_SPH_PAIRS_H
#define LMP_HVI_SPH_PAIRS_H

#include "hvi_sph.h"
#include "hvi_sph_records.h"

#include <algorithm>

// what the vectorized loops have in common: neighbors in vectors, kernels, viscosity, signals

namespace HVI {

// laws of the pairs of one particle: uniform, or from rows of tables of type pairs, by type of the neighbor

struct SphRows : SphLaws {
  double half_step;                             // with SPH_SOLID only
  const double *row_a, *row_b, *row_tension;    // with SPH_BODIES; tension: 0 or 1
  const double *row_ratio, *row_weight;         // with SPH_SPACINGS: see sph_spacings()
};

// neighbors of one particle within reach, as many as fit

struct alignas(64) SphNear {
  static constexpr int MAX = 128, SIZE = MAX + LANES;
  Vec4 d[SIZE];          // from the neighbor to the particle; difference in h
  double force[SIZE];    // on i along d, opposite on j; without SPH_SOLID

  // with SPH_SOLID: what is one number of a pair; and the force on i

  double middle_i[SIZE], middle_j[SIZE], weight_i[SIZE], weight_j[SIZE], nu_i[SIZE], nu_j[SIZE],
      bonded[SIZE], share[SIZE];
  double pull[SIZE], heat[SIZE];
  Vec4 f[SIZE];
  int j[SIZE];

  Vec fastest;    // see sph_signal(), of all pairs there have been
};

// whole vectors: fill up with particles out of reach, to which nothing happens

template <class Kernel>
static inline int sph_fill_up(int i, const SphPlace &pi, int n, SphNear &near)
{
  const int nlanes = (n + LANES - 1) & ~(LANES - 1);
  for (int m = n; m < nlanes; m++) {
    near.j[m] = i;
    near.d[m] = Vec4{2.0 * Kernel::support * pi.h};
  }
  return nlanes;
}

// for the time step, of a pair: the larger speed of sound, or that of a swing.  What is thin and large, as vapor
// of the same matter, has no less mass.

HVI_INLINE Vec sph_speed(bool unlike, const SphState &si, const Vec &c_j, const Vec &rho_j,
                         const Vec &w_j)
{
  Vec c = si.c > c_j ? Vec{} + si.c : c_j;
  if (unlike && any((si.rho > 4.0 * rho_j) | (rho_j > 4.0 * si.rho)))
    for (int k = 0; k < LANES; k++)
      c[k] = std::max(c[k], sph_swing(si.c, si.rho, si.w, c_j[k], rho_j[k], w_j[k]));
  return c;
}

/* ----------------------------------------------------------------------
   For the time step, of pairs that approach: (c + approach + viscosity)/h, Monaghan 1992 eq 4.5 with
   the speed at which the pair approaches in place of |v|, which depends on the frame.  soft is r^2 +
   0.01 h^2, rdotv is r times the speed.  A quotient is taken of what is fastest so far only.
------------------------------------------------------------------------- */

HVI_INLINE void keep_fastest(const Vec &all, const Vec &over, const Vec &rdotv, Vec &fastest)
{
  const Bits more = (rdotv < 0.0) & (all > fastest * over);
  if (any(more)) fastest = more ? all / over : fastest;
}

HVI_INLINE void sph_signal(const Vec &h, const Vec &r, const Vec &soft, const Vec &rdotv,
                           const Vec &c, const Vec &a, const Vec &b, Vec &fastest)
{
  const Vec all = c * (1.0 + 0.6 * a) * r * soft - rdotv * (soft + 0.6 * b * h * r);
  keep_fastest(all, h * r * soft, rdotv, fastest);
}

// the same of Riemann problems, whose viscosity is that with a = 1 and, of shocks that are faster by
// 1.2 |u|, h mu/r = 0.6 |u| in place of b mu: particles that nearly touch do not make it larger

HVI_INLINE void sph_signal(const Vec &h, const Vec &r, const Vec &rdotv, const Vec &c, Vec &fastest)
{
  keep_fastest(1.6 * c * r - 1.36 * rdotv, h * r, rdotv, fastest);
}

// Monaghan 1992, for pairs that approach: mu = h v.x/(r^2 + 0.01 h^2),
// Pi = (b mu^2 - a c_ij mu)/rho_ij; the means over i and j and all quotients in one

HVI_INLINE Vec sph_viscosity(const Vec &h, const Vec &soft, const Vec &rdotv, const Vec &c_sum,
                             const Vec &rho_sum, const Vec &a, const Vec &b)
{
  const Vec hv = h * (rdotv < 0.0 ? rdotv : Vec{});
  return hv * (2.0 * b * hv - a * c_sum * soft) / (soft * soft * rho_sum);
}

// one kernel for both: grad W(r, (h_i + h_j)/2) = F (dx,dy,dz)

template <class Kernel, int SCENE> class SphMeanKernel {
 public:
  SphMeanKernel(const SphLaws &laws, const SphPlace &pi) :
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

// each has its own kernel: grad W(r, h_i) = F_i d, and grad W(r, h_j) = F_j d.  Between
// types whose h are as 1 to ratio at the start, either is as wide as the mean of both: h_i (1 + ratio)/2.

template <class Kernel, int SCENE> class SphTwoKernels {
 public:
  SphTwoKernels(const SphLaws &laws, const SphPlace &pi) :
      norm(laws.norm), two(laws.dim > 1), three(laws.dim > 2), h_i(pi.h), hinv_i(1.0 / pi.h),
      scale_i(scale(hinv_i))
  {
  }
  inline void F(const Vec &r, const Vec &dh, Vec &F_i, Vec &F_j,
                const Vec &ratio = Vec{} + 1.0) const
  {
    if (SCENE & SPH_SPACINGS) {
      Vec inv_i, inv_j;
      widen(dh, ratio, inv_i, inv_j);
      F_i = scale(inv_i) * inv_i * inv_i * Kernel::template dw_q<Vec>(r * inv_i);
      F_j = scale(inv_j) * inv_j * inv_j * Kernel::template dw_q<Vec>(r * inv_j);
      return;
    }
    F_i = scale_i * hinv_i * hinv_i * Kernel::template dw_q<Vec>(r * hinv_i);
    F_j = F_i;
    if (SCENE & SPH_OWN_H) {
      const Vec hinv = 1.0 / (h_i - dh);
      F_j = scale(hinv) * hinv * hinv * Kernel::template dw_q<Vec>(r * hinv);
    }
  }

  // W, and h dW/dh = - (dim W + norm/h^dim q dw/dq)

  inline void W(const Vec &r, const Vec &dh, Vec &W_i, Vec &W_j, Vec &s_i, Vec &s_j,
                const Vec &ratio = Vec{} + 1.0) const
  {
    if (SCENE & SPH_SPACINGS) {
      Vec inv_i, inv_j;
      widen(dh, ratio, inv_i, inv_j);
      both(r * inv_i, scale(inv_i), W_i, s_i);
      both(r * inv_j, scale(inv_j), W_j, s_j);
      return;
    }
    const Vec q_i = r * hinv_i;
    W_i = scale_i * Kernel::template w<Vec>(q_i);
    W_j = W_i;
    if (SCENE & SPH_OWN_H) {
      const double dim = 1.0 + two + three;
      const Vec hinv = 1.0 / (h_i - dh), q_j = r * hinv, scale_j = scale(hinv);
      W_j = scale_j * Kernel::template w<Vec>(q_j);
      s_i = -(dim * W_i + scale_i * q_i * q_i * Kernel::template dw_q<Vec>(q_i));
      s_j = -(dim * W_j + scale_j * q_j * q_j * Kernel::template dw_q<Vec>(q_j));
    }
  }

 private:
  const double norm, two, three, h_i, hinv_i, scale_i;

  inline void widen(const Vec &dh, const Vec &ratio, Vec &inv_i, Vec &inv_j) const
  {
    const Vec narrower = 2.0 / (1.0 + ratio);
    inv_i = hinv_i * narrower;
    inv_j = narrower * ratio / (h_i - dh);
  }
  inline void both(const Vec &q, const Vec &scale, Vec &W, Vec &spread) const
  {
    W = scale * Kernel::template w<Vec>(q);
    spread = -((1.0 + two + three) * W + scale * q * q * Kernel::template dw_q<Vec>(q));
  }
  template <class T> inline T scale(const T &hinv) const    // norm/h^dim, without a choice
  {
    return norm * hinv * (two * hinv + (1.0 - two)) * (three * hinv + (1.0 - three));
  }
};

}    // namespace HVI

#endif
