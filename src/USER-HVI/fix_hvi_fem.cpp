/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "fix_hvi_fem.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_hvi_johnson_cook.h"
#include "fix_hvi_sph.h"
#include "fix_hvi_store.h"
#include "force.h"
#include "group.h"
#include "memory.h"
#include "modify.h"
#include "output.h"
#include "update.h"

#include <algorithm>
#include <cstring>
#include <map>

using namespace LAMMPS_NS;
using namespace FixConst;
using HVI::CORNERS;
using HVI::LANES;

/* ---------------------------------------------------------------------- */

FixHVIFEM::FixHVIFEM(LAMMPS *lmp, int narg, char **arg) :
    FixHVIFEMMesh(lmp, narg, arg), coupling(lmp, *this)
{
  if (igroup != 0)
    error->all(FLERR,
               "Fix hvi/fem must be of group all, not {}: elements say which particles are "
               "theirs",
               group->names[igroup]);
  read_options(narg, arg);
  if (!atom->esph_flag || !atom->rho_flag || !atom->vest_flag)
    error->all(FLERR, "Fix hvi/fem needs atom_style sph");
  if (atom->map_style == Atom::MAP_NONE)
    error->all(FLERR, "Fix hvi/fem needs a map of particles by ID: use atom_modify map yes");

  scalar_flag = vector_flag = 1;
  size_vector = NCOUNT + 2;
  extscalar = 0;    // a number, never per particle
  extvector = 0;
  global_freq = 1;
  if (!probes.empty()) {
    array_flag = 1;
    size_array_rows = probes.size();
    size_array_cols = Probe::NVALUE;
    extarray = 0;
  }
  if (every > 0) {
    local_flag = 1;
    local_freq = every;
    size_local_rows = 0;
    size_local_cols = NCOLUMN;
  }
  restart_global = 1;
  force_reneighbor = 1;
  next_reneighbor = -1;
  nevery = 1;
  begin();
}

FixHVIFEM::~FixHVIFEM()
{
  memory->destroy(array_local);
}

/* ---------------------------------------------------------------------- */

void FixHVIFEM::read_options(int narg, char **arg)
{
  Mechanics::Options &options = mechanics.options;
  node_types.assign(atom->ntypes + 1, 0);
  const std::map<std::string, std::pair<double *, double>> numbers = {
      {"hourglass/viscous", {&options.viscous, 1.0}},
      {"hourglass/stiffness", {&options.stiffness, 1.0}},
      {"courant", {&courant, 1.0}},
      {"strain", {&options.strain, 100.0}},
      {"jacobian", {&options.jacobian, 1.0}},
      {"edges", {&options.edges, 1000.0}},
      {"step", {&options.shrink, 1.0}}};
  const std::map<std::string, bool *> switches = {
      {"convert", &converts}, {"damage", &options.damage}, {"spall", &options.spall}};
  for (int iarg = 3, n; iarg < narg; iarg += n + 1) {
    const std::string key = arg[iarg];
    n = key == "probe" ? 3 : (key == "viscosity" ? 2 : 1);
    if (iarg + n >= narg) utils::missing_cmd_args(FLERR, "fix hvi/fem " + key, error);
    char **const word = arg + iarg + 1;
    if (key == "nodes") {
      int lo, hi;
      utils::bounds(FLERR, word[0], 1, atom->ntypes, lo, hi, error);
      std::fill(node_types.begin() + lo, node_types.begin() + hi + 1, 1);
    } else if (key == "probe") {
      probes.emplace_back();
      for (int k = 0; k < 3; k++) probes.back().x[k] = utils::numeric(FLERR, word[k], false, lmp);
    } else if (key == "local") {
      every = utils::inumeric(FLERR, word[0], false, lmp);
      if (every < 1) error->all(FLERR, "Fix hvi/fem local must be above 0, not {}", every);
    } else if (key == "viscosity") {
      options.q1 = utils::numeric(FLERR, word[0], false, lmp);
      options.q2 = utils::numeric(FLERR, word[1], false, lmp);
      if (!(options.q1 >= 0.0) || !(options.q2 >= 0.0))
        error->all(FLERR, "Fix hvi/fem viscosity must not be negative: {} {}", options.q1,
                   options.q2);
    } else if (switches.count(key)) {
      *switches.at(key) = utils::logical(FLERR, word[0], false, lmp);
    } else if (numbers.count(key)) {
      const auto &number = numbers.at(key);
      *number.first = utils::numeric(FLERR, word[0], false, lmp);
      const double least = key == "edges" ? 1.0 : 0.0;
      if (!(*number.first >= least && *number.first <= number.second))
        error->all(FLERR, "Fix hvi/fem {} must be from {} to {}, not {}", key, least, number.second,
                   word[0]);
    } else
      error->all(FLERR, "Unknown fix hvi/fem keyword: {}", key);
  }
  if (std::count(node_types.begin(), node_types.end(), 1) == 0)
    error->all(FLERR, "Fix hvi/fem needs the types of its nodes: nodes TYPE");
  if (!(courant > 0.0)) error->all(FLERR, "Fix hvi/fem courant must be above 0");

  if (options.viscous * courant > MOST_DRAG)    // why: check_drag()
    error->all(FLERR,
               "Fix hvi/fem hourglass/viscous times courant must be at most {}, or the drag may be "
               "unstable, not {} times {}",
               MOST_DRAG, options.viscous, courant);
}

/* ---------------------------------------------------------------------- */

int FixHVIFEM::setmask()
{
  return POST_INTEGRATE | PRE_EXCHANGE | PRE_NEIGHBOR | POST_NEIGHBOR | PRE_FORCE | PRE_REVERSE |
      FINAL_INTEGRATE | END_OF_STEP;
}

/* ---------------------------------------------------------------------- */

void FixHVIFEM::init()
{
  if (modify->get_fix_by_style("^hvi/fem$").size() > 1)
    error->all(FLERR, "More than one fix hvi/fem: one has all elements");
  coupling.store = FixHVIStore::find(lmp);
  coupling.integrator = nullptr;
  for (Fix *const fix : modify->get_fix_list()) {
    if (fix == this && !coupling.integrator)
      error->all(FLERR, "Fix hvi/fem must come after fix hvi/sph, which moves its nodes");
    if (strcmp(fix->style, "hvi/sph") == 0) coupling.integrator = dynamic_cast<FixHVISPH *>(fix);
  }
  coupling.strength = FixHVIJohnsonCook::find(lmp);
  if (!coupling.store || !force->pair_match("^hvi/sph$", 0) || !coupling.strength)
    error->all(FLERR,
               "Fix hvi/fem needs pair style hvi/sph, for materials, and fix hvi/johnson-cook, for "
               "the laws of solids");
  const HVI::SphSettings &set = coupling.store->fields.settings;
  if (domain->dimension != 3 || set.laws.dim != 3)
    error->all(
        FLERR,
        "Fix hvi/fem needs three dimensions: plane strain is three layers of elements or more "
        "between periodic faces");
  if (!atom->rmass)
    error->all(FLERR,
               "Fix hvi/fem needs masses of particles, for those of nodes change: use fix ID all "
               "property/atom rmass ghost yes before read_data");
  FixHVIFEMMesh::init();
  coupling.init();
}

/* ----------------------------------------------------------------------
   A run begins: masses that nobody has given, and which particles are embedded, before particles go to other ranks
------------------------------------------------------------------------- */

void FixHVIFEM::setup_pre_exchange()
{
  atom->nghost = 0;
  atom->map_init();
  atom->map_set();
  connect();
  coupling.mark();
  find_laws();
  gather_nodes(0.0, true);
  start_elements();
  gather_nodes(0.0, true);    // with the places and masses of new ones
  check_state();
  if (!goes_on) coupling.place();
}

void FixHVIFEM::setup_pre_neighbor()
{
  keep_on_planes();
  connect();
  gather_nodes(0.0, true);
  comm->forward_comm();
}

// after fix hvi/sph, which has seen what was changed by others

void FixHVIFEM::setup_pre_force(int /*vflag*/)
{
  if (!goes_on) coupling.place();
  coupling.show_all();
  comm->forward_comm();
}

void FixHVIFEM::setup(int /*vflag*/)
{
  at_end = true;
  find_probes();
  show_particles();
  if (every > 0) list_elements();
  goes_on = false;    // from now on forces are made anew
  check_drag();
  coupling.check_fixes();
}

/* ----------------------------------------------------------------------
   Fix hvi/sph has moved the nodes.  What forces have worked, failures, and particles to their places
------------------------------------------------------------------------- */

void FixHVIFEM::post_integrate()
{
  at_end = false;
  gather_middle();
  for (std::size_t e = 0; e < elements.size(); e++)
    mechanics.first_half(elements[e], nodes_of(e), update->dt);
  if (converts) release();
  coupling.place();
}

/* ----------------------------------------------------------------------
   In the middle of a step, with the state of its begin: an element that has failed leaves its particles to
   themselves.  Nodes lose its part of their mass, particles have as much, and the same momentum; kinetic
   energy of what nodes did against each other is heat.
------------------------------------------------------------------------- */

void FixHVIFEM::release()
{
  enum { FREED, STATES, N };
  int here[N] = {0, 0}, all[N];
  std::vector<std::size_t> freed;
  for (std::size_t e = 0; e < elements.size(); e++) {
    Element &one = elements[e];
    if (one.n == 0) continue;
    HVI::Corners x;
    places(e, x);
    const HVI::ElementNodes corners = nodes_of(e);
    const Mechanics::Failure why = mechanics.failure(one, corners, x);
    if (why == Mechanics::NONE) continue;
    freed.push_back(e);
    here[FREED]++;
    if (!steps[e].paired) here[STATES] = 1;
    const double heat = mechanics.let_go(one, corners, cells(e));
    counts[why] += 1.0;
    counts[HEAT] += one.mass * heat;
    counts[HOURGLASS] += one.hourglass;
  }
  MPI_Allreduce(here, all, N, MPI_INT, MPI_SUM, world);
  if (!all[FREED]) return;
  total -= all[FREED];
  next_reneighbor = update->ntimestep;
  if (all[STATES]) coupling.show_all();    // pairs have not seen them before
  for (const std::size_t e : freed) elements[e].type = 0;
  coupling.take_masses();
}

/* ----------------------------------------------------------------------
   Particles have been exchanged
------------------------------------------------------------------------- */

void FixHVIFEM::pre_neighbor()
{
  keep_on_planes();
  connect();
  gather_middle();
}

// kicks as far as a step differs from the one before

void FixHVIFEM::gather_middle()
{
  gather_nodes(update->dt * update->dt - dt_last * dt_last);
}

/* ----------------------------------------------------------------------
   Between the sweeps of pair hvi/sph: elements to the end of the step.  Those that pairs do not act on have their
   forces at once, while all of their numbers are at hand.
------------------------------------------------------------------------- */

void FixHVIFEM::advance()
{
  const bool due = coupling.integrator->is_due();
  dt_forces = due ? coupling.integrator->step() : 0.0;
  coupling.gather_sums();
  shortest = HVI::NO_BOUND;
  for (std::size_t e = 0; e < elements.size(); e += LANES) {
    HVI::ElementBatch batch = load(e);
    if (goes_on)
      mechanics.resume(batch);
    else
      advance_batch(batch, due);
    for (int lane = 0; lane < batch.n; lane++) {
      Element &one = batch.element[lane];
      one.kick = 0.0;
      if (!(one.stable >= shortest)) shortest = one.stable;
      if (goes_on || one.stable_at_start > 0.0) continue;
      one.stable_at_start = one.stable;
      one.shared = HVI::shared_corners(nodes_of(e + lane));
    }
    if (!paired(e) && !goes_on) mechanics.forces(batch, dt_forces);
  }
  coupling.show();
}

void FixHVIFEM::advance_batch(HVI::ElementBatch &batch, bool due) const
{
  int lane;
  const Mechanics::Trouble trouble = mechanics.advance(batch, dt_forces, due, lane);
  if (trouble == Mechanics::NO_TROUBLE) return;
  const Element &one = batch.element[lane];
  if (trouble == Mechanics::NOT_A_NUMBER)
    error->one(FLERR, "Fix hvi/fem: stress of element {} is not a number", one.id);
  error->one(
      FLERR,
      "Fix hvi/fem: element {} (type {}) has turned inside out or collapsed at step {}: volume "
      "{}, density {}, energy per mass {}; elements that are crushed need particles and "
      "convert yes, or a smaller courant",
      one.id, one.type, update->ntimestep, one.V, one.rho, one.ahead);
}

/* ----------------------------------------------------------------------
   When pairs have acted: forces of elements, in place of pre_force() of others, for ghosts have not
   yet sent what happened to them, but sums of what pairs did to embedded particles are at their owners
------------------------------------------------------------------------- */

void FixHVIFEM::pre_reverse(int, int)
{
  coupling.gather_forces();
  for (std::size_t e = 0; e < elements.size() && !goes_on; e += LANES) {
    if (!paired(e)) continue;
    HVI::ElementBatch batch = load(e);
    mechanics.forces(batch, dt_forces);
  }

  // in the order of elements, whichever pairs act on: so sums are the same to the last bit when a run goes on with new lists

  node_forces.assign(nodes.size(), {0.0, 0.0, 0.0});
  for (std::size_t e = 0; e < elements.size(); e++) {
    const Element &one = elements[e];
    double work = steps[e].work;
    for (int a = 0; a < CORNERS; a++) {
      std::array<double, 3> &f = node_forces[number(e, a)];
      for (int k = 0; k < 3; k++) {
        f[k] += one.force[a][k] + one.pair_force[a][k];
        work += one.pair_force[a][k] * nodes[number(e, a)].v[k];
      }
    }
    steps[e].work = work;
  }
  coupling.take_forces(node_forces);
  bring_forces();
}

/* ----------------------------------------------------------------------
   To nodes.  One on a mirror plane stays there: its image does the same on the other side, and what they have
   in common is half of each.
------------------------------------------------------------------------- */

void FixHVIFEM::bring_forces()
{
  HVI::SphFields &fields = coupling.store->fields;
  const HVI::MirrorPlanes &mirror = fields.settings.mirror;
  of_nodes.scatter(node_forces, [&](int i, const std::array<double, 3> &f) {
    for (int k = 0; k < 3; k++) {
      if (mirror.has(k) && mirror.depth(k, atom->x[i]) < 0.0)
        error->one(FLERR,
                   "Fix hvi/fem: node {} has gone through the mirror plane {} at step {}: walls "
                   "of elements do not bounce off mirror planes",
                   atom->tag[i], "xyz"[k], update -> ntimestep);
      if (mirror.has(k) && atom->x[i][k] == mirror.at[k])
        fields.plane_force[k] -= f[k];
      else
        atom->f[i][k] += f[k];
    }
  });
}

/* ---------------------------------------------------------------------- */

void FixHVIFEM::final_integrate()
{
  at_end = true;
  dt_last = update->dt;
  for (std::size_t e = 0; e < elements.size(); e++)
    mechanics.second_half(elements[e], steps[e], dt_last);
}

/* ----------------------------------------------------------------------
   what output sees of embedded particles: velocity of the end of the step, and all of their state
------------------------------------------------------------------------- */

void FixHVIFEM::end_of_step()
{
  const bool due = update->ntimestep == output->next || update->ntimestep == update->laststep ||
      update->eflag_global == update->ntimestep;
  if (due) show_particles();
  if (every > 0 && (due || update->ntimestep % every == 0)) list_elements();
}

// a run may end before its last step

void FixHVIFEM::post_run()
{
  if (shown == update->ntimestep) return;
  show_particles();
  if (every > 0) list_elements();
}

void FixHVIFEM::show_particles()
{
  shown = update->ntimestep;
  gather_nodes(dt_last * dt_last, true);
  for (std::size_t e = 0; e < elements.size(); e++) {
    Element &one = elements[e];
    one.fingerprint = fingerprint(e);
    one.step = dt_last;
    std::copy_n(steps[e].L, 9, one.L);
    one.kick = 0.0;
    for (const HVI::Node *const node : nodes_of(e)) one.kick += node->kick / CORNERS;
  }
  coupling.show_velocities();
  coupling.show_all();
  read_probes();
}

void FixHVIFEM::tighten(HVI::TimeStepBounds &bounds)
{
  if (!(courant * shortest >= bounds.stable)) bounds.stable = courant * shortest;
}
