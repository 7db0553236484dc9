/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_STRENGTH_MODEL_H
#define LMP_HVI_STRENGTH_MODEL_H

#include "hvi_strength.h"
#include "hvi_vector.h"

#include <limits>

namespace HVI {

// From a law, a plain struct, the class that the others know: guards and the radial return.  Compiled
// in hvi_laws.cpp only.

/* ----------------------------------------------------------------------
   The stress y with  y = Y(d_eps),  d_eps = (trial - y)/(3 G),  for a Y that
   does not fall and trial > y0 = Y(0): one root, between y0 and the trial.
   In y, not in d_eps, both are precise, for large trials and steep Y too.
   Chandrupatla's method, Adv. Eng. Softw. 28 (1997) 145: inverse quadratic
   interpolation where that is safe, else bisection.
------------------------------------------------------------------------- */

template <class Yield> double solve_return(double trial, double G, double y0, const Yield &Y)
{
  auto excess = [&](double y) {
    return Y((trial - y) / (3.0 * G)) - y;
  };
  double x1 = y0, f1 = excess(y0), x2 = trial, f2 = y0 - trial;
  if (f1 < trial - y0) {    // the flow stress of the largest d_eps is an upper bound too
    x2 = x1;
    f2 = f1;
    x1 = y0 + f1;
    f1 = excess(x1);
  }
  double t = f1 / (f1 - f2);
  for (int k = 0; k < 200; k++) {
    if (std::fabs(f1) <= 1e-15 * x1 || std::fabs(x1 - x2) <= 1e-15 * x1) break;
    if (!(t > 1e-15 && t < 1.0 - 1e-15)) t = 0.5;
    const double x = x1 + t * (x2 - x1), f = excess(x);
    double x3 = x1, f3 = f1;
    if ((f > 0.0) != (f1 > 0.0)) {
      x3 = x2;
      f3 = f2;
      x2 = x1;
      f2 = f1;
    }
    x1 = x;
    f1 = f;
    const double xi = (x1 - x2) / (x3 - x2), phi = (f1 - f2) / (f3 - f2);
    t = 0.5;
    if (phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi)
      t = f1 / (f2 - f1) * f3 / (f2 - f3) + (x3 - x1) / (x2 - x1) * f1 / (f3 - f1) * f2 / (f3 - f2);
  }
  return x1;
}

// whether a law can do that for LANES particles

template <class Law>
constexpr auto solves_many(const Law *law, int)
    -> decltype(law->solve(Vec(), Vec(), Vec(), Vec(), 0.0), true)
{
  return true;
}

template <class Law> constexpr bool solves_many(const Law *, long)
{
  return false;
}

template <class Law> class StrengthModel final : public Strength {
 public:
  explicit StrengthModel(const Law &law) : law(law) {}

  const char *name() const override { return law.name; }

  double shear_modulus(const Conditions &c) const override
  {
    return molten(c) ? 0.0 : positive(law.modulus(c));
  }

  double yield(double eps, double rate, const Conditions &c) const override
  {
    return scale(c) * law.flow(eps, rate, c);
  }

  double homologous_temperature(const Conditions &c) const override
  {
    if (molten(c)) return 1.0;
    return c.T > law.Tref ? (c.T - law.Tref) / (law.melt(c) - law.Tref) : 0.0;
  }

  Plastic radial_return(const Deviator &trial, double dt, double G, double eps,
                        const Conditions &c) const override
  {
    const double stress = von_mises(trial), factor = scale(c);
    const double y0 = factor * law.flow(eps, dt > 0.0 ? 0.0 : NOT_A_NUMBER, c);
    if (stress <= y0) return {trial, 0.0, 0.0, y0};
    if (!(stress > y0 && stress < NO_LIMIT && G >= 0.0))
      return {scaled(trial, NOT_A_NUMBER), NOT_A_NUMBER, NOT_A_NUMBER, NOT_A_NUMBER};
    if (3.0 * G <= 1e-100 * stress) return {scaled(trial, y0 / stress), 0.0, 0.0, y0};
    return returned(trial, stress, G, solve_return(stress, G, y0, [&](double x) {
                      return factor *
                          law.flow(eps + x, dt > 0.0 ? std::min(x / dt, 1e300) : NOT_A_NUMBER, c);
                    }));
  }

  void radial_return(int n, const Deviator *trial, double dt, const double *G, const double *eps,
                     const Conditions *c, Plastic *result) const override
  {
    if constexpr (solves_many((const Law *) nullptr, 0)) {
      Vec stress = {}, modulus = Vec{} + 1.0, factor = {}, before = {};
      bool usual[LANES];
      for (int k = 0; k < n; k++) {
        const double vm = von_mises(trial[k]);
        usual[k] = vm < NO_LIMIT && vm > 0.0 && 3.0 * G[k] > 1e-100 * vm;
        if (!usual[k]) continue;
        stress[k] = vm;
        modulus[k] = G[k];
        factor[k] = scale(c[k]);
        before[k] = eps[k];
      }
      const Vec y = law.solve(stress, modulus, factor, before, dt);
      for (int k = 0; k < n; k++)
        if (!usual[k] || !(y[k] >= 0.0))
          result[k] = radial_return(trial[k], dt, G[k], eps[k], c[k]);
        else if (y[k] == stress[k])
          result[k] = {trial[k], 0.0, 0.0, factor[k] * law.flow(eps[k], 0.0, c[k])};
        else
          result[k] = returned(trial[k], stress[k], G[k], y[k]);
    } else
      for (int k = 0; k < n; k++) result[k] = radial_return(trial[k], dt, G[k], eps[k], c[k]);
  }

 private:
  static constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();
  Law law;

  static Plastic returned(const Deviator &trial, double stress, double G, double y)
  {
    y = y < stress ? y : stress;    // the root may be past it by a rounding
    const double d_eps = (stress - y) / (3.0 * G);
    return {scaled(trial, y / stress), d_eps, y * d_eps, y};
  }

  bool molten(const Conditions &c) const { return c.T >= law.melt(c); }
  static double positive(double x) { return x < 0.0 ? 0.0 : x; }    // NaN stays
  double scale(const Conditions &c) const { return molten(c) ? 0.0 : positive(law.scale(c)); }
};

}    // namespace HVI

#endif
