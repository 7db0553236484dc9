/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_CELLS_H
#define LMP_HVI_CELLS_H

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace HVI {

/* ----------------------------------------------------------------------
   Points sorted into cells, so that those within a distance of a place are
   found in a time that does not grow with their number.  Each is put down in
   all cells that it reaches.  Coordinates are fractions of the box, the
   distance is given in them for each direction; a fraction may lie outside 0
   to 1 and, where the box is periodic, counts modulo 1.
------------------------------------------------------------------------- */

class Cells {
 public:
  Cells(const double *distance, const bool *periodic)
  {
    for (int k = 0; k < 3; k++) {
      reach[k] = distance[k] * (1.0 + 1.0e-6);    // rounding of coordinates
      number[k] = periodic[k] ? std::max(1.0, std::floor(std::min(1.0 / reach[k], MOST))) : 0.0;
      scale[k] = periodic[k] ? number[k] : 1.0 / reach[k];
    }
  }

  void add(int index, const double *s)
  {
    std::int64_t lo[3], hi[3];
    for (int k = 0; k < 3; k++) {
      lo[k] = cell(k, s[k] - reach[k]);
      hi[k] = cell(k, s[k] + reach[k]);
    }
    for (std::int64_t i = lo[0]; i <= hi[0]; i++)
      for (std::int64_t j = lo[1]; j <= hi[1]; j++)
        for (std::int64_t k = lo[2]; k <= hi[2]; k++) entries.emplace_back(key(i, j, k), index);
  }

  // after the last add(): cells may share a key, or be one across the box, but a point is in
  // none of them twice

  void sort()
  {
    std::sort(entries.begin(), entries.end());
    entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
    for (size_t n = 0; n < entries.size(); n++)
      if (n == 0 || entries[n].first != entries[n - 1].first) first[entries[n].first] = n;
  }

  // work on all points that may be within the distance of s, in ascending order of their index

  template <class Work> void near(const double *s, Work work) const
  {
    const std::uint64_t wanted = key(cell(0, s[0]), cell(1, s[1]), cell(2, s[2]));
    const auto it = first.find(wanted);
    if (it == first.end()) return;
    for (size_t n = it->second; n < entries.size() && entries[n].first == wanted; n++)
      work(entries[n].second);
  }

 private:
  static constexpr double MOST = 1.0e9;    // cells in a direction, so that numbers stay exact
  double reach[3], scale[3];
  double number[3];    // of cells in a direction, 0: as many as there are points
  std::vector<std::pair<std::uint64_t, int>> entries;    // cell, point
  std::unordered_map<std::uint64_t, size_t> first;

  std::int64_t cell(int k, double s) const
  {
    const double u = s * scale[k];
    if (!(u > -MOST)) return -static_cast<std::int64_t>(MOST);    // also what is not a number
    return static_cast<std::int64_t>(std::floor(std::min(u, MOST)));
  }

  std::uint64_t key(std::int64_t i, std::int64_t j, std::int64_t k) const
  {
    const std::int64_t c[3] = {i, j, k};
    std::uint64_t mixed = 0;
    for (int d = 0; d < 3; d++) {
      std::int64_t one = c[d];
      if (number[d] > 0.0) {
        const auto n = static_cast<std::int64_t>(number[d]);
        one = (one % n + n) % n;
      }
      mixed = (mixed ^ static_cast<std::uint64_t>(one)) * 0xFF51AFD7ED558CCDull;
      mixed ^= mixed >> 32;
    }
    return mixed;
  }
};

}    // namespace HVI

#endif
