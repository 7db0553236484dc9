/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_EOS_LINEAR_H
#define LMP_HVI_EOS_LINEAR_H

#include "hvi_parameter.h"

namespace HVI {

/* ----------------------------------------------------------------------
   Linear in density, without thermal pressure.

     p = K (rho/rho0 - 1),   c = sqrt(K/rho0)

   Zisis et al. (2013), where K = rho0 u0^2/Ca with the Cauchy number Ca and
   the closing speed u0.
------------------------------------------------------------------------- */

struct EosLinear {
  static constexpr const char *name = "linear";
  static constexpr int nargs = 2;
  static constexpr Parameter params[] = {
      {"rho0", DENSITY, POSITIVE, REQUIRED},
      {"K", PRESSURE, POSITIVE, REQUIRED},
  };

  double rho0, K, c0, rho_max;

  static EosLinear make(const double *v)
  {
    EosLinear law;
    law.rho0 = v[0];
    law.K = v[1];
    law.c0 = std::sqrt(law.K / law.rho0);
    law.rho_max = NO_LIMIT;
    return law;
  }

  void state(double rho, double, double &p, double &csq) const
  {
    p = K * (rho / rho0 - 1.0);
    csq = K / rho0;
  }

  double temperature(double, double) const { return std::numeric_limits<double>::quiet_NaN(); }
};

}    // namespace HVI

#endif
