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
#include "hvi_cite.h"
#include "hvi_laws.h"
#include "hvi_material.h"
#include "hvi_vector.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <iterator>
#include <set>

using namespace LAMMPS_NS;

/* ----------------------------------------------------------------------
   Sections of data files: the state; what the last forces and the next step need beside it; where fracture takes
   time how far it has come.  Data files have no infinity: it is
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

    {"heat", FORCES, offsetof(Solid, heat)},
    {"expansion", FORCES, offsetof(Solid, expansion)},
    {"p_min_before", FORCES, offsetof(Solid, before.p_min),
     [](const FixHVIJohnsonCook &fix, int i) {
       return std::max(fix.extra[i].before.p_min, -DBL_MAX);
     },
     [](FixHVIJohnsonCook &fix, int i, double p) {
       fix.extra[i].before.p_min = p > -DBL_MAX ? p : -HVI::NO_LIMIT;
     }},
    {"shear_before", FORCES, offsetof(Solid, before.shear)},
    {"shear", FORCES, offsetof(Solid, shear)},
    {"rate", FORCES, offsetof(Solid, rate)},
    {"first_id", FORCES, offsetof(Solid, id)},    // as it was: read_data may give others

    {"voids", VOIDS, offsetof(Solid, voids.phi)},
    {"damage", VOIDS, offsetof(Solid, voids.D)},
    {"work", VOIDS, offsetof(Solid, voids.work)},
    {"initiation", VOIDS, offsetof(Solid, initiation)},

    // made anew when a run begins
    {nullptr, 0, offsetof(Solid, p_min)},
};

/* ---------------------------------------------------------------------- */

FixHVIJohnsonCook::FixHVIJohnsonCook(LAMMPS *lmp, int narg, char **arg) :
    FixHVIRecords(lmp, narg, arg, HVI::SolidModel::blank(), FIELDS, {"", "_forces", "_voids"}),
    store(nullptr), in_setup(true), checked(false)
{
  static_assert(covers<Solid>(FIELDS), "a number of the record is missing, or there twice");
  static_assert(have_room(FIELDS), "lines of data files are too long");
  read_options(narg, arg);
  if (options.damage) HVI::cite(lmp->citeme, HVI::CITE_JOHNSON_COOK);
  begin();
  vector_flag = 1;
  size_vector = atom->ntypes;
  global_freq = 1;
  extvector = 0;
}

/* ---------------------------------------------------------------------- */

void FixHVIJohnsonCook::read_options(int narg, char **arg)
{
  bool damage_given = false;
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
      damage_given = true;
      options.damage_law.clear();
      if (value == "yes" || value == "on" || value == "true")
        options.damage = true;
      else if (value == "no" || value == "off" || value == "false")
        options.damage = false;
      else if (HVI::find_law("damage", value)) {
        options.damage = true;
        options.damage_law = value;
      } else
        error->all(FLERR, "Fix hvi/johnson-cook damage must be yes, no or a law ({}), not {}",
                   HVI::law_names("damage"), value);
    } else if (key == "thermal") {
      options.thermal = utils::logical(FLERR, value, false, lmp);
    } else if (key == "melt") {
      options.melt = utils::logical(FLERR, value, false, lmp);
    } else if (key == "temperature") {
      if (value != "energy" && value != "work")
        error->all(FLERR, "Fix hvi/johnson-cook temperature must be energy or work, not {}", value);
      options.from_work = value == "work";
    } else if (key == "spall") {
      const HVI::SpallModel *const spall = HVI::find_spall(value);
      if (!spall)
        error->all(FLERR, "Fix hvi/johnson-cook spall must be {}, not {}", HVI::spall_names(),
                   value);
      options.spall = spall->model;
    } else if (key == "weibull") {
      options.weibull = utils::numeric(FLERR, value, false, lmp);
      options.seed = utils::inumeric(FLERR, arg[iarg + 2], false, lmp);
      if (!(options.weibull >= 0.01 &&
            std::isfinite(options.weibull)))    // Gamma(1 + 1/modulus) is finite
        error->all(FLERR, "Fix hvi/johnson-cook weibull modulus must be 0.01 or more, not {}",
                   value);
      if (options.seed <= 0)
        error->all(FLERR, "Fix hvi/johnson-cook weibull seed must be > 0, not {}", arg[iarg + 2]);
    } else if (key == "weibull_size") {
      options.reference = utils::numeric(FLERR, value, false, lmp);
      if (!(options.reference >= 0.0 && std::isfinite(options.reference)))
        error->all(FLERR, "Fix hvi/johnson-cook weibull_size must be >= 0, not {}", value);
    } else
      error->all(FLERR, "Unknown fix hvi/johnson-cook keyword: {}", key);
    iarg += 1 + nvalues;
  }
  if (options.strength == "none") {
    if (damage_given && options.damage)
      error->all(FLERR,
                 "Fix hvi/johnson-cook strength none brings no plastic strain, which damage needs: "
                 "use damage no");
    options.damage = false;
  }
  if (options.melt && options.spall != HVI::Spall::VOIDS)
    error->all(FLERR, "Fix hvi/johnson-cook melt yes needs spall voids, whose strength it ends");
  if (options.melt && (!options.thermal || options.strength == "none"))
    error->all(FLERR,
               "Fix hvi/johnson-cook melt yes needs a strength that knows the temperature: not "
               "strength none, nor thermal no");
  if (options.reference > 0.0 && !(options.weibull > 0.0))
    error->all(FLERR, "Fix hvi/johnson-cook weibull_size needs weibull, whose scatter it scales");
  if (options.reference > 0.0 && options.weibull < 1.0)
    error->all(FLERR, "Fix hvi/johnson-cook weibull_size needs a modulus of 1 or more, not {}",
               options.weibull);
  if (options.reference > 0.0 && !options.damage && options.spall == HVI::Spall::NONE)
    error->all(FLERR,
               "Fix hvi/johnson-cook weibull with weibull_size scatters damage and spall: it needs "
               "one of them");
  if (options.weibull > 0.0 && options.reference == 0.0 && !options.damage)
    error->all(FLERR,
               "Fix hvi/johnson-cook weibull scatters damage: it needs damage yes, or weibull_size "
               "to scatter spall");
  if (options.weibull > 0.0 && !atom->tag_enable)
    error->all(FLERR, "Fix hvi/johnson-cook weibull needs IDs of particles");
}

/* ----------------------------------------------------------------------
   "damage yes" leaves the law to the files: here it has its name
------------------------------------------------------------------------- */

std::string FixHVIJohnsonCook::settings() const
{
  std::string damage;
  for (const auto &model : models) {
    if (!model || !model->damage()) continue;
    const std::string law = model->damage()->name();
    if (("," + damage + ",").find("," + law + ",") == std::string::npos)
      damage += (damage.empty() ? "" : ",") + law;
  }
  if (damage.empty()) damage = options.damage ? "yes" : "no";
  std::string text =
      fmt::format("strength {} damage {} spall {} temperature {} thermal {}", options.strength,
                  damage, HVI::spall_model(options.spall).name,
                  options.from_work ? "work" : "energy", options.thermal ? "yes" : "no");
  if (options.melt) text += " melt yes";
  if (options.weibull > 0.0) text += fmt::format(" weibull {} {}", options.weibull, options.seed);
  if (options.reference > 0.0) text += fmt::format(" weibull_size {}", options.reference);
  return text;
}

/* ----------------------------------------------------------------------
   Data files do not say by which laws their state came to be, and pair_coeff, set and group may change
   those of a particle with its state: nobody may go on with what another law has begun.
------------------------------------------------------------------------- */

void FixHVIJohnsonCook::check_state() const
{
  constexpr int NKIND = std::size(HVI::SolidModel::BEGUN_BY);
  const int ntypes = atom->ntypes;
  std::vector<bigint> number(2 * NKIND * (ntypes + 1), 0);    // of those with a model, and without
  for (int i = 0; i < atom->nlocal; i++) {
    const HVI::SolidModel *const model = of(i);
    const auto *const begun = HVI::SolidModel::misread(model, extra[i]);
    if (begun)
      number[(NKIND * atom->type[i] + (begun - HVI::SolidModel::BEGUN_BY)) * 2 + (model ? 0 : 1)]++;
  }
  MPI_Allreduce(MPI_IN_PLACE, number.data(), number.size(), MPI_LMP_BIGINT, MPI_SUM, world);
  for (int k = 0; k < (int) number.size(); k++) {
    if (number[k] == 0) continue;
    const int itype = k / (2 * NKIND);
    const HVI::SolidModel::Begun &begun = HVI::SolidModel::BEGUN_BY[k / 2 % NKIND];
    const HVI::Material *const material = store->materials.of(itype);
    const bool left = models[itype] && k % 2;
    error->all(FLERR,
               "Fix hvi/johnson-cook: {} particles of type {} (material {}) have {}, by {}, but "
               "are of {} in this run: give the keywords and material files of the run that their "
               "state is from, or unfix {} and give it anew, by which all particles start "
               "without stress and damage",
               number[k], itype, material ? material->name : "none", begun.what, begun.law,
               left ? fmt::format("no solid, outside of group {},", group->names[igroup])
                    : laws_of(itype),
               id);
  }
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
  check_restored();
  restored.clear();    // later runs of this script may use another fix
  check_state();
  if (update->whichflag == 1)    // not of commands before a run
    for (int i = 0; i < atom->nlocal; i++) name_thresholds(i);
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
    if (!material) continue;

    // pair_coeff makes liquids that do not spall; those by their files do, and all with strength none of this fix

    if (material->liquid) continue;
    HVI::SolidOptions own = options;
    const bool liquid = options.strength != "none" && material->is_liquid();
    if (liquid) {
      if (options.spall == HVI::Spall::NONE ||
          !material->section("spall", HVI::spall_model(options.spall).section))
        continue;
      own.strength = "none";
      own.from_work = false;
    } else if (options.strength != "none" && !material->section("strength", options.strength)) {
      liquids = liquids || inside[itype];
      continue;
    }
    anywhere = anywhere || !liquid;
    here = here || (!liquid && inside[itype]);
    std::string problem;

    // damage yes is for materials that have a law of it, one by its name for all

    own.damage = options.damage && !liquid &&
        (!options.damage_law.empty() || material->section("damage", ""));
    models[itype] = HVI::SolidModel::make(*material, own, problem);
    if (!models[itype] && liquid) {
      if (!warned[itype] && comm->me == 0)
        error->warning(
            FLERR,
            "Fix hvi/johnson-cook: material {} (type {}) is a liquid and does not spall: it {}",
            material->name, itype, problem);
      warned[itype] = 1;
      continue;
    }
    if (!models[itype])
      error->all(FLERR, "Fix hvi/johnson-cook: material {} (type {}) {}", material->name, itype,
                 problem);
    takes_time = takes_time || models[itype]->softens();
    if (warned[itype]) continue;
    warned[itype] = 1;
    if (comm->me == 0 && options.damage && !own.damage && !liquid)
      error->warning(FLERR,
                     "Fix hvi/johnson-cook: material {} (type {}) has no section damage and does "
                     "not fail by plastic strain",
                     material->name, itype);
    if (comm->me == 0 && options.spall != HVI::Spall::NONE && !models[itype]->spall_limited())
      error->warning(FLERR,
                     "Fix hvi/johnson-cook: material {} (type {}) has no section spall {} and "
                     "does not spall",
                     material->name, itype, HVI::spall_model(options.spall).section);
  }
  wd_section = takes_time ? VOIDS + 1 : VOIDS;    // the last one, or without
  if (!anywhere || (liquids && !here))
    error->all(FLERR,
               "Fix hvi/johnson-cook: no material {}has a section strength {} (there are: {}); "
               "strength none is for those that bear no shear",
               anywhere ? fmt::format("of group {} ", group->names[igroup]) : "", options.strength,
               known_strengths());
}

std::string FixHVIJohnsonCook::known_strengths() const
{
  std::set<std::string> found;
  for (int itype = 1; itype <= atom->ntypes; itype++)
    if (const HVI::Material *const material = store->materials.of(itype)) {
      bool any = false;
      for (const HVI::Section &section : material->sections)
        if (section.kind == "strength") {
          found.insert(fmt::format("{} of {}", section.law, material->name));
          any = true;
        }
      if (!any) found.insert("none of " + material->name);
    }
  return utils::join_words({found.begin(), found.end()}, ", ");
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
    const bool comes_later =
        inside[itype] + outside[itype] == 0 && !modify->get_fix_by_style("^deposit").empty();
    if (!models[itype] && (inside[itype] || comes_later))
      error->warning(
          FLERR,
          "Fix hvi/johnson-cook: material {} (type {}) has no section strength {}: its "
          "{} particles in group {} bear no shear.  If that is meant, give strength none "
          "in its file, or in pair_coeff, which does not spall",
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

// what the model of a particle needs: of its state; and, when the velocity gradient of the middle of the step is
// known, of the end of the step

HVI::SolidInput FixHVIJohnsonCook::input(int i) const
{
  HVI::SolidInput in = {};
  in.rho = atom->rho[i];
  in.e = atom->esph[i] / mass(i);
  if (options.weibull > 0.0) in.id = extra[i].id > 0.0 ? extra[i].id : atom->tag[i];
  const HVI::SolidModel *const model = of(i);
  if (model && model->has_size()) in.size = spacing(i);
  return in;
}

HVI::SolidInput FixHVIJohnsonCook::input_of_end(int i) const
{
  HVI::SolidInput in = input(i);
  in.p = store->fields.pressure(i);
  in.L = store->fields.velocity_gradient(i);
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
   a new particle, or one that a command has changed since the last run
------------------------------------------------------------------------- */

void FixHVIJohnsonCook::start(int i, bool anew)
{
  in_setup = true;
  if (const HVI::SolidModel *const model = of(i))
    model->start(extra[i], input(i), anew);
  else
    HVI::SolidModel::liquefy(extra[i]);
}

// in a run, between two steps

void FixHVIJohnsonCook::start_newcomer(int i)
{
  const bool was = in_setup;
  if (models[atom->type[i]] && !of(i) &&
      (options.strength == "none" || !store->materials.of(atom->type[i])->is_liquid()))
    error->one(
        FLERR,
        "Fix hvi/johnson-cook: particle {} (type {}), a solid, comes at step {} and is not in "
        "group {}: let fix deposit have that group",
        atom->tag[i], atom->type[i], update->ntimestep, group->names[igroup]);
  start(i, true);
  name_thresholds(i);
  in_setup = was;
}

// by the ID of the begin, for commands may give others later

void FixHVIJohnsonCook::name_thresholds(int i)
{
  if (options.weibull > 0.0 && extra[i].id == 0.0) extra[i].id = atom->tag[i];
}

/* ---------------------------------------------------------------------- */

void FixHVIJohnsonCook::begin_step()
{
  for (int i = 0; i < atom->nlocal; i++) {
    const HVI::SolidModel *const model = of(i);
    if (model && !HVI::SphFields::is_frozen(atom->rho[i]))
      model->begin_step(extra[i], model->own_limit() ? input(i) : HVI::SolidInput());
  }
  in_setup = false;
}

/* ----------------------------------------------------------------------
   particles of one type after another, as many at a time as vectors have lanes
------------------------------------------------------------------------- */

void FixHVIJohnsonCook::advance(double dt)
{
  int who[HVI::LANES], n = 0;
  Solid *states[HVI::LANES];
  HVI::SolidInput in[HVI::LANES];
  const HVI::SolidModel *now = nullptr;    // of the particles in who
  const auto go = [&]() {
    if (!n) return;
    const int wrong = now->advance(n, states, in, dt);
    if (wrong >= 0)
      error->one(FLERR, "Fix hvi/johnson-cook: stress of particle {} is not a number",
                 atom->tag[who[wrong]]);
    n = 0;
  };
  for (int i = 0; i < atom->nlocal; i++) {
    const HVI::SolidModel *const model = of(i);
    if (!model || failed(i) || (atom->mask[i] & store->embedded) ||
        HVI::SphFields::is_frozen(atom->rho[i]))
      continue;
    if (store->fields.asleep(i)) {
      extra[i].rate = 0.0;
      continue;
    }
    if (n == HVI::LANES || model != now) go();
    now = model;
    states[n] = &extra[i];
    in[n] = input_of_end(i);
    who[n++] = i;
  }
  go();
}

/* ----------------------------------------------------------------------
   In a setup the least pressure of the end of the last step is not known any more: state was read
   from a data file, or pair_coeff has changed the material.
------------------------------------------------------------------------- */

FixHVIJohnsonCook::Stress FixHVIJohnsonCook::stress(int i) const
{
  const Solid &s = extra[i];
  const HVI::SolidModel *const model = of(i);
  double p_min = s.failed() ? 0.0 : -HVI::NO_LIMIT;    // rubble stays rubble, as a liquid, too
  if (model && in_setup)
    p_min = model->p_min(s, model->looks(s) ? input_of_end(i) : HVI::SolidInput());
  else if (model && !s.failed())
    p_min = s.p_min;
  return {s.S, p_min, s.shear};
}

/* ---------------------------------------------------------------------- */

void FixHVIJohnsonCook::reflect(int i, int op)
{
  HVI::SolidModel::reflect(extra[i], op);
}
