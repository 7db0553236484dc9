/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "hvi_torn.h"

#include "atom.h"
#include "hvi_energy_carrier.h"
#include "hvi_interface.h"

#include <algorithm>

using namespace LAMMPS_NS;

using HVI::EnergyCarrier;

/* ---------------------------------------------------------------------- */

HVITorn::HVITorn(LAMMPS *lmp) : Pointers(lmp)
{
  find_pairs();
  find_bonds();
}

/* ----------------------------------------------------------------------
   sub-styles of hybrid and hybrid/overlay act as they would alone
------------------------------------------------------------------------- */

void HVITorn::find_pairs()
{
  const auto styles = HVI::pair_styles(force);
  weighs = atom->molecular != Atom::ATOMIC && atom->nbonds > 0 &&
      !std::all_of(force->special_lj + 1, force->special_lj + 4, [](double w) {
             return w == 1.0;
           });
  for (auto *carrier : HVI::find_interface<EnergyCarrier>(lmp))
    if (!dynamic_cast<Pair *>(carrier)) pairs.push_back({carrier, nullptr});
  if (styles.empty()) return;

  // hybrid/scaled scales them, which its own single() knows; hybrid/molecular looks at molecules

  if (utils::strmatch(force->pair_style, "^hybrid/scaled")) {
    if (needs_types_only(force->pair))
      pairs.push_back({nullptr, force->pair});
    else
      names.emplace_back(force->pair_style);
    return;
  }
  if (utils::strmatch(force->pair_style, "^hybrid/molecular")) {
    names.emplace_back(force->pair_style);
    return;
  }

  for (auto *pair : styles) {
    const char *const name = force->pair_match_ptr(pair);
    auto *const carrier = dynamic_cast<EnergyCarrier *>(pair);
    if (carrier && weighs && has_energy(*carrier))
      names.emplace_back(name);
    else if (carrier)
      pairs.push_back({carrier, pair});
    else if (needs_types_only(pair))
      pairs.push_back({nullptr, pair});
    else if (!utils::strmatch(name, "^sph/"))    // those have no energy of pairs
      names.emplace_back(name);
  }
}

// of pairs

bool HVITorn::has_energy(const EnergyCarrier &carrier) const
{
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++)
      if (carrier.pair_cutsq(i, j) > 0.0) return true;
  return false;
}

/* ----------------------------------------------------------------------
   What single() reads is not to be known, so none of the data may be there
   that those of LAMMPS's styles read: charge, dipole, radius, ..., or what a
   pair style keeps of its particles and neighbors.
------------------------------------------------------------------------- */

bool HVITorn::needs_types_only(Pair *pair) const
{
  if (weighs) return false;
  // a pair style that is there: no carrier is no null
  // NOLINTNEXTLINE(clang-analyzer-core.NullDereference)
  if (!pair->single_enable || pair->manybody_flag || pair->single_extra || pair->nextra)
    return false;
  return !(atom->q_flag || atom->mu_flag || atom->radius_flag || atom->vfrac_flag ||
           atom->ellipsoid_flag || atom->edpd_flag || atom->rheo_status_flag);
}

/* ---------------------------------------------------------------------- */

void HVITorn::find_bonds()
{
  if (!force->bond) return;
  bonds.resize(atom->nbondtypes + 1, {nullptr, nullptr});

  auto *const hybrid = dynamic_cast<BondHybrid *>(force->bond);
  const auto styles = HVI::bond_styles(force);
  for (size_t k = 0; k < styles.size(); k++) {
    const char *const name = hybrid ? hybrid->keywords[k] : force->bond_style;
    auto *const carrier = dynamic_cast<EnergyCarrier *>(styles[k]);

    // those that break keep their own records; the others read types or old positions

    const bool types_only = !styles[k]->partial_flag && !utils::strmatch(name, "^special") &&
        !utils::strmatch(name, "^harmonic/restrain");
    if (!carrier && !types_only) {
      names.emplace_back(name);
      continue;
    }
    for (int btype = 1; btype <= atom->nbondtypes; btype++)
      if (HVI::acts(force, styles[k], btype)) bonds[btype] = {carrier, styles[k]};
  }
}

/* ---------------------------------------------------------------------- */

double HVITorn::cutsq(const PairSource &s, int itype, int jtype) const
{
  if (s.pair && !HVI::acts(force, s.pair, itype, jtype)) return 0.0;
  // without a carrier there is a pair style: find_pairs()
  // NOLINTNEXTLINE(clang-analyzer-core.NullDereference)
  return s.carrier ? s.carrier->pair_cutsq(itype, jtype) : s.pair->cutsq[itype][jtype];
}

bool HVITorn::has_pairs() const
{
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = 1; j <= atom->ntypes; j++)
      if (pair_cutsq(i, j) > 0.0) return true;
  return false;
}

double HVITorn::pair_cutsq(int itype, int jtype) const
{
  double largest = 0.0;
  for (const PairSource &s : pairs) largest = std::max(largest, cutsq(s, itype, jtype));
  return largest;
}

/* ---------------------------------------------------------------------- */

double HVITorn::pair(int itype, int jtype, double rsq, double &fforce) const
{
  double energy = 0.0;
  fforce = 0.0;
  for (const PairSource &s : pairs) {
    if (rsq >= cutsq(s, itype, jtype)) continue;
    double fone = 0.0;
    energy += s.carrier ? s.carrier->pair_energy(itype, jtype, rsq, fone)
                        : s.pair->single(0, 0, itype, jtype, rsq, 1.0, 1.0, fone);
    fforce += fone;
  }
  return energy;
}

/* ---------------------------------------------------------------------- */

double HVITorn::bond(int btype, double rsq, double &fforce) const
{
  const BondSource &s = bonds[btype];
  fforce = 0.0;
  if (s.carrier) return s.carrier->bond_energy(btype, rsq, fforce);
  return s.bond ? s.bond->single(btype, rsq, 0, 0, fforce) : 0.0;
}
