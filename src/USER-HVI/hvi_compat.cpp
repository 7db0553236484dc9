/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "hvi_compat.h"

#include "input.h"
#include "variable.h"

using namespace HVI;
using LAMMPS_NS::Variable;

/* ----------------------------------------------------------------------
   LAMMPS has no public way to formulas, nor to what is left of a list.  What
   class Info shows of variables is no way: of those of style timer it reads
   memory that nobody has written.
------------------------------------------------------------------------- */

namespace {

// 4 Feb 2025: private arrays, with public names.  Where LAMMPS has none, NoArrays stands for them.

struct NoArrays {
  int *style, *num, *which;
  char ***data;
};

template <typename V, typename = void> struct Having {
  using type = NoArrays;
};
template <typename V> struct Having<V, decltype(void(&V::names))> {
  using type = V;
};
using Arrays = Having<Variable>::type;

NoArrays arrays(const Arrays &);

// explicit instantiations may name private members (C++17, [temp.explicit])

template <auto STYLE, auto NUM, auto WHICH, auto DATA> struct Open {
  friend NoArrays arrays(const Arrays &a) { return {a.*STYLE, a.*NUM, a.*WHICH, a.*DATA}; }
};
template struct Open<&Arrays::style, &Arrays::num, &Arrays::which, &Arrays::data>;

// 4 Jul 2026: protected structs

template <typename V> struct OpenStructs : V {
  static const auto &of(const V &variable) { return variable.*(&OpenStructs::variables); }
};

/* ---------------------------------------------------------------------- */

VariableText text(const char *name, const std::string &style, int num, int which, char **data)
{
  VariableText one = {name, style, {}};
  if (style == "index") one.values.assign(data + which, data + num);
  if (style == "string" || style == "equal") one.values.assign(data, data + 1);
  return one;
}

template <typename V>
auto list_of(const V &variable) -> decltype(variable.names, std::vector<VariableText>())
{
  const auto a = arrays(variable);
  std::vector<VariableText> list;
  for (int i = 0; i < variable.nvar; i++)
    list.push_back(
        text(variable.names[i], V::varstyles[a.style[i]], a.num[i], a.which[i], a.data[i]));
  return list;
}

template <typename V>
auto list_of(const V &variable) -> decltype(variable.get_style(0), std::vector<VariableText>())
{
  std::vector<VariableText> list;
  for (int i = 0; i < variable.get_nvar(); i++) {
    if (!variable.get_style(i)) continue;    // deleted
    const auto &v = OpenStructs<V>::of(variable)[i];
    list.push_back(text(v.name.c_str(), variable.get_style(i), v.num, v.which, v.data));
  }
  return list;
}

}    // namespace

/* ---------------------------------------------------------------------- */

std::vector<VariableText> HVI::variable_list(LAMMPS_NS::LAMMPS *lmp)
{
  return list_of(*lmp->input->variable);
}
