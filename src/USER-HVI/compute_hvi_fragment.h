/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifdef COMPUTE_CLASS
// clang-format off
ComputeStyle(hvi/fragment,ComputeHVIFragment);
// clang-format on
#else

#ifndef LMP_COMPUTE_HVI_FRAGMENT_H
#define LMP_COMPUTE_HVI_FRAGMENT_H

#include "compute_hvi_fragment_atom.h"

namespace LAMMPS_NS {

/* ----------------------------------------------------------------------
   Table of the fragments.  With "region ID" only particles in the region count
   and connect: two pieces that hang together only through particles outside
   are two fragments.

   Between mirror planes of pair hvi/sph all is of the whole model: a fragment closer to a plane than
   half of the distance within which particles hang together is one piece with its image, of any other
   there are as many.  No other two come that close across a plane without being one on this side.

   Rows (largest mass first, equal masses by ID; all on rank 0):
     id count mass x y z vx vy vz ke size
   x y z is the center of mass of the unwrapped coordinates, ke the kinetic
   energy of all its particles, size the diameter of a uniform sphere with the
   same radius of gyration: 2 sqrt(5/3) Rg, so 0 for a single particle.

   Global vector: number of fragments N_frag, number of particles N_part,
   F = N_frag / N_part, mass of the largest as a fraction of all, mass of
   those that are single particles.
------------------------------------------------------------------------- */

class ComputeHVIFragment : public ComputeHVIFragmentAtom {
 public:
  ComputeHVIFragment(class LAMMPS *, int, char **);
  ~ComputeHVIFragment() override;
  void init() override;
  void compute_vector() override;
  void compute_local() override;
  double memory_usage() override;

  // for a compute that has one of its own, see choose(): number of fragments, and the heaviest, of those
  // as heavy that with the lowest ID

  struct Heaviest {
    int64_t id;    // 0: there is none
    double number, mass, velocity[3];
  };
  Heaviest find_heaviest();

 private:
  struct Row {
    int64_t id;
    double count, mass, center[3], momentum[3];
    double mvsq;      // sum of m v^2
    double spread;    // sum of m (x - center)^2
    int reached;      // mirror planes that it hangs together with its images across, bits

    void add(const Row &);
    Row image(const HVI::MirrorPlanes &, int op) const;
  };
  struct Share {    // of a fragment that another rank gathers
    Row row;
    int vertex;
  };

  char *idregion;
  class Region *region;
  bigint table_step;    // when the rows were last made
  std::vector<Row>
      rows;    // fragments whose lowest ID is owned here, with images that are one with them
  std::vector<int> slot;
  HVI::MirrorPlanes mirror;

  void make_rows();
  double number(const Row &) const;    // of such pieces in the whole model
};

}    // namespace LAMMPS_NS

#endif
#endif
