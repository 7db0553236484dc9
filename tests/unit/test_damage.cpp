/* ----------------------------------------------------------------------
   lammps-hvi: hypervelocity impact for LAMMPS, GNU GPL version 2, see LICENSE
   Damage, scatter and spall.
------------------------------------------------------------------------- */

#include "hvi_damage_johnson_cook.h"
#include "hvi_laws.h"
#include "hvi_spall.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>
#include <numeric>
#include <random>

using namespace HVI;

namespace {

const double NONE = std::numeric_limits<double>::quiet_NaN();

const DamageJohnsonCook AL2024 = {0.13, 0.13, -1.5, 0.011, 0.0, 1.0};
const DamageJohnsonCook AL6061 = {-0.77, 1.45, -0.47, 0.0, 1.6, 1.0};

Deviator rotated(const Eigen::Vector3d &principal, const Eigen::Matrix3d &R)
{
  const Eigen::Matrix3d m = R * principal.asDiagonal() * R.transpose();
  return {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2)};
}

}    // namespace

/* ---------------------------------------------------------------------- */

TEST(Triaxiality, SignAndBounds)
{
  EXPECT_DOUBLE_EQ(triaxiality(-1.0, 3.0), 1.0 / 3.0);    // uniaxial tension
  EXPECT_DOUBLE_EQ(triaxiality(1.0, 3.0), -1.0 / 3.0);    // uniaxial compression
  EXPECT_EQ(triaxiality(0.0, 0.0), 0.0);
  EXPECT_EQ(triaxiality(-1.0, 0.0), 10.0);
  EXPECT_EQ(triaxiality(1.0, 0.0), -10.0);
  EXPECT_EQ(triaxiality(-1.0, 0.01), 10.0);
  EXPECT_DOUBLE_EQ(triaxiality(-1.0, 0.101), 1.0 / 0.101);
  EXPECT_TRUE(std::isnan(triaxiality(NONE, 1.0)));
  EXPECT_TRUE(std::isnan(triaxiality(1.0, NONE)));
}

TEST(Damage, FailureStrainByHand)
{
  // 0.13 + 0.13 exp(-0.5) = 0.208848986
  EXPECT_NEAR(AL2024.failure_strain(1.0 / 3.0, 1.0, 0.0), 0.208848986, 1e-9);
  EXPECT_NEAR(AL2024.failure_strain(1.0 / 3.0, 1e4, 0.0), 0.208848986 * (1.0 + 0.011 * 9.21034037),
              1e-9);
  EXPECT_EQ(AL2024.failure_strain(0.4, 1e-6, 0.0), AL2024.failure_strain(0.4, 1.0, 0.0));
  EXPECT_EQ(AL2024.failure_strain(0.4, 0.0, 0.0), AL2024.failure_strain(0.4, 1.0, 0.0));
  EXPECT_EQ(AL2024.failure_strain(0.4, NONE, 0.0), AL2024.failure_strain(0.4, 1.0, 0.0));
  EXPECT_NEAR(AL6061.failure_strain(0.0, 1.0, 0.5), 0.68 * 1.8, 1e-12);
  // tension makes less ductile
  EXPECT_LT(AL2024.failure_strain(1.0, 1.0, 0.0), AL2024.failure_strain(-1.0, 1.0, 0.0));
}

// D1 of Al 6061-T6 is negative: the floor rules for s* > ln(1.45/0.77)/0.47 = 1.3467

TEST(Damage, Floor)
{
  const double s = std::log(1.45 / 0.77) / 0.47;
  EXPECT_NEAR(s, 1.347, 1e-3);
  EXPECT_GT(AL6061.failure_strain(s - 1e-3, 1.0, 0.0), 1e-4);
  EXPECT_EQ(AL6061.failure_strain(s + 1e-9, 1.0, 0.0), 1e-6);
  EXPECT_EQ(AL6061.failure_strain(10.0, 1e9, 1.0), 1e-6);
  // two brackets below zero are no ductility
  const DamageJohnsonCook odd = {-1.0, 0.0, -1.0, -1.0, -2.0, 1.0};
  EXPECT_EQ(odd.failure_strain(0.0, 1.0, 1.0), 1e-6);
  const DamageJohnsonCook cold = {1.0, 0.0, -1.0, -1.0, -2.0, 1.0};
  EXPECT_EQ(cold.failure_strain(0.0, 1e3, 1.0), 1e-6);
  // nothing overflows to what is not a number
  const DamageJohnsonCook steep = {0.1, 0.0, -1e3, 0.0, 0.0, 1.0};
  EXPECT_DOUBLE_EQ(steep.failure_strain(-10.0, 1.0, 0.0), 0.1);
  EXPECT_TRUE(std::isnan(AL2024.failure_strain(NONE, 1.0, 0.0)));
}

TEST(Damage, Increment)
{
  const double f = AL2024.failure_strain(1.0 / 3.0, 100.0, 0.0);
  EXPECT_DOUBLE_EQ(AL2024.increment(1e-4, 1e-6, -1e8, 3e8, 0.0, 1.0), 1e-4 / f);
  EXPECT_DOUBLE_EQ(AL2024.increment(1e-4, 1e-6, -1e8, 3e8, 0.0, 0.5), 2e-4 / f);
  EXPECT_EQ(AL2024.increment(0.0, 0.0, -1e8, 0.0, 0.0, 1.0), 0.0);
  EXPECT_DOUBLE_EQ(AL2024.increment(1e-4, 0.0, -1e8, 3e8, 0.0, 1.0),
                   1e-4 / AL2024.failure_strain(1.0 / 3.0, 1.0, 0.0));
  const DamageJohnsonCook hot = {0.5, 0.0, 0.0, 0.0, 1.0, 1.0};
  EXPECT_DOUBLE_EQ(hot.increment(0.1, 1.0, 0.0, 1.0, 1.0, 1.0), 0.1);
}

/* ----------------------------------------------------------------------
   above a triaxiality of 1.5, with a mean stress of spall: linear in it to eps_min
------------------------------------------------------------------------- */

TEST(Damage, HighTriaxiality)
{
  DamageJohnsonCook law = AL2024;
  law.eps_min = 0.02;
  law.sigma_spall = 1.2;
  const double vm = 0.3;    // s* = 4 at spall
  const double top = (0.13 + 0.13 * std::exp(-2.25)) * (1.0 + 0.011 * std::log(1e4));
  for (double s : {-2.0, 0.0, 1.0, 1.49, 1.5})
    EXPECT_DOUBLE_EQ(law.failure_strain(-s * vm, vm, 1e4, 0.0), AL2024.failure_strain(s, 1e4, 0.0));
  for (double s : {1.5 + 1e-12, 1.7, 2.0, 2.75, 3.5, 3.999})
    EXPECT_NEAR(law.failure_strain(-s * vm, vm, 1e4, 0.0), top + (0.02 - top) * (s - 1.5) / 2.5,
                1e-12);
  for (double p : {-1.2, -1.3, -5.0, -1e9}) EXPECT_EQ(law.failure_strain(p, vm, 1e4, 0.0), 0.02);
  EXPECT_EQ(law.failure_strain(-1.3, 0.0, 1e4, 0.0), 0.02);
  EXPECT_NEAR(law.failure_strain(-0.6, 0.0, 1e4, 0.0), 0.5 * (top + 0.02), 1e-12);
  // a yield stress so high that spall comes before 1.5
  EXPECT_DOUBLE_EQ(law.failure_strain(-1.4, 1.0, 1e4, 0.0), AL2024.failure_strain(1.4, 1e4, 0.0));
  EXPECT_EQ(law.failure_strain(-1.6, 1.0, 1e4, 0.0), 0.02);
  EXPECT_TRUE(std::isnan(law.failure_strain(NONE, vm, 1.0, 0.0)));
  // without it the law goes on
  law.sigma_spall = 0.0;
  EXPECT_DOUBLE_EQ(law.failure_strain(-1.0, vm, 1e4, 0.0),
                   AL2024.failure_strain(1.0 / vm, 1e4, 0.0));
}

// never below eps_min, nor negative, whatever the set; 6061-T6's is 0 from 1.347 on

TEST(Damage, NeverBelowItsLeast)
{
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int least = 0;
  for (int k = 0; k < 100000; k++) {
    DamageJohnsonCook law = k % 2 ? AL6061 : AL2024;
    law.eps_min = 0.15;
    law.sigma_spall = k % 3 ? 1.2 : 0.0;
    const double e =
        law.failure_strain(3.0 * uniform(random), 0.5 + 0.5 * uniform(random),
                           std::exp(20.0 * uniform(random)), 0.5 + 0.5 * uniform(random));
    ASSERT_GE(e, 0.15);
    least += e == 0.15;
  }
  EXPECT_GT(least, 10000);
  EXPECT_LT(least, 60000);
}

// Tension that grows in proportion to the strain, -p = k eps, at constant yield stress: with s* = k eps/vm beyond 1.5
// D = int d_eps/(a - b (s* - 1.5)), which is -ln(1 - b (s* - 1.5)/a) vm/(k b)

TEST(Damage, PathTowardsSpall)
{
  DamageJohnsonCook law = {0.1, 0.0, 0.0, 0.0, 0.0, 1.0};
  law.eps_min = 0.01;
  law.sigma_spall = 2.0;
  const double vm = 0.5, k = 40.0, a = 0.1, b = (a - law.eps_min) / (2.0 / vm - 1.5);
  const double first = 1.5 * vm / k, end = 1.9 / k;
  const double want = first / a - std::log(1.0 - b * (k * end / vm - 1.5) / a) * vm / (k * b);
  double D = 0.0;
  const int n = 20000;
  for (int i = 0; i < n; i++)
    D += law.increment(end / n, 1.0, -k * (i + 0.5) * end / n, vm, 0.0, 1.0);
  EXPECT_NEAR(D, want, 1e-6 * want);
  EXPECT_GT(want, 1.5 * end / a);
}

// Stretched at constant triaxiality and rate, failure comes at the strain eps_f; where the pressure
// falls in proportion to the strain, D = int d_eps/(D1 + D2 exp(D3 k eps)), which has a closed form

TEST(Damage, Paths)
{
  for (double s : {-1.0, 0.0, 1.0 / 3.0, 1.0, 2.5})
    for (double rate : {1.0, 1e5}) {
      const double f = AL2024.failure_strain(s, rate, 0.0);
      double D = 0.0, eps = 0.0;
      const double d = 1e-5;
      for (; D < 1.0; eps += d) D += AL2024.increment(d, d / rate, -s * 3e8, 3e8, 0.0, 1.0);
      EXPECT_NEAR(eps, f, 1.01 * d);
    }
  const double a = 0.13, b = 0.13, c = -1.5 * 4.0, end = 0.3;    // s* = 4 eps
  // int dx/(a + b exp(c x)) = x/a - ln(a + b exp(c x))/(a c)
  const double want = end / a - std::log((a + b * std::exp(c * end)) / (a + b)) / (a * c);
  double error[2];
  for (int k = 0; k < 2; k++) {
    const int n = 2000 << k;
    double D = 0.0;
    for (int i = 0; i < n; i++)
      D += AL2024.increment(end / n, 1.0, -4.0 * (i + 0.5) * end / n, 1.0, 0.0, 1.0);
    error[k] = std::fabs(D - want);
  }
  EXPECT_LT(error[1], 1e-8 * want);
  EXPECT_NEAR(std::log2(error[0] / error[1]), 2.0, 0.05);
}

// stretched in uniaxial stress by the whole machinery: triaxiality 1/3 to the end

TEST(Damage, WithStrength)
{
  std::string problem;
  auto law = make_strength({"strength", "perfect", {{"G", 26e9}, {"Y", 3e8}}}, problem);
  Deviator S = {};
  double eps = 0.0, D = 0.0;
  const double d = 1e-5, dt = 1e-9;
  while (D < 1.0) {
    const Deviator trial = {S.xx + 2 * 26e9 * d, S.yy - 26e9 * d, S.zz - 26e9 * d, 0.0, 0.0, 0.0};
    const Plastic r = law->radial_return(trial, dt, 26e9, eps, {1.0, 1.0, 0.0, NONE});
    S = r.S;
    eps += r.d_eps;
    // the sides are free: -p + Syy = 0
    D += AL2024.increment(r.d_eps, dt, S.yy, von_mises(S), 0.0, 1.0);
  }
  EXPECT_NEAR(eps, AL2024.failure_strain(1.0 / 3.0, d / dt, 0.0), 1.1 * d);
}

TEST(Damage, Section)
{
  std::string problem;
  Section s = {"damage",
               "johnson-cook",
               {{"D1", 0.1},
                {"D2", 0.2},
                {"D3", -3.0},
                {"D4", 0.01},
                {"D5", 1.0},
                {"epsdot0", 2.0},
                {"eps_min", 0.05},
                {"sigma_spall", 8.0},
                {"u_f", 0.25}}};
  auto law = make_damage(s, problem);
  ASSERT_TRUE(law);
  EXPECT_EQ(problem, "");
  EXPECT_STREQ(law->name(), "johnson-cook");
  const double f = (0.1 + 0.2 * std::exp(-1.5)) * (1.0 + 0.01 * std::log(1e3)) * 1.3;
  EXPECT_NEAR(law->increment(1e-3, 5e-7, -2.0, 4.0, 0.3, 0.7), 1e-3 / 0.7 / f, 1e-15);
  EXPECT_NEAR(law->increment(1e-3, 5e-7, -8.0, 4.0, 0.3, 0.7), 1e-3 / 0.7 / 0.05, 1e-15);
  EXPECT_EQ(law->displacement(), 0.25);
  for (auto wrong :
       {std::pair<const char *, double>{"eps_min", 0.0}, {"sigma_spall", -1.0}, {"u_f", -1.0}}) {
    Section t = s;
    t.values[wrong.first] = wrong.second;
    EXPECT_FALSE(make_damage(t, problem));
    EXPECT_EQ(problem.find(wrong.first), 0u) << problem;
  }
  s.values["epsdot0"] = 0.0;
  EXPECT_FALSE(make_damage(s, problem));
  EXPECT_EQ(problem, "epsdot0 = 0 must be > 0");
  s.values.erase("D3");
  EXPECT_FALSE(make_damage(s, problem));
  EXPECT_EQ(problem, "missing key D3");
  s.kind = "strength";
  EXPECT_FALSE(make_damage(s, problem));
  EXPECT_EQ(problem, "strength johnson-cook is no law of damage");
  EXPECT_FALSE(make_damage({"damage", "cockcroft-latham", s.values}, problem));
  EXPECT_EQ(problem, "damage cockcroft-latham is no law of damage");
}

/* ----------------------------------------------------------------------
   scatter
------------------------------------------------------------------------- */

TEST(Weibull, MeanAndQuantiles)
{
  for (double modulus : {1.0, 2.5, 16.3}) {
    const int n = 200000;
    std::vector<double> x(n);
    for (int i = 0; i < n; i++) x[i] = weibull_factor(12345, i + 1, modulus);
    const double mean = std::accumulate(x.begin(), x.end(), 0.0) / n;
    double variance = 0.0;
    for (double y : x) variance += (y - mean) * (y - mean) / (n - 1);
    const double g1 = std::tgamma(1.0 + 1.0 / modulus), g2 = std::tgamma(1.0 + 2.0 / modulus);
    const double sigma = std::sqrt(g2 / (g1 * g1) - 1.0);
    EXPECT_NEAR(mean, 1.0, 4.0 * sigma / std::sqrt(n));
    EXPECT_NEAR(std::sqrt(variance), sigma, 0.02 * sigma);
    std::sort(x.begin(), x.end());
    for (double q : {0.001, 0.01, 0.1, 0.5, 0.9, 0.99, 0.999}) {
      // the fraction below the exact quantile is binomial
      const double exact = std::pow(-std::log1p(-q), 1.0 / modulus) / g1;
      const double below = double(std::lower_bound(x.begin(), x.end(), exact) - x.begin()) / n;
      EXPECT_NEAR(below, q, 4.0 * std::sqrt(q * (1.0 - q) / n)) << modulus;
    }
    EXPECT_GT(x[0], 0.0);
    EXPECT_LT(x[n - 1], 20.0);
  }
}

// The weakest of the parts of a volume, with the factor of their size: the same distribution into how many so ever
// it is divided, in one, two and three dimensions.  Without it it falls as parts^(-1/modulus).

TEST(Weibull, WeakestOfAVolume)
{
  const double modulus = 6.0, whole = 0.7, reference = 0.2;
  const double g1 = std::tgamma(1.0 + 1.0 / modulus), g2 = std::tgamma(1.0 + 2.0 / modulus);
  const double sigma = std::sqrt(g2 / (g1 * g1) - 1.0);
  std::int64_t tag = 0;
  for (int dim : {1, 2, 3}) {
    const double want = std::pow(whole / reference, -dim / modulus);
    for (int parts : {1, 2, 4, 8}) {    // per direction
      const int n = 2000, m = int(std::pow(parts, dim) + 0.5);
      double mean = 0.0, square = 0.0, without = 0.0;
      for (int k = 0; k < n; k++) {
        double weakest = 1e300;
        for (int i = 0; i < m; i++) weakest = std::min(weakest, weibull_factor(3, ++tag, modulus));
        without += weakest / n;
        weakest *= size_factor(whole / parts, reference, dim, modulus);
        mean += weakest / n;
        square += weakest * weakest / n;
      }
      EXPECT_NEAR(mean, want, 4.0 * want * sigma / std::sqrt(n)) << dim << " " << parts;
      EXPECT_NEAR(std::sqrt(square - mean * mean), want * sigma, 0.1 * want * sigma);
      EXPECT_NEAR(without, std::pow(m, -1.0 / modulus), 4.0 * sigma / std::sqrt(n));
    }
  }
  EXPECT_EQ(size_factor(0.2, 0.2, 3, 6.0), 1.0);
  EXPECT_DOUBLE_EQ(size_factor(0.1, 0.2, 3, 6.0), std::sqrt(2.0));
}

// a function of seed and ID alone, the same on every machine; neighbors do not go together

TEST(Weibull, Stateless)
{
  const double here = weibull_factor(7, 42, 3.0);
  for (int tag = 100; tag > 0; tag--) {
    const double x = weibull_factor(7, tag, 3.0);
    if (tag == 42)
      EXPECT_EQ(x, here);
    else
      EXPECT_NE(x, here);
  }
  EXPECT_NE(weibull_factor(8, 42, 3.0), here);
  EXPECT_NE(weibull_factor(42, 7, 3.0), here);
  EXPECT_NE(weibull_factor(7, 42 + (std::int64_t(1) << 40), 3.0), here);
  EXPECT_EQ(weibull_factor(7, 42, std::numeric_limits<double>::infinity()), 1.0);
  // SplitMix64's published sequence from the seed 1234567
  std::uint64_t state = 1234567;
  for (std::uint64_t want : {6457827717110365317u, 3203168211198807973u, 9817491932198370423u}) {
    EXPECT_EQ(hash64(state), want);
    state += 0x9e3779b97f4a7c15u;
  }
  const int n = 100000;
  for (auto step : {std::pair<int, int>{0, 1}, {1, 0}, {0, 64}}) {
    double xy = 0.0;
    for (int i = 0; i < n; i++)
      xy += (weibull_factor(5, i, 1.0) - 1.0) *
          (weibull_factor(5 + step.first, i + step.second, 1.0) - 1.0) / n;
    EXPECT_LT(std::fabs(xy), 5.0 / std::sqrt(n));
  }
}

/* ----------------------------------------------------------------------
   spall
------------------------------------------------------------------------- */

TEST(Principal, KnownCases)
{
  EXPECT_NEAR(largest_principal({2.0, -1.0, -1.0, 0.0, 0.0, 0.0}), 2.0, 1e-14);
  EXPECT_NEAR(largest_principal({-2.0, 1.0, 1.0, 0.0, 0.0, 0.0}), 1.0, 1e-7);    // double root
  EXPECT_NEAR(largest_principal({0.0, 0.0, 0.0, 3.0, 0.0, 0.0}), 3.0, 1e-14);
  EXPECT_NEAR(largest_principal({0.0, 0.0, 0.0, 0.0, -3.0, 0.0}), 3.0, 1e-14);
  EXPECT_NEAR(largest_principal({0.0, 0.0, 0.0, 1.0, 1.0, 1.0}), 2.0, 1e-14);
  EXPECT_EQ(largest_principal({0.0, 0.0, 0.0, 0.0, 0.0, 0.0}), 0.0);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  double worst = 0.0;
  for (int k = 0; k < 20000; k++) {
    const double a = uniform(random), b = k % 4 ? uniform(random) : a * (1.0 + 1e-9 * (k % 7));
    const Eigen::Vector3d principal(a, b, -a - b);
    const Eigen::Matrix3d R =
        Eigen::Quaterniond(uniform(random), uniform(random), uniform(random), uniform(random))
            .normalized()
            .toRotationMatrix();
    for (double size : {1e-9, 1.0, 1e12}) {
      const double got = largest_principal(rotated(size * principal, R)) / size;
      worst = std::max(worst, std::fabs(got - principal.maxCoeff()) / principal.norm());
    }
  }
  EXPECT_LT(worst, 5e-8);
}

// the shortcut for what is far from spall does not change the answer

TEST(Spall, PrincipalStress)
{
  const double limit = 1.2;
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int yes = 0;
  for (int k = 0; k < 100000; k++) {
    const double a = uniform(random), b = uniform(random), p = -1.0 + uniform(random);
    const Eigen::Vector3d principal(a, b, -a - b);
    const Eigen::Matrix3d R =
        Eigen::Quaterniond(uniform(random), uniform(random), uniform(random), uniform(random))
            .normalized()
            .toRotationMatrix();
    const double excess = principal.maxCoeff() - p - limit;
    if (std::fabs(excess) < 1e-6) continue;
    ASSERT_EQ(spalls(Spall::PRINCIPAL, p, rotated(principal, R), limit), excess > 0.0);
    yes += excess > 0.0;
  }
  EXPECT_GT(yes, 20000);
  EXPECT_LT(yes, 80000);
  const Deviator S = {2.0, -1.0, -1.0, 0.0, 0.0, 0.0};
  EXPECT_FALSE(spalls(Spall::PRINCIPAL, 0.81, S, limit));    // tension of 1.19 in spite of p > 0
  EXPECT_TRUE(spalls(Spall::PRINCIPAL, 0.79, S, limit));
  EXPECT_FALSE(spalls(Spall::PRINCIPAL, -0.5, scaled(S, -0.5), limit));
}

TEST(Spall, WhoSpalls)
{
  const Deviator S = {2.0, -1.0, -1.0, 0.0, 0.0, 0.0}, zero = {};
  EXPECT_FALSE(spalls(Spall::NONE, -100.0, S, 1.2));
  EXPECT_FALSE(spalls(Spall::PRESSURE, -100.0, S, 1.2));
  EXPECT_FALSE(spalls(Spall::ZERO, -1.19, S, 1.2));
  EXPECT_FALSE(spalls(Spall::ZERO, -1.2, S, 1.2));    // exceeds, not reaches
  EXPECT_TRUE(spalls(Spall::ZERO, -1.21, S, 1.2));
  EXPECT_FALSE(spalls(Spall::PRINCIPAL, -1.19, zero, 1.2));
  EXPECT_TRUE(spalls(Spall::PRINCIPAL, -1.21, zero, 1.2));
  for (Spall model : {Spall::NONE, Spall::PRESSURE, Spall::PRINCIPAL, Spall::ZERO})
    EXPECT_FALSE(spalls(model, 5.0, S, 1.2));
}

// pulled to failure and pushed together again: p of the law, and p as it comes out

TEST(Spall, StateMachine)
{
  const double limit = 1.2, law_p[] = {1.0, -1.0, -1.5, -0.5, 2.0, -3.0};
  const Deviator law_S = {0.2, -0.1, -0.1, 0.0, 0.05, 0.0};
  struct Case {
    Spall model;
    double p[6];
    bool spalled[6];
  };
  const Case cases[] = {
      {Spall::NONE, {1.0, -1.0, -1.5, -0.5, 2.0, -3.0}, {0, 0, 0, 0, 0, 0}},
      {Spall::PRESSURE, {1.0, -1.0, -1.2, -0.5, 2.0, -1.2}, {0, 0, 0, 0, 0, 0}},
      {Spall::PRINCIPAL, {1.0, 0.0, 0.0, 0.0, 2.0, 0.0}, {0, 1, 1, 1, 1, 1}},    // 1 + 0.2 and more
      {Spall::ZERO, {1.0, -1.0, 0.0, 0.0, 2.0, 0.0}, {0, 0, 1, 1, 1, 1}},
  };
  for (const Case &c : cases) {
    bool spalled = false;
    for (int i = 0; i < 6; i++) {
      spalled = spalled || spalls(c.model, law_p[i], law_S, limit);
      EXPECT_EQ(spalled, c.spalled[i]) << i;
      EXPECT_EQ(clip_tension(law_p[i], least_pressure(c.model, spalled, limit)), c.p[i]) << i;
    }
  }
  // failed by damage: the same in every model
  for (Spall model : {Spall::NONE, Spall::PRESSURE, Spall::PRINCIPAL, Spall::ZERO})
    for (double p : {-5.0, -1e-3, 0.0, 3.0})
      EXPECT_EQ(clip_tension(p, least_pressure(model, true, limit)), std::max(p, 0.0));
}
