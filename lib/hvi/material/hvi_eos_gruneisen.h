/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_EOS_GRUNEISEN_H
#define LMP_HVI_EOS_GRUNEISEN_H

#include "hvi_eos_expansion.h"
#include "hvi_eos_hugoniot.h"
#include "hvi_eos_thermal.h"
#include "hvi_parameter.h"

namespace HVI {

/* ----------------------------------------------------------------------
   Grueneisen in LS-DYNA's form, with a cubic Hugoniot and a first-order
   volume correction a of Gamma, mu = rho/rho0 - 1, E = rho0 e:

     p = rho0 C^2 mu [1 + (1 - g0/2) mu - a/2 mu^2]/D^2 + (g0 + a mu) E   mu > 0
     p = rho0 C^2 mu + (g0 + a mu/(1 - k mu)) E                           mu <= 0, less where p > 0:
                                                                          hvi_eos_expansion.h
     D = 1 - (S1-1) mu - S2 mu^2/(mu+1) - S3 mu^3/(mu+1)^2

   LS-DYNA Keyword User's Manual, vol II, EOS 4; Steinberg, UCRL-MA-106439
   (1996), whose b is a.  LS-DYNA has k = 0, with which hot vapor pulls where a > g0, as in water.  Here
   k = 2 a/g0 - 1 where that is above 0: at least g0/2 is left at density 0, and c has no jump at rho0.

   With eta = mu/(mu+1),

     D = (mu+1) d,   d = 1 - S1 eta - S2 eta^2 - S3 eta^3 = C/Us,

   which is how it is evaluated.  Where it ends: hvi_eos_hugoniot.h.
------------------------------------------------------------------------- */

struct EosGruneisen {
  static constexpr const char *name = "gruneisen";
  static constexpr int nargs = 6;
  static constexpr Parameter params[] = {
      {"rho0", DENSITY, POSITIVE, REQUIRED},
      {"C", SPEED, POSITIVE, REQUIRED},
      {"S1", NUMBER, NOT_NEGATIVE, REQUIRED},
      {"g0", NUMBER, NOT_NEGATIVE, REQUIRED},
      {"a", NUMBER, ANY, 0.0},
      {"cp", HEAT_CAPACITY, NOT_NEGATIVE, 0.0},    // 0: no temperature
      {"S2", NUMBER, ANY, 0.0},
      {"S3", NUMBER, ANY, 0.0},
      {"T0", TEMPERATURE, POSITIVE, 300.0},
  };

  double rho0, c0, S1, g0, a, cp, S2, S3, T0, rho_max, k;
  HotExpansion hot;
  ThermalTable thermal;

  static EosGruneisen make(const double *v)
  {
    const double g0 = v[3], a = v[4];
    const double k = std::max(2.0 * a / std::max(g0, 1e-30) - 1.0, 0.0);
    const HotExpansion hot(std::max(g0 - a, 0.5 * g0));
    EosGruneisen law = {v[0], v[1], v[2], g0, a, v[5], v[6], v[7], v[8], NO_LIMIT, k, hot, {}};
    law.rho_max = end_of_hugoniot(law);
    law.thermal.fill(law);
    return law;
  }

  // C/Us

  double ratio(double eta) const { return 1.0 - eta * (S1 + eta * (S2 + eta * S3)); }

  void state(double rho, double e, double &p, double &csq) const
  {
    const double v = 1.0 / rho, x = rho0 * v, eta = 1.0 - x;
    const double mu = (rho - rho0) / rho0;
    double gamma = g0 + a * mu;    // dp/de/rho0
    const double K = rho0 * c0 * c0;
    double slope;    // dp/dmu at constant e
    if (mu > 0.0) {
      const double d = 1.0 / ratio(eta);
      const double dd = -(S1 + eta * (2.0 * S2 + eta * 3.0 * S3));
      // Hugoniot K eta/d^2, and 1 - (g0 + a mu) eta/2
      const double ph = K * eta * d * d;
      const double dph = K * (1.0 - 2.0 * eta * dd * d) * d * d * x * x;
      const double f = 1.0 - 0.5 * gamma * eta;
      const double df = -0.5 * (a * eta + gamma * x * x);
      p = ph * f + gamma * rho0 * e;
      slope = dph * f + ph * df + a * rho0 * e;
    } else {
      const double s = 1.0 / (1.0 - k * mu);
      gamma = g0 + a * mu * s;
      p = K * mu + gamma * rho0 * e;
      slope = K + a * s * s * rho0 * e;
      hot.apply(rho / rho0, 1.0, p, slope, gamma);
    }
    csq = slope / rho0 + p * v * x * gamma;
  }

  // in compression: pressure at e = 0, and dp/de/rho0

  double p0(double eta) const
  {
    const double d = ratio(eta);
    return rho0 * c0 * c0 * eta * (1.0 - 0.5 * g(eta) * eta) / (d * d);
  }
  double g(double eta) const { return g0 + a * eta / (1.0 - eta); }

  double temperature(double rho, double e) const { return thermal.temperature(*this, rho, e); }
};

}    // namespace HVI

#endif
