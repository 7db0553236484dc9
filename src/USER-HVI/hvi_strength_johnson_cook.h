/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_STRENGTH_JOHNSON_COOK_H
#define LMP_HVI_STRENGTH_JOHNSON_COOK_H

#include "hvi_strength.h"

namespace HVI {

/* ----------------------------------------------------------------------
   Johnson & Cook, Proc. 7th Int. Symp. Ballistics (1983) 541

     Y = (A + B eps^n) (1 + C ln(epsdot/epsdot0)) (1 - T*^m)
     T* = (T - Tref)/(Tm - Tref) in [0, 1]

   G is constant below Tm.  The factor of the rate is not below 1, unless
   slow is set: then it goes on falling, to 0.
------------------------------------------------------------------------- */

struct StrengthJohnsonCook {
  static constexpr const char *name = "johnson-cook";
  static constexpr Parameter params[] = {
      {"G", PRESSURE, POSITIVE, REQUIRED},     {"A", PRESSURE, POSITIVE, REQUIRED},
      {"B", PRESSURE, NOT_NEGATIVE, REQUIRED}, {"n", NUMBER, NOT_NEGATIVE, REQUIRED},
      {"C", NUMBER, NOT_NEGATIVE, REQUIRED},   {"m", NUMBER, POSITIVE, REQUIRED},
      {"epsdot0", RATE, POSITIVE, 1.0},        {"Tref", TEMPERATURE, POSITIVE, REQUIRED},
      {"Tm", TEMPERATURE, POSITIVE, REQUIRED},
  };

  double G, A, B, n, C, m, epsdot0, Tref, Tm;
  bool slow = false;

  static std::string problem(const double *v) { return v[8] > v[7] ? "" : "Tm must be above Tref"; }

  static StrengthJohnsonCook make(const double *v)
  {
    StrengthJohnsonCook law;
    law.G = v[0];
    law.A = v[1];
    law.B = v[2];
    law.n = v[3];
    law.C = v[4];
    law.m = v[5];
    law.epsdot0 = v[6];
    law.Tref = v[7];
    law.Tm = v[8];
    return law;
  }

  double modulus(const Conditions &) const { return G; }
  double melt(const Conditions &) const { return Tm; }

  double scale(const Conditions &c) const
  {
    return c.T > Tref ? 1.0 - std::pow((c.T - Tref) / (Tm - Tref), m) : 1.0;
  }

  double flow(double eps, double rate) const
  {
    const double y = A + B * std::pow(eps, n);
    if (!(rate > epsdot0) && !(slow && rate >= 0.0)) return y;
    return y * std::max(1.0 + (C > 0.0 ? C * std::log(rate / epsdot0) : 0.0), 0.0);
  }
};

}    // namespace HVI

#endif
