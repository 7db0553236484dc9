/* ----------------------------------------------------------------------
  lammps-hvi: hypervelocity impact for LAMMPS, GNU GPL version 2, see LICENSE
  exp and log of vectors beside those of the C library.
------------------------------------------------------------------------- */

#include "hvi_vector_math.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

using namespace HVI;

TEST(VectorMath, ExpAndLog)
{
  std::mt19937_64 random(1);
  const double e = std::numeric_limits<double>::epsilon();
  for (int k = 0; k < 300000; k++) {
    Vec x, u;
    const double size = k % 3 ? 1.0 : (k % 2 ? 700.0 : 1e-6);
    for (int l = 0; l < LANES; l++) {
      x[l] = std::uniform_real_distribution<double>(-size, size)(random);
      u[l] = k % 2 ? std::exp(x[l]) : std::uniform_real_distribution<double>(0.5, 2.0)(random);
    }
    const Vec y = exp(x), v = log(u);
    for (int l = 0; l < LANES; l++) {
      ASSERT_NEAR(y[l], std::exp(x[l]), 2.0 * e * std::exp(x[l])) << x[l];
      ASSERT_NEAR(v[l], std::log(u[l]), 2.0 * e * std::fabs(std::log(u[l]))) << u[l];
    }
  }
}

TEST(VectorMath, Ends)
{
  const Vec zero = {};
  const double bad = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(exp(zero)[0], 1.0);
  EXPECT_EQ(log(zero + 1.0)[0], 0.0);
  EXPECT_DOUBLE_EQ(exp(zero + 1e4)[0], std::exp(700.0));
  EXPECT_DOUBLE_EQ(exp(zero - 1e4)[0], std::exp(-700.0));
  EXPECT_DOUBLE_EQ(log(zero + 1e308)[0], std::log(1e308));
  EXPECT_DOUBLE_EQ(log(zero + 2.3e-308)[0], std::log(2.3e-308));
  EXPECT_TRUE(std::isnan(exp(zero + bad)[0]));
  EXPECT_TRUE(std::isnan(log(zero + bad)[0]));
}
