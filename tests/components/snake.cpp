/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

// hvi_components.* without LAMMPS: graphs whose vertices lie on the ranks as the first argument
// says (blocks, cyclic or random), with IDs in random order.  Rank 0 checks every label against
// a search of its own and prints the number of rounds, the vertices and the components, a line
// for each graph.
//
//   mpirun -np P ./snake {blocks|cyclic|random chain|cut|pairs|empty N} ...

#include "hvi_components.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <numeric>
#include <random>
#include <string>

static int search(const std::string &layout, const std::string &graph, int n)
{
  int me, nprocs;
  MPI_Comm_rank(MPI_COMM_WORLD, &me);
  MPI_Comm_size(MPI_COMM_WORLD, &nprocs);

  // the same on all ranks

  std::mt19937 rng(7);
  std::vector<int> owner(n), id(n);
  std::iota(id.begin(), id.end(), 1);
  std::shuffle(id.begin(), id.end(), rng);
  for (int v = 0; v < n; v++) {
    if (layout == "blocks") owner[v] = (int64_t) v * nprocs / n;
    if (layout == "cyclic") owner[v] = v % nprocs;
    if (layout == "random") owner[v] = rng() % nprocs;
    if (graph == "empty") owner[v] = nprocs - 1;
  }
  std::vector<std::pair<int, int>> edges;
  for (int v = 0; v + 1 < n; v++) {
    if (graph == "cut" && rng() % 10 == 0) continue;
    if (graph == "pairs" && v % 2) continue;
    edges.emplace_back(v, v + 1);
  }

  // this rank's part: owned vertices first, then a copy of each that an edge leads to

  std::vector<int64_t> ids;
  std::map<int, int> local;
  for (int v = 0; v < n; v++)
    if (owner[v] == me) {
      local[v] = ids.size();
      ids.push_back(id[v]);
    }
  std::vector<int> copies;
  auto find = [&](int v) {
    const auto found = local.find(v);
    if (found != local.end()) return found->second;
    copies.push_back(v);
    return local[v] = ids.size() + copies.size() - 1;
  };
  std::vector<std::pair<int, int>> mine;
  for (auto [a, b] : edges)
    if (owner[(a % 2) ? a : b] == me) mine.emplace_back(find(a), find(b));    // on one side only

  HVI::Components components(MPI_COMM_WORLD);
  components.start(ids, ids.size() + copies.size());
  for (auto [i, j] : mine) components.join(i, j);
  components.finish([&](HVI::Components::Node *node) {
    std::vector<HVI::Components::Node> all(n);
    for (int v = 0; v < n; v++)
      if (owner[v] == me) all[v] = node[local[v]];
    for (int p = 0; p < nprocs; p++) {
      std::vector<HVI::Components::Node> theirs(all);
      MPI_Bcast(theirs.data(), n * sizeof(theirs[0]), MPI_BYTE, p, MPI_COMM_WORLD);
      for (size_t k = 0; k < copies.size(); k++)
        if (owner[copies[k]] == p) node[ids.size() + k] = theirs[copies[k]];
    }
  });

  // the answer, by hand: every edge is from v to v+1

  std::vector<int> want(id);
  for (auto [a, b] : edges) want[b] = std::min(want[a], want[b]);
  for (size_t k = edges.size(); k-- > 0;) want[edges[k].first] = want[edges[k].second];

  int wrong = 0, allwrong, heads = 0;
  for (int v = 0; v < n; v++)
    if (owner[v] == me && components.component(local[v]).id != want[v]) wrong++;
  MPI_Allreduce(&wrong, &allwrong, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  for (int v = 0; v < n; v++) heads += want[v] == id[v];
  if (me == 0)
    printf("layout %s graph %s rounds %d vertices %d components %d wrong %d\n", layout.c_str(),
           graph.c_str(), components.rounds(), n, heads, allwrong);
  return allwrong;
}

int main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  if (argc < 4 || argc % 3 != 1) MPI_Abort(MPI_COMM_WORLD, 1);
  int wrong = 0;
  for (int k = 1; k < argc; k += 3) wrong += search(argv[k], argv[k + 1], std::stoi(argv[k + 2]));
  MPI_Finalize();
  return wrong > 0;
}
