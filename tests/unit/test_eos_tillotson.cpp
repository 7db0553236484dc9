/* ----------------------------------------------------------------------
   lammps-hvi: hypervelocity impact for LAMMPS, GNU GPL version 2, see LICENSE
   Tillotson's equation of state: the formulas as printed, branches and their borders, Hugoniots
   of Al, Fe and Cu against shock data, release isentropes.
------------------------------------------------------------------------- */

#include "eos_paths.h"

using HVI::Eos;
using namespace HVI_TEST;

namespace {

struct Metal {
  const char *name;
  double rho0, a, b, A, B, E0, Eiv, Ecv, alpha, beta;

  std::unique_ptr<Eos> law(double cp = 0.0) const
  {
    std::string problem;
    auto made =
        HVI::make_eos("tillotson", {rho0, a, b, A, B, E0, Eiv, Ecv, alpha, beta, cp}, problem);
    EXPECT_TRUE(made) << problem;
    return made;
  }
};

constexpr Metal AL = {"Al", 2700, 0.5, 1.63, 75.2e9, 65e9, 5e6, 3e6, 13.9e6, 5, 5};
constexpr Metal FE = {"Fe", 7860, 0.5, 1.5, 128e9, 105e9, 9.5e6, 1.42e6, 8.45e6, 5, 5};
constexpr Metal CU = {"Cu", 8900, 0.5, 1.5, 139e9, 110e9, 32.5e6, 1.35e6, 3.0e6, 5, 5};
// nothing equal to anything else, so that no two parameters can be exchanged unseen
constexpr Metal ODD = {"odd", 3000, 0.4, 1.2, 60e9, 40e9, 7e6, 2e6, 9e6, 4, 6};
constexpr Metal METALS[] = {AL, FE, CU, ODD};

enum Branch { DENSE, MIXED, VAPOR };

Branch branch(const Metal &m, double rho, double e)
{
  if (rho >= m.rho0 || e <= m.Eiv) return DENSE;
  return e >= m.Ecv ? VAPOR : MIXED;
}

// as Tillotson and Melosh print it, for e >= 0

double printed(const Metal &m, double rho, double e)
{
  const double eta = rho / m.rho0, mu = eta - 1;
  const double b = m.b / (e / (m.E0 * eta * eta) + 1);
  const double dense = (m.a + b) * rho * e + m.A * mu + m.B * mu * mu;
  const double v = m.rho0 / rho - 1;
  const double vapor =
      m.a * rho * e + (b * rho * e + m.A * mu * std::exp(-m.beta * v)) * std::exp(-m.alpha * v * v);
  switch (branch(m, rho, e)) {
    case DENSE:
      return dense;
    case VAPOR:
      return vapor;
    default:
      return ((e - m.Eiv) * vapor + (m.Ecv - e) * dense) / (m.Ecv - m.Eiv);
  }
}

// densities and energies of every branch, away from the borders (e = 0 is one, for omega)

template <class F> void everywhere(const F &f)
{
  int n[3] = {0, 0, 0};
  for (const Metal &m : METALS)
    for (double x : {0.02, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 1.01, 1.1, 1.5, 2.0, 3.0})
      for (double heat : {0.03, 0.1, 0.5, 0.95})
        for (int part = 0; part < 3; part++) {
          const double e = part == 0 ? heat * m.Eiv
              : part == 1            ? m.Eiv + heat * (m.Ecv - m.Eiv)
                                     : m.Ecv * (1.05 + 10 * heat);
          n[branch(m, x * m.rho0, e)]++;
          f(m, x * m.rho0, e);
        }
  for (int k : n) EXPECT_GT(k, 50);
}

/* ---------------------------------------------------------------------- */

TEST(Tillotson, PressureAsPrinted)
{
  everywhere([](const Metal &m, double rho, double e) {
    const double p = printed(m, rho, e);
    EXPECT_NEAR(at(*m.law(), rho, e).p, p, 1e-12 * (m.A + std::fabs(p)))
        << m.name << " " << rho << " " << e;
  });
}

TEST(Tillotson, SoundSpeedIsTheSlopeOfTheIsentrope)
{
  int n[3] = {0, 0, 0};
  everywhere([&n](const Metal &m, double rho, double e) {
    const auto law = m.law();
    const double d = 5e-5 * rho, slope = slope_of_isentrope(*law, rho, e, d);
    if (slope < 1e-3 * m.A / m.rho0) {    // in tension; there is a floor
      EXPECT_LT(at(*law, rho, e).csq, 1.001e-3 * m.A / m.rho0);
      return;
    }
    EXPECT_NEAR(at(*law, rho, e).csq, slope, 1e-7 * slope) << m.name << " " << rho << " " << e;
    n[branch(m, rho, e)]++;
  });
  for (int k : n) EXPECT_GT(k, 40);
}

TEST(Tillotson, IsContinuousAcrossBorders)
{
  for (const Metal &m : METALS) {
    const auto law = m.law();
    const double d = 1e-10;
    for (double x = 0.02; x < 2.0; x += 0.0499)
      for (double border : {m.Eiv, m.Ecv}) {
        const double scale = m.A + 10 * m.rho0 * border;
        EXPECT_NEAR(at(*law, x * m.rho0, border * (1 + d)).p,
                    at(*law, x * m.rho0, border * (1 - d)).p, 10 * d * scale)
            << m.name << x;
        EXPECT_NEAR(at(*law, x * m.rho0, border).p, at(*law, x * m.rho0, border * (1 - d)).p,
                    10 * d * scale);
      }
    for (double e = 0.0; e < 3 * m.Ecv; e += 0.0917 * m.Ecv) {
      const State lo = at(*law, m.rho0 * (1 - d), e), hi = at(*law, m.rho0 * (1 + d), e);
      EXPECT_NEAR(lo.p, hi.p, 10 * d * (m.A + 10 * m.rho0 * e)) << m.name << e;
      EXPECT_NEAR(lo.csq, hi.csq, 1e-7 * hi.csq) << m.name << e;    // the speed of sound, too
    }
  }
}

TEST(Tillotson, ReferenceState)
{
  for (const Metal &m : METALS) {
    const auto law = m.law();
    const State s = at(*law, m.rho0, 0.0);
    EXPECT_EQ(s.p, 0.0);
    EXPECT_NEAR(s.csq, m.A / m.rho0, 1e-14 * s.csq);
    EXPECT_NEAR(law->c0(), std::sqrt(m.A / m.rho0), 1e-12 * law->c0());
    EXPECT_EQ(law->rho0(), m.rho0);
    EXPECT_EQ(law->rho_max(), HVI::NO_LIMIT);
  }
}

// omega would vanish at e = -E0 eta^2

TEST(Tillotson, NoPoleAtNegativeEnergies)
{
  for (const Metal &m : METALS)
    for (double x : {1e-3, 0.1, 0.5, 1.0, 1.5}) {
      const auto law = m.law();
      const double rho = x * m.rho0, pole = m.E0 * x * x;
      const double cold = at(*law, rho, 0.0).p;
      for (double e : {-1e-3 * pole, -0.5 * pole, -pole, -1.0001 * pole, -3 * pole})
        EXPECT_NEAR(at(*law, rho, e).p, cold + (m.a + m.b) * rho * e, 1e-12 * (m.A - 10 * rho * e));
      // slopes join at e = 0
      const double d = 1e-6 * pole;
      const double up = (at(*law, rho, d).p - cold) / d, down = (cold - at(*law, rho, -d).p) / d;
      EXPECT_NEAR(up, down, 1e-5 * up + 1e-15 * m.A / d);
    }
}

TEST(Tillotson, FarStatesAreNumbersOrNoAnswer)
{
  for (const Metal &m : METALS)
    for (double rho : {5e-324, 1e-300, 1e-200, 1e-100, 1e-20, 1e-5, 1e20, 1e200})
      for (double e : {-1e300, -1e10, 0.0, 1.0, 1.5e6, 5e6, 1e10, 1e300}) {
        double p, csq;
        const bool good = m.law()->evaluate(rho, e, p, csq);
        EXPECT_EQ(good, std::isfinite(p) && std::isfinite(csq)) << rho << " " << e;
        // vapor has an answer at any density
        if (rho > (e > 1e9 ? 1e-201 : 1e-101) && rho < 1 && std::fabs(e) < 1e11) {
          EXPECT_TRUE(good) << rho << " " << e;
        }
      }
  // hot vapor is an ideal gas with gamma = 1 + a
  const State s = at(*AL.law(), 1e-6 * AL.rho0, 1e9);
  EXPECT_NEAR(s.p, AL.a * s.rho * s.e, 1e-10 * s.p);
  EXPECT_NEAR(s.csq, AL.a * (1 + AL.a) * s.e, 1e-10 * s.csq);
}

/* ----------------------------------------------------------------------
   Shock data Us = c + s u: Al 1100 and Cu of Steinberg (1996), as in their material files; Fe of
   McQueen, Marsh, Taylor, Fritz & Carter in High-Velocity Impact Phenomena (1970), above its
   transition at 13 GPa.  The limits are the deviations measured here, rounded up; Tillotson's law
   is no fit to these lines.
------------------------------------------------------------------------- */

struct Shock {
  Metal metal;
  double c, s, first, low, high;    // from which u on; limits of Us/data - 1
};

const Shock SHOCKS[] = {{AL, 5386, 1.339, 500, -0.0066, 0.0158},
                        {FE, 3955, 1.580, 1000, -0.0474, -0.0088},
                        {CU, 3940, 1.489, 500, -0.0052, 0.0280}};

TEST(Tillotson, HugoniotsAgainstShockData)
{
  for (const Shock &data : SHOCKS) {
    const auto law = data.metal.law();
    const double rho0 = data.metal.rho0;
    double low = 1, high = -1;
    for (double u = data.first; u < 5001; u += 250) {
      const State s = hugoniot(*law, rho0, u, 4 * rho0);
      // the energy equation, in the form without velocities
      EXPECT_NEAR(s.e, 0.5 * s.p * (1 / rho0 - 1 / s.rho), 1e-9 * s.e);
      EXPECT_GT(s.rho, rho0);
      const double Us = s.p / (rho0 * u), off = Us / (data.c + data.s * u) - 1;
      low = std::min(low, off);
      high = std::max(high, off);
      EXPECT_GT(off, data.low) << data.metal.name << " u " << u;
      EXPECT_LT(off, data.high) << data.metal.name << " u " << u;
    }
    RecordProperty(std::string(data.metal.name) + "_percent",
                   std::to_string(100 * low) + " to " + std::to_string(100 * high));
  }
}

/* ---------------------------------------------------------------------- */

// Down the isentrope from a shock, dp/drho from the ODE's own pressures: 4th-order differences over
// five neighbors on the path, where these are on one branch.

struct Walk {
  int n[3];
  double worst;
};

Walk walk(const Metal &m, double u, double end, double h)
{
  const auto law = m.law();
  const State shock = hugoniot(*law, m.rho0, u, 4 * m.rho0);
  std::vector<State> path = {shock};
  while (path.back().rho > end && path.back().p > 0.0) {
    const double rho = path.back().rho * std::exp(-h);
    path.push_back(at(*law, rho, isentrope(*law, path.back().rho, path.back().e, rho, 1)));
  }
  Walk w = {{0, 0, 0}, 0.0};
  for (std::size_t k = 2; k + 2 < path.size(); k++) {
    const State &s = path[k];
    const Branch here = branch(m, s.rho, s.e);
    // in one branch, and on one side of rho0, where the third derivative jumps
    if (branch(m, path[k - 2].rho, path[k - 2].e) != here ||
        branch(m, path[k + 2].rho, path[k + 2].e) != here ||
        (path[k - 2].rho > m.rho0) != (path[k + 2].rho > m.rho0))
      continue;
    const double slope =
        (8 * (path[k - 1].p - path[k + 1].p) - path[k - 2].p + path[k + 2].p) / (12 * h * s.rho);
    w.worst = std::max(w.worst, std::fabs(slope - s.csq) / s.csq);
    w.n[here]++;
  }
  return w;
}

TEST(Tillotson, SoundSpeedAlongReleaseIsentropes)
{
  for (const Metal &m : METALS)
    for (double u : {500.0, 2000.0, 4000.0, 6000.0, 9000.0, 15000.0}) {
      const Walk w = walk(m, u, 0.05 * m.rho0, 1e-3);
      EXPECT_LT(w.worst, 1e-6) << m.name << " " << u;
      EXPECT_GT(w.n[DENSE], 20);
      if (u == 9000) { EXPECT_GT(w.n[MIXED], 100) << m.name; }
      if (u == 15000) { EXPECT_GT(w.n[VAPOR], 100) << m.name; }
    }
}

// The same isentrope from the speed of sound alone: drho/dp = 1/c^2, de/dp = p/(rho c)^2.  What it
// arrives at must have the pressure that was the variable, through all branches.

TEST(Tillotson, ReleaseByTheSpeedOfSoundKeepsThePressure)
{
  for (const Metal &m : METALS)
    for (double u : {1000.0, 4000.0, 9000.0, 15000.0}) {
      const auto law = m.law();
      const State shock = hugoniot(*law, m.rho0, u, 4 * m.rho0);
      auto slopes = [](const State &s, double &drho, double &de) {    // by ln p
        drho = s.p / s.csq;
        de = s.p * s.p / (s.rho * s.rho * s.csq);
      };
      auto step = [&](const State &s, double h) {
        double r[4], e[4];
        slopes(s, r[0], e[0]);
        slopes(at(*law, s.rho + h / 2 * r[0], s.e + h / 2 * e[0]), r[1], e[1]);
        slopes(at(*law, s.rho + h / 2 * r[1], s.e + h / 2 * e[1]), r[2], e[2]);
        slopes(at(*law, s.rho + h * r[2], s.e + h * e[2]), r[3], e[3]);
        return at(*law, s.rho + h / 6 * (r[0] + 2 * (r[1] + r[2]) + r[3]),
                  s.e + h / 6 * (e[0] + 2 * (e[1] + e[2]) + e[3]));
      };
      // down to a thousandth of the pressure, across borders, where c jumps, in small steps
      const int n = 5000, fine = 20000;
      const double h = std::log(1e-3) / n;
      State s = shock;
      double worst = 0;
      for (int k = 1; k <= n; k++) {
        const State next = step(s, h);
        if (branch(m, next.rho, next.e) == branch(m, s.rho, s.e))
          s = next;
        else
          for (int l = 0; l < fine; l++) s = step(s, h / fine);
        const double p = shock.p * std::exp(k * h);
        worst = std::max(worst, std::fabs(s.p - p) / p);
      }
      EXPECT_LT(worst, 1e-6) << m.name << " " << u;
      // and the energy that of the isentrope by density
      EXPECT_NEAR(isentrope(*law, shock.rho, shock.e, s.rho, 20000), s.e, 1e-5 * shock.e);
    }
}

// A release to p = 0 ends below rho0, the lower the stronger the shock, and hotter than it began;
// the free surface moves at about twice the velocity of the matter behind the shock.

TEST(Tillotson, ReleaseToZeroPressure)
{
  for (const Metal &m : {AL, FE, CU}) {
    const auto law = m.law();
    double rho = m.rho0, e = 0;
    for (double u : {500.0, 1000.0, 1500.0, 2000.0}) {
      const State s = released(*law, hugoniot(*law, m.rho0, u, 4 * m.rho0), 1e-3);
      EXPECT_NEAR(s.p, 0.0, 1e-9 * m.A);
      EXPECT_LT(s.rho, rho);
      EXPECT_GT(s.e, e);
      EXPECT_LT(s.e, 0.5 * u * u);
      rho = s.rho;
      e = s.e;
    }
  }
}

/* ---------------------------------------------------------------------- */

TEST(Tillotson, Temperature)
{
  const double cp = 884;
  const auto law = AL.law(cp);
  EXPECT_TRUE(std::isnan(AL.law()->temperature(3000, 1e5)));
  EXPECT_EQ(law->temperature(AL.rho0, 0.0), 300.0);
  EXPECT_NEAR(law->temperature(AL.rho0, 1e5), 300 + 1e5 / cp, 1e-9);
  EXPECT_EQ(law->temperature(0.3 * AL.rho0, 1e5), 300 + 1e5 / cp);
  EXPECT_EQ(law->temperature(AL.rho0, -1e9), 0.0);

  // up the isentrope through the reference state: d ln T = Gamma d ln rho, rho Gamma = dp/de; past
  // the end of the table at 3.3 rho0, too
  double T = 300, e = 0, lnrho = std::log(AL.rho0);
  const double h = 1e-4;
  for (int k = 1; k < 14000; k++) {
    const double mid = std::exp(lnrho + h / 2), em = isentrope(*law, std::exp(lnrho), e, mid, 1);
    const double de = 1e-4 * (em + 1e5);
    const double gamma = (at(*law, mid, em + de).p - at(*law, mid, em - de).p) / (2 * de * mid);
    T *= std::exp(h * gamma);
    const double next = std::exp(lnrho + h);
    e = isentrope(*law, std::exp(lnrho), e, next, 1);
    lnrho += h;
    if (k % 100 == 0) {
      ASSERT_NEAR(law->temperature(next, e), T, 2e-5 * T) << next / AL.rho0;
      EXPECT_NEAR(law->temperature(next, e + cp * 50), T + 50, 2e-5 * T);
    }
  }
  EXPECT_GT(lnrho, std::log(4 * AL.rho0));
}

TEST(Tillotson, WrongParameters)
{
  auto refused = [](std::size_t k, double value, const std::string &why) {
    std::vector<double> args = {2700, .5, 1.63, 75.2e9, 65e9, 5e6, 3e6, 13.9e6, 5, 5, 0};
    args[k] = value;
    std::string problem;
    EXPECT_FALSE(HVI::make_eos("tillotson", args, problem));
    EXPECT_EQ(problem, why);
  };
  refused(0, 0, "rho0 = 0 must be > 0");
  refused(1, -0.5, "a = -0.5 must be >= 0");
  refused(3, 0, "A = 0 must be > 0");
  refused(5, 0, "E0 = 0 must be > 0");
  refused(7, 3e6, "Ecv = 3e+06 must be > Eiv = 3e+06");
  refused(7, 2e6, "Ecv = 2e+06 must be > Eiv = 3e+06");
  refused(8, 0, "alpha = 0 must be > 0");
  refused(9, HVI::NO_LIMIT, "beta = inf is not a finite number");
  std::string problem;
  EXPECT_FALSE(HVI::make_eos("tillotson", {2700, .5}, problem));
  EXPECT_EQ(problem, "takes 11 values (rho0 a b A B E0 Eiv Ecv alpha beta cp), not 2");
}

}    // namespace
