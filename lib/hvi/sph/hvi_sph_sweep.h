/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_SPH_SWEEP_H
#define LMP_HVI_SPH_SWEEP_H

#include "hvi_images.h"
#include "hvi_sph.h"

#include <memory>
#include <string>
#include <vector>

namespace HVI {

// the half list of neighbors, as LAMMPS has it

struct SphList {
  int inum;
  const int *ilist, *numneigh;
  const int *const *firstneigh;
};

// those of the list within reach, in its order: kept by a first sweep for a second one in the same step

struct SphKept {
  std::vector<int> j, number;
  double bytes() const { return (j.capacity() + number.capacity()) * sizeof(int); }
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
  const double *const *visc_a = nullptr, *const *visc_b = nullptr;    // by types, with SPH_BODIES,
  const double *const *tension = nullptr;                             // likewise, 0 or 1
  const double *const *ratio =
      nullptr;    // with SPH_SPACINGS, by types: of h at the start, j's to i's,
  const double *const *weight = nullptr;    // and of weights in a density
  const int *type = nullptr;                // by index of owned particles
  const int *embedded =
      nullptr;    // by index of owned and ghosts: types of those in elements, else 0; null: none are
  Images *images = nullptr;    // null: no mirror planes
  SphKept *kept = nullptr;
  SphWatcher *watcher = nullptr;
  bool tally = false;
  double half_step = 0.0;    // half of the time step, with SPH_SOLID
  double fastest =
      0.0;    // 1/time in which signals pass h: given of particles, raised to that of pairs

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
  virtual ~SphSweeps() = default;
  virtual int scene() const = 0;       // bits of SphScene: those asked for, and maybe more
  virtual bool vectors() const = 0;    // of pairs; else pair by pair: see hvi_sph_reference.h
  virtual void first(SphWork &) const = 0;
  virtual void forces(SphWork &) const = 0;
  virtual double w(double q) const = 0;    // the kernel

  bool has_first() const { return (scene() & (SPH_RIEMANN | SPH_SOLID)) != 0; }
};

// in vectors, if there are any for kernel and scene.  Null: an unknown kernel.

std::unique_ptr<SphSweeps> make_sph_sweeps(const std::string &kernel, int scene);

}    // namespace HVI

#endif
