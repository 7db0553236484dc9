/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "hvi_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>

using namespace HVI;

namespace {

using Place = std::array<std::int64_t, 3>;    // of a cell

struct Hash {
  size_t operator()(const Place &c) const
  {
    std::uint64_t mixed = 0;
    for (const std::int64_t one : c) {
      mixed = (mixed ^ static_cast<std::uint64_t>(one)) * 0xFF51AFD7ED558CCDull;
      mixed ^= mixed >> 32;
    }
    return mixed;
  }
};

using Numbers = std::unordered_map<Place, int, Hash>;

// cells beyond are one cell, which bounds no less

std::int64_t place_of(double s)
{
  static constexpr double MOST = 1.0e15;
  return static_cast<std::int64_t>(std::floor(std::max(-MOST, std::min(s, MOST))));
}

int number(const Place &place, Numbers &numbers, std::vector<Place> &places)
{
  const auto found = numbers.emplace(place, places.size());
  if (found.second) places.push_back(place);
  return found.first->second;
}

// a wide void between two parts of a scene must not make many levels

bool all_adjacent(const std::vector<Place> &places)
{
  Place lo = places[0], hi = places[0];
  for (const Place &c : places)
    for (int k = 0; k < 3; k++) {
      lo[k] = std::min(lo[k], c[k]);
      hi[k] = std::max(hi[k], c[k]);
    }
  return hi[0] - lo[0] <= 1 && hi[1] - lo[1] <= 1 && hi[2] - lo[2] <= 1;
}

}    // namespace

/* ---------------------------------------------------------------------- */

RelativeMotion::Box RelativeMotion::nothing()
{
  static constexpr double INF = std::numeric_limits<double>::infinity();
  return {{INF, INF, INF}, {-INF, -INF, -INF}};
}

/* ---------------------------------------------------------------------- */

void RelativeMotion::start(int n, const double *const *x, double cut, double skin)
{
  double size = cut + 3.0 * skin, allowed = skin;
  levels.clear();
  cell.resize(n);
  if (n == 0) return;

  Numbers numbers;
  std::vector<Place> places;
  Place last = {};
  int found = -1;    // neighbors in memory are mostly in the same cell
  for (int i = 0; i < n; i++) {
    const Place place = {place_of(x[i][0] / size), place_of(x[i][1] / size),
                         place_of(x[i][2] / size)};
    if (found < 0 || place != last) {
      found = number(place, numbers, places);
      last = place;
    }
    cell[i] = found;
  }

  while (true) {
    levels.emplace_back();
    Level &level = levels.back();
    level.allowed = allowed;
    level.boxes.resize(places.size());
    for (const Place &c : places) {
      level.first.push_back(level.other.size());
      for (int k = 14; k < 27; k++) {    // half of the cells around: each two once
        const auto near = numbers.find({c[0] + k / 9 - 1, c[1] + k / 3 % 3 - 1, c[2] + k % 3 - 1});
        if (near != numbers.end()) level.other.push_back(near->second);
      }
    }
    level.first.push_back(level.other.size());
    if (all_adjacent(places)) break;

    Numbers larger;
    std::vector<Place> parents;
    for (const Place &c : places)
      level.parent.push_back(number({c[0] >> 1, c[1] >> 1, c[2] >> 1}, larger, parents));
    numbers.swap(larger);
    places.swap(parents);
    allowed = size - (cut + skin);
    size *= 2.0;
  }
}

/* ---------------------------------------------------------------------- */

bool RelativeMotion::exceeded(const double *const *moved, const double *const *v, double time)
{
  for (Level &level : levels) std::fill(level.boxes.begin(), level.boxes.end(), nothing());
  for (double &one : most) one = 0.0;
  if (levels.empty()) return false;

  double longest = 0.0, farthest[3] = {0.0, 0.0, 0.0};
  for (size_t i = 0; i < cell.size(); i++) {
    Box &box = levels[0].boxes[cell[i]];
    double sq = 0.0, later = 0.0;
    for (int k = 0; k < 3; k++) {
      const double now = moved[i][k], then = v ? now + time * v[i][k] : now;
      box.lo[k] = std::min({box.lo[k], now, then});
      box.hi[k] = std::max({box.hi[k], now, then});
      sq += now * now;
      later += then * then;
      farthest[k] = std::max({farthest[k], std::fabs(now), std::fabs(then)});
    }
    longest = std::max({longest, sq, later});
  }

  // diagonals of boxes may be longer than any difference: what LAMMPS asks for is enough

  const double skin = levels[0].allowed;
  if (4.0 * longest <= skin * skin) {
    std::copy_n(farthest, 3, most);
    return false;
  }

  for (size_t n = 0; n < levels.size(); n++) {
    const Level &level = levels[n];
    const double allowed_sq = level.allowed * level.allowed;
    for (size_t c = 0; c < level.boxes.size(); c++) {
      const Box &own = level.boxes[c];
      double sq = 0.0;
      for (int k = 0; k < 3; k++) {
        const double range = own.hi[k] - own.lo[k];
        sq += range * range;
      }
      if (sq > allowed_sq) return true;
      for (int m = level.first[c]; m < level.first[c + 1]; m++) {
        const Box &near = level.boxes[level.other[m]];
        sq = 0.0;
        for (int k = 0; k < 3; k++) {
          const double range = std::max(own.hi[k] - near.lo[k], near.hi[k] - own.lo[k]);
          sq += range * range;
        }
        if (sq > allowed_sq) return true;
      }
      if (level.parent.empty()) {
        for (int k = 0; k < 3; k++) most[k] = std::max({most[k], -own.lo[k], own.hi[k]});
        continue;
      }
      Box &all = levels[n + 1].boxes[level.parent[c]];
      for (int k = 0; k < 3; k++) {
        all.lo[k] = std::min(all.lo[k], own.lo[k]);
        all.hi[k] = std::max(all.hi[k], own.hi[k]);
      }
    }
  }
  return false;
}

/* ---------------------------------------------------------------------- */

double RelativeMotion::bytes() const
{
  double sum = cell.capacity() * sizeof(int);
  for (const Level &level : levels)
    sum += level.boxes.capacity() * sizeof(Box) +
        (level.first.capacity() + level.other.capacity() + level.parent.capacity()) * sizeof(int);
  return sum;
}
