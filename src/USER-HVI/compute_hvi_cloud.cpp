/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */
#include "compute_hvi_cloud.h"

#include "atom.h"
#include "error.h"
#include "force.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

using namespace LAMMPS_NS;

// the global vector, in this order

// clang-format off
enum {
  LENGTH, DIAMETER, RATIO, FRONT, REAR, FRONT_VELOCITY, REAR_VELOCITY, EXPANSION,
  MASS, MOMENTUM, KINETIC, COUNT, NVALUES
};
// clang-format on

static constexpr double TIE = 1.0e-9;          // distances that differ by less are equal
static constexpr double TIE_MASS = 1.0e-12;    // shares of the mass likewise

/* ---------------------------------------------------------------------- */

ComputeHVICloud::ComputeHVICloud(LAMMPS *lmp, int narg, char **arg) :
    ComputeHVIMatter(lmp, narg, arg), axis(-1), plane(NAN), quantile(0.99)
{
  vector_flag = 1;
  size_vector = NVALUES;
  extvector = 0;

  int iarg = 3;
  while (iarg < narg) {
    if (iarg + 2 > narg)
      utils::missing_cmd_args(FLERR, fmt::format("compute hvi/cloud {}", arg[iarg]), error);
    const char *const value = arg[iarg + 1];
    if (strcmp(arg[iarg], "axis") == 0) {
      axis = axis_of(value);
    } else if (strcmp(arg[iarg], "plane") == 0) {
      plane = utils::numeric(FLERR, value, false, lmp);
      if (!std::isfinite(plane))
        error->all(FLERR, "Compute hvi/cloud plane must be a number, not {}", value);
    } else if (strcmp(arg[iarg], "quantile") == 0) {
      quantile = utils::numeric(FLERR, value, false, lmp);
      if (!(quantile > 0.5 && quantile <= 1.0))
        error->all(FLERR, "Compute hvi/cloud quantile must be > 0.5 and <= 1, not {}", value);
    } else
      error->all(FLERR, "Unknown compute hvi/cloud keyword: {}", arg[iarg]);
    iarg += 2;
  }
  if (axis < 0) utils::missing_cmd_args(FLERR, "compute hvi/cloud axis", error);
  if (std::isnan(plane)) utils::missing_cmd_args(FLERR, "compute hvi/cloud plane", error);

  vector = new double[size_vector];
}

/* ---------------------------------------------------------------------- */

ComputeHVICloud::~ComputeHVICloud()
{
  delete[] vector;
}

/* ---------------------------------------------------------------------- */

void ComputeHVICloud::compute_vector()
{
  invoked_vector = update->ntimestep;

  const double *const *const v = atom->v;
  const int across[2] = {(axis + 1) % 3, (axis + 2) % 3};
  const HVI::MirrorPlanes mirror = find_mirror();

  // sums over the cloud

  enum { SMASS, SMOMENTUM, SMVSQ, SCOUNT, SY, SVY = SY + 2, NSUM = SVY + 2 };
  double mine[NSUM] = {0.0}, sum[NSUM];
  cloud.clear();
  each([&](int i, double m, const double *x) {
    if (!(x[axis] > plane)) return;

    Particle p = {};
    p.mass = m;
    p.s = x[axis];
    p.vs = v[i][axis];
    for (int k = 0; k < 2; k++) {
      p.y[k] = x[across[k]];
      p.vy[k] = v[i][across[k]];
      mine[SY + k] += p.mass * p.y[k];
      mine[SVY + k] += p.mass * p.vy[k];
    }
    mine[SMASS] += p.mass;
    mine[SMOMENTUM] += p.mass * p.vs;
    mine[SMVSQ] += p.mass * (p.vs * p.vs + p.vy[0] * p.vy[0] + p.vy[1] * p.vy[1]);
    mine[SCOUNT] += 1.0;
    cloud.push_back(p);
  });
  MPI_Allreduce(mine, sum, NSUM, MPI_DOUBLE, MPI_SUM, world);

  std::fill(vector, vector + NVALUES, 0.0);
  if (sum[SCOUNT] == 0.0) return;
  vector[MASS] = sum[SMASS];
  vector[MOMENTUM] = sum[SMOMENTUM];
  vector[KINETIC] = 0.5 * force->mvv2e * sum[SMVSQ];
  vector[COUNT] = sum[SCOUNT];

  // distance from the axis, and how fast it grows; mirror planes hold the axis

  double center[2], drift[2];
  for (int k = 0; k < 2; k++) {
    const bool mirrored = mirror.has(across[k]);
    center[k] = mirrored ? mirror.at[across[k]] : sum[SY + k] / sum[SMASS];
    drift[k] = mirrored ? 0.0 : sum[SVY + k] / sum[SMASS];
  }

  for (Particle &p : cloud) {
    double y[2], vy[2];
    for (int k = 0; k < 2; k++) {
      y[k] = p.y[k] - center[k];
      vy[k] = p.vy[k] - drift[k];
    }
    p.r = std::sqrt(y[0] * y[0] + y[1] * y[1]);
    p.vr = (p.r > 0.0) ? (y[0] * vy[0] + y[1] * vy[1]) / p.r : 0.0;
  }

  vector[FRONT] = find_quantile(&Particle::s, 1.0);
  vector[REAR] = -find_quantile(&Particle::s, -1.0);
  vector[LENGTH] = vector[FRONT] - vector[REAR];
  const double radius = find_quantile(&Particle::r, 1.0);
  vector[DIAMETER] = 2.0 * radius;
  if (radius > 0.0) vector[RATIO] = vector[LENGTH] / radius;

  // what moves at the edges: all that lie as far out but for round-off, or symmetry would be
  // broken by chance

  const double front = vector[FRONT] - TIE * vector[LENGTH];
  const double rear = vector[REAR] + TIE * vector[LENGTH];
  double edge_mine[6] = {0.0}, edge[6];
  for (const Particle &p : cloud) {
    if (p.s >= front) {
      edge_mine[0] += p.mass;
      edge_mine[1] += p.mass * p.vs;
    }
    if (p.s <= rear) {
      edge_mine[2] += p.mass;
      edge_mine[3] += p.mass * p.vs;
    }
    if (p.r >= (1.0 - TIE) * radius) {
      edge_mine[4] += p.mass;
      edge_mine[5] += p.mass * p.vr;
    }
  }
  MPI_Allreduce(edge_mine, edge, 6, MPI_DOUBLE, MPI_SUM, world);
  vector[FRONT_VELOCITY] = edge[1] / edge[0];
  vector[REAR_VELOCITY] = edge[3] / edge[2];
  vector[EXPANSION] = edge[5] / edge[4];
}

/* ----------------------------------------------------------------------
   numbers in the order of the doubles, for a bisection that ends
------------------------------------------------------------------------- */

static uint64_t to_rank(double value)
{
  uint64_t bits;
  memcpy(&bits, &value, sizeof(bits));
  return (bits >> 63) ? ~bits : bits | (uint64_t(1) << 63);
}

static double from_rank(uint64_t bits)
{
  bits = (bits >> 63) ? bits & ~(uint64_t(1) << 63) : ~bits;
  double value;
  memcpy(&value, &bits, sizeof(value));
  return value;
}

/* ----------------------------------------------------------------------
   Smallest value of a particle (what * sign) up to which the share quantile of
   the mass lies.  Mass is counted in integers, in units of 2^-61 of all of it or
   less, so that the order of summation does not matter: the answer is the same
   particle's on any number of ranks.
------------------------------------------------------------------------- */

double ComputeHVICloud::find_quantile(double Particle::*what, double sign)
{
  const int n = cloud.size();
  const int unit = 61 - std::ilogb(vector[MASS]);
  ordered.clear();
  for (const Particle &p : cloud)
    ordered.push_back({sign * p.*what, std::llround(std::ldexp(p.mass, unit))});
  std::sort(ordered.begin(), ordered.end(), [](const Weighted &a, const Weighted &b) {
    return a.value < b.value;
  });
  for (int i = 1; i < n; i++) ordered[i].weight += ordered[i - 1].weight;

  auto weight_up_to = [this](double value) {
    const auto it =
        std::upper_bound(ordered.begin(), ordered.end(), value, [](double v, const Weighted &w) {
          return v < w.value;
        });
    int64_t mine = (it == ordered.begin()) ? 0 : (it - 1)->weight, all;
    MPI_Allreduce(&mine, &all, 1, MPI_INT64_T, MPI_SUM, world);
    return all;
  };

  // the highest value and minus the lowest

  const double big = std::numeric_limits<double>::max();
  double mine[2] = {-big, -big}, ends[2];
  if (n > 0) {
    mine[0] = ordered[n - 1].value;
    mine[1] = -ordered[0].value;
  }
  MPI_Allreduce(mine, ends, 2, MPI_DOUBLE, MPI_MAX, world);

  const int64_t wanted = std::llround((1.0 - TIE_MASS) * quantile * weight_up_to(ends[0]));
  uint64_t lo = to_rank(-ends[1]);
  uint64_t hi = to_rank(ends[0]);
  while (lo < hi) {
    const uint64_t middle = lo + (hi - lo) / 2;
    if (weight_up_to(from_rank(middle)) >= wanted)
      hi = middle;
    else
      lo = middle + 1;
  }
  return from_rank(hi);
}

/* ---------------------------------------------------------------------- */

double ComputeHVICloud::memory_usage()
{
  return (double) cloud.capacity() * sizeof(Particle) +
      (double) ordered.capacity() * sizeof(Weighted);
}
