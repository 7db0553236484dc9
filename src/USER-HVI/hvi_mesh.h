/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_MESH_H
#define LMP_HVI_MESH_H

#include "hvi_components.h"
#include "hvi_interface.h"

#include <cstdint>
#include <vector>

namespace HVI {

/* ----------------------------------------------------------------------
   A fix that has elements, for pair hvi/sph.  Types of their nodes have no material.  Particles
   that elements hold are marked in FixHVIStore and SphFields; what they show to others comes from elements.
------------------------------------------------------------------------- */

class Mesh {
 public:
  virtual ~Mesh() noexcept(false) {}
  virtual bool is_node(int itype) const = 0;

  // of nodes and particles of new elements, before other fixes and computes ask LAMMPS for masses in their init()

  virtual void give_masses() = 0;

  // between the two sweeps, when all have the sums of the first: elements are brought to the end of the
  // step, and with them state, density and pressure of the particles they hold

  virtual void advance() = 0;

  // internal energy of those elements of an owned node that hold no particles, which would have it; each element is of one
  // of its nodes

  virtual double energy_without_particles(int i) const = 0;

  // density and energy of an owned particle that an element holds, at the end of this step; false: it is free, or that is not
  // known

  virtual bool is_shown(int i, double &rho, double &esph) const = 0;

  // What hangs together by elements, collective: an element holds its particles and nodes if one of
  // its particles has an id above 0; one without particles does, unless failed ones are alone and it
  // has failed.  Vertices are owned particles, nodes with their node_id(), and from first on copies
  // of what elements of this rank have.

  virtual int copies() const = 0;
  virtual void join(Components &, const std::vector<std::int64_t> &id, int first,
                    bool failed_alone) = 0;
  virtual void copy(Components::Node *, int first) = 0;    // to these copies from their owners

  // after join(): bits of the mirror planes by which an owned particle hangs together with its image, as its element does

  virtual int on_mirror_planes(int i) const = 0;

  // above those of all particles: a component is named by one of these, if it has any

  static std::int64_t node_id(std::int64_t tag) { return INT64_MAX - tag; }
};

// what has elements; null: there are none

inline Mesh *find_mesh(const LAMMPS_NS::LAMMPS *lmp)
{
  const auto found = find_interface<Mesh>(lmp);
  return found.empty() ? nullptr : found[0];
}

}    // namespace HVI

#endif
