/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_ROWS_H
#define LMP_HVI_ROWS_H

#include "hvi_motion.h"

#include <vector>

namespace HVI {

/* ----------------------------------------------------------------------
   Half lists of neighbors, made cell by cell when they are asked for: where nothing happens nobody asks.  Points and
   cells are those of RelativeMotion::start(); whenever a row is made, it is by the places of that time, so it is good
   as long as RelativeMotion says.

   A pair of owned points is in one row of both; of an owned point and a ghost, with newton on, in the row of the owned
   one if the ghost is beyond it by z, else y, else x, so on one rank of two; with newton off, always.
------------------------------------------------------------------------- */

class NeighborRows {
 public:
  // x of owned points, then of ghosts; types from 1; cutsq: of two types the square of the distance up to
  // which they are neighbors, most the largest of these

  struct Points {
    int owned, all;
    const double *const *x;
    const int *type;
    const double *const *cutsq;
    double most;
    bool newton;
    int longest;    // neighbors of a point
  };
  void start(const RelativeMotion &, const Points &);

  int cells() const { return made.size(); }
  bool has(int cell) const { return made[cell]; }

  // makes the rows of the owned points of a cell, unless they are there; returns the first point with too many
  // neighbors, or -1

  int make(int cell);

  // owned points of a cell, in ascending order

  const int *begin(int cell) const { return order.data() + first_of[cell]; }
  const int *end(int cell) const { return order.data() + ghosts_of[cell]; }

  bool is_lonely(int cell) const    // one point, and none next to it
  {
    return first_of[cell + 1] == first_of[cell] + 1 && after_first[cell + 1] == after_first[cell] &&
        before_first[cell + 1] == before_first[cell];
  }

  // by owned point, 0 and null as long as its row has not been made

  std::vector<int> number;
  std::vector<int *> first;

  double bytes() const;

 private:
  Points points = {};
  std::vector<char> made;
  std::vector<int> order;                  // points by cells, owned ones first
  std::vector<int> types;                  // in that order
  std::vector<int> first_of, ghosts_of;    // of a cell, in order; first_of has one more
  std::vector<double> place[3];            // in that order
  struct Box {
    double lo[3], hi[3];
  };
  std::vector<Box> boxes;    // of the points of a cell
  std::vector<int> after_first,
      after;    // of a cell those next to it: pairs with these are in its rows
  std::vector<int> before_first, before;    // the other cells next to it
  bool ghosts = false;
  std::vector<int> row;    // the one that is being made, so long
  std::size_t length = 0;
  std::vector<std::vector<int>> pages;
  std::size_t page = 0;

  bool is_near(const double *at, int cell) const;
  int *keep();
  template <class Wanted> void look(int type, const double *at, int from, int to, const Wanted &);
};

}    // namespace HVI

#endif
