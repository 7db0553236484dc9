/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "hvi_rows.h"

#include "hvi_vector.h"

#include <algorithm>
#include <limits>

using namespace HVI;

static constexpr std::size_t PAGE = 1 << 18;

void NeighborRows::start(const RelativeMotion &motion, const Points &those)
{
  points = those;
  const int n = motion.cells();
  made.assign(n, 0);
  number.assign(points.owned, 0);
  first.assign(points.owned, nullptr);
  ghosts = points.all > points.owned;
  page = 0;
  for (std::vector<int> &one : pages) one.clear();

  // sort by cells

  first_of.assign(n + 1, 0);
  ghosts_of.assign(n, 0);
  for (int i = 0; i < points.all; i++) first_of[motion.cell_of(i) + 1]++;
  for (int c = 0; c < n; c++) first_of[c + 1] += first_of[c];
  std::vector<int> next(first_of.begin(), first_of.end() - 1);
  order.resize(points.all);
  types.resize(points.all);
  for (std::vector<double> &one : place) one.resize(points.all + LANES);
  static constexpr double INF = std::numeric_limits<double>::infinity();
  boxes.assign(n, {{INF, INF, INF}, {-INF, -INF, -INF}});
  for (int i = 0; i < points.all; i++) {
    const int c = motion.cell_of(i), at = next[c]++;
    order[at] = i;
    types[at] = points.type[i];
    for (int k = 0; k < 3; k++) {
      const double x = place[k][at] = points.x[i][k];
      boxes[c].lo[k] = std::min(boxes[c].lo[k], x);
      boxes[c].hi[k] = std::max(boxes[c].hi[k], x);
    }
    if (i < points.owned) ghosts_of[c] = at + 1;
  }
  for (int c = 0; c < n; c++) ghosts_of[c] = std::max(ghosts_of[c], first_of[c]);

  after_first.assign(n + 1, 0);
  before_first.assign(n + 1, 0);
  motion.each_adjacent([&](int a, int b) {
    after_first[a + 1]++;
    before_first[b + 1]++;
  });
  for (int c = 0; c < n; c++) {
    after_first[c + 1] += after_first[c];
    before_first[c + 1] += before_first[c];
  }
  after.resize(after_first[n]);
  before.resize(before_first[n]);
  std::vector<int> a_next(after_first.begin(), after_first.end()),
      b_next(before_first.begin(), before_first.end());
  motion.each_adjacent([&](int a, int b) {
    after[a_next[a]++] = b;
    before[b_next[b]++] = a;
  });
}

// whether a point of the cell can be

bool NeighborRows::is_near(const double *at, int cell) const
{
  const Box &box = boxes[cell];
  double square = 0.0;
  for (int k = 0; k < 3; k++) {
    const double gap = std::max({box.lo[k] - at[k], at[k] - box.hi[k], 0.0});
    square += gap * gap;
  }
  return square <= points.most;
}

/* ----------------------------------------------------------------------
   of the points from ... to in order those near enough to be neighbors of i, and wanted
------------------------------------------------------------------------- */

template <class Wanted>
inline void NeighborRows::look(int type, const double *at, int from, int to, const Wanted &wanted)
{
  const double *const cutsq = points.cutsq[type];
  const Vec most = Vec{} + points.most;
  const double *const x = place[0].data(), *const y = place[1].data(), *const z = place[2].data();
  const auto squared = [](const double *of, double center) {
    Vec d;
    __builtin_memcpy(&d, of, sizeof(d));
    d -= center;
    return d * d;
  };
  if (row.size() < length + (to - from)) row.resize(2 * (length + to - from));
  int *const found = row.data();
  std::size_t n = length;
  for (int m = from; m < to; m += LANES) {
    const Vec square = squared(x + m, at[0]) + squared(y + m, at[1]) + squared(z + m, at[2]);
    if (!any(square <= most)) continue;
    const int lanes = std::min(+LANES, to - m);
    for (int lane = 0; lane < lanes; lane++) {
      found[n] = order[m + lane];
      n += square[lane] <= cutsq[types[m + lane]] && wanted(m + lane);
    }
  }
  length = n;
}

int NeighborRows::make(int cell)
{
  if (made[cell]) return -1;
  made[cell] = 1;
  const auto any_point = [](int) {
    return true;
  };
  for (int m = first_of[cell]; m < ghosts_of[cell]; m++) {
    const int i = order[m];
    const double at[3] = {place[0][m], place[1][m], place[2][m]};
    const int type = types[m];
    length = 0;
    look(type, at, m + 1, ghosts_of[cell], any_point);
    for (int k = after_first[cell]; k < after_first[cell + 1]; k++)
      if (is_near(at, after[k])) look(type, at, first_of[after[k]], ghosts_of[after[k]], any_point);

    if (ghosts) {
      const auto beyond = [&](int ghost) {
        for (int k = 2; k >= 0; k--)
          if (place[k][ghost] != at[k]) return place[k][ghost] > at[k];
        return true;
      };
      const auto all = [&](int c) {
        if (ghosts_of[c] == first_of[c + 1] || !is_near(at, c)) return;
        if (points.newton)
          look(type, at, ghosts_of[c], first_of[c + 1], beyond);
        else
          look(type, at, ghosts_of[c], first_of[c + 1], any_point);
      };
      all(cell);
      for (int k = after_first[cell]; k < after_first[cell + 1]; k++) all(after[k]);
      for (int k = before_first[cell]; k < before_first[cell + 1]; k++) all(before[k]);
    }
    number[i] = length;
    if (number[i] > points.longest) return i;
    first[i] = keep();
  }
  return -1;
}

// rows stay where they are until the next start()

int *NeighborRows::keep()
{
  while (page < pages.size() && pages[page].size() + length > pages[page].capacity()) page++;
  if (page == pages.size()) {
    pages.emplace_back();
    pages.back().reserve(std::max(PAGE, length));
  }
  std::vector<int> &here = pages[page];
  here.insert(here.end(), row.begin(), row.begin() + length);
  return here.data() + here.size() - length;
}

double NeighborRows::bytes() const
{
  double ints = 2.0 * order.capacity() + first_of.capacity() + ghosts_of.capacity() +
      number.capacity() + after.capacity() + before.capacity() + after_first.capacity() +
      before_first.capacity();
  for (const std::vector<int> &one : pages) ints += one.capacity();
  return ints * sizeof(int) + first.capacity() * sizeof(int *) + made.capacity() +
      boxes.capacity() * sizeof(Box) + 3.0 * place[0].capacity() * sizeof(double);
}
