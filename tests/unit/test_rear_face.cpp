/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#include "hvi_rear_face.h"

#include <gtest/gtest.h>

#include <cmath>

using HVI::RearFace;

static const double ZERO[2] = {0.0, 0.0};

// a slope in one direction: what is deeper than all columns around is hidden

TEST(RearFace, HidesWhatTheBodyReachesBeyond)
{
  RearFace face;
  const double lo[2] = {0.0, 0.0}, hi[2] = {10.0, 6.0};
  face.start(lo, hi, 1.0, ZERO);
  EXPECT_EQ(face.columns().size(), 11u * 7u);
  for (int p = 0; p < 11; p++)
    for (int q = 0; q < 7; q++) face.add(p + 0.5, q + 0.5, p, 0.4);
  for (const double b : {0.1, 3.3, 6.9}) {
    EXPECT_TRUE(face.hides(5.5, b, 3.49)) << b;
    EXPECT_FALSE(face.hides(5.5, b, 3.5)) << b;
    EXPECT_FALSE(face.hides(10.99, b, 8.5)) << "the last column looks at the one before it";
    EXPECT_TRUE(face.hides(10.99, b, 8.4)) << b;
  }
  face.columns()[5 * 7 + 3] = RearFace::NONE;    // a hole
  for (int p = 4; p <= 6; p++) EXPECT_FALSE(face.hides(p + 0.5, 3.5, -1.0)) << p;
  EXPECT_TRUE(face.hides(7.5, 3.5, 5.4));
}

// a quarter has the columns of the whole

TEST(RearFace, MirrorImages)
{
  RearFace whole, quarter;
  const double hi[2] = {5.3, 4.1}, lo[2] = {-5.3, -4.1}, least[2] = {0.2, 0.3};
  whole.start(lo, hi, 0.7, ZERO);
  quarter.start(least, hi, 0.7, ZERO);
  EXPECT_EQ(whole.columns().size(), 4 * quarter.columns().size());
  for (int k = 0; k < 60; k++) {
    const double a = 0.2 + 0.089 * k, b = 0.3 + std::fmod(0.61 * k, 3.8),
                 h = std::fmod(7.0 * k, 5.0);
    quarter.add(a, b, h, 0.5);
    for (const double x : {a, -a})
      for (const double y : {b, -b}) whole.add(x, y, h, 0.5);
  }
  for (double a = 0.05; a < 5.6; a += 0.171)
    for (double b = 0.05; b < 4.5; b += 0.133)
      for (const double x : {a, -a})
        for (const double y : {b, -b})
          EXPECT_EQ(whole.hides(x, y, 2.2), quarter.hides(a, b, 2.2)) << x << ' ' << y;
}

// coarse matter covers several columns

TEST(RearFace, SquaresOfMatter)
{
  RearFace face;
  const double lo[2] = {0.0, 0.0}, hi[2] = {8.0, 8.0};
  face.start(lo, hi, 1.0, ZERO);
  face.add(4.5, 4.5, 2.0, 1.5);
  int covered = 0;
  for (const double h : face.columns()) covered += h == 2.0;
  EXPECT_EQ(covered, 16);
  EXPECT_TRUE(face.hides(4.5, 4.5, 1.0));
  EXPECT_FALSE(face.hides(2.5, 4.5, 1.0));
  face.add(-5.0, 4.5, 9.0, 1.0);    // beside it all
  face.add(4.5, 1e300, 9.0, 1.0);
  for (const double h : face.columns()) EXPECT_LT(h, 9.0);
}

TEST(RearFace, WhatIsBesideIsNotHidden)
{
  RearFace face;
  const double lo[2] = {0.0, 0.0}, hi[2] = {1.0, 1.0};
  face.start(lo, hi, 0.25, ZERO);
  for (double a = 0.0; a <= 1.0; a += 0.125)
    for (double b = 0.0; b <= 1.0; b += 0.125) face.add(a, b, 1.0, 0.1);
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
  face.start(high, low, 1.0, ZERO);    // as least and most of nothing come out
  EXPECT_TRUE(face.columns().empty());
  face.add(0.0, 0.0, 1.0, 1.0);
  EXPECT_FALSE(face.hides(0.0, 0.0, 0.0));
  const double lo[2] = {0.0, 0.0}, hi[2] = {1e6, 2.0}, corner[2] = {1e6, 1e6};
  for (const double *to : {hi, corner}) {
    face.start(lo, to, 1e-3, ZERO);
    EXPECT_LT(face.columns().size(), 2100000u);
    face.add(to[0], to[1], 1.0, 1e7);
    EXPECT_TRUE(face.hides(to[0], to[1], 0.0));
  }
}
