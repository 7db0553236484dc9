/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_EOS_POLYNOMIAL_H
#define LMP_HVI_EOS_POLYNOMIAL_H

#include "hvi_eos_expansion.h"
#include "hvi_eos_thermal.h"
#include "hvi_parameter.h"

namespace HVI {

/* ----------------------------------------------------------------------
   Polynomial, mu = rho/rho0 - 1:

     p = A1 mu + A2 mu^2 + A3 mu^3 + (B0 + B1 mu + B2 mu^2) rho0 e   mu > 0
     p = T1 mu + T2 mu^2 + B0 rho0 e                                 mu <= 0, less where p > 0:
                                                                     hvi_eos_expansion.h

   Esposito (2024) eq 2.15; AUTODYN Theory Manual, Polynomial Equation of
   State, where B2 = 0 and T1 = 0 stands for T1 = A1, as it does here;
   B2 is C6 of LS-DYNA's EOS 1.
------------------------------------------------------------------------- */

struct EosPolynomial {
  static constexpr const char *name = "polynomial";
  static constexpr int nargs = 10;
  static constexpr Parameter params[] = {
      {"rho0", DENSITY, POSITIVE, REQUIRED},
      {"A1", PRESSURE, POSITIVE, REQUIRED},
      {"A2", PRESSURE, ANY, 0.0},
      {"A3", PRESSURE, ANY, 0.0},
      {"B0", NUMBER, NOT_NEGATIVE, 0.0},
      {"B1", NUMBER, ANY, 0.0},
      {"B2", NUMBER, ANY, 0.0},
      {"T1", PRESSURE, NOT_NEGATIVE, 0.0},
      {"T2", PRESSURE, ANY, 0.0},
      {"cp", HEAT_CAPACITY, NOT_NEGATIVE, 0.0},    // 0: no temperature
      {"T0", TEMPERATURE, POSITIVE, 300.0},
  };

  double rho0, A1, A2, A3, B0, B1, B2, T1, T2, cp, T0, c0, rho_max;
  HotExpansion hot;
  ThermalTable thermal;

  static EosPolynomial make(const double *v)
  {
    EosPolynomial law = {v[0], v[1], v[2], v[3],  v[4], v[5],     v[6],
                         v[7], v[8], v[9], v[10], 0.0,  NO_LIMIT, HotExpansion(v[4]),
                         {}};
    if (law.T1 == 0.0) law.T1 = law.A1;
    law.c0 = std::sqrt(law.A1 / law.rho0);
    law.thermal.fill(law);
    return law;
  }

  void state(double rho, double e, double &p, double &csq) const
  {
    const double mu = rho / rho0 - 1.0;
    double gamma, slope;    // dp/de/rho0 and dp/dmu
    if (mu > 0.0) {
      gamma = B0 + mu * (B1 + mu * B2);
      p = mu * (A1 + mu * (A2 + mu * A3)) + gamma * rho0 * e;
      slope = A1 + mu * (2.0 * A2 + mu * 3.0 * A3) + (B1 + 2.0 * mu * B2) * rho0 * e;
    } else {
      gamma = B0;
      p = mu * (T1 + mu * T2) + gamma * rho0 * e;
      slope = T1 + 2.0 * mu * T2;
      hot.apply(rho / rho0, 1.0, p, slope, gamma);
    }
    csq = slope / rho0 + p / (rho * rho) * rho0 * gamma;
  }

  // in compression: pressure at e = 0, and dp/de/rho0

  double p0(double eta) const
  {
    const double mu = eta / (1.0 - eta);
    return mu * (A1 + mu * (A2 + mu * A3));
  }
  double g(double eta) const
  {
    const double mu = eta / (1.0 - eta);
    return B0 + mu * (B1 + mu * B2);
  }

  double temperature(double rho, double e) const { return thermal.temperature(*this, rho, e); }
};

}    // namespace HVI

#endif
