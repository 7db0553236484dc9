/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

// what limits the time step; the rest of the class is in pair_hvi_contact.cpp

#include "pair_hvi_contact.h"

#include "atom.h"
#include "force.h"
#include "neigh_list.h"

#include <cmath>
#include <vector>

using namespace LAMMPS_NS;

static constexpr double BIG = 1.0e100;

/* ----------------------------------------------------------------------
   shortest sqrt(m/k) of the pairs in reach: as they stand, and where a pair
   that approaches will turn back if left alone.  The stiffness k grows with
   depth and with energy, so only a pair that is deeper, more energetic or
   lighter than the worst one so far of its types needs to be worked out.
------------------------------------------------------------------------- */

void PairHVIContact::tighten(HVI::TimeStepBounds &bounds)
{
  const double *const *const x = atom->x;
  const double *const *const v = atom->v;
  const double *const rmass = atom->rmass;
  const double *const mass = atom->mass;
  const int *const type = atom->type;
  const double mvv2e = force->mvv2e;

  double contact = bounds.contact * bounds.contact;
  double approach = bounds.approach * bounds.approach;

  if (uniform && one_mass()) {
    const Extremes all = extremes();
    const double m = 0.5 * mvv2e * mass[1];
    if (!(all.rsq >= common.cutsq)) contact = MIN(contact, m / common.stiffness(all.rsq));
    if (!(all.energy <= 0.0))
      approach = MIN(approach, m / common.stiffness(common.turning_rsq(all.energy)));
    if (std::isnan(all.energy)) approach = all.energy;
    bounds.contact = std::sqrt(contact);
    bounds.approach = std::sqrt(approach);
    bounds.conserve_energy(HVI::shortest_cutoff(lmp));
    return;
  }

  struct Worst {
    double rsq, m_contact, e, m_approach;
  };
  const int np1 = atom->ntypes + 1;
  std::vector<Worst> worst(np1 * np1, {BIG, BIG, 0.0, BIG});

  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii];
    const int itype = type[i];
    const int *const jlist = list->firstneigh[i];
    const int jnum = list->numneigh[i];
    const double mi = rmass ? rmass[i] : mass[itype];

    for (int jj = 0; jj < jnum; jj++) {
      const int j = jlist[jj] & NEIGHMASK;
      const int jtype = type[j];
      const double delx = x[i][0] - x[j][0];
      const double dely = x[i][1] - x[j][1];
      const double delz = x[i][2] - x[j][2];
      const double rsq = delx * delx + dely * dely + delz * delz;
      const double rdotv =
          delx * (v[i][0] - v[j][0]) + dely * (v[i][1] - v[j][1]) + delz * (v[i][2] - v[j][2]);

      const HVI::Contact &c = law[itype][jtype];
      Worst &w = worst[itype * np1 + jtype];
      const double mj = rmass ? rmass[j] : mass[jtype];
      const double m = mvv2e * mi * mj / (mi + mj);
      const bool touching = rsq < c.cutsq;

      if (touching && !(rsq >= w.rsq && m >= w.m_contact)) {
        const double bound = m / c.stiffness(rsq);
        if (bound < contact || std::isnan(bound)) {
          contact = bound;
          w.rsq = rsq;
          w.m_contact = m;
        }
      }

      if (!(rdotv >= 0.0)) {
        const double e = 0.5 * m * rdotv * rdotv / rsq + (touching ? c.energy(rsq) : 0.0);
        if (!(e <= w.e && m >= w.m_approach)) {
          const double bound = m / c.stiffness(c.turning_rsq(e));
          if (bound < approach || std::isnan(bound)) {
            approach = bound;
            w.e = e;
            w.m_approach = m;
          }
        }
      }
    }
  }

  bounds.contact = std::sqrt(contact);
  bounds.approach = std::sqrt(approach);
  bounds.conserve_energy(HVI::shortest_cutoff(lmp));
}

/* ---------------------------------------------------------------------- */

bool PairHVIContact::one_mass() const
{
  if (atom->rmass) return false;
  for (int i = 2; i <= atom->ntypes; i++)
    if (atom->mass[i] != atom->mass[1]) return false;
  return true;
}

/* ----------------------------------------------------------------------
   where all pairs have one law and one mass: the shortest distance, and the most energy of a pair
   that approaches, without a branch per pair: which pairs approach is a coin toss, too
------------------------------------------------------------------------- */

PairHVIContact::Extremes PairHVIContact::extremes() const
{
  if (list->inum == 0) return {BIG, 0.0};
  const double(*const x)[3] = (const double(*)[3]) atom->x[0];
  const double(*const v)[3] = (const double(*)[3]) atom->v[0];
  const HVI::Contact c = common;
  const double quarter_m = 0.25 * force->mvv2e * atom->mass[1];    // half of the reduced mass

  double rsq[NTOUCH], rdotv[NTOUCH];
  double shortest[NLANE], most[NLANE], sum[NLANE];
  for (int k = 0; k < NLANE; k++) {
    shortest[k] = BIG;
    most[k] = sum[k] = 0.0;
  }
  int n = 0;

  const auto work_off = [&]() {
    for (; n % NLANE; n++) {
      rsq[n] = BIG;
      rdotv[n] = 0.0;
    }
    for (int first = 0; first < n; first += NLANE)
      for (int k = 0; k < NLANE; k++) {
        const double one = rsq[first + k], rate = rdotv[first + k];
        const double r2inv = 1.0 / one;

        // q > 1/2 of Contact::energy() is where they touch

        double dq = c.s6 * (r2inv * r2inv * r2inv) - 0.5;
        dq = dq < 0.0 ? 0.0 : dq;
        const double energy = quarter_m * rate * rate * r2inv + c.depth * dq * dq;
        const double e = rate >= 0.0 ? 0.0 : energy;
        shortest[k] = one < shortest[k] ? one : shortest[k];
        most[k] = e > most[k] ? e : most[k];
        sum[k] += e;    // a maximum may drop a NaN
      }
    n = 0;
  };

  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii];
    const int *const jlist = list->firstneigh[i];
    const int jnum = list->numneigh[i];
    const double xi[3] = {x[i][0], x[i][1], x[i][2]};
    const double vi[3] = {v[i][0], v[i][1], v[i][2]};

    for (int jfirst = 0; jfirst < jnum; jfirst += NROW) {
      const int jlast = MIN(jfirst + NROW, jnum);
      if (n > NTOUCH - NROW) work_off();
      for (int jj = jfirst; jj < jlast; jj++) {
        const int j = jlist[jj] & NEIGHMASK;
        const double delx = xi[0] - x[j][0];
        const double dely = xi[1] - x[j][1];
        const double delz = xi[2] - x[j][2];
        rsq[n] = delx * delx + dely * dely + delz * delz;
        rdotv[n] = delx * (vi[0] - v[j][0]) + dely * (vi[1] - v[j][1]) + delz * (vi[2] - v[j][2]);
        n++;
      }
    }
  }
  work_off();

  for (int k = 1; k < NLANE; k++) {
    shortest[0] = MIN(shortest[0], shortest[k]);
    most[0] = MAX(most[0], most[k]);
    sum[0] += sum[k];
  }
  return {shortest[0], std::isnan(sum[0]) ? sum[0] : most[0]};
}
