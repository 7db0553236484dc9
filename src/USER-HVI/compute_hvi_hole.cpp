/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */
#include "compute_hvi_hole.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_store_global.h"
#include "group.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

using namespace LAMMPS_NS;

// the global vector, in this order

// clang-format off
enum {
  DIAMETER, SMALLEST, LARGEST, CENTER, AREA = CENTER + 2, SHARE, LAYER, REFERENCE, SPACING, FOUND, NVALUES
};
// clang-format on

enum { PLACED, AT, NKEPT = AT + 3 };    // in the fix that keeps them

static constexpr int PER_OCTAVE = 64, OCTAVES = 40;    // bins for distances from the plane
static constexpr int NBINS = 4096;                     // bins for coordinates across the axis
static constexpr double TAIL = 0.01;                   // share of the particles in each tail
static constexpr double MARGIN = 0.1;                  // what is added there, in plate widths
static constexpr double FINEST = 0.75;                 // map, in spacings of the particles
static constexpr int MOST_PARTS = 4;                   // along the edge of a large particle
static constexpr double ONE_SIDED = 0.01;              // a plate with less on one side is mirrored

/* ---------------------------------------------------------------------- */

ComputeHVIHole::ComputeHVIHole(LAMMPS *lmp, int narg, char **arg, bool keeps) :
    ComputeHVIMatter(lmp, narg, arg), axis(-1), sectors(36), center{NAN, NAN}, plane(NAN),
    thickness(0.0), dr(0.0), fill(0.5), reference(0.0), is_away(false), placed(false),
    id_fix(nullptr), warned_open(false), warned_away(false), warned_coarse(false), warned_dr(false)
{
  if (domain->dimension != 3)
    error->all(FLERR, "Compute hvi/hole needs a three-dimensional simulation");

  vector_flag = 1;
  size_vector = NVALUES;
  extvector = 0;

  int iarg = 3;
  auto number = [&](int i) {
    return utils::numeric(FLERR, arg[i], false, lmp);
  };
  auto positive = [&](int i) {
    const double value = number(i);
    if (!(value > 0.0))
      error->all(FLERR, "Compute hvi/hole {} must be > 0, not {}", arg[iarg], arg[i]);
    return value;
  };
  while (iarg < narg) {
    const bool two = strcmp(arg[iarg], "centre") == 0 || strcmp(arg[iarg], "center") == 0;
    if (iarg + (two ? 3 : 2) > narg)
      utils::missing_cmd_args(FLERR, fmt::format("compute hvi/hole {}", arg[iarg]), error);
    const char *const value = arg[iarg + 1];
    if (two) {
      center[0] = number(iarg + 1);
      center[1] = number(iarg + 2);
      iarg++;
    } else if (strcmp(arg[iarg], "axis") == 0) {
      axis = axis_of(value);
    } else if (strcmp(arg[iarg], "plane") == 0) {
      plane = number(iarg + 1);
    } else if (strcmp(arg[iarg], "thickness") == 0) {
      thickness = positive(iarg + 1);
    } else if (strcmp(arg[iarg], "dr") == 0) {
      dr = positive(iarg + 1);
    } else if (strcmp(arg[iarg], "reference") == 0) {
      reference = positive(iarg + 1);
    } else if (strcmp(arg[iarg], "fill") == 0) {
      fill = number(iarg + 1);
      if (!(fill > 0.0 && fill < 1.0))
        error->all(FLERR, "Compute hvi/hole fill must be > 0 and < 1, not {}", value);
    } else if (strcmp(arg[iarg], "sectors") == 0) {
      sectors = utils::inumeric(FLERR, value, false, lmp);
      if (sectors < 8 || sectors > 3600 || sectors % 2)
        error->all(FLERR, "Compute hvi/hole sectors must be even, from 8 to 3600, not {}", value);
    } else
      error->all(FLERR, "Unknown compute hvi/hole keyword: {}", arg[iarg]);
    iarg += 2;
  }
  if (axis < 0) utils::missing_cmd_args(FLERR, "compute hvi/hole axis", error);
  if (std::isnan(center[0])) utils::missing_cmd_args(FLERR, "compute hvi/hole centre", error);
  if (std::isnan(plane)) utils::missing_cmd_args(FLERR, "compute hvi/hole plane", error);
  across[0] = (axis == 0) ? 1 : 0;
  across[1] = (axis == 2) ? 1 : 2;

  vector = new double[size_vector];

  // what a restart file says is of another place if the command has been given another one

  if (!keeps) return;
  id_fix = utils::strdup(std::string(id) + "_COMPUTE_STORE");
  const double *const kept =
      dynamic_cast<FixStoreGlobal *>(
          modify->add_fix(fmt::format("{} all STORE/GLOBAL {} 1", id_fix, (int) NKEPT)))
          ->vstore;
  placed = kept[PLACED] != 0.0 && kept[AT] == center[0] && kept[AT + 1] == center[1] &&
      kept[AT + 2] == plane;
}

/* ---------------------------------------------------------------------- */

ComputeHVIHole::~ComputeHVIHole()
{
  if (id_fix && modify->get_fix_by_id(id_fix)) modify->delete_fix(id_fix);
  delete[] id_fix;
  delete[] vector;
}

/* ---------------------------------------------------------------------- */

void ComputeHVIHole::init()
{
  warned_open = warned_away = warned_coarse = warned_dr = false;
  keep();
}

/* ---------------------------------------------------------------------- */

void ComputeHVIHole::keep() const
{
  if (!id_fix) return;
  const auto *const fix = dynamic_cast<FixStoreGlobal *>(modify->get_fix_by_id(id_fix));
  if (!fix) error->all(FLERR, "Compute hvi/hole: the fix {} that it made is gone", id_fix);
  const double kept[NKEPT] = {placed ? 1.0 : 0.0, center[0], center[1], plane};
  std::copy(kept, kept + NKEPT, fix->vstore);
}

/* ---------------------------------------------------------------------- */

void ComputeHVIHole::compute_vector()
{
  invoked_vector = update->ntimestep;
  std::fill(vector, vector + NVALUES, 0.0);
  vector[FOUND] = -1.0;

  find_layer();
  const bool found_plate = find_extent();
  if (placed) is_away = false;    // it has been there, and flies
  placed = placed || (found_plate && !is_away);
  keep();
  if (is_away && comm->me == 0 && !warned_away) {
    error->warning(
        FLERR,
        "Compute hvi/hole: no plate around the centre, the hole is taken as 0: particles of "
        "group {} are far away from {} {} or from the plane at {}",
        group->names[igroup], center[0], center[1], plane);
    warned_away = true;
  }
  if (!found_plate || is_away) return;

  // a map with a spacing from the layer's volume tells the spacing of the plate's particles

  const double area = (hi[0] - lo[0]) * (hi[1] - lo[1]) * vector[SHARE] / cells;
  grain = std::max(std::cbrt(2.0 * std::min(half, farthest) * area), std::sqrt(area));
  make_map(grain);
  const double spacing = grain = find_spacing();
  if (dr > 0.0 && dr < FINEST * spacing) {
    if (comm->me == 0 && !warned_dr)
      error->warning(FLERR, "Compute hvi/hole dr {} is too small for particles {} apart, using {}",
                     dr, spacing, FINEST * spacing);
    warned_dr = true;
  }
  make_map((dr > 0.0) ? std::max(dr, FINEST * spacing) : spacing);
  if (reference > 0.0) map.intact = reference;
  vector[LAYER] = 2.0 * half;
  vector[REFERENCE] = map.intact;
  vector[SPACING] = map.h;

  const HVI::Plate::Found found = map.find_hole(fill, mirrored[0] || mirrored[1]);
  if (found == HVI::Plate::OPEN && comm->me == 0 && !warned_open) {
    error->warning(FLERR, "Compute hvi/hole: no plate around the centre, the hole is taken as 0");
    warned_open = true;
  }
  if (found == HVI::Plate::NO_HOLE) vector[FOUND] = 0.0;
  if (found != HVI::Plate::HOLE) return;
  vector[FOUND] = 1.0;

  const HVI::Plate::Hole hole = map.measure(sectors);
  vector[DIAMETER] = hole.diameter;
  vector[SMALLEST] = hole.smallest;
  vector[LARGEST] = hole.largest;
  vector[AREA] = hole.area;
  for (int k = 0; k < 2; k++) vector[CENTER + k] = center[k] + hole.center[k];
}

/* ----------------------------------------------------------------------
   Particles of the group near the plane.  How near is told by a fixed point: half
   the layer is 4 times the median distance of its own particles from the plane,
   that is the thickness of an even plate with the plane in its middle.  In a single
   layer this is 0, or round-off: half the layer is no less than the group's width
   over the root of its number, which is the spacing there.
------------------------------------------------------------------------- */

void ComputeHVIHole::find_layer()
{
  layer.clear();
  is_away = false;

  // from the third on: minus the lowest, and the highest; minus the least mass; both ends along the axis

  double mine[9] = {0.0, 0.0}, most[9];
  std::fill(mine + 2, mine + 9, -HUGE_VAL);
  each([&](int, double m, const double *x) {
    const Particle p = {
        m, x[axis] - plane, {x[across[0]] - center[0], x[across[1]] - center[1]}, 1};
    mine[0] = std::max(mine[0], std::fabs(p.s));
    mine[1] = std::max(mine[1], p.mass);
    mine[7] = std::max(mine[7], -p.s);
    mine[8] = std::max(mine[8], p.s);
    if (m > 0.0) mine[6] = std::max(mine[6], -m);
    for (int k = 0; k < 2; k++) {
      mine[2 + k] = std::max(mine[2 + k], -p.y[k]);
      mine[4 + k] = std::max(mine[4 + k], p.y[k]);
    }
    layer.push_back(p);
  });
  MPI_Allreduce(mine, most, 9, MPI_DOUBLE, MPI_MAX, world);
  const int64_t here = layer.size();
  int64_t everywhere;
  MPI_Allreduce(&here, &everywhere, 1, MPI_INT64_T, MPI_SUM, world);
  farthest = most[0];
  if (most[1] == 0.0) return;
  least_mass = -most[6];
  unit = std::ldexp(1.0, 57 - std::ilogb(most[1]) - std::ilogb((double) atom->natoms + 1.0));

  const double least = std::sqrt((most[2] + most[4]) * (most[3] + most[5]) / everywhere);
  const double depth = most[7] + most[8] + least;
  is_away = most[7] < -depth || most[8] < -depth;
  half = (thickness > 0.0) ? 0.5 * thickness : least;
  if (thickness == 0.0 && farthest > 0.0) {
    const int nbins = OCTAVES * PER_OCTAVE;
    std::vector<int64_t> number(nbins, 0);
    for (const Particle &p : layer) {
      const double octave = OCTAVES + std::log2(std::fabs(p.s) / farthest);
      number[(int) std::clamp(octave * PER_OCTAVE, 0.0, nbins - 1.0)]++;
    }
    MPI_Allreduce(MPI_IN_PLACE, number.data(), nbins, MPI_INT64_T, MPI_SUM, world);
    for (int b = 1; b < nbins; b++) number[b] += number[b - 1];

    auto quantile = [&](double q, int last) {
      const double wanted = q * number[std::min(last, nbins - 1)];
      int b = 0;
      while (number[b] < wanted) b++;
      return b;
    };
    int last = quantile(0.35, nbins) + 3 * PER_OCTAVE;
    for (;;) {
      const int next = quantile(0.5, last) + 2 * PER_OCTAVE;
      if (next >= last) break;
      last = next;
    }
    half = std::max(least, farthest * std::exp2((last + 1.0) / PER_OCTAVE - OCTAVES));
  }
  layer.erase(std::remove_if(layer.begin(), layer.end(),
                             [this](const Particle &p) {
                               return std::fabs(p.s) > half;
                             }),
              layer.end());
}

/* ----------------------------------------------------------------------
   Where the plate is, but for strays, and whether it is a half or a quarter of one,
   cut at the center: then it is mirrored there.
------------------------------------------------------------------------- */

bool ComputeHVIHole::find_extent()
{
  double mine[5], ends[5];    // minus the lowest, and the highest; farthest from the plane
  std::fill(mine, mine + 5, -HUGE_VAL);
  for (const Particle &p : layer) {
    for (int k = 0; k < 2; k++) {
      mine[k] = std::max(mine[k], -p.y[k]);
      mine[2 + k] = std::max(mine[2 + k], p.y[k]);
    }
    mine[4] = std::max(mine[4], std::fabs(p.s));
  }
  MPI_Allreduce(mine, ends, 5, MPI_DOUBLE, MPI_MAX, world);
  farthest = ends[4];
  if (!(-ends[0] < ends[2] && -ends[1] < ends[3])) return false;

  std::vector<int64_t> number(2 * NBINS + 3, 0);
  for (Particle &p : layer) {
    for (int k = 0; k < 2; k++) {
      const int b = (int) (NBINS * (p.y[k] + ends[k]) / (ends[2 + k] + ends[k]));
      number[k * NBINS + std::min(b, NBINS - 1)]++;
    }
    number[2 * NBINS]++;
    number[2 * NBINS + 1] += std::llround(unit * p.mass);
    p.parts = std::max(1, std::min((int) (std::cbrt(p.mass / least_mass) + 0.01), MOST_PARTS));
    number[2 * NBINS + 2] += (int64_t) p.parts * p.parts * p.parts;
  }
  MPI_Allreduce(MPI_IN_PLACE, number.data(), number.size(), MPI_INT64_T, MPI_SUM, world);
  count = number[2 * NBINS];
  cells = number[2 * NBINS + 2];
  mean_mass = number[2 * NBINS + 1] / unit / cells;

  vector[SHARE] = 1.0;
  for (int k = 0; k < 2; k++) {
    const double width = (ends[2 + k] + ends[k]) / NBINS;
    int first = k * NBINS, last = (k + 1) * NBINS - 1;
    for (int64_t sum = number[first]; sum < TAIL * count; sum += number[first]) first++;
    for (int64_t sum = number[last]; sum < TAIL * count; sum += number[last]) last--;
    lo[k] = (first - k * NBINS) * width - ends[k];
    hi[k] = (last + 1 - k * NBINS) * width - ends[k];

    is_away = is_away || lo[k] > hi[k] - lo[k] || hi[k] < lo[k] - hi[k];
    const double slack = ONE_SIDED * (hi[k] - lo[k]);
    const double margin = MARGIN * (hi[k] - lo[k]);
    mirrored[k] = lo[k] > -slack || hi[k] < slack;
    lo[k] -= margin;
    hi[k] += margin;
    if (mirrored[k]) {
      hi[k] = std::max(hi[k], -lo[k]);
      lo[k] = -hi[k];
      vector[SHARE] *= 0.5;
    }
  }
  return true;
}

/* ----------------------------------------------------------------------
   Each particle is spread by a cubic B-spline, which leaves no ripples of a lattice
   with about this spacing; a larger one in parts that are as fine as the finest particles, so
   that these decide how narrow a hole is seen.
------------------------------------------------------------------------- */

void ComputeHVIHole::make_map(double spacing)
{
  const bool as_wanted = map.lay_out(lo, hi, spacing);
  if (!as_wanted && comm->me == 0 && !warned_coarse) {
    error->warning(FLERR, "Compute hvi/hole: a map with spacing {} would be too large, it is {}",
                   spacing, map.h);
    warned_coarse = true;
  }

  mass.assign(map.areal.size(), 0);
  for (const Particle &p : layer)
    for (int sx = mirrored[0] ? -1 : 1; sx <= 1; sx += 2)
      for (int sy = mirrored[1] ? -1 : 1; sy <= 1; sy += 2) {
        const double share = unit * p.mass / (p.parts * p.parts), edge = 0.5 * (p.parts - 1);
        for (int c = 0; c < p.parts * p.parts; c++) {
          const int row_of_parts = c / p.parts, column = c % p.parts;
          const double u[2] = {map.node(0, sx * p.y[0] + grain * (row_of_parts - edge)),
                               map.node(1, sy * p.y[1] + grain * (column - edge))};
          if (u[0] < 1.0 || u[0] >= map.n[0] - 2 || u[1] < 1.0 || u[1] >= map.n[1] - 2) continue;
          const int i[2] = {(int) u[0], (int) u[1]};
          double w[2][4];
          for (int k = 0; k < 2; k++) {
            const double f = u[k] - i[k], g = 1.0 - f;
            w[k][0] = g * g * g / 6.0;
            w[k][1] = 2.0 / 3.0 - f * f * (1.0 - 0.5 * f);
            w[k][2] = 2.0 / 3.0 - g * g * (1.0 - 0.5 * g);
            w[k][3] = f * f * f / 6.0;
          }
          for (int a = 0; a < 4; a++) {
            int64_t *const row = &mass[map.index(i[0] + a - 1, i[1] - 1)];
            const double part = share * w[0][a];
            for (int b = 0; b < 4; b++) row[b] += std::llround(part * w[1][b]);
          }
        }
      }
  MPI_Allreduce(MPI_IN_PLACE, mass.data(), mass.size(), MPI_INT64_T, MPI_SUM, world);
  for (size_t k = 0; k < mass.size(); k++) map.areal[k] = mass[k] / (unit * map.h * map.h);

  map.find_intact();
}

/* ----------------------------------------------------------------------
   Cube root of the volume per particle in the intact plate, whose thickness t is
   that of L even layers with this spacing a: t^2 = (L a)^2 = 12 <(s - <s>)^2> + a^2.
   Sums of integers do not depend on the number of ranks.
------------------------------------------------------------------------- */

double ComputeHVIHole::find_spacing()
{
  const double scale = 1 << 30;
  int64_t mine[3] = {0, 0, 0}, sum[3];
  for (const Particle &p : layer) {
    if (farthest == 0.0 || std::hypot(p.y[0], p.y[1]) < map.far * map.h) continue;
    const double s = p.s / farthest;
    mine[0]++;
    mine[1] += std::llround(scale * s);
    mine[2] += std::llround(scale * s * s);
  }
  MPI_Allreduce(mine, sum, 3, MPI_INT64_T, MPI_SUM, world);
  double variance = 0.0;
  if (sum[0] > 0) {
    const double mean = sum[1] / scale / sum[0];
    variance = farthest * farthest * std::max(sum[2] / scale / sum[0] - mean * mean, 0.0);
  }

  const double density = map.intact / mean_mass;
  double a = 1.0 / std::sqrt(density);
  for (int i = 0; i < 50; i++) a = std::cbrt(std::sqrt(12.0 * variance + a * a) / density);
  return a;
}

/* ---------------------------------------------------------------------- */

double ComputeHVIHole::memory_usage()
{
  return (double) layer.capacity() * sizeof(Particle) + (double) mass.capacity() * sizeof(int64_t) +
      map.memory_usage();
}
