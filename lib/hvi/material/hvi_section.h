/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_SECTION_H
#define LMP_HVI_SECTION_H

#include <map>
#include <string>

namespace HVI {

// a section of a material file, as "strength johnson-cook": values of all keys of the law, given or
// preset, in the units of the run

struct Section {
  std::string kind, law;
  std::map<std::string, double> values;
};

}    // namespace HVI

#endif
