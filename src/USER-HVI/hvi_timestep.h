/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_TIMESTEP_H
#define LMP_HVI_TIMESTEP_H

namespace HVI {

/* ----------------------------------------------------------------------
   What a style tells fix hvi/dt about the present state of its own pairs on
   this rank: the shortest time sqrt(m/k) it must resolve, m the reduced mass
   and k the stiffness d2phi/dr2 of a pair, for each reason that may limit it.
   Velocities of ghost particles are up to date when tighten() is called.
------------------------------------------------------------------------- */

struct TimeStepBounds {
  double contact;     // stiffness of pairs in contact as they stand
  double spring;      // stiffness of intact bonds
  double approach;    // stiffness where approaching pairs will turn back
  double signal;      // not of a pair's stiffness: a length over the speed of signals, SPH
};

class TimeStepSource {
 public:
  virtual ~TimeStepSource() noexcept(false) {}
  virtual void tighten(TimeStepBounds &bounds) = 0;
};

}    // namespace HVI

#endif
