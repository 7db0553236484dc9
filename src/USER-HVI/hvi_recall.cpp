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
#include "library.h"
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

/* ---------------------------------------------------------------------- */

void HVIRecall::command(int narg, char **arg)
{
  if (narg < 2) utils::missing_cmd_args(FLERR, "hvi/recall", error);
  const std::string word = arg[0];
  const std::vector<std::string> rest(arg + 2, arg + narg);

  if (word == "write") {
    if (!rest.empty() && rest[0] != "except")
      error->all(FLERR, "hvi/recall write: unknown keyword {}", rest[0]);
    write(arg[1], {rest.begin() + (rest.empty() ? 0 : 1), rest.end()});
    return;
  }
  if (word != "variable")
    error->all(FLERR, "hvi/recall: must be followed by write or variable, not {}", word);
  if (rest.empty()) utils::missing_cmd_args(FLERR, "hvi/recall variable", error);

  const std::string name = arg[1];
  if (input->variable->find(name.c_str()) < 0) {
    define(name, rest);
    return;
  }
  if (!is_in(names(), name))
    error->all(FLERR, "hvi/recall: variable {} is not of style index", name);
  const auto now = values(name);
  if (now != rest)
    error->all(FLERR,
               "This run cannot be gone on with, for a variable has changed: {} was '{}', and is "
               "'{}' now; leave it out, or start anew",
               name, joined(rest), joined(now));
}

/* ----------------------------------------------------------------------
   LAMMPS tells styles of variables in text only:
   Variable[  0]: dx,                style = index,            def = 0.4
------------------------------------------------------------------------- */

std::vector<std::string> HVIRecall::names() const
{
  std::vector<std::string> list;
  char text[512];
  for (int i = 0; lammps_variable_info(lmp, i, text, sizeof(text)) == 1; i++) {
    text[sizeof(text) - 1] = '\0';
    const std::string info = text;
    const size_t from = info.find("]: "), to = info.find(','), style = info.find("style = index,");
    if (from < to && to < style && style != std::string::npos)
      list.push_back(info.substr(from + 3, to - from - 3));
  }
  return list;
}

/* ----------------------------------------------------------------------
   and values of a list one by one: it is gone through, which removes it, and
   made again
------------------------------------------------------------------------- */

std::vector<std::string> HVIRecall::values(const std::string &name) const
{
  std::vector<std::string> list;
  std::string copy = name;
  char *arg = &copy[0];
  do list.emplace_back(input->variable->retrieve(arg));
  while (input->variable->next(1, &arg) == 0);
  define(name, list);
  return list;
}

/* ---------------------------------------------------------------------- */

void HVIRecall::define(const std::string &name, const std::vector<std::string> &list) const
{
  std::vector<std::string> words = {name, "index"};
  words.insert(words.end(), list.begin(), list.end());
  std::vector<char *> arg;
  for (auto &word : words) arg.push_back(&word[0]);
  input->variable->set(static_cast<int>(arg.size()), arg.data());
}

/* ---------------------------------------------------------------------- */

void HVIRecall::write(const std::string &file, const std::vector<std::string> &except) const
{
  std::string text = "# variables of this run, by hvi/recall write\n";
  for (const auto &name : names()) {
    if (is_in(except, name)) continue;
    text += "hvi/recall variable " + name;
    for (const auto &value : values(name)) {
      const char *quote = value.find('"') == std::string::npos ? "\"" : "'";
      if (value.find('"') != std::string::npos && value.find('\'') != std::string::npos)
        quote = "\"\"\"";
      text += " " + (quote + value) + quote;
    }
    text += "\n";
  }
  if (comm->me != 0) return;
  FILE *fp = fopen(file.c_str(), "w");
  bool whole = fp && fputs(text.c_str(), fp) >= 0;
  if (fp && fclose(fp) != 0) whole = false;
  if (!whole) error->one(FLERR, "hvi/recall: cannot write file {}: {}", file, utils::getsyserror());
}
