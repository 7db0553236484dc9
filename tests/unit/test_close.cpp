/* ----------------------------------------------------------------------
   lammps-hvi: hypervelocity impact for LAMMPS, GNU GPL version 2, see LICENSE
   Close pairs against all pairs.
------------------------------------------------------------------------- */

#include "hvi_close.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>

using namespace HVI;

using Pairs = std::multiset<std::pair<int, int>>;

static Pairs found(const std::vector<std::array<double, 3>> &x, double distance)
{
  ClosePairs close;
  for (int i = 0; i < (int) x.size(); i++) close.add(i, x[i].data());
  Pairs pairs;
  close.each(distance, [&](int i, int j, double square) {
    double sum = 0.0;
    for (int k = 0; k < 3; k++) sum += (x[i][k] - x[j][k]) * (x[i][k] - x[j][k]);
    EXPECT_NEAR(square, sum, 1e-12);
    pairs.insert(std::minmax(i, j));
  });
  return pairs;
}

static Pairs all(const std::vector<std::array<double, 3>> &x, double distance)
{
  Pairs pairs;
  for (int i = 0; i < (int) x.size(); i++)
    for (int j = i + 1; j < (int) x.size(); j++) {
      double sum = 0.0;
      for (int k = 0; k < 3; k++) sum += (x[i][k] - x[j][k]) * (x[i][k] - x[j][k]);
      if (sum <= distance * distance) pairs.insert({i, j});
    }
  return pairs;
}

TEST(Close, IsEveryPairOnce)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  for (double size : {0.3, 1.0, 4.0, 40.0})
    for (double shift : {0.0, -7.0, 1.0e6}) {
      std::vector<std::array<double, 3>> x(400);
      for (auto &one : x)
        for (double &coordinate : one) coordinate = shift + size * place(random);
      const Pairs pairs = all(x, 0.7);
      if (size < 10.0) { EXPECT_GT(pairs.size(), 10u); }
      EXPECT_EQ(found(x, 0.7), pairs) << size << " " << shift;
    }
}

TEST(Close, LatticeAsWideAsTheDistance)
{
  for (double spacing : {0.1, 1.0 / 3.0, 0.7}) {
    std::vector<std::array<double, 3>> x;
    for (int k = 0; k < 512; k++)
      x.push_back({spacing * (k % 8) - 0.3, spacing * (k / 8 % 8) + 0.1, spacing * (k / 64)});
    for (double more : {1.0e-12, 1.0e-4})
      EXPECT_EQ(found(x, (1.0 + more) * spacing).size(), 3u * 7 * 64);
  }
}

TEST(Close, FarAwayAndNowhere)
{
  static constexpr double NOWHERE = std::numeric_limits<double>::quiet_NaN(), FAR = 1.0e300;
  std::vector<std::array<double, 3>> x = {
      {0, 0, 0},         {0.5, 0, 0},     {FAR, 0, 0},     {FAR, 0.5, 0}, {1e8, 0, 0},
      {1e8 + 0.5, 0, 0}, {NOWHERE, 0, 0}, {0, NOWHERE, 0}, {-FAR, 1, 1},  {0, 0.5, 0}};
  EXPECT_EQ(found(x, 0.7), all(x, 0.7));
  x.erase(x.begin() + 8);
  EXPECT_EQ(found(x, 0.7), all(x, 0.7));
  EXPECT_EQ(found({}, 1.0), Pairs());
  EXPECT_EQ(found({{1, 2, 3}}, 1.0), Pairs());
  EXPECT_EQ(found({{1, 2, 3}, {1, 2, 3}}, 1.0).size(), 1u);
}
