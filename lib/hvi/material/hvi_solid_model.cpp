/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#include "hvi_solid_model.h"

#include "hvi_laws.h"
#include "hvi_mirror.h"
#include "hvi_strength_perfect.h"
#include "hvi_vector.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace HVI {

namespace {

  constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();

  void add(Deviator &s, double dt, const Deviator &r)
  {
    s.xx += dt * r.xx;
    s.yy += dt * r.yy;
    s.zz += dt * r.zz;
    s.xy += dt * r.xy;
    s.xz += dt * r.xz;
    s.yz += dt * r.yz;
  }

  void crush(SolidState &s)
  {
    s.S = Deviator();
    s.shear = s.rate = 0.0;
  }

  // the section of damage that is asked for, or the only one

  const Section *damage_section(const Material &material, const std::string &law,
                                std::string &problem)
  {
    const Section *found = nullptr;
    std::string names;
    int n = 0;
    for (const Section &s : material.sections) {
      if (s.kind != "damage" || (!law.empty() && s.law != law)) continue;
      if (!found) found = &s;
      names += (n++ ? ", " : "") + s.law;
    }
    if (n == 1) return found;
    if (n == 0)
      problem = "has no section damage" + (law.empty() ? "" : " " + law) + "; use damage no";
    else
      problem = "has several sections damage (" + names + "); say which: damage LAW";
    return nullptr;
  }
}    // namespace

/* ---------------------------------------------------------------------- */

std::unique_ptr<SolidModel> SolidModel::make(const Material &material, const SolidOptions &options,
                                             std::string &problem)
{
  problem.clear();
  std::unique_ptr<SolidModel> model(new SolidModel());
  model->eos = material.eos;
  model->rho0 = material.eos->rho0();
  model->spall = options.spall;
  model->thermal = options.thermal;
  model->from_work = options.from_work;
  model->weibull = options.weibull;
  model->seed = options.seed;
  model->reference = options.weibull > 0.0 ? options.reference : 0.0;
  model->dim = options.dim;

  const Section none = {"strength", "none", {}};
  const Section *const strength =
      options.strength == none.law ? &none : material.section("strength", options.strength);
  if (!strength) {
    problem = "has no section strength " + options.strength;
    return nullptr;
  }
  model->law = make_strength(*strength, problem);
  if (!model->law) {
    problem = "has a wrong section strength " + options.strength + ": " + problem;
    return nullptr;
  }

  model->melt = options.melt && options.thermal && strength != &none;

  if (options.damage) {
    const Section *const damage = damage_section(material, options.damage_law, problem);
    if (!damage) return nullptr;
    model->fracture = make_damage(*damage, problem);
    if (!model->fracture) {
      problem = "has a wrong section damage " + damage->law + ": " + problem;
      return nullptr;
    }
    model->u_f = model->fracture->displacement();
  }

  problem = model->take_spall(material);
  if (!problem.empty()) return nullptr;
  if (!(model->rho0 > 0.0) && (strength != &none || model->with_spall)) {
    problem = "has an equation of state without a density at rest (rho0), which solids need";
    return nullptr;
  }

  const Eos &eos = *material.eos;
  model->T0 = eos.temperature(eos.rho0(), 0.0);
  const Conditions hot = {model->rho0, model->rho0, 0.0, 1.0e9};
  if (model->melt && model->with_voids &&
      !(model->law->shear_modulus(hot) == 0.0 && std::isfinite(model->T0))) {
    problem = "never melts: melt yes needs strength johnson-cook, steinberg-guinan or "
              "zerilli-armstrong and an equation of state with a temperature";
    return nullptr;
  }
  const double little = 1.0e-4 * eos.c0() * eos.c0();
  model->cp = little / (eos.temperature(eos.rho0(), little) - model->T0);
  model->take_energy(material);
  if (model->softens()) {
    const Conditions rest = {model->rho0, model->rho0, 0.0,
                             options.thermal ? model->T0 : NOT_A_NUMBER};
    const double Y = model->law->yield(0.0, 0.0, rest);
    if (Y > 0.0) model->biggest = 3.0 * model->law->shear_modulus(rest) * model->u_f / Y;
  }
  const Section *const heat = material.section("thermal", "work");
  if (heat) model->chi = heat->values.at("chi");
  if (options.from_work && !(model->cp > 0.0)) {
    problem = "has an equation of state without heat capacity, which temperature work needs";
    return nullptr;
  }
  return model;
}

/* ----------------------------------------------------------------------
   the law of spall; without its section the material does not spall.  Returns what is wrong.
------------------------------------------------------------------------- */

std::string SolidModel::take_spall(const Material &material)
{
  const char *const name = spall_model(spall).section;
  const Section *const section = name ? material.section("spall", name) : nullptr;
  if (!section) {
    spall = Spall::NONE;
    return "";
  }
  if (spall == Spall::GRADY && law->name() == std::string(StrengthNone::name))
    return "has no yield stress, which spall grady takes its limit from: use another strength or "
           "spall";
  std::string problem;
  if (spall == Spall::VOIDS)
    with_voids = make_spall(*section, voids, problem);
  else if (spall == Spall::TULER_BUTCHER)
    make_spall(*section, impulse, problem);
  else if (spall == Spall::GRADY)
    make_spall(*section, grady, problem);
  else
    sigma_p = section->values.at("sigma_p");
  with_spall = problem.empty();
  return with_spall ? "" : std::string("has a wrong section spall ") + name + ": " + problem;
}

/* ----------------------------------------------------------------------
   what parting takes up, per volume: that of the law of spall in force, else of voids, else of
   Grady's limit with the yield stress of the material at rest
------------------------------------------------------------------------- */

void SolidModel::take_energy(const Material &material)
{
  const Section *const v = material.section("spall", SpallVoids::name);
  const Section *const g = material.section("spall", SpallGrady::name);
  if (v && (spall != Spall::GRADY || !g))
    fragment_energy = 0.5 * v->values.at("sigma") * v->values.at("phi_c");
  else if (g)
    fragment_energy = g->values.at("eps_c") *
        law->yield(0.0, 0.0, {rho0, rho0, 0.0, thermal ? T0 : NOT_A_NUMBER});
}

// Whether it spalls at the end of this step, under the pressure of the law.  limit: the factor of
// thresholds, which is to an impulse as if stress were divided by it.

bool SolidModel::parts(SolidState &s, double rho, double p, double Y, double limit, double dt) const
{
  if (spall == Spall::GRADY) return spalls(spall, p, s.S, limit * grady.limit(rho, eos->c0(), Y));
  if (spall == Spall::TULER_BUTCHER) {
    const double over = principal_above(limit * impulse.sigma_0, p, s.S) - limit * impulse.sigma_0;
    if (over > 0.0) s.voids.D = impulse.advance(s.voids.D, impulse.sigma_0 + over / limit, dt);
  } else if (spall != Spall::VOIDS)
    return spalls(spall, p, s.S, limit * sigma_p);
  return s.voids.D >= 1.0;
}

// above the melting temperature of its law of strength

bool SolidModel::molten(const SolidState &s, const SolidInput &in) const
{
  return law->shear_modulus(conditions(s, in)) == 0.0;
}

// where there are voids or may be; returns p_min() of the end.  With melt: the spall strength of preheated
// aluminum drops steeply towards melting (Kanel et al., J. Appl. Phys. 79 (1996) 8310).

double SolidModel::grow_voids(SolidState &s, const SolidInput &in, double limit, double dt) const
{
  if (with_voids && melt && in.p < 0.0 && !s.failed() && molten(s, in)) {
    s.voids.D = 1.0;
    return closed(true, in);
  }
  if (with_voids && !s.failed() && (in.p < 0.0 || s.voids.phi > 0.0)) {
    SpallVoids own = voids;
    own.sigma *= limit;
    const double least = own.advance(s.voids, *eos, in.rho, in.e, in.size, dt);
    if (open(s)) return least;
  }
  return p_min(s, in);
}

// with the stress of the end of the step; with softening its plastic strain counts in the next

void SolidModel::grow_damage(SolidState &s, const SolidInput &in, const Conditions &c, double yield,
                             double d_eps, double dt) const
{
  if (softens() && s.initiation >= 1.0) {
    s.damage += in.size * d_eps / u_f;
    return;
  }
  double &D = softens() ? s.initiation : s.damage;
  D += fracture->increment(d_eps, dt, c.p, yield, law->homologous_temperature(c), scatter(in));
}

/* ---------------------------------------------------------------------- */

SolidState SolidModel::blank()
{
  SolidState s = {};
  s.before = {-NO_LIMIT, UNSEEN};
  s.p_min = -NO_LIMIT;
  return s;
}

// work tells voids that have been pressed shut, of which D is left, from an impulse

const SolidModel::Begun *SolidModel::misread(const SolidModel *model, const SolidState &s)
{
  if (s.failed()) return nullptr;
  const Spall law = model ? model->spall : Spall::NONE;
  const bool softens = model && model->softens();
  const bool opened = s.voids.phi > 0.0 || s.voids.work > 0.0;
  if (opened && law != Spall::VOIDS) return &BEGUN_BY[0];
  if (!opened && s.voids.D > 0.0 && law != Spall::TULER_BUTCHER) return &BEGUN_BY[1];
  if (s.initiation > 0.0 && !softens) return &BEGUN_BY[2];
  if (s.damage > 0.0 && s.initiation < 1.0 && softens) return &BEGUN_BY[3];
  return nullptr;
}

void SolidModel::liquefy(SolidState &s)
{
  s.S = {};
  s.shear = 0.0;
  s.before = {s.failed() ? 0.0 : -NO_LIMIT, s.shear};
}

/* ---------------------------------------------------------------------- */

// The limit before the last step is that of this run.  It was that of sound matter, if it was below 0, even
// where that has failed since.

void SolidModel::start(SolidState &s, SolidInput in, bool anew) const
{
  if (!anew && started(s)) {
    if (!with_voids && s.before.p_min < 0.0) s.before.p_min = closed(false, in);
    return;
  }
  in.p = 0.0;    // there is no pressure yet
  if (s.shear == 0.0 && !s.failed()) s.shear = law->shear_modulus(conditions(s, in));
  s.before = {p_min(s, in), s.shear};
}

// the least pressure is that of matter without voids: inactive particles keep it

void SolidModel::begin_step(SolidState &s, const SolidInput &in) const
{
  s.before = {closed(s.failed(), in), s.shear};
}

/* ----------------------------------------------------------------------
   The trial stress turns with S of the middle of the step: so S keeps its size to fourth order
------------------------------------------------------------------------- */

int SolidModel::advance(int n, SolidState *const *state, const SolidInput *in, double dt) const
{
  Conditions c[LANES] = {};
  Deviator trial[LANES] = {};
  double shear[LANES] = {}, eps[LANES] = {};
  double limit[LANES] = {};
  bool begun[LANES] = {};
  Plastic plastic[LANES];
  for (int k = 0; k < n; k++) {
    SolidState &s = *state[k];
    SolidInput now = in[k];
    Deviator middle = s.S;
    add(middle, 0.5 * dt, jaumann_rate(now.L, s.shear, s.S));
    trial[k] = s.S;
    add(trial[k], dt, jaumann_rate(now.L, s.shear, middle));
    begun[k] = with_voids && s.voids.D > BEGUN;
    limit[k] = threshold(now);
    s.p_min = grow_voids(s, now, limit[k], dt);
    now.p = clip_tension(now.p, s.p_min);
    c[k] = conditions(s, now);
    shear[k] = s.shear = law->shear_modulus(c[k]);
    eps[k] = s.eps;
    const double left = intact(s);
    if (left == 1.0) continue;

    // with the yield stress times what is left all is as without, if stress and modulus are over that

    const double whole = left > 0.0 ? 1.0 / left : 0.0;
    trial[k] = scaled(trial[k], whole);
    shear[k] *= whole;
  }
  law->radial_return(n, trial, dt, shear, eps, c, plastic);

  for (int k = 0; k < n; k++) {
    SolidState &s = *state[k];
    if (std::isnan(plastic[k].d_eps)) return k;
    const double left = intact(s), yield = left * plastic[k].yield;
    s.S = scaled(plastic[k].S, left);
    s.eps += plastic[k].d_eps;
    s.heat += left * plastic[k].work / in[k].rho;
    if (dt > 0.0) s.rate = plastic[k].d_eps / dt;    // else that of the last step
    if (fracture && plastic[k].d_eps > 0.0)
      grow_damage(s, in[k], c[k], yield, plastic[k].d_eps, dt);
    if (s.damage >= 1.0) {
      crush(s);
    } else if (parts(s, in[k].rho, c[k].p, yield, limit[k], dt)) {
      s.spalled = 1.0;
      crush(s);
    }
    if (!begun[k] && (s.failed() || (with_voids && s.voids.D > BEGUN)))
      s.expansion = in[k].expansion;
  }
  return -1;
}

/* ---------------------------------------------------------------------- */

double SolidModel::temperature(const SolidState &s, const SolidInput &in) const
{
  return from_work ? T0 + chi * s.heat / cp : eos->temperature(density(s, in.rho), in.e);
}

Conditions SolidModel::conditions(const SolidState &s, const SolidInput &in) const
{
  return {density(s, in.rho), rho0, in.p, thermal ? temperature(s, in) : NOT_A_NUMBER};
}

void SolidModel::reflect(SolidState &s, int op)
{
  const Reflection reflection(op);
  reflection.symmetric(s.S);
}

}    // namespace HVI
