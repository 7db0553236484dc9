/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_EOS_MIE_GRUNEISEN_H
#define LMP_HVI_EOS_MIE_GRUNEISEN_H

#include "hvi_eos_expansion.h"
#include "hvi_eos_hugoniot.h"
#include "hvi_eos_thermal.h"
#include "hvi_parameter.h"

namespace HVI {

/* ----------------------------------------------------------------------
   Mie-Grueneisen about the Hugoniot Us = C + S1 u, with Gamma rho constant.

     p = p_H (1 - g0 eta/2) + rho0 g0 e      eta = 1 - rho0/rho
     p_H = rho0 C^2 eta/(1 - S1 eta)^2       for eta > 0
     p = rho0 C^2 (rho/rho0 - 1) + rho0 g0 e for eta <= 0

   Esposito (2024) eqs 2.11-2.13; eq 2.14 as printed drops -g0 eta/2.  In
   expansion, where the Hugoniot says nothing, the line of LS-DYNA's form is
   taken, less where it pushes: see hvi_eos_expansion.h; it joins with the same slope.
   Where it ends: hvi_eos_hugoniot.h.
------------------------------------------------------------------------- */

struct EosMieGruneisen {
  static constexpr const char *name = "mie-gruneisen";
  static constexpr int nargs = 5;
  static constexpr Parameter params[] = {
      {"rho0", DENSITY, POSITIVE, REQUIRED},    {"C", SPEED, POSITIVE, REQUIRED},
      {"S1", NUMBER, NOT_NEGATIVE, REQUIRED},   {"g0", NUMBER, NOT_NEGATIVE, REQUIRED},
      {"cp", HEAT_CAPACITY, NOT_NEGATIVE, 0.0},    // 0: no temperature
      {"T0", TEMPERATURE, POSITIVE, 300.0},
  };

  double rho0, c0, S1, g0, cp, T0, rho_max;
  HotExpansion hot;
  ThermalTable thermal;

  static EosMieGruneisen make(const double *v)
  {
    EosMieGruneisen law = {v[0], v[1], v[2], v[3], v[4], v[5], NO_LIMIT, HotExpansion(v[3]), {}};
    law.rho_max = end_of_hugoniot(law);
    law.thermal.fill(law);
    return law;
  }

  void state(double rho, double e, double &p, double &csq) const
  {
    const double v = 1.0 / rho, eta = 1.0 - rho0 * v;
    const double k = rho0 * c0 * c0;
    double slope, g = g0;    // dp/drho at constant e, dp/de/rho0
    if (eta > 0.0) {
      const double d = 1.0 / (1.0 - S1 * eta);
      const double ph = k * eta * d * d;
      const double dph = k * (1.0 + S1 * eta) * d * d * d;
      p = ph * (1.0 - 0.5 * g0 * eta) + rho0 * g0 * e;
      slope = (dph * (1.0 - 0.5 * g0 * eta) - 0.5 * g0 * ph) * rho0 * v * v;
    } else {
      p = c0 * c0 * (rho - rho0) + rho0 * g0 * e;
      slope = c0 * c0;
      hot.apply(rho / rho0, 1.0 / rho0, p, slope, g);
    }
    csq = slope + p * v * v * rho0 * g;
  }

  double ratio(double eta) const { return 1.0 - S1 * eta; }    // C/Us

  // in compression: pressure at e = 0, and dp/de/rho0

  double p0(double eta) const
  {
    const double d = ratio(eta);
    return rho0 * c0 * c0 * eta * (1.0 - 0.5 * g0 * eta) / (d * d);
  }
  double g(double) const { return g0; }

  double temperature(double rho, double e) const { return thermal.temperature(*this, rho, e); }
};

}    // namespace HVI

#endif
