/* ----------------------------------------------------------------------
   lammps-hvi: hypervelocity impact for LAMMPS, GNU GPL version 2, see LICENSE
   The breakable spring alone, against the formulas as printed.
------------------------------------------------------------------------- */

#include "hvi_spring.h"

#include <gtest/gtest.h>

using HVI::Spring;

namespace {

struct Case {
  double kappa, r_eq, r_cut;
};

class SpringLaw : public ::testing::TestWithParam<Case> {
 protected:
  double kappa = GetParam().kappa, r_eq = GetParam().r_eq, r_cut = GetParam().r_cut;
  Spring law = Spring::make(kappa, r_eq, r_cut);

  double phi(double r) const { return law.energy(r * r); }
  double f(double r) const { return law.force(r * r) * r; }
};

TEST_P(SpringLaw, HookeInTension)
{
  for (double r = 1.001 * r_eq; r <= r_cut; r += 0.01 * r_eq) {
    EXPECT_NEAR(phi(r), 0.5 * kappa * (r - r_eq) * (r - r_eq), 1e-12 * kappa * r_eq * r_eq);
    EXPECT_NEAR(f(r), -kappa * (r - r_eq), 1e-13 * kappa * r_eq);
  }
}

TEST_P(SpringLaw, SlackInCompression)
{
  for (double q : {0.1, 0.5, 0.9, 0.999, 1.0 - 1e-12}) {
    EXPECT_EQ(phi(q * r_eq), 0.0);
    EXPECT_EQ(f(q * r_eq), 0.0);
    EXPECT_FALSE(law.broken(q * q * r_eq * r_eq));
  }
}

TEST_P(SpringLaw, ForceIsMinusTheSlope)
{
  for (double r = 0.9 * r_eq; r < r_cut; r += 0.0137 * r_eq) {
    const double h = 1e-6 * r_eq;
    EXPECT_NEAR(f(r), -(phi(r + h) - phi(r - h)) / (2.0 * h), 1e-6 * kappa * r_eq) << "r/r_eq " << r / r_eq;
  }
}

TEST_P(SpringLaw, ContinuousAtEquilibrium)
{
  EXPECT_NEAR(phi(r_eq), 0.0, 1e-30 * kappa * r_eq * r_eq);
  EXPECT_NEAR(f(r_eq), 0.0, 1e-15 * kappa * r_eq);
  EXPECT_NEAR(phi(r_eq * (1.0 + 1e-8)), 0.0, 1e-15 * kappa * r_eq * r_eq);
  EXPECT_NEAR(f(r_eq * (1.0 + 1e-8)), 0.0, 2e-8 * kappa * r_eq);
}

TEST_P(SpringLaw, BreaksBeyondRcutOnly)
{
  EXPECT_FALSE(law.broken(law.cutsq));
  EXPECT_FALSE(law.broken(r_cut * r_cut));
  EXPECT_FALSE(law.broken(r_cut * r_cut * (1.0 - 1e-15)));
  EXPECT_TRUE(law.broken(std::nextafter(r_cut * r_cut, 1e300)));
  EXPECT_TRUE(law.broken(4.0 * r_cut * r_cut));
}

INSTANTIATE_TEST_SUITE_P(Sizes, SpringLaw,
                         ::testing::Values(Case{1.0, 1.0, 1.1}, Case{50.0, 1.1224620483093730, 1.5},
                                           Case{4.56e6, 2.6e-4, 3.5e-4}));

}    // namespace
