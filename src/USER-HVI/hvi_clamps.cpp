/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "hvi_clamps.h"

#include "atom.h"
#include "fix_hvi_store.h"
#include "force.h"
#include "math_extra.h"
#include "memory.h"
#include "update.h"

#include <cstring>
#include <limits>

using namespace LAMMPS_NS;
using MathExtra::dot3;

// displacement of a particle that has come in the step in progress

static constexpr double NEWCOMER = std::numeric_limits<double>::infinity();

enum { WORK, IMPULSE };    // in the book

/* ---------------------------------------------------------------------- */

HVIClamps::HVIClamps(LAMMPS *lmp, double *book_in) :
    Pointers(lmp), book(book_in), clampbit(0), dt(0.0), finternal(nullptr), xold(nullptr),
    dx(nullptr), nmax(0), newcomers(false), state()
{
}

HVIClamps::~HVIClamps()
{
  memory->destroy(finternal);
  memory->destroy(xold);
  memory->destroy(dx);
}

/* ---------------------------------------------------------------------- */

void HVIClamps::watch(int groupbits)
{
  clampbit = groupbits;
  grow(atom->nmax);
}

void HVIClamps::begin()
{
  if (!clampbit) return;
  state = measure();
  for (int i = 0; i < atom->nlocal; i++) dx[i][0] = dx[i][1] = dx[i][2] = 0.0;
  newcomers = false;
}

void HVIClamps::post_integrate()
{
  if (!clampbit) return;
  dt = update->dt;
  for (int i = 0; i < atom->nlocal; i++)
    for (int k = 0; k < 3 && !is_newcomer(i); k++) dx[i][k] = atom->x[i][k] - xold[i][k];
  book_half();
}

void HVIClamps::see_forces(double dt_in)
{
  if (!clampbit) return;
  dt = dt_in;
  if (atom->nlocal == 0) return;
  admit();
  memcpy(&finternal[0][0], &atom->f[0][0], 3 * sizeof(double) * atom->nlocal);
  book_half();
}

void HVIClamps::end_of_step()
{
  if (!clampbit) return;
  const State now = measure();
  book[WORK] += now.energy - state.energy;
  for (int k = 0; k < 3; k++) book[IMPULSE + k] += now.momentum[k] - state.momentum[k];
  state = now;
  if (atom->nlocal) memcpy(&xold[0][0], &atom->x[0][0], 3 * sizeof(double) * atom->nlocal);
}

// that came in this step and is not admitted yet

bool HVIClamps::is_newcomer(int i) const
{
  return newcomers && dx[i][0] == NEWCOMER;
}

void HVIClamps::book_half()
{
  const double kick = 0.5 * dt * force->ftm2v;
  for (int i = 0; i < atom->nlocal; i++)
    if ((atom->mask[i] & clampbit) && !is_newcomer(i)) {
      book[WORK] -= 0.5 * dot3(finternal[i], dx[i]);
      for (int k = 0; k < 3; k++) book[IMPULSE + k] -= kick * finternal[i][k];
    }
}

/* ----------------------------------------------------------------------
   What a particle brings that other fixes put among the clamped ones in the
   middle of a step is no work of clamps.  It gets the second half kick of the
   step, as if it had moved through it with the velocity it came with.
------------------------------------------------------------------------- */

void HVIClamps::add(int i)
{
  if (!clampbit) return;
  dx[i][0] = NEWCOMER;
  newcomers = true;
}

void HVIClamps::admit()
{
  if (!clampbit || !newcomers) return;
  newcomers = false;
  for (int i = 0; i < atom->nlocal; i++) {
    if (dx[i][0] != NEWCOMER) continue;
    for (int k = 0; k < 3; k++) dx[i][k] = dt * atom->v[i][k];
    if (atom->mask[i] & clampbit) count_in(i, state);
  }
}

void HVIClamps::take_out(const State &left)
{
  state.energy -= left.energy;
  for (int k = 0; k < 3; k++) state.momentum[k] -= left.momentum[k];
}

void HVIClamps::hand_over(int i, double mass)
{
  if (!(atom->mask[i] & clampbit)) return;
  const double *const v = atom->v[i];
  state.energy += 0.5 * force->mvv2e * mass * dot3(v, v);
  for (int k = 0; k < 3; k++) {
    state.momentum[k] += mass * v[k];
    if (mass > 0.0) dx[i][k] = update->dt * v[k];
  }
}

/* ----------------------------------------------------------------------
   the displacement of a step outlives the migration in the middle of it
------------------------------------------------------------------------- */

void HVIClamps::grow(int n)
{
  if (!clampbit) return;
  for (double ***array : {&finternal, &xold, &dx}) {
    memory->grow(*array, n, 3, "hvi/ledger:clamps");
    if (n > nmax) memset(&(*array)[nmax][0], 0, 3 * sizeof(double) * (n - nmax));
  }
  nmax = n;
}

void HVIClamps::copy(int i, int j)
{
  if (clampbit) memcpy(dx[j], dx[i], SENT * sizeof(double));
}

int HVIClamps::pack(int i, double *buf) const
{
  if (!clampbit) return 0;
  memcpy(buf, dx[i], SENT * sizeof(double));
  return SENT;
}

int HVIClamps::unpack(int i, const double *buf)
{
  if (!clampbit) return 0;
  memcpy(dx[i], buf, SENT * sizeof(double));
  newcomers = newcomers || dx[i][0] == NEWCOMER;
  return SENT;
}

/* ---------------------------------------------------------------------- */

void HVIClamps::count_in(int i, State &s) const
{
  const double *const v = atom->v[i];
  const double m = atom->rmass ? atom->rmass[i] : atom->mass[atom->type[i]];
  s.energy += 0.5 * force->mvv2e * m * dot3(v, v);
  for (int k = 0; k < 3; k++) s.momentum[k] += m * v[k];
}

// particles in elements have nothing of their own: what they are given when these fail is no work of clamps

HVIClamps::State HVIClamps::measure() const
{
  const FixHVIStore *const store = FixHVIStore::find(lmp);
  const int embedded = store ? store->embedded : 0;
  State s = {0.0, {0.0, 0.0, 0.0}};
  for (int i = 0; i < atom->nlocal; i++)
    if ((atom->mask[i] & clampbit) && !(atom->mask[i] & embedded)) count_in(i, s);
  return s;
}
