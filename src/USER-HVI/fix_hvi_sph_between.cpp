/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

// between the halves of a step: what others have moved, mirror planes, ghosts, solids with gradient
// corrected; the rest of the class is in fix_hvi_sph.cpp

#include "fix_hvi_sph.h"

#include "atom.h"
#include "domain.h"
#include "fix_hvi_johnson_cook.h"
#include "fix_hvi_ledger.h"
#include "fix_hvi_store.h"
#include "hvi_compat.h"

#include <cmath>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

const double *FixHVISPH::working_velocity(int i) const
{
  const bool known = integrates(i) || (atom->mask[i] & store->embedded);
  return known ? extra[i].working : atom->v[i];
}

void FixHVISPH::carry(int i, const double *working)
{
  for (int k = 0; k < 3; k++) extra[i].working[k] = working[k];
}

void FixHVISPH::let_go(int i, double de)
{
  Extra &e = extra[i];
  e.drho = e.stretch = 0.0;
  e.de = de;
  e.trend_rho = NAN;    // there were no rates before
  e.settled = e.rho = atom->rho[i];
  e.esph = atom->esph[i];
}

/* ----------------------------------------------------------------------
   What forces work on the velocity of the end of the step beyond what they did on the extrapolated
   one.  Over all particles that is the same of pairs, so it can be taken from a particle's own energy.
   A half kick gives dt/2 F.v and, at the end of a step less, at the beginning more, dt^2/8 F^2/m,
   which only cancels if the step is the same: what is left is taken, too.  Then the total energy is
   kept to round-off, but for dt^2/8 F^2/m of the moment.  The first is of SPH forces only, for others
   work on v itself; F in the second is all of the force.
------------------------------------------------------------------------- */

double FixHVISPH::missed_work(int i) const
{
  if (!store->fields.settings.energy) return 0.0;
  const double *const v = atom->v[i], *const w = extra[i].working;
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

double FixHVISPH::settle_density(int i, double div)
{
  if (!integrates(i)) return atom->rho[i];
  Extra &e = extra[i];
  if (due) e.settled *= std::exp(-dtv * div);
  e.stretch = -e.settled * div;
  return e.settled;
}

void FixHVISPH::settle_solids()
{
  if (due && strength) strength->whole_step(dtv);
  due = false;
}

/* ----------------------------------------------------------------------
   a piston, say, is moved by a fix that does not know vest, which is what forces see: its velocity, or
   that of the middle of the step, from where it has gone
------------------------------------------------------------------------- */

void FixHVISPH::post_integrate()
{
  const HVI::SphSettings &set = store->fields.settings;
  if (set.mirror.planes) reflect();
  if (!follow && !set.whole) return;
  for (int i = 0; i < atom->nlocal; i++) {
    if ((atom->mask[i] & groupbit) || !has_material(i)) continue;
    double way[3] = {0.0, 0.0, 0.0};
    if (set.whole) {
      for (int k = 0; k < 3; k++) way[k] = atom->x[i][k] - extra[i].working[k];
      HVI::minimum_image(domain, way[0], way[1], way[2]);
    }
    const bool goes = way[0] != 0.0 || way[1] != 0.0 || way[2] != 0.0;
    for (int k = 0; k < 3; k++) atom->vest[i][k] = goes ? way[k] / dtv : atom->v[i][k];
  }
}

/* ----------------------------------------------------------------------
   of what others move, for its velocity in the middle of the next step
------------------------------------------------------------------------- */

void FixHVISPH::keep_places()
{
  if (!store->fields.settings.whole || igroup == 0) return;
  for (int i = 0; i < atom->nlocal; i++)
    if (!(atom->mask[i] & groupbit) && has_material(i))
      for (int k = 0; k < 3; k++) extra[i].working[k] = atom->x[i][k];
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
      extra[i].trend_v[k] = -extra[i].trend_v[k];
      extra[i].working[k] = -extra[i].working[k];
    }
    if (op && strength) strength->reflect(i, op);
  }
  ledger->book_mirror(impulse);
}

/* ----------------------------------------------------------------------
   the constant of variable h goes to new ghosts
------------------------------------------------------------------------- */

int FixHVISPH::pack_border(int n, int *list, double *buf)
{
  for (int i = 0; i < n; i++) buf[i] = extra[list[i]].hscale;
  return n;
}

int FixHVISPH::unpack_border(int n, int first, double *buf)
{
  for (int i = 0; i < n; i++) extra[first + i].hscale = buf[i];
  return n;
}

int FixHVISPH::pack_forward_comm(int n, int *list, double *buf, int /*pbc_flag*/, int * /*pbc*/)
{
  return pack_border(n, list, buf);
}

void FixHVISPH::unpack_forward_comm(int n, int first, double *buf)
{
  unpack_border(n, first, buf);
}
