/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_COMPONENTS_H
#define LMP_HVI_COMPONENTS_H

#include "hvi_deliver.h"

#include <cstdint>
#include <functional>
#include <mpi.h>
#include <vector>

namespace HVI {

/* ----------------------------------------------------------------------
   Disjoint sets of 0 .. n-1; the lowest member of a set stands for it.
------------------------------------------------------------------------- */

class DisjointSets {
 public:
  void reset(int n);

  int find(int i)
  {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  }

  void unite(int i, int j)
  {
    i = find(i);
    j = find(j);
    if (i < j)
      parent[j] = i;
    else
      parent[i] = j;
  }

 private:
  std::vector<int> parent;
};

/* ----------------------------------------------------------------------
   Connected components of a graph that is spread over the ranks of a
   communicator.  Knows MPI, but nothing of LAMMPS.

   Every rank owns some vertices, each with an ID > 0 that no other vertex of
   any rank has, and may hold copies of vertices that other ranks (or itself)
   own.  An edge must be known to the owner of at least one of its ends.
   A vertex with an ID <= 0 stays alone whatever edges it is given.

     start(id, nall)     vertices 0 .. id.size()-1 are owned, the rest up to
                         nall-1 are copies
     join(i, j)          an edge; at least one end is owned
     finish(exchange)    exchange(node) copies the nodes of the owned vertices
                         to their copies, on whatever ranks these are
     component(i)        the same node for all owned vertices of a component;
                         its ID is the lowest in the component

   First each rank finds the components of what it owns.  Then, in each round,
   groups of 1, 2, 4, ... ranks merge in pairs: the first rank of a group knows
   the links that leave the group, and only these.  So rounds grow as the
   logarithm of the number of ranks, however often a chain crosses from rank to
   rank, and memory as the links between the two halves of the ranks: few, if
   neighbors in rank are neighbors in space, as in LAMMPS.
------------------------------------------------------------------------- */

class Components {
 public:
  struct Node {
    int64_t id;    // lowest ID of a component
    int rank;      // owner of the vertex with this ID
    int vertex;    // what local(i) gives there for that vertex
  };
  using Exchange = std::function<void(Node *)>;

  explicit Components(MPI_Comm);

  void start(const std::vector<int64_t> &id, int nall);
  void join(int i, int j)
  {
    if (i >= nowned || j >= nowned)
      crossing.push_back({i, j});
    else if (node[i].id > 0 && node[j].id > 0)
      sets.unite(i, j);
  }
  void finish(const Exchange &exchange);

  const Node &component(int i) const { return node[i]; }
  int local(int i) { return sets.find(i); }    // same vertex for all joined within this rank
  int rounds() const { return nrounds; }       // that this rank took part in; rank 0 in all
  double memory_usage() const;

 private:
  struct Edge {
    int i, j;
  };
  struct Link {
    Node own, far;    // components inside ranks
    Node label;       // what own has been merged into so far
  };

  MPI_Comm world;
  MPI_Datatype link_type, node_type;    // in finish() only
  int me, nprocs, nowned, nrounds;
  DisjointSets sets;
  std::vector<Node> node;
  std::vector<Edge> crossing;

  std::vector<Link> find_links() const;
  std::vector<Node> merge(std::vector<Link> links, int span);
};

}    // namespace HVI

#endif
