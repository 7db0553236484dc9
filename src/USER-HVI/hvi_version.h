/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_VERSION_H
#define LMP_HVI_VERSION_H

namespace HVI {

// CMake, Sphinx and Python read the version here; a test holds README, CITATION and examples to it
static constexpr char HVI_VERSION[] = "0.1.0";

}    // namespace HVI

#endif
