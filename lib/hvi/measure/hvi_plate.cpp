/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */
#include "hvi_plate.h"

#include <algorithm>
#include <cmath>

using namespace HVI;

static constexpr double PI = 3.14159265358979323846;
static constexpr double MAXNODES = 4.0e6, MAXLINE = 1.0e5;
static constexpr double PIECE = 0.05;    // share of the far part's mass that makes a piece plate
static constexpr int FINE = 8;    // a cell at the edge of the hole is looked at in FINE^2 points

/* ----------------------------------------------------------------------
   some nodes more than needed on all sides; false if the spacing had to be larger
------------------------------------------------------------------------- */

bool Plate::lay_out(const double *lo, const double *hi, double spacing)
{
  const double width[2] = {hi[0] - lo[0], hi[1] - lo[1]};
  h = std::max(
      {spacing, std::sqrt(width[0] * width[1] / MAXNODES), width[0] / MAXLINE, width[1] / MAXLINE});
  for (int k = 0; k < 2; k++) {
    first[k] = (int) std::floor(lo[k] / h) - 3;
    n[k] = (int) std::ceil(hi[k] / h) + 4 - first[k];
  }
  areal.assign(n[0] * n[1], 0.0);
  return h == spacing;
}

/* ----------------------------------------------------------------------
   from the center, in spacings
------------------------------------------------------------------------- */

double Plate::distance(int i, int j) const
{
  return std::hypot(first[0] + i, first[1] + j);
}

/* ----------------------------------------------------------------------
   The intact plate: the outer half of the mass, by distance from the center.  Its
   mass per area is the median over nodes away from its edges.
------------------------------------------------------------------------- */

void Plate::find_intact()
{
  double total = 0.0;
  std::vector<double> ring(n[0] + n[1], 0.0);
  for (int i = 0; i < n[0]; i++)
    for (int j = 0; j < n[1]; j++) {
      ring[(int) distance(i, j)] += areal[index(i, j)];
      total += areal[index(i, j)];
    }
  far = ring.size();
  for (double sum = 0.0; sum < 0.5 * total && far > 0; sum += ring[far]) far--;

  // first guess: half of the mass there has more mass per area

  std::vector<double> values;
  total = 0.0;
  for (int i = 0; i < n[0]; i++)
    for (int j = 0; j < n[1]; j++)
      if (areal[index(i, j)] > 0.0 && distance(i, j) >= far) {
        values.push_back(areal[index(i, j)]);
        total += values.back();
      }
  intact = 0.0;
  if (values.empty()) return;
  std::sort(values.begin(), values.end(), [](double a, double b) {
    return a > b;
  });
  size_t v = 0;
  for (double sum = values[0]; sum < 0.5 * total && v + 1 < values.size(); sum += values[v]) v++;
  intact = values[v];

  std::vector<double> inner, all;
  for (int i = 1; i < n[0] - 1; i++)
    for (int j = 1; j < n[1] - 1; j++) {
      if (areal[index(i, j)] < 0.5 * intact || distance(i, j) < far) continue;
      double lowest = intact;
      for (int a = -1; a <= 1; a++)
        for (int b = -1; b <= 1; b++) lowest = std::min(lowest, areal[index(i + a, j + b)]);
      if (lowest >= 0.5 * intact) inner.push_back(areal[index(i, j)]);
      all.push_back(areal[index(i, j)]);
    }
  if (all.empty()) return;

  // a ring too narrow for that is nearly all edge: the upper quartile instead of the median

  const bool narrow = 4 * inner.size() < all.size();
  std::vector<double> &from = narrow ? all : inner;
  const auto middle = from.begin() + (narrow ? 3 * from.size() / 4 : from.size() / 2);
  std::nth_element(from.begin(), middle, from.end());
  intact = *middle;
}

/* ----------------------------------------------------------------------
   connected parts of the marked nodes, diagonals count: label 1 .. result, 0 elsewhere
------------------------------------------------------------------------- */

int Plate::find_components(const std::vector<char> &marked)
{
  int ncomponents = 0;
  std::vector<int> todo;
  label.assign(marked.size(), 0);
  for (size_t start = 0; start < marked.size(); start++) {
    if (!marked[start] || label[start]) continue;
    label[start] = ++ncomponents;
    todo.push_back(start);
    while (!todo.empty()) {
      const int i = todo.back() / n[1], j = todo.back() % n[1];
      todo.pop_back();
      for (int a = std::max(i - 1, 0); a <= std::min(i + 1, n[0] - 1); a++)
        for (int b = std::max(j - 1, 0); b <= std::min(j + 1, n[1] - 1); b++) {
          const int k = a * n[1] + b;
          if (!marked[k] || label[k]) continue;
          label[k] = ncomponents;
          todo.push_back(k);
        }
    }
  }
  return ncomponents;
}

/* ----------------------------------------------------------------------
   moves of a chess king to the next marked node
------------------------------------------------------------------------- */

std::vector<int> Plate::moves_from(const std::vector<char> &marked) const
{
  std::vector<int> moves(marked.size());
  for (size_t k = 0; k < marked.size(); k++) moves[k] = marked[k] ? 0 : n[0] + n[1];
  auto step = [&](int i, int j, int a, int b) {
    if (i + a < 0 || i + a >= n[0] || j + b < 0 || j + b >= n[1]) return;
    int &here = moves[i * n[1] + j];
    here = std::min(here, moves[(i + a) * n[1] + j + b] + 1);
  };
  for (int sign = -1; sign <= 1; sign += 2)
    for (int i = 0; i < n[0]; i++)
      for (int j = 0; j < n[1]; j++) {
        const int x = (sign < 0) ? i : n[0] - 1 - i, y = (sign < 0) ? j : n[1] - 1 - j;
        for (int b = -1; b <= 1; b++) step(x, y, sign, b);
        step(x, y, 0, sign);
      }
  return moves;
}

/* ----------------------------------------------------------------------
   Plate is what is filled and connected, in pieces that make up much of the far part.
   The hole is what the plate encloses around the center or, if there is plate, the
   largest elsewhere.  Openings less than 2 width + 1 nodes wide are closed, and this
   width is increased as long as the center is open to the rim.
------------------------------------------------------------------------- */

Plate::Found Plate::find_hole(double fill, bool mirrored)
{
  const double enough = fill * intact;
  const int nodes = areal.size();
  std::vector<char> marked(nodes);
  for (int k = 0; k < nodes; k++) marked[k] = areal[k] >= enough;
  std::vector<double> mass(find_components(marked) + 1, 0.0);
  double total = 0.0;
  for (int i = 0; i < n[0]; i++)
    for (int j = 0; j < n[1]; j++) {
      const int k = index(i, j);
      if (!marked[k] || distance(i, j) < far) continue;
      mass[label[k]] += areal[k];
      total += areal[k];
    }
  if (total == 0.0) return OPEN;
  for (int k = 0; k < nodes; k++)
    if (marked[k] && mass[label[k]] < PIECE * total) {
      marked[k] = 0;
      areal[k] = 0.0;    // a fragment must not shape the edge
    }
  const std::vector<int> gap = moves_from(marked);

  const int middle = index(-first[0], -first[1]);
  int width, pick;
  for (width = 1;; width += 1 + width / 4) {
    for (int k = 0; k < nodes; k++) marked[k] = gap[k] > width;
    std::vector<int> size(find_components(marked) + 1, 0);    // -1: touches the border
    for (int i = 0; i < n[0]; i++)
      for (int j = 0; j < n[1]; j++) {
        int &s = size[label[index(i, j)]];
        if (i == 0 || j == 0 || i == n[0] - 1 || j == n[1] - 1)
          s = -1;
        else if (s >= 0)
          s++;
      }
    size[0] = 0;    // what is not marked

    pick = label[middle];
    if (gap[middle] <= 1 && !mirrored)
      pick = std::max_element(size.begin(), size.end()) - size.begin();
    if (size[pick] > 0) break;
    if (gap[middle] <= width) return (gap[middle] > 1) ? OPEN : NO_HOLE;
  }

  for (int k = 0; k < nodes; k++) marked[k] = label[k] == pick;
  const std::vector<int> reach = moves_from(marked);
  for (int k = 0; k < nodes; k++) marked[k] = gap[k] > 0 && reach[k] <= width + width / 2;
  sample(marked, enough);
  return HOLE;
}

/* ----------------------------------------------------------------------
   small pieces of the hole: its edge is where the mass per area, linear between nodes,
   is as much as plate must have
------------------------------------------------------------------------- */

void Plate::sample(const std::vector<char> &hole, double enough)
{
  const double extent = std::sqrt(std::count(hole.begin(), hole.end(), 1));
  const int coarse = std::clamp((int) (512.0 / extent), 1, FINE);

  samples.clear();
  for (int i = 0; i < n[0] - 1; i++)
    for (int j = 0; j < n[1] - 1; j++) {
      const int k = i * n[1] + j;
      const int corners = hole[k] + hole[k + 1] + hole[k + n[1]] + hole[k + n[1] + 1];
      if (corners == 0) continue;
      const int m = (corners == 4) ? coarse : FINE;
      for (int a = 0; a < m; a++)
        for (int b = 0; b < m; b++) {
          const double u = (a + 0.5) / m, w = (b + 0.5) / m;
          const double here = (1.0 - u) * ((1.0 - w) * areal[k] + w * areal[k + 1]) +
              u * ((1.0 - w) * areal[k + n[1]] + w * areal[k + n[1] + 1]);
          if (here < enough)
            samples.push_back({{h * (first[0] + i + u), h * (first[1] + j + w)}, h * h / (m * m)});
        }
    }
}

/* ----------------------------------------------------------------------
   Spreading moves the edge of a hole of radius R inward by sigma^2/2R, with sigma^2 the
   variance of what a particle is spread by: h^2/3 of the spline and h^2/6 of what is
   linear between nodes.  Along any closed edge this adds up to pi sigma^2.
------------------------------------------------------------------------- */

Plate::Hole Plate::measure(int sectors) const
{
  const double variance = 0.5 * h * h;
  Hole hole = {PI * variance, 0.0, HUGE_VAL, 0.0, {0.0, 0.0}};
  double area = 0.0;
  for (const Sample &s : samples) {
    area += s.area;
    for (int k = 0; k < 2; k++) hole.center[k] += s.area * s.y[k];
  }
  for (double &c : hole.center) c /= area;
  hole.area += area;
  hole.diameter = 2.0 * std::sqrt(hole.area / PI);

  // square of the radius in every direction, from the area of the sector; none is narrower
  // than the spacing

  sectors = std::clamp(2 * (int) (0.5 * PI * hole.diameter / h), 8, sectors);
  std::vector<double> rsq(sectors, 0.0), r(sectors);
  for (const Sample &s : samples) {
    const double angle = std::atan2(s.y[1] - hole.center[1], s.y[0] - hole.center[0]);
    const int k = (int) (sectors * (0.5 + 0.5 * angle / PI));
    rsq[std::min(k, sectors - 1)] += s.area * sectors / PI;
  }
  for (int k = 0; k < sectors; k++) {
    const double sides = rsq[(k + 1) % sectors] + rsq[(k + sectors - 1) % sectors];
    r[k] = std::sqrt(0.5 * rsq[k] + 0.25 * sides + variance);
  }
  for (int k = 0; k < sectors / 2; k++) {
    hole.smallest = std::min(hole.smallest, r[k] + r[k + sectors / 2]);
    hole.largest = std::max(hole.largest, r[k] + r[k + sectors / 2]);
  }
  return hole;
}

/* ---------------------------------------------------------------------- */

double Plate::memory_usage() const
{
  return (double) areal.capacity() * sizeof(double) + (double) label.capacity() * sizeof(int) +
      (double) samples.capacity() * sizeof(Sample);
}
