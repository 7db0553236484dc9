/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_MATERIALS_H
#define LMP_HVI_MATERIALS_H

#include "hvi_material.h"

#include <memory>
#include <string>
#include <vector>

namespace HVI {

/* ----------------------------------------------------------------------
   The materials of a simulation by type of particle: what any style gave a type, for all
   styles to ask.  One per simulation, in fix hvi/store, so that it outlives the
   styles that fill it.
------------------------------------------------------------------------- */

class Materials {
 public:
  struct Entry {
    std::shared_ptr<const Material> material;    // null: the type has none
    std::string owner;                           // the style that gave it
    double volume = 0.0;                         // of a particle at rest, 0: not given
    bool restored = false;                       // named by a restart file, not by the input
  };

  // asked once per particle and step

  const Material *of(int itype) const
  {
    return itype < (int) entries.size() ? entries[itype].material.get() : nullptr;
  }
  const Entry &entry(int itype) const;

  void set(int itype, const Entry &);
  void forget(const std::string &owner);    // all that it gave

 private:
  std::vector<Entry> entries;
};

}    // namespace HVI

#endif
