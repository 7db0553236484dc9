/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_SPH_MESSAGE_H
#define LMP_HVI_SPH_MESSAGE_H

#include "hvi_sph_touching.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace HVI {

/* ----------------------------------------------------------------------
   What ranks tell each other of particles at once: the first numbers of each record, of up to MOST arrays; after these,
   of what touches, how many particles have a record, which of those in the message, and its numbers.  index(k) is the
   record of the k-th particle in the message.
------------------------------------------------------------------------- */

class SphMessage {
 public:
  template <class Record> SphMessage &with(Record *records, int number = Record::SENT)
  {
    static_assert(sizeof(Record) % sizeof(double) == 0, "records are numbers");
    if (records)
      parts[nparts++] = {(double *) records, (int) (sizeof(Record) / sizeof(double)), number};
    return *this;
  }
  SphMessage &with_sums(SphTouching *all) { return with_some(all, 0, SphGradV::SENT); }
  SphMessage &with_pushes(SphTouching *all)
  {
    return with_some(all, sizeof(SphGradV) / sizeof(double), SphPush::SENT);
  }

  // doubles per particle, at most

  static constexpr int SUMS = 2 + SphGradV::SENT, PUSHES = 2 + SphPush::SENT;
  int size() const
  {
    int total = touching ? some + 2 : 0;
    for (int a = 0; a < nparts; a++) total += parts[a].number;
    return total;
  }

  template <class Index> int pack(int n, const Index &index, double *buf) const
  {
    double *to = buf;
    for (int a = 0; a < nparts; a++)
      for (int k = 0; k < n; k++) to = std::copy_n(parts[a].of(index(k)), parts[a].number, to);
    if (!touching || n == 0) return to - buf;
    double &have = *to++;
    have = 0.0;
    for (int k = 0; k < n; k++) {
      if (!touching->has(index(k))) continue;
      have += 1.0;
      *to++ = k;
      to = std::copy_n(of(touching->of(index(k))), some, to);
    }
    return to - buf;
  }

  // put(number of here, number that came)

  template <class Index, class Put>
  void unpack(int n, const Index &index, const double *from, const Put &put) const
  {
    const auto take = [&](double *to, int number) {
      for (int l = 0; l < number; l++) put(to[l], *from++);
    };
    for (int a = 0; a < nparts; a++)
      for (int k = 0; k < n; k++) take(parts[a].of(index(k)), parts[a].number);
    if (!touching || n == 0) return;
    for (int have = (int) *from++; have > 0; have--) {
      const int k = (int) *from++;
      take(of(touching->at(index(k))), some);
    }
  }

 private:
  static constexpr int MOST = 3;
  struct Part {
    double *first;
    int stride, number;
    double *of(int i) const { return first + i * (std::ptrdiff_t) stride; }
  };
  std::array<Part, MOST> parts;
  int nparts = 0;
  SphTouching *touching = nullptr;
  int first = 0, some = 0;    // of its records: what is sent

  double *of(SphTouching::Record &record) const { return (double *) &record + first; }
  const double *of(const SphTouching::Record &record) const
  {
    return (const double *) &record + first;
  }
  SphMessage &with_some(SphTouching *all, int from, int number)
  {
    touching = all;
    first = from;
    some = number;
    return *this;
  }
};

}    // namespace HVI

#endif
