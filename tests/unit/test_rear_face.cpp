/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#include "hvi_rear_face.h"

#include <gtest/gtest.h>

using HVI::RearFace;

TEST(RearFace, HidesWhatTheBodyReachesBeyond)
{
  RearFace face;
  const double lo[2] = {-1.0, 2.0}, hi[2] = {1.0, 3.0};
  face.start(lo, hi, 0.5);
  EXPECT_EQ(face.columns().size(), 5u * 3u);
  face.add(-0.9, 2.1, 4.0);
  face.add(-0.6, 2.4, 7.0);    // the same column
  face.add(1.0, 3.0, -2.0);    // the last one
  EXPECT_TRUE(face.hides(-0.99, 2.01, 6.9));
  EXPECT_FALSE(face.hides(-0.99, 2.01, 7.0));
  EXPECT_FALSE(face.hides(-0.4, 2.1, -10.0)) << "a column without matter";
  EXPECT_TRUE(face.hides(1.2, 3.2, -2.1));
  EXPECT_FALSE(face.hides(1.2, 3.2, -1.9));
}

TEST(RearFace, WhatIsBesideIsNotHidden)
{
  RearFace face;
  const double lo[2] = {0.0, 0.0}, hi[2] = {1.0, 1.0};
  face.start(lo, hi, 0.25);
  for (double a = 0.0; a <= 1.0; a += 0.125)
    for (double b = 0.0; b <= 1.0; b += 0.125) face.add(a, b, 1.0);
  for (const double a : {-0.01, 1.3, 1e300, -1e300, double(NAN)}) {
    EXPECT_FALSE(face.hides(a, 0.5, 0.0)) << a;
    EXPECT_FALSE(face.hides(0.5, a, 0.0)) << a;
  }
  EXPECT_TRUE(face.hides(0.5, 0.5, 0.0));
}

TEST(RearFace, OfNoBodyAndOfAHugeOne)
{
  RearFace face;
  const double high[2] = {1e20, 1e20}, low[2] = {-1e20, -1e20};
  face.start(high, low, 1.0);    // as least and most of nothing come out
  EXPECT_TRUE(face.columns().empty());
  face.add(0.0, 0.0, 1.0);
  EXPECT_FALSE(face.hides(0.0, 0.0, 0.0));
  const double lo[2] = {0.0, 0.0}, hi[2] = {1e6, 2.0}, corner[2] = {1e6, 1e6};
  for (const double *to : {hi, corner}) {
    face.start(lo, to, 1e-3);
    EXPECT_LT(face.columns().size(), 1100000u);
    face.add(to[0], to[1], 1.0);
    EXPECT_TRUE(face.hides(to[0], to[1], 0.0));
  }
}
