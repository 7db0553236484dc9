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
  int *const *firstneigh;
};

// those of the list within reach, in its order: kept by a first sweep for a second one in the same step

struct SphKept {
  std::vector<int> j, number;
  double bytes() const { return (j.capacity() + number.capacity()) * sizeof(int); }
};

// who is told about pairs

class SphWatcher {
 public:
  virtual void tally(int i, int n, const SphNear &, bool vectors) = 0;    // where asked for
  virtual void overlap(int i, int j) = 0;                                 // both at the same place

 protected:
  ~SphWatcher() = default;
};

// all that a sweep works on

struct SphWork {
  SphView records;
  SphList list;
  SphLaws laws;
  const double *const *visc_a, *const *visc_b, *const *tension;    // by types, with SPH_BODIES
  const double *const *ratio, *const *weight;                      // and with SPH_SPACINGS
  const int *type;
  Images *images;    // null: no mirror planes
  SphKept *kept;
  const int *embedded;    // in elements, by index without images: the type; null: none are
  SphWatcher *watcher;
  bool tally;
  double fastest;    // of the speeds of signals over h: that of particles, and then of pairs
};

/* ----------------------------------------------------------------------
   The sweeps over the half list, of one kernel and scene.

   A scene may ask for a first sweep, whose sums of neighbors (here: slopes) are
   communicated before the second one, forces(), uses them.  The first one keeps
   the neighbors within reach; the second goes through those.  Any scene can have one:
   it is what first() does, and that has_first() says so.
------------------------------------------------------------------------- */

class SphSweeps {
 public:
  virtual ~SphSweeps() = default;
  virtual int scene() const = 0;    // bits of SphScene: those asked for, and maybe more
  virtual bool has_first() const = 0;
  virtual void first(SphWork &) const = 0;
  virtual void forces(SphWork &) const = 0;
  virtual double w(double q) const = 0;    // the kernel
};

// scene: bits of SphScene.  Null: an unknown kernel, or terms that do not go together.

std::unique_ptr<SphSweeps> make_sph_sweeps(const std::string &kernel, int scene);

}    // namespace HVI

#endif
