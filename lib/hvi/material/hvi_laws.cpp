/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#include "hvi_laws.h"

#include "hvi_damage_johnson_cook.h"
#include "hvi_strength_cowper_symonds.h"
#include "hvi_strength_johnson_cook.h"
#include "hvi_strength_model.h"
#include "hvi_strength_perfect.h"
#include "hvi_strength_steinberg_guinan.h"
#include "hvi_strength_zerilli_armstrong.h"

#include <iterator>
#include <vector>

namespace HVI {

namespace {

  // ---------------------------------------------------------------------- laws that are numbers only

  // the tension, of pressure or of the largest principal stress, that the material bears

  struct SpallLimit {
    static constexpr const char *name = "limit";
    static constexpr Parameter params[] = {{"sigma_p", PRESSURE, POSITIVE, REQUIRED}};
  };

  // fraction of the plastic work that heats (Taylor & Quinney)

  struct ThermalWork {
    static constexpr const char *name = "work";
    static constexpr Parameter params[] = {{"chi", NUMBER, FRACTION, REQUIRED}};
  };

  // ---------------------------------------------------------------------- entries

  // what a law has against values that are right one by one, if it looks at them together

  template <class Law> auto together(const double *v, int) -> decltype(Law::problem(v))
  {
    return Law::problem(v);
  }
  template <class Law> std::string together(const double *, long)
  {
    return "";
  }

  template <class Law> constexpr LawEntry numbers(const char *kind)
  {
    return {kind,
            Law::name,
            int(std::size(Law::params)),
            std::data(Law::params),
            [](const double *v) {
              return together<Law>(v, 0);
            },
            nullptr,
            nullptr};
  }

  template <class Law> constexpr LawEntry strength()
  {
    LawEntry e = numbers<Law>("strength");
    e.strength = [](const double *v) -> std::unique_ptr<Strength> {
      return std::make_unique<StrengthModel<Law>>(Law::make(v));
    };
    return e;
  }

  template <class Law> constexpr LawEntry damage()
  {
    LawEntry e = numbers<Law>("damage");
    e.damage = [](const double *v) -> std::unique_ptr<Damage> {
      return std::make_unique<DamageModel<Law>>(Law::make(v));
    };
    return e;
  }

  // the only list of laws beside that of hvi_eos.cpp, those of a kind together

  constexpr LawEntry LAWS[] = {
      strength<StrengthJohnsonCook>(),   strength<StrengthSteinbergGuinan>(),
      strength<StrengthCowperSymonds>(), strength<StrengthZerilliArmstrong>(),
      strength<StrengthPerfect>(),       strength<StrengthNone>(),
      damage<DamageJohnsonCook>(),       numbers<SpallLimit>("spall"),
      numbers<SpallVoids>("spall"),      numbers<SpallTulerButcher>("spall"),
      numbers<SpallGrady>("spall"),      numbers<ThermalWork>("thermal"),
  };

  // the law of a section of the given kind and the values of its parameters; null if something is wrong

  const LawEntry *read_law(const std::string &kind, const Section &section,
                           std::vector<double> &values, std::string &problem)
  {
    problem.clear();
    const LawEntry *const law = section.kind == kind ? find_law(kind, section.law) : nullptr;
    if (!law) {
      problem = section.kind + " " + section.law + " is no law of " + kind;
      return nullptr;
    }
    for (int i = 0; i < law->nparams && problem.empty(); i++) {
      const Parameter &par = law->params[i];
      const auto found = section.values.find(par.key);
      if (found == section.values.end())
        problem = std::string("missing key ") + par.key;
      else {
        values.push_back(found->second);
        problem = value_problem(par.key, found->second, par.range);
      }
    }
    if (problem.empty()) problem = law->problem(values.data());
    return problem.empty() ? law : nullptr;
  }
}    // namespace

/* ---------------------------------------------------------------------- */

const LawEntry *find_law(const std::string &kind, const std::string &name)
{
  for (const LawEntry &law : LAWS)
    if (kind == law.kind && name == law.name) return &law;
  return nullptr;
}

bool is_kind_of_law(const std::string &word)
{
  for (const LawEntry &law : LAWS)
    if (word == law.kind) return true;
  return false;
}

std::string kinds_of_laws()
{
  std::string kinds, last;
  for (const LawEntry &law : LAWS) {
    if (last == law.kind) continue;
    last = law.kind;
    kinds += (kinds.empty() ? "" : ", ") + last;
  }
  return kinds;
}

std::string law_names(const std::string &kind)
{
  std::string names;
  for (const LawEntry &law : LAWS)
    if (kind == law.kind) names += (names.empty() ? "" : ", ") + std::string(law.name);
  return names;
}

/* ---------------------------------------------------------------------- */

std::unique_ptr<Strength> make_strength(const Section &section, std::string &problem)
{
  std::vector<double> values;
  const LawEntry *const law = read_law("strength", section, values, problem);
  return law ? law->strength(values.data()) : nullptr;
}

std::unique_ptr<Damage> make_damage(const Section &section, std::string &problem)
{
  std::vector<double> values;
  const LawEntry *const law = read_law("damage", section, values, problem);
  return law ? law->damage(values.data()) : nullptr;
}

template <class Law> bool make_spall(const Section &section, Law &law, std::string &problem)
{
  std::vector<double> values;
  const bool good = read_law("spall", section, values, problem);
  if (good) law = Law::make(values.data());
  return good;
}

template bool make_spall(const Section &, SpallVoids &, std::string &);
template bool make_spall(const Section &, SpallTulerButcher &, std::string &);
template bool make_spall(const Section &, SpallGrady &, std::string &);

}    // namespace HVI
