/* ----------------------------------------------------------------------
   lammps-hvi: hypervelocity impact for LAMMPS, GNU GPL version 2, see LICENSE
   Equations of state, against the analytic Hugoniot and the laws of thermodynamics.
------------------------------------------------------------------------- */

#include "hvi_eos.h"

#include <gtest/gtest.h>

using HVI::Eos;

namespace {

std::unique_ptr<Eos> eos(const std::string &name, const std::vector<double> &args)
{
  std::string problem;
  auto law = HVI::make_eos(name, args, problem);
  EXPECT_TRUE(law) << problem;
  EXPECT_EQ(problem, "");
  return law;
}

std::unique_ptr<Eos> eos_full(const std::string &name, const std::vector<double> &values)
{
  std::string problem;
  auto law = HVI::make_eos_full(name, values, problem);
  EXPECT_TRUE(law) << problem;
  return law;
}

double pressure(const Eos &law, double rho, double e)
{
  double p, csq;
  EXPECT_TRUE(law.evaluate(rho, e, p, csq)) << law.name() << " rho " << rho << " e " << e;
  return p;
}

double csq(const Eos &law, double rho, double e)
{
  double p, c2;
  EXPECT_TRUE(law.evaluate(rho, e, p, c2));
  return c2;
}

constexpr double RHO0 = 2703, C0 = 5240, S = 1.40;    // Al 6061
constexpr double NAN_ = std::numeric_limits<double>::quiet_NaN();

std::unique_ptr<Eos> al_gruneisen(double a)
{
  return eos("gruneisen", {RHO0, C0, S, 1.97, a, 885});
}
std::unique_ptr<Eos> al_mie()
{
  return eos("mie-gruneisen", {RHO0, C0, S, 1.97, 885});
}

// one of each, for what must hold for all of them

std::vector<std::unique_ptr<Eos>> all()
{
  std::vector<std::unique_ptr<Eos>> laws;
  laws.push_back(eos("linear", {2700, 7.6e10}));
  laws.push_back(eos("tait", {1000, 1500, 7}));
  laws.push_back(eos("tait", {1000, 1500, 3.3}));
  laws.push_back(al_gruneisen(0));
  laws.push_back(al_gruneisen(0.48));
  laws.push_back(eos_full("gruneisen", {11340, 2006, 1.429, 2.74, 0.54, 124, 0.8506, -1.64, 300}));
  laws.push_back(al_mie());
  laws.push_back(eos("polynomial", {2700, 7.6e10, 1e11, 5e10, 2.0, 1.0, 0.3, 7.6e10, 0, 885}));
  laws.push_back(eos("polynomial", {2700, 7.6e10, 1e11, 5e10, 2.0, 1.0, 0, 5e10, 1e9, 885}));
  laws.push_back(eos("tillotson", {2700, 0.5, 1.63, 75.2e9, 65e9, 5e6, 3e6, 13.9e6, 5, 5, 0}));
  return laws;
}

/* ---------------------------------------------------------------------- */

// On the Hugoniot rho0 Us = rho (Us - u), p = rho0 Us u, e = u^2/2

TEST(Hugoniot, PressureIsRho0UsU)
{
  for (double a : {0.0, 0.48, -0.3, 2.0})
    for (double u = 1.0; u < 20000.0; u *= 1.1) {
      const double Us = C0 + S * u, rho = RHO0 * Us / (Us - u), e = 0.5 * u * u;
      const auto law = al_gruneisen(a);
      if (rho >= law->rho_max()) break;    // with a = 2, from 9 km/s on
      EXPECT_NEAR(pressure(*law, rho, e) / (RHO0 * Us * u), 1.0, 1e-10) << u;
      EXPECT_NEAR(pressure(*al_mie(), rho, e) / (RHO0 * Us * u), 1.0, 1e-10) << u;
    }
}

// the LS-DYNA form with Us = C + S1 u + S2 (u/Us) u + S3 (u/Us)^2 u, Steinberg's lead

TEST(Hugoniot, CubicOfLead)
{
  const double rho0 = 11340, C = 2006, S1 = 1.429, S2 = 0.8506, S3 = -1.64;
  const auto law = eos_full("gruneisen", {rho0, C, S1, 2.74, 0.54, 124, S2, S3, 300});
  for (double eta = 0.001; eta < 0.573; eta += 0.001) {
    const double Us = C / (1.0 - eta * (S1 + eta * (S2 + eta * S3))), u = eta * Us;
    EXPECT_NEAR(Us, C + S1 * u + S2 * eta * u + S3 * eta * eta * u, 1e-9 * Us);
    EXPECT_NEAR(pressure(*law, rho0 / (1.0 - eta), 0.5 * u * u) / (rho0 * Us * u), 1.0, 1e-10);
  }
}

// the form as it is printed in LS-DYNA's manual; what pushes in expansion pushes less, of second order at rho0

TEST(Hugoniot, LsDynaFormAsPrinted)
{
  const double g0 = 2.74, a = 0.54, S1 = 1.429, S2 = 0.8506, S3 = -1.64, rho0 = 11340, C = 2006;
  const auto law = eos_full("gruneisen", {rho0, C, S1, g0, a, 124, S2, S3, 300});
  for (double mu = -0.5; mu < 1.2; mu += 0.01)
    for (double e : {0.0, 1e6, -1e5}) {
      const double D =
          1 - (S1 - 1) * mu - S2 * mu * mu / (mu + 1) - S3 * mu * mu * mu / ((mu + 1) * (mu + 1));
      const double thermal = (g0 + a * mu) * rho0 * e;
      const double cold = rho0 * C * C * mu;
      const double p = mu > 0 ? cold * (1 + (1 - g0 / 2) * mu - a / 2 * mu * mu) / (D * D) + thermal
                              : cold + thermal;
      const double here = pressure(*law, rho0 * (1 + mu), e);
      if (mu < -1e-9 && p > 0) {
        EXPECT_LT(here, p) << mu;
        EXPECT_GT(here, (1 - 3 * mu * mu) * p) << mu;
      } else
        EXPECT_NEAR(here, p, 1e-12 * std::fabs(p) + 1.0) << mu;
    }
}

TEST(Hugoniot, MieGruneisenIsGruneisenWithoutA)
{
  const auto one = al_gruneisen(0), two = al_mie();
  for (double rho = 1000; rho < 7000; rho += 77)
    for (double e : {0.0, 3e5, 1e7}) {
      double p1, c1, p2, c2;
      EXPECT_TRUE(one->evaluate(rho, e, p1, c1));
      EXPECT_TRUE(two->evaluate(rho, e, p2, c2));
      EXPECT_NEAR(p1, p2, 1e-12 * std::fabs(p2) + 1.0);
      EXPECT_NEAR(c1, c2, 1e-12 * c2);
      EXPECT_NEAR(one->temperature(rho, e), two->temperature(rho, e), 1e-6);
    }
}

// symmetric flyer plates, Al 6061: table of validation numbers, P in GPa

TEST(Hugoniot, FlyerPlates)
{
  const double V[9] = {500, 1000, 2000, 3000, 5000, 5941, 6700, 7000, 10000};
  const double P[9] = {3.777, 8.028, 17.948, 29.760, 59.061, 75.465, 89.917, 95.929, 165.424};
  const double R[9] = {2829.5, 2951.4, 3182.3, 3397.3, 3785.9, 3952.1, 4079.1, 4127.8, 4569.7};
  for (const auto &law : {al_gruneisen(0), al_gruneisen(0.48), al_mie()})
    for (int i = 0; i < 9; i++) {
      // solve the jump conditions p = rho0 Us u, e = u^2/2 for the density by bisection
      const double u = 0.5 * V[i];
      double lo = RHO0 * 1.0001, hi = 0.999 * law->rho_max();
      for (int k = 0; k < 200; k++) {
        const double rho = 0.5 * (lo + hi), Us = u / (1.0 - RHO0 / rho);
        (pressure(*law, rho, 0.5 * u * u) < RHO0 * Us * u ? lo : hi) = rho;
      }
      EXPECT_NEAR(lo, R[i], 0.051) << V[i];
      EXPECT_NEAR(1e-9 * pressure(*law, lo, 0.5 * u * u), P[i], 5.1e-4) << V[i];
    }
}

// Al 2024 on Cu at 5750 m/s: u 1880.7 m/s, P 113.20 GPa

TEST(Hugoniot, AsymmetricFlyer)
{
  const double u = 1880.7, v = 5750 - u;
  const double Us = 3940 + 1.489 * u, Ua = 5328 + 1.338 * v;
  const auto cu = eos("gruneisen", {8930, 3940, 1.489, 2.02, 0.47, 383});
  const auto al = eos("gruneisen", {2785, 5328, 1.338, 2.00, 0.48, 863});
  EXPECT_NEAR(1e-9 * pressure(*cu, 8930 * Us / (Us - u), 0.5 * u * u), 113.20, 0.01);
  EXPECT_NEAR(1e-9 * pressure(*al, 2785 * Ua / (Ua - v), 0.5 * v * v), 113.20, 0.01);
}

// Esposito's eq 2.14 without -Gamma eta/2 is 31 % high on the Hugoniot at 5.9 km/s

TEST(Hugoniot, PrintedMieGruneisenWouldBeTooHigh)
{
  const double u = 0.5 * 5941, Us = C0 + S * u, eta = u / Us;
  const double printed =
      RHO0 * C0 * C0 * eta / ((1 - S * eta) * (1 - S * eta)) + RHO0 * 1.97 * 0.5 * u * u;
  EXPECT_NEAR(printed / (RHO0 * Us * u), 1.31, 0.01);
}

/* ---------------------------------------------------------------------- */

// c^2 = dp/drho along de = p/rho^2 drho, integrated by Runge-Kutta a little to both sides

TEST(SoundSpeed, IsTheSlopeOfTheIsentrope)
{
  auto step = [](const Eos &law, double rho, double e, double d) {
    auto f = [&](double r, double x) {
      return pressure(law, r, x) / (r * r);
    };
    const double k1 = f(rho, e), k2 = f(rho + d / 2, e + d / 2 * k1),
                 k3 = f(rho + d / 2, e + d / 2 * k2), k4 = f(rho + d, e + d * k3);
    return pressure(law, rho + d, e + d / 6 * (k1 + 2 * k2 + 2 * k3 + k4));
  };
  for (const auto &law : all())
    for (double x : {0.9, 0.97, 1.03, 1.2, 1.5, 1.9})
      for (double heat : {0.0, 0.02, 0.3}) {
        // at e = 0 the second derivative of tillotson jumps, which differences do not like
        if (heat == 0.0 && law->name() == std::string("tillotson")) continue;
        const double rho = x * law->rho0(), e = heat * law->c0() * law->c0(), d = 1e-4 * rho;
        const double slope = (8 * (step(*law, rho, e, d) - step(*law, rho, e, -d)) -
                              step(*law, rho, e, 2 * d) + step(*law, rho, e, -2 * d)) /
            (12 * d);
        EXPECT_NEAR(csq(*law, rho, e), slope, 1e-8 * slope)
            << law->name() << " " << x << " " << heat;
      }
}

TEST(SoundSpeed, OfTheReferenceState)
{
  for (const auto &law : all()) {
    EXPECT_NEAR(pressure(*law, law->rho0(), 0.0), 0.0, 1e-6 * law->rho0());
    EXPECT_NEAR(std::sqrt(csq(*law, law->rho0() * (1 + 1e-12), 0.0)), law->c0(), 1e-9 * law->c0());
  }
}

TEST(SoundSpeed, HasAFloor)
{
  // linear tension of a Grueneisen solid at a tenth of its density
  for (const auto &law : {al_gruneisen(0.48), al_mie()}) {
    EXPECT_LT(pressure(*law, 270, 0.0), 0.0);
    EXPECT_DOUBLE_EQ(csq(*law, 270, 0.0), 1e-6 * C0 * C0);
  }
  const auto gas = eos("idealgas", {1.4});
  EXPECT_GT(csq(*gas, 1.0, 0.0), 0.0);
  EXPECT_GT(csq(*gas, 1.0, -1.0), 0.0);
}

TEST(Eos, ContinuousAtTheReferenceDensity)
{
  for (const auto &law : all())
    for (double e : {0.0, 1e5, 1e6}) {
      const double rho0 = law->rho0(), d = 1e-9;
      const double jump = pressure(*law, rho0 * (1 + d), e) - pressure(*law, rho0 * (1 - d), e);
      const double scale = rho0 * law->c0() * law->c0() + 10 * rho0 * e;
      EXPECT_NEAR(jump, 0.0, 10 * d * scale) << law->name();
    }
}

TEST(Eos, PolesAreFlagged)
{
  for (const auto &law : {al_gruneisen(0), al_mie()}) {
    // C/Us = 1 - S eta = 1/100
    const double end = RHO0 / (1 - 0.99 / S);
    EXPECT_NEAR(law->rho_max(), end, 1e-9 * end);
    double p, c;
    EXPECT_TRUE(law->evaluate(0.9999 * end, 0.0, p, c));
    for (double rho : {1.0001 * end, RHO0 / (1 - 1 / S), 1e5, 1e300}) {
      EXPECT_FALSE(law->evaluate(rho, 0.0, p, c)) << rho;
      EXPECT_TRUE(std::isnan(p) && std::isnan(c));
    }
  }
  // a slope below 1 has no pole
  EXPECT_EQ(eos("mie-gruneisen", {1000, 1000, 0.9, 1, 0})->rho_max(), HVI::NO_LIMIT);
  EXPECT_EQ(eos("gruneisen", {1000, 1000, 0.9, 1, 0, 0})->rho_max(), HVI::NO_LIMIT);
  // lead, whose Hugoniot has no pole, and aluminum, before its pole, end where (g0 + a mu) eta is 2;
  // at lower densities cold matter has a pressure above 0
  auto ends = [](const Eos &law, double g0, double a) {
    const double mu = law.rho_max() / law.rho0() - 1;
    EXPECT_NEAR((g0 + a * mu) * mu / (mu + 1), 2.0, 1e-9);
    for (double rho = 1.001 * law.rho0(); rho < law.rho_max(); rho *= 1.01)
      EXPECT_GT(pressure(law, rho, 0.0), 0.0) << rho;
  };
  ends(*eos_full("gruneisen", {11340, 2006, 1.429, 2.74, 0.54, 124, 0.8506, -1.64, 300}), 2.74,
       0.54);
  ends(*al_gruneisen(0.48), 1.97, 0.48);
  // and so does a law with Gamma rho constant, where g0 is large
  EXPECT_NEAR(eos("mie-gruneisen", {1000, 1000, 1.2, 3, 0})->rho_max(), 3000, 1e-6);
  // where C/Us turns back: S1 + 2 S2 eta + 3 S3 eta^2 = 0
  EXPECT_NEAR(eos_full("gruneisen", {8930, 3940, 1.0, 1.0, 0, 0, -1.1, 0, 300})->rho_max(),
              8930 / (1 - 1 / 2.2), 0.1);
  // a pole behind which C/Us is positive again is one all the same
  const auto law = eos_full("gruneisen", {1000, 1000, 3.0, 1.0, 0.0, 0.0, -1.0, -1.0, 300});
  const double eta = 1 - 1000 / law->rho_max();
  EXPECT_NEAR(1 - 3 * eta + eta * eta + eta * eta * eta, 0.01, 1e-10);
  EXPECT_LT(eta, 0.42);
}

TEST(Eos, NothingButNumbersGoesIn)
{
  auto laws = all();
  laws.push_back(eos("idealgas", {1.4}));
  for (const auto &law : laws)
    for (double bad : {NAN_, HVI::NO_LIMIT, -HVI::NO_LIMIT}) {
      double p = 0, c = 0;
      EXPECT_FALSE(law->evaluate(bad, 0.0, p, c)) << law->name();
      EXPECT_TRUE(std::isnan(p) && std::isnan(c));
      EXPECT_FALSE(law->evaluate(0.0, 0.0, p, c));
      EXPECT_FALSE(law->evaluate(-1.0, 0.0, p, c));
      const bool cold = law->name() == std::string("linear") || law->name() == std::string("tait");
      EXPECT_EQ(law->evaluate(2700.0, bad, p, c), cold) << law->name();
    }
}

/* ---------------------------------------------------------------------- */

TEST(Eos, Linear)
{
  const auto law = eos("linear", {0.5, 2.0});    // beta of Zisis: rho 0.5, Ca 0.25
  EXPECT_DOUBLE_EQ(pressure(*law, 0.5 * 1.299797, 0.0), 2.0 * 0.299797);
  EXPECT_DOUBLE_EQ(law->c0(), 2.0);
  EXPECT_DOUBLE_EQ(csq(*law, 0.9, 5.0), 4.0);
}

TEST(Eos, TaitAsInPackageSph)
{
  const double rho0 = 1000, c0 = 10, B = c0 * c0 * rho0 / 7.0;
  const auto law = eos("tait", {rho0, c0, 7}), real = eos("tait", {rho0, c0, 7 + 1e-13});
  for (double rho = 300; rho < 3000; rho += 7) {
    const double t = rho / rho0;
    double fi = t * t * t;
    fi = B * (fi * fi * t - 1.0);    // pair style sph/taitwater
    EXPECT_NEAR(pressure(*law, rho, 0.0), fi, 1e-12 * std::fabs(fi));
    EXPECT_NEAR(pressure(*real, rho, 0.0), fi, 1e-10 * std::fabs(fi));
    EXPECT_NEAR(csq(*law, rho, 0.0), c0 * c0 * std::pow(t, 6), 1e-12 * c0 * c0 * std::pow(t, 6));
  }
}

TEST(Eos, IdealGas)
{
  const auto gas = eos("idealgas", {1.4});
  EXPECT_DOUBLE_EQ(pressure(*gas, 2.0, 3.0), 0.4 * 6.0);
  EXPECT_DOUBLE_EQ(csq(*gas, 2.0, 3.0), 1.4 * 2.4 / 2.0);
  EXPECT_EQ(gas->rho0(), 0.0);
  EXPECT_EQ(gas->c0(), 0.0);
  EXPECT_TRUE(std::isnan(gas->temperature(2.0, 3.0)));
  EXPECT_DOUBLE_EQ(eos_full("idealgas", {1.4, 718})->temperature(1.2, 718 * 300), 300);
}

TEST(Eos, PolynomialBranches)
{
  const auto law = eos("polynomial", {2.0, 3, 4, 5, 0.5, 0.25, 0.125, 6, 7, 0});
  EXPECT_DOUBLE_EQ(pressure(*law, 3.0, 0.1), 1.5 + 1 + 0.625 + (0.5 + 0.125 + 0.03125) * 0.2);
  EXPECT_DOUBLE_EQ(pressure(*law, 1.0, 0.1), -3 + 1.75 + 0.1);
  // T1 = 0 stands for A1
  EXPECT_DOUBLE_EQ(pressure(*eos("polynomial", {2.0, 3, 4, 5, 0.5, 0, 0, 0, 0, 0}), 1.0, 0.0),
                   -1.5);
}

/* ---------------------------------------------------------------------- */

// T ds = de - p/rho^2 drho must be an exact differential: d(1/T)/drho|e = -d(p/(T rho^2))/de|rho

TEST(Temperature, IsConsistentWithThePressure)
{
  for (const auto &law : all()) {
    if (std::isnan(law->temperature(law->rho0(), 0.0))) continue;
    for (double x : {1.05, 1.2, 1.5, 1.8})
      for (double heat : {0.7, 1.5}) {
        const double rho = x * law->rho0(), e = heat * law->c0() * law->c0();
        const double dr = 1e-4 * rho, de = 1e-4 * e;
        auto beta = [&](double r, double en) {
          return 1.0 / law->temperature(r, en);
        };
        auto pb = [&](double r, double en) {
          return pressure(*law, r, en) / (r * r) * beta(r, en);
        };
        const double left = (beta(rho + dr, e) - beta(rho - dr, e)) / (2 * dr);
        const double right = -(pb(rho, e + de) - pb(rho, e - de)) / (2 * de);
        EXPECT_NEAR(left, right, 1e-5 * (std::fabs(left) + 1.0 / (law->temperature(rho, e) * rho)))
            << law->name() << " " << x << " " << heat;
      }
  }
}

TEST(Temperature, OfTheReferenceStateAndInExpansion)
{
  const auto law = al_gruneisen(0.48);
  EXPECT_DOUBLE_EQ(law->temperature(RHO0, 0.0), 300.0);
  EXPECT_NEAR(law->temperature(RHO0 * (1 + 1e-9), 885 * 100.0), 400.0, 1e-5);
  EXPECT_DOUBLE_EQ(law->temperature(0.3 * RHO0, 885 * 1000.0), 1300.0);
  EXPECT_DOUBLE_EQ(law->temperature(RHO0, -1e9), 0.0);
  EXPECT_TRUE(std::isnan(eos("gruneisen", {RHO0, C0, S, 1.97, 0.48, 0})->temperature(RHO0, 0.0)));
  EXPECT_TRUE(std::isnan(eos("linear", {1, 1})->temperature(1, 1)));
}

// along the Hugoniot cp dT/dv = -cp T Gamma/v + [p + (v0 - v) dp/dv]/2 (Walsh & Christian, Phys.
// Rev. 97 (1955) 1544), integrated by Runge-Kutta; eta = u/Us is taken for the volume

TEST(Temperature, OfShockedSolids)
{
  for (double a : {0.0, 0.48, -0.3}) {
    const auto law = al_gruneisen(a);
    auto slope = [a](double eta, double T) {
      const double d = 1 - S * eta, mu = eta / (1 - eta);
      const double p = RHO0 * C0 * C0 * eta / (d * d);
      const double dp = RHO0 * C0 * C0 * (1 + S * eta) / (d * d * d);
      return T * (1.97 + a * mu) + (eta * dp - p) / (2 * RHO0 * 885);
    };
    double T = 300;
    const double d = 1e-4;
    for (int i = 0; i < 6600; i++) {
      const double eta = i * d;
      const double k1 = slope(eta, T), k2 = slope(eta + d / 2, T + d / 2 * k1),
                   k3 = slope(eta + d / 2, T + d / 2 * k2), k4 = slope(eta + d, T + d * k3);
      T += d / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      const double end = eta + d, u = end * C0 / (1 - S * end);
      ASSERT_NEAR(law->temperature(RHO0 / (1 - end), 0.5 * u * u), T, 1e-6 * T) << end;
    }
    EXPECT_GT(T, 3000);
  }
}

// at 5.9 km/s e/cp alone would be twice as hot

TEST(Temperature, ColdEnergyIsNotHeat)
{
  const double u = 0.5 * 5941, Us = C0 + S * u, rho = RHO0 * Us / (Us - u), e = 0.5 * u * u;
  const double T = al_gruneisen(0.48)->temperature(rho, e);
  EXPECT_GT(300 + e / 885, 2 * T);
}

/* ---------------------------------------------------------------------- */

void refused(const std::string &name, const std::vector<double> &args, const std::string &why)
{
  std::string problem;
  EXPECT_FALSE(HVI::make_eos(name, args, problem)) << name;
  EXPECT_NE(problem.find(why), std::string::npos) << problem;
}

TEST(MakeEos, ShortForm)
{
  EXPECT_EQ(HVI::eos_nargs("linear"), 2);
  EXPECT_EQ(HVI::eos_nargs("tait"), 3);
  EXPECT_EQ(HVI::eos_nargs("idealgas"), 1);
  EXPECT_EQ(HVI::eos_nargs("gruneisen"), 6);
  EXPECT_EQ(HVI::eos_nargs("mie-gruneisen"), 5);
  EXPECT_EQ(HVI::eos_nargs("polynomial"), 10);
  EXPECT_EQ(HVI::eos_nargs("tillotson"), 11);
  EXPECT_EQ(HVI::eos_nargs("table"), -1);    // has a file
  EXPECT_EQ(HVI::eos_nargs("none"), -1);
  EXPECT_EQ(HVI::eos_args("gruneisen"), "rho0 C S1 g0 a cp");
  EXPECT_EQ(HVI::eos_args("mie-gruneisen"), "rho0 C S1 g0 cp");
  EXPECT_EQ(HVI::eos_args("polynomial"), "rho0 A1 A2 A3 B0 B1 B2 T1 T2 cp");
}

TEST(MakeEos, WrongArguments)
{
  refused("shock", {1, 2}, "unknown equation of state shock");
  refused("shock", {1, 2}, "mie-gruneisen, polynomial, tillotson, table");
  refused("linear", {1000}, "takes 2 values (rho0 K), not 1");
  refused("linear", {1000, 1, 1}, "not 3");
  refused("linear", {0, 1}, "rho0 = 0 must be > 0");
  refused("linear", {1000, -1}, "K = -1 must be > 0");
  refused("tait", {1000, NAN_, 7}, "c0 = nan is not a finite number");
  refused("tait", {HVI::NO_LIMIT, 1, 7}, "rho0 = inf is not a finite number");
  refused("idealgas", {1}, "gamma = 1 must be > 1");
  refused("gruneisen", {2700, 5000, -1, 2, 0.5, 900}, "S1 = -1 must be >= 0");
  refused("mie-gruneisen", {2700, 5000, 1, 2, -1}, "cp = -1 must be >= 0");
}

}    // namespace
