/* ----------------------------------------------------------------------
   lammps-hvi: hypervelocity impact for LAMMPS, GNU GPL version 2, see LICENSE
   Hugoniots and isentropes of any equation of state, for the tests of the laws.
------------------------------------------------------------------------- */

#ifndef HVI_TEST_EOS_PATHS_H
#define HVI_TEST_EOS_PATHS_H

#include "hvi_eos.h"

#include <gtest/gtest.h>

namespace HVI_TEST {

struct State {
  double rho, e, p, csq;
};

inline State at(const HVI::Eos &law, double rho, double e)
{
  State s = {rho, e, 0.0, 0.0};
  EXPECT_TRUE(law.evaluate(rho, e, s.p, s.csq)) << law.name() << " rho " << rho << " e " << e;
  return s;
}

// Behind a shock that brings matter at rest, at rho0 and e = 0, to the velocity u: momentum
// p = rho0 Us u, mass rho0 Us = rho (Us - u), energy e = u^2/2, solved for rho by bisection.

inline State hugoniot(const HVI::Eos &law, double rho0, double u, double highest)
{
  double lo = rho0 * (1.0 + 1e-6), hi = highest;
  const double e = 0.5 * u * u;
  for (int k = 0; k < 100; k++) {
    const double rho = 0.5 * (lo + hi);
    (at(law, rho, e).p < rho0 * u * u / (1.0 - rho0 / rho) ? lo : hi) = rho;
  }
  return at(law, lo, e);
}

// one step of Dormand and Prince's fifth order along dy/dx = f(x, y)

template <class F> double step5(const F &f, double x, double y, double h)
{
  const double k1 = f(x, y), k2 = f(x + h / 5, y + h * k1 / 5),
               k3 = f(x + 0.3 * h, y + h * (3 * k1 + 9 * k2) / 40),
               k4 = f(x + 0.8 * h, y + h * (44 * k1 / 45 - 56 * k2 / 15 + 32 * k3 / 9)),
               k5 = f(x + h * 8 / 9,
                      y +
                          h *
                              (19372 * k1 / 6561 - 25360 * k2 / 2187 + 64448 * k3 / 6561 -
                               212 * k4 / 729)),
               k6 = f(x + h,
                      y +
                          h *
                              (9017 * k1 / 3168 - 355 * k2 / 33 + 46732 * k3 / 5247 +
                               49 * k4 / 176 - 5103 * k5 / 18656));
  return y +
      h * (35 * k1 / 384 + 500 * k3 / 1113 + 125 * k4 / 192 - 2187 * k5 / 6784 + 11 * k6 / 84);
}

// along de/d ln rho = p/rho, from a state to another density, in n steps

inline double isentrope(const HVI::Eos &law, double rho, double e, double end, int n)
{
  auto f = [&law](double x, double y) {
    const double r = std::exp(x);
    return at(law, r, y).p / r;
  };
  const double x = std::log(rho), h = (std::log(end) - x) / n;
  for (int k = 0; k < n; k++) e = step5(f, x + k * h, e, h);
  return e;
}

// The density where the isentrope has come down to p = 0, and its e: steps of h in ln rho down to
// the sign change, then bisection in the last step.

inline State released(const HVI::Eos &law, const State &from, double h)
{
  double rho = from.rho, e = from.e;
  for (int k = 0; k < 100000; k++) {
    const double next = rho * std::exp(-h), en = isentrope(law, rho, e, next, 1);
    if (at(law, next, en).p <= 0.0) {
      double lo = 0.0, hi = h;
      for (int l = 0; l < 60; l++) {
        const double mid = 0.5 * (lo + hi), r = rho * std::exp(-mid);
        (at(law, r, isentrope(law, rho, e, r, 1)).p > 0.0 ? lo : hi) = mid;
      }
      const double r = rho * std::exp(-lo);
      return at(law, r, isentrope(law, rho, e, r, 1));
    }
    rho = next;
    e = en;
  }
  ADD_FAILURE() << "pressure never falls to 0";
  return from;
}

// dp/drho along the isentrope through a state, from five points of it

inline double slope_of_isentrope(const HVI::Eos &law, double rho, double e, double d)
{
  auto p = [&](double k) {
    const double end = rho + k * d;
    return at(law, end, isentrope(law, rho, e, end, 1)).p;
  };
  return (8 * (p(1) - p(-1)) - p(2) + p(-2)) / (12 * d);
}

}    // namespace HVI_TEST

#endif
