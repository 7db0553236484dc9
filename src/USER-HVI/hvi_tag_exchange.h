/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_TAG_EXCHANGE_H
#define LMP_HVI_TAG_EXCHANGE_H

#include "pointers.h"

#include <cstring>
#include <type_traits>
#include <vector>

namespace LAMMPS_NS {

/* ----------------------------------------------------------------------
   Rows of numbers of particles, brought to ranks that ask for them by ID, wherever their owners are, and back:
   nodes to elements, forces to nodes.  No ghosts are needed, so no cutoff need reach across an element.

     connect()   after each exchange of particles: which ranks own what this one wants
     gather()    from owners to the slots, in the order of the IDs wanted; one particle may have several
     scatter()   from slots to owners

   A row is what pack(n) returns: plain data, of numbers of eight bytes.  pack(n) and unpack(n, row) get the index of
   an owned particle on the owner's side, that of a slot on the other; all of them are called in the same order in
   every run on the same ranks.
------------------------------------------------------------------------- */

class HVITagExchange : protected Pointers {
 public:
  HVITagExchange(class LAMMPS *lmp) : Pointers(lmp) {}

  // collective; of particles of those types of which types says that.  Returns an ID that none of
  // these has, the same on all ranks; 0: all are there

  tagint connect(const std::vector<tagint> &wanted, const std::vector<char> &types, bool that);

  // collective: slots of another exchange that are kept (not 0), with their numbers there

  void select(const HVITagExchange &all, const std::vector<double> &kept);

  int size() const { return nslots; }

  // index on this rank; -1: none.  A map by array is not asked beyond its end.

  int local(tagint id) const;

  template <class Pack, class Unpack> void gather(const Pack &pack, const Unpack &unpack)
  {
    run(owned, slots, pack, unpack);
  }
  template <class Pack> auto gather(const Pack &pack)
  {
    std::vector<std::decay_t<decltype(pack(0))>> rows(nslots);
    gather(pack, [&rows](int k, const auto &row) {
      rows[k] = row;
    });
    return rows;
  }
  template <class Pack, class Unpack> void scatter(const Pack &pack, const Unpack &unpack)
  {
    run(slots, owned, pack, unpack);
  }
  template <class Row, class Unpack>
  void scatter(const std::vector<Row> &rows, const Unpack &unpack)
  {
    run(
        slots, owned,
        [&rows](int k) {
          return rows[k];
        },
        unpack);
  }
  double memory_usage() const;

 private:
  // particles or slots that take part: here, on this rank itself, paired; there, by rank, from begin[k] on those
  // of ranks[k]

  struct Side {
    std::vector<int> here, there, ranks, begin = {0};
    void close(int rank);    // all since the last one are of this rank
  };
  Side owned, slots;
  int nslots = 0;
  std::vector<double> sent, received;
  std::vector<MPI_Request> requests;

  std::vector<tagint> alltoall(const std::vector<std::vector<tagint>> &out, std::vector<int> &from);
  void start(int width, const Side &from, const Side &to);
  void finish();

  template <class Pack, class Unpack>
  void run(const Side &from, const Side &to, const Pack &pack, const Unpack &unpack)
  {
    using Row = std::decay_t<decltype(pack(0))>;
    static constexpr int WIDTH =
        sizeof(Row) / sizeof(double);    // NOLINT(bugprone-sizeof-expression): 1 of a number
    static_assert(std::is_trivially_copyable<Row>::value && WIDTH * sizeof(double) == sizeof(Row),
                  "a row is plain data of numbers of eight bytes");
    sent.resize(from.there.size() * WIDTH);
    received.resize(to.there.size() * WIDTH);
    for (std::size_t k = 0; k < from.there.size(); k++) {
      const Row row = pack(from.there[k]);
      memcpy(&sent[k * WIDTH], &row, sizeof(Row));
    }
    start(WIDTH, from, to);
    for (std::size_t k = 0; k < from.here.size(); k++) unpack(to.here[k], pack(from.here[k]));
    finish();
    for (std::size_t k = 0; k < to.there.size(); k++) {
      Row row;
      memcpy(&row, &received[k * WIDTH], sizeof(Row));
      unpack(to.there[k], row);
    }
  }
};

}    // namespace LAMMPS_NS

#endif
