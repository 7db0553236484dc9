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
   LAMMPS has no public way to the style of each variable.  What class Info shows of
   variables is no way: of those of style timer it reads memory that nobody has written.
------------------------------------------------------------------------- */

namespace {

// 4 Feb 2025: a private array, beside public names.  Where LAMMPS has none, NoArray stands for it.

struct NoArray {
  int *style;
};

template <typename V, typename = void> struct Having {
  using type = NoArray;
};
template <typename V> struct Having<V, decltype(void(&V::names))> {
  using type = V;
};
using Array = Having<Variable>::type;

const int *styles(const Array &);

// explicit instantiations may name private members (C++17, [temp.explicit])

template <auto STYLE> struct Open {
  friend const int *styles(const Array &a) { return a.*STYLE; }
};
template struct Open<&Array::style>;

// 4 Jul 2026: protected structs

template <typename V> struct OpenStructs : V {
  static const auto &of(const V &variable) { return variable.*(&OpenStructs::variables); }
};

/* ---------------------------------------------------------------------- */

template <typename V>
auto list_of(const V &variable) -> decltype(variable.names, std::vector<VariableName>())
{
  std::vector<VariableName> list;
  for (int i = 0; i < variable.nvar; i++)
    list.push_back({variable.names[i], V::varstyles[styles(variable)[i]]});
  return list;
}

template <typename V>
auto list_of(const V &variable) -> decltype(variable.get_style(0), std::vector<VariableName>())
{
  std::vector<VariableName> list;
  for (int i = 0; i < variable.get_nvar(); i++)
    if (variable.get_style(i))    // else deleted
      list.push_back({OpenStructs<V>::of(variable)[i].name, variable.get_style(i)});
  return list;
}

}    // namespace

/* ---------------------------------------------------------------------- */

std::vector<VariableName> HVI::variable_list(LAMMPS_NS::LAMMPS *lmp)
{
  return list_of(*lmp->input->variable);
}
