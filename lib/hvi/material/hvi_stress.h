/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_STRESS_H
#define LMP_HVI_STRESS_H

#include <algorithm>
#include <cmath>

namespace HVI {

/* ----------------------------------------------------------------------
   Deviatoric stress S and what moves it.  Tension is positive in the
   stress, sigma = -p I + S.
------------------------------------------------------------------------- */

struct Deviator {
  double xx, yy, zz, xy, xz, yz;
};

// L_ab = d v_a/d b, so that xy is d vx/dy

struct VelocityGradient {
  double xx, xy, xz, yx, yy, yz, zx, zy, zz;
};

inline Deviator scaled(const Deviator &s, double f)
{
  return {f * s.xx, f * s.yy, f * s.zz, f * s.xy, f * s.xz, f * s.yz};
}

// a : b

inline double contract(const Deviator &a, const Deviator &b)
{
  return a.xx * b.xx + a.yy * b.yy + a.zz * b.zz + 2.0 * (a.xy * b.xy + a.xz * b.xz + a.yz * b.yz);
}

// von Mises's stress, sqrt(3/2 S:S), from numbers of any size

inline double von_mises(const Deviator &s)
{
  const double square = 1.5 * contract(s, s);
  if (square > 1e-200 && square < 1e200) return std::sqrt(square);
  const double size = std::max({std::fabs(s.xx), std::fabs(s.yy), std::fabs(s.zz), std::fabs(s.xy),
                                std::fabs(s.xz), std::fabs(s.yz)});
  if (size == 0.0) return square;    // 0, or what is not a number
  const Deviator unit = {s.xx / size, s.yy / size, s.zz / size,
                         s.xy / size, s.xz / size, s.yz / size};
  return size * std::sqrt(1.5 * contract(unit, unit));
}

/* ----------------------------------------------------------------------
   Elastic rate of S with Jaumann's derivative,

     dS/dt = 2 G (D - tr(D)/3 I) + W S - S W

   D = (L + L^T)/2 and W = (L - L^T)/2, the spin: S of a body that turns
   as a whole turns with it.
------------------------------------------------------------------------- */

inline Deviator jaumann_rate(const VelocityGradient &L, double G, const Deviator &S)
{
  const double mean = (L.xx + L.yy + L.zz) / 3.0;
  const double wxy = 0.5 * (L.xy - L.yx), wxz = 0.5 * (L.xz - L.zx), wyz = 0.5 * (L.yz - L.zy);
  Deviator rate;
  rate.xx = 2.0 * (G * (L.xx - mean) + wxy * S.xy + wxz * S.xz);
  rate.yy = 2.0 * (G * (L.yy - mean) - wxy * S.xy + wyz * S.yz);
  rate.zz = 2.0 * (G * (L.zz - mean) - wxz * S.xz - wyz * S.yz);
  rate.xy = G * (L.xy + L.yx) + wxy * (S.yy - S.xx) + wxz * S.yz + wyz * S.xz;
  rate.xz = G * (L.xz + L.zx) + wxz * (S.zz - S.xx) + wxy * S.yz - wyz * S.xy;
  rate.yz = G * (L.yz + L.zy) + wyz * (S.zz - S.yy) - wxy * S.xz - wxz * S.xy;
  return rate;
}

}    // namespace HVI

#endif
