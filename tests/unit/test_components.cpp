/* ----------------------------------------------------------------------
   lammps-hvi: hypervelocity impact for LAMMPS, GNU GPL version 2, see LICENSE
   Connected components on one rank, with copies of its own vertices as across periodic faces, against a search from
   every vertex. More ranks: tests/style/test_fragments.py.
------------------------------------------------------------------------- */

#include "hvi_components.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace HVI;

namespace {

class ComponentsOf : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { MPI_Init(nullptr, nullptr); }
  static void TearDownTestSuite() { MPI_Finalize(); }

  // copy_of[n]: which vertex n beyond the owned ones is

  static void copy(Components::Node *node, int nowned, const std::vector<int> &copy_of)
  {
    for (size_t n = 0; n < copy_of.size(); n++) node[nowned + n] = node[copy_of[n]];
  }
};

TEST_F(ComponentsOf, DeliveryToMyselfKeepsTheOrder)
{
  const std::vector<int> items = {5, 3, 8};
  EXPECT_EQ(deliver(MPI_COMM_WORLD, items, {0, 0, 0}), items);
  EXPECT_EQ(deliver(MPI_COMM_WORLD, std::vector<int>(), {}), std::vector<int>());
}

TEST_F(ComponentsOf, LowestIdAndLowestVertexStandForAll)
{
  Components c(MPI_COMM_WORLD);
  EXPECT_EQ(c.rounds(), 0);
  c.start({7, 3, 5, 0, 9, 11}, 6);
  c.join(2, 1);
  c.join(0, 2);
  c.join(3, 4);    // an ID of 0 stays alone
  c.join(4, 3);
  c.finish([](Components::Node *) {
  });
  const int64_t id[] = {3, 3, 3, 0, 9, 11};
  const int vertex[] = {0, 0, 0, 3, 4, 5};
  for (int i = 0; i < 6; i++) {
    EXPECT_EQ(c.component(i).id, id[i]);
    EXPECT_EQ(c.component(i).vertex, vertex[i]);
    EXPECT_EQ(c.component(i).rank, 0);
    EXPECT_EQ(c.local(i), vertex[i]);
  }
  EXPECT_EQ(c.rounds(), 0);
  EXPECT_EQ(c.memory_usage(), 6 * sizeof(int) + 7 * sizeof(Components::Node));
}

TEST_F(ComponentsOf, JoinsAcrossItsOwnCopies)
{
  // 4 and 5 are copies of 1 and 3
  Components c(MPI_COMM_WORLD);
  const std::vector<int> copies = {1, 3};
  c.start(
      {
          4,
          2,
          8,
          6,
      },
      6);
  c.join(0, 4);
  c.join(5, 2);
  c.finish([&](Components::Node *node) {
    copy(node, 4, copies);
  });
  const int64_t two[] = {2, 2, 6, 6};
  for (int i = 0; i < 4; i++) EXPECT_EQ(c.component(i).id, two[i]);
  EXPECT_EQ(c.component(0).vertex, 1);
  EXPECT_EQ(c.component(2).vertex, 3);
  EXPECT_EQ(c.local(0), 0);    // here nothing is joined
  EXPECT_GE(c.memory_usage(), 4 * sizeof(int) + 7 * sizeof(Components::Node) + 4 * sizeof(int));

  c.start({4, 2, 8, -6}, 6);    // again, with one that stays alone
  c.join(0, 4);
  c.join(2, 5);
  c.join(4, 2);
  c.finish([&](Components::Node *node) {
    copy(node, 4, copies);
  });
  const int64_t again[] = {2, 2, 2, -6};
  for (int i = 0; i < 4; i++) EXPECT_EQ(c.component(i).id, again[i]);
}

TEST_F(ComponentsOf, AreThoseOfASearch)
{
  std::mt19937 random(7);
  Components c(MPI_COMM_WORLD);
  for (int round = 0; round < 60; round++) {
    const int n = 1 + random() % 60, ncopies = random() % 30, edges = random() % (n + 20);
    std::vector<int64_t> id(n);
    for (int i = 0; i < n; i++) id[i] = 10 * (i + 1);
    std::shuffle(id.begin(), id.end(), random);
    for (int64_t &one : id)
      if (random() % 10 == 0) one = -one;
    std::vector<int> copies(ncopies);
    for (int &of : copies) of = random() % n;
    std::vector<std::vector<int>> beside(n);
    c.start(id, n + ncopies);
    for (int e = 0; e < edges; e++) {
      int i = random() % n, j = random() % (n + ncopies);
      const int at = j < n ? j : copies[j - n];
      if (random() % 2) std::swap(i, j);
      c.join(i, j);
      const int from = i < n ? i : copies[i - n], to = j < n ? j : copies[j - n];
      EXPECT_TRUE(from == at || to == at);
      if (id[from] <= 0 || id[to] <= 0) continue;
      beside[from].push_back(to);
      beside[to].push_back(from);
    }
    c.finish([&](Components::Node *node) {
      copy(node, n, copies);
    });
    for (int start = 0; start < n; start++) {
      std::vector<int> todo = {start};
      std::vector<char> seen(n, 0);
      seen[start] = 1;
      int64_t lowest = id[start];
      while (!todo.empty()) {
        const int i = todo.back();
        todo.pop_back();
        lowest = std::min(lowest, id[i]);
        for (const int j : beside[i])
          if (!seen[j]) {
            seen[j] = 1;
            todo.push_back(j);
          }
      }
      EXPECT_EQ(c.component(start).id, lowest) << round << " " << start;
    }
  }
}
}    // namespace
