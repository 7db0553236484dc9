/* ----------------------------------------------------------------------
   lammps-hvi: hypervelocity impact for LAMMPS, GNU GPL version 2, see LICENSE
   Points in cells: who may be near a place, against all pairs.
------------------------------------------------------------------------- */

#include "hvi_cells.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

using Point = std::array<double, 3>;

namespace {

struct Case {
  Point distance;
  std::array<bool, 3> periodic;
};

class CellsOf : public ::testing::TestWithParam<Case> {
 protected:
  std::vector<Point> cloud(int n, unsigned seed, double lo, double hi) const
  {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(lo, hi);
    std::vector<Point> points(n);
    for (Point &p : points)
      for (double &s : p) s = place(random);
    return points;
  }

  // as boxes overlap, periodic directions counted by the nearest image

  bool within(const Point &a, const Point &b) const
  {
    for (int k = 0; k < 3; k++) {
      double d = a[k] - b[k];
      if (GetParam().periodic[k]) d -= std::round(d);
      if (std::fabs(d) > GetParam().distance[k]) return false;
    }
    return true;
  }
};

TEST_P(CellsOf, NobodyNearIsMissedOrTwice)
{
  const auto points = cloud(300, 1, -0.6, 1.7), places = cloud(200, 2, -0.6, 1.7);
  HVI::Cells cells(GetParam().distance.data(), GetParam().periodic.data());
  for (size_t n = 0; n < points.size(); n++) cells.add(n, points[n].data());
  cells.sort();

  int nnear = 0;
  for (const Point &s : places) {
    std::vector<int> found;
    cells.near(s.data(), [&](int n) { found.push_back(n); });
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    EXPECT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
    for (size_t n = 0; n < points.size(); n++)
      if (within(points[n], s)) {
        nnear++;
        EXPECT_TRUE(std::binary_search(found.begin(), found.end(), (int) n)) << n;
      }
  }
  EXPECT_GT(nnear, 20);
}

const std::array<bool, 3> NO = {false, false, false}, ALL = {true, true, true};
INSTANTIATE_TEST_SUITE_P(Boxes, CellsOf,
                         ::testing::Values(Case{{0.11, 0.13, 0.1}, NO}, Case{{0.11, 0.13, 0.1}, ALL},
                                           Case{{0.34, 0.45, 0.3}, ALL}, Case{{0.6, 1.2, 5.0}, ALL},
                                           Case{{0.25, 0.2, 0.5}, {true, false, true}},
                                           Case{{0.1, 3.0, 0.1}, {false, true, false}}));

TEST(Cells, AreFewPerPlace)
{
  const double width[3] = {0.01, 0.01, 0.01};
  const bool periodic[3] = {false, true, false};
  HVI::Cells cells(width, periodic);
  const int n = 40;
  for (int i = 0; i < n * n * n; i++) {
    const double s[3] = {0.0101 * (i % n), 0.0101 * (i / n % n), 0.0101 * (i / n / n)};
    cells.add(i, s);
  }
  cells.sort();
  long sum = 0;
  for (int i = 0; i < n * n * n; i++) {
    const double s[3] = {0.0101 * (i % n), 0.0101 * (i / n % n), 0.0101 * (i / n / n)};
    cells.near(s, [&](int) { sum++; });
  }
  EXPECT_LT(sum, 30L * n * n * n);    // of all pairs there are 64,000 n^3
}

TEST(Cells, TakeWhatIsNotANumber)
{
  const double width[3] = {0.1, 0.1, 0.1}, nan[3] = {NAN, INFINITY, -INFINITY};
  const bool periodic[3] = {false, false, true};
  HVI::Cells cells(width, periodic);
  cells.add(0, nan);
  cells.sort();
  int found = 0;
  cells.near(nan, [&](int) { found++; });
  EXPECT_EQ(found, 1);
}

}    // namespace
