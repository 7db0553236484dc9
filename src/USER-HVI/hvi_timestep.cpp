/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "hvi_timestep.h"

#include "atom.h"
#include "comm.h"
#include "hvi_interface.h"
#include "lammps.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

double HVI::shortest_cutoff(const LAMMPS *lmp)
{
  const Pair *const pair = lmp->force->pair;
  double cutoff = NO_BOUND;
  if (pair)
    for (int i = 1; i <= lmp->atom->ntypes; i++)
      for (int j = i; j <= lmp->atom->ntypes; j++)
        if (pair->cutsq[i][j] > 0.0) cutoff = std::min(cutoff, std::sqrt(pair->cutsq[i][j]));
  return cutoff;
}

/* ---------------------------------------------------------------------- */

bool HVI::at_hand(const std::vector<TimeStepSource *> &sources)
{
  return std::all_of(sources.begin(), sources.end(), [](const TimeStepSource *source) {
    return source->at_hand();
  });
}

/* ---------------------------------------------------------------------- */

HVI::StableSteps HVI::stable_steps(const LAMMPS *lmp, const std::vector<TimeStepSource *> &sources,
                                   double factor)
{
  const Atom *const atom = lmp->atom;
  if (!at_hand(sources)) lmp->comm->forward_comm_array(3, atom->v);

  TimeStepBounds bounds;
  for (auto *source : sources) source->tighten(bounds);

  // the extremes of velocity too: min v and min -v in each direction

  enum {
    CONTACT,
    SPRING,
    APPROACH,
    SIGNAL,
    GROWTH,
    TRAVEL,
    MEET,
    STABLE,
    ALONE,
    V,
    MINUS_V = V + 3,
    N = MINUS_V + 3
  };
  double here[N] = {bounds.contact, bounds.spring, bounds.approach, bounds.signal, bounds.growth,
                    bounds.travel,  bounds.meet,   bounds.stable,   bounds.alone,  NO_BOUND,
                    NO_BOUND,       NO_BOUND,      NO_BOUND,        NO_BOUND,      NO_BOUND};
  double sum = 0.0;
  for (int i = 0; i < atom->nlocal; i++)
    for (int k = 0; k < 3; k++) {
      const double v = atom->v[i][k];
      here[V + k] = std::min(here[V + k], v);
      here[MINUS_V + k] = std::min(here[MINUS_V + k], -v);
      sum += v;
    }

  // MPI_MIN may drop a NaN, so carry it as the smallest number of all

  double lowest[N];
  for (int k = 0; k < N; k++)
    if (std::isnan(here[k]) || !std::isfinite(sum)) here[k] = -1.0;
  MPI_Allreduce(here, lowest, N, MPI_DOUBLE, MPI_MIN, lmp->world);

  double spread = 0.0, travel = NO_BOUND;
  if (atom->natoms > 0)
    for (int k = 0; k < 3; k++) {
      const double range = lowest[V + k] + lowest[MINUS_V + k];
      spread += range * range;
    }
  if (lowest[TRAVEL] < NO_BOUND && spread > 0.0) travel = lowest[TRAVEL] / std::sqrt(spread);

  travel = std::min(travel, lowest[MEET]);

  StableSteps steps = {factor * lowest[CONTACT], factor * lowest[SPRING],
                       std::min(factor * lowest[APPROACH], travel),
                       std::min(factor * lowest[SIGNAL], lowest[STABLE]), lowest[GROWTH]};
  if (std::min({steps.contact, steps.spring, steps.approach, steps.signal}) >= factor * NO_BOUND)
    steps.signal = factor * lowest[ALONE];
  return steps;
}

/* ---------------------------------------------------------------------- */

double HVI::stable_step(const LAMMPS *lmp, double factor)
{
  const StableSteps s = stable_steps(lmp, find_interface<TimeStepSource>(lmp), factor);
  const double shortest = std::min({s.contact, s.spring, s.approach, s.signal});
  return shortest < factor * NO_BOUND ? shortest : INFINITY;
}
