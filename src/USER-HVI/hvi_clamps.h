/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_CLAMPS_H
#define LMP_HVI_CLAMPS_H

#include "pointers.h"

namespace LAMMPS_NS {

/* ----------------------------------------------------------------------
   What clamps do to their particles is the change of those particles' kinetic
   energy and momentum less what pairs and bonds do to them: in a step of
   length dt the impulse dt/2 (F_old + F_new), the work 1/2 (F_old + F_new).dx,
   half of each booked before and after the forces change.  The displacement
   serves whoever moves the particles, fix move as well as fix nve.

   Called by the ledger at the hooks of a step.  Nothing is kept of particles, or
   sent with them, as long as no group is clamped.
------------------------------------------------------------------------- */

class HVIClamps : protected Pointers {
 public:
  HVIClamps(class LAMMPS *, double *book);    // where work and impulse are added up, 4 numbers
  ~HVIClamps() override;

  void watch(int groupbits);
  int bits() const { return clampbit; }

  void begin();                  // of a run
  void post_integrate();         // of all fixes
  void see_forces(double dt);    // complete, and untouched by other fixes
  void end_of_step();

  void look();        // what clamped particles have got since the last look
  void add(int i);    // a particle that has come
  void hand_over(int i, double mass);

  static constexpr int SENT = 7;    // numbers that go along with a particle
  void grow(int nmax);
  void copy(int i, int j);
  int pack(int i, double *buf) const;
  int unpack(int i, const double *buf);
  double memory_usage() const { return 13.0 * nmax * sizeof(double); }

 private:
  double *const book;
  int clampbit;
  double dt;              // length of the step in progress, 0 at the start of a run
  double **finternal;     // forces before other fixes change them
  double **xold, **dx;    // positions before the step in progress, displacement in it
  double **had;      // kinetic energy and momentum at the last look; what goes takes them along
  int nmax;          // their length
  bool newcomers;    // there may be particles that came in this step

  void book_half();
  void admit();
  bool is_newcomer(int i) const;
  int embedded() const;
  void find_state(int i, int embedded, double *state) const;
};

}    // namespace LAMMPS_NS

#endif
