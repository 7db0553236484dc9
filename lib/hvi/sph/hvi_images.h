/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_IMAGES_H
#define LMP_HVI_IMAGES_H

#include "hvi_mirror.h"
#include "hvi_sph_records.h"

#include <vector>

namespace HVI {

/* ----------------------------------------------------------------------
   Images of the particles near the planes, within reach of others or soon: the time step
   wants to know.  Their records follow those of ghosts.
------------------------------------------------------------------------- */

class Images {
 public:
  double force[3] = {0, 0, 0};    // of the planes on the particles

  // before records are filled: is_ours by type, reach of what is in lists; alone, empty or of owned particles: does not act on
  // its own image

  void find(const MirrorPlanes &, const double *const *x, const int *type,
            const std::vector<char> &is_ours, int nlocal, int nall, double reachsq,
            const std::vector<char> &alone = {});
  int end() const { return first + images.size(); }    // of the records

  // those of the particles are there; and after the loop, what happened to images

  void fill(const MirrorPlanes &, const SphView &) const;
  void fold(const SphView &, bool newton);

  // in between, likewise, the sums of a first sweep: folded before they go to the owners of
  // ghosts, filled in when those have sent them back

  void fold_sums(const SphView &) const;
  void fill_sums(const SphView &) const;

  // images that particle i may interact with: those of its neighbors, and its own.  Valid until the next call.

  const std::vector<int> &near(int i, const int *jlist, int jnum);

  double reachsq() const { return reach_squared; }
  bool is_image(int j) const { return j >= first; }
  int owner(int j) const { return images[j - first].owner; }
  int operation(int j) const { return images[j - first].op; }
  bool is_own(int j) const { return images[j - first].self; }    // seen by its owner

 private:
  struct Image {
    int owner, op;
    bool self;    // of an owned particle, for itself: what happens to this one is of no concern
  };
  std::vector<Image> images;
  int nlocal = 0, first = 0;    // index of the first record
  double reach_squared = 0.0;
  std::vector<int>
      of[MirrorPlanes::NOPS];    // by operation and particle: index of its image, or -1,
  std::vector<int> self[MirrorPlanes::NOPS];    // and of the one for itself
  std::vector<int> nearby;
};

}    // namespace HVI

#endif
