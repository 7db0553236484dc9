/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_REAR_FACE_H
#define LMP_HVI_REAR_FACE_H

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace HVI {

/* ----------------------------------------------------------------------
   How far a body reaches along an axis, in square columns across it.  What is farther back than that by half a column's
   width, in its column and in those around it, is before the rear face of the body, however far it has bulged.
   Where the body has no matter there is no face.
------------------------------------------------------------------------- */

class RearFace {
 public:
  static constexpr double NONE = -std::numeric_limits<double>::infinity();

  // of a body between lo and hi: two coordinates across the axis; columns are cell wide, or as many as MOST allows, and
  // begin at the anchor, so that a body between mirror planes has those of the whole

  void start(const double *lo, const double *hi, double cell_in, const double *anchor)
  {
    cell = cell_in;
    for (int k = 0; k < 2; k++) number[k] = 0;
    if (lo[0] <= hi[0] && lo[1] <= hi[1] && cell > 0.0) {
      const double wide[2] = {hi[0] - lo[0], hi[1] - lo[1]};
      width =
          std::max({cell, std::sqrt(wide[0] * wide[1] / MOST), std::max(wide[0], wide[1]) / MOST});
      for (int k = 0; k < 2; k++) {
        origin[k] = anchor[k] + width * std::floor((lo[k] - anchor[k]) / width);
        number[k] = 1 + (int) ((hi[k] - origin[k]) / width);
      }
    }
    heights.assign((std::size_t) number[0] * number[1], NONE);
  }

  // matter that covers a square, half of it to all sides of a, b

  void add(double a, double b, double height, double half)
  {
    const std::ptrdiff_t from[2] = {line(a - half, 0), line(b - half, 1)},
                         to[2] = {line(a + half, 0), line(b + half, 1)};
    for (std::ptrdiff_t p = std::max<std::ptrdiff_t>(0, from[0]); p <= std::min(to[0], last(0));
         p++)
      for (std::ptrdiff_t q = std::max<std::ptrdiff_t>(0, from[1]); q <= std::min(to[1], last(1));
           q++)
        heights[p * number[1] + q] = std::max(heights[p * number[1] + q], height);
  }
  bool hides(double a, double b, double height) const
  {
    const std::ptrdiff_t p = line(a, 0), q = line(b, 1);
    if (p < 0 || q < 0 || p > last(0) || q > last(1)) return false;
    for (std::ptrdiff_t m = std::max<std::ptrdiff_t>(0, p - 1); m <= std::min(p + 1, last(0)); m++)
      for (std::ptrdiff_t n = std::max<std::ptrdiff_t>(0, q - 1); n <= std::min(q + 1, last(1));
           n++)
        if (!(height < heights[m * number[1] + n] - 0.5 * cell)) return false;
    return true;
  }
  std::vector<double> &columns() { return heights; }    // the highest of all ranks is to be put in

 private:
  static constexpr double MOST = 1.0e6;
  double origin[2] = {0.0, 0.0}, width = 1.0, cell = 1.0;
  int number[2] = {0, 0};
  std::vector<double> heights;

  std::ptrdiff_t last(int k) const { return (std::ptrdiff_t) number[k] - 1; }
  std::ptrdiff_t line(double x,
                      int k) const    // -1: before the first; beyond the last: some number above it
  {
    const double p = std::floor((x - origin[k]) / width);
    return p >= 0.0 ? (std::ptrdiff_t) std::min(p, (double) number[k]) : -1;
  }
};

}    // namespace HVI

#endif
