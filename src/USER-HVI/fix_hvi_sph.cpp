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
#include "fix_deform.h"
#include "fix_hvi_johnson_cook.h"
#include "fix_hvi_ledger.h"
#include "fix_hvi_store.h"
#include "force.h"
#include "group.h"
#include "hvi_anew.h"
#include "hvi_compat.h"
#include "hvi_interface.h"
#include "hvi_timestep.h"
#include "modify.h"
#include "timer.h"
#include "update.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstring>
#include <utility>

using namespace LAMMPS_NS;
using namespace FixConst;

/* ----------------------------------------------------------------------
   Data files: what the last rates belong to, for particles that go on from it, and the constant of
   variable h.  atom_style sph does not write vest.  In sections of their own: rates of the begin of the last step, and
   what the last forces belong to.  Data files have no NaN: it is DBL_MAX.
------------------------------------------------------------------------- */

static constexpr int RATES = 1, STEP = 2;

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
    {"rho", 0, offsetof(Extra, rates_rho),
     [](const FixHVISPH &fix, int i) {
       return fix.goes_on(i) ? fix.extra[i].rates_rho : fix.atom->rho[i];
     }},
    {"esph", 0, offsetof(Extra, rates_esph),
     [](const FixHVISPH &fix, int i) {
       return fix.goes_on(i) ? fix.extra[i].rates_esph : fix.atom->esph[i];
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
    {"drho", RATES, offsetof(Extra, old_drho),
     [](const FixHVISPH &fix, int i) {
       return std::isnan(fix.extra[i].old_drho) ? DBL_MAX : fix.extra[i].old_drho;
     },
     [](FixHVISPH &fix, int i, double rate) {
       fix.extra[i].old_drho = rate < DBL_MAX ? rate : NAN;
     }},
    {"desph", RATES, offsetof(Extra, old_de)},
    {"ax", RATES, offsetof(Extra, old_a[0])},
    {"ay", RATES, offsetof(Extra, old_a[1])},
    {"az", RATES, offsetof(Extra, old_a[2])},
    {"work_vx", STEP, offsetof(Extra, v_work[0])},
    {"work_vy", STEP, offsetof(Extra, v_work[1])},
    {"work_vz", STEP, offsetof(Extra, v_work[2])},
    {"new_rho", STEP, offsetof(Extra, new_rho)},
    {"step", STEP, offsetof(Extra, step)},
    {"weight", STEP, offsetof(Extra, weight)},
    {"beyond", STEP, offsetof(Extra, beyond)},
    {"frozen", STEP, offsetof(Extra, frozen)},
    {"body", STEP, offsetof(Extra, body), nullptr, nullptr, true},

    // 0 between steps, or made anew when a run begins
    {nullptr, 0, offsetof(Extra, drho)},
    {nullptr, 0, offsetof(Extra, de)},
    {nullptr, 0, offsetof(Extra, x_before[0])},
    {nullptr, 0, offsetof(Extra, x_before[1])},
    {nullptr, 0, offsetof(Extra, x_before[2])},
};

// the velocity that the last rates belong to

const double *FixHVISPH::felt_velocity(int i) const
{
  return goes_on(i) ? atom->vest[i] : atom->v[i];
}

/* ---------------------------------------------------------------------- */

FixHVISPH::FixHVISPH(LAMMPS *lmp, int narg, char **arg) :
    FixHVIRecords(lmp, narg, arg, Extra(), FIELDS, {"", "_rates", "_step"}), store(nullptr),
    ledger(nullptr), strength(nullptr), evaluation(nullptr), dtv(0.0), dtf(0.0),
    power(0.0), push{0.0, 0.0, 0.0}, last(0.0), due(false), stepping(0), wallbit(0), follow(0),
    checked(0), quiet(1.0e-10), relative(true), most_frozen(0), deletes_frozen(false), swiftest(0.0)
{
  static_assert(covers<Extra>(FIELDS), "a number of the record is missing, or there twice");
  static_assert(have_room(FIELDS), "lines of data files are too long");
  if (!atom->esph_flag || !atom->rho_flag || !atom->vest_flag)
    error->all(FLERR,
               "Fix hvi/sph needs density, energy and velocity estimates of particles: use "
               "atom_style sph");
  for (int iarg = 3; iarg < narg; iarg += 2) {
    const std::string key = arg[iarg];
    if (key != "walls" && key != "sleep" && key != "lists" && key != "bad")
      error->all(FLERR, "Unknown fix hvi/sph keyword: {}", key);
    if (iarg + 2 > narg) utils::missing_cmd_args(FLERR, "fix hvi/sph " + key, error);
    const std::string value = arg[iarg + 1];
    if (key == "walls") {
      const int jgroup = group->find(value);
      if (jgroup == -1) error->all(FLERR, "Could not find fix hvi/sph walls group ID {}", value);
      wallbit |= group->bitmask[jgroup];
    } else if (key == "bad") {
      if (value != "error" && value != "freeze" && value != "delete")
        error->all(FLERR, "Fix hvi/sph bad must be error, freeze N or delete N, not {}", value);
      most_frozen = 0;
      deletes_frozen = value == "delete";
      if (value == "error") continue;
      if (++iarg + 2 > narg) utils::missing_cmd_args(FLERR, "fix hvi/sph bad " + value, error);
      most_frozen = utils::bnumeric(FLERR, arg[iarg + 1], false, lmp);
      if (most_frozen < 1)
        error->all(FLERR, "Fix hvi/sph bad {} must be 1 or more particles, not {}", value,
                   arg[iarg + 1]);
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
  comm_border = 2;
  comm_forward = 2;
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
  HVI::run_anew(update);
  atom->delete_callback(id, Atom::BORDER);
}

/* ---------------------------------------------------------------------- */

int FixHVISPH::setmask()
{
  return INITIAL_INTEGRATE | POST_INTEGRATE | PRE_NEIGHBOR | PRE_FORCE | FINAL_INTEGRATE;
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
  for (Fix *const other : modify->get_fix_list()) {
    if (!(other->box_change & (BOX_CHANGE_SIZE | BOX_CHANGE_SHAPE))) continue;
    const auto *const deform = dynamic_cast<FixDeform *>(other);
    if (!deform || deform->remapflag != Domain::NO_REMAP)
      error->all(
          FLERR,
          "Fix hvi/sph does not support fix {} {}: it may move particles with the box, without "
          "a velocity, so they would not feel it; fix deform may have remap none",
          other->id, other->style);
  }
  if (update->dt < 0.0)
    error->all(FLERR, "Fix hvi/sph: the time step must not be negative: {}", update->dt);

  store = FixHVIStore::find(lmp);
  if (!store || !force->pair_match("^hvi/sph$", 0))
    error->all(FLERR, "Fix hvi/sph needs pair style hvi/sph");
  const HVI::SphSettings &set = store->fields.settings;
  check_restart();

  check_restored();
  restored.clear();    // later runs of this script may change the settings
  forget_rows();

  strength = FixHVIJohnsonCook::find(lmp);
  evaluation = HVI::find_interface<HVI::SphStep>(lmp).at(0);
  ledger = FixHVILedger::instance(lmp);
  follow = igroup != 0 && !set.is_stock() && modify->get_fix_by_style("^sph$").empty();
  reset_dt();
  checked = 0;
  weight_power.assign(atom->ntypes + 1, 1.0);
  for (int i = 1; i <= atom->ntypes; i++) {
    const HVI::Material *const material = store->materials.of(i);
    if (material && material->eos->rho0() > 0.0) weight_power[i] = 2.0 / 3.0;
  }
  moved_by_others = 0;
  for (const Fix *const other : modify->get_fix_list())
    if (other->time_integrate && !utils::strmatch(other->style, "^hvi/"))
      moved_by_others |= other->groupbit;
  if (store->has_moved && last_at_rest.empty() && comm->me == 0)
    error->warning(FLERR,
                   "Fix hvi/sph is given anew: what the one before kept of particles is lost, so "
                   "those that touch become one body, and smoothing lengths, rates and frozen "
                   "particles begin anew");

  for (const Fix *const other : modify->get_fix_list()) {
    if (!other->time_integrate || utils::strmatch(other->style, "^hvi/")) continue;
    bigint here = 0, both;
    for (int i = 0; i < atom->nlocal; i++) here += moves(i) && (atom->mask[i] & other->groupbit);
    MPI_Allreduce(&here, &both, 1, MPI_LMP_BIGINT, MPI_SUM, world);
    if (both)
      error->all(FLERR,
                 "Fix {} ({}) moves {} particles that fix hvi/sph moves, too: give one of them a "
                 "group without these",
                 other->id, other->style, both);
  }
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
   same rates; a particle that a command has changed in between starts anew.  The lowest byte of a mark is the
   particle's type then, and a 1: 0 is that of one that was never integrated.
------------------------------------------------------------------------- */

static constexpr int TYPES = 128;

static uint64_t low_byte(int itype)
{
  return (uint64_t) (itype % TYPES) << 1 | 1;
}

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
  return (mark & ~(uint64_t) 255) | low_byte(atom->type[i]);
}

// another type alone is no change

bool FixHVISPH::goes_on(int i) const
{
  return extra[i].mark && (extra[i].mark | 255) == (fingerprint(i) | 255);
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

// In solids what no fix moves stands still, whatever velocity a piston has left it

bool FixHVISPH::stands(int i) const
{
  return store->fields.settings.solid && has_material(i) &&
      !(atom->mask[i] & (groupbit | store->embedded | moved_by_others));
}

// what others move must be remembered, too, where forces go by the velocity of the middle of a step

bool FixHVISPH::remembers(int i) const
{
  return integrates(i) || (store->fields.settings.solid && has_material(i));
}

// at the start of its first run, and the smoothing length that goes with it

void FixHVISPH::give_density(int i)
{
  const HVI::SphSettings &set = store->fields.settings;
  const int itype = atom->type[i];
  Extra &e = extra[i];
  if (atom->rho[i] == 0.0 && e.mark == 0 && e.frozen == 0.0 &&
      store->materials.entry(itype).volume > 0.0)
    atom->rho[i] = store->materials.of(itype)->eos->rho0();
  if (e.hscale != 0.0) return;
  if (set.variable && !(atom->rho[i] > 0.0))
    error->one(
        FLERR,
        "Fix hvi/sph: h variable needs the density of particle {} at the start of its first run, "
        "or, if it comes during a run, a spacing or volume in pair_coeff; its density is {}",
        atom->tag[i], atom->rho[i]);
  e.hscale = set.hscale(itype, std::fabs(atom->rho[i]));    // of what freezes at once, too, no NaN
}

/* ----------------------------------------------------------------------
   What comes during a run, by fix deposit for instance, begins as all do at the start of a run: density, velocity and mass
   before they are sent to ghosts, the state of a solid when all fixes have made their records.  What comes in the same
   step is one body, with a label that is no ID.
------------------------------------------------------------------------- */

void FixHVISPH::set_arrays(int i)
{
  static constexpr int64_t NO_ID = (int64_t) 1 << 48;    // with planes it is exact in a double
  FixHVIRecords::set_arrays(i);
  if (!stepping || !store || !integrates(i) || extra[i].mark != 0) return;
  if (atom->rmass) atom->rmass[i] = atom->mass[atom->type[i]];
  give_density(i);
  for (int k = 0; k < 3; k++) atom->vest[i][k] = extra[i].v_work[k] = atom->v[i][k];
  set_body(i, NO_ID + update->ntimestep, 0);
}

void FixHVISPH::pre_neighbor()
{
  count_frozen();
  if (!stepping || !store->fields.settings.solid) return;
  for (int i = 0; i < atom->nlocal; i++)
    if (extra[i].new_rho == 0.0 && extra[i].frozen == 0.0 && integrates(i)) {
      if (strength) strength->start_newcomer(i);
      extra[i].new_rho = atom->rho[i];
    }
}

/* ---------------------------------------------------------------------- */

void FixHVISPH::setup_pre_force(int /*vflag*/)
{
  const HVI::SphSettings &set = store->fields.settings;
  double longest = 0.0;
  setup_rho.assign(atom->nlocal, 0.0);
  for (int i = 0; i < atom->nlocal; i++) {
    if (!has_material(i)) continue;
    Extra &e = extra[i];
    give_density(i);
    const bool anew = set.is_stock() || !remembers(i) || !goes_on(i) ||
        set.solid != (e.new_rho != 0.0);
    if (anew && (integrates(i) || follow))
      for (int k = 0; k < 3; k++) atom->vest[i][k] = atom->v[i][k];
    if (stands(i)) std::fill_n(atom->vest[i], 3, 0.0);
    if (strength) strength->start(i, anew);
    if (anew) {
      e.new_rho = set.solid ? atom->rho[i] : 0.0;
      if (!set.solid) e.step = 0.0;    // else the last half kick was one of that step
    }
    if (!integrates(i)) continue;
    if (!anew) longest = std::max(longest, e.step);
    if (anew) {
      e.rates_rho = atom->rho[i];
      e.rates_esph = atom->esph[i];
      e.old_drho = NAN;
      e.weight = 1.0;
      for (int k = 0; k < 3; k++) e.v_work[k] = atom->v[i][k];
      e.beyond = 0.0;
    }

    // forces are asked for with what their rates belong to; the state waits in its place

    std::swap(e.rates_rho, atom->rho[i]);
    std::swap(e.rates_esph, atom->esph[i]);
    setup_rho[i] = atom->rho[i];
  }
  MPI_Allreduce(&longest, &last, 1, MPI_DOUBLE, MPI_MAX, world);
  if (strength) check_turned();
  due = false;
  in_setup = true;
  comm->forward_comm();
  if (set.variable) tell_ghosts();
}

/* ---------------------------------------------------------------------- */

void FixHVISPH::setup(int /*vflag*/)
{
  store->has_moved = true;
  check_materials();
  store->has_forgotten = false;
  if (!checked) {
    check_left_out();
    check_step();
    checked = 1;
  }
  stepping = 1;
  in_setup = false;
  swiftest = 0.0;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!integrates(i)) continue;
    Extra &e = extra[i];

    // unless sph/rhosum has replaced the density in the meantime

    if (atom->rho[i] == setup_rho[i])
      std::swap(e.rates_rho, atom->rho[i]);
    else
      e.rates_rho = atom->rho[i];
    std::swap(e.rates_esph, atom->esph[i]);
    note_change(i);
  }
  count_frozen();
  keep_places();
  power = store->fields.viscous_power;
  for (int k = 0; k < 3; k++) push[k] = store->fields.plane_force[k];
}

// Where density would fall below half of itself it goes on with its logarithm, so never below 0

static double changed(double rho, double change)
{
  return change >= -0.5 * rho ? rho + change : 0.5 * rho * std::exp(2.0 * change / rho + 1.0);
}

// to the end of a step: half of its change, and then more, which is taken back when that is known

static void extrapolate(double &rho, double half, double &more)
{
  if (HVI::SphFields::is_frozen(rho)) return;
  const double change = half + more, end = changed(rho, change);
  if (change < -0.5 * rho) more = end - changed(rho, half);
  rho = end;
}

/* ----------------------------------------------------------------------
   A type that has got another material since the last run, or a particle that has got another type: masses are by it,
   densities may not be
------------------------------------------------------------------------- */

void FixHVISPH::check_materials()
{
  const int ntypes = atom->ntypes;
  std::vector<double> at_rest(ntypes + 1, 0.0);
  for (int itype = 1; itype <= ntypes; itype++)
    if (const HVI::Material *const material = store->materials.of(itype))
      at_rest[itype] = material->eos->rho0();
  const auto before = [&](int itype) {
    return itype > 0 && itype < (int) last_at_rest.size() ? last_at_rest[itype] : at_rest[itype];
  };
  std::vector<double> off(2 * (ntypes + 1), 0.0);    // and those that were of another type
  double *const come = &off[ntypes + 1];
  for (int i = 0; i < atom->nlocal; i++) {
    const int itype = atom->type[i], mark = extra[i].mark & 255, old = mark >> 1;
    if (!(std::fabs(atom->rho[i] - at_rest[itype]) > 0.2 * at_rest[itype])) continue;
    if (old > 0 && old <= ntypes && mark != (int) low_byte(itype) && before(old) != at_rest[itype])
      come[itype] += 1.0;
    else if (before(itype) != at_rest[itype])
      off[itype] += 1.0;
  }
  MPI_Allreduce(MPI_IN_PLACE, off.data(), off.size(), MPI_DOUBLE, MPI_SUM, world);
  for (int itype = 1; itype <= ntypes && !comm->me; itype++) {
    if (!(at_rest[itype] > 0.0)) continue;
    if (off[itype] > 0.0 && before(itype) > 0.0)
      error->warning(FLERR,
                     "Fix hvi/sph: type {} had a material of density {} at rest in the last run "
                     "and now has one of {}, and {} of its particles have densities more than 20 % "
                     "off that: use set type {} sph/rho",
                     itype, before(itype), at_rest[itype], off[itype], itype);
    if (come[itype] > 0.0)
      error->warning(FLERR,
                     "Fix hvi/sph: {} particles that were of another type in the last run have "
                     "become type {} and have densities more than 20 % off that of its material at "
                     "rest, {}: use set group ID sph/rho",
                     come[itype], itype, at_rest[itype]);
  }
  last_at_rest = at_rest;
}

/* ----------------------------------------------------------------------
   Half a kick and a drift; then rho, esph and vest are extrapolated to the end
   of the step, where rates are evaluated (Zisis et al. eq 18).  The package SPH
   evaluates them with density and energy of the middle of the step.

   So oscillations that nothing damps grow by (omega dt)^4/8 and more in a step: a wall of two layers
   rings in its thickness.  Solids go by the leapfrog, which keeps them up to omega dt = 2: vest is the
   velocity of the middle of the step, which brings density and stress to its end before forces, see
   HVISchemeSolid.  What is extrapolated with rho and esph, by their rates and the change of these in the
   last step, are heat and weights: those of forces, and how far these are from those of the middle, which L
   has.  Forces do work on the velocity of the end of the step, with a sixth of the change of acceleration
   extrapolated to third order; when that is known, see missed_work().
------------------------------------------------------------------------- */

void FixHVISPH::initial_integrate(int /*vflag*/)
{
  stepping = 1;
  const double ahead = store->fields.settings.is_stock() ? 0.0 : 1.0;
  const bool solid = store->fields.settings.solid;
  if (strength) strength->begin_step();
  due = solid;
  double missed = 0.0;

  for (int i = 0; i < atom->nlocal; i++) {
    if (!moves(i)) continue;
    if (is_still(i)) {
      for (int k = 0; k < 3; k++) atom->x[i][k] += dtv * atom->v[i][k];
      continue;
    }
    const double dtfm = dtf / (atom->rmass ? atom->rmass[i] : atom->mass[atom->type[i]]);
    if (solid && has_material(i)) {
      missed += first_half_solid(i, dtfm);
      continue;
    }
    double *const v = atom->v[i], *const f = atom->f[i];
    Extra &e = extra[i];
    if (solid)
      for (int k = 0; k < 3; k++) e.old_a[k] = v[k] - e.v_work[k];
    for (int k = 0; k < 3; k++) {
      atom->vest[i][k] = v[k] + 2.0 * dtfm * f[k];
      v[k] += dtfm * f[k];
      atom->x[i][k] += dtv * v[k];
    }
    const double drho = dtf * atom->drho[i], de = dtf * atom->desph[i];
    e.drho = ahead * drho;
    e.de = ahead * de;
    extrapolate(atom->rho[i], drho, e.drho);
    atom->esph[i] += de + e.de;
  }
  last = dtv;
  ledger->book_missed(missed);
}

/* ----------------------------------------------------------------------
   Rates are those of the middle of the last step; their change in it is known if there were rates before.
   Returns the energy that is booked as missed.
------------------------------------------------------------------------- */

double FixHVISPH::first_half_solid(int i, double dtfm)
{
  double *const v = atom->v[i], *const f = atom->f[i];
  Extra &e = extra[i];
  const double gain = atom->desph[i] - e.beyond, kick = missed_kick(i);
  const bool has_old = !std::isnan(e.old_drho);
  const double dtf_then = 0.5 * last;    // to the last digit as at the end of the last step
  const double per_mass =
      dtf_then / (atom->rmass ? atom->rmass[i] : atom->mass[atom->type[i]]) / dtf_then;
  for (int k = 0; k < 3; k++) {
    const double end = v[k] + 2.0 * dtfm * f[k];
    const double change = has_old ? per_mass * f[k] - e.old_a[k] : 0.0;
    v[k] += dtfm * f[k];
    atom->x[i][k] += dtv * v[k];
    e.v_work[k] = end + dtf / 3.0 * change;
    e.old_a[k] = dtf > 0.0 ? dtfm / dtf * f[k] : 0.0;
    atom->vest[i][k] = v[k];
  }
  const double drho = dtf * atom->drho[i], de = dtf * gain;
  e.drho = drho + dtv * (has_old ? atom->drho[i] - e.old_drho : 0.0);
  e.de = de + dtf * (has_old ? gain - e.old_de : 0.0);
  e.old_drho = e.drho != 0.0 || e.de != 0.0 ? atom->drho[i] : NAN;
  e.old_de = gain;
  e.new_rho = atom->rho[i];
  atom->esph[i] -= kick;
  extrapolate(atom->rho[i], drho, e.drho);
  atom->esph[i] += de + e.de;

  // w = V (rho/rho0)^(1/3), or V without rho0, to first order in what V changes by.  A frozen particle has none.

  const double begin = e.new_rho;
  if (!HVI::SphFields::is_frozen(begin))
    e.weight = 1.0 + 0.5 * weight_power[atom->type[i]] * (atom->rho[i] - begin) / begin;
  return kick + dtf * e.beyond;
}

/* ----------------------------------------------------------------------
   Ghosts and lists are there, forces are 0.  Where pair style sph/rhosum makes densities, which comes later,
   pair style hvi/sph does this itself; in a setup, too, after fix hvi/fem has put particles into their places.
   LAMMPS's breakdown of times counts it as that of the pair style.
------------------------------------------------------------------------- */

void FixHVISPH::pre_force(int /*vflag*/)
{
  if (store->fields.settings.is_stock()) return;
  timer->stamp(Timer::MODIFY);
  evaluation->prepare();
  timer->stamp(Timer::PAIR);
}

/* ---------------------------------------------------------------------- */

void FixHVISPH::final_integrate()
{
  const HVI::SphFields &sph = store->fields;
  double *const rho = atom->rho, *const esph = atom->esph;
  double missed = 0.0;
  swiftest = 0.0;

  for (int i = 0; i < atom->nlocal; i++) {
    if (!moves(i) || is_still(i)) continue;
    const double dtfm = dtf / (atom->rmass ? atom->rmass[i] : atom->mass[atom->type[i]]);
    for (int k = 0; k < 3; k++) atom->v[i][k] += dtfm * atom->f[i][k];
    Extra &e = extra[i];
    e.rates_rho = rho[i];
    e.rates_esph = esph[i];
    double gain = atom->desph[i];
    if (sph.settings.solid && has_material(i)) {
      e.beyond = missed_work(i);
      const double by_L = -sph.density(i) * sph.divergence(i);
      gain -= e.beyond;
      missed += dtf * e.beyond;
      e.step = may_be_still(i) ? -dtv : dtv;

      // what is not by L is interface density dissipation

      if (!HVI::SphFields::is_frozen(rho[i]))
        rho[i] = changed(e.new_rho, dtv * (atom->drho[i] - by_L));
    } else {
      if (sph.settings.solid) {
        std::copy_n(atom->v[i], 3, e.v_work);
        e.old_drho = 0.0;
      }
      if (!HVI::SphFields::is_frozen(rho[i]))
        rho[i] = changed(rho[i], dtf * atom->drho[i] - e.drho);
    }
    note_change(i);
    esph[i] += dtf * gain - e.de;
    e.drho = e.de = 0.0;
  }
  ledger->book_missed(missed);
  keep_places();

  const double now = sph.viscous_power;
  ledger->book_viscous(dtf * (power + now));
  power = now;
  if (sph.settings.mirror.planes) {
    double impulse[3];
    for (int k = 0; k < 3; k++) {
      impulse[k] = dtf * (push[k] + sph.plane_force[k]);
      push[k] = sph.plane_force[k];
    }
    ledger->book_mirror(impulse);
  }
}

/* ----------------------------------------------------------------------
   A particle of a solid is still if it is inactive and a step changes no number of it but its place, so that all else
   can be left out, to the last bit.  may_be_still() is asked at the end of a step, is_still() as long as step
   says so.
------------------------------------------------------------------------- */

bool FixHVISPH::may_be_still(int i) const
{
  const Extra &e = extra[i];
  if (!store->fields.asleep(i) || !is_left_alone(i)) return false;
  for (int k = 0; k < 3; k++)
    if (e.old_a[k] != 0.0 || e.v_work[k] != atom->v[i][k]) return false;
  return std::isnan(e.old_drho) && e.old_de == 0.0 && e.drho == 0.0 && e.de == 0.0 &&
      e.weight == 1.0;
}

bool FixHVISPH::is_still(int i) const
{
  return store->fields.asleep(i) && extra[i].step < 0.0 && is_left_alone(i);
}

// by forces, and by fixes that change it themselves

bool FixHVISPH::is_left_alone(int i) const
{
  const double *const f = atom->f[i], *const v = atom->v[i], *const vest = atom->vest[i];
  for (int k = 0; k < 3; k++)
    if (f[k] != 0.0 || vest[k] != v[k]) return false;
  return atom->drho[i] == 0.0 && atom->desph[i] == 0.0 && atom->rho[i] == extra[i].new_rho &&
      atom->esph[i] == extra[i].rates_esph;
}

/* ---------------------------------------------------------------------- */

void FixHVISPH::post_run()
{
  for (int i = 0; i < atom->nlocal; i++) {
    extra[i].mark = remembers(i) ? fingerprint(i) : 0;
    extra[i].step = step_of(i);
    std::copy_n(atom->x[i], 3, extra[i].x_before);
  }
  stepping = 0;
}

// the step that particle i has taken last; 0: fix hvi/sph does not integrate it

double FixHVISPH::step_of(int i) const
{
  if (!integrates(i)) return 0.0;
  return extra[i].step < 0.0 ? last : extra[i].step;
}

// a restart file in the middle of a run is like one at its end

FixHVISPH::Extra FixHVISPH::stored(int i) const
{
  Extra e = extra[i];
  if (stepping) {
    e.mark = remembers(i) ? fingerprint(i) : 0;
    std::copy_n(atom->x[i], 3, e.x_before);
  }
  e.step = step_of(i);
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

/* ---------------------------------------------------------------------- */

void FixHVISPH::note_change(int i)
{
  const double rho = extra[i].rates_rho;
  if (!HVI::SphFields::is_frozen(rho))
    swiftest = std::max(swiftest, std::fabs(atom->drho[i]) / rho);
}

void FixHVISPH::tighten(HVI::TimeStepBounds &bounds)
{
  static constexpr double MOST = 0.5;
  if (swiftest * bounds.stable > MOST) bounds.stable = MOST / swiftest;
}

/* ----------------------------------------------------------------------
   In the middle of a step, for its density rho: the extrapolation of energy is undone.  A density of 0 marks the
   particle, and reaches its ghosts with the next communication.  What is not finite is an error of its own.
------------------------------------------------------------------------- */

bool FixHVISPH::freeze(int i, double rho)
{
  if (most_frozen == 0 || !integrates(i) || HVI::SphFields::is_frozen(atom->rho[i])) return false;
  Extra &e = extra[i];
  if (!std::isfinite(rho) || !std::isfinite(atom->esph[i])) return false;
  atom->esph[i] -= e.de;
  atom->rho[i] = e.new_rho = e.drho = e.de = 0.0;
  e.old_drho = NAN;
  e.frozen = 1.0;
  ledger->book_frozen();
  error->warning(
      FLERR,
      "Fix hvi/sph: no equation of state answers for particle {} (type {}) at step {}: it "
      "takes no part from now on, and keeps its momentum and energy",
      atom->tag[i], atom->type[i], update->ntimestep);
  return true;
}

// collective: when a run begins, and with new lists

void FixHVISPH::count_frozen() const
{
  if (most_frozen == 0) return;
  double entry[FixHVILedger::NENTRY];
  ledger->totals(entry);
  const double frozen = entry[FixHVILedger::FROZEN];
  if (frozen > most_frozen)
    error->all(
        FLERR,
        "Fix hvi/sph: {} particles take no part any more at step {}, more than the {} that bad "
        "allows: see the warnings above for the first; a shorter step or another equation "
        "of state may help",
        frozen, update->ntimestep, most_frozen);
}

/* ---------------------------------------------------------------------- */

const double *FixHVISPH::work_velocity(int i) const
{
  const bool has_own = integrates(i) || (atom->mask[i] & store->embedded);
  return has_own ? extra[i].v_work : stands(i) ? atom->vest[i] : atom->v[i];
}

void FixHVISPH::set_work_velocity(int i, const double *v)
{
  for (int k = 0; k < 3; k++) extra[i].v_work[k] = v[k];
}

void FixHVISPH::let_go(int i, double de)
{
  Extra &e = extra[i];
  e.drho = 0.0;
  e.de = de;
  e.old_drho = NAN;
  if (!has_body(i)) e.body = 0.0;    // of what hangs on elements
  e.new_rho = e.rates_rho = atom->rho[i];
  e.rates_esph = atom->esph[i];
  e.weight = 1.0;
}

/* ----------------------------------------------------------------------
   What forces work on the velocity of the end of the step beyond what they did on the extrapolated
   one.  Over all particles that is the same of pairs, so it can be taken from a particle's own energy.
   A half kick gives dt/2 F.v and, at the end of a step less, at the beginning more, dt^2/8 F^2/m,
   which cancel if the steps are equal: the rest is taken from the particle's energy, too.  Then the total energy is
   kept to round-off, but for dt^2/8 F^2/m of the moment.  The first is of SPH forces only, for others
   work on v itself; F in the second is all of the force.
------------------------------------------------------------------------- */

double FixHVISPH::missed_work(int i) const
{
  if (!store->fields.settings.energy) return 0.0;
  const double *const v = atom->v[i], *const w = extra[i].v_work;
  const double *const f = store->fields.own_force(i);
  return f[0] * (v[0] - w[0]) + f[1] * (v[1] - w[1]) + f[2] * (v[2] - w[2]);
}

double FixHVISPH::missed_kick(int i) const
{
  if (!store->fields.settings.energy) return 0.0;
  const double *const f = atom->f[i];
  return 0.125 * (dtv * dtv - extra[i].step * extra[i].step) *
      (f[0] * f[0] + f[1] * f[1] + f[2] * f[2]) /
      (atom->rmass ? atom->rmass[i] : atom->mass[atom->type[i]]);
}

/* ---------------------------------------------------------------------- */

double FixHVISPH::advance_density(int i, double div)
{
  if (!integrates(i)) return atom->rho[i];
  Extra &e = extra[i];
  if (due) e.new_rho *= std::exp(-dtv * div);
  return e.new_rho;
}

/* ----------------------------------------------------------------------
   a piston, say, is moved by a fix that does not know vest, which is what forces see: its velocity, or
   that of the middle of the step, from where it has gone
------------------------------------------------------------------------- */

void FixHVISPH::post_integrate()
{
  const HVI::SphSettings &set = store->fields.settings;
  if (set.mirror.planes) reflect();
  if (!follow && !set.solid) return;
  for (int i = 0; i < atom->nlocal; i++) {
    if ((atom->mask[i] & groupbit) || !has_material(i)) continue;
    double way[3] = {0.0, 0.0, 0.0};
    if (set.solid) {
      for (int k = 0; k < 3; k++) way[k] = atom->x[i][k] - extra[i].x_before[k];
      HVI::minimum_image(domain, way[0], way[1], way[2]);
    }
    const bool goes = way[0] != 0.0 || way[1] != 0.0 || way[2] != 0.0;
    for (int k = 0; k < 3; k++)
      atom->vest[i][k] = goes ? way[k] / dtv : stands(i) ? 0.0 : atom->v[i][k];
  }
}

/* ----------------------------------------------------------------------
   of what others move, for its velocity in the middle of the next step
------------------------------------------------------------------------- */

void FixHVISPH::keep_places()
{
  if (!store->fields.settings.solid || igroup == 0) return;
  for (int i = 0; i < atom->nlocal; i++)
    if (!(atom->mask[i] & groupbit) && has_material(i))
      for (int k = 0; k < 3; k++) extra[i].x_before[k] = atom->x[i][k];
}

void FixHVISPH::share(int i, int n, double lost)
{
  Extra &e = extra[i];
  e.rates_esph = (e.rates_esph - lost) / n;
  e.de /= n;
  e.old_de /= n;
}

void FixHVISPH::hasten(int i, const double *v)
{
  for (int k = 0; k < 3; k++) {
    atom->v[i][k] += v[k];
    atom->vest[i][k] += v[k];
    extra[i].v_work[k] += v[k];
  }
}

/* ----------------------------------------------------------------------
   what has crossed a mirror plane is where its image was
------------------------------------------------------------------------- */

void FixHVISPH::reflect()
{
  const HVI::MirrorPlanes &mirror = store->fields.settings.mirror;
  double impulse[3] = {0.0, 0.0, 0.0};
  for (int i = 0; i < atom->nlocal; i++) {
    if (!integrates(i)) continue;
    int op = 0;
    for (int k = 0; k < 3; k++) {
      if (!mirror.has(k) || mirror.depth(k, atom->x[i]) >= 0.0) continue;
      op |= 1 << k;
      atom->x[i][k] = 2.0 * mirror.at[k] - atom->x[i][k];
      if (!ledger->clamps(atom->mask[i]))
        impulse[k] -=
            2.0 * (atom->rmass ? atom->rmass[i] : atom->mass[atom->type[i]]) * atom->v[i][k];
      atom->v[i][k] = -atom->v[i][k];
      atom->vest[i][k] = -atom->vest[i][k];
      extra[i].old_a[k] = -extra[i].old_a[k];
      extra[i].v_work[k] = -extra[i].v_work[k];
    }
    if (op && strength) strength->reflect(i, op);
  }
  ledger->book_mirror(impulse);
}

/* ----------------------------------------------------------------------
   the constant of variable h and the label of the body go to new ghosts
------------------------------------------------------------------------- */

int FixHVISPH::pack_border(int n, int *list, double *buf)
{
  for (int i = 0; i < n; i++) {
    buf[2 * i] = extra[list[i]].hscale;
    buf[2 * i + 1] = extra[list[i]].body;
  }
  return 2 * n;
}

int FixHVISPH::unpack_border(int n, int first, double *buf)
{
  for (int i = 0; i < n; i++) {
    extra[first + i].hscale = buf[2 * i];
    extra[first + i].body = buf[2 * i + 1];
  }
  return 2 * n;
}

int FixHVISPH::pack_forward_comm(int n, int *list, double *buf, int /*pbc_flag*/, int * /*pbc*/)
{
  return pack_border(n, list, buf);
}

void FixHVISPH::unpack_forward_comm(int n, int first, double *buf)
{
  unpack_border(n, first, buf);
}

/* ----------------------------------------------------------------------
   a run that goes on from a restart file has the settings and the materials it was written with
------------------------------------------------------------------------- */

void FixHVISPH::check_restart() const
{
  if (restored.empty()) return;
  const std::string &now = store->fields.settings.text;
  const size_t end = restored.find('\n');
  if (restored.substr(0, end) != now)
    error->all(FLERR,
               "Fix hvi/sph: the restart file was written with pair_style hvi/sph {}, this run "
               "uses {}",
               restored.substr(0, end), now);

  for (const std::string &word : utils::split_words(restored.substr(end + 1))) {
    const int itype = std::stoi(word);
    const HVI::Materials::Entry &entry = store->materials.entry(itype);
    const std::string checksum = word.substr(word.find(':') + 1);
    if (!entry.material || std::to_string(entry.material->checksum) == checksum) continue;
    static constexpr char SAYS[] =
        "Fix hvi/sph: numbers of material {} of type {} are not those the restart file was written "
        "with{}";
    if (entry.restored)
      error->all(FLERR, SAYS, entry.material->name, itype,
                 ": give pair_coeff again if the new ones are meant");
    else if (comm->me == 0)
      error->warning(FLERR, SAYS, entry.material->name, itype, "");
  }
}

/* ----------------------------------------------------------------------
   Commands between runs that turn or deform a body do not turn or change its stress
------------------------------------------------------------------------- */

void FixHVISPH::check_turned()
{
  static constexpr double ROUNDED =
      1.0e-4;                             // of the extent of what bears stress: places of dumps are
  enum { WAY = 0, PLACE = 6, N = 12 };    // the largest along and against the axes
  told_turned.resize(atom->ntypes + 1, 0);
  std::vector<std::array<double, N>> most(atom->ntypes + 1);
  for (auto &of : most) of.fill(-HUGE_VAL);
  for (int i = 0; i < atom->nlocal; i++) {
    if (!has_material(i) || std::isnan(extra[i].x_before[0]) || !strength->bears_shear(i)) continue;
    double way[3];
    for (int k = 0; k < 3; k++) way[k] = atom->x[i][k] - extra[i].x_before[k];
    HVI::minimum_image(domain, way[0], way[1], way[2]);
    std::array<double, N> &of = most[atom->type[i]];
    for (int k = 0; k < 3; k++) {
      of[WAY + k] = std::max(of[WAY + k], way[k]);
      of[WAY + 3 + k] = std::max(of[WAY + 3 + k], -way[k]);
      of[PLACE + k] = std::max(of[PLACE + k], atom->x[i][k]);
      of[PLACE + 3 + k] = std::max(of[PLACE + 3 + k], -atom->x[i][k]);
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, most[0].data(), N * most.size(), MPI_DOUBLE, MPI_MAX, world);
  for (int itype = 1; itype <= atom->ntypes; itype++) {
    const std::array<double, N> &of = most[itype];
    double apart = 0.0, extent = 0.0;
    for (int k = 0; k < 3; k++) {
      apart = std::max(apart, of[WAY + k] + of[WAY + 3 + k]);
      extent = std::max(extent, of[PLACE + k] + of[PLACE + 3 + k]);
    }
    if (!(apart > ROUNDED * extent) || told_turned[itype]) continue;
    told_turned[itype] = 1;
    if (comm->me == 0)
      error->warning(
          FLERR,
          "Fix hvi/sph: since the last run particles of type {} under stress have been moved "
          "differently, by up to {:.4g} against each other: if that has turned or deformed a "
          "body, its stress has not been turned or changed with it",
          itype, apart);
  }
}

/* ----------------------------------------------------------------------
   Energy that flows into particles whose density and energy nobody integrates is lost to the books;
   a piston that fix move or fix rigid moves is meant so
------------------------------------------------------------------------- */

void FixHVISPH::check_left_out() const
{
  int cared_for = groupbit | wallbit;
  for (const Fix *const other : modify->get_fix_list())
    if (utils::strmatch(other->style, "^sph") || utils::strmatch(other->style, "^meso") ||
        utils::strmatch(other->style, "^move$") || utils::strmatch(other->style, "^rigid"))
      cared_for |= other->groupbit;
  bigint here = 0, everywhere;
  for (int i = 0; i < atom->nlocal; i++)
    if (has_material(i) && !(atom->mask[i] & cared_for)) here++;
  MPI_Allreduce(&here, &everywhere, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (everywhere && comm->me == 0)
    error->warning(
        FLERR,
        "Fix hvi/sph: {} particles with a material are integrated by no fix: their density "
        "and energy stay, and what flows into them is missing in compute hvi/energy (walls "
        "GROUP if that is meant)",
        everywhere);

  // what it does not move has the velocity of its way

  if (!store->fields.settings.solid || modify->get_fix_by_style("^recenter$").empty()) return;
  here = 0;
  for (int i = 0; i < atom->nlocal; i++)
    here += has_material(i) && !(atom->mask[i] & (groupbit | store->embedded));
  MPI_Allreduce(&here, &everywhere, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (everywhere)
    error->all(FLERR,
               "Fix hvi/sph does not integrate {} particles, so fix recenter may give them a "
               "velocity: use velocity all zero linear",
               everywhere);
}

// a fixed step that signals, or stiff pairs of other styles, outrun

void FixHVISPH::check_step() const
{
  if (!modify->get_fix_by_style("^hvi/dt$").empty()) return;
  const double stable = HVI::stable_step(lmp, 1.0);
  if (stable > 0.0 && update->dt > stable && comm->me == 0)
    error->warning(
        FLERR,
        "Fix hvi/sph: the time step {} is above the stable one, about {}: use fix hvi/dt, "
        "or a third of that",
        update->dt, stable);
}

/* ----------------------------------------------------------------------
   For the restart file: the settings of the pair style, and the checksums of the numbers of
   materials, which a run that goes on must not change unnoticed
------------------------------------------------------------------------- */

std::string FixHVISPH::settings() const
{
  const FixHVIStore *const now = store ? FixHVIStore::find(lmp) : nullptr;
  if (!now) return restored;
  std::string text = now->fields.settings.text + "\n";
  for (int itype = 1; itype <= atom->ntypes; itype++)
    if (const HVI::Material *const material = now->materials.of(itype))
      text += fmt::format("{}:{} ", itype, material->checksum);
  return text;
}
