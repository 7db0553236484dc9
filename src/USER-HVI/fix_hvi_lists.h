/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(hvi/lists,FixHVILists);
// clang-format on
#else

#ifndef LMP_FIX_HVI_LISTS_H
#define LMP_FIX_HVI_LISTS_H

#include "fix.h"
#include "hvi_motion.h"
#include "hvi_rows.h"

#include <vector>

namespace LAMMPS_NS {

// asks for new lists of neighbors when particles have moved against those around them

class FixHVILists : public Fix {
 public:
  FixHVILists(class LAMMPS *, int, char **);
  ~FixHVILists() override;

  int setmask() override;
  void init() override;
  void setup_pre_exchange() override;
  void pre_exchange() override;
  void setup_pre_neighbor() override;
  void pre_neighbor() override;
  void setup(int) override;
  void post_integrate() override;
  void post_run() override;
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  double memory_usage() override;

  // for init_style() of pair styles, where it becomes the last fix of all: it must see where others
  // have put the particles

  static FixHVILists *make(class LAMMPS *, bool relative, bool ahead);

  static constexpr int SENT =
      3;    // doubles to each ghost in each step, while in charge; twice as many if ahead

  bool in_charge() const;

  // Rows of the half list are made where they are asked for.  keep_rows(): said in init_style(), for then no
  // other list is asked for; may_keep_rows(): whether that can be.

  bool may_keep_rows(double cut) const;
  void keep_rows(bool keeps) { has_rows = keeps; }
  HVI::NeighborRows *rows() { return has_rows ? &made_rows : nullptr; }
  const HVI::RelativeMotion &cells() const { return motion; }

 private:
  HVI::RelativeMotion motion;
  HVI::NeighborRows made_rows;
  bool has_rows;
  std::vector<double> hold;    // positions of owned particles when lists were made
  double **moved, **going;     // of owned particles and ghosts, since then; velocities, if ahead
  int nmax;
  double farthest[3];    // that any particle may go: to the rank next to its own
  double beyond[6];      // fixed faces, low ones first: who comes there is to be lost
  double unseen[3];      // relative motion of two that no rank has both of
  int delay;             // of neigh_modify
  bool relative;         // else LAMMPS decides
  bool ahead;            // not looked at in each step, but by how far they will get in several
  bigint made, next, looked;    // step when lists were made, are looked at next, were looked at
  bool known;                   // no particle has come since lists were made
  bool leaving;                 // some particle is to be lost
  bool put_back;                // particles have been put into the box since lists were made

  struct Bins {
    int wide;    // neighbor->binsizeflag
    double bin, sort_bin;
  };
  Bins put, given;    // last set here; of neigh_modify and atom_modify sort

  void check_box(const double *length, double cut) const;
  double least_bins(bool shrinks) const;
  void give_back_sorting();
  void give_back();
  void measure();
  bool strays() const;
  void set_bins(double least, double least_sort);
  bool exceeded(double time);
};

}    // namespace LAMMPS_NS

#endif
#endif
