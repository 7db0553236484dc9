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
#include "hvi_laws.h"
#include "hvi_material.h"
#include "hvi_vector.h"
#include "memory.h"
#include "modify.h"
#include "pair_hvi_sph.h"

#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;

struct FixHVIJohnsonCook::Laws {
  std::unique_ptr<HVI::Strength> strength;
  std::unique_ptr<HVI::Damage> damage;
  double sigma_p = 0.0;                    // limit of tension, spall
  double T0 = 0.0, cp = 0.0, chi = 1.0;    // temperature from plastic work
};

/* ---------------------------------------------------------------------- */

FixHVIJohnsonCook::FixHVIJohnsonCook(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), strength_name("johnson-cook"), spall(HVI::Spall::PRINCIPAL),
    with_damage(1), thermal(1), from_work(0), weibull(0.0), weibull_seed(0), solid(nullptr),
    pair(nullptr), fresh(true),
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
      strength_name = value;
    } else if (key == "damage") {
      with_damage = utils::logical(FLERR, value, false, lmp);
    } else if (key == "thermal") {
      thermal = utils::logical(FLERR, value, false, lmp);
    } else if (key == "temperature") {
      if (value != "energy" && value != "work")
        error->all(FLERR, "Fix hvi/johnson-cook temperature must be energy or work, not {}", value);
      from_work = value == "work";
    } else if (key == "spall") {
      spall_name = value;
      if (value == "none")
        spall = HVI::Spall::NONE;
      else if (value == "pressure")
        spall = HVI::Spall::PRESSURE;
      else if (value == "principal")
        spall = HVI::Spall::PRINCIPAL;
      else if (value == "zero")
        spall = HVI::Spall::ZERO;
      else
        error->all(FLERR,
                   "Fix hvi/johnson-cook spall must be none, pressure, principal or zero, not {}",
                   value);
    } else if (key == "weibull") {
      weibull = utils::numeric(FLERR, value, false, lmp);
      weibull_seed = utils::inumeric(FLERR, arg[iarg + 2], false, lmp);
      if (!(weibull >= 0.01 && std::isfinite(weibull)))    // Gamma(1 + 1/modulus) is finite
        error->all(FLERR, "Fix hvi/johnson-cook weibull modulus must be 0.01 or more, not {}",
                   value);
      if (weibull_seed <= 0)
        error->all(FLERR, "Fix hvi/johnson-cook weibull seed must be > 0, not {}", arg[iarg + 2]);
    } else
      error->all(FLERR, "Unknown fix hvi/johnson-cook keyword: {}", key);
    iarg += 1 + nvalues;
  }
  if (weibull > 0.0 && !with_damage)
    error->all(FLERR, "Fix hvi/johnson-cook weibull scatters damage: it needs damage yes");
  if (weibull > 0.0 && !atom->tag_enable)
    error->all(FLERR, "Fix hvi/johnson-cook weibull needs IDs of particles");

  text = fmt::format("strength {} damage {} spall {} temperature {} thermal {}", strength_name,
                     with_damage ? "yes" : "no", spall_name, from_work ? "work" : "energy",
                     thermal ? "yes" : "no");
  if (weibull > 0.0) text += fmt::format(" weibull {} {}", weibull, weibull_seed);

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
  pair = PairHVISPH::find(lmp);
  if (!pair) error->all(FLERR, "Fix hvi/johnson-cook needs pair style hvi/sph");
  if (!restored.empty() && restored != text)
    error->all(FLERR,
               "Fix hvi/johnson-cook: the restart file was written with {}, this run uses {}",
               restored, text);
  restored.clear();    // later runs of this script may use another fix
  state_rows.forget();
  force_rows.forget();

  laws.clear();
  bool found = false;
  laws.resize(atom->ntypes + 1);
  for (int itype = 1; itype <= atom->ntypes; itype++) {
    const HVI::Material *const material = pair->material(itype);
    if (!material) continue;
    const HVI::Section *const section = material->section("strength", strength_name);
    if (!section) continue;    // types without strength are fluids
    found = true;
    auto made = std::make_unique<Laws>();
    std::string problem;
    made->strength = HVI::make_strength(*section, problem);
    if (!made->strength)
      error->all(FLERR, "Fix hvi/johnson-cook: strength {} of material {} (type {}): {}",
                 strength_name, material->name, itype, problem);
    if (with_damage) {
      const HVI::Section *const d = material->section("damage", "johnson-cook");
      if (!d)
        error->all(
            FLERR,
            "Fix hvi/johnson-cook: material {} (type {}) has no section damage johnson-cook; "
            "use damage no",
            material->name, itype);
      made->damage = HVI::make_damage(*d, problem);
      if (!made->damage)
        error->all(FLERR, "Fix hvi/johnson-cook: damage of material {} (type {}): {}",
                   material->name, itype, problem);
    }
    if (spall != HVI::Spall::NONE) {
      const HVI::Section *const s = material->section("spall", "limit");
      if (!s && comm->me == 0)
        error->warning(FLERR,
                       "Fix hvi/johnson-cook: material {} (type {}) has no section spall limit and "
                       "does not spall",
                       material->name, itype);
      made->sigma_p = s ? s->values.at("sigma_p") : INFINITY;
    }
    const HVI::Eos &eos = *material->eos;
    made->T0 = eos.temperature(eos.rho0(), 0.0);
    const double little = 1.0e-4 * eos.c0() * eos.c0();
    made->cp = little / (eos.temperature(eos.rho0(), little) - made->T0);
    const HVI::Section *const heat = material->section("thermal", "work");
    if (heat) made->chi = heat->values.at("chi");
    if (from_work && !(made->cp > 0.0))
      error->all(
          FLERR,
          "Fix hvi/johnson-cook temperature work: the equation of state of material {} (type "
          "{}) has no heat capacity",
          material->name, itype);
    laws[itype] = std::move(made);
  }
  if (!found)
    error->all(FLERR, "Fix hvi/johnson-cook: no material has a section strength {}", strength_name);
}

/* ----------------------------------------------------------------------
   a new particle, or one that a command has changed since the last run
------------------------------------------------------------------------- */

void FixHVIJohnsonCook::start(int i, bool anew)
{
  fresh = true;
  const Laws *const law = of(i);
  Solid &s = solid[i];
  anew = anew || s.sent.shear == UNSENT;
  if (anew && law && s.shear == 0.0 && !failed(i))
    s.shear = law->strength->shear_modulus(conditions(i, 0.0));    // there is no pressure yet
  if (!anew) return;
  s.yield = UNKNOWN;
  send(i, law, s.S);
}

/* ---------------------------------------------------------------------- */

const FixHVIJohnsonCook::Laws *FixHVIJohnsonCook::of(int i) const
{
  return (atom->mask[i] & groupbit) ? laws[atom->type[i]].get() : nullptr;
}

double FixHVIJohnsonCook::temperature(int i) const
{
  const int itype = atom->type[i];
  if (from_work && laws[itype])
    return laws[itype]->T0 + laws[itype]->chi * solid[i].heat / laws[itype]->cp;
  const double m = atom->rmass ? atom->rmass[i] : atom->mass[itype];
  return pair->material(itype)->eos->temperature(atom->rho[i], atom->esph[i] / m);
}

double FixHVIJohnsonCook::plastic_work(int i) const
{
  return (atom->rmass ? atom->rmass[i] : atom->mass[atom->type[i]]) * solid[i].heat;
}

double FixHVIJohnsonCook::scatter(int i) const
{
  return weibull > 0.0 ? HVI::weibull_factor(weibull_seed, atom->tag[i], weibull) : 1.0;
}

HVI::Conditions FixHVIJohnsonCook::conditions(int i, double p) const
{
  const double rho0 = pair->material(atom->type[i])->eos->rho0();
  return {atom->rho[i], rho0, p, thermal ? temperature(i) : NAN};
}

/* ----------------------------------------------------------------------
   dS/dt of the last forces' velocity gradient and stress moves S on by dt; radial return and
   damage.  Rubble bears no shear.
------------------------------------------------------------------------- */

HVI::Deviator FixHVIJohnsonCook::rate(int i) const
{
  return HVI::jaumann_rate(pair->velocity_gradient(i), solid[i].shear, solid[i].sent.S);
}

static void add(HVI::Deviator &s, double dt, const HVI::Deviator &r)
{
  s.xx += dt * r.xx;
  s.yy += dt * r.yy;
  s.zz += dt * r.zz;
  s.xy += dt * r.xy;
  s.xz += dt * r.xz;
  s.yz += dt * r.yz;
}

void FixHVIJohnsonCook::advance(int n, const int *who, const Laws &law, double dt)
{
  HVI::Conditions c[HVI::LANES] = {};
  HVI::Deviator trial[HVI::LANES] = {};
  double shear[HVI::LANES] = {}, eps[HVI::LANES] = {};
  HVI::Plastic plastic[HVI::LANES];
  for (int k = 0; k < n; k++) {
    Solid &s = solid[who[k]];
    c[k] = conditions(who[k], pair->pressure(who[k]));
    shear[k] = s.shear = law.strength->shear_modulus(c[k]);
    eps[k] = s.eps;
    trial[k] = s.middle;
    s.middle = rate(who[k]);
    add(trial[k], 0.5 * dt, s.middle);
  }
  law.strength->radial_return(n, trial, dt, shear, eps, c, plastic);

  for (int k = 0; k < n; k++) {
    const int i = who[k];
    Solid &s = solid[i];
    if (std::isnan(plastic[k].d_eps))
      error->one(FLERR, "Fix hvi/johnson-cook: stress of particle {} is not a number",
                 atom->tag[i]);
    s.S = plastic[k].S;
    s.yield = plastic[k].yield;
    s.eps += plastic[k].d_eps;
    s.heat += plastic[k].work / c[k].rho;
    s.rate = plastic[k].d_eps / dt;
    if (law.damage && plastic[k].d_eps > 0.0)
      s.damage += law.damage->increment(plastic[k].d_eps, dt, c[k].p, s.yield,
                                        law.strength->homologous_temperature(c[k]), scatter(i));
    if (s.damage >= 1.0) {
      rubble(i);
    } else if (HVI::spalls(spall, c[k].p, s.S, law.sigma_p)) {
      s.spalled = 1.0;
      rubble(i);
    }
  }
}

void FixHVIJohnsonCook::rubble(int i)
{
  solid[i].S = HVI::Deviator();
  solid[i].shear = solid[i].rate = 0.0;
}

/* ----------------------------------------------------------------------
   Half of the elastic trial stress; and S extrapolated to the end of the step for the
   forces, back to the yield surface, without plastic strain.  The second half, with
   the new velocity gradient, brings the radial return.
------------------------------------------------------------------------- */

void FixHVIJohnsonCook::first_half(double dt)
{
  for (int i = 0; i < atom->nlocal; i++) {
    const Laws *const law = of(i);
    if (!law) continue;
    Solid &s = solid[i];
    HVI::Deviator ahead = s.S;
    if (!failed(i)) {
      const HVI::Deviator dS = fresh ? rate(i) : s.middle;
      s.middle = s.S;
      add(s.middle, 0.5 * dt, dS);
      add(ahead, dt, dS);
      const double stress = HVI::von_mises(ahead);
      if (s.yield == UNKNOWN)
        s.yield = s.rate > 0.0 ? HVI::von_mises(s.S)
                               : law->strength->yield(s.eps, 0.0, conditions(i, pair->pressure(i)));
      if (stress > s.yield) ahead = HVI::scaled(ahead, s.yield / stress);
    }
    send(i, law, ahead);
  }
  fresh = false;
}

/* ----------------------------------------------------------------------
   what neighbors will know of i
------------------------------------------------------------------------- */

void FixHVIJohnsonCook::send(int i, const Laws *law, const HVI::Deviator &S)
{
  const double p_min = law ? HVI::least_pressure(spall, failed(i), law->sigma_p) : -HVI::NO_LIMIT;
  solid[i].sent = {S, p_min, solid[i].shear};
}

void FixHVIJohnsonCook::second_half(double dt)
{
  int who[HVI::LANES], n = 0;
  const Laws *now = nullptr;    // of those in who
  for (int i = 0; i < atom->nlocal; i++) {
    const Laws *const law = of(i);
    if (!law || failed(i)) continue;
    if (n == HVI::LANES || law != now) {
      if (n) advance(n, who, *now, dt);
      n = 0;
      now = law;
    }
    who[n++] = i;
  }
  if (n) advance(n, who, *now, dt);
}

/* ----------------------------------------------------------------------
   in the directions of op, when a particle has crossed mirror planes
------------------------------------------------------------------------- */

void FixHVIJohnsonCook::reflect(int i, int op)
{
  const HVI::Reflection reflection(op);
  reflection.symmetric(solid[i].S);
  reflection.symmetric(solid[i].sent.S);
  reflection.symmetric(solid[i].middle);
}
