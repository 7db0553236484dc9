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

#include <string>
#include <vector>

namespace LAMMPS_NS {

/* ----------------------------------------------------------------------
   The variables that a run was given: written by the run, taken up again by
   one that goes on with it, which must not have been given others.
------------------------------------------------------------------------- */

class HVIRecall : public Command {
 public:
  HVIRecall(class LAMMPS *lmp) : Command(lmp) {}
  void command(int, char **) override;

 private:
  std::vector<std::string> names() const;                        // of index-style variables
  std::vector<std::string> values(const std::string &) const;    // those not yet used up
  void define(const std::string &, const std::vector<std::string> &) const;
  void write(const std::string &, const std::vector<std::string> &) const;
};

}    // namespace LAMMPS_NS

#endif
#endif
