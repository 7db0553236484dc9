/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_EOS_GRUNEISEN_H
#define LMP_HVI_EOS_GRUNEISEN_H

#include "hvi_eos_expansion.h"
#include "hvi_eos_thermal.h"
#include "hvi_parameter.h"

namespace HVI {

/* ----------------------------------------------------------------------
   Grueneisen in LS-DYNA's form, with a cubic Hugoniot and a first-order
   volume correction a of Gamma, mu = rho/rho0 - 1, E = rho0 e:

     p = rho0 C^2 mu [1 + (1 - g0/2) mu - a/2 mu^2]/D^2 + (g0 + a mu) E   mu > 0
     p = rho0 C^2 mu + (g0 + a mu) E                                      mu <= 0, less where p > 0:
                                                                          hvi_eos_expansion.h
     D = 1 - (S1-1) mu - S2 mu^2/(mu+1) - S3 mu^3/(mu+1)^2

   LS-DYNA Keyword User's Manual, vol II, EOS 4; Steinberg, UCRL-MA-106439
   (1996), whose b is a.  With eta = mu/(mu+1),

     D = (mu+1) d,   d = 1 - S1 eta - S2 eta^2 - S3 eta^3 = C/Us,

   which is how it is evaluated.  d vanishes on the pole of the Hugoniot; the
   law ends at the lowest density where d is 1/100.
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

  double rho0, c0, S1, g0, a, cp, S2, S3, T0, rho_max;
  HotExpansion hot;
  ThermalTable thermal;

  static EosGruneisen make(const double *v)
  {
    EosGruneisen law = {
        v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8], NO_LIMIT, HotExpansion(v[3] - v[4]),
        {}};
    law.rho_max = law.rho0 / (1.0 - law.first_eta(0.01));
    law.thermal.fill(law);
    return law;
  }

  // C/Us

  double ratio(double eta) const { return 1.0 - eta * (S1 + eta * (S2 + eta * S3)); }

  // smallest eta with C/Us = d, or 1 (infinite density)

  double first_eta(double d) const
  {
    static constexpr int n = 1000;
    for (int i = 1; i <= n; i++) {
      if (ratio(double(i) / n) > d) continue;
      double lo = double(i - 1) / n, hi = double(i) / n;
      for (int k = 0; k < 60; k++) {
        const double mid = 0.5 * (lo + hi);
        (ratio(mid) > d ? lo : hi) = mid;
      }
      return lo;
    }
    return 1.0;
  }

  void state(double rho, double e, double &p, double &csq) const
  {
    const double v = 1.0 / rho, x = rho0 * v, eta = 1.0 - x;
    const double mu = (rho - rho0) / rho0;
    double gamma = g0 + a * mu;    // dp/de/rho0
    const double k = rho0 * c0 * c0;
    double slope;    // dp/dmu at constant e
    if (mu > 0.0) {
      const double d = 1.0 / ratio(eta);
      const double dd = -(S1 + eta * (2.0 * S2 + eta * 3.0 * S3));
      // Hugoniot k eta/d^2, and 1 - (g0 + a mu) eta/2
      const double ph = k * eta * d * d;
      const double dph = k * (1.0 - 2.0 * eta * dd * d) * d * d * x * x;
      const double f = 1.0 - 0.5 * gamma * eta;
      const double df = -0.5 * (a * eta + gamma * x * x);
      p = ph * f + gamma * rho0 * e;
      slope = dph * f + ph * df + a * rho0 * e;
    } else {
      p = k * mu + gamma * rho0 * e;
      slope = k + a * rho0 * e;
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
