/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(hvi/dt,FixHVIDt);
// clang-format on
#else

#ifndef LMP_FIX_HVI_DT_H
#define LMP_FIX_HVI_DT_H

#include "fix.h"
#include "hvi_timestep.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

class FixHVIDt : public Fix {
 public:
  FixHVIDt(class LAMMPS *, int, char **);
  int setmask() override;
  void init() override;
  void setup(int) override;
  void end_of_step() override;
  double compute_scalar() override;
  double compute_vector(int) override;
  void post_run() override;
  void write_restart(FILE *) override;
  void restart(char *) override;

 private:
  double factor, dtmin, dtmax, floor;
  int asked, every;    // asked 0: every is what suits the sources
  int limiter;
  double restored;    // dt of a restart file, 0: there was none
  int chosen;         // in an earlier run
  bool running;       // a run is not at its end
  bigint laststep;    // that chose dt
  double first;       // step that was chosen; 0: none yet
  std::vector<HVI::TimeStepSource *> sources;

  double choose(int);
  std::string fastest_signal();
  void apply(double);
};

}    // namespace LAMMPS_NS

#endif
#endif
