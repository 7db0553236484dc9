/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_SLEEP_H
#define LMP_HVI_SLEEP_H

#include "hvi_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace HVI {

/* ----------------------------------------------------------------------
   Where nothing happens: cells of RelativeMotion whose particles, and those of all adjacent cells, are
   undisturbed and have one velocity.  All that can act on a particle is in its own cell and the
   adjacent ones, so nothing does, and wherever something comes near it wakes before that acts.

   Active particles may need inactive ones: sums over all neighbors, such as M of solids, lack none of
   them only if all cells next to one with an active particle are gone through.
------------------------------------------------------------------------- */

class Sleep {
 public:
  void start(const RelativeMotion &motion) { cells.assign(motion.cells(), Cell()); }

  void add(int cell, const double *v, bool disturbed)
  {
    Cell &c = cells[cell];
    c.disturbed = c.disturbed || disturbed;
    for (int k = 0; k < 3; k++) {
      c.lo[k] = std::min(c.lo[k], v[k]);
      c.hi[k] = std::max(c.hi[k], v[k]);
    }
  }

  // alike: velocities that differ by no more count as one

  void settle(const RelativeMotion &motion, double alike)
  {
    double most = 0.0;
    const auto one = [alike, &most](const Cell &a, const Cell &b) {
      double square = 0.0, widest = 0.0;
      for (int k = 0; k < 3; k++) {
        const double range = std::max(a.hi[k], b.hi[k]) - std::min(a.lo[k], b.lo[k]);
        if (!(range > 0.0)) continue;    // of an empty cell
        square += range * range;
        widest = std::max(widest, range);
      }
      most = std::max(most, square);
      return widest <= alike && !a.disturbed && !b.disturbed;
    };
    for (Cell &c : cells) c.asleep = one(c, c);
    motion.each_adjacent([&](int a, int b) {
      if (!one(cells[a], cells[b])) cells[a].asleep = cells[b].asleep = false;
    });
    speed = std::sqrt(most);
    for (Cell &c : cells) c.watched = !c.asleep;
  }

  // no two particles in one cell or in adjacent ones have velocities that differ by more

  double fastest() const { return speed; }

  bool asleep(int cell) const { return cells[cell].asleep; }

  // another rank says that a particle in it is awake

  void watch(int cell) { cells[cell].watched = true; }

  // next to somebody who is awake; after spread()

  void spread(const RelativeMotion &motion)
  {
    for (Cell &c : cells) c.near = c.watched;
    motion.each_adjacent([this](int a, int b) {
      if (cells[a].watched) cells[b].near = true;
      if (cells[b].watched) cells[a].near = true;
    });
  }

  bool near_awake(int cell) const { return cells[cell].near; }

  // where points of those cells may have neighbors, or of cells of other ranks: of_ghosts, cells of ours with
  // points of theirs, are next to these

  void reach_out(const RelativeMotion &motion, const std::vector<int> &of_ghosts)
  {
    for (Cell &c : cells) {
      c.source = c.near;
      c.reached = false;
    }
    for (const int c : of_ghosts) cells[c].source = true;
    motion.each_adjacent([this](int a, int b) {
      if (cells[a].source) cells[b].reached = true;
      if (cells[b].source) cells[a].reached = true;
    });
    for (Cell &c : cells) c.reached = c.reached || c.source;
  }
  bool reached(int cell) const { return cells[cell].reached; }

 private:
  static constexpr double INF = std::numeric_limits<double>::infinity();
  struct Cell {
    double lo[3] = {INF, INF, INF}, hi[3] = {-INF, -INF, -INF};    // of velocities
    bool disturbed = false, asleep = false, watched = false, near = false;
    bool source = false, reached = false;
  };
  std::vector<Cell> cells;
  double speed = 0.0;
};

}    // namespace HVI

#endif
