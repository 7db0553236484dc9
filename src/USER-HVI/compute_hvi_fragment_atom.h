/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifdef COMPUTE_CLASS
// clang-format off
ComputeStyle(hvi/fragment/atom,ComputeHVIFragmentAtom);
// clang-format on
#else

#ifndef LMP_COMPUTE_HVI_FRAGMENT_ATOM_H
#define LMP_COMPUTE_HVI_FRAGMENT_ATOM_H

#include "compute_hvi_matter.h"
#include "hvi_close.h"
#include "hvi_components.h"
#include "hvi_mesh.h"

namespace LAMMPS_NS {

/* ----------------------------------------------------------------------
   Fragments: particles of the group that hang together through others of the
   group.  The lowest atom ID in a fragment is its ID.

   bonds         bonded particles hang together: live bonds only, as the bond
                 style has left them in the last force evaluation
   distance R    particles closer than R hang together, with "distance R h" those closer than R times
                 the mean of their smoothing lengths; with "damage yes" those that have failed (fix
                 hvi/johnson-cook, or property d_hvi_damage at 1) stay alone
------------------------------------------------------------------------- */

class ComputeHVIFragmentAtom : public ComputeHVIMatter {
 public:
  ComputeHVIFragmentAtom(class LAMMPS *, int, char **);
  ~ComputeHVIFragmentAtom() override;
  void init() override;
  void compute_peratom() override;
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  double memory_usage() override;

  // for a compute that has one of its own: whether failed particles stay alone; of each particle the
  // lowest ID in its fragment, 0 of those that do not count

  void choose(const std::vector<char> *, int damage);
  void find_chosen(std::vector<int64_t> &lowest);
  void name_found(std::vector<int64_t> &lowest) const;    // those of the last search

 protected:
  ComputeHVIFragmentAtom(class LAMMPS *, int, char **, int keywords);

  int iarg;    // first argument after MODE
  HVI::Components components;
  std::vector<int64_t> id;    // atom ID; 0 if left out, < 0 if it stays alone
  double cutoff;    // of mode distance, else 0: R, or R times the largest smoothing length

  void find_fragments(class Region *);
  double reach(int itype, int jtype) const;    // particles of these types hang together if closer

 private:
  enum Mode { BONDS, DISTANCE };

  Mode mode;
  int damage;               // 1: failed particles stay alone
  double factor;            // of smoothing lengths, 0: cutoff is a length
  std::vector<double> h;    // by type, with a factor
  HVI::ClosePairs close;
  int nmax;
  double *fragment;
  HVI::Components::Node *node;    // what forward communication carries
  bool checking = false;          // it carries nothing, but says whether ghosts are there
  int received = 0;

  const double *find_damage() const;
  void check_ghosts();
  void join_bonds();
  void join_close(const HVI::Mesh *);
  bool excluded(int, int) const;
};

}    // namespace LAMMPS_NS

#endif
#endif
