/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_STRENGTH_LAWS_H
#define LMP_HVI_STRENGTH_LAWS_H

#include "hvi_damage_johnson_cook.h"
#include "hvi_material.h"
#include "hvi_strength_cowper_symonds.h"
#include "hvi_strength_johnson_cook.h"
#include "hvi_strength_perfect.h"
#include "hvi_strength_steinberg_guinan.h"

#include <iterator>

namespace HVI {

/* ----------------------------------------------------------------------
   Laws from the sections of a material file.  Null, and in problem what is
   wrong, if the section has no such law, lacks a key or has a value out of
   range.  slow: see the law of Johnson and Cook; the others ignore it.
------------------------------------------------------------------------- */

template <int N>
std::string section_values(const Section &section, const Parameter (&params)[N], double (&v)[N])
{
  for (int i = 0; i < N; i++) {
    const auto found = section.values.find(params[i].key);
    if (found == section.values.end()) return std::string("missing key ") + params[i].key;
    v[i] = found->second;
    const std::string problem = value_problem(params[i].key, v[i], params[i].range);
    if (!problem.empty()) return problem;
  }
  return "";
}

// fills in the law; says what is wrong

template <class Law> std::string read_law(const Section &section, Law &law)
{
  double v[std::size(Law::params)];
  std::string problem = section_values(section, Law::params, v);
  if (problem.empty()) problem = Law::problem(v);
  if (problem.empty()) law = Law::make(v);
  return problem;
}

template <class Law>
std::unique_ptr<Strength> make_model(const Section &section, std::string &problem)
{
  Law law;
  problem = read_law(section, law);
  if (!problem.empty()) return nullptr;
  return std::make_unique<StrengthModel<Law>>(law);
}

inline std::unique_ptr<Strength> make_no_strength()
{
  return std::make_unique<StrengthModel<StrengthNone>>(StrengthNone());
}

inline std::unique_ptr<Strength> make_strength(const Section &section, std::string &problem,
                                               bool slow = false)
{
  problem.clear();
  if (section.kind == "strength") {
    if (section.law == StrengthJohnsonCook::name) {
      StrengthJohnsonCook law;
      problem = read_law(section, law);
      if (!problem.empty()) return nullptr;
      law.slow = slow;
      return std::make_unique<StrengthModel<StrengthJohnsonCook>>(law);
    }
    if (section.law == StrengthSteinbergGuinan::name)
      return make_model<StrengthSteinbergGuinan>(section, problem);
    if (section.law == StrengthCowperSymonds::name)
      return make_model<StrengthCowperSymonds>(section, problem);
    if (section.law == StrengthPerfect::name) return make_model<StrengthPerfect>(section, problem);
    if (section.law == StrengthNone::name) return make_no_strength();
  }
  problem = section.kind + " " + section.law + " is no law of strength";
  return nullptr;
}

inline std::unique_ptr<DamageJohnsonCook> make_damage(const Section &section, std::string &problem)
{
  problem.clear();
  DamageJohnsonCook law;
  if (section.kind == "damage" && section.law == DamageJohnsonCook::name)
    problem = read_law(section, law);
  else
    problem = section.kind + " " + section.law + " is no law of damage";
  if (!problem.empty()) return nullptr;
  return std::make_unique<DamageJohnsonCook>(law);
}

}    // namespace HVI

#endif
