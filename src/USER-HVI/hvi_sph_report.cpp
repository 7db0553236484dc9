/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "hvi_sph_report.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_hvi_store.h"
#include "hvi_kernel.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;

// What is warned about.  Half of a kernel's reach is 1.2 to 2 spacings as a rule; a lattice in 1, 2, 3
// dimensions has 2, 12, 32 neighbors at the least of it.

static constexpr double H_LEAST = 1.0, H_MOST = 2.5;
static constexpr double NEIGHBORS_LEAST[4] = {0.0, 2.0, 10.0, 28.0};
static constexpr double RATIO_OFF = 0.2;         // of density
static constexpr double GRADIENT_OFF = 0.005;    // sum of a kernel's gradients on a row, from 1
static constexpr double SPEED_LEAST = 10.0;      // m/s, of an impact
static constexpr double BOX_MOST = 2000.0;       // cutoffs
static constexpr double FILL_MOST = 1.5;         // likewise
static constexpr double FILL_LEAST = 0.4;    // of a body's bounding box, if that tells its layers

/* ---------------------------------------------------------------------- */

HVISphReport::HVISphReport(LAMMPS *lmp, FixHVIStore *store, const std::vector<char> &is_ours) :
    Pointers(lmp), weight(nullptr), vectors(true), laws(atom->ntypes + 1), solid(false),
    kept_bytes(0), forward(0), reverse(0), border(0), store(store), is_ours(is_ours),
    rows(atom->ntypes + 1), spread(0.0)
{
}

/* ----------------------------------------------------------------------
   sums and extremes of all types over all ranks
------------------------------------------------------------------------- */

void HVISphReport::count(const HVI::SphList &list, bool newton)
{
  static constexpr double BIG = 1.0e300;
  const HVI::SphSettings &set = store->fields.settings;
  const int ntypes = atom->ntypes, nlocal = atom->nlocal;
  enum { NUMBER, MASS, DENSITY, NEIGHBORS, NEW, FAR, HELD, NSUM };
  enum { RHO_LO, RHO_HI, X_LO, X_HI = X_LO + 3, NEXTREME = X_HI + 3 };    // all as minima
  std::vector<double> sum(NSUM * (ntypes + 1), 0.0), least(NEXTREME * (ntypes + 1) + 6, BIG);
  double *const speed = &least[NEXTREME * (ntypes + 1)];

  for (int i = 0; i < nlocal; i++) {
    const int itype = atom->type[i];
    if (!is_ours[itype]) continue;
    const bool anew = unmoved.empty() ? update->ntimestep == 0 : unmoved[i];
    if (!anew && atom->rho[i] == 0.0) continue;    // frozen
    double *const s = &sum[NSUM * itype], *const e = &least[NEXTREME * itype];
    const HVI::Materials::Entry &entry = store->materials.entry(itype);
    const double rho0 = entry.material->eos->rho0();
    const bool filled = atom->rho[i] == 0.0 && entry.volume > 0.0;    // fix hvi/sph will
    const double rho = filled ? rho0 : atom->rho[i];
    s[NUMBER] += 1.0;
    s[MASS] += atom->rmass ? atom->rmass[i] : atom->mass[itype];
    s[DENSITY] += rho;
    if (atom->mask[i] & store->embedded) s[HELD] += 1.0;
    if (anew) {
      s[NEW] += 1.0;
      if (rho0 > 0.0 && std::fabs(rho / rho0 - 1.0) > RATIO_OFF) s[FAR] += 1.0;
    }
    e[RHO_LO] = MIN(e[RHO_LO], rho);
    e[RHO_HI] = MIN(e[RHO_HI], -rho);
    for (int k = 0; k < 3; k++) {
      e[X_LO + k] = MIN(e[X_LO + k], atom->x[i][k]);
      e[X_HI + k] = MIN(e[X_HI + k], -atom->x[i][k]);
      speed[k] = MIN(speed[k], atom->v[i][k]);
      speed[3 + k] = MIN(speed[3 + k], -atom->v[i][k]);
    }
  }

  // each pair of the half list counts for both particles, but not for embedded ones: lists leave out pairs of two of them

  const double *const *const x = atom->x;
  const auto is_free = [this](int i) {
    return !(atom->mask[i] & store->embedded);
  };
  for (int ii = 0; ii < list.inum; ii++) {
    const int i = list.ilist[ii], itype = atom->type[i];
    for (int jj = 0; jj < list.numneigh[i]; jj++) {
      const int j = list.firstneigh[i][jj] & NEIGHMASK, jtype = atom->type[j];
      const double reach = set.support * widest(itype, jtype);
      const double d[3] = {x[i][0] - x[j][0], x[i][1] - x[j][1], x[i][2] - x[j][2]};
      if (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] >= reach * reach) continue;
      if (is_free(i)) sum[NSUM * itype + NEIGHBORS] += 1.0;
      if ((newton || j < nlocal) && is_free(j)) sum[NSUM * jtype + NEIGHBORS] += 1.0;
    }
  }

  MPI_Allreduce(MPI_IN_PLACE, sum.data(), sum.size(), MPI_DOUBLE, MPI_SUM, world);
  MPI_Allreduce(MPI_IN_PLACE, least.data(), least.size(), MPI_DOUBLE, MPI_MIN, world);

  double square = 0.0;
  for (int k = 0; k < 3; k++)
    if (speed[k] < BIG) square += (speed[k] + speed[3 + k]) * (speed[k] + speed[3 + k]);
  spread = std::sqrt(square);

  const int dim = set.laws.dim;
  for (int itype = 1; itype <= ntypes; itype++) {
    const double *const s = &sum[NSUM * itype], *const e = &least[NEXTREME * itype];
    if (!is_ours[itype] || s[NUMBER] == 0.0) continue;
    Row &row = rows[itype];
    const double n = s[NUMBER], rho0 = store->materials.of(itype)->eos->rho0();
    const double rho = rho0 > 0.0 ? rho0 : s[DENSITY] / n;
    row.number = n;
    row.mass = s[MASS] / n;
    row.spacing = std::pow(row.mass / rho, 1.0 / dim);
    row.held = s[HELD];
    if (row.held < n) row.neighbors = s[NEIGHBORS] / (n - row.held);
    row.fresh = s[NEW];
    row.far = s[FAR];
    if (rho0 > 0.0) {
      row.ratio = s[DENSITY] / n / rho0;
      row.least = e[RHO_LO] / rho0;
      row.most = -e[RHO_HI] / rho0;
    }

    // The bounding box of a plate tells its layers, that of a tilted one or of a cloud does not

    double volume = 1.0, thinnest = BIG;
    for (int k = 0; k < 3; k++) {
      if (!store->fields.along[k]) continue;
      const double length = -e[X_HI + k] - e[X_LO + k] + row.spacing;
      volume *= length;
      thinnest = MIN(thinnest, length);
    }
    row.filled = n * row.mass / rho / volume;
    if (row.filled > FILL_LEAST) row.layers = static_cast<int>(std::lround(thinnest / row.spacing));
  }
}

/* ---------------------------------------------------------------------- */

std::string HVISphReport::terms() const
{
  const HVI::SphSettings &set = store->fields.settings;
  std::string text = set.riemann ? "Riemann problems" : "viscosity";
  if (set.density) text += ", interface density dissipation";
  if (set.variable) text += ", variable h";
  if (!set.energy) text += ", no energy equation";
  if (solid) text += ", stress, corrected forces";
  if (set.laws.art_eps > 0.0) text += ", artificial stress";
  if (set.mirror.planes) text += ", mirror planes";
  return text;
}

/* ----------------------------------------------------------------------
   Whether the log has this table: the same settings, and no particles that were not there.
   Motion, losses and lists are nothing new.  Outlives clear, after which a run goes on from
   the restart file that it has written: then no particle is new.
------------------------------------------------------------------------- */

struct HVISphReport::Told {
  double clock = 0.0;    // which LAMMPS, if a process has several
  std::string settings;
  std::vector<Row> rows;
};

bool HVISphReport::is_told(const std::string &settings)
{
  static constexpr double SAME = 1.0e-6;    // of mean masses, which are sums in any order
  static constexpr double NEAR = 0.1;       // of those of fewer particles
  static Told told;
  bool same =
      told.clock == lmp->initclock && told.settings == settings && told.rows.size() == rows.size();
  for (int i = 1; same && i <= atom->ntypes; i++) {
    const Row &row = rows[i], &last = told.rows[i];
    const double most = row.number == last.number ? SAME : NEAR;
    const bool heavier = row.number > 0.0 && std::fabs(row.mass - last.mass) > most * last.mass;
    same = (store->is_reported || row.fresh == 0.0) && row.number <= last.number &&
        row.fresh <= last.fresh && !heavier;
  }
  told = {lmp->initclock, settings, rows};
  store->is_reported = true;
  return same;
}

/* ---------------------------------------------------------------------- */

void HVISphReport::write()
{
  if (comm->me != 0) return;
  const HVI::SphSettings &set = store->fields.settings;
  std::string text = fmt::format("Pair style hvi/sph {}\n", set.text), settings = text;
  text += fmt::format("  {:>4} {:>10} {:>11} {:>9} {:>9} {:>21} {:>6}  {}\n", "type", "particles",
                      "spacing", "h/spacing", "neighbors", "rho/rho0 (least,most)", "layers",
                      "material: laws");
  for (int itype = 1; itype <= atom->ntypes; itype++) {
    if (!is_ours[itype]) continue;
    const Row &row = rows[itype];
    const HVI::Material &material = *store->materials.of(itype);
    const std::string density = row.ratio > 0.0
        ? fmt::format("{:.4f} ({:.3f},{:.3f})", row.ratio, row.least, row.most)
        : "-";
    const std::string what = fmt::format("{}: {}{}\n", material.name, material.eos->name(),
                                         laws[itype].empty() ? "" : ", " + laws[itype]);
    text +=
        fmt::format("  {:>4} {:>10.0f} {:>11.5g} {:>9.4g} {:>9.4g} {:>21} {:>6}  {}", itype,
                    row.number, row.spacing, row.spacing > 0.0 ? set.h[itype] / row.spacing : 0.0,
                    row.neighbors, density, row.layers ? std::to_string(row.layers) : "-", what);
    settings += fmt::format("{} {} {}", itype, set.h[itype], what);
  }
  std::string more = fmt::format("  terms: {}\n", terms());
  for (int i = 1; weight && i <= atom->ntypes; i++)
    for (int j = i + 1; j <= atom->ntypes; j++)
      if (is_ours[i] && is_ours[j] && weight[i][j] != 1.0)
        more += fmt::format(
            "  weights of spacings: type {} counts {:.4g} times in densities of type {}\n", j,
            weight[i][j], i);
  more += fmt::format("  arrays, bytes: {}\n", store->fields.arrays());
  more += fmt::format("  memory: {:.0f} bytes per owned and ghost particle, {} more per owned "
                      "particle in fixes\n",
                      store->fields.bytes_per_particle(), kept_bytes);
  more += fmt::format("  communication beyond atom_style sph, doubles per ghost: {} forward and {} "
                      "reverse in each step, {} when new\n",
                      forward, reverse, border);
  if (!vectors)
    more += fmt::format("  reference loop, pair by pair: takes about {} times as long as loops in "
                        "vectors (pair_style hvi/sph, Loops)\n",
                        solid ? 2 : (set.riemann ? 7 : 3));
  if (!is_told(settings + more)) utils::logmesg(lmp, text + more);
}

/* ----------------------------------------------------------------------
   -sum over a row of x dW/dx s, particles a spacing s apart: 1, if gradients of linear fields are
   to be exact (doc/src/Howto_sph.rst, Advice)
------------------------------------------------------------------------- */

static double gradient_sum(const std::string &kernel, double h_over_s)
{
  const HVI::KernelFunctions &k = *HVI::find_kernel(kernel);
  double sum = 0.0;
  for (int n = 1; n < k.support * h_over_s; n++) {
    const double q = n / h_over_s;
    sum -= 2.0 * k.norm[0] * q * k.dw(q) / h_over_s;
  }
  return sum;
}

/* ---------------------------------------------------------------------- */

void HVISphReport::warn() const
{
  if (comm->me != 0) return;
  const HVI::SphSettings &set = store->fields.settings;
  double cutoff = 0.0;
  for (int itype = 1; itype <= atom->ntypes; itype++) {
    const Row &row = rows[itype];
    if (row.number == 0.0) continue;
    const double half_reach = 0.5 * set.support * set.h[itype] / row.spacing;
    cutoff = MAX(cutoff, set.support * set.h[itype]);
    if (half_reach < H_LEAST || half_reach > H_MOST)
      error->warning(FLERR,
                     "Pair style hvi/sph: the kernel of type {} reaches {:.3g} spacings "
                     "(m/rho0)^(1/dim), where {:.3g} to {:.3g} are usual: check h, masses and dim",
                     itype, 2.0 * half_reach, 2.0 * H_LEAST, 2.0 * H_MOST);
    else if (row.neighbors < NEIGHBORS_LEAST[set.laws.dim] && row.fresh > 1.0 &&
             row.fresh == row.number && row.held < row.number && !set.mirror.planes)
      error->warning(FLERR,
                     "Pair style hvi/sph: particles of type {} have {:.3g} neighbors in the mean, "
                     "the kernel needs {:.3g} or more: check positions, spacing and h",
                     itype, row.neighbors, NEIGHBORS_LEAST[set.laws.dim]);
    if (row.filled > FILL_MOST && row.far == 0.0 && row.fresh == row.number)
      error->warning(
          FLERR,
          "Pair style hvi/sph: particles of type {} have {:.3g} times the volume m/rho0 of "
          "the box around them: check the mass or the spacing of the type, and positions",
          itype, row.filled);
    const double sum = set.laws.dim == 1 ? gradient_sum(set.kernel, set.h[itype] / row.spacing)
                                         : 1.0;
    const bool exact = set.riemann || solid;
    if (!exact && std::fabs(sum - 1.0) > GRADIENT_OFF)
      error->warning(
          FLERR,
          "Pair style hvi/sph: gradients by the kernel of type {} are {:.4f} times the right "
          "ones on its row, and with viscosity no spacing mends that: use gauss with h of "
          "1.2 spacings, or dissipation riemann",
          itype, sum);
    if (row.far > 0.0)
      error->warning(FLERR,
                     "Pair style hvi/sph: {:.0f} particles of type {} start with a density more "
                     "than {:.0f} % off that of the material at rest",
                     row.far, itype, 100.0 * RATIO_OFF);
  }

  // meters per second of a unit of speed

  const std::string units = update->unit_style;
  const bool meters = units == "si" || units == "micro" || units == "nano";
  const double speed = meters ? 1.0 : (units == "cgs" ? 0.01 : 0.0);
  if (speed > 0.0 && spread > 0.0 && spread * speed < SPEED_LEAST &&
      !modify->get_fix_by_style("^hvi/dt$").empty())
    error->warning(FLERR,
                   "Pair style hvi/sph: the largest difference of velocities is {:.3g} m/s, little "
                   "for an impact: the command velocity takes lattice units without units box",
                   spread * speed);
  for (int k = 0; k < domain->dimension; k++)
    if (cutoff > 0.0 && domain->prd[k] > BOX_MOST * cutoff)
      error->warning(FLERR,
                     "Pair style hvi/sph: the box is {:.6g} cutoffs long along {}: the bins of the "
                     "neighbor list will take time and memory",
                     domain->prd[k] / cutoff, "xyz"[k]);
}
