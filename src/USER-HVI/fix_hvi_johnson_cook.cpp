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
#include "group.h"
#include "hvi_laws.h"
#include "hvi_material.h"
#include "hvi_vector.h"
#include "modify.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

using namespace LAMMPS_NS;

/* ----------------------------------------------------------------------
   Sections of data files: the state; the stress in the last forces with what the next step
   needs beside it; where fracture takes time how far it has come.  Data files have no infinity: it is
   DBL_MAX.
------------------------------------------------------------------------- */

namespace {
using Solid = HVI::SolidState;
enum { STATE, FORCES, VOIDS };
}    // namespace

constexpr FixHVIJohnsonCook::Field FixHVIJohnsonCook::FIELDS[] = {
    {"Sxx", STATE, offsetof(Solid, S.xx)},
    {"Syy", STATE, offsetof(Solid, S.yy)},
    {"Szz", STATE, offsetof(Solid, S.zz)},
    {"Sxy", STATE, offsetof(Solid, S.xy)},
    {"Sxz", STATE, offsetof(Solid, S.xz)},
    {"Syz", STATE, offsetof(Solid, S.yz)},
    {"eps", STATE, offsetof(Solid, eps)},
    {"damage", STATE, offsetof(Solid, damage)},
    {"spalled", STATE, offsetof(Solid, spalled)},
    {"heat", STATE, offsetof(Solid, heat)},
    {"expansion", STATE, offsetof(Solid, expansion)},

    {"Sxx", FORCES, offsetof(Solid, seen.S.xx)},
    {"Syy", FORCES, offsetof(Solid, seen.S.yy)},
    {"Szz", FORCES, offsetof(Solid, seen.S.zz)},
    {"Sxy", FORCES, offsetof(Solid, seen.S.xy)},
    {"Sxz", FORCES, offsetof(Solid, seen.S.xz)},
    {"Syz", FORCES, offsetof(Solid, seen.S.yz)},
    {"p_min", FORCES, offsetof(Solid, seen.p_min),
     [](const FixHVIJohnsonCook &fix, int i) {
       return std::max(fix.extra[i].seen.p_min, -DBL_MAX);
     },
     [](FixHVIJohnsonCook &fix, int i, double p) {
       fix.extra[i].seen.p_min = p > -DBL_MAX ? p : -HVI::NO_LIMIT;
     }},
    {"shear_then", FORCES, offsetof(Solid, seen.shear)},
    {"shear", FORCES, offsetof(Solid, shear)},
    {"rate", FORCES, offsetof(Solid, rate)},

    {"voids", VOIDS, offsetof(Solid, voids.phi)},
    {"damage", VOIDS, offsetof(Solid, voids.D)},
    {"work", VOIDS, offsetof(Solid, voids.work)},
    {"initiation", VOIDS, offsetof(Solid, initiation)},

    // made anew when a run begins
    {nullptr, 0, offsetof(Solid, least)},
    {nullptr, 0, offsetof(Solid, yield)},
    {nullptr, 0, offsetof(Solid, carried.xx)},
    {nullptr, 0, offsetof(Solid, carried.yy)},
    {nullptr, 0, offsetof(Solid, carried.zz)},
    {nullptr, 0, offsetof(Solid, carried.xy)},
    {nullptr, 0, offsetof(Solid, carried.xz)},
    {nullptr, 0, offsetof(Solid, carried.yz)},
};

/* ---------------------------------------------------------------------- */

FixHVIJohnsonCook::FixHVIJohnsonCook(LAMMPS *lmp, int narg, char **arg) :
    FixHVIRecords(lmp, narg, arg, HVI::SolidModel::blank(), FIELDS, {"", "_forces", "_voids"}),
    store(nullptr), fresh(true), checked(false)
{
  static_assert(covers<Solid>(FIELDS), "a number of the record is missing, or there twice");
  read_options(narg, arg);
  begin();
  vector_flag = 1;
  size_vector = atom->ntypes;
  global_freq = 1;
  extvector = 0;
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
  forget_rows();
  make_models();
  if (!restored.empty() && restored != settings())
    error->all(FLERR,
               "Fix hvi/johnson-cook: the restart file was written with {}, this run uses {}",
               restored, settings());
  restored.clear();    // later runs of this script may use another fix
  check_state();
  checked = false;
}

/* ----------------------------------------------------------------------
   asked before models are made, so it goes by the options
------------------------------------------------------------------------- */

bool FixHVIJohnsonCook::can_fail() const
{
  int here = options.damage || options.spall != HVI::Spall::NONE, anywhere;
  for (int i = 0; i < atom->nlocal; i++)
    if (failed(i)) here = 1;
  MPI_Allreduce(&here, &anywhere, 1, MPI_INT, MPI_MAX, world);
  return anywhere;
}

/* ---------------------------------------------------------------------- */

void FixHVIJohnsonCook::make_models()
{
  models.clear();
  models.resize(atom->ntypes + 1);
  warned.resize(atom->ntypes + 1, 0);
  count_particles();
  options.dim = store->fields.settings.laws.dim;
  bool takes_time = options.spall == HVI::Spall::VOIDS ||
      options.spall == HVI::Spall::TULER_BUTCHER;
  bool anywhere = false, here = false, liquids = false;
  for (int itype = 1; itype <= atom->ntypes; itype++) {
    const HVI::Material *const material = store->materials.of(itype);
    if (!material || material->is_liquid()) continue;
    if (options.strength != "none" && !material->section("strength", options.strength)) {
      liquids = liquids || inside[itype];
      continue;
    }
    anywhere = true;
    here = here || inside[itype];
    std::string problem;
    models[itype] = HVI::SolidModel::make(*material, options, problem);
    if (!models[itype])
      error->all(FLERR, "Fix hvi/johnson-cook: material {} (type {}) {}", material->name, itype,
                 problem);
    takes_time = takes_time || models[itype]->softens();
    if (options.spall == HVI::Spall::NONE || models[itype]->spall_limited() || warned[itype])
      continue;
    warned[itype] = 1;
    if (comm->me == 0)
      error->warning(FLERR,
                     "Fix hvi/johnson-cook: material {} (type {}) has no section spall {} and "
                     "does not spall",
                     material->name, itype, HVI::spall_model(options.spall).section);
  }
  wd_section = takes_time ? VOIDS + 1 : VOIDS;    // the last one, or without
  if (!anywhere || (liquids && !here))
    error->all(FLERR,
               "Fix hvi/johnson-cook: no material {}has a section strength {}; strength none is "
               "for those that bear no shear",
               anywhere ? fmt::format("of group {} ", group->names[igroup]) : "", options.strength);
}

void FixHVIJohnsonCook::count_particles()
{
  const int n = atom->ntypes + 1;
  std::vector<bigint> here(2 * n, 0), everywhere(2 * n);
  for (int i = 0; i < atom->nlocal; i++) here[atom->type[i] + (atom->mask[i] & groupbit ? 0 : n)]++;
  MPI_Allreduce(here.data(), everywhere.data(), 2 * n, MPI_LMP_BIGINT, MPI_SUM, world);
  inside.assign(everywhere.begin(), everywhere.begin() + n);
  outside.assign(everywhere.begin() + n, everywhere.end());
}

/* ----------------------------------------------------------------------
   solids that are liquids in this run, unless they are meant to be; softening that takes up more than is
   asked for
------------------------------------------------------------------------- */

void FixHVIJohnsonCook::setup(int /*vflag*/)
{
  if (checked) return;
  checked = true;
  std::vector<double> largest(atom->ntypes + 1, 0.0);    // of spacings, where they count
  for (int i = 0; i < atom->nlocal; i++) {
    const HVI::SolidModel *const model = of(i);
    if (model && model->softens())
      largest[atom->type[i]] = std::max(largest[atom->type[i]], spacing(i));
  }
  MPI_Allreduce(MPI_IN_PLACE, largest.data(), largest.size(), MPI_DOUBLE, MPI_MAX, world);
  for (int itype = 1; itype <= atom->ntypes; itype++) {
    const HVI::Material *const material = store->materials.of(itype);
    if (!material || material->is_liquid() || comm->me) continue;
    if (!models[itype] && inside[itype])
      error->warning(FLERR,
                     "Fix hvi/johnson-cook: material {} (type {}) has no section strength {}: its "
                     "{} particles in group {} bear no shear.  If that is meant, put strength none "
                     "into its file",
                     material->name, itype, options.strength, inside[itype], group->names[igroup]);
    if (models[itype] && outside[itype] && options.strength != "none")
      error->warning(FLERR,
                     "Fix hvi/johnson-cook: {} particles of material {} (type {}) are not in group "
                     "{}: they bear no shear and do not spall",
                     outside[itype], material->name, itype, group->names[igroup]);
    if (models[itype] && largest[itype] >= models[itype]->largest_size())
      error->warning(
          FLERR,
          "Fix hvi/johnson-cook: the spacing {:.4g} of material {} (type {}) must be less "
          "than 3 G u_f/Y = {:.4g}, else stress that softens falls faster than elastic "
          "strain can follow.  Use finer particles or u_f above {:.4g}",
          largest[itype], material->name, itype, models[itype]->largest_size(),
          models[itype]->softening_displacement() * largest[itype] / models[itype]->largest_size());
  }
}

/* ---------------------------------------------------------------------- */

const HVI::SolidModel *FixHVIJohnsonCook::of(int i) const
{
  if (!(atom->mask[i] & groupbit) || models.empty())
    return nullptr;    // empty: before the first run
  return models[atom->type[i]].get();
}

std::string FixHVIJohnsonCook::laws_of(int itype) const
{
  const HVI::SolidModel *const model = models[itype].get();
  if (!model) return "liquid";
  std::string words = fmt::format("strength {}", model->strength().name());
  if (model->damage())
    words += fmt::format(", damage {}{}", model->damage()->name(),
                         model->softens() ? " with softening" : "");
  if (options.spall != HVI::Spall::NONE && model->spall_limited())
    words += std::string(", spall ") + HVI::spall_model(options.spall).name;
  return words;
}

double FixHVIJohnsonCook::compute_vector(int i)
{
  const HVI::SolidModel *const model = models.empty() ? nullptr : models[i + 1].get();
  if (!model) return 0.0;
  return (options.spall != HVI::Spall::NONE && model->spall_limited()) || model->damage() ? 1.0
                                                                                          : 0.0;
}

double FixHVIJohnsonCook::mass(int i) const
{
  return atom->rmass ? atom->rmass[i] : atom->mass[atom->type[i]];
}

double FixHVIJohnsonCook::density(int i) const
{
  const HVI::SolidModel *const model = of(i);
  return model ? model->density(extra[i], atom->rho[i]) : atom->rho[i];
}

double FixHVIJohnsonCook::fragments(int i) const
{
  const HVI::SolidModel *const model = of(i);
  return model ? model->fragments(extra[i]) : 0.0;
}

// what the model of a particle needs of the last forces; before the first there are none

HVI::SolidInput FixHVIJohnsonCook::input(int i, Needs needs) const
{
  HVI::SolidInput in = {};
  in.rho = atom->rho[i];
  in.e = atom->esph[i] / mass(i);
  if (needs >= FORCES) in.p = store->fields.pressure(i);
  if (needs >= GRADIENT) in.L = store->fields.velocity_gradient(i);
  if (options.weibull > 0.0) in.id = atom->tag[i];
  const HVI::SolidModel *const model = of(i);
  if (model && model->has_size()) in.size = spacing(i);
  return in;
}

// in a step that forces come in the middle of: with the density of its end

HVI::SolidInput FixHVIJohnsonCook::settled_input(int i) const
{
  HVI::SolidInput in = input(i, FORCES);
  in.rho = store->fields.density(i);
  in.expansion = -store->fields.view().rates[i].drho / in.rho;
  return in;
}

double FixHVIJohnsonCook::spacing(int i) const
{
  const double V = mass(i) / store->materials.of(atom->type[i])->eos->rho0();
  const int dim = store->fields.settings.laws.dim;
  return dim == 3 ? std::cbrt(V) : (dim == 2 ? std::sqrt(V) : V);
}

/* ----------------------------------------------------------------------
   At the end of the step that begins, as fix hvi/sph extrapolates what it integrates; others stay as they
   are.  The pressure is that of the last forces, less what it may fall by, twice: only its sign counts.
------------------------------------------------------------------------- */

HVI::SolidInput FixHVIJohnsonCook::extrapolated(int i, double dt, int integrated) const
{
  HVI::SolidInput in = input(i, FORCES);
  if (!(atom->mask[i] & integrated)) return in;
  const double drho = dt * atom->drho[i], de = dt * atom->desph[i] / mass(i);
  const double c = store->fields.view().state[i].c;
  in.p -= 2.0 * (c * c * std::fabs(drho) + of(i)->gamma() * in.rho * std::fabs(de));
  in.rho += drho;
  in.e += de;
  return in;
}

/* ----------------------------------------------------------------------
   a new particle, or one that a command has changed since the last run
------------------------------------------------------------------------- */

void FixHVIJohnsonCook::start(int i, bool anew)
{
  fresh = true;
  if (const HVI::SolidModel *const model = of(i))
    model->start(extra[i], input(i, STATE), anew);
  else if (anew || !HVI::SolidModel::started(extra[i]))
    HVI::SolidModel::liquefy(extra[i]);
}

/* ---------------------------------------------------------------------- */

void FixHVIJohnsonCook::first_half(double dt, int integrated)
{
  const bool whole = store->fields.settings.whole;
  for (int i = 0; i < atom->nlocal; i++) {
    const HVI::SolidModel *const model = of(i);
    if (!model) continue;
    if (whole) {
      model->present(extra[i], model->own_limit() ? input(i, STATE) : HVI::SolidInput());
      continue;
    }
    if (fresh || !model->ready(extra[i])) {
      model->prepare(extra[i], input(i, fresh ? GRADIENT : FORCES), fresh);
      if (fresh && store->fields.asleep(i))
        HVI::SolidModel::rest(extra[i]);    // as in second_half()
    }
    model->first_half(extra[i],
                      model->looks() ? extrapolated(i, dt, integrated) : HVI::SolidInput(), dt);
  }
  fresh = false;
}

/* ---------------------------------------------------------------------- */

void FixHVIJohnsonCook::second_half(double dt)
{
  each_solid([this, dt](int n, const int *who, Solid *const *states) {
    HVI::SolidInput in[HVI::LANES];
    for (int k = 0; k < n; k++) {
      in[k] = input(who[k], GRADIENT);
      in[k].expansion = -atom->drho[who[k]] / in[k].rho;
    }
    return of(who[0])->second_half(n, states, in, dt);
  });
}

void FixHVIJohnsonCook::try_out(int i, const HVI::VelocityGradient &L, double dt)
{
  const HVI::SolidModel *const model = of(i);
  if (model && !failed(i)) model->try_out(extra[i], L, dt);
}

void FixHVIJohnsonCook::whole_step(double dt)
{
  each_solid([this, dt](int n, const int *who, Solid *const *states) {
    HVI::SolidInput in[HVI::LANES];
    for (int k = 0; k < n; k++) in[k] = settled_input(who[k]);
    return of(who[0])->whole_step(n, states, in, dt);
  });
}

/* ----------------------------------------------------------------------
   particles of one type after another, as many at a time as vectors have lanes
------------------------------------------------------------------------- */

template <class Step> void FixHVIJohnsonCook::each_solid(const Step &step)
{
  int who[HVI::LANES], n = 0;
  Solid *states[HVI::LANES];
  const HVI::SolidModel *now = nullptr;    // of those in who
  const auto go = [&]() {
    if (!n) return;
    const int wrong = step(n, who, states);
    if (wrong >= 0)
      error->one(FLERR, "Fix hvi/johnson-cook: stress of particle {} is not a number",
                 atom->tag[who[wrong]]);
    n = 0;
  };
  for (int i = 0; i < atom->nlocal; i++) {
    const HVI::SolidModel *const model = of(i);
    if (!model || failed(i) || (atom->mask[i] & store->embedded)) continue;
    if (store->fields.asleep(i)) {
      HVI::SolidModel::rest(extra[i]);
      continue;
    }
    if (n == HVI::LANES || model != now) go();
    now = model;
    states[n] = &extra[i];
    who[n++] = i;
  }
  go();
}

/* ----------------------------------------------------------------------
   What forces come of, after whole_step().  In a setup nothing may be left of that: state was read
   from a data file, or pair_coeff has changed the material.
------------------------------------------------------------------------- */

HVI::SphStress FixHVIJohnsonCook::settled(int i) const
{
  const Solid &s = extra[i];
  const HVI::SolidModel *const model = of(i);
  double p_min = -HVI::NO_LIMIT;
  if (model && fresh)
    p_min = model->p_min(s, model->looks(s) ? settled_input(i) : HVI::SolidInput());
  else if (model)
    p_min = s.failed() ? 0.0 : s.least;
  return {s.S.xx, s.S.yy, s.S.zz, s.S.xy, s.S.xz, s.S.yz, p_min, s.shear};
}

/* ----------------------------------------------------------------------
   in the directions of op, when a particle has crossed mirror planes
------------------------------------------------------------------------- */

void FixHVIJohnsonCook::reflect(int i, int op)
{
  HVI::SolidModel::reflect(extra[i], op);
}
