/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_EOS_EXPANSION_H
#define LMP_HVI_EOS_EXPANSION_H

#include <algorithm>

namespace HVI {

/* ----------------------------------------------------------------------
   Pressure of hot expanded matter.  In expansion, x = rho/rho0 < 1, laws about a Hugoniot go on as

     p1 = pref(x) + G(x) rho0 e     G(0) > 0

   which holds near rho0 and keeps a pressure at any density however thin, so that c^2 grows as
   p1/rho^2 without bounds.  Where p1 > 0, the pressure is

     p = f(x) p1,   f = 1 - (1 - x)^2 [1 + (2 - h) x],   h = H/G(0), 3 at most

   f(1) = 1 and f'(1) = 0, so that p, c and Gamma join those in compression.  p is 0 where p1 is, at the
   energy e0(x), and p1 < 0 is left as it is.  f' >= 0, so c^2 > 0 where p1 rises with density.  f = h x
   in thin matter, which is a gas with Gamma = H,

     p = H rho (e - e0(0)),   H = 2/3

   of single atoms, less the energy e0(0) that binds them: C^2/G(0) of the law gruneisen.
   That Gamma goes from that of the solid to that of the vapor, and that the binding energy counts, is
   from the law PUFF (Radioss Reference Guide, /EOS/PUFF; there by a root of x and an exponential,
   with a parameter for the energy).
------------------------------------------------------------------------- */

class HotExpansion {
 public:
  explicit HotExpansion(double G0) : h(3.0 * G0 > VAPOR ? VAPOR / G0 : 3.0) {}

  // p1, its slope at constant e over x or something else that x has the slope dx over, and dp1/de/rho0, to
  // those of p

  void apply(double x, double dx, double &p, double &slope, double &G) const
  {
    if (!(p > 0.0)) return;
    const double f = 1.0 - (1.0 - x) * (1.0 - x) * (1.0 + (2.0 - h) * x);
    slope = f * slope + (1.0 - x) * (h + 3.0 * (2.0 - h) * x) * dx * p;
    p *= f;
    G *= f;
  }

 private:
  static constexpr double VAPOR = 2.0 / 3.0;
  double h;
};

}    // namespace HVI

#endif
