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
#include "domain.h"
#include "fix_hvi_store.h"
#include "force.h"
#include "hvi_compat.h"
#include "math_extra.h"
#include "memory.h"
#include "update.h"

#include <algorithm>
#include <cstring>
#include <limits>

using namespace LAMMPS_NS;
using MathExtra::dot3;

// displacement of a particle that has come in the step in progress

static constexpr double NEWCOMER = std::numeric_limits<double>::infinity();

enum { WORK, IMPULSE, N = IMPULSE + 3 };    // in the book; of a particle: kinetic energy, momentum

/* ---------------------------------------------------------------------- */

HVIClamps::HVIClamps(LAMMPS *lmp, double *book_in) :
    Pointers(lmp), book(book_in), clampbit(0), dt(0.0), finternal(nullptr), xold(nullptr),
    dx(nullptr), had(nullptr), nmax(0), newcomers(false)
{
}

HVIClamps::~HVIClamps()
{
  memory->destroy(finternal);
  memory->destroy(xold);
  memory->destroy(dx);
  memory->destroy(had);
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
  const int held = embedded();
  for (int i = 0; i < atom->nlocal; i++) {
    find_state(i, held, had[i]);
    dx[i][0] = dx[i][1] = dx[i][2] = 0.0;
  }
  newcomers = false;
}

void HVIClamps::post_integrate()
{
  if (!clampbit) return;
  dt = update->dt;
  for (int i = 0; i < atom->nlocal; i++)
    if (!is_newcomer(i)) {
      for (int k = 0; k < 3; k++) dx[i][k] = atom->x[i][k] - xold[i][k];
      HVI::minimum_image(domain, dx[i][0], dx[i][1],
                         dx[i][2]);    // put back into the box between runs
    }
  look();
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
  look();
  if (atom->nlocal) memcpy(&xold[0][0], &atom->x[0][0], 3 * sizeof(double) * atom->nlocal);
}

void HVIClamps::look()
{
  if (!clampbit) return;
  const int held = embedded();
  double got[N] = {0.0};
  for (int i = 0; i < atom->nlocal; i++) {
    if (is_newcomer(i)) continue;
    double now[N];
    find_state(i, held, now);
    for (int n = 0; n < N; n++) got[n] += now[n] - had[i][n];
    memcpy(had[i], now, sizeof(now));
  }
  for (int n = 0; n < N; n++) book[n] += got[n];
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
  if (!newcomers) return;
  newcomers = false;
  const int held = embedded();
  for (int i = 0; i < atom->nlocal; i++) {
    if (dx[i][0] != NEWCOMER) continue;
    for (int k = 0; k < 3; k++) dx[i][k] = dt * atom->v[i][k];
    find_state(i, held, had[i]);
  }
}

void HVIClamps::hand_over(int i, double mass)
{
  if (!(atom->mask[i] & clampbit)) return;
  const double *const v = atom->v[i];
  had[i][WORK] += 0.5 * force->mvv2e * mass * dot3(v, v);
  for (int k = 0; k < 3; k++) {
    had[i][IMPULSE + k] += mass * v[k];
    if (mass > 0.0) dx[i][k] = update->dt * v[k];
  }
}

/* ----------------------------------------------------------------------
   the displacement of a step, and what particles had, outlive the migration in the middle of it
------------------------------------------------------------------------- */

void HVIClamps::grow(int n)
{
  if (!clampbit) return;
  for (double ***array : {&finternal, &xold, &dx}) {
    memory->grow(*array, n, 3, "hvi/ledger:clamps");
    if (n > nmax) memset(&(*array)[nmax][0], 0, 3 * sizeof(double) * (n - nmax));
  }
  memory->grow(had, n, N, "hvi/ledger:clamps");
  if (n > nmax) memset(had[nmax], 0, N * sizeof(double) * (n - nmax));
  nmax = n;
}

void HVIClamps::copy(int i, int j)
{
  if (!clampbit) return;
  memcpy(dx[j], dx[i], 3 * sizeof(double));
  memcpy(had[j], had[i], N * sizeof(double));
}

int HVIClamps::pack(int i, double *buf) const
{
  if (!clampbit) return 0;
  memcpy(buf, dx[i], 3 * sizeof(double));
  memcpy(buf + 3, had[i], N * sizeof(double));
  return SENT;
}

int HVIClamps::unpack(int i, const double *buf)
{
  if (!clampbit) return 0;
  memcpy(dx[i], buf, 3 * sizeof(double));
  memcpy(had[i], buf + 3, N * sizeof(double));
  newcomers = newcomers || dx[i][0] == NEWCOMER;
  return SENT;
}

/* ----------------------------------------------------------------------
   of a clamped particle; those in elements have nothing of their own: what they are given when these fail is no
   work of clamps
------------------------------------------------------------------------- */

int HVIClamps::embedded() const
{
  const FixHVIStore *const store = FixHVIStore::find(lmp);
  return store ? store->embedded : 0;
}

void HVIClamps::find_state(int i, int held, double *state) const
{
  std::fill_n(state, +N, 0.0);
  if (!(atom->mask[i] & clampbit) || (atom->mask[i] & held)) return;
  const double *const v = atom->v[i];
  const double m = atom->rmass ? atom->rmass[i] : atom->mass[atom->type[i]];
  state[WORK] = 0.5 * force->mvv2e * m * dot3(v, v);
  for (int k = 0; k < 3; k++) state[IMPULSE + k] = m * v[k];
}
