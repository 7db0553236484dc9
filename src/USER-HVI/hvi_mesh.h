/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_MESH_H
#define LMP_HVI_MESH_H

#include "hvi_interface.h"

namespace HVI {

/* ----------------------------------------------------------------------
   A fix that has elements, for pair hvi/sph.  Types of their nodes have no material.  Particles
   that elements hold are marked in FixHVIStore and SphFields; what they show to others comes from elements.
------------------------------------------------------------------------- */

class Mesh {
 public:
  virtual ~Mesh() noexcept(false) {}
  virtual bool is_node(int itype) const = 0;

  // between the two sweeps, when all have the sums of the first: elements are brought to the end of the
  // step, and with them state, density and pressure of the particles they hold

  virtual void advance() = 0;
};

// what has elements; null: there are none

inline Mesh *find_mesh(const LAMMPS_NS::LAMMPS *lmp)
{
  const auto found = find_interface<Mesh>(lmp);
  return found.empty() ? nullptr : found[0];
}

}    // namespace HVI

#endif
