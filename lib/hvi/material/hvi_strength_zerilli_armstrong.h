/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_STRENGTH_ZERILLI_ARMSTRONG_H
#define LMP_HVI_STRENGTH_ZERILLI_ARMSTRONG_H

#include "hvi_strength.h"

namespace HVI {

/* ----------------------------------------------------------------------
   Zerilli & Armstrong, J. Appl. Phys. 61 (1987) 1816

     fcc  Y = C0 + C2 eps^(1/2) exp(-C3 T + C4 T ln epsdot)
     bcc  Y = C0 + C1 exp(-C3 T + C4 T ln epsdot) + C5 eps^n

   C0 is the stress of solutes and of the size of grains, in the paper Delta sigma_G' + k l^(-1/2).
   epsdot is in 1/s, so in other units epsdot0 is that.  The logarithm is not below 0, as slow
   motion would take away all strength; the exponent is not above 0, its value at 0 K, so that
   strength is bounded in fast motion.  G is constant below Tm, which the paper does not have.
   Where there is no temperature it is 300 K.
------------------------------------------------------------------------- */

struct StrengthZerilliArmstrong {
  static constexpr const char *name = "zerilli-armstrong";
  static constexpr Parameter params[] = {
      {"G", PRESSURE, POSITIVE, REQUIRED},
      {"C0", PRESSURE, POSITIVE, REQUIRED},
      {"C1", PRESSURE, NOT_NEGATIVE, 0.0},
      {"C2", PRESSURE, NOT_NEGATIVE, 0.0},
      {"C3", PER_TEMPERATURE, NOT_NEGATIVE, REQUIRED},
      {"C4", PER_TEMPERATURE, NOT_NEGATIVE, REQUIRED},
      {"C5", PRESSURE, NOT_NEGATIVE, 0.0},
      {"n", NUMBER, NOT_NEGATIVE, 0.0},
      {"epsdot0", RATE, POSITIVE, 1.0},
      {"Tm", TEMPERATURE, POSITIVE, REQUIRED},
  };
  static constexpr double Tref = 300.0;

  double G, C0, C1, C2, C3, C4, C5, n, epsdot0, Tm;

  static std::string problem(const double *v)
  {
    return v[9] > Tref ? "" : "Tm must be above 300 K";
  }
  static StrengthZerilliArmstrong make(const double *v)
  {
    return {v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8], v[9]};
  }

  double modulus(const Conditions &) const { return G; }
  double melt(const Conditions &) const { return Tm; }
  double scale(const Conditions &) const { return 1.0; }

  double flow(double eps, double rate, const Conditions &c) const
  {
    const double T = std::isnan(c.T) ? Tref : std::max(c.T, 0.0);
    const double L = rate > epsdot0 ? std::log(rate / epsdot0) : 0.0;
    const double active = std::exp(std::min(T * (C4 * L - C3), 0.0));
    const double athermal = C0 + (C5 > 0.0 ? C5 * std::pow(eps, n) : 0.0);
    return athermal + (C1 + C2 * std::sqrt(eps)) * active;
  }
};

}    // namespace HVI

#endif
