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
#include "hvi_cite.h"
#include "hvi_compat.h"
#include "hvi_restart.h"
#include "memory.h"
#include "modify.h"
#include "output.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

using namespace LAMMPS_NS;
using namespace FixConst;
using HVI::CORNERS;
using HVI::ELEMENT_SIZE;
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
  HVI::cite(lmp->citeme);
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
   A run begins: which particles are embedded, and state of new elements, before particles go to other ranks
------------------------------------------------------------------------- */

void FixHVIFEM::setup_pre_exchange()
{
  find_here();
  coupling.mark();
  find_laws();
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
  looked_at = goes_on;
  find_probes();
  show_particles();
  if (every > 0) list_elements();
  resumed = goes_on;
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
  if (resumed) take_changed_forces();
  gather_middle();
  if (looked_at) gather_changes();
  for (std::size_t e = 0; e < elements.size(); e++)
    mechanics.first_half(elements[e], nodes_of(e), update->dt,
                         looked_at ? power_on_changes(e) : 0.0);
  if (converts) release();
  coupling.place();
}

/* ----------------------------------------------------------------------
   The first step of a run that goes on: fixes that have come or gone since give nodes other forces than those of the last run's
   end, which have left their kick in the energy
------------------------------------------------------------------------- */

void FixHVIFEM::take_changed_forces()
{
  resumed = false;
  gather_nodes(dt_last * dt_last, true);
  for (std::size_t e = 0; e < elements.size(); e++) {
    const double kick = kick_of(e);
    if (kick != elements[e].kick) elements[e].e += kick - elements[e].kick;
  }
}

double FixHVIFEM::kick_of(std::size_t e) const
{
  double kick = 0.0;
  for (const HVI::Node *const node : nodes_of(e)) kick += node->kick / CORNERS;
  return kick;
}

/* ----------------------------------------------------------------------
   Changes of velocity by other fixes at the end of the last step, such as fix momentum, and the power of pair forces on
   them, which is not work of pairs
------------------------------------------------------------------------- */

void FixHVIFEM::gather_changes()
{
  node_changes.resize(nodes.size());
  of_nodes.gather(
      [this](int i) {
        const double *const change = coupling.integrator->velocity_change(i);
        return std::array<double, 3>{change[0], change[1], change[2]};
      },
      [this](int k, const std::array<double, 3> &change) {
        node_changes[k] = change;
      });
}

double FixHVIFEM::power_on_changes(std::size_t e) const
{
  double power = 0.0;
  for (int a = 0; a < CORNERS; a++)
    for (int k = 0; k < 3; k++)
      power += elements[e].pair_force[a][k] * node_changes[number(e, a)][k];
  return power;
}

/* ----------------------------------------------------------------------
   In the middle of a step, with the state of its begin: an element that has failed leaves its particles to
   themselves.  Nodes lose its part of their mass, particles have as much, and the same momentum; kinetic
   energy of what nodes did against each other is heat.
------------------------------------------------------------------------- */

void FixHVIFEM::release()
{
  enum { FREED, STATES, N };
  bigint here[N] = {0, 0}, all[N];
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
  MPI_Allreduce(here, all, N, MPI_LMP_BIGINT, MPI_SUM, world);
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
      if (!(one.stable >= shortest)) shortest = one.stable;
      if (goes_on) continue;
      one.kick = 0.0;
      if (one.stable_at_start > 0.0) continue;
      one.stable_at_start = one.stable;
      one.shared = mechanics.shared_corners(nodes_of(e + lane));
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
      if (mirror.passes(k, atom->x[i]))
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
  looked_at = is_looked_at();
  if (looked_at) show_particles();
}

/* ----------------------------------------------------------------------
   By fixes at the end of this step, before this one may have its turn: LAMMPS's read particles, or have computes read
   them, and do not say so before; those of this package do not.
------------------------------------------------------------------------- */

bool FixHVIFEM::is_looked_at() const
{
  for (int n = 0; n < modify->nfix; n++) {
    const Fix *const other = modify->fix[n];
    if ((modify->fmask[n] & END_OF_STEP) && update->ntimestep % other->nevery == 0 &&
        strncmp(other->style, "hvi/", 4) != 0)
      return true;
  }
  return false;
}

/* ----------------------------------------------------------------------
   what output sees of embedded particles: velocity of the end of the step, and all of their state
------------------------------------------------------------------------- */

void FixHVIFEM::end_of_step()
{
  const bool due = update->ntimestep == output->next || update->ntimestep == update->laststep ||
      update->eflag_global == update->ntimestep;
  const bool listed = every > 0 && (due || update->ntimestep % every == 0);
  if (due || listed) show_particles();
  if (listed) list_elements();
}

// a run may end before its last step

void FixHVIFEM::post_run()
{
  at_end = false;
  const bool all_seen = shown == update->ntimestep && !looked_at;
  looked_at = true;    // a run without setup may follow commands
  if (all_seen) return;
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
    if (!goes_on)
      one.kick = kick_of(e);    // else that of the last run's end: fixes may yet change forces
  }
  coupling.show_end();
  coupling.show_all();
  read_probes();
}

void FixHVIFEM::tighten(HVI::TimeStepBounds &bounds)
{
  if (!(courant * shortest >= bounds.stable)) bounds.stable = courant * shortest;
}

/* ======================================================================
   what elements and their nodes must be when a run begins: new ones, and those of a run before
====================================================================== */

/* ----------------------------------------------------------------------
   of types, as pair styles and fixes have them for this run
------------------------------------------------------------------------- */

void FixHVIFEM::find_laws()
{
  mechanics.mirror = coupling.store->fields.settings.mirror;
  mechanics.laws.assign(atom->ntypes + 1, {nullptr, nullptr});
  for (int itype = 1; itype <= atom->ntypes; itype++)
    if (const HVI::Material *const material = coupling.store->materials.of(itype))
      mechanics.laws[itype] = {material->eos.get(), coupling.strength->model(itype)};
  for (const Element &one : elements) {
    if (!mechanics.laws[one.type].eos || is_node(one.type))
      error->one(FLERR, "Fix hvi/fem: type {} of element {} has no material", one.type, one.id);
    if (!mechanics.laws[one.type].solid || coupling.store->materials.of(one.type)->is_liquid())
      error->one(FLERR,
                 "Fix hvi/fem: element {} has type {}, which is no solid for fix hvi/johnson-cook",
                 one.id, one.type);
  }
}

/* ----------------------------------------------------------------------
   Elements without a mass are new.  Masses of nodes and embedded particles are those that elements give them, or momentum
   would not be that of the material.  A free particle without one of its own has that of its type.
------------------------------------------------------------------------- */

void FixHVIFEM::give_masses()
{
  double *const rmass = atom->rmass;
  const FixHVIStore *const store = FixHVIStore::find(lmp);
  if (!rmass || !store) return;    // errors of init()
  FixHVIFEMMesh::init();
  int here = 0, anywhere;
  for (const Element &one : elements) here |= one.mass == 0.0;
  for (int i = 0; i < atom->nlocal; i++) here |= rmass[i] == 0.0 && !nodal(i);
  MPI_Allreduce(&here, &anywhere, 1, MPI_INT, MPI_MAX, world);
  if (!anywhere) return;

  find_here();
  struct Mass {
    double old, all;    // of elements that have begun, of all
  };
  std::vector<Mass> node_mass(nodes.size(), {0.0, 0.0});
  std::vector<double> embedded_mass;
  for (std::size_t e = 0; e < elements.size(); e++) {
    const Element &one = elements[e];
    const HVI::Material *const material = store->materials.of(one.type);
    HVI::Corners x;
    places(e, x);
    const double given = one.mass == 0.0 && material ? material->eos->rho0() * HVI::hex_volume(x)
                                                     : 0.0;
    for (int a = 0; a < CORNERS; a++) {
      Mass &node = node_mass[number(e, a)];
      node.old += one.mass / CORNERS;
      node.all += (one.mass + given) / CORNERS;
    }
    embedded_mass.resize(embedded_mass.size() + one.particles(), given / one.particles());
  }

  // other masses that a node has are an error when the run begins; commands before it may come here several times

  std::vector<Mass> sums(atom->nlocal, {0.0, 0.0});
  of_nodes.scatter(node_mass, [&](int i, const Mass &mass) {
    sums[i].old += mass.old;
    sums[i].all += mass.all;
  });
  for (int i = 0; i < atom->nlocal; i++)
    if (sums[i].all > sums[i].old && std::fabs(rmass[i] - sums[i].old) <= 1.0e-9 * sums[i].all)
      rmass[i] = sums[i].all;
  std::vector<char> is_free(atom->nlocal, 1);
  of_embedded.scatter(embedded_mass, [&](int i, double mass) {
    is_free[i] = 0;
    if (mass > 0.0) rmass[i] = mass;
  });
  for (int i = 0; i < atom->nlocal; i++)
    if (rmass[i] == 0.0 && is_free[i] && !nodal(i)) rmass[i] = atom->mass[atom->type[i]];
}

// elements and nodes that are here

void FixHVIFEM::find_here()
{
  atom->nghost = 0;
  atom->map_init();
  atom->map_set();
  connect();
  gather_nodes(0.0, true);
}

/* ----------------------------------------------------------------------
   New elements are at rest in their material
------------------------------------------------------------------------- */

void FixHVIFEM::start_elements()
{
  std::vector<double> node_mass(nodes.size(), 0.0), embedded_mass;
  std::vector<std::int64_t> are_new;
  double least = HUGE_VAL;
  bigint bad = 0;
  for (std::size_t e = 0; e < elements.size(); e++) {
    Element &one = elements[e];
    const bool is_new = one.mass == 0.0;
    HVI::Corners x;
    places(e, x);
    if (is_new && !mechanics.start(one, x))
      error->one(FLERR,
                 "Fix hvi/fem: element {} is turned inside out or has no volume: its nodes must be "
                 "numbered around the bottom and then above it, seen from inside against the clock",
                 one.id);
    if (is_new && mechanics.is_distorted(x)) bad++;
    for (int a = 0; a < CORNERS; a++) node_mass[number(e, a)] += one.mass / CORNERS;
    embedded_mass.resize(embedded_mass.size() + one.particles(), one.mass / one.particles());
    are_new.resize(embedded_mass.size(), is_new);
    least = std::min(least, std::cbrt(one.V0));
  }
  std::vector<double> should(atom->nlocal, 0.0);
  of_nodes.scatter(node_mass, [&](int i, double mass) {
    coupling.check_group(i);
    should[i] += mass;
  });
  of_embedded.scatter(embedded_mass, [&](int i, double mass) {
    should[i] = mass;
  });
  of_embedded.scatter(are_new, [&](int i, std::int64_t is_new) {
    if (is_new && atom->esph[i] != 0.0)
      error->one(FLERR,
                 "Fix hvi/fem: particle {} has an internal energy of {}, and its element is new: "
                 "elements begin without, and embedded particles have theirs",
                 atom->tag[i], atom->esph[i]);
  });
  bigint without = 0, everywhere;
  const double *const rmass = atom->rmass;
  for (int i = 0; i < atom->nlocal; i++) {
    if (nodal(i) && valence[i] == 0 && total > 0) without++;
    if (should[i] > 0.0 && std::fabs(rmass[i] - should[i]) > 1.0e-9 * should[i])
      error->one(
          FLERR,
          "Fix hvi/fem: {} {} has mass {}, but its elements {}: they give masses to nodes and "
          "particles, which must not have others",
          nodal(i) ? "node" : "particle", atom->tag[i], rmass[i], should[i]);
  }
  MPI_Allreduce(&without, &everywhere, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (everywhere) error->all(FLERR, "Fix hvi/fem: {} nodes belong to no element", everywhere);
  MPI_Allreduce(MPI_IN_PLACE, &bad, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (bad && comm->me == 0)
    error->warning(
        FLERR,
        "Fix hvi/fem: {} elements have a shape at the start with which they fail as soon "
        "as they yield (keywords jacobian and edges): are their nodes the right ones?",
        bad);
  MPI_Allreduce(&least, &smallest, 1, MPI_DOUBLE, MPI_MIN, world);
  keep_on_planes(true);
}

/* ----------------------------------------------------------------------
   Nodes on mirror planes are, and stay, on them to the last digit: balancing by shifts takes all places to
   fractions of the box and back, which rounds them.  At the start of a run they must be at rest across them.
------------------------------------------------------------------------- */

void FixHVIFEM::keep_on_planes(bool start)
{
  const HVI::MirrorPlanes &mirror = coupling.store->fields.settings.mirror;
  for (int i = 0; mirror.planes && i < atom->nlocal + atom->nghost; i++)
    for (int k = 0; k < 3; k++) {
      if (!nodal(i) || !mirror.has(k)) continue;
      const double depth = mirror.depth(k, atom->x[i]);
      if (std::fabs(depth) <= (start ? 1.0e-6 : 1.0e-9) * smallest) {
        atom->x[i][k] = mirror.at[k];
        if (start && atom->v[i][k] != 0.0)
          error->one(FLERR,
                     "Fix hvi/fem: node {} is on the mirror plane {} and moves across it: set its "
                     "velocity there to 0",
                     atom->tag[i], "xyz"[k]);
      } else if (start && depth < 0.0)
        error->one(FLERR, "Fix hvi/fem: node {} is beyond the mirror plane {}", atom->tag[i],
                   "xyz"[k]);
    }
}

/* ----------------------------------------------------------------------
   Elements of a run that goes on where the last one ended have the forces of its end; if a command has changed
   any node or particle since, all are made anew.  Then density goes by volume: what pairs have told stays.
------------------------------------------------------------------------- */

void FixHVIFEM::check_state()
{
  int here = 1, all;
  for (std::size_t e = 0; e < elements.size(); e++) {
    Element &one = elements[e];
    if (const auto *const other =
            HVI::SolidModel::misread(mechanics.laws[one.type].solid, one.solid))
      error->one(FLERR,
                 "Fix hvi/fem: element {} of type {} has {}, by {}, which its type does not have "
                 "in this run: give fix hvi/johnson-cook the keywords, and the type the material "
                 "file, of the run that its state is from",
                 one.id, one.type, other->what, other->law);
    if (one.fingerprint != fingerprint(e)) here = 0;
    const double volume = load(e).V[0];
    if (std::fabs(volume - one.V) > 1.0e-9 * one.V) {
      here = 0;
      if (!(volume > 0.0))
        error->one(FLERR, "Fix hvi/fem: element {} is turned inside out since the last run",
                   one.id);
      one.rho *= one.V / volume;
      one.V = volume;
    }
  }
  for (int i = 0; i < atom->nlocal;
       i++)    // a fix hvi/sph of another ID knows nothing of the last step
    if (valence[i] > 0 && !coupling.integrator->knows_node(i)) here = 0;
  if (coupling.strayed()) here = 0;    // all ranks ask
  MPI_Allreduce(&here, &all, 1, MPI_INT, MPI_MIN, world);
  goes_on = all;
  double step = 0.0;
  if (goes_on)
    for (const Element &one : elements) step = std::max(step, one.step);
  MPI_Allreduce(&step, &dt_last, 1, MPI_DOUBLE, MPI_MAX, world);
  if (goes_on) return;
  for (Element &one : elements) {
    one.e -= one.kick;    // that of the last run's end; its first step gives another
    one.kick = 0.0;
    one.ahead = one.e;
    one.pair_power = one.q = 0.0;
    std::fill_n(one.force[0], 3 * CORNERS, 0.0);
    std::fill_n(one.pair_force[0], 3 * CORNERS, 0.0);
  }
}

// of its nodes: an element that goes on has forces of its own at the start of a run

double FixHVIFEM::fingerprint(std::size_t e) const
{
  std::uint64_t mark = 0x9E3779B97F4A7C15ull;
  for (int a = 0; a < CORNERS; a++)
    for (const double v : nodes[number(e, a)].predicted) {
      std::uint64_t bits;
      memcpy(&bits, &v, sizeof(bits));
      mark = (mark ^ bits) * 0xFF51AFD7ED558CCDull;
      mark ^= mark >> 32;
    }
  return (double) (mark >> 12) + 1.0;    // with all digits in data files
}

/* ----------------------------------------------------------------------
   The drag takes 16 eps c dt/l of an hourglass's speed in a step, in cubes 9 eps times the step in
   units of the stable one: with 2, less half the square of its frequency times dt, it grows.  A tenth
   leaves room for distorted elements.  Where the step is chosen, courant bounds it: read_options().
------------------------------------------------------------------------- */

void FixHVIFEM::check_drag()
{
  for (const char *const style : {"^hvi/dt", "^dt/reset"})
    if (!modify->get_fix_by_style(style).empty()) return;
  double stable;
  MPI_Allreduce(&shortest, &stable, 1, MPI_DOUBLE, MPI_MIN, world);
  const double viscous = mechanics.options.viscous;
  if (viscous * update->dt > MOST_DRAG * stable)
    error->all(
        FLERR,
        "Fix hvi/fem hourglass/viscous {} with a timestep of {:.3g} times the stable one of the "
        "elements: their product must be at most {}, or the drag may be unstable",
        viscous, update->dt / stable, MOST_DRAG);
}

/* ======================================================================
   what output, files and the books see of elements
====================================================================== */

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

bool FixHVIFEM::is_shown(int i, double &rho, double &esph) const
{
  return shown == update->ntimestep && coupling.is_shown(i, rho, esph);
}

double FixHVIFEM::energy_without_particles(int i) const
{
  double sum = 0.0;
  each_of(i, [&](const Element &one) {
    if (one.particles() == 0) sum += one.mass * (one.e - one.kick);
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
   Lists leave out pairs of embedded particles.  First nodes are owned here: others, and particles, hang on them.
------------------------------------------------------------------------- */

void FixHVIFEM::join(HVI::Components &components, const std::vector<std::int64_t> &ids, int first,
                     bool failed_alone)
{
  const auto held = of_embedded.gather([&ids](int i) {
    return ids[i];
  });
  std::vector<char> holds(elements.size());
  for (std::size_t e = 0; e < elements.size(); e++)
    holds[e] = elements[e].n == 0 && !(failed_alone && elements[e].solid.failed());
  for (std::size_t k = 0; k < held.size(); k++)
    if (held[k] > 0) holds[embedded[k].element] = 1;

  // one with nodes on a mirror plane holds together with its image

  const HVI::MirrorPlanes &mirror = coupling.store->fields.settings.mirror;
  on_planes.assign(atom->nlocal, 0);
  if (mirror.planes)
    of_embedded.scatter(
        [&](int k) {
          const std::size_t e = embedded[k].element;
          double planes = 0.0;    // rows are of doubles
          for (int d = 0; d < 3 && holds[e]; d++)
            for (int a = 0; a < CORNERS; a++)
              if (mirror.passes(d, nodes[number(e, a)].x)) {
                planes += 1 << d;
                break;
              }
          return planes;
        },
        [this](int i, double planes) {
          on_planes[i] = (int) planes;
        });

  const auto hang = [&](const Element &one, std::int64_t tag, int slot) {
    const int i = of_nodes.local(tag);
    components.join(of_nodes.local(one.node[0]), i >= 0 && i < atom->nlocal ? i : first + slot);
  };
  for (std::size_t e = 0; e < elements.size(); e++)
    for (int a = 1; a < CORNERS && holds[e]; a++)
      hang(elements[e], elements[e].node[a], number(e, a));
  for (std::size_t k = 0; k < embedded.size(); k++) {
    const Element &one = elements[embedded[k].element];
    if (holds[embedded[k].element]) hang(one, one.first + embedded[k].cell, of_nodes.size() + k);
  }
}

void FixHVIFEM::copy(HVI::Components::Node *node, int first)
{
  for (HVITagExchange *const here : {&of_nodes, &of_embedded}) {
    here->gather(
        [node](int i) {
          return node[i];
        },
        [&](int k, const HVI::Components::Node &there) {
          node[first + k] = there;
        });
    first += here->size();
  }
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
      for (int k = 0; k < 3; k++) c[k] -= probe.x[k];
      HVI::minimum_image(domain, c[0], c[1], c[2]);
      for (int k = 0; k < 3; k++) square += c[k] * c[k];
      if (square >= here.distance) continue;
      here.distance = square;
      id_here = elements[e].id;
    }
    MPI_Allreduce(&here, &nearest, 1, MPI_DOUBLE_INT, MPI_MINLOC, world);
    MPI_Bcast(&id_here, 1, MPI_INT64_T, nearest.rank, world);
    probe.id = id_here;
    double size = 0.0;    // of that element, from its center
    for (std::size_t e = 0; e < elements.size(); e++) {
      if (elements[e].id != probe.id) continue;
      HVI::Corners x;
      double c[3];
      places(e, x);
      center(x, c);
      for (const auto &corner : x)
        size = MAX(size, std::hypot(corner[0] - c[0], corner[1] - c[1], corner[2] - c[2]));
    }
    MPI_Allreduce(MPI_IN_PLACE, &size, 1, MPI_DOUBLE, MPI_MAX, world);
    if (std::sqrt(nearest.distance) > 2.0 * size && comm->me == 0)
      error->warning(
          FLERR,
          "Fix hvi/fem: probe {} {} {} is in no element, the nearest is {:.6g} away and is read: "
          "is it in other units?",
          probe.x[0], probe.x[1], probe.x[2], std::sqrt(nearest.distance));
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
    const double last[] = {one.solid.eps, one.solid.damage, one.e - one.kick, (double) one.n};
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
  if (at_end && looked_at) show_particles();    // with velocities as fixes have left them
  double sum[NCOUNT];
  MPI_Reduce(counts, sum, NCOUNT, MPI_DOUBLE, MPI_SUM, 0, world);
  if (comm->me) return;
  HVI::RestartSection section(ELEMENT_SIZE);
  section.put(&dt_last, 1);
  section.put(&total, 1);
  section.put(sum, NCOUNT);
  for (const Probe &probe : probes) {
    section.put(probe.x, 3);
    section.put(&probe.id, 1);
  }
  section.write_state(fp);
}

void FixHVIFEM::restart(char *buf)
{
  HVI::RestartSection section(lmp, "Fix hvi/fem", ELEMENT_SIZE, buf);
  double sum[NCOUNT];
  section.get(&dt_last, 1);
  section.get(&total, 1);
  section.get(sum, NCOUNT);
  if (comm->me == 0) std::copy_n(sum, +NCOUNT, counts);
  while (section.left()) {
    double x[3];
    section.get(x, 3);
    const auto id = section.get<decltype(Probe::id)>();
    for (Probe &probe : probes)
      if (std::equal(probe.x, probe.x + 3, x)) probe.id = id;
  }
}
