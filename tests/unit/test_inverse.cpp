/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#include "hvi_inverse.h"
#include "hvi_sph_records.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using HVI::Symmetric;

namespace {

// g of the header

double limited(double lambda)
{
  if (lambda <= 0.15) return 1.0;
  if (lambda >= 0.3) return 1.0 / lambda;
  const double w = (lambda - 0.15) / 0.15, s = w * w * (3.0 - 2.0 * w);
  return 1.0 - s + s / lambda;
}

Eigen::Matrix3d turned(std::mt19937 &random)
{
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  Eigen::Matrix3d m;
  for (int k = 0; k < 9; k++) m(k / 3, k % 3) = number(random);
  return Eigen::HouseholderQR<Eigen::Matrix3d>(m).householderQ();
}

double error(const Eigen::Vector3d &lambda, const Eigen::Matrix3d &axes)
{
  const Eigen::Matrix3d N = axes * lambda.asDiagonal() * axes.transpose();
  const Eigen::Matrix3d wanted = axes * lambda.unaryExpr(&limited).asDiagonal() * axes.transpose();
  const Symmetric s = HVI::limited_inverse({N(0, 0), N(1, 1), N(2, 2), N(0, 1), N(0, 2), N(1, 2)});
  const double found[6] = {s.xx, s.yy, s.zz, s.xy, s.xz, s.yz};
  const double exact[6] = {wanted(0, 0), wanted(1, 1), wanted(2, 2),
                           wanted(0, 1), wanted(0, 2), wanted(1, 2)};
  double worst = 0.0;
  for (int k = 0; k < 6; k++) worst = std::max(worst, std::fabs(found[k] - exact[k]));
  return worst;
}
}    // namespace

// eigenvalues of all sizes, alike to all degrees, on both sides of both limits

TEST(LimitedInverse, is_that_of_its_eigenvalues)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> size(0.0, 1.1), exponent(-17.0, -1.0);
  const auto near = [&](double x) {
    return x + std::pow(10.0, exponent(random));
  };
  for (int n = 0; n < 20000; n++) {
    const double a = n % 7 ? size(random) : (n % 2 ? 0.15 : 0.3),
                 b = n % 3 ? size(random) : near(a), c = n % 5 ? size(random) : near(b);
    EXPECT_LT(error({a, b, c}, turned(random)), 1e-12) << a << " " << b << " " << c;
  }
}

TEST(LimitedInverse, of_a_multiple_of_1)
{
  for (const double x : {0.0, 0.1, 0.2, 0.29, 0.5, 1.0})
    EXPECT_LT(error({x, x, x}, Eigen::Matrix3d::Identity()), 1e-13) << x;
}

// what Riemann problems need of a velocity gradient, in the order of Symmetric

TEST(Stretch, is_the_symmetric_part)
{
  HVI::SphGradV g = {};
  g.set_gradient({1.0, 2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0});
  g.keep_stretch();
  const Symmetric s = g.stretch();
  EXPECT_EQ(s.xx, 1.0);
  EXPECT_EQ(s.yy, 7.0);
  EXPECT_EQ(s.zz, 19.0);
  EXPECT_EQ(s.xy, 3.5);
  EXPECT_EQ(s.xz, 8.0);
  EXPECT_EQ(s.yz, 14.0);
}
