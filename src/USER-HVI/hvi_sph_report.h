/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_SPH_REPORT_H
#define LMP_HVI_SPH_REPORT_H

#include "hvi_sph_sweep.h"
#include "pointers.h"

#include <functional>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/* ----------------------------------------------------------------------
   What a run with pair style hvi/sph is about to compute, as a table in the log unless it
   tells the same already, and warnings where that is unlikely to be meant.  Made at the
   start of a run, by all ranks.
------------------------------------------------------------------------- */

class HVISphReport : protected Pointers {
 public:
  HVISphReport(class LAMMPS *, class FixHVIStore *, const std::vector<char> &is_ours);

  std::function<double(int, int)> widest;    // h of the wider kernel between two types
  const double *const *weight;      // of types in each other's density; null: all are alike
  bool vectors;                     // of pairs, not the reference loop
  std::vector<std::string> laws;    // by type, what is in force besides the equation of state
  std::vector<char> unmoved;    // by owned particle: not integrated in a run before; empty: unknown
  bool solid;                   // there is a fix that keeps stress
  int kept_bytes;               // per owned particle, in arrays of fixes
  int forward, reverse, border;    // doubles a ghost, sent and returned each step, sent when new

  void count(const HVI::SphList &, bool newton);
  void write();
  void warn() const;

 private:
  struct Row {
    double number = 0.0, mass = 0.0;    // of particles, their mean mass
    double spacing = 0.0;               // (m/rho0)^(1/dim), rho0 or else the mean density
    double neighbors = 0.0;             // mean of particles that are not embedded, within reach
    double filled = 0.0;                // part of their bounding box
    double ratio = 0.0, least = 0.0, most = 0.0;    // of density to that at rest: mean, extremes
    double fresh = 0.0;                             // particles in no run before
    double held = 0.0;                              // embedded particles
    double far = 0.0;    // particles with a ratio far from 1 at their start
    int layers = 0;      // of the thinnest direction, 0: cannot be told
  };
  struct Told;    // the last table
  class FixHVIStore *store;
  const std::vector<char> &is_ours;
  std::vector<Row> rows;    // by type
  double spread;            // of velocities

  std::string terms() const;
  bool is_told(const std::string &settings);
};

}    // namespace LAMMPS_NS

#endif
