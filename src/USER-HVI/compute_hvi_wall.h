/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifdef COMPUTE_CLASS
// clang-format off
ComputeStyle(hvi/wall,ComputeHVIWall);
// clang-format on
#else

#ifndef LMP_COMPUTE_HVI_WALL_H
#define LMP_COMPUTE_HVI_WALL_H

#include "compute_hvi_cloud.h"
#include "compute_hvi_fragment.h"
#include "compute_hvi_hole.h"
#include "compute_hvi_matter.h"
#include "hvi_rear_face.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace LAMMPS_NS {

/* ----------------------------------------------------------------------
   What an impact does to the walls of a shield: a row of a global array for each
   wall, in the order along the axis.  The definitions are in compute_hvi_wall.rst.

   Columns up to held_mass are sums and maxima over particles.  Those from
   cloud_mass on ask what hangs together, and are 0 without the keyword pieces.
   For these the compute has a compute hvi/fragment, hvi/cloud and hvi/hole of its
   own, which LAMMPS does not know, and chooses particles for them.
------------------------------------------------------------------------- */

class ComputeHVIWall : public ComputeHVIMatter {
 public:
  // clang-format off
  enum Column {
    COMING_MASS, COMING_ENERGY, PUSH, MOMENTUM, ENERGY, PLASTIC_POWER, PASSED_MASS, PASSED_MOMENTUM, PASSED_ENERGY,
    TIP, FAILED_DEPTH, REAR_STRAIN, MISSED_MASS, MISSED_REACH, FAR_FREE, MASS, HELD_MASS,
    CLOUD_MASS, CLOUD_MOMENTUM, CLOUD_ENERGY, FRONT_VELOCITY, CLOUD_LENGTH, CLOUD_DIAMETER, CLOUD_RATIO,
    FRAGMENTS, LARGEST_MASS, LARGEST_VELOCITY, PIECES_APART, LARGEST_APART_MASS,
    APART_MASS, SPALL_MASS, APART_NUMBER, BULGE, BODY_MASS,
    HOLE_FOUND, HOLE_DIAMETER, HOLE_MIN, HOLE_MAX, PLANE_FOUND, PLANE_DIAMETER, PLANE_X, PLANE_Y, OUTER_STRAIN, NCOLUMNS
  };
  // clang-format on

  ComputeHVIWall(class LAMMPS *, int, char **);
  ~ComputeHVIWall() override;
  void init() override;
  void init_list(int, class NeighList *) override;
  void compute_array() override;
  void set_arrays(int) override;
  double memory_usage() override;

 private:
  struct Place {    // what the command says of a wall
    int lo, hi, outer_lo,
        outer_hi;            // types of its particles; of those of its outer part, 0: none
    int node_lo, node_hi;    // of nodes of its elements; 0: none
    double front, rear, layers, radius, center[2], struck[2];
  };
  struct Wall : Place {
    std::unique_ptr<ComputeHVICloud> cloud;
    std::unique_ptr<ComputeHVIHole> hole, plane;    // line of sight; in the plane of the wall

    std::vector<double> start;    // its columns from CLOUD_MASS on while nothing has moved it
    bool untouched = false;       // so are they still

    bool owns(int itype) const
    {
      return (itype >= lo && itype <= hi) || (itype >= outer_lo && itype <= outer_hi);
    }
    bool is_outer(int itype) const { return itype >= outer_lo && itype <= outer_hi; }
    bool has_node(int itype) const { return itype >= node_lo && itype <= node_hi; }
  };

  int axis, across[2];
  double reach;    // particles closer than this, or this times h, hang together; 0: no pieces
  std::vector<Wall> walls;
  std::unique_ptr<ComputeHVIFragment> fragment;
  char *id_fix;
  bool owns_fix;                // else another compute hvi/wall has made it
  class FixStoreAtom *first;    // where particles were
  class FixHVIStore *store;
  class FixHVIJohnsonCook *strength;
  class FixHVIDebris *debris;

  std::vector<char> chosen;
  HVI::RearFace rear_face;                      // of the wall that is measured
  std::vector<int> wall_of;                     // by type, -1: of none
  std::vector<int> moved;                       // by wall: something of it moves, or has energy
  std::vector<int64_t> sound, together, own;    // lowest ID of the piece of a particle

  void read_wall(int &, int, char **);
  std::vector<std::string> command_of(const char *, const std::vector<std::string> &) const;
  double mass_of(int i) const;
  bool is_embedded(int i) const;
  bool is_missed(const Wall &, int i) const;
  void check_walls() const;
  void find_first();
  void sum_up();
  void find_pieces();
  void find_rear_face(const Wall &, int64_t hull);
  void measure(int number, double *row);
  int64_t piece_of(const std::vector<int64_t> &, int64_t id) const;
  void find_hole(Wall &, double *row);
};

}    // namespace LAMMPS_NS

#endif
#endif
