/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_FEM_COUPLING_H
#define LMP_HVI_FEM_COUPLING_H

#include "fix_hvi_fem_mesh.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

/* ----------------------------------------------------------------------
   Elements of fix hvi/fem and what their embedded particles have to do with others: which of them pairs act on, where they
   are and what they show, sums and forces of pairs on them brought to elements and nodes, and what becomes
   of them when their elements fail.
------------------------------------------------------------------------- */

class HVIFEMCoupling : protected Pointers {
 public:
  HVIFEMCoupling(class LAMMPS *, FixHVIFEMMesh &);
  ~HVIFEMCoupling() override;

  class FixHVIStore *store = nullptr;
  class FixHVISPH *integrator = nullptr;
  class FixHVIJohnsonCook *strength = nullptr;

  void init();

  // of a run that begins

  void mark();       // groups of embedded particles
  bool strayed();    // whether a command has moved embedded particles, or nodes without them
  void check_group(int i) const;
  void check_fixes();    // which must not act on embedded particles alone

  void find_pairs();    // after lists have been made: elements that pairs act on
  void place();    // embedded particles; those of elements that are no more are free from then on
  void take_masses();    // from nodes, of elements that are no more
  void show_all();       // state, to all embedded particles
  void show();           // to those that pairs act on, and density, pressure, velocity gradient
  void show_end();
  bool is_shown(int i, double &rho, double &esph) const;
  void gather_sums();
  void gather_forces();
  void take_forces(std::vector<std::array<double, 3>> &node_forces);    // of other styles

 private:
  FixHVIFEMMesh &mesh;
  class FixHVILedger *ledger = nullptr;
  int group_bit;             // of embedded particles
  std::vector<int> inner;    // by type: bit of the group that lists leave out; 0: none is embedded
  struct Shown {
    double rho, esph;
    tagint tag;    // 0: it is free
  };
  std::vector<Shown> at_end;    // of owned particles
  bool others = false;          // other styles may act on embedded particles

  bool is_embedded(int i) const { return atom->mask[i] & group_bit; }
  void make_groups();
  void unmark();
  static void forget(HVI::Element &);    // what pairs did
};

}    // namespace LAMMPS_NS

#endif
