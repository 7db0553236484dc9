/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_COMPAT_H
#define LMP_HVI_COMPAT_H

// this and hvi_compat.cpp are the only files that know which LAMMPS version they are compiled against

#include "domain.h"
#include "pointers.h"

#include <string>
#include <vector>

namespace HVI {

// Domain::minimum_image(dx,dy,dz) became minimum_image(FLERR,dx,dy,dz) after 4 Feb 2025

template <typename D>
auto minimum_image(D *domain, double &dx, double &dy, double &dz)
    -> decltype(domain->minimum_image(FLERR, dx, dy, dz))
{
  domain->minimum_image(FLERR, dx, dy, dz);
}

template <typename D>
auto minimum_image(D *domain, double &dx, double &dy, double &dz)
    -> decltype(domain->minimum_image(dx, dy, dz))
{
  domain->minimum_image(dx, dy, dz);
}

// all variables of an input, in LAMMPS's order

struct VariableName {
  std::string name, style;
};

std::vector<VariableName> variable_list(LAMMPS_NS::LAMMPS *);

}    // namespace HVI

#endif
