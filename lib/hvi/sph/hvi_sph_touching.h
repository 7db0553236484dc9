/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_SPH_TOUCHING_H
#define LMP_HVI_SPH_TOUCHING_H

#include "hvi_sph_records.h"

#include <cstddef>
#include <vector>

namespace HVI {

/* ----------------------------------------------------------------------
   What touches particles without hanging together with them: the sums of a first sweep over it, and with what they
   push it in a second one.  Few particles touch anything, so only these have a record: it begins with zeros
   where a pair, or another rank, first adds to it.
------------------------------------------------------------------------- */

class SphTouching {
 public:
  struct Record {
    SphGradV sums;
    SphPush push;
  };

  void start(int n)    // n particles, of which none touches anything
  {
    for (const int i : owners) slots[i] = NONE;
    owners.clear();
    records.clear();
    if (n > (int) slots.size()) slots.resize(n, NONE);
  }

  bool has(int i) const { return slots[i] != NONE; }
  const Record &of(int i) const    // zeros if it has none
  {
    static const Record nothing = {};
    return has(i) ? records[slots[i]] : nothing;
  }
  Record &at(int i)    // valid until another particle gets its record
  {
    if (!has(i)) {
      slots[i] = records.size();
      records.push_back({});
      owners.push_back(i);
    }
    return records[slots[i]];
  }

  const std::vector<int> &particles() const { return owners; }
  static constexpr std::size_t BYTES = sizeof(int);    // of every particle
  std::size_t bytes() const
  {
    return slots.capacity() * BYTES + owners.capacity() * sizeof(int) +
        records.capacity() * sizeof(Record);
  }

 private:
  static constexpr int NONE = -1;
  std::vector<int> slots, owners;    // by particle: its record; by record: its particle
  std::vector<Record> records;
};

}    // namespace HVI

#endif
