/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_SPH_WORK_H
#define LMP_HVI_SPH_WORK_H

#include "hvi_images.h"
#include "hvi_sph.h"

#include <vector>

namespace HVI {

// the half list of neighbors, as LAMMPS has it

struct SphList {
  int inum;
  const int *ilist, *numneigh;
  const int *const *firstneigh;
};

// those of the list within reach, in its order: kept by a first sweep for a second one in the same step;
// and room for some neighbors of one particle

struct SphKept {
  std::vector<int> j, number, some;
  void make_room(std::size_t pairs, std::size_t particles);
  int *room_for(std::size_t some_neighbors);
  double bytes() const
  {
    return (j.capacity() + number.capacity() + some.capacity()) * sizeof(int);
  }
};

// is told about pairs; d from j to i, f on i

class SphWatcher {
 public:
  virtual void tally(int i, int j, const double *d, const double *f) = 0;    // where asked for
  virtual void overlap(int i, int j) = 0;    // both at the same place

 protected:
  ~SphWatcher() = default;
};

// all that a sweep works on

struct SphWork {
  SphView records;
  SphList list = {};
  SphLaws laws = {};
  double half_step = 0.0;    // half of the time step, with SPH_SOLID

  // by two types, with SPH_BODIES: viscosity; 1: tension between them, 0: none

  const double *const *visc_a = nullptr, *const *visc_b = nullptr, *const *tension = nullptr;

  // likewise, with SPH_SPACINGS, of the second to the first: h at the start, weights in a density

  const double *const *ratio = nullptr, *const *weight = nullptr;

  // types of owned particles; of those and ghosts that are in elements, else 0 (null: none are)

  const int *type = nullptr, *embedded = nullptr;
  Images *images = nullptr;    // null: no mirror planes
  SphKept *kept = nullptr;
  SphWatcher *watcher = nullptr;
  bool tally = false;

  // largest 1/time in which signals pass h: given that of particles, raised to that of pairs

  double fastest = 0.0;

  // elements do for the particles of a body what pairs do otherwise

  bool in_elements_together(int i, int j) const
  {
    const int owner = images && images->is_image(j) ? images->owner(j) : j;
    return embedded && embedded[i] && embedded[owner] == embedded[i];
  }
};

/* ----------------------------------------------------------------------
   The sweeps over the half list, of one kernel and scene.

   A scene may ask for a first sweep, whose sums of neighbors are communicated before the second
   one, forces(), uses what is made of them.
------------------------------------------------------------------------- */

class SphSweeps {
 public:
  virtual ~SphSweeps();
  virtual int scene() const = 0;       // bits of SphScene: those asked for, and maybe more
  virtual bool vectors() const = 0;    // of pairs; else pair by pair: see hvi_sph_reference.h
  virtual void first(SphWork &) const = 0;
  virtual void forces(SphWork &) const = 0;
  virtual double w(double q) const = 0;    // the kernel

  bool has_first() const { return (scene() & (SPH_RIEMANN | SPH_SOLID)) != 0; }
};

}    // namespace HVI

#endif
