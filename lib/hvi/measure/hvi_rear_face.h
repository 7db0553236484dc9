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
   How far a body reaches along an axis, in square columns across it.  What is not so far in a column of the body
   is before its rear face, however far the body has bulged; where it has no matter there is no face.
------------------------------------------------------------------------- */

class RearFace {
 public:
  static constexpr double NONE = -std::numeric_limits<double>::infinity();

  // of a body between lo and hi: two coordinates across the axis; columns are cell wide, or as many as MOST allows

  void start(const double *lo, const double *hi, double cell)
  {
    for (int k = 0; k < 2; k++) {
      origin[k] = lo[k];
      number[k] = 0;
    }
    if (lo[0] <= hi[0] && lo[1] <= hi[1] && cell > 0.0) {
      const double area = (hi[0] - lo[0]) * (hi[1] - lo[1]);
      width =
          std::max({cell, std::sqrt(area / MOST), std::max(hi[0] - lo[0], hi[1] - lo[1]) / MOST});
      for (int k = 0; k < 2; k++) number[k] = 1 + (int) ((hi[k] - lo[k]) / width);
    }
    heights.assign((std::size_t) number[0] * number[1], NONE);
  }
  void add(double a, double b, double height)
  {
    const std::ptrdiff_t m = column(a, b);
    if (m >= 0) heights[m] = std::max(heights[m], height);
  }
  bool hides(double a, double b, double height) const
  {
    const std::ptrdiff_t m = column(a, b);
    return m >= 0 && height < heights[m];
  }
  std::vector<double> &columns() { return heights; }    // the highest of all ranks is to be put in

 private:
  static constexpr double MOST = 1.0e6;
  double origin[2], width;
  int number[2];
  std::vector<double> heights;

  std::ptrdiff_t column(double a, double b) const
  {
    const double p = (a - origin[0]) / width, q = (b - origin[1]) / width;
    if (!(p >= 0.0 && q >= 0.0 && p < number[0] && q < number[1])) return -1;
    return (std::ptrdiff_t) p * number[1] + (std::ptrdiff_t) q;
  }
};

}    // namespace HVI

#endif
