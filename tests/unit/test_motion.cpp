/* ----------------------------------------------------------------------
   lammps-hvi: hypervelocity impact for LAMMPS, GNU GPL version 2, see LICENSE
   Relative motion of points in cells, against all pairs: when a list of neighbors may lack one.
------------------------------------------------------------------------- */

#include "hvi_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <string>

using Point = std::array<double, 3>;
using Points = std::vector<Point>;

namespace {

constexpr double CUT = 1.0, SKIN = 0.3;
constexpr size_t NOWHERE = std::string::npos;

std::vector<const double *> rows(const Points &points)
{
  std::vector<const double *> made;
  for (const Point &p : points) made.push_back(p.data());
  return made;
}

class Motion {
 public:
  HVI::RelativeMotion cells;

  explicit Motion(const Points &x) { cells.start(x.size(), rows(x).data(), CUT, SKIN); }
  bool exceeded(const Points &moved) { return cells.exceeded(rows(moved).data()); }
};

double distance(const Point &a, const Point &b)
{
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

// a pair that was not in the list, and now is within cut

bool misses(const Points &x, const Points &moved)
{
  Points now = x;
  for (size_t i = 0; i < x.size(); i++)
    for (int k = 0; k < 3; k++) now[i][k] += moved[i][k];
  for (size_t i = 0; i < x.size(); i++)
    for (size_t j = 0; j < i; j++)
      if (distance(now[i], now[j]) < CUT && distance(x[i], x[j]) > CUT + SKIN) return true;
  return false;
}

Points cloud(int n, double size, unsigned seed, const Point &center = {})
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-0.5 * size, 0.5 * size);
  Points points(n);
  for (Point &p : points)
    for (int k = 0; k < 3; k++) p[k] = center[k] + place(random);
  return points;
}

Points both(Points a, const Points &b)
{
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

struct Where {
  std::string name;
  Points x;
};

const std::vector<Where> PLACES = {
    {"none", {}},
    {"one point", {{0.1, 0.2, 0.3}}},
    {"one cell", cloud(40, 1.5, 1, {0.8, 0.8, 0.8})},
    {"around the origin", cloud(60, 1.5, 2)},
    {"even", cloud(250, 9.0, 3)},
    {"sparse", cloud(120, 60.0, 4)},
    {"clusters",
     both(both(cloud(60, 3.0, 5), cloud(60, 3.0, 6, {7.1, -2.0, 1.0})),
          cloud(40, 2.0, 7, {-9.0, 30.0, 4.0}))},
    {"wide voids",
     both(both(cloud(50, 2.0, 8, {-4e3, 20.0, 1e5}), cloud(50, 2.0, 9, {4e3, 20.0, 1e5})),
          {{1e8, 1.0, 1.0}, {1e8, 1.0, 6.0}})},
    {"two bodies, a gap below the reach",
     both(cloud(80, 3.0, 10), cloud(80, 3.0, 11, {3.4, 0.2, 0.1}))},
    {"two bodies, a gap above the reach",
     both(cloud(80, 3.0, 12), cloud(80, 3.0, 13, {5.7, 0.2, 0.1}))},
};

// ways to move, larger and larger with s; of two groups the first half is one

using Move = std::function<Point(const Point &, int i, int n, double s, std::mt19937 &)>;
struct How {
  std::string name;
  Move move;
};

const std::vector<How> MOVES = {
    {"nothing",
     [](const Point &, int, int, double, std::mt19937 &) {
       return Point{};
     }},
    {"all alike",
     [](const Point &, int, int, double s, std::mt19937 &) {
       return Point{100.0 * s, -70.0 * s, 3.0 * s};
     }},
    {"past each other",
     [](const Point &, int i, int n, double s, std::mt19937 &) {
       return Point{0.0, 2 * i < n ? s : -s, 0.1 * s};
     }},
    {"toward each other",
     [](const Point &, int i, int n, double s, std::mt19937 &) {
       return Point{2 * i < n ? s : -s, 0.0, 9.0 * s};
     }},
    {"away",
     [](const Point &, int i, int n, double s, std::mt19937 &) {
       return Point{2 * i < n ? -s : s, 0.0, 0.0};
     }},
    {"expansion",
     [](const Point &x, int, int, double s, std::mt19937 &) {
       return Point{0.2 * s * x[0], 0.2 * s * x[1], 0.2 * s * x[2]};
     }},
    {"contraction",
     [](const Point &x, int, int, double s, std::mt19937 &) {
       const double part = -std::min(0.02 * s, 1.0);
       return Point{part * x[0], part * x[1], part * x[2]};
     }},
    {"shear",
     [](const Point &x, int, int, double s, std::mt19937 &) {
       return Point{s * x[1], 0.0, 0.0};
     }},
    {"at random",
     [](const Point &, int, int, double s, std::mt19937 &random) {
       std::uniform_real_distribution<double> part(-s, s);
       return Point{part(random), part(random), part(random)};
     }},
    {"one alone",
     [](const Point &, int i, int n, double s, std::mt19937 &) {
       return i == n / 2 ? Point{3.0 * s, 5.0 * s, -2.0 * s} : Point{};
     }},
    {"one across",
     [](const Point &x, int i, int, double s, std::mt19937 &) {
       const double part = -std::min(0.1 * s, 1.3);
       return i == 0 ? Point{part * x[0], part * x[1], part * x[2]} : Point{};
     }},
};

TEST(RelativeMotion, NoPairIsMissed)
{
  int nmissing = 0, nquiet = 0;
  for (const Where &where : PLACES) {
    Motion motion(where.x);
    for (const How &how : MOVES) {
      int yes = 0;
      for (double s = 0.01; s < 60.0; s *= 1.25) {
        std::mt19937 random(17);
        Points moved;
        for (size_t i = 0; i < where.x.size(); i++)
          moved.push_back(how.move(where.x[i], i, where.x.size(), s, random));
        const bool says = motion.exceeded(moved), missing = misses(where.x, moved);
        EXPECT_TRUE(says || !missing) << where.name << ", " << how.name << ", " << s;
        nmissing += missing;
        nquiet += !says;
        yes += missing;
      }
      const bool below = how.name == "past each other" && where.name.find("gap below") != NOWHERE;
      const bool above = how.name == "toward each other" && where.name.find("gap above") != NOWHERE;
      if (below || above) { EXPECT_GT(yes, 0) << where.name; }
    }
  }
  EXPECT_GT(nmissing, 300);    // the ways to move do bring pairs together
  EXPECT_GT(nquiet, 900);
}

// random places and velocities, as long as it says no

TEST(RelativeMotion, NoPairIsMissedWhileItSaysNo)
{
  int nfirst = 0;
  for (unsigned seed = 1; seed <= 60; seed++) {
    const double size = seed % 3 == 0 ? 4.0 : (seed % 3 == 1 ? 12.0 : 40.0);
    const Points x = cloud(seed % 3 == 0 ? 40 : 150, size, seed),
                 v = cloud(x.size(), 2.0, 1000 + seed);
    Motion motion(x);
    bool was_missing = false;
    for (double t = 0.0; t < 20.0 && !was_missing; t += 0.02 + 0.05 * t) {
      Points moved = v;
      for (Point &p : moved)
        for (double &s : p) s = t * s + 1e3 * t;    // and all of them fly
      const bool missing = misses(x, moved);
      EXPECT_TRUE(!missing || motion.exceeded(moved)) << seed << ", " << t;
      was_missing = missing;
    }
    nfirst += was_missing;
  }
  EXPECT_GT(nfirst, 50);
}

// two points anywhere: within skin in the first level, within size - cut - skin beyond

TEST(RelativeMotion, OfTwoPoints)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  int nmissing = 0;
  for (int n = 0; n < 100000; n++) {
    const double far = std::pow(10.0, 2.0 * part(random));
    const Points x = {{5.0 * part(random), 5.0 * part(random), 5.0 * part(random)},
                      {5.0 + far * part(random), far * part(random), far * part(random)}};
    Motion motion(x);
    const double by = 1.02 * part(random);    // nearly to the same place, or beyond it
    const Points moved = {
        {by * (x[1][0] - x[0][0]), by * (x[1][1] - x[0][1]), by * (x[1][2] - x[0][2])}, {}};
    const bool missing = misses(x, moved);
    nmissing += missing;
    ASSERT_TRUE(motion.exceeded(moved) || !missing) << n;
  }
  EXPECT_GT(nmissing, 5000);
}

// two that meet, each beside others at rest: boxes of both cells hold what is at rest, too

TEST(RelativeMotion, OfTwoWhoMeet)
{
  std::mt19937 random(6);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  for (int n = 0; n < 20000; n++) {
    const Point a = {9.0 * part(random), 9.0 * part(random), 9.0 * part(random)};
    Point e = {part(random), part(random), part(random)};
    const double far = CUT + (1.001 + std::fabs(part(random))) * SKIN, length = distance(e, {});
    for (double &s : e) s /= length;
    Points x = {a, a, a, a}, moved(4, Point{});
    for (int k = 0; k < 3; k++) {
      x[1][k] += far * e[k];
      x[2][k] += 0.1 * part(random);
      x[3][k] += far * e[k] + 0.1 * part(random);
      moved[0][k] = 0.5 * (far - 0.99 * CUT) * e[k];
      moved[1][k] = -moved[0][k];
    }
    Motion motion(x);
    ASSERT_TRUE(misses(x, moved));
    ASSERT_TRUE(motion.exceeded(moved)) << n;
  }
}

TEST(RelativeMotion, NoneWhenAllMoveAlike)
{
  const Point way = {1e6, -3e5, 12.0};
  for (const Where &where : PLACES) {
    Motion motion(where.x);
    const Points moved(where.x.size(), way);
    EXPECT_FALSE(motion.exceeded(moved)) << where.name;
    for (int k = 0; k < 3; k++)
      EXPECT_EQ(motion.cells.farthest(k), where.x.empty() ? 0.0 : std::fabs(way[k]));
  }
}

/* ----------------------------------------------------------------------
   Displacements of any two differ by no more than skin in length, if each is in a cube of the edge
   skin/sqrt(3), or not longer than half of that: such never make a list.  Those of LAMMPS's own
   criterion, skin/2 in length, may: what is looked at are boxes, with diagonals up to sqrt(3) skin.
------------------------------------------------------------------------- */

TEST(RelativeMotion, NoneWithinItsBound)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  const double edge = SKIN / std::sqrt(3.0) * (1.0 - 1e-12);
  for (const Where &where : PLACES) {
    Motion motion(where.x);
    for (int n = 0; n < 20; n++) {
      Points moved;
      Point most = {};
      for (size_t i = 0; i < where.x.size(); i++) {
        Point p;
        for (int k = 0; k < 3; k++) {
          p[k] = 0.5 * edge * (n % 2 ? part(random) : (part(random) < 0.0 ? -1.0 : 1.0));
          most[k] = std::max(most[k], std::fabs(p[k]));
        }
        moved.push_back(p);
      }
      EXPECT_FALSE(motion.exceeded(moved)) << where.name;
      for (int k = 0; k < 3; k++) EXPECT_EQ(motion.cells.farthest(k), most[k]);
    }
  }
  Motion two({{0.1, 0.1, 0.1}, {0.2, 0.2, 0.2}});
  const double more = 0.5 * SKIN / std::sqrt(3.0) * (1.0 + 1e-9);
  EXPECT_TRUE(two.exceeded({{more, more, more}, {-more, -more, -more}}));
}

// bodies far apart are given way in proportion: see the sizes of levels

TEST(RelativeMotion, WhatIsFarApartMayMove)
{
  const double size = CUT + 3.0 * SKIN;
  for (double gap = 4.5 * size; gap < 1e6; gap *= 1.37) {
    const Points x = both(cloud(30, 2.0, 21), cloud(30, 2.0, 22, {gap + 2.0, 0.3, 0.2}));
    Motion motion(x);
    Points moved(60, Point{});
    const auto approach = [&](double by) {
      for (int i = 0; i < 30; i++) moved[i] = {by, 0.0, 0.0};
      return motion.exceeded(moved);
    };

    // cells in which they are adjacent are larger than a half of the gap, those before than a quarter

    EXPECT_FALSE(approach(0.25 * gap - CUT)) << gap;
    EXPECT_TRUE(approach(gap)) << gap;
  }
}

TEST(RelativeMotion, TakesWhatIsFarAwayOrNotANumber)
{
  Motion motion(
      {{1e300, 0.0, 0.0}, {-1e300, 1e16, 0.0}, {NAN, INFINITY, -INFINITY}, {0.1, 0.1, 0.1}});
  EXPECT_EQ(motion.cells.points(), 4);
  EXPECT_FALSE(motion.exceeded(Points(4, Point{})));
  EXPECT_TRUE(motion.exceeded({{-2e300, 0.0, 0.0}, {}, {}, {}}));
}

TEST(RelativeMotion, CellsHoldAllThatIsNear)
{
  for (const Where &where : PLACES) {
    Motion motion(where.x);
    const HVI::RelativeMotion &cells = motion.cells;
    const int n = cells.cells();
    std::vector<std::vector<char>> near(n, std::vector<char>(n, 0));
    cells.each_adjacent([&](int a, int b) {
      EXPECT_FALSE(a == b || near[a][b]) << where.name;    // each two once
      near[a][b] = near[b][a] = 1;
    });
    for (size_t i = 0; i < where.x.size(); i++) {
      ASSERT_LT(cells.cell_of(i), n);
      for (size_t j = 0; j < i; j++)
        if (distance(where.x[i], where.x[j]) < CUT + 3.0 * SKIN) {
          const int a = cells.cell_of(i), b = cells.cell_of(j);
          EXPECT_TRUE(a == b || near[a][b]) << where.name;
        }
    }
  }
}

}    // namespace
