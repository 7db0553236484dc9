/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "fix_hvi_johnson_cook.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix_hvi_store.h"
#include "force.h"
#include "hvi_material.h"
#include "hvi_vector.h"
#include "memory.h"
#include "modify.h"

#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

FixHVIJohnsonCook::FixHVIJohnsonCook(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), solid(nullptr), store(nullptr), fresh(true),
    state_rows(lmp, id, "Sxx Syy Szz Sxy Sxz Syz eps damage spalled heat"),
    force_rows(lmp, std::string(id) + "_forces",
               "Sxx Syy Szz Sxy Sxz Syz p_min shear_then shear rate")
{
  std::string spall_name = "principal";
  int iarg = 3;
  while (iarg < narg) {
    const std::string key = arg[iarg];
    const int nvalues = key == "weibull" ? 2 : 1;
    if (iarg + nvalues >= narg)
      utils::missing_cmd_args(FLERR, fmt::format("fix hvi/johnson-cook {}", key), error);
    const std::string value = arg[iarg + 1];
    if (key == "strength") {
      options.strength = value;
    } else if (key == "damage") {
      options.damage = utils::logical(FLERR, value, false, lmp);
    } else if (key == "thermal") {
      options.thermal = utils::logical(FLERR, value, false, lmp);
    } else if (key == "temperature") {
      if (value != "energy" && value != "work")
        error->all(FLERR, "Fix hvi/johnson-cook temperature must be energy or work, not {}", value);
      options.from_work = value == "work";
    } else if (key == "spall") {
      spall_name = value;
      if (value == "none")
        options.spall = HVI::Spall::NONE;
      else if (value == "pressure")
        options.spall = HVI::Spall::PRESSURE;
      else if (value == "principal")
        options.spall = HVI::Spall::PRINCIPAL;
      else if (value == "zero")
        options.spall = HVI::Spall::ZERO;
      else
        error->all(FLERR,
                   "Fix hvi/johnson-cook spall must be none, pressure, principal or zero, not {}",
                   value);
    } else if (key == "weibull") {
      options.weibull = utils::numeric(FLERR, value, false, lmp);
      options.seed = utils::inumeric(FLERR, arg[iarg + 2], false, lmp);
      if (!(options.weibull >= 0.01 &&
            std::isfinite(options.weibull)))    // Gamma(1 + 1/modulus) is finite
        error->all(FLERR, "Fix hvi/johnson-cook weibull modulus must be 0.01 or more, not {}",
                   value);
      if (options.seed <= 0)
        error->all(FLERR, "Fix hvi/johnson-cook weibull seed must be > 0, not {}", arg[iarg + 2]);
    } else
      error->all(FLERR, "Unknown fix hvi/johnson-cook keyword: {}", key);
    iarg += 1 + nvalues;
  }
  if (options.weibull > 0.0 && !options.damage)
    error->all(FLERR, "Fix hvi/johnson-cook weibull scatters damage: it needs damage yes");
  if (options.weibull > 0.0 && !atom->tag_enable)
    error->all(FLERR, "Fix hvi/johnson-cook weibull needs IDs of particles");

  text = fmt::format("strength {} damage {} spall {} temperature {} thermal {}", options.strength,
                     options.damage ? "yes" : "no", spall_name,
                     options.from_work ? "work" : "energy", options.thermal ? "yes" : "no");
  if (options.weibull > 0.0) text += fmt::format(" weibull {} {}", options.weibull, options.seed);

  restart_global = 1;
  restart_peratom = 1;
  maxexchange = NSOLID;
  create_attribute = 1;
  wd_section = 2;

  FixHVIJohnsonCook::grow_arrays(atom->nmax);
  for (int i = 0; i < atom->nlocal; i++) FixHVIJohnsonCook::set_arrays(i);
  atom->add_callback(Atom::GROW);
  atom->add_callback(Atom::RESTART);
}

/* ---------------------------------------------------------------------- */

FixHVIJohnsonCook::~FixHVIJohnsonCook()
{
  atom->delete_callback(id, Atom::GROW);
  atom->delete_callback(id, Atom::RESTART);
  memory->sfree(solid);
}

/* ---------------------------------------------------------------------- */

FixHVIJohnsonCook *FixHVIJohnsonCook::find(LAMMPS *lmp)
{
  const auto fixes = lmp->modify->get_fix_by_style("^hvi/johnson-cook$");
  return fixes.empty() ? nullptr : dynamic_cast<FixHVIJohnsonCook *>(fixes[0]);
}

int FixHVIJohnsonCook::setmask()
{
  return 0;    // fix hvi/sph calls it
}

/* ---------------------------------------------------------------------- */

void FixHVIJohnsonCook::init()
{
  if (modify->get_fix_by_style("^hvi/johnson-cook$").size() > 1)
    error->all(FLERR, "More than one fix hvi/johnson-cook: it keeps the stress of all solids");
  if (modify->get_fix_by_style("^hvi/sph$").empty())
    error->all(FLERR, "Fix hvi/johnson-cook needs fix hvi/sph, which calls it");
  store = FixHVIStore::find(lmp);
  if (!store || !force->pair_match("^hvi/sph$", 0))
    error->all(FLERR, "Fix hvi/johnson-cook needs pair style hvi/sph");
  if (!restored.empty() && restored != text)
    error->all(FLERR,
               "Fix hvi/johnson-cook: the restart file was written with {}, this run uses {}",
               restored, text);
  restored.clear();    // later runs of this script may use another fix
  state_rows.forget();
  force_rows.forget();

  models.clear();
  models.resize(atom->ntypes + 1);
  warned.resize(atom->ntypes + 1, 0);
  bool found = false;
  for (int itype = 1; itype <= atom->ntypes; itype++) {
    const HVI::Material *const material = store->materials.of(itype);
    if (!material || !material->section("strength", options.strength)) continue;    // fluids
    found = true;
    std::string problem;
    models[itype] = HVI::SolidModel::make(*material, options, problem);
    if (!models[itype])
      error->all(FLERR, "Fix hvi/johnson-cook: material {} (type {}) {}", material->name, itype,
                 problem);
    if (options.spall == HVI::Spall::NONE || models[itype]->spall_limited() || warned[itype])
      continue;
    warned[itype] = 1;
    if (comm->me == 0)
      error->warning(FLERR,
                     "Fix hvi/johnson-cook: material {} (type {}) has no section spall limit and "
                     "does not spall",
                     material->name, itype);
  }
  if (!found)
    error->all(FLERR, "Fix hvi/johnson-cook: no material has a section strength {}",
               options.strength);
}

/* ---------------------------------------------------------------------- */

const HVI::SolidModel *FixHVIJohnsonCook::of(int i) const
{
  return (atom->mask[i] & groupbit) ? models[atom->type[i]].get() : nullptr;
}

std::string FixHVIJohnsonCook::laws_of(int itype) const
{
  const HVI::SolidModel *const model = models[itype].get();
  if (!model) return "liquid";
  std::string words = fmt::format("strength {}", model->strength().name());
  if (model->damage()) words += fmt::format(", damage {}", model->damage()->name());
  static const char *const SPALLS[] = {"none", "pressure", "principal", "zero"};    // as HVI::Spall
  if (options.spall != HVI::Spall::NONE && model->spall_limited())
    words += fmt::format(", spall {}", SPALLS[static_cast<int>(options.spall)]);
  return words;
}

double FixHVIJohnsonCook::plastic_work(int i) const
{
  return (atom->rmass ? atom->rmass[i] : atom->mass[atom->type[i]]) * solid[i].heat;
}

// what the model of a particle needs of the last forces; before the first there are none

HVI::SolidInput FixHVIJohnsonCook::input(int i, Needs needs) const
{
  HVI::SolidInput in = {};
  in.rho = atom->rho[i];
  in.e = atom->esph[i] / (atom->rmass ? atom->rmass[i] : atom->mass[atom->type[i]]);
  if (needs >= FORCES) in.p = store->fields.pressure(i);
  if (needs >= GRADIENT) in.L = store->fields.velocity_gradient(i);
  if (options.weibull > 0.0) in.id = atom->tag[i];
  return in;
}

/* ----------------------------------------------------------------------
   a new particle, or one that a command has changed since the last run
------------------------------------------------------------------------- */

void FixHVIJohnsonCook::start(int i, bool anew)
{
  fresh = true;
  if (const HVI::SolidModel *const model = of(i))
    model->start(solid[i], input(i, STATE), anew);
  else if (anew || !HVI::SolidModel::started(solid[i]))
    HVI::SolidModel::liquefy(solid[i]);
}

/* ---------------------------------------------------------------------- */

void FixHVIJohnsonCook::first_half(double dt)
{
  for (int i = 0; i < atom->nlocal; i++) {
    const HVI::SolidModel *const model = of(i);
    if (!model) continue;
    if (fresh || !model->ready(solid[i]))
      model->prepare(solid[i], input(i, fresh ? GRADIENT : FORCES), fresh);
    model->first_half(solid[i], dt);
  }
  fresh = false;
}

/* ----------------------------------------------------------------------
   particles of one type after another, as many at a time as vectors have lanes
------------------------------------------------------------------------- */

void FixHVIJohnsonCook::second_half(double dt)
{
  int who[HVI::LANES], n = 0;
  const HVI::SolidModel *now = nullptr;    // of those in who
  for (int i = 0; i < atom->nlocal; i++) {
    const HVI::SolidModel *const model = of(i);
    if (!model || failed(i)) continue;
    if (n == HVI::LANES || model != now) {
      if (n) second_half(n, who, dt);
      n = 0;
      now = model;
    }
    who[n++] = i;
  }
  if (n) second_half(n, who, dt);
}

void FixHVIJohnsonCook::second_half(int n, const int *who, double dt)
{
  Solid *states[HVI::LANES];
  HVI::SolidInput in[HVI::LANES];
  for (int k = 0; k < n; k++) {
    states[k] = &solid[who[k]];
    in[k] = input(who[k], GRADIENT);
  }
  const int wrong = of(who[0])->second_half(n, states, in, dt);
  if (wrong >= 0)
    error->one(FLERR, "Fix hvi/johnson-cook: stress of particle {} is not a number",
               atom->tag[who[wrong]]);
}

/* ----------------------------------------------------------------------
   in the directions of op, when a particle has crossed mirror planes
------------------------------------------------------------------------- */

void FixHVIJohnsonCook::reflect(int i, int op)
{
  HVI::SolidModel::reflect(solid[i], op);
}
