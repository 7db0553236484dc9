/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_STRENGTH_COWPER_SYMONDS_H
#define LMP_HVI_STRENGTH_COWPER_SYMONDS_H

#include "hvi_strength.h"

namespace HVI {

/* ----------------------------------------------------------------------
   Cowper & Symonds, Brown University, Technical Report 28 (1957)

     Y = Y0 [1 + (epsdot/D)^(1/p)]

   G is constant.  No hardening, no temperature.
------------------------------------------------------------------------- */

struct StrengthCowperSymonds {
  static constexpr const char *name = "cowper-symonds";
  static constexpr Parameter params[] = {
      {"G", PRESSURE, POSITIVE, REQUIRED},
      {"Y0", PRESSURE, POSITIVE, REQUIRED},
      {"D", RATE, POSITIVE, REQUIRED},
      {"p", NUMBER, POSITIVE, REQUIRED},
  };
  static constexpr double Tref = 300.0;

  double G, Y0, D, p;

  static StrengthCowperSymonds make(const double *v) { return {v[0], v[1], v[2], v[3]}; }

  double modulus(const Conditions &) const { return G; }
  double melt(const Conditions &) const { return NO_LIMIT; }
  double scale(const Conditions &) const { return 1.0; }

  double flow(double, double rate, const Conditions &) const
  {
    return rate > 0.0 ? Y0 * (1.0 + std::pow(rate / D, 1.0 / p)) : Y0;
  }
};

}    // namespace HVI

#endif
