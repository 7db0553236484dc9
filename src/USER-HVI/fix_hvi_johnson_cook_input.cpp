/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

// keywords, what restart files hold of them, whether state goes with them; the rest of the class is in
// fix_hvi_johnson_cook.cpp

#include "fix_hvi_johnson_cook.h"

#include "atom.h"
#include "error.h"
#include "fix_hvi_store.h"
#include "group.h"
#include "hvi_laws.h"

#include <cmath>
#include <iterator>

using namespace LAMMPS_NS;

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
