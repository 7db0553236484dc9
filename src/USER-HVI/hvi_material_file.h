/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_MATERIAL_FILE_H
#define LMP_HVI_MATERIAL_FILE_H

#include "hvi_material.h"
#include "pointers.h"

namespace HVI {

// Finds the file as LAMMPS finds potentials, reads it on rank 0 and parses it on all; stops with
// LAMMPS's error if anything is wrong.

Material read_material_file(LAMMPS_NS::LAMMPS *lmp, const std::string &filename);
std::unique_ptr<Eos> read_table_file(LAMMPS_NS::LAMMPS *lmp, const std::string &filename,
                                     std::uint64_t &checksum);

}    // namespace HVI

#endif
