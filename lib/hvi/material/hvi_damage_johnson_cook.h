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
   below eps_min.  Of high triaxiality, with sigma_spall: above s* = 1.5 eps_f goes
   linearly in s* to eps_min at s* = sigma_spall/sqrt(3/2 S:S), and stays there.
   The paper itself was not opened; so have it the authors of Spheral,
   github.com/LLNL/spheral, JohnsonCookFailureStrainPolicy.cc, with another limit
   than 1.5 if one likes.

   With u_f D = 1 is the initiation of damage, from which on the yield stress falls:
   see SolidModel.
------------------------------------------------------------------------- */

struct DamageJohnsonCook {
  static constexpr const char *name = "johnson-cook";
  static constexpr Parameter params[] = {
      {"D1", NUMBER, ANY, REQUIRED},       {"D2", NUMBER, ANY, REQUIRED},
      {"D3", NUMBER, ANY, REQUIRED},       {"D4", NUMBER, ANY, REQUIRED},
      {"D5", NUMBER, ANY, REQUIRED},       {"epsdot0", RATE, POSITIVE, 1.0},
      {"eps_min", NUMBER, POSITIVE, 1e-6}, {"sigma_spall", PRESSURE, NOT_NEGATIVE, 0.0},
      {"u_f", LENGTH, NOT_NEGATIVE, 0.0},
  };
  static constexpr double HIGH = 1.5;    // triaxiality

  double D1, D2, D3, D4, D5, epsdot0;
  double eps_min = 1e-6;
  double sigma_spall = 0.0;    // mean stress, 0: the law above of any triaxiality
  double u_f = 0.0;

  static DamageJohnsonCook make(const double *v)
  {
    return {v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8]};
  }

  // tstar from the law of strength; a rate that is not above epsdot0, or not known, does nothing

  double failure_strain(double sstar, double rate, double tstar) const
  {
    const double log_rate = rate > epsdot0 ? std::log(rate / epsdot0) : 0.0;
    const double strain = bracket(D1 + D2 * std::exp(std::min(D3 * sstar, 500.0))) *
        bracket(1.0 + D4 * log_rate) * bracket(1.0 + D5 * tstar);
    return strain < eps_min ? eps_min : strain;
  }

  double failure_strain(double p, double vm, double rate, double tstar) const
  {
    const double sstar = triaxiality(p, vm);
    if (!(sigma_spall > 0.0 && sstar > HIGH)) return failure_strain(sstar, rate, tstar);
    if (-p >= sigma_spall) return eps_min;
    const double part = (-p - HIGH * vm) / (sigma_spall - HIGH * vm);
    return eps_min + (1.0 - part) * (failure_strain(HIGH, rate, tstar) - eps_min);
  }

  double increment(double d_eps, double dt, double p, double vm, double tstar, double scatter) const
  {
    if (d_eps == 0.0) return 0.0;
    const double rate = dt > 0.0 ? d_eps / dt : 0.0;
    return d_eps / (scatter * failure_strain(p, vm, rate, tstar));
  }

 private:
  static double bracket(double x) { return x < 0.0 ? 0.0 : x; }    // NaN stays
};

}    // namespace HVI

#endif
