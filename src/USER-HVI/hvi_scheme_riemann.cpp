/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "hvi_scheme_riemann.h"

#include "atom.h"
#include "force.h"
#include "math_special.h"
#include "memory.h"

#include <cmath>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

HVISchemeRiemann::HVISchemeRiemann(LAMMPS *lmp, const HVIPairTables &tables) :
    HVIScheme(lmp, tables), ratio(nullptr), weight(nullptr), differ(false)
{
  memory->create(ratio, atom->ntypes + 1, atom->ntypes + 1, "hvi/sph:ratio");
  memory->create(weight, atom->ntypes + 1, atom->ntypes + 1, "hvi/sph:weight");
  find_weights();
  work.ratio = ratio;
  work.weight = weight;

  // forces use the number of neighbors at undisturbed particles

  choose(HVI::SPH_RIEMANN | (differ ? HVI::SPH_SPACINGS : 0), false);
}

HVISchemeRiemann::~HVISchemeRiemann()
{
  memory->destroy(ratio);
  memory->destroy(weight);
}

/* ----------------------------------------------------------------------
   By how much a particle counts more than another in the density of that: the
   ratio of their volumes, of those at rho0 if both have one.  A gas has none: what is large
   because it is thin now will be as small as others of its mass when pressures are even.  So of
   volumes, by h, and masses that ratio counts which is nearer to 1; and 1 if they do not agree
   on which is larger.  Volumes that nearly agree are the same.  Kernels between types are as wide
   as the mean of both h at the start.
------------------------------------------------------------------------- */

void HVISchemeRiemann::find_weights()
{
  static constexpr double SAME = 0.01;
  for (int i = 1; i <= atom->ntypes; i++) {
    if (!pairs.is_ours[i]) continue;
    ratio[i][i] = weight[i][i] = 1.0;
    for (int j = i + 1; j <= atom->ntypes; j++) {
      if (!pairs.is_ours[j]) continue;
      ratio[i][j] = set.h[j] / set.h[i];
      double w = MathSpecial::powint(ratio[i][j], set.laws.dim);
      if (!atom->rmass) {
        const double rho_i = store->materials.of(i)->eos->rho0();
        const double rho_j = store->materials.of(j)->eos->rho0();
        const double masses = atom->mass[j] / atom->mass[i];
        w = rho_i > 0.0 && rho_j > 0.0 ? masses * rho_i / rho_j
                                       : MAX(MIN(w, masses), MIN(1.0, MAX(w, masses)));
      }
      if (std::fabs(std::log(w)) < SAME) w = 1.0;
      weight[i][j] = w;
      weight[j][i] = 1.0 / w;
      ratio[j][i] = 1.0 / ratio[i][j];
      if (ratio[i][j] != 1.0 || w != 1.0) differ = true;
    }
  }
}

double HVISchemeRiemann::widest(int i, int j) const
{
  return 0.5 * MAX((1.0 + ratio[i][j]) * set.h[i], (1.0 + ratio[j][i]) * set.h[j]);
}

HVIScheme::Traffic HVISchemeRiemann::traffic() const
{
  static constexpr int SENT = HVI::SphSlopes::SENT;
  return {SENT, SENT, SENT, SENT};
}

/* ---------------------------------------------------------------------- */

void HVISchemeRiemann::evaluate()
{
  start();
  sweeps->first(work);
  if (set.mirror.planes) images.fold_sums(work.records);
  if (force->newton_pair) reverse(HVI::SphMessage().with(work.records.slopes));
  finish_slopes();
  forward(HVI::SphMessage().with(work.records.slopes));
  if (set.mirror.planes) images.fill_sums(work.records);
}

double HVISchemeRiemann::gather(int i, const EosState &eos, HVI::SphState &s)
{
  s.w = mass(i) / s.rho;
  s.p = eos.p;
  return eos.csq;
}

/* ----------------------------------------------------------------------
   When the first sweep has the sums of all neighbors.  Omega is 1
   where h stays as it is, and far from 1 only for particles nearly alone: bounded.
------------------------------------------------------------------------- */

void HVISchemeRiemann::finish_slopes()
{
  const HVI::SphView &records = work.records;
  for (const int i : filled) {
    if (i >= atom->nlocal) break;
    if (!pairs.is_ours[atom->type[i]]) continue;
    HVI::SphSlopes &slopes = records.slopes[i];
    const double start = set.h[atom->type[i]], h = records.place[i].h;
    const double W0 = sweeps->w(0.0) * set.laws.norm / MathSpecial::powint(h, set.laws.dim);
    const double n = slopes.n + W0;
    const bool follows = set.variable && h > set.hmin * start && h < set.hmax * start;
    const double omega = follows ? 1.0 + (slopes.spread / set.laws.dim - W0) / n : 1.0;
    const double by_omega = 1.0 / MAX(omega, 0.25);
    slopes.replace_sums(by_omega / n, by_omega);
  }
}
