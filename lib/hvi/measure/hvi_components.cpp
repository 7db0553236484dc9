/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "hvi_components.h"

#include <algorithm>
#include <numeric>
#include <tuple>

using namespace HVI;

static constexpr int LINKS = 1, LABELS = 2;    // message tags

/* ---------------------------------------------------------------------- */

void DisjointSets::reset(int n)
{
  parent.resize(n);
  std::iota(parent.begin(), parent.end(), 0);
}

/* ---------------------------------------------------------------------- */

Components::Components(MPI_Comm comm) : world(comm), nowned(0), nrounds(0)
{
  MPI_Comm_rank(world, &me);
  MPI_Comm_size(world, &nprocs);
}

/* ---------------------------------------------------------------------- */

void Components::start(const std::vector<int64_t> &id, int nall)
{
  nowned = id.size();
  sets.reset(nowned);
  crossing.clear();
  node.resize(nall + 1);    // never empty
  for (int i = 0; i < nowned; i++) node[i] = {id[i], me, i};
}

/* ---------------------------------------------------------------------- */

void Components::finish(const Exchange &exchange)
{
  // lowest ID of each component of this rank, then of each of its vertices

  for (int i = 0; i < nowned; i++) {
    Node &root = node[sets.find(i)];
    root.id = std::min(root.id, node[i].id);
  }
  for (int i = 0; i < nowned; i++) node[i] = node[sets.find(i)];
  exchange(node.data());

  std::vector<Link> links = find_links();
  MPI_Type_contiguous(sizeof(Link), MPI_BYTE, &link_type);
  MPI_Type_contiguous(sizeof(Node), MPI_BYTE, &node_type);
  MPI_Type_commit(&link_type);
  MPI_Type_commit(&node_type);
  nrounds = 0;
  const std::vector<Node> label = merge(links, 1);
  MPI_Type_free(&link_type);
  MPI_Type_free(&node_type);

  for (size_t n = 0; n < links.size(); n++) node[links[n].own.vertex] = label[n];
  for (int i = 0; i < nowned; i++) node[i] = node[sets.find(i)];
}

/* ----------------------------------------------------------------------
   links between components of different ranks (or, through a copy, of this
   one), each known on both sides
------------------------------------------------------------------------- */

std::vector<Components::Link> Components::find_links() const
{
  std::vector<Link> links;

  auto unique = [&links]() {
    auto key = [](const Link &l) {
      return std::make_tuple(l.own.id, l.far.id);
    };
    std::sort(links.begin(), links.end(), [&](const Link &a, const Link &b) {
      return key(a) < key(b);
    });
    links.erase(std::unique(links.begin(), links.end(),
                            [&](const Link &a, const Link &b) {
                              return key(a) == key(b);
                            }),
                links.end());
  };

  for (const Edge &e : crossing) {
    const Node &own = node[std::min(e.i, e.j)];
    const Node &far = node[std::max(e.i, e.j)];
    if (own.id > 0 && far.id > 0 && own.id != far.id) links.push_back({own, far, own});
  }
  unique();

  std::vector<Link> mirror;
  std::vector<int> rank;
  for (const Link &l : links) {
    mirror.push_back({l.far, l.own, l.far});
    rank.push_back(l.far.rank);
  }
  mirror = deliver(world, mirror, rank);
  links.insert(links.end(), mirror.begin(), mirror.end());
  unique();
  return links;
}

/* ----------------------------------------------------------------------
   Called by the first rank of a group of span ranks (fewer at the end) with
   the links that leave the first half of the group.  Returns what the own end
   of each belongs to in the end.
------------------------------------------------------------------------- */

std::vector<Components::Node> Components::merge(std::vector<Link> links, int span)
{
  // the second half's links

  const size_t nmine = links.size();
  const int second = me + span / 2;
  if (span > 1) nrounds++;
  const bool paired = span > 1 && second < nprocs;
  if (paired) {
    MPI_Status status;
    int n;
    MPI_Probe(second, LINKS, world, &status);
    MPI_Get_count(&status, link_type, &n);
    links.resize(nmine + n + 1);
    MPI_Recv(&links[nmine], n, link_type, second, LINKS, world, MPI_STATUS_IGNORE);
    links.pop_back();
  }

  // components of this group that any link or label names, by ID: a far end is
  // among them if it is inside the group, since a link is known on both sides

  std::vector<Node> name;
  for (const Link &l : links) {
    name.push_back(l.own);
    name.push_back(l.label);
  }
  auto lower = [](const Node &a, const Node &b) {
    return a.id < b.id;
  };
  std::sort(name.begin(), name.end(), lower);
  name.erase(std::unique(name.begin(), name.end(),
                         [](const Node &a, const Node &b) {
                           return a.id == b.id;
                         }),
             name.end());
  auto index = [&](const Node &wanted) {
    const auto it = std::lower_bound(name.begin(), name.end(), wanted, lower);
    return (it == name.end() || it->id != wanted.id) ? -1 : static_cast<int>(it - name.begin());
  };

  DisjointSets group;
  group.reset(name.size());
  std::vector<int> own(links.size());
  std::vector<size_t> leaving;
  for (size_t n = 0; n < links.size(); n++) {
    own[n] = index(links[n].own);
    group.unite(own[n], index(links[n].label));
    const int far = index(links[n].far);
    if (far >= 0)
      group.unite(own[n], far);
    else
      leaving.push_back(n);
  }

  // whoever leads the group that this one is part of knows the rest

  if (span < nprocs) {
    std::vector<Link> out;
    for (const size_t n : leaving) {
      out.push_back(links[n]);
      out.back().label = name[group.find(own[n])];
    }
    std::vector<Node> label(out.size() + 1);
    if (me % (2 * span) == 0)
      label = merge(out, 2 * span);
    else {
      const int first = me - span;
      const int nout = out.size();
      out.resize(nout + 1);
      MPI_Send(out.data(), nout, link_type, first, LINKS, world);
      MPI_Recv(label.data(), nout, node_type, first, LABELS, world, MPI_STATUS_IGNORE);
      nrounds++;
    }
    for (size_t n = 0; n < leaving.size(); n++) name[group.find(own[leaving[n]])] = label[n];
  }

  std::vector<Node> label(links.size() + 1);
  for (size_t n = 0; n < links.size(); n++) label[n] = name[group.find(own[n])];
  if (paired) MPI_Send(&label[nmine], links.size() - nmine, node_type, second, LABELS, world);
  label.resize(nmine);
  return label;
}

/* ---------------------------------------------------------------------- */

double Components::memory_usage() const
{
  return (double) nowned * sizeof(int) + (double) node.capacity() * sizeof(Node) +
      (double) crossing.capacity() * sizeof(Edge);
}
