/* ----------------------------------------------------------------------
   lammps-hvi: hypervelocity impact for LAMMPS, GNU GPL version 2, see LICENSE
   Half lists made cell by cell, against all pairs: each once, on one rank of two.
------------------------------------------------------------------------- */

#include "hvi_rows.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>

using Point = std::array<double, 3>;

namespace {

constexpr double SKIN = 0.1;
constexpr int TYPES = 2;
const double REACH[TYPES + 1][TYPES + 1] = {{}, {0.0, 0.5, 0.7}, {0.0, 0.7, 0.9}};

double squared(const Point &a, const Point &b)
{
  const double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  return d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
}

struct Scene {
  std::vector<Point> x;    // of a lattice: many coordinates are the same
  std::vector<int> type;

  Scene(int n, unsigned seed)
  {
    std::mt19937 random(seed);
    std::set<Point> there;
    while ((int) x.size() < n) {
      const Point p = {0.25 * (random() % 24), 0.25 * (random() % 12), 0.25 * (random() % 10)};
      if (!there.insert(p).second) continue;
      x.push_back(p);
      type.push_back(1 + random() % TYPES);
    }
  }
  bool near(int i, int j) const
  {
    const double reach = REACH[type[i]][type[j]] + SKIN;
    return squared(x[i], x[j]) <= reach * reach;
  }
};

// what a rank finds: it owns what is on its side of x = at, and has all others as ghosts

void look(const Scene &s, double at, bool above, bool newton,
          std::map<std::pair<int, int>, int> &found, bool by_demand)
{
  std::vector<int> number_of;    // owned points, then ghosts
  for (const bool owned : {true, false})
    for (int i = 0; i < (int) s.x.size(); i++)
      if ((s.x[i][0] > at) == (above == owned)) number_of.push_back(i);
  int owned = 0;
  std::vector<const double *> x;
  std::vector<int> type;
  for (const int i : number_of) {
    owned += (s.x[i][0] > at) == above;
    x.push_back(s.x[i].data());
    type.push_back(s.type[i]);
  }
  double cutsq[TYPES + 1][TYPES + 1] = {};
  const double *rows[TYPES + 1];
  for (int a = 0; a <= TYPES; a++) {
    rows[a] = cutsq[a];
    for (int b = 0; b <= TYPES; b++) cutsq[a][b] = (REACH[a][b] + SKIN) * (REACH[a][b] + SKIN);
  }
  HVI::RelativeMotion motion;
  motion.start(x.size(), x.data(), 0.9, SKIN);
  HVI::NeighborRows lists;
  lists.start(motion, {owned, (int) x.size(), x.data(), type.data(), rows, 1.0, newton, 1000000});
  ASSERT_EQ(lists.cells(), motion.cells());

  // in any order, some twice; rows that are there stay where they are

  std::vector<int *> before;
  for (int c = lists.cells() - 1; c >= 0; c -= 2) lists.make(c);
  before = lists.first;
  for (int c = 0; c < lists.cells() && !by_demand; c++) lists.make(c);
  int seen = 0;
  for (int c = 0; c < lists.cells(); c++)
    for (const int *i = lists.begin(c); i < lists.end(c); i++) {
      EXPECT_EQ(motion.cell_of(*i), c);
      EXPECT_LT(*i, owned);
      seen++;
      if (before[*i]) { EXPECT_EQ(before[*i], lists.first[*i]); }
      if (!lists.has(c)) { EXPECT_EQ(lists.number[*i], 0); }
      for (int k = 0; k < lists.number[*i]; k++) {
        const int a = number_of[*i], b = number_of[lists.first[*i][k]];
        found[{std::min(a, b), std::max(a, b)}]++;
      }
    }
  EXPECT_EQ(seen, owned);
}
}    // namespace

TEST(NeighborRows, have_every_pair_once)
{
  for (const double at : {-1.0, 1.1, 3.0})    // one rank, and two that share the points
    for (const bool newton : {true, false}) {
      const Scene s(900, 3);
      std::map<std::pair<int, int>, int> found;
      look(s, at, true, newton, found, false);
      if (at > 0.0) look(s, at, false, newton, found, false);
      int pairs = 0;
      for (int i = 0; i < (int) s.x.size(); i++)
        for (int j = i + 1; j < (int) s.x.size(); j++) {
          const bool across = (s.x[i][0] > at) != (s.x[j][0] > at);
          const int wanted = !s.near(i, j) ? 0 : (across && !newton ? 2 : 1);
          const auto it = found.find({i, j});
          EXPECT_EQ(it == found.end() ? 0 : it->second, wanted) << i << " " << j << " " << at;
          pairs += wanted > 0;
        }
      EXPECT_GT(pairs, 3000);
    }
}

TEST(NeighborRows, are_made_where_they_are_asked_for)
{
  const Scene s(900, 4);
  std::map<std::pair<int, int>, int> some, all;
  look(s, -1.0, true, true, some, true);
  look(s, -1.0, true, true, all, false);
  EXPECT_GT(some.size(), 100u);
  EXPECT_LT(some.size(), all.size() - 100);
  for (const auto &one : some) EXPECT_EQ(all.count(one.first), 1u);
}

TEST(NeighborRows, of_nothing)
{
  HVI::RelativeMotion motion;
  motion.start(0, nullptr, 0.9, SKIN);
  HVI::NeighborRows lists;
  lists.start(motion, {0, 0, nullptr, nullptr, nullptr, 1.0, true, 1000000});
  EXPECT_EQ(lists.cells(), 0);
}
