/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_PLATE_H
#define LMP_HVI_PLATE_H

#include <vector>

namespace HVI {

/* ----------------------------------------------------------------------
   Map of a plate's mass per area, and the hole in it.  Knows neither LAMMPS nor
   MPI.  Coordinates are from a center, which must be between lo and hi.

     lay_out(lo, hi, spacing)   an empty map from lo to hi
     areal[index(i, j)]         mass per area at node (i, j), to be filled in
     find_intact()              which part is intact, and its mass per area
     find_hole(fill, mirrored)  where there is less than this share of it; for a
                                mirrored plate only around the center
     measure(sectors)           the hole that was found
------------------------------------------------------------------------- */

class Plate {
 public:
  enum Found { NO_HOLE, OPEN, HOLE };    // open: there is no plate around the center
  struct Hole {
    double area, diameter, smallest, largest, center[2];
  };

  double h;    // spacing of the nodes
  int n[2];    // number of nodes
  std::vector<double> areal;
  double intact;    // mass per area of the intact plate,
  int far;          // which is this many spacings or more from the center

  Plate() : h(0.0), n{0, 0}, intact(0.0), far(0), first{0, 0} {}
  bool lay_out(const double *, const double *, double);
  int index(int i, int j) const { return i * n[1] + j; }
  double node(int k, double y) const { return y / h - first[k]; }
  void find_intact();
  Found find_hole(double, bool);
  Hole measure(int) const;
  double memory_usage() const;

 private:
  struct Sample {
    double y[2], area;    // a small piece of the hole
  };

  int first[2];    // node (i, j) is at h * (first[0] + i, first[1] + j)
  std::vector<int> label;
  std::vector<Sample> samples;

  double distance(int i, int j) const;
  int find_components(const std::vector<char> &);
  std::vector<int> moves_from(const std::vector<char> &) const;
  void sample(const std::vector<char> &, double);
};

}    // namespace HVI

#endif
