/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_STRENGTH_STEINBERG_GUINAN_H
#define LMP_HVI_STRENGTH_STEINBERG_GUINAN_H

#include "hvi_strength.h"

namespace HVI {

/* ----------------------------------------------------------------------
   Steinberg, Cochran & Guinan, J. Appl. Phys. 51 (1980) 1498

     G = G0 [1 + A p/eta^(1/3) - B (T - 300)],   eta = rho/rho0
     Y = min(Y0 (1 + beta eps)^n, Ymax) G/G0
     Tm = Tm0 exp[2 a (1 - 1/eta)] eta^(2 (g0 - a - 1/3))

   No rate: the law is that of rates above 1e5/s.  G is not below 0, which
   tension or heat could make it.
------------------------------------------------------------------------- */

struct StrengthSteinbergGuinan {
  static constexpr const char *name = "steinberg-guinan";
  static constexpr Parameter params[] = {
      {"G0", PRESSURE, POSITIVE, REQUIRED},           {"Y0", PRESSURE, POSITIVE, REQUIRED},
      {"Ymax", PRESSURE, POSITIVE, REQUIRED},         {"beta", NUMBER, NOT_NEGATIVE, REQUIRED},
      {"n", NUMBER, NOT_NEGATIVE, REQUIRED},          {"A", PER_PRESSURE, NOT_NEGATIVE, REQUIRED},
      {"B", PER_TEMPERATURE, NOT_NEGATIVE, REQUIRED}, {"Tm0", TEMPERATURE, POSITIVE, REQUIRED},
      {"g0", NUMBER, NOT_NEGATIVE, REQUIRED},         {"a", NUMBER, NOT_NEGATIVE, REQUIRED},
  };
  static constexpr double Tref = 300.0;

  double G0, Y0, Ymax, beta, n, A, B, Tm0, g0, a;

  static std::string problem(const double *v)
  {
    if (v[2] < v[1]) return "Ymax must not be below Y0";
    return v[7] > Tref ? "" : "Tm0 must be above 300 K";
  }

  static StrengthSteinbergGuinan make(const double *v)
  {
    StrengthSteinbergGuinan law;
    law.G0 = v[0];
    law.Y0 = v[1];
    law.Ymax = v[2];
    law.beta = v[3];
    law.n = v[4];
    law.A = v[5];
    law.B = v[6];
    law.Tm0 = v[7];
    law.g0 = v[8];
    law.a = v[9];
    return law;
  }

  double melt(const Conditions &c) const
  {
    const double eta = c.rho / c.rho0;
    return Tm0 * std::exp(2.0 * (a * (1.0 - 1.0 / eta) + (g0 - a - 1.0 / 3.0) * std::log(eta)));
  }

  double scale(const Conditions &c) const
  {
    const double heat = std::isnan(c.T) ? 0.0 : B * (c.T - Tref);
    return 1.0 + A * c.p / std::cbrt(c.rho / c.rho0) - heat;
  }

  double modulus(const Conditions &c) const { return G0 * scale(c); }

  double flow(double eps, double, const Conditions &) const
  {
    return std::min(Y0 * std::pow(1.0 + beta * eps, n), Ymax);
  }
};

}    // namespace HVI

#endif
