/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_TAG_EXCHANGE_H
#define LMP_HVI_TAG_EXCHANGE_H

#include "pointers.h"

#include <functional>
#include <vector>

namespace LAMMPS_NS {

/* ----------------------------------------------------------------------
   Numbers of particles brought to ranks that ask for them by ID, wherever their owners are, and back:
   nodes to elements, forces to nodes.  No ghosts are needed, so no cutoff need reach across an element.

     connect()   after each exchange of particles: who owns what this rank wants
     gather()    from owners to the slots, in the order of the IDs wanted; one particle may have several
     scatter()   from slots to owners

   pack(n, buf) and unpack(n, buf) get the index of an owned particle on the owner's side, that of a slot on
   the other; all of them are called in the same order in every run on the same ranks.
------------------------------------------------------------------------- */

class HVITagExchange : protected Pointers {
 public:
  HVITagExchange(class LAMMPS *lmp) : Pointers(lmp) {}

  // collective; may_be: whether an owned particle may be wanted by somebody.  Returns an ID that nobody
  // has, the same on all ranks; 0: all are there

  tagint connect(const std::vector<tagint> &wanted, const std::function<bool(int)> &may_be);

  int size() const { return nslots; }

  // index on this rank; -1: none.  A map by array is not asked beyond its end.

  int local(tagint id) const;

  template <class Pack, class Unpack> void gather(int width, const Pack &pack, const Unpack &unpack)
  {
    run(width, owned, slots, pack, unpack);
  }
  template <class Pack, class Unpack>
  void scatter(int width, const Pack &pack, const Unpack &unpack)
  {
    run(width, slots, owned, pack, unpack);
  }
  double memory_usage() const;

 private:
  // who takes part, by rank; here: on this rank itself, paired

  struct Side {
    std::vector<int> here, ranks, begin, there;    // there: from begin[k] on those of ranks[k]
  };
  Side owned, slots;
  int nslots = 0;
  std::vector<double> sent, received;

  std::vector<tagint> alltoall(const std::vector<std::vector<tagint>> &out, std::vector<int> &from);
  void start(int width, const Side &from, const Side &to);
  void finish();
  std::vector<MPI_Request> requests;

  template <class Pack, class Unpack>
  void run(int width, const Side &from, const Side &to, const Pack &pack, const Unpack &unpack)
  {
    if (!from.there.empty() || !to.there.empty()) {
      sent.resize(from.there.size() * width);
      received.resize(to.there.size() * width);
      for (std::size_t k = 0; k < from.there.size(); k++) pack(from.there[k], &sent[k * width]);
      start(width, from, to);
    }
    double buf[MAXWIDTH];
    for (std::size_t k = 0; k < from.here.size(); k++) {
      pack(from.here[k], buf);
      unpack(to.here[k], buf);
    }
    if (!from.there.empty() || !to.there.empty()) {
      finish();
      for (std::size_t k = 0; k < to.there.size(); k++) unpack(to.there[k], &received[k * width]);
    }
  }

 public:
  static constexpr int MAXWIDTH = 64;
};

}    // namespace LAMMPS_NS

#endif
