/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_LAWS_H
#define LMP_HVI_LAWS_H

#include "hvi_damage.h"
#include "hvi_section.h"
#include "hvi_spall_grady.h"
#include "hvi_spall_tuler_butcher.h"
#include "hvi_spall_voids.h"
#include "hvi_strength.h"

#include <memory>
#include <string>

namespace HVI {

/* ----------------------------------------------------------------------
   The laws of strength, damage, spall and heat that sections of material files
   may name.  Their only list is in hvi_laws.cpp: a new law is its header, its entry
   there, its tests and its lines in the documentation.
------------------------------------------------------------------------- */

struct LawEntry {
  const char *kind, *name;
  int nparams;
  const Parameter *params;
  std::string (*problem)(const double *);                   // of values that are right one by one
  std::unique_ptr<Strength> (*strength)(const double *);    // null: of another kind
  std::unique_ptr<Damage> (*damage)(const double *);
};

const LawEntry *find_law(const std::string &kind, const std::string &name);    // null: unknown
bool is_kind_of_law(const std::string &);
std::string kinds_of_laws();                       // "strength, damage, ..."
std::string law_names(const std::string &kind);    // "johnson-cook, ..."

// Laws from the sections of a material file.  Null, and in problem what is wrong, if the section has
// no such law, lacks a key or has a value out of range.

std::unique_ptr<Strength> make_strength(const Section &, std::string &problem);
std::unique_ptr<Damage> make_damage(const Section &, std::string &problem);

// a law of spall that is a plain struct, likewise; false if something is wrong

template <class Law> bool make_spall(const Section &, Law &, std::string &problem);

}    // namespace HVI

#endif
