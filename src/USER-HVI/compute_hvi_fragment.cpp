/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */
#include "compute_hvi_fragment.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "hvi_mesh.h"
#include "memory.h"
#include "region.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

using namespace LAMMPS_NS;

enum { N_FRAG, N_PART, FRAGMENTATION, LARGEST, SINGLES, NVALUES };    // global vector
static constexpr int NCOLS = 11;                                      // of a row

/* ---------------------------------------------------------------------- */

ComputeHVIFragment::ComputeHVIFragment(LAMMPS *lmp, int narg, char **arg) :
    ComputeHVIFragmentAtom(lmp, narg, arg, 1), idregion(nullptr), region(nullptr), table_step(-1)
{
  vector_flag = local_flag = 1;
  size_vector = NVALUES;
  extvector = 0;
  size_local_cols = NCOLS;
  size_local_rows = 0;

  while (iarg < narg) {
    if (strcmp(arg[iarg], "region") == 0) {
      if (iarg + 2 > narg) utils::missing_cmd_args(FLERR, "compute hvi/fragment region", error);
      if (!domain->get_region_by_id(arg[iarg + 1]))
        error->all(FLERR, "Region {} for compute hvi/fragment does not exist", arg[iarg + 1]);
      delete[] idregion;
      idregion = utils::strdup(arg[iarg + 1]);
      iarg += 2;
    } else
      error->all(FLERR, "Unknown compute hvi/fragment keyword: {}", arg[iarg]);
  }

  vector = new double[size_vector];
}

/* ---------------------------------------------------------------------- */

ComputeHVIFragment::~ComputeHVIFragment()
{
  delete[] idregion;
  delete[] vector;
  memory->destroy(array_local);
}

/* ---------------------------------------------------------------------- */

void ComputeHVIFragment::init()
{
  ComputeHVIFragmentAtom::init();

  if (idregion) {
    region = domain->get_region_by_id(idregion);
    if (!region) error->all(FLERR, "Region {} for compute hvi/fragment does not exist", idregion);
  }
  table_step = -1;    // a new run may start at the same step from other particles
  if (cutoff == 0.0 && find_mirror().planes)
    error->all(
        FLERR,
        "Compute hvi/fragment bonds: bonds do not tell what hangs together with its image in "
        "a mirror plane of pair style hvi/sph: use distance");
}

/* ---------------------------------------------------------------------- */

ComputeHVIFragment::Heaviest ComputeHVIFragment::find_heaviest()
{
  table_step = -1;
  make_rows();

  double mine[2] = {0.0, 0.0}, all[2];    // number; largest mass
  for (const Row &r : rows) {
    mine[0] += number(r);
    mine[1] = MAX(mine[1], r.mass);
  }
  MPI_Allreduce(&mine[0], &all[0], 1, MPI_DOUBLE, MPI_SUM, world);
  MPI_Allreduce(&mine[1], &all[1], 1, MPI_DOUBLE, MPI_MAX, world);

  int64_t lowest = INT64_MAX, found;
  for (const Row &r : rows)
    if (r.mass == all[1]) lowest = MIN(lowest, r.id);
  MPI_Allreduce(&lowest, &found, 1, MPI_INT64_T, MPI_MIN, world);
  if (found == INT64_MAX) return {0, 0.0, 0.0, {0.0, 0.0, 0.0}};

  Heaviest heaviest = {found, all[0], all[1], {0.0, 0.0, 0.0}};
  double velocity[3] = {0.0, 0.0, 0.0};
  for (const Row &r : rows)
    if (r.id == found)
      for (int k = 0; k < 3; k++) velocity[k] = r.momentum[k] / r.mass;
  MPI_Allreduce(velocity, heaviest.velocity, 3, MPI_DOUBLE, MPI_SUM, world);
  return heaviest;
}

/* ---------------------------------------------------------------------- */

void ComputeHVIFragment::compute_vector()
{
  invoked_vector = update->ntimestep;
  make_rows();

  double mine[NVALUES] = {0.0}, sum[NVALUES], mass = 0.0, largest = 0.0;
  for (const Row &r : rows) {
    const double n = number(r);
    mine[N_FRAG] += n;
    mine[N_PART] += n * r.count;
    mine[LARGEST] += n * r.mass;
    if (r.count == 1.0) mine[SINGLES] += n * r.mass;
    mass = MAX(mass, r.mass);
  }
  MPI_Allreduce(mine, sum, NVALUES, MPI_DOUBLE, MPI_SUM, world);
  MPI_Allreduce(&mass, &largest, 1, MPI_DOUBLE, MPI_MAX, world);

  vector[N_FRAG] = sum[N_FRAG];
  vector[N_PART] = sum[N_PART];
  vector[FRAGMENTATION] = (sum[N_PART] > 0.0) ? sum[N_FRAG] / sum[N_PART] : 0.0;
  vector[LARGEST] = (sum[LARGEST] > 0.0) ? largest / sum[LARGEST] : 0.0;
  vector[SINGLES] = sum[SINGLES];
}

/* ----------------------------------------------------------------------
   rank 0 holds them all: a dump shows them in order.  IDs in the second, third, ... part of a mirrored
   model are above those of the parts before by the highest of all.
------------------------------------------------------------------------- */

void ComputeHVIFragment::compute_local()
{
  invoked_local = update->ntimestep;
  make_rows();

  std::vector<Row> all = HVI::deliver(world, rows, std::vector<int>(rows.size(), 0));
  if (mirror.planes) {
    int64_t mine = 1, highest;
    each([&](int i, double, const double *) {
      mine = MAX(mine, atom->tag[i]);
    });
    MPI_Allreduce(&mine, &highest, 1, MPI_INT64_T, MPI_MAX, world);

    const size_t there = all.size();
    int64_t above = 0;
    for (int op = 1; op < HVI::MirrorPlanes::NOPS; op++) {
      if (!mirror.is_operation(op)) continue;
      above += highest;
      for (size_t n = 0; n < there; n++)
        if (!(op & all[n].reached)) {
          all.push_back(all[n].image(mirror, op));
          all.back().id += above;
        }
    }
  }
  std::sort(all.begin(), all.end(), [](const Row &a, const Row &b) {
    return (a.mass != b.mass) ? a.mass > b.mass : a.id < b.id;
  });

  size_local_rows = all.size();
  memory->destroy(array_local);
  memory->create(array_local, size_local_rows, NCOLS, "hvi/fragment:array_local");
  for (int n = 0; n < size_local_rows; n++) {
    const Row &r = all[n];
    double *const col = array_local[n];
    col[0] = r.id;
    col[1] = r.count;
    col[2] = r.mass;
    for (int k = 0; k < 3; k++) {
      col[3 + k] = r.center[k];
      col[6 + k] = r.momentum[k] / r.mass;
    }
    col[9] = 0.5 * force->mvv2e * r.mvsq;
    col[10] = 2.0 * std::sqrt(5.0 / 3.0 * r.spread / r.mass);
  }
}

/* ----------------------------------------------------------------------
   the owner of a fragment's lowest ID gathers what others have of it.  Rows hold for a step of a run: between
   runs commands may have changed anything.
------------------------------------------------------------------------- */

void ComputeHVIFragment::make_rows()
{
  if (table_step == update->ntimestep && update->whichflag) return;
  table_step = update->ntimestep;

  find_fragments(region);
  mirror = find_mirror();

  const int nlocal = atom->nlocal;
  const double *const *const v = atom->v;
  const HVI::Mesh *const mesh = cutoff > 0.0 ? HVI::find_mesh(lmp) : nullptr;    // not by bonds
  rows.clear();
  slot.assign(nlocal, -1);
  std::vector<Share> shares;
  std::vector<int> rank;

  each([&](int i, double m, const double *x) {
    if (id[i] == 0) return;
    const HVI::Components::Node &piece = components.component(i);
    const bool here = piece.rank == comm->me;
    const int vertex = here ? piece.vertex : components.local(i);

    if (slot[vertex] < 0) {
      const Row empty = {std::abs(piece.id), 0.0, 0.0, {0.0}, {0.0}, 0.0, 0.0, 0};
      if (here) {
        slot[vertex] = rows.size();
        rows.push_back(empty);
      } else {
        slot[vertex] = shares.size();
        shares.push_back({empty, piece.vertex});
        rank.push_back(piece.rank);
      }
    }
    Row &row = here ? rows[slot[vertex]] : shares[slot[vertex]].row;

    const double own = reach(atom->type[i], atom->type[i]);    // to its image
    Row one = {0, 1.0, m, {x[0], x[1], x[2]}, {0.0}, 0.0, 0.0, 0};
    for (int k = 0; k < 3; k++) {
      one.momentum[k] = m * v[i][k];
      if (id[i] > 0 && mirror.has(k) && 2.0 * mirror.depth(k, x) < own) one.reached |= 1 << k;
    }
    if (mesh && id[i] > 0) one.reached |= mesh->on_mirror_planes(i);
    one.mvsq = m * (v[i][0] * v[i][0] + v[i][1] * v[i][1] + v[i][2] * v[i][2]);
    row.add(one);
  });

  for (const Share &s : HVI::deliver(world, shares, rank)) rows[slot[s.vertex]].add(s.row);
  for (Row &r : rows)
    for (int k = 0; k < 3; k++)
      if (r.reached >> k & 1) r.add(r.image(mirror, 1 << k));
}

/* ---------------------------------------------------------------------- */

double ComputeHVIFragment::number(const Row &r) const
{
  double n = 1.0;
  for (int k = 0; k < 3; k++)
    if (mirror.has(k) && !(r.reached >> k & 1)) n *= 2.0;
  return n;
}

ComputeHVIFragment::Row ComputeHVIFragment::Row::image(const HVI::MirrorPlanes &planes,
                                                       int op) const
{
  Row there = *this;
  for (int k = 0; k < 3; k++)
    if (op >> k & 1) {
      there.center[k] = 2.0 * planes.at[k] - center[k];
      there.momentum[k] = -momentum[k];
    }
  return there;
}

/* ----------------------------------------------------------------------
   spread about the common center (Chan, Golub & LeVeque 1983): no difference
   of large numbers
------------------------------------------------------------------------- */

void ComputeHVIFragment::Row::add(const Row &other)
{
  const double total = mass + other.mass;
  const double part = other.mass / total;
  double distsq = 0.0;
  for (int k = 0; k < 3; k++) {
    const double d = other.center[k] - center[k];
    distsq += d * d;
    center[k] += part * d;
    momentum[k] += other.momentum[k];
  }
  spread += other.spread + mass * part * distsq;
  count += other.count;
  mass = total;
  mvsq += other.mvsq;
  reached |= other.reached;
}

/* ---------------------------------------------------------------------- */

double ComputeHVIFragment::memory_usage()
{
  return ComputeHVIFragmentAtom::memory_usage() + (double) rows.capacity() * sizeof(Row) +
      (double) slot.capacity() * sizeof(int) + (double) size_local_rows * NCOLS * sizeof(double);
}
