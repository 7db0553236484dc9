/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#include "hvi_pieces.h"

#include <gtest/gtest.h>

using HVI::Pieces;

// mass and momentum stay what they were, whatever the turn; the energy of spreading is known beforehand

TEST(Pieces, MeanAndMeanSquare)
{
  for (int n = 2; n <= 8; n++)
    for (const uint64_t number : {0ull, 1ull, 77ull, 1ull << 62}) {
      const auto places = Pieces::places(n, number);
      ASSERT_EQ(places.size(), (size_t) n * n * n);
      double mean[3] = {}, square = 0.0, most = 0.0;
      for (const auto &x : places) {
        double r = 0.0;
        for (int k = 0; k < 3; k++) {
          mean[k] += x[k];
          r += x[k] * x[k];
        }
        square += r;
        most = std::max(most, r);
      }
      for (int k = 0; k < 3; k++) EXPECT_NEAR(mean[k] / places.size(), 0.0, 1e-15);
      EXPECT_NEAR(square / places.size(), Pieces::mean_square(n), 1e-14);
      EXPECT_NEAR(std::sqrt(most), Pieces::corner(n), 1e-14);
    }
}

// moments of second and fourth order of corners turned in all directions alike

TEST(Pieces, AllDirectionsAlike)
{
  const int many = 20000;
  double xx = 0.0, xy = 0.0, xxxx = 0.0;
  for (int number = 0; number < many; number++) {
    const auto x = Pieces::places(2, number)[7];
    const double rr = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
    xx += x[0] * x[0] / rr;
    xy += x[0] * x[1] / rr;
    xxxx += x[2] * x[2] * x[2] * x[2] / (rr * rr);
  }
  EXPECT_NEAR(xx / many, 1.0 / 3.0, 0.01);
  EXPECT_NEAR(xy / many, 0.0, 0.01);
  EXPECT_NEAR(xxxx / many, 0.2, 0.01);
}

TEST(Pieces, TheSameNumberTheSameTurn)
{
  EXPECT_EQ(Pieces::places(3, 5), Pieces::places(3, 5));
  EXPECT_NE(Pieces::places(3, 5), Pieces::places(3, 6));
}

// mass by mass of fragments whose numbers go as exp(-m/m0): below m0 lies 1 - 2/e of it, and its mean is 2 m0

TEST(Pieces, WidthsOfFragments)
{
  const int many = 100000;
  double mean = 0.0, below = 0.0, above = 0.0;
  for (int number = 0; number < many; number++) {
    const double m = std::pow(Pieces::width(number), 3);
    ASSERT_TRUE(std::isfinite(m) && m > 0.0);
    mean += m / many;
    below += (m < 1.0) / (double) many;
    above += (m > 8.0) / (double) many;
  }
  EXPECT_NEAR(mean, 2.0, 0.02);
  EXPECT_NEAR(below, 1.0 - 2.0 / std::exp(1.0), 0.006);
  EXPECT_NEAR(above, 9.0 * std::exp(-8.0), 0.001);
  EXPECT_EQ(Pieces::width(7), Pieces::width(7));
}
