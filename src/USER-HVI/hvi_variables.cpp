/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing author: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "hvi_variables.h"

#include "error.h"
#include "hvi_compat.h"
#include "input.h"
#include "variable.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

using namespace LAMMPS_NS;

/* ----------------------------------------------------------------------
   edits from one word to another: letters put in, taken out, changed
   (Levenshtein 1966)
------------------------------------------------------------------------- */

static int edits(const std::string &a, const std::string &b)
{
  std::vector<int> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); i++) {
    int diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); j++) {
      const int change = diagonal + (a[i] != b[j]);
      diagonal = row[j + 1];
      row[j + 1] = std::min({change, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

/* ---------------------------------------------------------------------- */

void HVIVariables::command(int narg, char **arg)
{
  if (narg > 1 && std::string(arg[0]) == "positive") {
    for (int i = 1; i < narg; i++) {
      const char *const given = input->variable->retrieve(arg[i]);
      const std::string value = given ? given : "";
      if (!given) error->all(FLERR, "hvi/variables positive: variable {} is not defined", arg[i]);
      if (!utils::is_double(value) || !(utils::numeric(FLERR, value, false, lmp) > 0.0))
        error->all(FLERR, "Variable {} must be a number above 0, not {}", arg[i], value);
    }
    return;
  }
  if (narg < 2 || std::string(arg[0]) != "known")
    error->all(FLERR,
               "Illegal hvi/variables command: it is hvi/variables known NAMES optional NAMES, or "
               "hvi/variables positive NAMES");

  std::vector<std::string> names;
  bool optional = false;
  for (int i = 1; i < narg; i++) {
    const std::string name = arg[i];
    if (name == "optional" && !optional) {
      optional = true;
      continue;
    }
    if (std::find(names.begin(), names.end(), name) != names.end())
      error->all(FLERR, "hvi/variables names {} twice", name);
    if (!optional && input->variable->find(arg[i]) < 0)
      error->all(
          FLERR,
          "hvi/variables: variable {} is not defined: define it before this command, or name "
          "it after optional",
          name);
    names.push_back(name);
  }

  if (names.empty()) utils::missing_cmd_args(FLERR, "hvi/variables", error);

  for (const auto &variable : HVI::variable_list(lmp)) {
    const std::string &given = variable.name;
    if (variable.style != "index") continue;
    if (std::find(names.begin(), names.end(), given) != names.end()) continue;
    auto nearer = [&given](const std::string &a, const std::string &b) {
      return edits(a, given) < edits(b, given);
    };
    const std::string near = *std::min_element(names.begin(), names.end(), nearer);
    const bool likely = 3 * edits(near, given) <= (int) std::max(given.size(), near.size());
    std::string all;
    for (const std::string &name : names) all += " " + name;
    error->all(FLERR, "Unknown variable {}{} This input knows:{}", given,
               likely ? ": did you mean " + near + "?" : ".", all);
  }
}
