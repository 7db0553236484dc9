/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_CLOSE_H
#define LMP_HVI_CLOSE_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace HVI {

/* ----------------------------------------------------------------------
   Pairs of points that are near each other now, for what asks so seldom that a list with a skin would be made
   each time.  Points are sorted by cells as wide as the distance, by z, y, x; of the cells around one half is
   looked at, in five rows along x, which lie together.  No array of cells: the box may be as large as debris flies.
------------------------------------------------------------------------- */

class ClosePairs {
 public:
  void clear() { points.clear(); }
  void add(int index, const double *x) { points.push_back({0, index, {x[0], x[1], x[2]}}); }

  // work(i, j, square of the distance) for all pairs not farther apart than the distance, each once

  template <class Work> void each(double distance, const Work &work);

  double bytes() const { return (double) points.capacity() * sizeof(Point); }

 private:
  struct Point {
    std::int64_t cell;
    int index;
    std::array<double, 3> x;
  };
  std::vector<Point> points;

  // numbers of cells along x, y, z in one number: 1 to MOST, which is also for what is beyond, so that near points
  // are in the same cell or in adjacent ones wherever they are; what is not a number is in the first

  static constexpr int BITS = 20;
  static constexpr double MOST = (1 << BITS) - 2;
  static std::int64_t along(double x) { return std::min(MOST, std::max(1.0, 1.0 + std::floor(x))); }
  static std::int64_t row(std::int64_t y, std::int64_t z)
  {
    static constexpr std::int64_t CELLS = 1 << BITS;
    return CELLS * (y + CELLS * z);
  }
};

template <class Work> void ClosePairs::each(double distance, const Work &work)
{
  const double most = distance * distance;
  const double by = (1.0 - 1.0e-9) / distance;    // by rounding none may be two cells further
  std::array<double, 3> lo = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
  for (const Point &one : points)
    for (int k = 0; k < 3; k++) lo[k] = std::min(lo[k], one.x[k]);
  for (Point &one : points) {
    std::int64_t cell[3];
    for (int k = 0; k < 3; k++) cell[k] = along((one.x[k] - lo[k]) * by);
    one.cell = cell[0] + row(cell[1], cell[2]);
  }
  std::sort(points.begin(), points.end(), [](const Point &a, const Point &b) {
    return a.cell != b.cell ? a.cell < b.cell : a.index < b.index;
  });

  const std::size_t n = points.size();
  const std::int64_t rows[4] = {row(1, 0), row(-1, 1), row(0, 1), row(1, 1)};
  std::size_t from[4] = {}, to[4] = {}, next = 0;
  const auto look = [&](const Point &one, std::size_t first, std::size_t last) {
    for (std::size_t m = first; m < last; m++) {
      const Point &other = points[m];
      const double d[3] = {one.x[0] - other.x[0], one.x[1] - other.x[1], one.x[2] - other.x[2]};
      const double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
      if (square <= most) work(one.index, other.index, square);
    }
  };
  for (std::size_t begin = 0, end = 0; begin < n; begin = end) {
    const std::int64_t cell = points[begin].cell;
    while (end < n && points[end].cell == cell) end++;
    next = std::max(next, end);
    while (next < n && points[next].cell <= cell + 1) next++;
    for (int k = 0; k < 4; k++) {
      while (from[k] < n && points[from[k]].cell < cell + rows[k] - 1) from[k]++;
      to[k] = std::max(to[k], from[k]);
      while (to[k] < n && points[to[k]].cell <= cell + rows[k] + 1) to[k]++;
    }
    for (std::size_t m = begin; m < end; m++) {
      look(points[m], m + 1, next);
      for (int k = 0; k < 4; k++) look(points[m], from[k], to[k]);
    }
  }
}

}    // namespace HVI

#endif
