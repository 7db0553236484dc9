/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_EOS_IDEALGAS_H
#define LMP_HVI_EOS_IDEALGAS_H

#include "hvi_parameter.h"

#include <algorithm>

namespace HVI {

/* ----------------------------------------------------------------------
   Ideal gas.

     p = (gamma - 1) rho e,   c^2 = gamma p/rho,   T = e/cv

   There is no reference state: rho0 = 0, c0 = 0, and e = 0 at T = 0.
------------------------------------------------------------------------- */

struct EosIdealGas {
  static constexpr const char *name = "idealgas";
  static constexpr int nargs = 1;
  static constexpr Parameter params[] = {
      {"gamma", NUMBER, ABOVE_ONE, REQUIRED},
      {"cv", HEAT_CAPACITY, NOT_NEGATIVE, 0.0},    // 0: no temperature
  };

  double gamma, cv, rho0, c0, rho_max;

  static EosIdealGas make(const double *v) { return {v[0], v[1], 0.0, 0.0, NO_LIMIT}; }

  void state(double rho, double e, double &p, double &csq) const
  {
    p = (gamma - 1.0) * rho * e;
    csq = gamma * (gamma - 1.0) * e;
  }

  double temperature(double, double e) const
  {
    return cv > 0.0 ? std::max(e / cv, 0.0) : std::numeric_limits<double>::quiet_NaN();
  }
};

}    // namespace HVI

#endif
