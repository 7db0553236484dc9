/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "fix_hvi_sph.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_hvi_johnson_cook.h"
#include "fix_hvi_ledger.h"
#include "fix_hvi_store.h"
#include "force.h"
#include "group.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

using namespace LAMMPS_NS;
using namespace FixConst;

/* ----------------------------------------------------------------------
   Data files: what the last rates belong to, for particles that go on from it, and the constant of
   variable h.  atom_style sph does not write vest.  In a section of its own: how rates change.
------------------------------------------------------------------------- */

static constexpr int TRENDS = 1;

// sleep exact: what rounding of sums over neighbors leaves of rest, in parts of the speed of sound

static constexpr double EXACT = 1.0e-13;

constexpr FixHVISPH::Field FixHVISPH::FIELDS[] = {
    {"going_on", 0, offsetof(Extra, mark),
     [](const FixHVISPH &fix, int i) {
       return fix.goes_on(i) ? 1.0 : 0.0;
     },
     [](FixHVISPH &fix, int i, double going_on) {
       fix.extra[i].mark = going_on != 0.0 ? fix.fingerprint(i) : 0;
     }},
    {"h_constant", 0, offsetof(Extra, hscale)},
    {"rho", 0, offsetof(Extra, rho),
     [](const FixHVISPH &fix, int i) {
       return fix.goes_on(i) ? fix.extra[i].rho : fix.atom->rho[i];
     }},
    {"esph", 0, offsetof(Extra, esph),
     [](const FixHVISPH &fix, int i) {
       return fix.goes_on(i) ? fix.extra[i].esph : fix.atom->esph[i];
     }},
    {"vx", 0, Field::NOWHERE,
     [](const FixHVISPH &fix, int i) {
       return fix.felt_velocity(i)[0];
     },
     [](FixHVISPH &fix, int i, double v) {
       fix.atom->vest[i][0] = v;
     }},
    {"vy", 0, Field::NOWHERE,
     [](const FixHVISPH &fix, int i) {
       return fix.felt_velocity(i)[1];
     },
     [](FixHVISPH &fix, int i, double v) {
       fix.atom->vest[i][1] = v;
     }},
    {"vz", 0, Field::NOWHERE,
     [](const FixHVISPH &fix, int i) {
       return fix.felt_velocity(i)[2];
     },
     [](FixHVISPH &fix, int i, double v) {
       fix.atom->vest[i][2] = v;
     }},
    {"rho", TRENDS, offsetof(Extra, trend_rho)},
    {"esph", TRENDS, offsetof(Extra, trend_e)},
    {"vx", TRENDS, offsetof(Extra, trend_v[0])},
    {"vy", TRENDS, offsetof(Extra, trend_v[1])},
    {"vz", TRENDS, offsetof(Extra, trend_v[2])},
    {"working_vx", TRENDS, offsetof(Extra, working[0])},
    {"working_vy", TRENDS, offsetof(Extra, working[1])},
    {"working_vz", TRENDS, offsetof(Extra, working[2])},
    {"settled", TRENDS, offsetof(Extra, settled)},
    {"step", TRENDS, offsetof(Extra, step)},

    // 0 between steps
    {nullptr, 0, offsetof(Extra, drho)},
    {nullptr, 0, offsetof(Extra, de)},
    {nullptr, 0, offsetof(Extra, stretch)},
};

// the velocity that the last rates belong to

const double *FixHVISPH::felt_velocity(int i) const
{
  return goes_on(i) ? atom->vest[i] : atom->v[i];
}

/* ---------------------------------------------------------------------- */

FixHVISPH::FixHVISPH(LAMMPS *lmp, int narg, char **arg) :
    FixHVIRecords(lmp, narg, arg, Extra(), FIELDS, {"", "_trends"}), store(nullptr),
    ledger(nullptr), strength(nullptr), dtv(0.0), dtf(0.0), power(0.0), push{0.0, 0.0, 0.0},
    last(0.0), due(false), stepping(0), wallbit(0), follow(0), checked(0), quiet(1.0e-10),
    relative(true)
{
  static_assert(covers<Extra>(FIELDS), "a number of the record is missing, or there twice");
  if (!atom->esph_flag || !atom->rho_flag || !atom->vest_flag)
    error->all(FLERR,
               "Fix hvi/sph needs density, energy and velocity estimates of particles: use "
               "atom_style sph");
  for (int iarg = 3; iarg < narg; iarg += 2) {
    const std::string key = arg[iarg];
    if (key != "walls" && key != "sleep" && key != "lists")
      error->all(FLERR, "Unknown fix hvi/sph keyword: {}", key);
    if (iarg + 2 > narg) utils::missing_cmd_args(FLERR, "fix hvi/sph " + key, error);
    const std::string value = arg[iarg + 1];
    if (key == "walls") {
      const int jgroup = group->find(value);
      if (jgroup == -1) error->all(FLERR, "Could not find fix hvi/sph walls group ID {}", value);
      wallbit |= group->bitmask[jgroup];
    } else if (key == "lists") {
      if (value != "relative" && value != "displacement")
        error->all(FLERR, "Fix hvi/sph lists must be relative or displacement, not {}", value);
      relative = value == "relative";
    } else if (value == "exact" || value == "no") {
      quiet = value == "no" ? 0.0 : EXACT;
    } else {
      quiet = utils::numeric(FLERR, value, false, lmp);
      if (!(quiet >= EXACT && quiet <= 1.0e-4))
        error->all(FLERR,
                   "Fix hvi/sph sleep must be exact, no or a part of the speed of sound from {} to "
                   "1e-4, not {}",
                   EXACT, value);
    }
  }

  time_integrate = 1;
  comm_border = 1;
  comm_forward = 1;
  scalar_flag = vector_flag = 1;
  size_vector = atom->ntypes;
  global_freq = 1;
  extscalar = extvector = 0;

  begin();
  atom->add_callback(Atom::BORDER);
}

/* ---------------------------------------------------------------------- */

FixHVISPH::~FixHVISPH()
{
  atom->delete_callback(id, Atom::BORDER);
}

/* ---------------------------------------------------------------------- */

int FixHVISPH::setmask()
{
  // setup_pre_force() is called for fixes with a pre_force() only

  return INITIAL_INTEGRATE | POST_INTEGRATE | PRE_FORCE | FINAL_INTEGRATE;
}

/* ---------------------------------------------------------------------- */

void FixHVISPH::init()
{
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Fix hvi/sph does not support run_style respa");
  if (update->whichflag == 2) error->all(FLERR, "Fix hvi/sph does not support minimization");
  if (modify->get_fix_by_style("^hvi/sph$").size() > 1)
    error->all(FLERR, "More than one fix hvi/sph: it keeps the state of all SPH particles");
  if (domain->deform_vremap)
    error->all(FLERR, "Fix hvi/sph does not support fix deform with remap v");

  store = FixHVIStore::find(lmp);
  if (!store || !force->pair_match("^hvi/sph$", 0))
    error->all(FLERR, "Fix hvi/sph needs pair style hvi/sph");
  const HVI::SphSettings &set = store->fields.settings;
  check_restart();

  restored.clear();    // later runs of this script may change the settings
  forget_rows();

  strength = FixHVIJohnsonCook::find(lmp);

  ledger = FixHVILedger::instance(lmp);
  follow = igroup != 0 && !set.is_stock() && modify->get_fix_by_style("^sph$").empty();
  reset_dt();
  checked = 0;
}

/* ---------------------------------------------------------------------- */

void FixHVISPH::reset_dt()
{
  dtv = update->dt;
  dtf = 0.5 * update->dt;
}

/* ----------------------------------------------------------------------
   Rates belong to extrapolated values of velocity, density and energy.  A run
   that goes on where the last one or a restart file ended starts from the very
   same rates; a particle that a command has changed in between starts anew.
------------------------------------------------------------------------- */

uint64_t FixHVISPH::fingerprint(int i) const
{
  const double list[5] = {atom->v[i][0], atom->v[i][1], atom->v[i][2], atom->rho[i], atom->esph[i]};
  uint64_t mark = 0x9E3779B97F4A7C15ull;
  for (const double value : list) {
    uint64_t bits;
    memcpy(&bits, &value, sizeof(bits));
    mark = (mark ^ bits) * 0xFF51AFD7ED558CCDull;
    mark ^= mark >> 32;
  }
  return mark | 1;    // 0: never integrated
}

bool FixHVISPH::has_material(int i) const
{
  return store->fields.settings.h[atom->type[i]] > 0.0;
}

// particles in elements go where these go

bool FixHVISPH::moves(int i) const
{
  return (atom->mask[i] & (groupbit | store->embedded)) == groupbit;
}

bool FixHVISPH::integrates(int i) const
{
  return moves(i) && has_material(i);
}

// what others move must be remembered, too, where forces go by the velocity of the middle of a step

bool FixHVISPH::remembers(int i) const
{
  return integrates(i) || (store->fields.settings.whole && has_material(i));
}

void FixHVISPH::setup_pre_force(int /*vflag*/)
{
  const HVI::SphSettings &set = store->fields.settings;
  double longest = 0.0;
  for (int i = 0; i < atom->nlocal; i++) {
    const int itype = atom->type[i];
    if (!has_material(i)) continue;
    Extra &e = extra[i];
    if (atom->rho[i] == 0.0 && e.mark == 0 && store->materials.entry(itype).volume > 0.0)
      atom->rho[i] = store->materials.of(itype)->eos->rho0();
    if (e.hscale == 0.0) {
      if (set.variable && !(atom->rho[i] > 0.0))
        error->one(FLERR,
                   "Fix hvi/sph: h variable needs the density of particle {} at the start of its "
                   "first run, not {}",
                   atom->tag[i], atom->rho[i]);
      e.hscale = set.hscale(itype, atom->rho[i]);
    }
    const bool anew = set.is_stock() || !remembers(i) || e.mark != fingerprint(i) ||
        set.whole != (e.settled != 0.0);
    if (anew && (integrates(i) || follow))
      for (int k = 0; k < 3; k++) atom->vest[i][k] = atom->v[i][k];
    if (strength) strength->start(i, anew);
    if (anew) {
      e.settled = set.whole ? atom->rho[i] : 0.0;
      if (!set.whole) e.step = 0.0;    // else the last half kick was one of that step
    }
    if (!integrates(i)) continue;
    if (!anew) longest = std::max(longest, e.step);
    if (anew) {
      e.rho = atom->rho[i];
      e.esph = atom->esph[i];
      e.trend_rho = e.trend_e = 0.0;
      for (int k = 0; k < 3; k++) {
        e.trend_v[k] = 0.0;
        e.working[k] = atom->v[i][k];
      }
    }
    std::swap(e.rho, atom->rho[i]);
    std::swap(e.esph, atom->esph[i]);
    e.drho = atom->rho[i];
  }
  MPI_Allreduce(&longest, &last, 1, MPI_DOUBLE, MPI_MAX, world);
  comm->forward_comm();
  if (set.variable) comm->forward_comm(this);
}

/* ---------------------------------------------------------------------- */

void FixHVISPH::setup(int /*vflag*/)
{
  if (!checked) {
    check_left_out();
    check_step();
    checked = 1;
  }
  stepping = 1;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!integrates(i)) continue;
    Extra &e = extra[i];

    // unless sph/rhosum has replaced the density in the meantime

    if (atom->rho[i] == e.drho)
      std::swap(e.rho, atom->rho[i]);
    else
      e.rho = atom->rho[i];
    e.drho = 0.0;
    std::swap(e.esph, atom->esph[i]);
    e.stretch = 0.0;
  }
  keep_places();
  power = store->fields.viscous_power;
  for (int k = 0; k < 3; k++) push[k] = store->fields.plane_force[k];
}

/* ----------------------------------------------------------------------
   Half a kick and a drift; then rho, esph and vest are extrapolated to the end
   of the step, where rates are evaluated (Zisis et al. eq 18).  The package SPH
   evaluates them with density and energy of the middle of the step.

   So oscillations that nothing damps grow by (omega dt)^4/8 and more in a step: a wall of two layers
   rings in its thickness.  Solids with gradient corrected go by the leapfrog, which keeps them up to
   omega dt = 2: vest is the velocity of the middle of the step, which brings density and stress to
   its end, before forces: settle_density(), settle_solids().  What is extrapolated with rho and
   esph, by their rates and the change of these in the last step, are weights and heat.  Forces do
   work on the velocity of the end of the step, with a sixth of the change of acceleration extrapolated
   to third order; when that is known, see missed_work().
------------------------------------------------------------------------- */

void FixHVISPH::initial_integrate(int /*vflag*/)
{
  stepping = 1;
  double *const *const x = atom->x;
  double *const *const v = atom->v;
  double *const *const vest = atom->vest;
  const double *const *const f = atom->f;
  double *const rho = atom->rho;
  double *const esph = atom->esph;
  const double ahead = store->fields.settings.is_stock() ? 0.0 : 1.0;
  const bool whole = store->fields.settings.whole;
  if (strength) strength->first_half(dtv, groupbit);
  due = whole;
  last = dtv;
  double missed = 0.0;

  for (int i = 0; i < atom->nlocal; i++) {
    if (!moves(i)) continue;
    const double dtfm = dtf / (atom->rmass ? atom->rmass[i] : atom->mass[atom->type[i]]);
    Extra &e = extra[i];
    const bool solid = whole && has_material(i);
    const double beyond = solid ? missed_work(i) : 0.0, power_e = atom->desph[i] - beyond;
    for (int k = 0; k < 3; k++) {
      vest[i][k] = v[i][k] + 2.0 * dtfm * f[i][k];
      v[i][k] += dtfm * f[i][k];
      x[i][k] += dtv * v[i][k];
      if (!solid) continue;
      e.working[k] = vest[i][k] + dtf / 3.0 * e.trend_v[k];
      e.trend_v[k] = dtfm / dtf * f[i][k];
      vest[i][k] = v[i][k];
    }
    const double drho = dtf * atom->drho[i], de = dtf * power_e;
    e.drho = ahead * drho;
    e.de = ahead * de;
    if (solid) {
      const double kick = missed_kick(i);
      missed += kick + dtf * beyond;
      esph[i] -= kick;
      e.settled = rho[i];
      e.stretch = 0.0;
      e.drho += dtv * e.trend_rho;    // the rate is that of the middle of the last step
      e.de += dtf * e.trend_e;
      e.trend_rho = atom->drho[i];
      e.trend_e = power_e;
    }
    rho[i] += drho + e.drho;
    esph[i] += de + e.de;
  }
  ledger->book_missed(missed);
}

/* ---------------------------------------------------------------------- */

void FixHVISPH::final_integrate()
{
  const bool whole = store->fields.settings.whole;
  double *const *const v = atom->v;
  const double *const *const f = atom->f;
  double *const rho = atom->rho;
  double *const esph = atom->esph;
  double missed = 0.0;

  for (int i = 0; i < atom->nlocal; i++) {
    if (!moves(i)) continue;
    const double dtfm = dtf / (atom->rmass ? atom->rmass[i] : atom->mass[atom->type[i]]);
    for (int k = 0; k < 3; k++) v[i][k] += dtfm * f[i][k];
    Extra &e = extra[i];
    const bool solid = whole && has_material(i);
    const double beyond = solid ? missed_work(i) : 0.0, power_e = atom->desph[i] - beyond;
    e.rho = rho[i];
    e.esph = esph[i];
    if (solid)
      rho[i] = e.settled + dtv * (atom->drho[i] - e.stretch);    // interface density dissipation
    else
      rho[i] += dtf * atom->drho[i] - e.drho;
    esph[i] += dtf * power_e - e.de;
    if (solid) {
      e.step = dtv;
      missed += dtf * beyond;
      const bool was_there =
          (e.drho != 0.0 || e.de != 0.0) && !std::isnan(e.trend_rho);    // in the first half
      e.trend_rho = was_there ? atom->drho[i] - e.trend_rho : 0.0;
      e.trend_e = was_there ? power_e - e.trend_e : 0.0;
      for (int k = 0; k < 3; k++)
        e.trend_v[k] = was_there ? dtfm / dtf * f[i][k] - e.trend_v[k] : 0.0;
    }
    e.drho = e.de = e.stretch = 0.0;
  }
  ledger->book_missed(missed);
  keep_places();
  if (strength && !whole) strength->second_half(dtv);

  const double now = store->fields.viscous_power;
  ledger->book_viscous(dtf * (power + now));
  power = now;
  if (store->fields.settings.mirror.planes) {
    double impulse[3];
    for (int k = 0; k < 3; k++) {
      impulse[k] = dtf * (push[k] + store->fields.plane_force[k]);
      push[k] = store->fields.plane_force[k];
    }
    ledger->book_mirror(impulse);
  }
}

/* ---------------------------------------------------------------------- */

void FixHVISPH::post_run()
{
  for (int i = 0; i < atom->nlocal; i++) extra[i].mark = remembers(i) ? fingerprint(i) : 0;
  stepping = 0;
}

/* ---------------------------------------------------------------------- */

// a restart file in the middle of a run is like one at its end

FixHVISPH::Extra FixHVISPH::stored(int i) const
{
  Extra e = extra[i];
  if (stepping) e.mark = remembers(i) ? fingerprint(i) : 0;
  return e;
}

// how many particles were asleep in the last forces

double FixHVISPH::compute_scalar()
{
  const FixHVIStore *const now = FixHVIStore::find(lmp);
  bigint here = 0, all;
  if (now)
    for (const char one : now->fields.sleepers) here += one;
  MPI_Allreduce(&here, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  return all;
}

/* ----------------------------------------------------------------------
   Reference density of a type's material, so that inputs need not repeat what
   its file says; known before the first run.
------------------------------------------------------------------------- */

double FixHVISPH::compute_vector(int n)
{
  const auto *const now = FixHVIStore::find(lmp);
  const auto *const material = now ? now->materials.of(n + 1) : nullptr;
  return material ? material->eos->rho0() : 0.0;
}
