/* ----------------------------------------------------------------------
   lammps-hvi: hypervelocity impact for LAMMPS, GNU GPL version 2, see LICENSE
   Hot expanded matter by the laws about a Hugoniot: joins at rho0, is a gas where it is thin, and has a
   speed of sound that is bounded; beside Tillotson's law and measured liquid aluminum.
------------------------------------------------------------------------- */

#include "eos_paths.h"

using HVI::Eos;
using namespace HVI_TEST;

namespace {

// a law, and the energy that binds its vapor: where its line has no pressure at density 0

struct Bound {
  std::unique_ptr<Eos> law;
  double energy;
};

Bound gruneisen(double rho0, double C, double S1, double g0, double a)
{
  std::string problem;
  return {HVI::make_eos("gruneisen", {rho0, C, S1, g0, a, 900}, problem),
          C * C / std::max(g0 - a, 0.5 * g0)};
}

Bound aluminum()
{
  return gruneisen(2707, 5386, 1.339, 1.97, 0.48);
}

std::vector<Bound> all()
{
  std::string problem;
  std::vector<Bound> laws;
  laws.push_back(aluminum());
  laws.push_back(gruneisen(11340, 2006, 1.429, 2.74, 0.54));
  laws.push_back(gruneisen(1000, 1500, 1.5, 0.3, 0.0));          // less Gamma than vapor has
  laws.push_back(gruneisen(1000, 1500, 1.5, 1.0, -0.3));         // more, as it expands
  laws.push_back(gruneisen(998, 1480, 2.56, 0.4934, 1.3937));    // g0 < a: water
  laws.push_back(
      {HVI::make_eos("mie-gruneisen", {2785, 5240, 1.338, 2.0, 875}, problem), 5240.0 * 5240 / 2});
  laws.push_back({HVI::make_eos("polynomial",
                                {2700, 7.6e10, 1e11, 5e10, 2.0, 1.0, 0.3, 7.6e10, 0, 885}, problem),
                  7.6e10 / 5400});
  laws.push_back({HVI::make_eos("polynomial",
                                {2700, 7.6e10, 1e11, 5e10, 2.0, 1.0, 0, 5e10, 1e9, 885}, problem),
                  4.9e10 / 5400});
  return laws;
}

/* ---------------------------------------------------------------------- */

// p and c go through rho0 without a jump, of hot matter, too; where they did before this law was there

TEST(Expansion, JoinsAtTheReferenceDensity)
{
  for (const auto &one : all()) {
    if (one.law->name() == std::string("polynomial")) continue;    // whose c jumps with B1 and T1
    const double rho0 = one.law->rho0(), csq = one.law->c0() * one.law->c0(), d = 1e-10;
    for (double heat : {0.01, 0.1, 1.0}) {
      const State above = at(*one.law, rho0 * (1 + d), heat * csq);
      const State below = at(*one.law, rho0 * (1 - d), heat * csq);
      EXPECT_NEAR(above.p, below.p, 1e-6 * above.p) << heat;
      EXPECT_NEAR(above.csq, below.csq, 1e-6 * above.csq) << heat;
    }
  }
}

// c^2 is the slope of isentropes, from next to rho0 to thin vapor

TEST(Expansion, SoundSpeedIsTheSlopeOfTheIsentrope)
{
  for (const auto &one : all())
    for (double x : {0.99, 0.9, 0.7, 0.4, 0.1, 0.01})
      for (double heat : {1.5, 4.0}) {
        const double rho = x * one.law->rho0(), e = heat * one.energy;
        EXPECT_NEAR(at(*one.law, rho, e).csq / slope_of_isentrope(*one.law, rho, e, 1e-4 * rho),
                    1.0, 1e-7)
            << one.law->name() << " " << x << " " << heat;
      }
}

// p = (gamma - 1) rho (e - binding energy), c^2 = gamma p/rho, gamma 5/3, or as near as Gamma of the law lets it

TEST(Expansion, ThinMatterIsAGas)
{
  for (const auto &one : all()) {
    const double rho = 1e-6 * one.law->rho0(), e = 3.0 * one.energy;
    const State s = at(*one.law, rho, e);
    EXPECT_NEAR(s.p / (2.0 / 3.0 * rho * (e - one.energy)), 1.0, 1e-4) << one.law->name();
    EXPECT_NEAR(s.csq / (5.0 / 3.0 * s.p / rho), 1.0, 1e-4) << one.law->name();
    for (double x : {1e-9, 1e-13, 1e-17, 1e-100}) {
      const State thin = at(*one.law, x * one.law->rho0(), e);
      EXPECT_TRUE(thin.p >= 0.0 && thin.p < 2.0 * x / 1e-6 * s.p + 1e-300) << x;
      EXPECT_LT(thin.csq, 2.0 * s.csq) << x;
    }
  }
}

// Nothing expanded has more than three times the c^2 of what has that energy at rho0, or of its vapor.  With the
// line alone, aluminum of 2e7 J/kg has 31 km/s at a tenth of its density, and 1900 at a thousandth.

TEST(Expansion, SoundSpeedIsBounded)
{
  for (const auto &one : all()) {
    const double csq = one.law->c0() * one.law->c0(), rho0 = one.law->rho0();
    for (double heat = 0.01; heat < 100.0; heat *= 1.3) {
      const double dense = std::max(at(*one.law, rho0 * (1 + 1e-12), heat * csq).csq,
                                    csq * (1.0 + 10.0 / 9.0 * heat));
      for (double x = 1.0; x > 1e-7; x *= 0.97) {
        const State s = at(*one.law, x * rho0, heat * csq);
        EXPECT_LT(s.csq, 3.0 * dense) << one.law->name() << " " << x << " " << heat;
        if (s.p > 0.0) {
          EXPECT_GT(s.csq, 0.25 * s.p / (x * rho0)) << one.law->name() << " " << x << " " << heat;
        }
      }
    }
  }
}

// pressure of a given energy falls as matter expands, to nothing; always, where Gamma rho does not rise at first

TEST(Expansion, PressureFallsToNothing)
{
  const auto laws = all();
  for (const auto &one : laws)
    for (double heat : {1.2, 2.0, 10.0}) {
      double last = HVI::NO_LIMIT;
      for (double x = 1.0; x > 1e-6; x *= 0.97) {
        const double p = at(*one.law, x * one.law->rho0(), heat * one.energy).p;
        EXPECT_TRUE(p > 0.0 && (p < last || &one == &laws[3]))
            << one.law->name() << " " << x << " " << heat;
        last = p;
      }
      EXPECT_LT(last, 1e-5 * at(*one.law, one.law->rho0(), heat * one.energy).p);
    }
}

// Beside Tillotson's aluminum, an independent law of metal and vapor: what is fully vaporized has its
// pressure within a factor of 3 from 0.4 to 0.05 of the density; by the line alone up to 33 times as much

TEST(Expansion, VaporBesideTillotson)
{
  std::string problem;
  const auto other = HVI::make_eos(
      "tillotson", {2700, 0.5, 1.63, 75.2e9, 65e9, 5e6, 3e6, 13.9e6, 5, 5, 884}, problem);
  const Bound one = aluminum();
  for (double e : {2.5e7, 3e7, 4e7})
    for (double x : {0.4, 0.3, 0.2, 0.1, 0.05}) {
      const double ratio = at(*one.law, 2707 * x, e).p / at(*other, 2700 * x, e).p;
      EXPECT_TRUE(ratio > 1.0 / 3.0 && ratio < 3.0) << e << " " << x << " " << ratio;
    }
}

// The speed that matter reaches when a shock of up to 217 GPa comes to a free surface is that of Tillotson's
// law to 1.5 %; released from there it is nowhere so thin that the vapor counts

TEST(Expansion, ReleaseToZeroPressure)
{
  std::string problem;
  const auto other = HVI::make_eos(
      "tillotson", {2700, 0.5, 1.63, 75.2e9, 65e9, 5e6, 3e6, 13.9e6, 5, 5, 884}, problem);
  const Bound one = aluminum();
  auto free_surface = [](const Eos &law, double u, double highest) {
    const State s = hugoniot(law, law.rho0(), u, highest);
    double rho = s.rho, e = s.e, c = std::sqrt(s.csq), speed = u;
    const double h = 1e-3;
    for (int k = 0; k < 2000; k++) {
      const double next = rho * std::exp(-h);
      e = isentrope(law, rho, e, next, 1);
      const State n = at(law, next, e);
      if (n.p <= 0.0) break;
      speed += 0.5 * h * (c + std::sqrt(n.csq));
      c = std::sqrt(n.csq);
      rho = next;
    }
    return speed;
  };
  for (double u : {1e3, 2e3, 3e3, 4e3, 5e3, 6e3})
    EXPECT_NEAR(free_surface(*one.law, u, 0.999 * one.law->rho_max()) /
                    free_surface(*other, u, 4.0 * 2700),
                1.0, 0.015)
        << u;
}

}    // namespace
