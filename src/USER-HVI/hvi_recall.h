/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifdef COMMAND_CLASS
// clang-format off
CommandStyle(hvi/recall,HVIRecall);
// clang-format on
#else

#ifndef LMP_HVI_RECALL_H
#define LMP_HVI_RECALL_H

#include "command.h"
#include "hvi_compat.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

/* ----------------------------------------------------------------------
   The variables of a run for one that goes on with it: those that it was
   given, which the other must have too, and their later state.
------------------------------------------------------------------------- */

class HVIRecall : public Command {
 public:
  HVIRecall(class LAMMPS *lmp) : Command(lmp) {}
  void command(int, char **) override;

 private:
  HVI::VariableText index_variable(const std::string &) const;
  void recall(const std::string &, const std::vector<std::string> &) const;
  std::string given(const std::vector<std::string> &) const;
  std::string state(const std::vector<std::string> &) const;
  void write(const std::string &, const std::string &) const;
};

}    // namespace LAMMPS_NS

#endif
#endif
