/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

// the tensile part of a stress

#include "hvi_artstress.h"

#include <gtest/gtest.h>

using namespace HVI;

namespace {

Deviator rotated(const Eigen::Vector3d &principal, const Eigen::Matrix3d &R)
{
  const Eigen::Matrix3d m = R * principal.asDiagonal() * R.transpose();
  return {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2)};
}

void expect_tensile(const Eigen::Vector3d &principal)
{
  const Eigen::Matrix3d R = (Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()) *
                             Eigen::AngleAxisd(1.1, Eigen::Vector3d::UnitX()))
                                .toRotationMatrix();
  const double p = -principal.mean(), size = principal.norm();
  const Deviator S = rotated(principal + Eigen::Vector3d::Constant(p), R);
  const Deviator got = tensile_part(p, S), want = rotated(principal.cwiseMax(0.0), R);
  EXPECT_NEAR(got.xx, want.xx, 1e-14 * size);
  EXPECT_NEAR(got.yy, want.yy, 1e-14 * size);
  EXPECT_NEAR(got.zz, want.zz, 1e-14 * size);
  EXPECT_NEAR(got.xy, want.xy, 1e-14 * size);
  EXPECT_NEAR(got.xz, want.xz, 1e-14 * size);
  EXPECT_NEAR(got.yz, want.yz, 1e-14 * size);
}

}    // namespace

TEST(Artstress, TensilePart)
{
  expect_tensile({3.0, 1.0, 2.0});       // all of it
  expect_tensile({-3.0, -1.0, -2.0});    // nothing
  expect_tensile({3.0, 1.0, -2.0});
  expect_tensile({3.0, -1.0, -2.0e-3});
  expect_tensile({2.0, 2.0, -5.0});    // axes that are not unique
  expect_tensile({1.0, -5.0, -5.0});
  expect_tensile({1.0 + 1e-9, 1.0, -3.0});
  expect_tensile({4e9, -1e9, 0.0});
  expect_tensile({4e-9, -1e-9, 1e-9});
}

TEST(Artstress, NothingToDoAtRest)
{
  const Deviator got = tensile_part(0.0, {0.0, 0.0, 0.0, 0.0, 0.0, 0.0});
  EXPECT_EQ(contract(got, got), 0.0);
}
