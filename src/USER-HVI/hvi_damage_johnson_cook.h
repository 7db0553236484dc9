/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_DAMAGE_JOHNSON_COOK_H
#define LMP_HVI_DAMAGE_JOHNSON_COOK_H

#include "hvi_damage.h"

namespace HVI {

/* ----------------------------------------------------------------------
   Johnson & Cook, Eng. Fract. Mech. 21 (1985) 31

     dD = d_eps/eps_f
     eps_f = [D1 + D2 exp(D3 s*)] [1 + D4 ln(epsdot/epsdot0)] [1 + D5 T*]
     s* = triaxiality = -p/sqrt(3/2 S:S)

   No bracket counts as less than 0, the logarithm neither, and eps_f is not
   below 1e-6.
------------------------------------------------------------------------- */

struct DamageJohnsonCook {
  static constexpr const char *name = "johnson-cook";
  static constexpr Parameter params[] = {
      {"D1", NUMBER, ANY, REQUIRED}, {"D2", NUMBER, ANY, REQUIRED},
      {"D3", NUMBER, ANY, REQUIRED}, {"D4", NUMBER, ANY, REQUIRED},
      {"D5", NUMBER, ANY, REQUIRED}, {"epsdot0", RATE, POSITIVE, 1.0},
  };
  static constexpr double FLOOR = 1e-6;

  double D1, D2, D3, D4, D5, epsdot0;

  static DamageJohnsonCook make(const double *v) { return {v[0], v[1], v[2], v[3], v[4], v[5]}; }

  // tstar from the law of strength; a rate that is not above epsdot0, or not known, does nothing

  double failure_strain(double sstar, double rate, double tstar) const
  {
    const double log_rate = rate > epsdot0 ? std::log(rate / epsdot0) : 0.0;
    const double strain = bracket(D1 + D2 * std::exp(std::min(D3 * sstar, 500.0))) *
        bracket(1.0 + D4 * log_rate) * bracket(1.0 + D5 * tstar);
    return strain < FLOOR ? FLOOR : strain;
  }

  double increment(double d_eps, double dt, double p, double vm, double tstar, double scatter) const
  {
    if (d_eps == 0.0) return 0.0;
    const double rate = dt > 0.0 ? d_eps / dt : 0.0;
    return d_eps / (scatter * failure_strain(triaxiality(p, vm), rate, tstar));
  }

 private:
  static double bracket(double x) { return x < 0.0 ? 0.0 : x; }    // NaN stays
};

}    // namespace HVI

#endif
