/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "hvi_images.h"
#include "hvi_sph_touching.h"

namespace HVI {

void Images::find(const MirrorPlanes &mirror, const double *const *x, const int *type,
                  const std::vector<char> &is_ours, int nlocal_in, int nall, double reachsq,
                  const std::vector<char> &alone)
{
  nlocal = nlocal_in;
  first = nall;
  reach_squared = reachsq;
  images.clear();
  for (int op = 1; op < MirrorPlanes::NOPS; op++) {
    of[op].clear();
    if (!mirror.is_operation(op)) continue;
    of[op].assign(nall, -1);
    self[op].assign(nlocal, -1);
    for (int i = 0; i < nall; i++) {
      const double depth = mirror.depth_squared(op, x[i]);
      if (!(depth < reachsq) || !is_ours[type[i]]) continue;
      of[op][i] = end();
      images.push_back({i, op, false});
      if (i >= nlocal || !(4.0 * depth < reachsq) || (!alone.empty() && alone[i])) continue;
      self[op][i] = end();
      images.push_back({i, op, true});
    }
  }
}

/* ---------------------------------------------------------------------- */

void Images::fill(const MirrorPlanes &mirror, const SphView &records) const
{
  int a = first;
  for (const Image &image : images) {
    const Reflection reflect(image.op);
    records.place[a] = records.place[image.owner];
    double *const x = &records.place[a].x;
    for (int k = 0; k < 3; k++)
      if (image.op >> k & 1) x[k] = 2.0 * mirror.at[k] - x[k];
    records.state[a] = records.state[image.owner];
    reflect.velocity(records.state[a]);
    records.state[a].reflect_body(image.op);
    records.rates[a] = {};
    if (records.gradv) {
      records.gradv[a] = {};
      records.gradv[a].weight = records.gradv[image.owner].weight;
    }
    if (records.slopes) records.slopes[a] = {};
    a++;
  }
}

/* ----------------------------------------------------------------------
   What happened to images, reflected, happened to their owners.  The planes' force: a
   pair of images pushes both particles away from a plane alike; a particle and its own
   image push that particle.  With newton off the pair of an owned and a ghost
   particle is seen by two ranks: each counts the force on its own.
------------------------------------------------------------------------- */

void Images::fold(const SphView &records, bool newton)
{
  for (double &f : force) f = 0.0;
  int a = first;
  for (const Image &image : images) {
    SphRates &r = records.rates[a];
    const bool for_both = !image.self && (newton || image.owner < nlocal);
    const double *const f = &r.fx;
    for (int k = 0; k < 3; k++)
      if (image.op >> k & 1) force[k] -= (for_both ? 2.0 : 1.0) * f[k];
    if (!image.self) {
      const Reflection reflect(image.op);
      reflect.rates(r);
      double *const to = &records.rates[image.owner].fx;
      const double *const from = &r.fx;
      for (int k = 0; k < (int) (sizeof(r) / sizeof(double)); k++) to[k] += from[k];
    }
    a++;
  }
}

/* ---------------------------------------------------------------------- */

template <class Record> static void add(const Record &from, Record &to)
{
  for (int k = 0; k < Record::SENT; k++) (&to.xx)[k] += (&from.xx)[k];
}

void Images::fold_sums(const SphView &records) const
{
  for (int k = 0; k < (int) images.size(); k++) {
    const Image &image = images[k];
    if (image.self) continue;
    const Reflection reflect(image.op);
    const int a = first + k, i = image.owner;
    if (records.slopes) {
      reflect.slopes(records.slopes[a]);
      add(records.slopes[a], records.slopes[i]);
    }
    if (records.traction) {
      reflect.gradient(records.gradv[a]);
      add(records.gradv[a], records.gradv[i]);
    }
    if (records.touching && records.touching->has(a)) {
      SphGradV sums = records.touching->of(a).sums;
      reflect.gradient(sums);
      add(sums, records.touching->at(i).sums);
    }
  }
}

void Images::fill_sums(const SphView &records) const
{
  for (int k = 0; k < (int) images.size(); k++) {
    const Reflection reflect(images[k].op);
    const int a = first + k, i = images[k].owner;
    if (records.slopes) {
      records.slopes[a] = records.slopes[i];
      reflect.slopes(records.slopes[a]);
    }
    if (records.traction) {
      records.traction[a] = records.traction[i];
      reflect.tensor(records.traction[a]);
      reflect.velocity(records.traction[a]);
      records.gradv[a].stretch() = records.gradv[i].stretch();
      reflect.symmetric(records.gradv[a].stretch());
      if (records.art) {
        records.art[a] = records.art[i];
        reflect.symmetric(records.art[a]);
      }
    }
    if (records.touching && records.touching->has(i)) {
      SphPush push = records.touching->of(i).push;
      reflect.symmetric(push);
      records.touching->at(a).push = push;
    }
  }
}

/* ---------------------------------------------------------------------- */

const std::vector<int> &Images::near(int i, const int *jlist, int jnum)
{
  nearby.clear();
  for (int op = 1; op < MirrorPlanes::NOPS; op++) {
    if (of[op].empty() || of[op][i] < 0) continue;
    for (int jj = 0; jj < jnum; jj++) {
      const int a = of[op][jlist[jj] & NEIGHBOR_INDEX];
      if (a >= 0) nearby.push_back(a);
    }
    if (self[op][i] >= 0) nearby.push_back(self[op][i]);
  }
  return nearby;
}

}    // namespace HVI
