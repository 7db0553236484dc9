/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifdef COMMAND_CLASS
// clang-format off
CommandStyle(hvi/variables,HVIVariables);
// clang-format on
#else

#ifndef LMP_HVI_VARIABLES_H
#define LMP_HVI_VARIABLES_H

#include "command.h"

namespace LAMMPS_NS {

/* ----------------------------------------------------------------------
   Says which index-style variables an input has.  LAMMPS takes any name after
   -var: one that is misspelled would change nothing and say nothing.
------------------------------------------------------------------------- */

class HVIVariables : public Command {
 public:
  HVIVariables(class LAMMPS *lmp) : Command(lmp) {}
  void command(int, char **) override;
};

}    // namespace LAMMPS_NS

#endif
#endif
