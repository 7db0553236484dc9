/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_INTERFACE_H
#define LMP_HVI_INTERFACE_H

#include "bond_hybrid.h"
#include "fix.h"    // IWYU pragma: keep
#include "force.h"
#include "modify.h"
#include "pair_hybrid.h"

#include <vector>

namespace HVI {

/* ----------------------------------------------------------------------
   Who implements an interface of ours is found by asking all pair styles,
   bond styles and fixes, those under hybrid too.  Nothing lists them.
------------------------------------------------------------------------- */

// hybrid styles show to friends and heirs only which of their styles acts on which types

class PairHybridParts : public LAMMPS_NS::PairHybrid {
 public:
  static std::vector<LAMMPS_NS::Pair *> styles_of(LAMMPS_NS::PairHybrid *hybrid)
  {
    LAMMPS_NS::Pair **const list = hybrid->*(&PairHybridParts::styles);
    return {list, list + hybrid->*(&PairHybridParts::nstyles)};
  }

  static bool acts(LAMMPS_NS::PairHybrid *hybrid, LAMMPS_NS::Pair *style, int itype, int jtype)
  {
    LAMMPS_NS::Pair **const list = hybrid->*(&PairHybridParts::styles);
    const int *const number = (hybrid->*(&PairHybridParts::map))[itype][jtype];
    const int n = (hybrid->*(&PairHybridParts::nmap))[itype][jtype];
    for (int m = 0; m < n; m++)
      if (list[number[m]] == style) return true;
    return false;
  }
};

class BondHybridParts : public LAMMPS_NS::BondHybrid {
 public:
  static bool acts(LAMMPS_NS::BondHybrid *hybrid, LAMMPS_NS::Bond *style, int btype)
  {
    const int number = (hybrid->*(&BondHybridParts::map))[btype];
    return number >= 0 && hybrid->styles[number] == style;
  }
};

// the pair style, or those under hybrid; likewise bond styles

inline std::vector<LAMMPS_NS::Pair *> pair_styles(const LAMMPS_NS::Force *force)
{
  if (!force->pair) return {};
  if (auto *hybrid = dynamic_cast<LAMMPS_NS::PairHybrid *>(force->pair))
    return PairHybridParts::styles_of(hybrid);
  return {force->pair};
}

inline std::vector<LAMMPS_NS::Bond *> bond_styles(const LAMMPS_NS::Force *force)
{
  if (!force->bond) return {};
  if (auto *hybrid = dynamic_cast<LAMMPS_NS::BondHybrid *>(force->bond))
    return {hybrid->styles, hybrid->styles + hybrid->nstyles};
  return {force->bond};
}

// does one of those act on particles of these types, on bonds of this type?

inline bool acts(const LAMMPS_NS::Force *force, LAMMPS_NS::Pair *pair, int itype, int jtype)
{
  if (pair == force->pair) return true;
  auto *hybrid = dynamic_cast<LAMMPS_NS::PairHybrid *>(force->pair);
  return hybrid && PairHybridParts::acts(hybrid, pair, itype, jtype);
}

inline bool acts(const LAMMPS_NS::Force *force, LAMMPS_NS::Bond *bond, int btype)
{
  if (bond == force->bond) return true;
  auto *hybrid = dynamic_cast<LAMMPS_NS::BondHybrid *>(force->bond);
  return hybrid && BondHybridParts::acts(hybrid, bond, btype);
}

// pair styles first, then bond styles, then fixes, each in the order of the input script

template <class T> std::vector<T *> find_interface(const LAMMPS_NS::LAMMPS *lmp)
{
  std::vector<T *> found;
  for (auto *pair : pair_styles(lmp->force))
    if (auto *one = dynamic_cast<T *>(pair)) found.push_back(one);
  for (auto *bond : bond_styles(lmp->force))
    if (auto *one = dynamic_cast<T *>(bond)) found.push_back(one);
  for (auto *fix : lmp->modify->get_fix_list())
    if (auto *one = dynamic_cast<T *>(fix)) found.push_back(one);
  return found;
}

}    // namespace HVI

#endif
