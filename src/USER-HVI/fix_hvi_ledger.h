/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(hvi/ledger,FixHVILedger);
// clang-format on
#else

#ifndef LMP_FIX_HVI_LEDGER_H
#define LMP_FIX_HVI_LEDGER_H

#include "fix.h"
#include "hvi_clamps.h"

#include <vector>

namespace LAMMPS_NS {

/* ----------------------------------------------------------------------
   The books: energy, momentum and mass that are no longer in the particles,
   each booked where it happens.  One per simulation, made by the styles that
   need it; read by compute hvi/energy.
------------------------------------------------------------------------- */

class FixHVILedger : public Fix {
 public:
  // clang-format off
  enum Entry {
    BROKEN,                                 // energy of broken bonds
    LEFT,                                   // energy of particles that left the box
    LEFT_PX, LEFT_PY, LEFT_PZ, LEFT_MASS, LEFT_COUNT,
    BONDS_BROKEN, BONDS_LEFT,               // their numbers
    CLAMP_WORK,                             // work of the clamps on the particles
    CLAMP_JX, CLAMP_JY, CLAMP_JZ,           // impulse on the particles, of clamps and mirror planes
    VISCOUS,                                // heat from viscosity, a part of internal energy
    LEFT_PLASTIC,                           // plastic work that left the box, another part
    MISSED,                                 // work put right in internal energy, see fix hvi/sph
    LEFT_VOIDS,                             // work of opening voids that left the box, another part
    FROZEN,                                 // number of particles that take no part any more
    NENTRY
  };
  // clang-format on

  FixHVILedger(class LAMMPS *, int, char **);
  ~FixHVILedger() override;
  int setmask() override;
  void init() override;
  void setup(int) override;
  void post_integrate() override
  {
    moved = true;
    if (!later) see_moves();
  }
  void pre_force(int) override { see_moves(); }
  void setup_pre_exchange() override;
  void pre_exchange() override;
  void post_force(int) override;
  void end_of_step() override;
  int pack_reverse_comm(int, int, double *) override;
  void unpack_reverse_comm(int, int *, double *) override;
  void write_restart(FILE *) override;
  void restart(char *) override;
  void set_arrays(int i) override { held.add(i); }
  void grow_arrays(int n) override { held.grow(n); }
  void copy_arrays(int i, int j, int) override { held.copy(i, j); }
  int pack_exchange(int i, double *buf) override { return held.pack(i, buf); }
  int unpack_exchange(int i, double *buf) override { return held.unpack(i, buf); }
  double memory_usage() override;

  static FixHVILedger *instance(class LAMMPS *);    // the one of this simulation

  // for bond styles, in compute()

  void watch_breaking() { breaking = 1; }
  void book_break(int nerased, double energy);
  void book_lost_kick(int i, double fx, double fy, double fz);

  // for fix hvi/sph

  void book_viscous(double heat) { entry[VISCOUS] += heat; }
  void book_missed(double work) { entry[MISSED] += work; }
  void book_frozen() { entry[FROZEN] += 1.0; }
  bool clamps(int mask) const { return mask & held.bits(); }    // which books itself what they get
  void book_mirror(const double *impulse)
  {
    for (int k = 0; k < 3; k++) entry[CLAMP_JX + k] += impulse[k];
  }

  // for fix hvi/fem, in the middle of a step: elements give mass of clamped nodes to clamped particles

  void hand_over(int i, double mass) { held.hand_over(i, mass); }

  // for compute hvi/energy

  void clamp(int groupbits) { held.watch(groupbits); }    // moved by more than pairs and bonds
  void totals(double *sum);                               // the NENTRY entries, summed over ranks
  enum { START_ENERGY, START_PX, START_PY, START_PZ, START_MASS, NSTART };
  const double *first(const double *now);    // the first totals with energy, also across restarts

 private:
  bool later = false;    // walls that put particles back have their turn after this fix
  bool moved = false;    // in this step, and clamps have not seen it yet
  void see_moves()
  {
    if (moved) held.post_integrate();
    moved = false;
  }

  double entry[NENTRY];    // this rank's share
  int start_set;
  double start[NSTART];

  int breaking;
  int warned;        // of energy that is not booked
  int nerased;       // bond records erased on this rank in this step
  double dt_step;    // length of the step in progress, 0 in setup
  int nmax;
  double **lost;                 // force that bonds broken in this step no longer exert
  std::vector<int> lost_list;    // owned and ghost particles with an entry in it

  HVIClamps held;    // what clamps do to their particles

  void grow_lost();
  void add_lost(int, const double *);
  void count_erased(bigint);
  void book_forces();
  void let_go(double);
};

}    // namespace LAMMPS_NS

#endif
#endif
