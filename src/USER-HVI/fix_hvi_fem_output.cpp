/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

// what output and the books see of elements; the rest of the class is in fix_hvi_fem.cpp

#include "fix_hvi_fem.h"

#include "atom.h"
#include "comm.h"
#include "memory.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using HVI::CORNERS;

/* ---------------------------------------------------------------------- */

// with what the last half kick gave, as known at output, so that the sum with kinetic energy is exact

double FixHVIFEM::internal_energy(int i) const
{
  double sum = 0.0;
  for (int e = head[i]; e >= 0; e = next[e])
    if (alive(e)) sum += elements[e].mass * (elements[e].e - elements[e].kick);
  return sum;
}

double FixHVIFEM::plastic_work(int i) const
{
  double sum = 0.0;
  for (int e = head[i]; e >= 0; e = next[e])
    if (alive(e)) sum += elements[e].mass * elements[e].s.heat;
  return sum;
}

double FixHVIFEM::void_work(int i) const
{
  double sum = 0.0;
  for (int e = head[i]; e >= 0; e = next[e])
    if (alive(e)) sum += elements[e].mass * elements[e].s.voids.work;
  return sum;
}

/* ----------------------------------------------------------------------
   Elements that are left; then sums over ranks: the numbers of those that have become particles, and why;
   heat of that, hourglass energy of all, elements without particles that have failed, internal
   energy, smallest step
------------------------------------------------------------------------- */

double FixHVIFEM::compute_scalar()
{
  return total;
}

double FixHVIFEM::compute_vector(int k)
{
  double here = 0.0, sum;
  if (k < NCOUNT) {
    here = count[k];
    if (k == HOURGLASS)
      for (const Element &one : elements)
        if (one.type > 0) here += one.hourglass;
    if (k == PLAIN)
      for (const Element &one : elements)
        if (one.type > 0 && one.n == 0 && one.s.failed()) here += 1.0;
  } else if (k == NCOUNT) {
    for (const Element &one : elements)
      if (one.type > 0) here += one.mass * (one.e - one.kick);
  } else {
    MPI_Allreduce(&shortest, &sum, 1, MPI_DOUBLE, MPI_MIN, world);
    return options.courant * sum;
  }
  MPI_Allreduce(&here, &sum, 1, MPI_DOUBLE, MPI_SUM, world);
  return sum;
}

// all ranks ask for it; what a run has left is of its last step

double FixHVIFEM::compute_array(int i, int k)
{
  if (update->whichflag && probed != update->ntimestep) read_probes();
  return probes[i].value[k];
}

/* ----------------------------------------------------------------------
   Probes: the element whose center was nearest at the start of the first run: pressure, stress, von Mises
   stress, velocity and center; when it has become particles, 0
------------------------------------------------------------------------- */

void FixHVIFEM::find_probes()
{
  for (Probe &probe : probes) {
    if (probe.id) continue;
    struct {
      double distance;
      int rank;
    } here = {HUGE_VAL, comm->me}, nearest;
    std::int64_t id_here = 0;
    for (std::size_t e = 0; e < elements.size(); e++) {
      double x[CORNERS][3], square = 0.0;
      corners(e, X, x);
      for (int k = 0; k < 3; k++) {
        double center = 0.0;
        for (const auto &corner_x : x) center += corner_x[k] / CORNERS;
        square += (center - probe.x[k]) * (center - probe.x[k]);
      }
      if (square >= here.distance) continue;
      here.distance = square;
      id_here = elements[e].id;
    }
    MPI_Allreduce(&here, &nearest, 1, MPI_DOUBLE_INT, MPI_MINLOC, world);
    MPI_Bcast(&id_here, 1, MPI_INT64_T, nearest.rank, world);
    probe.id = id_here;
  }
}

void FixHVIFEM::read_probes()
{
  if (probes.empty() || now.size() != elements.size()) return;
  probed = update->ntimestep;
  std::vector<double> v(3 * nodes.size());    // that of the table is extrapolated until output
  nodes.gather(
      3,
      [this](int i, double *b) {
        std::copy_n(atom->v[i], 3, b);
      },
      [&v](int k, const double *b) {
        std::copy_n(b, 3, &v[3 * k]);
      });
  std::vector<double> here(Probe::NVALUE * probes.size(), 0.0), all(here.size());
  for (std::size_t e = 0; e < elements.size(); e++) {
    if (!alive(e)) continue;
    for (std::size_t n = 0; n < probes.size(); n++) {
      const Element &one = elements[e];
      if (probes[n].id != one.id) continue;
      double *const value = &here[Probe::NVALUE * n];
      const HVI::Deviator &S = one.s.S;
      const double p = now[e].p;
      const double stress[7] = {p, S.xx - p, S.yy - p, S.zz - p, S.xy, S.xz, S.yz};
      std::copy_n(stress, 7, value);
      value[7] = HVI::von_mises(S);
      double x[CORNERS][3];
      corners(e, X, x);
      for (int a = 0; a < CORNERS; a++)
        for (int k = 0; k < 3; k++) {
          value[8 + k] += v[3 * corner[CORNERS * e + a] + k] / CORNERS;
          value[11 + k] += x[a][k] / CORNERS;
        }
    }
  }
  MPI_Allreduce(here.data(), all.data(), here.size(), MPI_DOUBLE, MPI_SUM, world);
  for (std::size_t n = 0; n < probes.size(); n++)
    std::copy_n(&all[Probe::NVALUE * n], +Probe::NVALUE, probes[n].value);
}

/* ----------------------------------------------------------------------
   Elements of this rank for dump local and compute reduce: ID, type, center, pressure, stress, von Mises
   stress, plastic strain, damage, energy per mass, particles per edge
------------------------------------------------------------------------- */

void FixHVIFEM::list_elements()
{
  size_local_rows = std::count_if(elements.begin(), elements.end(), [](const Element &one) {
    return one.type > 0;
  });
  memory->destroy(array_local);
  memory->create(array_local, size_local_rows, NCOLUMN, "hvi/fem:local");
  int row = 0;
  for (std::size_t e = 0; e < elements.size(); e++) {
    if (!alive(e)) continue;
    const Element &one = elements[e];
    const HVI::Deviator &S = one.s.S;
    double x[CORNERS][3], center[3] = {};
    corners(e, X, x);
    for (const auto &corner_x : x)
      for (int k = 0; k < 3; k++) center[k] += corner_x[k] / CORNERS;
    const double p = now[e].p;
    const double list[NCOLUMN] = {
        (double) one.id,   (double) one.type, center[0],    center[1], center[2],     p,
        S.xx - p,          S.yy - p,          S.zz - p,     S.xy,      S.xz,          S.yz,
        HVI::von_mises(S), one.s.eps,         one.s.damage, one.e,     (double) one.n};
    std::copy_n(list, +NCOLUMN, array_local[row++]);
  }
}
