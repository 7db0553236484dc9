/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "hvi_recall.h"

#include "comm.h"
#include "error.h"
#include "input.h"
#include "variable.h"

#include <algorithm>
#include <cstdio>

using namespace LAMMPS_NS;

static bool is_in(const std::vector<std::string> &list, const std::string &name)
{
  return std::find(list.begin(), list.end(), name) != list.end();
}

static std::string joined(const std::vector<std::string> &list)
{
  std::string text;
  for (const auto &value : list) text += (text.empty() ? "" : " ") + value;
  return text;
}

// as a word of an input

static std::string quoted(const std::string &value)
{
  const bool more = value.find('\n') != std::string::npos;
  if (!more && value.find('"') == std::string::npos) return "\"" + value + "\"";
  if (!more && value.find('\'') == std::string::npos) return "'" + value + "'";
  return "\"\"\"" + value + "\"\"\"";
}

/* ---------------------------------------------------------------------- */

void HVIRecall::command(int narg, char **arg)
{
  if (narg < 2) utils::missing_cmd_args(FLERR, "hvi/recall", error);
  const std::string word = arg[0];
  std::vector<std::string> rest(arg + 2, arg + narg);

  if (word == "variable") {
    if (rest.empty()) utils::missing_cmd_args(FLERR, "hvi/recall variable", error);
    recall(arg[1], rest);
  } else if (word == "given" || word == "state") {
    if (!rest.empty()) {
      if (rest[0] != "except")
        error->all(FLERR, "hvi/recall {}: unknown keyword {}", word, rest[0]);
      rest.erase(rest.begin());
    }
    write(arg[1], word == "given" ? given(rest) : state(rest));
  } else
    error->all(FLERR, "hvi/recall: must be followed by given, state or variable, not {}", word);
}

/* ---------------------------------------------------------------------- */

HVI::VariableText HVIRecall::index_variable(const std::string &name) const
{
  for (const auto &variable : HVI::variable_list(lmp))
    if (variable.name == name && variable.style == "index") return variable;
  error->all(FLERR, "hvi/recall: variable {} is not of style index", name);
  return {};
}

/* ---------------------------------------------------------------------- */

void HVIRecall::recall(const std::string &name, const std::vector<std::string> &was) const
{
  if (input->variable->find(name.c_str()) < 0) {
    std::vector<std::string> words = {name, "index"};
    words.insert(words.end(), was.begin(), was.end());
    std::vector<char *> arg;
    for (auto &word : words) arg.push_back(&word[0]);
    input->variable->set(static_cast<int>(arg.size()), arg.data());
    return;
  }
  const auto now = index_variable(name).values;
  if (now != was)
    error->all(FLERR,
               "This run cannot be gone on with, for a variable has changed: {} was '{}', and is "
               "'{}' now; leave it out, or start anew",
               name, joined(was), joined(now));
}

/* ---------------------------------------------------------------------- */

std::string HVIRecall::given(const std::vector<std::string> &except) const
{
  std::string text = "# variables that this run was given, by hvi/recall given\n";
  for (const auto &variable : HVI::variable_list(lmp)) {
    if (variable.style != "index" || is_in(except, variable.name)) continue;
    text += "hvi/recall variable " + variable.name;
    for (const auto &value : variable.values) text += " " + quoted(value);
    text += "\n";
  }
  return text;
}

/* ---------------------------------------------------------------------- */

std::string HVIRecall::state(const std::vector<std::string> &except) const
{
  std::string text = "# variables of this run as they are, by hvi/recall state\n";
  for (const auto &variable : HVI::variable_list(lmp)) {
    const std::string &name = variable.name;
    if (is_in(except, name)) continue;
    if (variable.style == "index") {
      text += "variable " + name + " delete\nvariable " + name + " index";
      for (const auto &value : variable.values) text += " " + quoted(value);
      text += "\n";
    } else if (variable.style == "string" || variable.style == "equal") {
      text += "variable " + name + " " + variable.style + " " + quoted(variable.values[0]) + "\n";
    }
  }
  return text;
}

/* ----------------------------------------------------------------------
   under its name the file is whole: the one before, or this
------------------------------------------------------------------------- */

void HVIRecall::write(const std::string &file, const std::string &text) const
{
  if (comm->me != 0) return;
  const std::string part = file + ".part";
  FILE *fp = fopen(part.c_str(), "w");
  bool whole = fp && fputs(text.c_str(), fp) >= 0;
  if (fp && fclose(fp) != 0) whole = false;
  if (!whole || rename(part.c_str(), file.c_str()) != 0)
    error->one(FLERR, "hvi/recall: cannot write file {}: {}", file, utils::getsyserror());
}
