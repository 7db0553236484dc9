/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_MOTION_H
#define LMP_HVI_MOTION_H

#include <cstdint>
#include <vector>

namespace HVI {

/* ----------------------------------------------------------------------
   When a list of neighbors must be made anew: what counts is how far points have moved against
   those around them, not how far they have moved.

   The list has all pairs that were within cut + skin.  A pair that was farther apart comes within
   cut only by moving against each other by more than skin; one that was d apart, by more than d -
   cut.  Points are sorted into cells, once; later, boxes hold the displacements of each cell, and
   boxes of adjacent cells bound what their points have moved against each other.  For pairs beyond
   adjacent cells there are cells twice as large, and so on: those are a whole cell apart, so may
   move by its size - cut - skin, and points that are not in adjacent cells stay cut + skin apart.
------------------------------------------------------------------------- */

class RelativeMotion {
 public:
  void start(int n, const double *const *x, double cut, double skin);

  // moved: what each of the n points has moved since.  False: no pair can be missing; nor any time up
  // to the one given, if they go on with velocity v.

  bool exceeded(const double *const *moved, const double *const *v = nullptr, double time = 0.0);

  // the most that any of them has moved in direction k; after exceeded() has said no

  double farthest(int k) const { return most[k]; }

  // the smallest cells: all that can be within cut of each other are in one, or in adjacent ones

  int points() const { return cell.size(); }
  int cells() const { return levels.empty() ? 0 : levels[0].boxes.size(); }
  int cell_of(int i) const { return cell[i]; }
  template <class Work> void each_adjacent(const Work &work) const    // of two cells
  {
    if (levels.empty()) return;
    const Level &level = levels[0];
    for (int c = 0; c < cells(); c++)
      for (int m = level.first[c]; m < level.first[c + 1]; m++) work(c, level.other[m]);
  }
  double bytes() const;

 private:
  struct Box {
    double lo[3], hi[3];
  };
  struct Level {
    double allowed;            // relative motion in adjacent cells
    std::vector<Box> boxes;    // of occupied cells
    std::vector<int> first,
        other;                  // adjacent cells of cell c: other[first[c]] ... before first[c + 1]
    std::vector<int> parent;    // in the next level
  };

  std::vector<Level> levels;
  std::vector<int> cell;    // of the points, in the first level
  double most[3] = {0.0, 0.0, 0.0};

  static Box nothing();
};

}    // namespace HVI

#endif
