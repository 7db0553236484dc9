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

  void start(int n);    // n particles, of which none touches anything

  bool has(int i) const { return slots[i] != NONE; }
  const Record &of(int i) const { return has(i) ? records[slots[i]] : NOTHING; }
  Record &at(int i)    // valid until another particle begins
  {
    return has(i) ? records[slots[i]] : begin(i);
  }

  static constexpr std::size_t BYTES = sizeof(int);    // of every particle
  std::size_t bytes() const;

 private:
  static constexpr int NONE = -1;
  static const Record NOTHING;
  std::vector<int> slots, owners;    // by particle: its record; by record: its particle
  std::vector<Record> records;

  Record &begin(int i);    // out of line: sweeps are compiled for several kinds of machines
};

}    // namespace HVI

#endif
