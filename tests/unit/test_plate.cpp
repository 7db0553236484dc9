/* ----------------------------------------------------------------------
   lammps-hvi: hypervelocity impact for LAMMPS, GNU GPL version 2, see LICENSE
   The map of a plate and its hole, where nodes can be counted by hand.
------------------------------------------------------------------------- */

#include "hvi_plate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

using HVI::Plate;

namespace {

// a plate of mass per area f(x, y), in spacings, on nodes up to half from the center and four more

using Field = std::function<double(int, int)>;

Plate plate(int half, const Field &f, double h = 1.0)
{
  Plate p;
  const double lo[2] = {-half * h, -half * h}, hi[2] = {half * h, half * h};
  EXPECT_TRUE(p.lay_out(lo, hi, h));
  for (int i = 0; i < p.n[0]; i++)
    for (int j = 0; j < p.n[1]; j++) {
      const int x = i - half - 3, y = j - half - 3;
      if (std::abs(x) <= half && std::abs(y) <= half) p.areal[p.index(i, j)] = f(x, y);
    }
  return p;
}

int most(int x, int y)
{
  return std::max(std::abs(x), std::abs(y));
}

// 8 x 8 points of a cell between nodes: where a side is 1 and the other 0, half of them are below 0.5; with one corner
// 0 the 10 with (1 - u) (1 - w) > 0.5, with one corner 1 all but 10

constexpr double SIDE = 0.5, CORNER = 10.0 / 64.0;

double square_hole(int n)    // of nodes -n to n
{
  return 4.0 * n * n + 8.0 * n * SIDE + 4.0 * CORNER;
}

void expect_area(const Plate &p, double area)
{
  const double spread = 0.5 * M_PI;
  const Plate::Hole hole = p.measure(360);
  EXPECT_NEAR(hole.area / (p.h * p.h), area + spread, 1e-11 * area);
  EXPECT_NEAR(hole.diameter, 2.0 * std::sqrt(hole.area / M_PI), 1e-12);
}
}    // namespace

TEST(PlateMap, HasNodesAroundAllOfIt)
{
  Plate p;
  const double lo[2] = {-2.2, -1.0}, hi[2] = {3.1, 2.0};
  EXPECT_TRUE(p.lay_out(lo, hi, 0.5));
  EXPECT_EQ(p.h, 0.5);
  EXPECT_EQ(p.n[0], 19);    // -8 to 10
  EXPECT_EQ(p.n[1], 13);    // -5 to 7
  EXPECT_EQ(p.node(0, 0.75), 9.5);
  EXPECT_EQ(p.node(1, 0.0), 5.0);
  EXPECT_EQ(p.index(2, 3), 29);
  EXPECT_EQ(p.areal, std::vector<double>(19 * 13, 0.0));
  EXPECT_EQ(p.memory_usage(), 19 * 13 * 8.0);
}

TEST(PlateMap, IsCoarserThanMemoryAllows)
{
  Plate p;
  const double a[2] = {-5.0, -5.0}, b[2] = {5.0, 5.0};    // 4 million nodes
  EXPECT_FALSE(p.lay_out(a, b, 1e-3));
  EXPECT_DOUBLE_EQ(p.h, 0.005);
  for (int k = 0; k < 2; k++) {    // 100,000 in a line
    double lo[2] = {-0.05, -0.05}, hi[2] = {0.05, 0.05};
    lo[k] = -400.0;
    hi[k] = 600.0;
    EXPECT_FALSE(p.lay_out(lo, hi, 1e-3));
    EXPECT_DOUBLE_EQ(p.h, 0.01);
    EXPECT_EQ(p.n[k], 100000 + 7);
  }
}

TEST(PlateIntact, IsTheMedianAwayFromEdges)
{
  // slopes along x: the median of what is symmetric is that of x = 0. Its edges and what is near the center do not count
  Plate p = plate(10, [](int x, int y) {
    return most(x, y) < 4 ? 0.0 : most(x, y) == 4 || most(x, y) == 10 ? 0.4 : 2.0 + 0.001 * x;
  });
  p.find_intact();
  EXPECT_EQ(p.intact, 2.0);

  // the outer half of the mass
  double total = 0.0, outside = 0.0, further = 0.0;
  for (int x = -10; x <= 10; x++)
    for (int y = -10; y <= 10; y++) {
      const double mass = p.areal[p.index(x + 13, y + 13)];
      total += mass;
      if (std::sqrt(x * x + y * y) >= p.far) outside += mass;
      if (std::sqrt(x * x + y * y) >= p.far + 1) further += mass;
    }
  EXPECT_GE(outside, 0.5 * total);
  EXPECT_LT(further, 0.5 * total);
}

TEST(PlateIntact, IsNotThatOfAPileAtTheRim)
{
  Plate p = plate(20, [](int x, int y) {
    return most(x, y) == 18 ? 3.0 : 1.0;
  });
  p.find_intact();
  EXPECT_EQ(p.intact, 1.0);
}

TEST(PlateIntact, OfANarrowRingIsTheUpperQuartile)
{
  int n = 0;
  Plate p = plate(5, [&](int x, int y) {
    return most(x, y) == 5 ? 1.0 + 0.01 * (n++ * 7 % 40) : 0.0;
  });
  p.find_intact();
  EXPECT_EQ(n, 40);
  EXPECT_EQ(p.far, 5);
  EXPECT_DOUBLE_EQ(p.intact, 1.30);    // 30 of 40 are below
}

TEST(PlateIntact, IsNothingWithoutMass)
{
  Plate p = plate(5, [](int, int) {
    return 0.0;
  });
  p.find_intact();
  EXPECT_EQ(p.intact, 0.0);
  EXPECT_EQ(p.find_hole(0.5, false), Plate::OPEN);
}

TEST(PlateHole, SquareIsCountedExactly)
{
  for (const double h : {1.0, 0.25})
    for (const int n : {2, 3, 6, 40}) {    // the last in coarser points, but for its edge
      Plate p = plate(
          n + 11,
          [&](int x, int y) {
            return most(x, y) > n ? 1.0 : 0.0;
          },
          h);
      p.find_intact();
      EXPECT_EQ(p.intact, 1.0);
      ASSERT_EQ(p.find_hole(0.5, false), Plate::HOLE);
      expect_area(p, square_hole(n));
      const Plate::Hole hole = p.measure(360);
      EXPECT_NEAR(hole.center[0], 0.0, 1e-12);
      EXPECT_NEAR(hole.center[1], 0.0, 1e-12);
    }
}

TEST(PlateHole, EdgeIsWhereThereIsThatShareOfThePlate)
{
  // 5/8 of a cell at the edge are below a fill of 0.6875 - with m points, those with u < fill
  Plate p = plate(14, [](int x, int) {
    return std::abs(x) > 3 ? 4.0 : 0.0;
  });
  for (int i = 0; i < p.n[0]; i++)    // closed at both ends
    for (int j = 0; j < p.n[1]; j++)
      if (std::abs(j - 17) > 5 && std::abs(j - 17) <= 14)
        p.areal[p.index(i, j)] = std::abs(i - 17) <= 14 ? 4.0 : 0.0;
  p.find_intact();
  EXPECT_EQ(p.intact, 4.0);
  ASSERT_EQ(p.find_hole(0.65, false), Plate::HOLE);    // 5 of 8: u = 1/16 ... 9/16
  int corner = 0;    // of 64 points those with 1 - (1 - u) (1 - w) < 0.65
  for (int a = 0; a < 8; a++)
    for (int b = 0; b < 8; b++) corner += (15 - 2 * a) * (15 - 2 * b) > 0.35 * 256;
  expect_area(p, 60.0 + 32 * 0.625 + 4 * corner / 64.0);
}

TEST(PlateHole, NeedNotBeAtTheCenter)
{
  const Field f = [](int x, int y) {
    return most(x - 6, y + 5) > 3 && most(x + 7, y - 7) > 2 ? 1.0 : 0.0;
  };
  Plate p = plate(14, f, 0.5);
  p.find_intact();
  ASSERT_EQ(p.find_hole(0.5, false), Plate::HOLE);    // the larger of two
  expect_area(p, square_hole(3));
  const Plate::Hole hole = p.measure(360);
  EXPECT_NEAR(hole.center[0], 3.0, 1e-12);
  EXPECT_NEAR(hole.center[1], -2.5, 1e-12);

  Plate quarter = plate(14, f);
  quarter.find_intact();
  EXPECT_EQ(quarter.find_hole(0.5, true),
            Plate::NO_HOLE);    // of a mirrored plate there is none elsewhere
  Plate whole = plate(14, [](int, int) {
    return 1.0;
  });
  whole.find_intact();
  EXPECT_EQ(whole.find_hole(0.5, false), Plate::NO_HOLE);
}

TEST(PlateHole, OfOneNodeIsNone)
{
  Plate p = plate(14, [](int x, int y) {
    return most(x, y) > 0 ? 1.0 : 0.0;
  });
  p.find_intact();
  EXPECT_EQ(p.find_hole(0.5, false), Plate::NO_HOLE);
}

TEST(PlateHole, SlotsAreClosed)
{
  // three nodes wide: the hole is what is left if openings of 5 nodes are closed, and 3 nodes around that
  Plate p = plate(20, [](int x, int y) {
    return most(x, y) > 5 && !(x > 0 && std::abs(y) <= 1) ? 1.0 : 0.0;
  });
  p.find_intact();
  ASSERT_EQ(p.find_hole(0.5, false), Plate::HOLE);
  // the square; its side at the slot, the two corners there, and the slot to the next node
  expect_area(p, square_hole(5) + 2 * SIDE + 2 * (1.0 - CORNER - SIDE) + 2.0 + 2 * SIDE);

  Plate thin = plate(20, [](int x, int y) {
    return most(x, y) > 5 && !(x > 0 && y == 0) ? 1.0 : 0.0;
  });
  thin.find_intact();
  ASSERT_EQ(thin.find_hole(0.5, false), Plate::HOLE);
  // one node wide: closed at once; only the two cells at the side of the hole are emptier than without it
  expect_area(thin, square_hole(5) + 2 * (1.0 - CORNER - SIDE));
}

TEST(PlateHole, OpenToTheRimIsNone)
{
  Plate p = plate(14, [](int x, int) {
    return x >= 3 ? 1.0 : 0.0;
  });
  p.find_intact();
  EXPECT_EQ(p.find_hole(0.5, false), Plate::OPEN);
}

TEST(PlateHole, FragmentsInItAreNotPlate)
{
  const auto hole = [](int fragment) {
    Plate p = plate(14, [=](int x, int y) {
      return most(x, y) > 6 || (most(x - 1, y) <= fragment && fragment >= 0) ? 1e-3 : 0.0;
    });
    p.find_intact();
    EXPECT_EQ(p.find_hole(0.5, false), Plate::HOLE);
    EXPECT_EQ(p.areal[p.index(18, 17)], 0.0);    // taken out
    expect_area(p, square_hole(6));
  };
  hole(-1);
  hole(0);
  hole(2);
}

TEST(PlateHole, APieceWithMuchOfTheFarMassIsPlate)
{
  // two halves of a plate, apart from one another: both edges count
  Plate p = plate(14, [](int x, int y) {
    return most(x, y) > 4 && x != 0 ? 1.0 : 0.0;
  });
  p.find_intact();
  ASSERT_EQ(p.find_hole(0.5, false), Plate::HOLE);
  expect_area(p, square_hole(4) + 4 * (1.0 - CORNER - SIDE));
}

// a piece counts from 0.05 of the mass of the outer part on, taken here as it is found

TEST(PlateHole, PiecesBelowATwentiethAreFragments)
{
  int kept = 0, gone = 0;
  for (int k = 0; k < 400; k++) {
    const double each = 0.6 + 0.01 * k;    // mass per area of a piece in a corner
    Plate p = plate(14, [=](int x, int y) {
      if (x >= 10 && y >= 10) return each;
      return (most(x, y) <= 4 || (x >= 9 && y >= 9)) ? 0.0 : 1.0;
    });
    p.find_intact();
    double total = 0.0, piece = 0.0;
    for (int x = -14; x <= 14; x++)
      for (int y = -14; y <= 14; y++) {
        const double mass = p.areal[p.index(x + 17, y + 17)];
        if (mass < 0.5 * p.intact || std::hypot(x, y) < p.far) continue;
        total += mass;
        if (x >= 10 && y >= 10) piece += mass;
      }
    if (piece == 0.0) continue;
    p.find_hole(0.5, false);
    EXPECT_EQ(p.areal[p.index(30, 30)] > 0.0, piece >= 0.05 * total)
        << each << " " << piece / total;
    gone += piece > 0.045 * total && piece < 0.05 * total;
    kept += piece < 0.055 * total && piece > 0.05 * total;
  }
  EXPECT_GT(kept, 0);
  EXPECT_GT(gone, 0);
}

TEST(PlateHole, DiametersOfAnEllipse)
{
  // no spreading here, but measure() takes out that of particles
  const double a = 12.0, b = 7.0;
  const auto across = [](double half) {
    return 2.0 * std::sqrt(half * half + 0.5);
  };
  Plate p = plate(30, [=](int x, int y) {
    const double r = std::hypot(x / a, y / b),
                 slope = r > 0.0 ? std::hypot(x / a / a, y / b / b) / r : 1.0 / b;
    return std::clamp(0.5 + (r - 1.0) / slope / 4.0, 0.0, 1.0);
  });
  p.find_intact();
  EXPECT_EQ(p.intact, 1.0);
  ASSERT_EQ(p.find_hole(0.5, false), Plate::HOLE);
  const Plate::Hole hole = p.measure(1000);
  EXPECT_NEAR(hole.diameter, across(std::sqrt(a * b)), 0.005 * hole.diameter);
  EXPECT_NEAR(hole.largest, across(a), 0.015 * hole.largest);
  EXPECT_NEAR(hole.smallest, across(b), 0.015 * hole.smallest);
}

TEST(PlateHole, DiametersOfACircleAreOne)
{
  for (const int sectors : {8, 12, 1000}) {
    Plate p = plate(40, [](int x, int y) {
      return std::clamp(0.5 + (std::hypot(x, y) - 20.0) / 4.0, 0.0, 1.0);
    });
    p.find_intact();
    ASSERT_EQ(p.find_hole(0.5, false), Plate::HOLE);
    const Plate::Hole hole = p.measure(sectors);
    const double d = 2.0 * std::sqrt(400.5);
    EXPECT_NEAR(hole.diameter, d, 1e-3 * d);
    EXPECT_NEAR(hole.smallest, d, 0.01 * d);
    EXPECT_NEAR(hole.largest, d, 0.01 * d);
  }
}
