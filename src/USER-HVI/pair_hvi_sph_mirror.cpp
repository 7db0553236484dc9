/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

// mirror planes: images of particles, for half and quarter models

#include "pair_hvi_sph.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "fix_hvi_sph.h"
#include "force.h"
#include "math_special.h"
#include "neighbor.h"
#include "update.h"

#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using HVI::MirrorPlanes;
using MathSpecial::square;

/* ---------------------------------------------------------------------- */

void PairHVISPH::check_mirror() const
{
  for (int k = 0; k < 3; k++) {
    if (!mirror.has(k)) continue;
    if (k >= domain->dimension)
      error->all(FLERR, "Pair style hvi/sph: mirror {} in a two-dimensional box", "xyz"[k]);
    if (domain->periodicity[k])
      error->all(FLERR, "Pair style hvi/sph: mirror {} needs a box that is not periodic along {}",
                 "xyz"[k], "xyz"[k]);
  }
  if (!mirror.planes) return;
  if (domain->triclinic)
    error->all(FLERR, "Pair style hvi/sph: mirror needs a box that is not triclinic");
  if (riemann)
    error->all(FLERR, "Pair style hvi/sph: mirror does not work with dissipation riemann");
  if (!fix)
    error->all(FLERR,
               "Pair style hvi/sph: mirror needs fix hvi/sph, which keeps particles on "
               "their side");
}

/* ----------------------------------------------------------------------
   at the start of a run no particle may be beyond a plane, or on it
------------------------------------------------------------------------- */

void PairHVISPH::check_sides() const
{
  if (!mirror.planes) return;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!materials[atom->type[i]]) continue;
    for (int k = 0; k < 3; k++)
      if (mirror.has(k) && !(mirror.depth(k, atom->x[i]) > 1.0e-12 * htype[atom->type[i]]))
        error->one(FLERR,
                   "Pair style hvi/sph: particle {} at {} = {} is on the mirror plane {} or beyond "
                   "it (mirror {} {} {} wants all {} it); a lattice is best half a spacing away",
                   atom->tag[i], "xyz"[k], atom->x[i][k], mirror.at[k], "xyz"[k], mirror.at[k],
                   mirror.side[k] > 0 ? "lo" : "hi", mirror.side[k] > 0 ? "above" : "below");
  }
}

/* ----------------------------------------------------------------------
   which particles have images within reach of others, or soon: the time step wants to know
------------------------------------------------------------------------- */

void PairHVISPH::find_images()
{
  const int nlocal = atom->nlocal;
  const int nall = nlocal + atom->nghost;
  double &reachsq = images.reachsq;
  reachsq = 0.0;
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = 1; j <= atom->ntypes; j++)
      if (materials[i] && materials[j] && cutsq[i][j] > 0.0)
        reachsq = MAX(reachsq, square(std::sqrt(cutsq[i][j]) + neighbor->skin));

  for (int i = 0; i < nlocal; i++)
    for (int k = 0; k < 3; k++)
      if (mirror.has(k) && materials[atom->type[i]] && mirror.depth(k, atom->x[i]) < 0.0)
        error->one(FLERR,
                   "Pair style hvi/sph: particle {} is beyond the mirror plane {} at step {}: fix "
                   "hvi/sph does not integrate it, so does not put it back",
                   atom->tag[i], "xyz"[k], update->ntimestep);

  images.all.clear();
  images.first = nall;
  for (int op = 1; op < MirrorPlanes::NOPS; op++) {
    if (!mirror.is_operation(op)) continue;
    images.of[op].assign(nall, -1);
    images.self[op].assign(nlocal, -1);
    for (int i = 0; i < nall; i++) {
      const double depth = mirror.depth_squared(op, atom->x[i]);
      if (!(depth < reachsq) || !materials[atom->type[i]]) continue;
      images.of[op][i] = nall + images.all.size();
      images.all.push_back({i, op, false});
      if (i >= nlocal || !(4.0 * depth < reachsq)) continue;
      images.self[op][i] = nall + images.all.size();
      images.all.push_back({i, op, true});
    }
  }
}

/* ----------------------------------------------------------------------
   their records, after those of the particles are there
------------------------------------------------------------------------- */

void PairHVISPH::fill_images()
{
  int a = images.first;
  for (const auto &image : images.all) {
    const HVI::Reflection reflect(image.op);
    place[a] = place[image.owner];
    double *const x = &place[a].x;
    for (int k = 0; k < 3; k++)
      if (image.op >> k & 1) x[k] = 2.0 * mirror.at[k] - x[k];
    state[a] = state[image.owner];
    reflect.state(state[a]);
    memset((void *) &rates[a], 0, sizeof(HVI::SphRates));
    if (solid) {
      stress[a] = stress[image.owner];
      reflect.symmetric(stress[a]);
      memset((void *) &gradv[a], 0, sizeof(HVI::SphGradV));
    }
    if (art) {
      art[a] = art[image.owner];
      reflect.symmetric(art[a]);
    }
    a++;
  }
}

/* ----------------------------------------------------------------------
   What happened to images, reflected, happened to their owners.  The planes' force: a
   pair of images pushes both particles away from a plane alike; a particle and its own
   image push that particle.  With newton off the pair of an owned and a ghost
   particle is seen by two ranks: each counts the force on its own.
------------------------------------------------------------------------- */

void PairHVISPH::fold_images()
{
  for (double &f : images.force) f = 0.0;
  int a = images.first;
  for (const auto &image : images.all) {
    HVI::SphRates &r = rates[a];
    const bool both = !image.self && (force->newton_pair || image.owner < atom->nlocal);
    const double *const f = &r.fx;
    for (int k = 0; k < 3; k++)
      if (image.op >> k & 1) images.force[k] -= (both ? 2.0 : 1.0) * f[k];
    if (!image.self) {
      const HVI::Reflection reflect(image.op);
      reflect.rates(r);
      double *const to = &rates[image.owner].fx;
      const double *const from = &r.fx;
      for (int k = 0; k < (int) (sizeof(r) / sizeof(double)); k++) to[k] += from[k];
      if (solid) {
        reflect.gradient(gradv[a]);
        double *const L = &gradv[image.owner].xx;
        for (int k = 0; k < HVI::SphGradV::SENT; k++) L[k] += (&gradv[a].xx)[k];
      }
    }
    a++;
  }
}

/* ----------------------------------------------------------------------
   images that particle i may interact with: those of its neighbors, and its own
------------------------------------------------------------------------- */

const std::vector<int> &PairHVISPH::images_near(int i, const int *jlist, int jnum)
{
  nearby.clear();
  for (int op = 1; op < MirrorPlanes::NOPS; op++) {
    if (!mirror.is_operation(op) || images.of[op][i] < 0) continue;
    const std::vector<int> &of = images.of[op];
    for (int jj = 0; jj < jnum; jj++) {
      const int a = of[jlist[jj] & NEIGHMASK];
      if (a >= 0) nearby.push_back(a);
    }
    if (images.self[op][i] >= 0) nearby.push_back(images.self[op][i]);
  }
  return nearby;
}

/* ----------------------------------------------------------------------
   A pair with an image counts for the virial as the halves of it and of its image on
   this side: f.d of either particle.  With its own image a particle has one half.
------------------------------------------------------------------------- */

void PairHVISPH::tally_image(int i, int a, const double *f, const double *d)
{
  const int nlocal = atom->nlocal, newton = force->newton_pair;
  const auto &image = images.all[a - images.first];
  ev_tally_xyz(i, i, nlocal, newton, 0.0, 0.0, 0.5 * f[0], 0.5 * f[1], 0.5 * f[2], d[0], d[1],
               d[2]);
  if (image.self) return;
  const HVI::Reflection reflect(image.op);
  const double *const s = reflect.s;
  ev_tally_xyz(image.owner, image.owner, nlocal, newton, 0.0, 0.0, 0.5 * s[0] * f[0],
               0.5 * s[1] * f[1], 0.5 * s[2] * f[2], s[0] * d[0], s[1] * d[1], s[2] * d[2]);
}

tagint PairHVISPH::tag_of(int j) const
{
  const int nall = atom->nlocal + atom->nghost;
  return atom->tag[j < nall ? j : images.all[j - images.first].owner];
}
