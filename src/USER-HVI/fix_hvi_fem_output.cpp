/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

// what output, files and the books see of elements

#include "fix_hvi_fem.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "memory.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using HVI::CORNERS;
using HVI::ELEMENT_SIZE;

/* ----------------------------------------------------------------------
   of the elements of a particle; internal energy with what the last half kick gave, as known at output, so that the sum with
   kinetic energy is exact
------------------------------------------------------------------------- */

double FixHVIFEM::internal_energy(int i) const
{
  double sum = 0.0;
  each_of(i, [&](const Element &one) {
    sum += one.mass * (one.e - one.kick);
  });
  return sum;
}

double FixHVIFEM::plastic_work(int i) const
{
  double sum = 0.0;
  each_of(i, [&](const Element &one) {
    sum += one.mass * one.solid.heat;
  });
  return sum;
}

double FixHVIFEM::void_work(int i) const
{
  double sum = 0.0;
  each_of(i, [&](const Element &one) {
    sum += one.mass * one.solid.voids.work;
  });
  return sum;
}

/* ----------------------------------------------------------------------
   Sums over ranks: the numbers of elements that have become particles, and why; heat of that, hourglass energy of all,
   elements without particles that have failed, internal energy, smallest step
------------------------------------------------------------------------- */

double FixHVIFEM::compute_vector(int k)
{
  double here = k < NCOUNT ? counts[k] : 0.0, sum;
  if (k > NCOUNT) {
    MPI_Allreduce(&shortest, &sum, 1, MPI_DOUBLE, MPI_MIN, world);
    return courant * sum;
  }
  for (const Element &one : elements) {
    if (!one.alive()) continue;
    if (k == HOURGLASS) here += one.hourglass;
    if (k == PLAIN && one.n == 0 && one.solid.failed()) here += 1.0;
    if (k == NCOUNT) here += one.mass * (one.e - one.kick);
  }
  MPI_Allreduce(&here, &sum, 1, MPI_DOUBLE, MPI_SUM, world);
  return sum;
}

// all ranks ask for it; in the middle of a step, and after a run, it is what was known last

double FixHVIFEM::compute_array(int i, int k)
{
  if (update->whichflag && at_end && probed != update->ntimestep) read_probes();
  return probes[i].value[k];
}

/* ----------------------------------------------------------------------
   Probes: the element whose center was nearest at the start of the first run: pressure, stress, von Mises
   stress, velocity and center; when it has become particles, 0
------------------------------------------------------------------------- */

static void center(const HVI::Corners &x, double c[3])
{
  for (int k = 0; k < 3; k++) {
    c[k] = 0.0;
    for (int a = 0; a < CORNERS; a++) c[k] += x[a][k] / CORNERS;
  }
}

// pressure, stress and von Mises stress

static std::array<double, 8> stress(const HVI::SolidState &solid, double p)
{
  const HVI::Deviator &S = solid.S;
  return {p, S.xx - p, S.yy - p, S.zz - p, S.xy, S.xz, S.yz, HVI::von_mises(S)};
}

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
      HVI::Corners x;
      double c[3], square = 0.0;
      places(e, x);
      center(x, c);
      for (int k = 0; k < 3; k++) square += (c[k] - probe.x[k]) * (c[k] - probe.x[k]);
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
  if (probes.empty()) return;
  probed = update->ntimestep;
  gather_nodes(0.0, true);
  std::vector<double> here(Probe::NVALUE * probes.size(), 0.0), all(here.size());
  for (std::size_t e = 0; e < elements.size(); e++)
    for (std::size_t n = 0; n < probes.size(); n++) {
      const Element &one = elements[e];
      if (probes[n].id != one.id) continue;
      double *const value = &here[Probe::NVALUE * n];
      const std::array<double, 8> s = stress(one.solid, steps[e].p);
      std::copy(s.begin(), s.end(), value);
      for (const HVI::Node *const node : nodes_of(e))
        for (int k = 0; k < 3; k++) value[8 + k] += node->v[k] / CORNERS;
      HVI::Corners x;
      places(e, x);
      center(x, value + 11);
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
  size_local_rows = elements.size();
  memory->destroy(array_local);
  memory->create(array_local, size_local_rows, NCOLUMN, "hvi/fem:local");
  for (int e = 0; e < size_local_rows; e++) {
    const Element &one = elements[e];
    HVI::Corners x;
    places(e, x);
    const std::array<double, 8> s = stress(one.solid, steps[e].p);
    const double last[] = {one.solid.eps, one.solid.damage, one.e, (double) one.n};
    double *row = array_local[e];
    *row++ = one.id;
    *row++ = one.type;
    center(x, row);
    std::copy_n(last, 4, std::copy(s.begin(), s.end(), row + 3));
  }
}

/* ----------------------------------------------------------------------
   Restart files: what is of all elements: the last step, their number and what has become of others, and which of them
   probes have, for the nearest now may be another
------------------------------------------------------------------------- */

void FixHVIFEM::write_restart(FILE *fp)
{
  double sum[NCOUNT];
  MPI_Reduce(counts, sum, NCOUNT, MPI_DOUBLE, MPI_SUM, 0, world);
  if (comm->me) return;
  std::vector<double> list = {(double) ELEMENT_SIZE, dt_last, (double) total};
  list.insert(list.end(), sum, sum + NCOUNT);
  list.push_back(probes.size());
  for (const Probe &probe : probes) {
    list.insert(list.end(), probe.x, probe.x + 3);
    list.push_back(probe.id);
  }
  const int size = list.size() * sizeof(double);
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(list.data(), size, 1, fp);
}

void FixHVIFEM::restart(char *buf)
{
  const double *list = (const double *) buf;
  if (list[0] != ELEMENT_SIZE)
    error->all(FLERR, "Fix hvi/fem: the restart file is of another version");
  dt_last = list[1];
  total = list[2];
  if (comm->me == 0) std::copy_n(list + 3, +NCOUNT, counts);
  list += 3 + NCOUNT;
  const double *const end = list + 1 + 4 * (int) list[0];
  for (++list; list < end; list += 4)
    for (Probe &probe : probes)
      if (std::equal(probe.x, probe.x + 3, list)) probe.id = list[3];
}
