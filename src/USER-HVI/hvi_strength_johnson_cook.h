/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_STRENGTH_JOHNSON_COOK_H
#define LMP_HVI_STRENGTH_JOHNSON_COOK_H

#include "hvi_strength.h"

namespace HVI {

/* ----------------------------------------------------------------------
   Johnson & Cook, Proc. 7th Int. Symp. Ballistics (1983) 541

     Y = (A + B eps^n) (1 + C ln(epsdot/epsdot0)) (1 - T*^m)
     T* = (T - Tref)/(Tm - Tref) in [0, 1]

   G is constant below Tm.  The factor of the rate is not below 1, unless
   slow is set: then it goes on falling, to 0.
------------------------------------------------------------------------- */

struct StrengthJohnsonCook {
  static constexpr const char *name = "johnson-cook";
  static constexpr Parameter params[] = {
      {"G", PRESSURE, POSITIVE, REQUIRED},     {"A", PRESSURE, POSITIVE, REQUIRED},
      {"B", PRESSURE, NOT_NEGATIVE, REQUIRED}, {"n", NUMBER, NOT_NEGATIVE, REQUIRED},
      {"C", NUMBER, NOT_NEGATIVE, REQUIRED},   {"m", NUMBER, POSITIVE, REQUIRED},
      {"epsdot0", RATE, POSITIVE, 1.0},        {"Tref", TEMPERATURE, POSITIVE, REQUIRED},
      {"Tm", TEMPERATURE, POSITIVE, REQUIRED},
  };

  double G, A, B, n, C, m, epsdot0, Tref, Tm;
  bool slow = false;
  static constexpr int TERMS = 7;
  double series[TERMS];    // of (1 + u)^n - 1

  static std::string problem(const double *v) { return v[8] > v[7] ? "" : "Tm must be above Tref"; }

  static StrengthJohnsonCook make(const double *v)
  {
    StrengthJohnsonCook law;
    law.G = v[0];
    law.A = v[1];
    law.B = v[2];
    law.n = v[3];
    law.C = v[4];
    law.m = v[5];
    law.epsdot0 = v[6];
    law.Tref = v[7];
    law.Tm = v[8];
    double c = 1.0;
    for (int k = 0; k < TERMS; k++) law.series[k] = c *= (law.n - k) / (k + 1);
    return law;
  }

  double modulus(const Conditions &) const { return G; }
  double melt(const Conditions &) const { return Tm; }

  double scale(const Conditions &c) const
  {
    if (!(c.T > Tref)) return 1.0;
    const double T = (c.T - Tref) / (Tm - Tref);
    return 1.0 - (m == 1.0 ? T : std::pow(T, m));
  }

  double flow(double eps, double rate) const
  {
    const double y = A + B * std::pow(eps, n);
    if (!(rate > epsdot0) && !(slow && rate >= 0.0)) return y;
    return y * std::max(1.0 + (C > 0.0 ? C * std::log(rate / epsdot0) : 0.0), 0.0);
  }

  /* ----------------------------------------------------------------------
     y = Y(x), x = (trial - y)/(3 G), by Halley's method in ln x.  There
     trial - 3 G x - Y(x) falls and is concave, at the kinks too, so that steps
     from x of Y(0), the largest, come down to the root without passing it by much.  The
     errors of steps are cubes of those before.  A step adds little to a
     plastic strain that is there: a series in place of the power.
  ------------------------------------------------------------------------- */

  double solve(double trial, double G, double y0, double factor, double eps, double dt) const
  {
    const bool rates = dt > 0.0 && C > 0.0;
    const double before = std::pow(eps, n);
    double x = (trial - y0) / (3.0 * G);
    double L = rates ? std::log(x / (dt * epsdot0)) : 0.0;
    for (int k = 0; k < 30; k++) {
      const double u = x / eps, part = x / (eps + x);
      const double power = u < 0.01 ? before * (1.0 + binomial(u)) : std::pow(eps + x, n);
      const double y = factor * (A + B * power), y1 = factor * B * n * power * part;
      const double y2 = y1 * (1.0 + (n - 1.0) * part);    // derivatives to ln x
      double R = 1.0, R1 = 0.0;
      if (rates && (L > 0.0 || slow) && 1.0 + C * L > 0.0) {
        R += C * L;
        R1 = C;
      } else if (rates && slow)
        R = 0.0;
      const double Y = y * R, Y1 = y1 * R + y * R1, Y2 = y2 * R + 2.0 * y1 * R1;
      const double slope = 3.0 * G * x + Y1;
      const double newton = (trial - 3.0 * G * x - Y) / slope;
      const double bend = 0.5 * newton * (3.0 * G * x + Y2) / slope;
      const double step = newton / std::max(1.0 + bend, 0.5);
      if (std::fabs(step) < 1e-5) return Y + step * (Y1 + 0.5 * step * Y2);
      x *= std::exp(step);
      L += step;
    }
    return std::numeric_limits<double>::quiet_NaN();
  }

 private:
  double binomial(double u) const
  {
    double sum = 0.0;
    for (int k = TERMS - 1; k >= 0; k--) sum = u * (series[k] + sum);
    return sum;
  }
};

}    // namespace HVI

#endif
