/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifdef COMPUTE_CLASS
// clang-format off
ComputeStyle(hvi/cloud,ComputeHVICloud);
// clang-format on
#else

#ifndef LMP_COMPUTE_HVI_CLOUD_H
#define LMP_COMPUTE_HVI_CLOUD_H

#include "compute_hvi_matter.h"

#include <cstdint>
#include <vector>

namespace LAMMPS_NS {

/* ----------------------------------------------------------------------
   The debris cloud: particles of the group beyond plane X in +axis direction,
   by unwrapped coordinates s along the axis; M is their mass.  Quantiles make
   its edges insensitive to a few stray particles.

     front    smallest s of a particle with mass(<= s) >= Q M
     rear     largest s of a particle with mass(>= s) >= Q M
     L_a      front - rear
     axis     line in axis direction through the center of mass
     r        distance from the axis
     L_r      smallest r of a particle with mass(<= r) >= Q M

   Global vector:
      1 L_a                    2 diameter 2 L_r        3 R = L_a / L_r
      4 front                  5 rear
      6 mean axial velocity of particles with s >= front
      7 mean axial velocity of particles with s <= rear
      8 expansion velocity: mean radial velocity, relative to the center of
        mass, of particles with r >= L_r
      9 mass                  10 axial momentum       11 kinetic energy
     12 number of particles
   Means are weighted with mass.  All are 0 for an empty cloud, R also for one
   without a radius.
------------------------------------------------------------------------- */

class ComputeHVICloud : public ComputeHVIMatter {
 public:
  ComputeHVICloud(class LAMMPS *, int, char **);
  ~ComputeHVICloud() override;
  void init() override {}
  void compute_vector() override;
  double memory_usage() override;

 private:
  struct Particle {
    double mass, s, vs;    // along the axis
    double y[2], vy[2];    // across
    double r, vr;          // distance from it
  };
  struct Weighted {
    double value;
    int64_t weight;    // of all up to this one
  };

  int axis;
  double plane, quantile;
  std::vector<Particle> cloud;    // of this rank
  std::vector<Weighted> ordered;

  double find_quantile(double Particle::*what, double sign);
};

}    // namespace LAMMPS_NS

#endif
#endif
