/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_EOS_TAIT_H
#define LMP_HVI_EOS_TAIT_H

#include "hvi_parameter.h"

namespace HVI {

/* ----------------------------------------------------------------------
   Tait-Murnaghan: stiffened, without thermal pressure.

     p = B [(rho/rho0)^gamma - 1],   B = rho0 c0^2/gamma
     c^2 = c0^2 (rho/rho0)^(gamma - 1)

   Cole, Underwater Explosions (1948); Monaghan, J. Comput. Phys. 110 (1994)
   399.  With gamma = 7 as in LAMMPS's pair style sph/taitwater,
   which takes c0 as the sound speed in all states.
------------------------------------------------------------------------- */

struct EosTait {
  static constexpr const char *name = "tait";
  static constexpr int nargs = 3;
  static constexpr Parameter params[] = {
      {"rho0", DENSITY, POSITIVE, REQUIRED},
      {"c0", SPEED, POSITIVE, REQUIRED},
      {"gamma", NUMBER, POSITIVE, 7.0},
  };

  double rho0, c0, gamma, B, rho_max;

  static EosTait make(const double *v)
  {
    EosTait law;
    law.rho0 = v[0];
    law.c0 = v[1];
    law.gamma = v[2];
    law.B = law.rho0 * law.c0 * law.c0 / law.gamma;
    law.rho_max = NO_LIMIT;
    return law;
  }

  // the power 7 by multiplication, which is much cheaper

  void state(double rho, double, double &p, double &csq) const
  {
    const double x = rho / rho0, x3 = x * x * x;
    const double slope = gamma == 7.0 ? x3 * x3 : std::pow(x, gamma - 1.0);
    p = B * (slope * x - 1.0);
    csq = c0 * c0 * slope;
  }

  double temperature(double, double) const { return std::numeric_limits<double>::quiet_NaN(); }
};

}    // namespace HVI

#endif
