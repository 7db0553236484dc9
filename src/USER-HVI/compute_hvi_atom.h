/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifdef COMPUTE_CLASS
// clang-format off
ComputeStyle(hvi/atom,ComputeHVIAtom);
// clang-format on
#else

#ifndef LMP_COMPUTE_HVI_ATOM_H
#define LMP_COMPUTE_HVI_ATOM_H

#include "compute.h"
#include "hvi_mesh.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

class ComputeHVIAtom : public Compute {
 public:
  ComputeHVIAtom(class LAMMPS *, int, char **);
  ~ComputeHVIAtom() override;
  void init() override;
  void compute_peratom() override;
  int pack_reverse_comm(int, int, double *) override;
  void unpack_reverse_comm(int, int *, double *) override;
  double memory_usage() override;

 private:
  enum Value {
    PRESSURE,
    ENERGY,
    TEMPERATURE,
    SOUND,
    LENGTH,    // of all
    EPS,
    EPSDOT,
    DAMAGE,
    INITIATION,
    SPALLED,
    VOIDS,
    VOID_DAMAGE,
    FRAGSIZE,
    MISES,
    SXX,
    SYY,
    SZZ,
    SXY,
    SXZ,
    SYZ,    // of solids
    ASLEEP,
    COST,
    BODY,
    BONDS
  };

  std::vector<Value> values;
  int nmax;
  double **table;
  std::vector<double> nbonds;    // of owned and ghost particles
  bool are_others = false;       // particles, than those of the last forces
  bool checking = false;         // reverse communication says whether ghosts are there
  int sent = 0;

  // found anew for each evaluation: fixes may have gone since the last run

  class FixHVIStore *store;
  class FixHVISPH *integrator;
  class FixHVIJohnsonCook *strength;
  HVI::Mesh *mesh;

  void find_sources();
  double value_of(Value, int) const;
  double solid_value(Value, int, double) const;

  void check_ghosts(const std::string &value);
  void check_inactive(bool asks_for_asleep);
  void count_bonds();
};

}    // namespace LAMMPS_NS

#endif
#endif
