/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "hvi_tag_exchange.h"

#include "atom.h"
#include "comm.h"

#include <algorithm>
#include <numeric>
#include <utility>

using namespace LAMMPS_NS;

/* ----------------------------------------------------------------------
   what each rank has for each other one; from: where those of a rank begin in what comes
------------------------------------------------------------------------- */

std::vector<tagint> HVITagExchange::alltoall(const std::vector<std::vector<tagint>> &out,
                                             std::vector<int> &from)
{
  const int nprocs = comm->nprocs;
  std::vector<int> nout(nprocs), nin(nprocs), to(nprocs + 1, 0);
  for (int p = 0; p < nprocs; p++) {
    nout[p] = out[p].size();
    to[p + 1] = to[p] + nout[p];
  }
  MPI_Alltoall(nout.data(), 1, MPI_INT, nin.data(), 1, MPI_INT, world);
  from.assign(nprocs + 1, 0);
  std::partial_sum(nin.begin(), nin.end(), from.begin() + 1);
  std::vector<tagint> sends, takes(from[nprocs] + 1);    // never a null buffer
  sends.reserve(to[nprocs] + 1);
  for (const auto &one : out) sends.insert(sends.end(), one.begin(), one.end());
  sends.push_back(0);
  MPI_Alltoallv(sends.data(), nout.data(), to.data(), MPI_LMP_TAGINT, takes.data(), nin.data(),
                from.data(), MPI_LMP_TAGINT, world);
  return takes;
}

int HVITagExchange::local(tagint id) const
{
  if (id < 1 || (atom->map_style == Atom::MAP_ARRAY && id >= atom->get_map_maxarray())) return -1;
  return atom->map(id);
}

/* ----------------------------------------------------------------------
   A directory tells owners: the rank of an ID there is ID modulo ranks.  Owners say what they have, others
   what they look for.
------------------------------------------------------------------------- */

tagint HVITagExchange::connect(const std::vector<tagint> &wanted, const std::vector<char> &types,
                               bool that)
{
  const auto may_be = [&](int i) {
    return (types[atom->type[i]] != 0) == that;
  };
  const int nprocs = comm->nprocs, nlocal = atom->nlocal;
  owned = slots = Side();
  nslots = wanted.size();
  std::vector<int> far;    // slots whose particles are elsewhere
  for (int k = 0; k < nslots; k++) {
    const int i = local(wanted[k]);
    if (i >= 0 && i < nlocal && may_be(i)) {
      owned.here.push_back(i);
      slots.here.push_back(k);
    } else
      far.push_back(k);
  }
  if (nprocs == 1) return far.empty() ? 0 : wanted[far[0]];

  std::vector<std::vector<tagint>> out(nprocs);
  std::vector<int> from, asked_from;
  for (int i = 0; i < nlocal; i++)
    if (may_be(i)) out[atom->tag[i] % nprocs].push_back(atom->tag[i]);
  const std::vector<tagint> known = alltoall(out, from);
  std::vector<std::pair<tagint, int>> directory;
  directory.reserve(from[nprocs]);
  for (int p = 0; p < nprocs; p++)
    for (int k = from[p]; k < from[p + 1]; k++) directory.emplace_back(known[k], p);
  std::sort(directory.begin(), directory.end());

  for (auto &one : out) one.clear();
  for (const int k : far) out[wanted[k] % nprocs].push_back(wanted[k]);
  const std::vector<tagint> asked = alltoall(out, asked_from);
  std::vector<std::vector<tagint>> answer(nprocs);
  for (int p = 0; p < nprocs; p++)
    for (int k = asked_from[p]; k < asked_from[p + 1]; k++) {
      const auto found =
          std::lower_bound(directory.begin(), directory.end(), std::make_pair(asked[k], 0));
      const bool there = found != directory.end() && found->first == asked[k];
      answer[p].push_back(there ? found->second : -1);
    }
  const std::vector<tagint> owner = alltoall(answer, from);

  // answers come in the order of the questions

  tagint missing = 0;
  std::vector<int> next(from.begin(), from.end() - 1);
  std::vector<std::vector<int>> slots_of(nprocs);
  for (auto &one : out) one.clear();
  for (const int k : far) {
    const tagint p = owner[next[wanted[k] % nprocs]++];
    if (p < 0) {
      missing = std::max(missing, wanted[k]);
      continue;
    }
    out[p].push_back(wanted[k]);
    slots_of[p].push_back(k);
  }
  tagint anywhere;
  MPI_Allreduce(&missing, &anywhere, 1, MPI_LMP_TAGINT, MPI_MAX, world);
  if (anywhere) return anywhere;

  const std::vector<tagint> mine = alltoall(out, from);
  for (int p = 0; p < nprocs; p++) {
    slots.there.insert(slots.there.end(), slots_of[p].begin(), slots_of[p].end());
    slots.close(p);
    for (int k = from[p]; k < from[p + 1]; k++) owned.there.push_back(atom->map(mine[k]));
    owned.close(p);
  }
  return 0;
}

void HVITagExchange::Side::close(int rank)
{
  if (begin.back() == (int) there.size()) return;
  ranks.push_back(rank);
  begin.push_back(there.size());
}

/* ---------------------------------------------------------------------- */

void HVITagExchange::select(const HVITagExchange &all, const std::vector<double> &kept)
{
  owned = slots = Side();
  nslots = all.nslots;
  for (std::size_t k = 0; k < all.slots.here.size(); k++) {
    if (kept[all.slots.here[k]] == 0.0) continue;
    owned.here.push_back(all.owned.here[k]);
    slots.here.push_back(all.slots.here[k]);
  }
  sent.clear();
  for (const int k : all.slots.there) sent.push_back(kept[k]);
  received.resize(all.owned.there.size());
  start(1, all.slots, all.owned);
  finish();
  const auto take = [](const Side &from, const std::vector<double> &flags, Side &side) {
    for (std::size_t p = 0; p < from.ranks.size(); p++) {
      for (int k = from.begin[p]; k < from.begin[p + 1]; k++)
        if (flags[k] != 0.0) side.there.push_back(from.there[k]);
      side.close(from.ranks[p]);
    }
  };
  take(all.slots, sent, slots);
  take(all.owned, received, owned);
}

/* ---------------------------------------------------------------------- */

void HVITagExchange::start(int width, const Side &from, const Side &to)
{
  requests.resize(from.ranks.size() + to.ranks.size());
  MPI_Request *request = requests.data();
  for (std::size_t k = 0; k < to.ranks.size(); k++)
    MPI_Irecv(&received[to.begin[k] * width], (to.begin[k + 1] - to.begin[k]) * width, MPI_DOUBLE,
              to.ranks[k], 0, world, request++);
  for (std::size_t k = 0; k < from.ranks.size(); k++)
    MPI_Isend(&sent[from.begin[k] * width], (from.begin[k + 1] - from.begin[k]) * width, MPI_DOUBLE,
              from.ranks[k], 0, world, request++);
}

void HVITagExchange::finish()
{
  MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
}

double HVITagExchange::memory_usage() const
{
  const auto bytes = [](const Side &s) {
    return (s.here.capacity() + s.there.capacity()) * sizeof(int);
  };
  return bytes(owned) + bytes(slots) + (sent.capacity() + received.capacity()) * sizeof(double);
}
