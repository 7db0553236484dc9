/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "compute_hvi_energy.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix_hvi_ledger.h"
#include "fix_hvi_store.h"
#include "group.h"
#include "hvi_anew.h"
#include "hvi_energy_carrier.h"
#include "hvi_interface.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;

// the global vector, in this order

// clang-format off
enum {
  KINETIC, INTERNAL, CONTACT, SPRING, BROKEN, LEFT, CLAMPS, TOTAL, RATIO,
  PX, PY, PZ, LEFT_PX, LEFT_PY, LEFT_PZ, JX, JY, JZ,
  MASS, LEFT_MASS, LEFT_COUNT, BONDS_BROKEN, BONDS_LEFT,
  P0X, P0Y, P0Z, MASS0, VISCOUS, PLASTIC, MISSED, VOIDS, FROZEN, NVALUES
};
// clang-format on

static constexpr double LARGE_DRIFT = 0.01;    // of the energy in a run: is warned of

/* ---------------------------------------------------------------------- */

ComputeHVIEnergy::ComputeHVIEnergy(LAMMPS *lmp, int narg, char **arg) :
    Compute(lmp, narg, arg), ledger(nullptr), clampbit(0), run_start(HUGE_VAL), last(0.0),
    before(0.0), warned(false), warned_of_missed(false)
{
  if (igroup != 0)
    error->all(FLERR, "Compute hvi/energy is the ledger of the whole system: group must be all");

  scalar_flag = vector_flag = 1;
  size_vector = NVALUES;
  extscalar = extvector = 0;
  peflag = 1;    // energies of pairs and bonds are tallied on the steps asked for
  timeflag = 1;

  ledger = FixHVILedger::instance(lmp);

  int iarg = 3;
  while (iarg < narg) {
    if (strcmp(arg[iarg], "clamps") == 0) {
      if (iarg + 2 > narg) utils::missing_cmd_args(FLERR, "compute hvi/energy clamps", error);
      const int jgroup = group->find(arg[iarg + 1]);
      if (jgroup == -1)
        error->all(FLERR, "Could not find compute hvi/energy clamps group ID {}", arg[iarg + 1]);
      clampbit |= group->bitmask[jgroup];
      iarg += 2;
    } else
      error->all(FLERR, "Unknown compute hvi/energy keyword: {}", arg[iarg]);
  }

  vector = new double[size_vector];
}

/* ---------------------------------------------------------------------- */

ComputeHVIEnergy::~ComputeHVIEnergy()
{
  HVI::run_anew(update);
  delete[] vector;
}

/* ---------------------------------------------------------------------- */

void ComputeHVIEnergy::init()
{
  ledger = FixHVILedger::instance(lmp);
  int bits = 0;
  for (auto &icompute : modify->get_compute_by_style("^hvi/energy$"))
    bits |= dynamic_cast<ComputeHVIEnergy *>(icompute)->clampbit;
  for (int k = 0; k < group->ngroup; k++)
    if (group->names[k] && group->dynamic[k] && (clampbit & group->bitmask[k]))
      error->all(FLERR,
                 "Compute hvi/energy clamps: group {} is dynamic, and what enters or leaves it "
                 "would be booked as work of clamps",
                 group->names[k]);
  ledger->clamp(bits);

  if (atom->molecular != Atom::ATOMIC && (force->angle || force->dihedral || force->improper))
    error->all(FLERR, "Compute hvi/energy does not book angle, dihedral and improper energies");
  if (force->kspace) error->all(FLERR, "Compute hvi/energy does not book kspace energies");
}

/* ----------------------------------------------------------------------
   the first total of all is what later ones are compared with.  Output gets others: fixes have not yet
   set up what they keep.
------------------------------------------------------------------------- */

void ComputeHVIEnergy::setup()
{
  if (run_start != HUGE_VAL) before += last - run_start;
  run_start = HUGE_VAL;
  if (update->eflag_global == update->ntimestep) compute_vector();
  invoked_vector = -1;
}

/* ---------------------------------------------------------------------- */

double ComputeHVIEnergy::compute_scalar()
{
  if (invoked_vector != update->ntimestep) compute_vector();
  invoked_scalar = invoked_vector;
  scalar = vector[TOTAL];
  return scalar;
}

/* ---------------------------------------------------------------------- */

void ComputeHVIEnergy::warn(double drift)
{
  warned = true;
  if (comm->me == 0)
    error->warning(
        FLERR,
        "Compute hvi/energy: {:.3g} of the energy has {} during runs, up to step {}: does "
        "another fix do work (a thermostat, a wall that moves: see keyword clamps) or "
        "bring particles, or is the time step too long?",
        std::fabs(drift), drift > 0.0 ? "come" : "gone", update->ntimestep);
}

/* ---------------------------------------------------------------------- */

void ComputeHVIEnergy::compute_vector()
{
  invoked_vector = update->ntimestep;
  if (update->eflag_global != invoked_vector)
    error->all(FLERR,
               "Energy was not tallied on needed timestep: use compute hvi/energy through "
               "thermo output, fix ave/time or a variable on a step that tallies it");

  const double *const *const v = atom->v;
  const double *const rmass = atom->rmass;
  const double *const mass = atom->mass;
  const int *const type = atom->type;

  // particles in elements are there twice: what they have is in nodes and elements

  const FixHVIStore *const store = FixHVIStore::find(lmp);
  const int embedded = store ? store->embedded : 0;

  double here[NVALUES] = {0.0};
  for (int i = 0; i < atom->nlocal; i++) {
    if (atom->mask[i] & embedded) continue;
    const double m = rmass ? rmass[i] : mass[type[i]];
    here[KINETIC] += m * (v[i][0] * v[i][0] + v[i][1] * v[i][1] + v[i][2] * v[i][2]);
    here[PX] += m * v[i][0];
    here[PY] += m * v[i][1];
    here[PZ] += m * v[i][2];
    here[MASS] += m;
  }
  here[KINETIC] *= 0.5 * force->mvv2e;
  if (atom->esph_flag)
    for (int i = 0; i < atom->nlocal; i++)
      if (!(atom->mask[i] & embedded)) here[INTERNAL] += atom->esph[i];
  for (const auto *const carrier : HVI::find_interface<HVI::EnergyCarrier>(lmp))
    for (int i = 0; i < atom->nlocal; i++) {
      if (atom->mask[i] & embedded) continue;
      here[INTERNAL] += carrier->internal_energy(i);
      here[PLASTIC] += carrier->plastic_work(i);
      here[VOIDS] += carrier->void_work(i);
    }
  if (force->pair) here[CONTACT] = force->pair->eng_vdwl + force->pair->eng_coul;
  if (force->bond) here[SPRING] = force->bond->energy;
  MPI_Allreduce(here, vector, NVALUES, MPI_DOUBLE, MPI_SUM, world);

  double booked[FixHVILedger::NENTRY];
  ledger->totals(booked);
  vector[BROKEN] = booked[FixHVILedger::BROKEN];
  vector[LEFT] = booked[FixHVILedger::LEFT];
  vector[CLAMPS] = -booked[FixHVILedger::CLAMP_WORK];    // what the clamps have taken up
  for (int k = 0; k < 3; k++) {
    vector[LEFT_PX + k] = booked[FixHVILedger::LEFT_PX + k];
    vector[JX + k] = booked[FixHVILedger::CLAMP_JX + k];
  }
  vector[LEFT_MASS] = booked[FixHVILedger::LEFT_MASS];
  vector[LEFT_COUNT] = booked[FixHVILedger::LEFT_COUNT];
  vector[BONDS_BROKEN] = booked[FixHVILedger::BONDS_BROKEN];
  vector[BONDS_LEFT] = booked[FixHVILedger::BONDS_LEFT];
  vector[VISCOUS] = booked[FixHVILedger::VISCOUS];
  vector[MISSED] = booked[FixHVILedger::MISSED];
  vector[PLASTIC] += booked[FixHVILedger::LEFT_PLASTIC];
  vector[VOIDS] += booked[FixHVILedger::LEFT_VOIDS];
  vector[FROZEN] = booked[FixHVILedger::FROZEN];

  vector[TOTAL] = 0.0;
  for (int n = KINETIC; n < TOTAL; n++) vector[TOTAL] += vector[n];

  const double now[FixHVILedger::NSTART] = {vector[TOTAL], vector[PX], vector[PY], vector[PZ],
                                            vector[MASS]};
  const double *const start = ledger->first(now);
  vector[RATIO] = start[0] != 0.0 ? vector[TOTAL] / start[0] : 1.0;
  for (int k = 0; k < 3; k++) vector[P0X + k] = start[1 + k];
  vector[MASS0] = start[4];
  if (run_start == HUGE_VAL) run_start = vector[TOTAL];
  last = vector[TOTAL];
  double scale = std::fabs(run_start);
  for (int n = KINETIC; n <= SPRING; n++) scale = std::max(scale, std::fabs(vector[n]));
  const double drift = before + last - run_start;
  if (!warned && scale > 0.0 && std::fabs(drift) > LARGE_DRIFT * scale) warn(drift / scale);

  // of solids alone: their total does not drift

  const double missed = std::fabs(vector[MISSED]);
  if (!warned_of_missed && scale > 0.0 && missed > LARGE_DRIFT * scale) {
    warned_of_missed = true;
    if (comm->me == 0)
      error->warning(
          FLERR,
          "Compute hvi/energy: {:.3g} of the energy is work that the time step has missed "
          "(entry 30), up to step {}, booked as heat of solids: use a smaller C",
          missed / scale, update->ntimestep);
  }
}
