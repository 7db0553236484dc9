/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "compute_hvi_wall.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_hvi_debris.h"
#include "fix_hvi_johnson_cook.h"
#include "fix_hvi_store.h"
#include "fix_store_atom.h"
#include "force.h"
#include "group.h"
#include "hvi_mesh.h"
#include "hvi_stress.h"
#include "memory.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>

using namespace LAMMPS_NS;

static constexpr double BIG = 1.0e20;
static constexpr double WHOLE =
    0.99;    // of a plate that is no smaller than its share of the model

/* ---------------------------------------------------------------------- */

ComputeHVIWall::ComputeHVIWall(LAMMPS *lmp, int narg, char **arg) :
    ComputeHVIMatter(lmp, narg, arg), axis(-1), reach(0.0), id_fix(nullptr), owns_fix(true),
    first(nullptr), store(nullptr), strength(nullptr), debris(nullptr)
{
  if (domain->dimension != 3)
    error->all(FLERR, "Compute hvi/wall needs a three-dimensional simulation");
  array_flag = 1;
  size_array_cols = NCOLUMNS;
  extarray = 0;

  int iarg = 3;
  bool is_scaled = false;    // reach is in smoothing lengths
  if (narg < 5) utils::missing_cmd_args(FLERR, "compute hvi/wall", error);
  const bool is_like = strcmp(arg[iarg], "like") == 0;
  if (is_like) {
    auto *const other = dynamic_cast<ComputeHVIWall *>(modify->get_compute_by_id(arg[iarg + 1]));
    if (!other)
      error->all(FLERR, "Compute hvi/wall like: there is no compute hvi/wall with the ID {}",
                 arg[iarg + 1]);
    axis = other->axis;
    id_fix = utils::strdup(other->id_fix);
    owns_fix = false;
    for (const Place &place : other->walls) {
      walls.emplace_back();
      static_cast<Place &>(walls.back()) = place;
    }
  } else {
    if (strcmp(arg[iarg], "axis") != 0)
      error->all(FLERR, "Compute hvi/wall begins with axis x, y or z, or with like ID, not {}",
                 arg[iarg]);
    axis = axis_of(arg[iarg + 1]);
  }
  create_attribute = owns_fix;
  across[0] = (axis == 0) ? 1 : 0;
  across[1] = (axis == 2) ? 1 : 2;
  iarg += 2;
  while (iarg < narg) {
    if (strcmp(arg[iarg], "pieces") == 0) {
      if (iarg + 2 > narg) utils::missing_cmd_args(FLERR, "compute hvi/wall pieces", error);
      if (strcmp(arg[iarg + 1], "no") == 0)
        reach = 0.0;
      else {
        reach = utils::numeric(FLERR, arg[iarg + 1], false, lmp);
        if (!(reach > 0.0) || !std::isfinite(reach))
          error->all(FLERR, "Compute hvi/wall pieces must be no or a distance > 0, not {}",
                     arg[iarg + 1]);
      }
      iarg += 2;
      is_scaled = reach > 0.0 && iarg < narg && strcmp(arg[iarg], "h") == 0;
      if (is_scaled) iarg++;
    } else if (is_like)
      error->all(FLERR, "Compute hvi/wall like takes pieces and no other keyword, not {}",
                 arg[iarg]);
    else
      read_wall(iarg, narg, arg);
  }
  if (walls.empty()) utils::missing_cmd_args(FLERR, "compute hvi/wall wall", error);
  for (Wall &w : walls)
    for (int k = 0; k < 2; k++)
      if (std::isnan(w.struck[k])) w.struck[k] = w.center[k];
  for (size_t k = 1; k < walls.size(); k++) {
    if (walls[k].front < walls[k - 1].rear)
      error->all(FLERR,
                 "Compute hvi/wall: wall {} begins at {}, before the rear of wall {} at {}: give "
                 "walls in the order along the axis",
                 k + 1, walls[k].front, k, walls[k - 1].rear);
    for (size_t j = 0; j < k; j++)
      for (int t = 1; t <= atom->ntypes; t++)
        if ((walls[k].owns(t) && walls[j].owns(t)) ||
            (walls[k].has_node(t) && walls[j].has_node(t)))
          error->all(FLERR, "Compute hvi/wall: walls {} and {} share a type of particles or nodes",
                     j + 1, k + 1);
  }
  size_array_rows = walls.size();
  memory->create(array, size_array_rows, NCOLUMNS, "hvi/wall:array");

  if (reach > 0.0) {
    auto make = [this](const char *what, const std::vector<std::string> &more, auto *none,
                       auto... how) {
      using Style = std::remove_pointer_t<decltype(none)>;
      std::vector<std::string> words = command_of(what, more);
      std::vector<char *> args;
      for (std::string &word : words) args.push_back(word.data());
      return std::make_unique<Style>(this->lmp, (int) args.size(), args.data(), how...);
    };
    const std::string name(1, 'x' + axis);
    auto text = [](double value) {
      return fmt::format("{:.17g}", value);
    };
    std::vector<std::string> near = {"distance", text(reach)};
    if (is_scaled) near.emplace_back("h");
    near.insert(near.end(), {"damage", "yes"});
    fragment = make("hvi/fragment", near, (ComputeHVIFragment *) nullptr);
    comm_forward = fragment->comm_forward;    // LAMMPS makes buffers for the computes that it knows
    for (Wall &w : walls) {
      const std::string middle = text(0.5 * (w.front + w.rear));
      const std::vector<std::string> where = {
          "axis", name, "center", text(w.struck[0]), text(w.struck[1]), "plane", middle};
      std::vector<std::string> all = where;
      all.insert(all.end(), {"thickness", text(BIG)});
      w.cloud =
          make("hvi/cloud", {"axis", name, "plane", text(w.rear)}, (ComputeHVICloud *) nullptr);
      w.hole = make("hvi/hole", all, (ComputeHVIHole *) nullptr, false);
      w.plane = make("hvi/hole", where, (ComputeHVIHole *) nullptr, false);
    }
  }

  // where particles were: kept as by compute displace/atom, in restart files, too

  if (!owns_fix) return;
  id_fix = utils::strdup(std::string(id) + "_COMPUTE_STORE");
  first = dynamic_cast<FixStoreAtom *>(
      modify->add_fix(fmt::format("{} all STORE/ATOM 3 0 0 1", id_fix)));
  if (first->restart_reset)
    first->restart_reset = 0;
  else
    for (int i = 0; i < atom->nlocal; i++) ComputeHVIWall::set_arrays(i);
}

/* ---------------------------------------------------------------------- */

ComputeHVIWall::~ComputeHVIWall()
{
  if (owns_fix && id_fix && modify->nfix) modify->delete_fix(id_fix);
  delete[] id_fix;
  memory->destroy(array);
}

/* ----------------------------------------------------------------------
   the command of a compute of its own
------------------------------------------------------------------------- */

std::vector<std::string> ComputeHVIWall::command_of(const char *what,
                                                    const std::vector<std::string> &more) const
{
  std::vector<std::string> words = {std::string(id) + "_" + what, group->names[igroup], what};
  std::replace(words[0].begin(), words[0].end(), '/', '_');
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/* ----------------------------------------------------------------------
   wall TYPES front thickness, or what belongs to the wall before it
------------------------------------------------------------------------- */

void ComputeHVIWall::read_wall(int &iarg, int narg, char **arg)
{
  const std::string key = arg[iarg];
  auto need = [&](int n) {
    if (iarg + 1 + n > narg) utils::missing_cmd_args(FLERR, "compute hvi/wall " + key, error);
  };
  auto number = [&](int n) {
    const double value = utils::numeric(FLERR, arg[iarg + n], false, lmp);
    if (!std::isfinite(value))
      error->all(FLERR, "Compute hvi/wall {} must be a number, not {}", key, arg[iarg + n]);
    return value;
  };
  auto positive = [&](int n) {
    const double value = number(n);
    if (!(value > 0.0))
      error->all(FLERR, "Compute hvi/wall {} must be > 0, not {}", key, arg[iarg + n]);
    return value;
  };

  if (key == "wall") {
    need(3);
    Wall w;
    utils::bounds(FLERR, arg[iarg + 1], 1, atom->ntypes, w.lo, w.hi, error);
    w.front = number(2);
    w.rear = w.front + positive(3);
    w.node_lo = w.node_hi = w.outer_lo = w.outer_hi = 0;
    w.layers = 1.0;
    w.radius = BIG;
    w.center[0] = w.center[1] = 0.0;
    w.struck[0] = w.struck[1] = NAN;
    walls.push_back(std::move(w));
    iarg += 4;
    return;
  }
  if (key != "outer" && key != "nodes" && key != "layers" && key != "radius" && key != "center" &&
      key != "struck")
    error->all(FLERR, "Unknown compute hvi/wall keyword: {}", key);
  if (walls.empty())
    error->all(FLERR, "Compute hvi/wall {} belongs to a wall, and comes after it", key);
  Wall &w = walls.back();
  const bool two = key == "center" || key == "struck";
  need(two ? 2 : 1);
  if (key == "outer")
    utils::bounds(FLERR, arg[iarg + 1], 1, atom->ntypes, w.outer_lo, w.outer_hi, error);
  else if (key == "nodes")
    utils::bounds(FLERR, arg[iarg + 1], 1, atom->ntypes, w.node_lo, w.node_hi, error);
  else if (key == "layers")
    w.layers = utils::inumeric(FLERR, arg[iarg + 1], false, lmp);
  else if (key == "radius")
    w.radius = positive(1);
  else
    for (int k = 0; k < 2; k++) (key == "center" ? w.center : w.struck)[k] = number(1 + k);
  if (!(w.layers >= 1.0))
    error->all(FLERR, "Compute hvi/wall layers must be 1 or more, not {}", arg[iarg + 1]);
  iarg += two ? 3 : 2;
}

/* ---------------------------------------------------------------------- */

void ComputeHVIWall::set_arrays(int i)
{
  domain->unmap(atom->x[i], atom->image[i], first->astore[i]);
}

/* ---------------------------------------------------------------------- */

// anew each time: the compute that has made the fix may be gone, or given again

void ComputeHVIWall::find_first()
{
  first = dynamic_cast<FixStoreAtom *>(modify->get_fix_by_id(id_fix));
  if (first) return;
  if (owns_fix) error->all(FLERR, "Compute hvi/wall: the fix {} that it made is gone", id_fix);
  error->all(FLERR, "Compute hvi/wall like: the compute with fix {} is gone: uncompute {}, too",
             id_fix, id);
}

/* ---------------------------------------------------------------------- */

void ComputeHVIWall::init()
{
  find_first();
  store = force->pair_match("^hvi/sph$", 0) ? FixHVIStore::find(lmp) : nullptr;
  if (!store) error->all(FLERR, "Compute hvi/wall needs pair style hvi/sph");

  std::vector<bigint> mine(atom->ntypes + 1, 0), number(atom->ntypes + 1, 0);
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & groupbit) mine[atom->type[i]]++;
  MPI_Allreduce(mine.data(), number.data(), mine.size(), MPI_LMP_BIGINT, MPI_SUM, world);
  for (size_t k = 0; k < walls.size(); k++)
    for (int t = 1; t <= atom->ntypes; t++)
      if (walls[k].owns(t) && number[t] == 0)
        error->all(FLERR, "Compute hvi/wall: group {} has no particles of type {}, wall {}",
                   group->names[igroup], t, k + 1);

  check_walls();
  if (!fragment) return;
  fragment->choose(nullptr, FixHVIJohnsonCook::find(lmp) ? 1 : 0);
  fragment->init();
  for (Wall &w : walls) {
    w.start.clear();    // commands between runs may have changed it
    w.hole->init();
    w.plane->init();
  }
}

/* ----------------------------------------------------------------------
   by the places that particles had first: a wall in other units is none.  What stood where its hole is
   looked for is the wall, however far it has gone since.
------------------------------------------------------------------------- */

void ComputeHVIWall::check_walls() const
{
  const HVI::Mesh *const mesh = HVI::find_mesh(lmp);
  enum { LOWEST, HIGHEST = LOWEST + 2, NENDS = HIGHEST + 2 };    // across the axis; less the lowest
  std::vector<std::array<double, NENDS>> ends(walls.size(), {-BIG, -BIG, -BIG, -BIG});
  for (int i = 0; i < atom->nlocal; i++)
    for (size_t k = 0; k < walls.size(); k++) {
      const double *const x0 = first->astore[i];
      const double s = x0[axis], thickness = walls[k].rear - walls[k].front;
      if (!walls[k].owns(atom->type[i]) || !(s > walls[k].front - thickness) ||
          !(s < walls[k].rear + thickness))
        continue;
      for (int d = 0; d < 2; d++) {
        ends[k][LOWEST + d] = MAX(ends[k][LOWEST + d], -x0[across[d]]);
        ends[k][HIGHEST + d] = MAX(ends[k][HIGHEST + d], x0[across[d]]);
      }
    }
  MPI_Allreduce(MPI_IN_PLACE, ends.data(), NENDS * ends.size(), MPI_DOUBLE, MPI_MAX, world);
  for (size_t k = 0; k < walls.size(); k++) {
    if (ends[k][LOWEST] == -BIG)
      error->all(
          FLERR,
          "Compute hvi/wall: no particle of wall {} was near its faces at {} and {} along {}: "
          "are they in other units?",
          k + 1, walls[k].front, walls[k].rear, "xyz"[axis]);
    bool is_aside = false;
    for (int d = 0; d < 2; d++) {
      const double lo = -ends[k][LOWEST + d], hi = ends[k][HIGHEST + d];
      const double struck = walls[k].struck[d];
      is_aside = is_aside || struck < 2.0 * lo - hi || struck > 2.0 * hi - lo;
    }
    if (fragment && !is_aside) {
      walls[k].hole->say_placed();
      walls[k].plane->say_placed();
    }
    for (int t = walls[k].node_lo; t <= walls[k].node_hi; t++)
      if (t > 0 && !(mesh && mesh->is_node(t)))
        error->all(
            FLERR,
            "Compute hvi/wall nodes: type {} of wall {} is no type of nodes of a fix hvi/fem", t,
            k + 1);
  }
}

/* ---------------------------------------------------------------------- */

void ComputeHVIWall::init_list(int which, NeighList *list)
{
  if (fragment) fragment->init_list(which, list);
}

/* ---------------------------------------------------------------------- */

double ComputeHVIWall::mass_of(int i) const
{
  return atom->rmass ? atom->rmass[i] : atom->mass[atom->type[i]];
}

// particles in elements: their mass and velocity are those of nodes, too

bool ComputeHVIWall::is_embedded(int i) const
{
  return atom->mask[i] & store->embedded;
}

// straight back to the plane of the rear face: beyond the radius of the wall there

bool ComputeHVIWall::is_missed(const Wall &w, int i) const
{
  const double *const x = atom->x[i];
  const double *const v = atom->v[i];
  if (!(x[axis] > w.rear) || !(v[axis] > 0.0)) return false;
  const double t = (x[axis] - w.rear) / v[axis];
  double rsq = 0.0;
  for (int k = 0; k < 2; k++) {
    const double d = x[across[k]] - t * v[across[k]] - w.center[k];
    rsq += d * d;
  }
  return rsq > w.radius * w.radius;
}

/* ---------------------------------------------------------------------- */

void ComputeHVIWall::compute_array()
{
  invoked_array = update->ntimestep;
  store = force->pair_match("^hvi/sph$", 0) ? FixHVIStore::find(lmp) : nullptr;
  if (!store) error->all(FLERR, "Compute hvi/wall needs pair style hvi/sph");
  find_first();
  strength = FixHVIJohnsonCook::find(lmp);
  debris = FixHVIDebris::find(lmp);

  for (size_t k = 0; k < walls.size(); k++) std::fill(array[k], array[k] + NCOLUMNS, 0.0);
  sum_up();
  if (fragment) find_pieces();
}

/* ----------------------------------------------------------------------
   sums and maxima of all walls, in one reduction each
------------------------------------------------------------------------- */

void ComputeHVIWall::sum_up()
{
  const int nwalls = walls.size();
  const int nlocal = atom->nlocal;
  const HVI::Mesh *const mesh = HVI::find_mesh(lmp);
  const double half = 0.5 * force->mvv2e;
  std::vector<double> sum(nwalls * NCOLUMNS, 0.0), most(nwalls * NCOLUMNS, 0.0);
  wall_of.assign(atom->ntypes + 1, -1);
  moved.assign(nwalls, 0);
  std::vector<int> has_nodes(nwalls, 0), lacks_nodes(nwalls, 0);
  for (int k = 0; k < nwalls; k++) {
    for (int t = 1; t <= atom->ntypes; t++)
      if (walls[k].owns(t)) wall_of[t] = k;
    most[k * NCOLUMNS + TIP] = -BIG;
  }

  for (int i = 0; i < nlocal; i++) {
    const int itype = atom->type[i];
    if (!(atom->mask[i] & groupbit)) {
      for (int k = 0; mesh && k < nwalls; k++)
        if (walls[k].has_node(itype)) lacks_nodes[k] = 1;
      continue;
    }
    const double *const x = atom->x[i];
    const double *const v = atom->v[i];
    const double m = mass_of(i);
    const double energy = half * m * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    if (mesh && mesh->is_node(itype)) {
      for (int k = 0; k < nwalls; k++)
        if (walls[k].has_node(itype)) {
          has_nodes[k] = 1;
          if (energy > 0.0) moved[k] = 1;
          sum[k * NCOLUMNS + PUSH] += atom->f[i][axis];
          sum[k * NCOLUMNS + MOMENTUM] += m * v[axis];
          sum[k * NCOLUMNS + ENERGY] += energy + mesh->energy_without_particles(i);
          sum[k * NCOLUMNS + MASS] += m;
        }
      continue;
    }

    const int home = wall_of[itype];
    for (int k = 0; k < nwalls; k++) {
      const Wall &w = walls[k];
      double *const s = &sum[k * NCOLUMNS];
      double *const top = &most[k * NCOLUMNS];
      if (home > k) continue;    // what is behind has not passed
      top[TIP] = MAX(top[TIP], x[axis]);
      if (home != k) {
        if (!(v[axis] > 0.0)) continue;
        if (x[axis] < w.front) {
          s[COMING_MASS] += m;
          s[COMING_ENERGY] += energy;
        } else if (x[axis] > w.rear) {
          s[PASSED_MASS] += m;
          s[PASSED_MOMENTUM] += m * v[axis];
          s[PASSED_ENERGY] += energy;
          if (home < 0 && is_missed(w, i)) {
            const double t = (x[axis] - w.rear) / v[axis];
            s[MISSED_MASS] += m;
            top[MISSED_REACH] = MAX(top[MISSED_REACH],
                                    std::hypot(x[across[0]] - t * v[across[0]] - w.center[0],
                                               x[across[1]] - t * v[across[1]] - w.center[1]));
          }
        }
        continue;
      }

      const double *const x0 = first->astore[i];
      double rho = atom->rho[i], esph = atom->esph[i];
      if (mesh) mesh->is_shown(i, rho, esph);
      if (energy > 0.0 || esph != 0.0) moved[k] = 1;
      s[ENERGY] += esph;
      if (!is_embedded(i)) {
        s[PUSH] += atom->f[i][axis];
        s[MOMENTUM] += m * v[axis];
        s[ENERGY] += energy;
        s[MASS] += m;
        top[FAR_FREE] = MAX(top[FAR_FREE],
                            std::hypot(x0[across[0]] - w.center[0], x0[across[1]] - w.center[1]));
      } else
        s[HELD_MASS] += m;
      if (!strength) continue;
      const FixHVIJohnsonCook::Solid &state = strength->state(i);
      if (state.rate > 0.0 && rho > 0.0)
        s[PLASTIC_POWER] += m / rho * HVI::von_mises(state.S) * state.rate;
      const double depth = x0[axis] - w.front;
      // layers of the outer part are twice as thick: their middle is between two of the others

      const bool is_outer = w.is_outer(itype);
      const double layer = (w.rear - w.front) / w.layers;
      if (strength->failed(i))
        top[FAILED_DEPTH] = MAX(top[FAILED_DEPTH], depth + (is_outer ? 0.5 * layer : 0.0));
      if (depth > w.rear - w.front - (is_outer ? 1.5 : 1.0) * layer) {
        top[REAR_STRAIN] = MAX(top[REAR_STRAIN], state.eps);
        if (is_outer) top[OUTER_STRAIN] = MAX(top[OUTER_STRAIN], state.eps);
      }
    }
  }

  MPI_Allreduce(MPI_IN_PLACE, sum.data(), sum.size(), MPI_DOUBLE, MPI_SUM, world);
  MPI_Allreduce(MPI_IN_PLACE, most.data(), most.size(), MPI_DOUBLE, MPI_MAX, world);
  MPI_Allreduce(MPI_IN_PLACE, moved.data(), nwalls, MPI_INT, MPI_MAX, world);
  if (mesh) {
    MPI_Allreduce(MPI_IN_PLACE, has_nodes.data(), nwalls, MPI_INT, MPI_MAX, world);
    MPI_Allreduce(MPI_IN_PLACE, lacks_nodes.data(), nwalls, MPI_INT, MPI_MAX, world);
  }
  for (int k = 0; k < nwalls; k++)
    if (sum[k * NCOLUMNS + HELD_MASS] > 0.0 && (!has_nodes[k] || lacks_nodes[k]))
      error->all(FLERR,
                 "Compute hvi/wall: wall {} has elements, and group {} not all of its nodes, which "
                 "have their mass and momentum: give the wall its nodes, and a group with them",
                 k + 1, group->names[igroup]);
  for (int k = 0; k < nwalls; k++) {
    array[k][OUTER_STRAIN] = most[k * NCOLUMNS + OUTER_STRAIN];
    for (int c = 0; c < CLOUD_MASS; c++)
      array[k][c] =
          (c == TIP || c == FAILED_DEPTH || c == REAR_STRAIN || c == MISSED_REACH || c == FAR_FREE)
          ? most[k * NCOLUMNS + c]
          : sum[k * NCOLUMNS + c];
  }
}

/* ----------------------------------------------------------------------
   What hangs together in all matter: by sound material, and at all.  A wall that nothing has
   reached since it was looked at first is what it was then.
------------------------------------------------------------------------- */

void ComputeHVIWall::find_pieces()
{
  const int nlocal = atom->nlocal;
  std::vector<char> counts(atom->ntypes + 1, 1);
  for (size_t k = 0; k < walls.size(); k++) {
    Wall &w = walls[k];
    w.untouched = !w.start.empty() && !moved[k] && array[k][PASSED_MASS] == 0.0;
    for (int t = 1; t <= atom->ntypes; t++)
      if (w.owns(t)) counts[t] = !w.untouched;
  }
  chosen.assign(nlocal, 0);
  for (int i = 0; i < nlocal; i++) chosen[i] = (atom->mask[i] & groupbit) && counts[atom->type[i]];
  fragment->choose(&chosen, strength ? 1 : 0);
  fragment->find_chosen(sound);
  fragment->choose(&chosen, 0);
  fragment->find_chosen(together);
  for (size_t k = 0; k < walls.size(); k++)
    if (walls[k].untouched)
      std::copy(walls[k].start.begin(), walls[k].start.end(),
                array[k] + CLOUD_MASS);    // and all after it
    else {
      measure(k, array[k]);
      if (!moved[k] && array[k][PASSED_MASS] == 0.0)
        walls[k].start.assign(array[k] + CLOUD_MASS, array[k] + NCOLUMNS);
    }
}

/* ----------------------------------------------------------------------
   the piece that has the particle with this ID; 0: there is none
------------------------------------------------------------------------- */

int64_t ComputeHVIWall::piece_of(const std::vector<int64_t> &piece, int64_t tag) const
{
  int64_t mine = 0, found;
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->tag[i] == tag) mine = piece[i];
  MPI_Allreduce(&mine, &found, 1, MPI_INT64_T, MPI_MAX, world);
  return found;
}

/* ----------------------------------------------------------------------
   Of the wall's own matter that hangs together.  What lies in the crater of a wall that has bulged by more than its
   thickness is beyond the plane where its rear was, but has not come through.
------------------------------------------------------------------------- */

void ComputeHVIWall::find_rear_face(const Wall &w, int64_t hull)
{
  static constexpr double WIDE =
      0.75;    // half of a square of its own, in spacings: a layer that is stretched has no gaps
  double box[5] = {BIG, BIG, BIG, BIG,
                   BIG};    // least, and less the most, to both sides; least spacing
  const auto is_of_it = [&](int i) {
    return hull && together[i] == hull && w.owns(atom->type[i]);
  };
  const auto spacing = [&](int i) {
    const HVI::Material *const material = store->materials.of(atom->type[i]);
    const double rho0 = material ? material->eos->rho0() : 0.0;
    const double rho = rho0 > 0.0 ? rho0 : atom->rho[i];
    return rho > 0.0 ? std::cbrt(mass_of(i) / rho) : 0.0;
  };
  for (int i = 0; i < atom->nlocal; i++) {
    if (!is_of_it(i)) continue;
    for (int k = 0; k < 2; k++) {
      box[k] = MIN(box[k], atom->x[i][across[k]]);
      box[2 + k] = MIN(box[2 + k], -atom->x[i][across[k]]);
    }
    box[4] = MIN(box[4], spacing(i));
  }
  MPI_Allreduce(MPI_IN_PLACE, box, 5, MPI_DOUBLE, MPI_MIN, world);
  const double hi[2] = {-box[2], -box[3]};
  const HVI::MirrorPlanes &mirror = store->fields.settings.mirror;
  double anchor[2];
  for (int k = 0; k < 2; k++)
    anchor[k] = mirror.has(across[k]) ? mirror.at[across[k]] : w.center[k];
  rear_face.start(box, hi, box[4], anchor);
  for (int i = 0; i < atom->nlocal; i++)
    if (is_of_it(i))
      rear_face.add(atom->x[i][across[0]], atom->x[i][across[1]], atom->x[i][axis],
                    WIDE * spacing(i));
  std::vector<double> &columns = rear_face.columns();
  if (!columns.empty())
    MPI_Allreduce(MPI_IN_PLACE, columns.data(), columns.size(), MPI_DOUBLE, MPI_MAX, world);
}

/* ---------------------------------------------------------------------- */

void ComputeHVIWall::measure(int number, double *row)
{
  Wall &w = walls[number];
  const int nlocal = atom->nlocal;
  const int *const type = atom->type;
  const HVI::Mesh *const mesh = HVI::find_mesh(lmp);
  auto is_matter = [&](int i) {
    return (atom->mask[i] & groupbit) && !(mesh && mesh->is_node(type[i]));
  };

  // the body: what hangs together with the largest piece of the wall's own matter

  chosen.assign(nlocal, 0);
  for (int i = 0; i < nlocal; i++) chosen[i] = is_matter(i) && w.owns(type[i]);
  fragment->choose(&chosen, strength ? 1 : 0);
  const int64_t kernel = fragment->find_heaviest().id;
  const int64_t body = piece_of(sound, kernel);
  const int64_t hull = piece_of(together, kernel);

  find_rear_face(w, hull);

  // what has passed it, and what of that is apart

  enum { APART, SPALL, NUMBER, BODY, NSUM };
  double mine[NSUM] = {0.0}, sum[NSUM], height = -BIG;
  const double layer = 0.5 * (w.rear - w.front) / w.layers;
  chosen.assign(nlocal, 0);
  for (int i = 0; i < nlocal; i++) {
    if (!is_matter(i) || wall_of[type[i]] > number) continue;
    const double *const x = atom->x[i], s = x[axis];
    const bool mine_here = w.owns(type[i]);
    if (sound[i] == body && body) {
      if (mine_here) height = MAX(height, s + layer - w.rear);
    }
    if (mine_here && together[i] == hull && hull) mine[BODY] += mass_of(i);
    if (!(s > w.rear) || !(atom->v[i][axis] > 0.0) || sound[i] == body) continue;
    if (rear_face.hides(x[across[0]], x[across[1]], s)) continue;
    if (!mine_here && is_missed(w, i)) continue;
    chosen[i] = 1;
    if (together[i] == hull) continue;
    mine[APART] += mass_of(i);
    if (mine_here) mine[SPALL] += mass_of(i);
    mine[NUMBER] += debris ? debris->part(i) : 1.0;
  }
  MPI_Allreduce(mine, sum, NSUM, MPI_DOUBLE, MPI_SUM, world);
  MPI_Allreduce(&height, &row[BULGE], 1, MPI_DOUBLE, MPI_MAX, world);
  if (row[BULGE] == -BIG) row[BULGE] = 0.0;
  row[APART_MASS] = sum[APART];
  row[SPALL_MASS] = sum[SPALL];
  row[APART_NUMBER] = sum[NUMBER];
  row[BODY_MASS] = sum[BODY];

  w.cloud->choose(&chosen);
  w.cloud->compute_vector();
  const double *const cloud = w.cloud->vector;
  row[CLOUD_LENGTH] = cloud[0];
  row[CLOUD_DIAMETER] = cloud[1];
  row[CLOUD_RATIO] = cloud[2];
  row[FRONT_VELOCITY] = cloud[5];
  row[CLOUD_MASS] = cloud[8];
  row[CLOUD_MOMENTUM] = cloud[9];
  row[CLOUD_ENERGY] = cloud[10];

  fragment->choose(&chosen, strength ? 1 : 0);
  ComputeHVIFragment::Heaviest piece = fragment->find_heaviest();
  row[FRAGMENTS] = piece.number;
  row[LARGEST_MASS] = piece.mass;
  row[LARGEST_VELOCITY] = piece.velocity[axis];
  fragment->choose(&chosen, 0);
  piece = fragment->find_heaviest();
  row[PIECES_APART] = piece.number;
  row[LARGEST_APART_MASS] = piece.mass;
  find_hole(w, row);
}

/* ----------------------------------------------------------------------
   in the largest piece of the wall's own matter, rubble or not: what drifts in a
   hole is no plate
------------------------------------------------------------------------- */

void ComputeHVIWall::find_hole(Wall &w, double *row)
{
  const HVI::MirrorPlanes &mirror = store->fields.settings.mirror;
  double share = WHOLE;
  for (int k = 0; k < 2; k++)
    if (mirror.has(across[k])) share *= 0.5;

  for (int i = 0; i < atom->nlocal; i++)
    chosen[i] = (atom->mask[i] & groupbit) && w.owns(atom->type[i]);
  fragment->choose(&chosen, 0);
  const int64_t plate = fragment->find_heaviest().id;
  fragment->name_found(own);
  for (int i = 0; i < atom->nlocal; i++) chosen[i] = chosen[i] && own[i] == plate;

  const std::pair<ComputeHVIHole *, int> looks[2] = {{w.hole.get(), HOLE_FOUND},
                                                     {w.plane.get(), PLANE_FOUND}};
  for (const auto &[hole, found] : looks) {
    hole->choose(&chosen);
    hole->compute_vector();
    const double *const v = hole->vector;
    row[found] = v[6] < share ? -1.0 : v[10];
    if (row[found] <= 0.0) continue;
    row[found + 1] = v[0];
    row[found + 2] = found == HOLE_FOUND ? v[1] : v[3];
    row[found + 3] = found == HOLE_FOUND ? v[2] : v[4];
  }
}

/* ---------------------------------------------------------------------- */

double ComputeHVIWall::memory_usage()
{
  double bytes = chosen.capacity() +
      sizeof(int64_t) * (double) (sound.capacity() + together.capacity() + own.capacity());
  if (fragment) bytes += fragment->memory_usage();
  for (Wall &w : walls)
    if (w.cloud)
      bytes += w.cloud->memory_usage() + w.hole->memory_usage() + w.plane->memory_usage();
  return bytes;
}
