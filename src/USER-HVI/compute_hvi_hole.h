/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifdef COMPUTE_CLASS
// clang-format off
ComputeStyle(hvi/hole,ComputeHVIHole);
// clang-format on
#else

#ifndef LMP_COMPUTE_HVI_HOLE_H
#define LMP_COMPUTE_HVI_HOLE_H

#include "compute_hvi_matter.h"
#include "hvi_plate.h"

#include <cstdint>
#include <vector>

namespace LAMMPS_NS {

/* ----------------------------------------------------------------------
   The hole in a plate, seen along the axis.  The mass of a layer around the plate
   is spread onto a map across the axis; the hole is found there.  The definition is
   in compute_hvi_hole.rst.

   Global vector:
      1 equal-area diameter    2 smallest diameter    3 largest diameter
      4, 5 center of the hole  6 area
      7 share of the plate that is there: 1, 1/2 or 1/4
      8 thickness of the layer
      9 mass per area of the intact plate
     10 spacing of the map
   1 to 6 are 0 if there is no hole, all if there is no plate.
------------------------------------------------------------------------- */

class ComputeHVIHole : public ComputeHVIMatter {
 public:
  // keeps: in restart files, that a plate has been there; a compute that LAMMPS does not know keeps nothing

  ComputeHVIHole(class LAMMPS *, int, char **, bool keeps = true);
  ~ComputeHVIHole() override;
  void init() override;
  void compute_vector() override;
  double memory_usage() override;
  void say_placed() { placed = true; }    // a plate has been there, as others know

 private:
  struct Particle {
    double mass, s, y[2];    // s from the plane, y from the center
    int parts;    // along each edge, as large as the finest particle: 1, or 2 of one twice as large
  };

  // settings; 0 means: find it out

  int axis, across[2], sectors;
  double center[2], plane, thickness, dr, fill, reference;
  bool is_away;    // from the centre, or from the plane
  bool placed;     // a plate has been there
  char *id_fix;    // that keeps it, with the place that the command gives; null: none does
  bool warned_open, warned_away, warned_coarse, warned_dr;

  // the plate's layer; all but the particles is the same on all ranks

  std::vector<Particle> layer;           // of this rank
  double half = 0.0, farthest = 0.0;     // thickness of the layer / 2, largest |s|
  int64_t count = 0, cells = 0;          // of its particles, and of their parts
  double least_mass = 0.0;               // of a particle
  double mean_mass = 0.0, unit = 0.0;    // of a part; masses are added up as integers: mass * unit
  double grain = 0.0;                    // how far parts are from each other
  bool mirrored[2] = {};
  double lo[2] = {}, hi[2] = {};    // where the plate is
  std::vector<int64_t> mass;
  HVI::Plate map;

  void keep() const;
  void find_layer();
  bool find_extent();
  void make_map(double);
  double find_spacing();
};

}    // namespace LAMMPS_NS

#endif
#endif
