/* ----------------------------------------------------------------------
   lammps-hvi: hypervelocity impact for LAMMPS, GNU GPL version 2, see LICENSE
   The contact law alone, against the formulas as printed.
------------------------------------------------------------------------- */

#include "hvi_contact_step.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

using HVI::Contact;

namespace {

// Watson & Steinhauser eq 3, with the shift as an argument: the paper prints 1

double printed(double eps, double sigma, double shift, double r)
{
  const double q = std::pow(sigma / r, 6.0);
  return eps * (q * q - q + shift);
}

struct Case {
  double eps, sigma, prefactor;
};

class ContactLaw : public ::testing::TestWithParam<Case> {
 protected:
  Contact law = Contact::make(GetParam().eps, GetParam().sigma, GetParam().prefactor);
  double eps = GetParam().eps, sigma = GetParam().sigma, F = GetParam().prefactor;
  double r_eq = Contact::r_eq(sigma);

  double phi(double r) const { return law.energy(r * r); }
  double f(double r) const { return law.force(r * r) * r; }
};

TEST_P(ContactLaw, EndsAtTheMinimumOfLennardJones)
{
  EXPECT_NEAR(r_eq, std::pow(2.0, 1.0 / 6.0) * sigma, 1e-15 * sigma);
  EXPECT_NEAR(law.cutsq, r_eq * r_eq, 1e-15 * r_eq * r_eq);
}

TEST_P(ContactLaw, EnergyAndForceVanishAtTheCutoff)
{
  EXPECT_NEAR(phi(r_eq), 0.0, 1e-15 * F * eps);
  EXPECT_NEAR(f(r_eq), 0.0, 1e-14 * F * eps / sigma);
  EXPECT_NEAR(phi(r_eq * (1.0 - 1e-7)), 0.0, 1e-12 * F * eps);
  EXPECT_NEAR(f(r_eq * (1.0 - 1e-9)), 0.0, 1e-7 * F * eps / sigma);
}

TEST_P(ContactLaw, PrintedShiftOfOneWouldJump)
{
  EXPECT_NEAR(F * printed(eps, sigma, 1.0, r_eq), 0.75 * F * eps, 1e-14 * F * eps);
  for (double r : {0.6 * sigma, 0.9 * sigma, sigma, 1.1 * sigma}) {
    const double quarter = F * printed(eps, sigma, 0.25, r);
    EXPECT_NEAR(phi(r), quarter, 1e-13 * quarter + 1e-15 * F * eps);
    EXPECT_GT(std::fabs(phi(r) - F * printed(eps, sigma, 1.0, r)), 0.7 * F * eps);
  }
}

TEST_P(ContactLaw, ForceIsMinusTheSlope)
{
  for (double r = 0.6 * sigma; r < 0.999 * r_eq; r += 0.02 * sigma) {
    const double h = 1e-4 * sigma;
    const double slope = (8.0 * (phi(r + h) - phi(r - h)) - phi(r + 2 * h) + phi(r - 2 * h)) / (12.0 * h);
    EXPECT_NEAR(f(r), -slope, 1e-8 * std::fabs(slope) + 1e-10 * F * eps / sigma) << "r/sigma " << r / sigma;
    EXPECT_GT(f(r), 0.0);
  }
}

TEST_P(ContactLaw, StiffnessIsTheSlopeOfTheForce)
{
  for (double r = 0.6 * sigma; r < r_eq; r += 0.02 * sigma) {
    const double h = 1e-4 * sigma;
    const double slope = (8.0 * (f(r + h) - f(r - h)) - f(r + 2 * h) + f(r - 2 * h)) / (12.0 * h);
    EXPECT_NEAR(law.stiffness(r * r), -slope, 1e-8 * std::fabs(slope)) << "r/sigma " << r / sigma;
  }
  // of eps [(s/r)^12 - (s/r)^6] at its minimum: 36/2^(4/3) eps/s^2
  EXPECT_NEAR(law.stiffness(r_eq * r_eq), 18.0 * std::cbrt(0.5) * F * eps / (sigma * sigma),
              1e-12 * F * eps / (sigma * sigma));
}

TEST_P(ContactLaw, TurningPointInvertsTheEnergy)
{
  for (double e : {1e-6, 0.01, 0.25, 1.0, 30.0, 1e4}) {
    const double rsq = law.turning_rsq(e * F * eps);
    EXPECT_LT(rsq, law.cutsq);
    EXPECT_NEAR(law.energy(rsq), e * F * eps, 1e-12 * e * F * eps);
  }
  EXPECT_NEAR(law.turning_rsq(0.0), law.cutsq, 1e-15 * law.cutsq);
}

INSTANTIATE_TEST_SUITE_P(Sizes, ContactLaw,
                         ::testing::Values(Case{1.0, 1.0, 1.0}, Case{1.0, 1.0, 4.0}, Case{0.0104, 2.3e-4, 1.0},
                                           Case{1e-9, 7e-7, 4.0}));

TEST(ContactPrefactor, FourIsTheTextbookForm)
{
  const double eps = 1.7, sigma = 0.8;
  const Contact law = Contact::make(eps, sigma, 4.0);
  for (double r : {0.6, 0.7, 0.8, 0.85}) {
    const double q = std::pow(sigma / r, 6.0);
    EXPECT_NEAR(law.energy(r * r), 4.0 * eps * (q * q - q) + eps, 1e-12 * law.energy(r * r));
    EXPECT_NEAR(law.force(r * r) * r, 24.0 * eps * (2.0 * q * q - q) / r, 1e-12 * law.force(r * r) * r);
  }
}

TEST(ContactPrefactor, OneHasTheForceOfThePaper)
{
  // eq 2: 6 eps/r [2 (s/r)^12 - (s/r)^6], no factor 4
  const Contact law = Contact::make(2.0, 1.0, 1.0);
  EXPECT_NEAR(law.force(1.0), 12.0, 1e-13);
  EXPECT_NEAR(law.energy(1.0), 0.5, 1e-15);
}

struct Pair {
  double m, rsq, rdotv;
};

std::vector<Pair> pairs(int n, double mass, int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  std::vector<Pair> made;
  for (int i = 0; i < n; i++)
    made.push_back({mass > 0.0 ? mass : 0.2 + part(random), 0.5 + 1.5 * part(random), 20.0 * (part(random) - 0.5)});
  return made;
}

// each pair by itself

HVI::ContactTimes all_of(const Contact &law, const std::vector<Pair> &list)
{
  HVI::ContactTimes least = {1e200, 1e200};
  for (const Pair &p : list) {
    const bool touching = p.rsq < law.cutsq;
    if (touching) least.contact = std::min(least.contact, p.m / law.stiffness(p.rsq));
    if (p.rdotv >= 0.0) continue;
    const double e = 0.5 * p.m * p.rdotv * p.rdotv / p.rsq + (touching ? law.energy(p.rsq) : 0.0);
    least.approach = std::min(least.approach, p.m / law.stiffness(law.turning_rsq(e)));
  }
  return least;
}

HVI::ContactTimes uniform(const Contact &law, double m, const std::vector<Pair> &list)
{
  HVI::ContactTimes least = {1e200, 1e200};
  HVI::UniformContactStep step(law, m);
  for (size_t first = 0; first < list.size(); first += HVI::UniformContactStep::ROW) {
    const auto row = step.row();
    const size_t number = std::min<size_t>(HVI::UniformContactStep::ROW, list.size() - first);
    for (size_t n = 0; n < number; n++) {
      row.rsq[n] = list[first + n].rsq;
      row.rdotv[n] = list[first + n].rdotv;
    }
    step.filled(number);
  }
  step.finish(least);
  return least;
}

TEST(ContactStep, FindsTheLeastOfAllPairs)
{
  const Contact law = Contact::make(1.3, 1.0, 1.0);
  for (int n : {0, 1, 7, 64, 200, 1000})
    for (int seed = 0; seed < 20; seed++) {
      for (double mass : {0.7, 0.0}) {
        const auto list = pairs(n, mass, seed);
        const HVI::ContactTimes want = all_of(law, list);
        HVI::ContactTimes found = {1e200, 1e200};
        HVI::ContactStep step;
        for (const Pair &p : list) step.add(law, p.m, p.rsq, p.rdotv, found);
        EXPECT_EQ(found.contact, want.contact);
        EXPECT_EQ(found.approach, want.approach);
        if (mass == 0.0) continue;
        found = uniform(law, mass, list);
        EXPECT_NEAR(found.contact, want.contact, 1e-12 * want.contact);
        EXPECT_NEAR(found.approach, want.approach, 1e-12 * want.approach);
      }
    }
}

TEST(ContactStep, TellsWhatIsNotANumber)
{
  const Contact law = Contact::make(1.0, 1.0, 1.0);
  auto list = pairs(100, 1.0, 3);
  list[17].rdotv = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(uniform(law, 1.0, list).approach));
  HVI::ContactTimes found = {1e200, 1e200};
  HVI::ContactStep step;
  for (int n = 0; n <= 17; n++) step.add(law, 1.0, list[n].rsq, list[n].rdotv, found);
  EXPECT_TRUE(std::isnan(found.approach));
}

}    // namespace
