/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

// the rest of fix hvi/ledger: clamps

#include "fix_hvi_ledger.h"

#include "atom.h"
#include "fix_hvi_store.h"
#include "force.h"
#include "memory.h"
#include "update.h"

#include <cstring>
#include <limits>

using namespace LAMMPS_NS;

// displacement of a particle that has come in the step in progress

static constexpr double NEWCOMER = std::numeric_limits<double>::infinity();

static inline double dot(const double *a, const double *b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* ----------------------------------------------------------------------
   What clamps do to their particles is the change of those particles' kinetic
   energy and momentum less what pairs and bonds do to them: in a step of
   length dt the impulse dt/2 (F_old + F_new), the work 1/2 (F_old + F_new).dx,
   half of each booked before and after the forces change.  The displacement
   serves whoever moves the particles, fix move as well as fix nve.
------------------------------------------------------------------------- */

void FixHVILedger::clamp(int bits)
{
  clampbit = bits;
  grow_arrays(atom->nmax);
}

void FixHVILedger::post_integrate()
{
  if (!clampbit) return;

  dt_step = update->dt;
  for (int i = 0; i < atom->nlocal; i++)
    for (int k = 0; k < 3; k++) dx[i][k] = atom->x[i][k] - xold[i][k];
  book_clamps();
}

void FixHVILedger::book_clamps()
{
  const double kick = 0.5 * dt_step * force->ftm2v;
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & clampbit) {
      entry[CLAMP_WORK] -= 0.5 * dot(finternal[i], dx[i]);
      for (int k = 0; k < 3; k++) entry[CLAMP_JX + k] -= kick * finternal[i][k];
    }
}

/* ----------------------------------------------------------------------
   What a particle brings that other fixes put among the clamped ones in the
   middle of a step is no work of clamps.  It gets the second half kick of the
   step, as if it had moved through it with the velocity it came with.
------------------------------------------------------------------------- */

void FixHVILedger::set_arrays(int i)
{
  if (!clampbit) return;
  dx[i][0] = NEWCOMER;
  newcomers = 1;
}

void FixHVILedger::admit_newcomers()
{
  if (!newcomers) return;
  newcomers = 0;
  for (int i = 0; i < atom->nlocal; i++) {
    if (dx[i][0] != NEWCOMER) continue;
    for (int k = 0; k < 3; k++) dx[i][k] = dt_step * atom->v[i][k];
    if (atom->mask[i] & clampbit) count_in(i, clamp_state);
  }
}

/* ----------------------------------------------------------------------
   the displacement of a step outlives the migration in the middle of it;
   nothing is stored or sent without clamps
------------------------------------------------------------------------- */

void FixHVILedger::grow_arrays(int n)
{
  if (!clampbit) return;
  for (double ***array : {&finternal, &xold, &dx}) {
    memory->grow(*array, n, 3, "hvi/ledger:clamps");
    if (n > nclamp) memset(&(*array)[nclamp][0], 0, 3 * sizeof(double) * (n - nclamp));
  }
  nclamp = n;
}

void FixHVILedger::copy_arrays(int i, int j, int /*delflag*/)
{
  if (clampbit) memcpy(dx[j], dx[i], 3 * sizeof(double));
}

int FixHVILedger::pack_exchange(int i, double *buf)
{
  if (!clampbit) return 0;
  memcpy(buf, dx[i], 3 * sizeof(double));
  return 3;
}

int FixHVILedger::unpack_exchange(int i, double *buf)
{
  if (!clampbit) return 0;
  memcpy(dx[i], buf, 3 * sizeof(double));
  if (dx[i][0] == NEWCOMER) newcomers = 1;
  return 3;
}

/* ---------------------------------------------------------------------- */

void FixHVILedger::count_in(int i, ClampState &s) const
{
  const double *const v = atom->v[i];
  const double m = atom->rmass ? atom->rmass[i] : atom->mass[atom->type[i]];
  s.energy += 0.5 * force->mvv2e * m * dot(v, v);
  for (int k = 0; k < 3; k++) s.momentum[k] += m * v[k];
}

// particles in elements have nothing of their own: what they are given when these fail is no work of clamps

FixHVILedger::ClampState FixHVILedger::measure_clamps() const
{
  const FixHVIStore *const store = FixHVIStore::find(lmp);
  const int embedded = store ? store->embedded : 0;
  ClampState s = {0.0, {0.0, 0.0, 0.0}};
  for (int i = 0; i < atom->nlocal; i++)
    if ((atom->mask[i] & clampbit) && !(atom->mask[i] & embedded)) count_in(i, s);
  return s;
}

void FixHVILedger::hand_over(int i, double mass)
{
  if (!(atom->mask[i] & clampbit)) return;
  const double *const v = atom->v[i];
  clamp_state.energy += 0.5 * force->mvv2e * mass * dot(v, v);
  for (int k = 0; k < 3; k++) {
    clamp_state.momentum[k] += mass * v[k];
    if (mass > 0.0) dx[i][k] = update->dt * v[k];
  }
}
