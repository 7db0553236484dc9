/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#include "hvi_eos.h"

#include "hvi_eos_gruneisen.h"
#include "hvi_eos_idealgas.h"
#include "hvi_eos_linear.h"
#include "hvi_eos_mie_gruneisen.h"
#include "hvi_eos_polynomial.h"
#include "hvi_eos_tait.h"
#include "hvi_eos_tillotson.h"

namespace HVI {

namespace {

  // the only list of equations of state with parameters

  struct Entry {
    const char *name;
    int nargs, nparams;
    const Parameter *params;
    std::string (*problem)(const double *);
    std::unique_ptr<Eos> (*make)(const double *);
  };

  // what a law has against parameters that are right one by one, if it looks at them together

  template <class Law> auto together(const double *v, int) -> decltype(Law::problem(v))
  {
    return Law::problem(v);
  }
  template <class Law> std::string together(const double *, long)
  {
    return "";
  }

  template <class Law> constexpr Entry entry()
  {
    return {Law::name,
            Law::nargs,
            int(std::size(Law::params)),
            Law::params,
            [](const double *v) {
              return together<Law>(v, 0);
            },
            [](const double *v) -> std::unique_ptr<Eos> {
              return std::make_unique<EosModel<Law>>(Law::make(v));
            }};
  }

  constexpr Entry entries[] = {
      entry<EosLinear>(),       entry<EosTait>(),       entry<EosIdealGas>(), entry<EosGruneisen>(),
      entry<EosMieGruneisen>(), entry<EosPolynomial>(), entry<EosTillotson>()};

  const Entry *find(const std::string &name)
  {
    for (const Entry &e : entries)
      if (name == e.name) return &e;
    return nullptr;
  }
}    // namespace

std::string eos_names()
{
  std::string names;
  for (const Entry &e : entries) names += std::string(e.name) + ", ";
  return names + EOS_TABLE;
}

int eos_nargs(const std::string &name)
{
  const Entry *e = find(name);
  return e ? e->nargs : -1;
}

std::string eos_args(const std::string &name)
{
  const Entry *e = find(name);
  std::string args;
  for (int i = 0; e && i < e->nargs; i++) args += (i ? " " : "") + std::string(e->params[i].key);
  return args;
}

const Parameter *eos_params(const std::string &name, int &n)
{
  const Entry *e = find(name);
  n = e ? e->nparams : 0;
  return e ? e->params : nullptr;
}

/* ---------------------------------------------------------------------- */

std::unique_ptr<Eos> make_eos_full(const std::string &name, const std::vector<double> &values,
                                   std::string &problem)
{
  problem.clear();
  const Entry *e = find(name);
  if (!e) {
    problem = "unknown equation of state " + name + "; known are " + eos_names();
    return nullptr;
  }
  if (int(values.size()) != e->nparams) {
    problem =
        "has " + std::to_string(e->nparams) + " parameters, not " + std::to_string(values.size());
    return nullptr;
  }
  for (int i = 0; i < e->nparams; i++) {
    problem = value_problem(e->params[i].key, values[i], e->params[i].range);
    if (!problem.empty()) return nullptr;
  }
  problem = e->problem(values.data());
  if (!problem.empty()) return nullptr;
  return e->make(values.data());
}

std::unique_ptr<Eos> make_eos(const std::string &name, const std::vector<double> &args,
                              std::string &problem)
{
  problem.clear();
  const Entry *e = find(name);
  if (e && int(args.size()) != e->nargs) {
    problem = "takes " + std::to_string(e->nargs) + " values (" + eos_args(name) + "), not " +
        std::to_string(args.size());
    return nullptr;
  }
  std::vector<double> values = args;
  for (int i = e ? e->nargs : 0; e && i < e->nparams; i++) values.push_back(e->params[i].preset);
  return make_eos_full(name, values, problem);
}

}    // namespace HVI
