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
#include "fix_hvi_ledger.h"
#include "fix_hvi_sph.h"
#include "fix_hvi_store.h"
#include "force.h"
#include "group.h"
#include "hvi_compat.h"
#include "hvi_interface.h"
#include "memory.h"
#include "modify.h"
#include "neighbor.h"
#include "output.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;
using HVI::CORNERS;

/* ---------------------------------------------------------------------- */

FixHVIFEM::~FixHVIFEM()
{
  if (copymode || !head) return;
  atom->delete_callback(id, Atom::GROW);
  atom->delete_callback(id, Atom::RESTART);
  memory->destroy(head);
  memory->destroy(users);
  memory->destroy(array_local);
  unmark_particles();
  if (FixHVIStore *const now = FixHVIStore::find(lmp)) now->embedded = 0;
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
  store = FixHVIStore::find(lmp);
  integrator = nullptr;
  for (Fix *const fix : modify->get_fix_list()) {
    if (fix == this && !integrator)
      error->all(FLERR, "Fix hvi/fem must come after fix hvi/sph, which moves its nodes");
    if (strcmp(fix->style, "hvi/sph") == 0) integrator = dynamic_cast<FixHVISPH *>(fix);
  }
  strength = FixHVIJohnsonCook::find(lmp);
  if (!store || !force->pair_match("^hvi/sph$", 0) || !strength)
    error->all(FLERR,
               "Fix hvi/fem needs pair style hvi/sph, for materials, and fix hvi/johnson-cook, for "
               "the laws of solids");
  if (!store->fields.settings.whole)
    error->all(FLERR, "Fix hvi/fem needs pair style hvi/sph with gradient corrected");
  if (domain->dimension != 3 || store->fields.settings.laws.dim != 3)
    error->all(
        FLERR,
        "Fix hvi/fem needs three dimensions: plane strain is three layers of elements or more "
        "between periodic faces");
  if (!atom->rmass)
    error->all(FLERR,
               "Fix hvi/fem needs masses of particles, for those of nodes change: use fix ID all "
               "property/atom rmass ghost yes before read_data");
  ledger = FixHVILedger::instance(lmp);
  store->embedded = held;
  wraps = false;
  nearby = HUGE_VAL;
  for (int k = 0; k < 3; k++)
    if (domain->periodicity[k]) {
      wraps = true;
      nearby = std::min(nearby, 0.25 * domain->prd[k]);
    }

  const bigint here = std::count_if(elements.begin(), elements.end(), [](const Element &one) {
    return one.type > 0;    // others went with their nodes when these were read
  });
  bigint all;
  MPI_Allreduce(&here, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (all == 0 && total < 0)
    error->all(FLERR, "Fix hvi/fem has no elements: use read_data FILE fix {} elements Elements",
               id);
  if (total < 0 && expected >= 0 && all != expected)
    error->all(
        FLERR,
        "Fix hvi/fem: {} of {} elements have a first node that is not there: the section Elements "
        "must come after Atoms, with IDs of nodes as there",
        expected - all, expected);
  if (total < 0) total = all;
  expected = -1;
  make_groups();
  others = find_others();
}

/* ----------------------------------------------------------------------
   Lists leave out pairs of particles that are both inside of elements of one body
------------------------------------------------------------------------- */

void FixHVIFEM::make_groups()
{
  std::vector<int> here(atom->ntypes + 1, 0), used(atom->ntypes + 1);
  for (const Element &one : elements)
    if (one.n > 0) here[one.type] = 1;
  MPI_Allreduce(here.data(), used.data(), used.size(), MPI_INT, MPI_MAX, world);
  inner.resize(atom->ntypes + 1, 0);
  for (int itype = 1; itype <= atom->ntypes; itype++) {
    if (!used[itype] || inner[itype]) continue;
    const std::string name = fmt::format("{}_inner_{}", id, itype);
    inner[itype] = group->bitmask[group->find_or_create(name.c_str())];
    neighbor->modify_params(fmt::format("exclude group {} {}", name, name));
  }
}

/* ----------------------------------------------------------------------
   Of a run that begins: masses that nobody has given, and which particles are in elements, before
   particles go to other ranks
------------------------------------------------------------------------- */

void FixHVIFEM::setup_pre_exchange()
{
  atom->nghost = 0;
  atom->map_init();
  atom->map_set();
  mark_particles();
  start_elements();
  gather_start();
  check_state();
  if (!going_on) place_particles({});
}

void FixHVIFEM::setup_pre_neighbor()
{
  keep_on_planes();
  connect();
  gather_start();
  comm->forward_comm();
}

// there is no other velocity yet

void FixHVIFEM::gather_start()
{
  gather_nodes();
  for (std::size_t k = 0; k < node.size(); k += NODE) std::copy_n(&node[k + V], 3, &node[k + W]);
}

/* ----------------------------------------------------------------------
   after fix hvi/sph, which has seen who was changed by others
------------------------------------------------------------------------- */

void FixHVIFEM::setup_pre_force(int /*vflag*/)
{
  if (!going_on) place_particles({});
  show_states(true);
  comm->forward_comm();
}

void FixHVIFEM::setup_pre_reverse(int, int)
{
  make_forces(0.0);
}

void FixHVIFEM::setup(int /*vflag*/)
{
  find_probes();
  show_particles();
  if (every > 0) list_elements();
  going_on = false;    // from now on forces are made anew
  check_drag();
  check_fixes();
}

/* ----------------------------------------------------------------------
   The drag takes 16 eps c dt/l of an hourglass's speed in a step, in cubes 9 eps times the step in
   units of the stable one: with 2, less half the square of its frequency times dt, it grows.  A tenth
   leaves room for distorted elements.  Where the step is chosen, courant bounds it: read_options().
------------------------------------------------------------------------- */

void FixHVIFEM::check_drag()
{
  if (!modify->get_fix_by_style("^(hvi/dt|dt/reset)$").empty()) return;
  double stable;
  MPI_Allreduce(&shortest, &stable, 1, MPI_DOUBLE, MPI_MIN, world);
  if (options.viscous * update->dt > MOST_DRAG * stable)
    error->all(
        FLERR,
        "Fix hvi/fem hourglass/viscous {} with a timestep of {:.3g} times the stable one of the "
        "elements: their product must be at most {}, or the drag may be unstable",
        options.viscous, update->dt / stable, MOST_DRAG);
}

/* ----------------------------------------------------------------------
   Forces of fixes come after those of elements have gone to nodes.  What acts on nodes, of a body as gravity
   say, is all that there is; what acts on particles in them only would be lost.
------------------------------------------------------------------------- */

void FixHVIFEM::check_fixes()
{
  std::vector<int> of_nodes(nodes.size()), of_particles(inside.size());
  const auto pack = [this](int i, double *b) {
    b[0] = atom->mask[i];
  };
  nodes.gather(1, pack, [&](int k, const double *b) {
    of_nodes[k] = b[0];
  });
  particles.gather(1, pack, [&](int k, const double *b) {
    of_particles[k] = b[0];
  });
  for (const Fix *const fix : modify->get_fix_list()) {
    if (!(modify->fmask[modify->find_fix(fix->id)] & POST_FORCE)) continue;
    bigint lost = 0, everywhere;
    for (std::size_t k = 0; k < inside.size(); k++) {
      int on_nodes = 0;
      for (int a = 0; a < CORNERS; a++) on_nodes |= of_nodes[corner[CORNERS * inside[k].e + a]];
      lost += (of_particles[k] & fix->groupbit) && !(on_nodes & fix->groupbit);
    }
    MPI_Allreduce(&lost, &everywhere, 1, MPI_LMP_BIGINT, MPI_SUM, world);
    if (everywhere)
      error->all(
          FLERR,
          "Fix hvi/fem: what fix {} ({}) does to {} particles in elements would be lost: fixes "
          "act on elements by their nodes, which its group {} must have, too",
          fix->id, fix->style, everywhere, group->names[fix->igroup]);
  }
}

/* ----------------------------------------------------------------------
   whether particles in elements have forces or energy of pairs of other styles, or of bonds
------------------------------------------------------------------------- */

bool FixHVIFEM::find_others() const
{
  if (force->bond || force->angle || force->dihedral || force->improper || force->kspace)
    return true;
  for (Pair *const pair : HVI::pair_styles(force)) {
    if (pair == force->pair_match("^hvi/sph$", 0)) continue;
    for (int itype = 1; itype <= atom->ntypes; itype++)
      for (int jtype = 1; jtype <= atom->ntypes; jtype++)
        if (inner[itype] && HVI::acts(force, pair, itype, jtype)) return true;
  }
  return false;
}

// tables of nodes are others when particles have been exchanged

void FixHVIFEM::pre_neighbor()
{
  keep_on_planes();
  connect();
  gather_nodes();
}

/* ----------------------------------------------------------------------
   fix hvi/sph has moved the nodes.  What forces have worked, failures, and particles to their places
------------------------------------------------------------------------- */

void FixHVIFEM::post_integrate()
{
  gather_nodes();
  half_energy(update->dt);
  std::vector<char> freed;
  if (options.fails) release(freed);
  place_particles(freed);
}

/* ----------------------------------------------------------------------
   Half of a step's energy.  Forces on nodes work on the velocity v of the middle of the step, in both
   halves: that is what kinetic energy changes by, but for dt^2/8 f^2/m, which cancels between a
   step and the next if they are as long; what is left is given back, and at output all of it, see
   internal_energy().  Of pairs
   particles have gained de, and forces worked f.w on them at the velocity that pairs have seen; on v
   it is another work.
------------------------------------------------------------------------- */

void FixHVIFEM::half_energy(double dt)
{
  for (std::size_t e = 0; e < elements.size(); e++) {
    if (!alive(e)) continue;
    Element &one = elements[e];
    double work = 0.0, kick = 0.0;
    for (int a = 0; a < CORNERS; a++) {
      const double *const n = at(e, a);
      for (int k = 0; k < 3; k++)
        work += (one.force[3 * a + k] + one.pair_force[3 * a + k]) * n[V + k];
      kick += n[KICK];
    }
    one.change = 0.5 * dt * (one.power - work) / one.mass;
    one.e += one.change + kick / CORNERS;
    one.ahead = one.e + one.change;
  }
}

// the second half: forces have worked on velocities that have not changed since they were made

void FixHVIFEM::final_integrate()
{
  dt_last = update->dt;
  for (std::size_t e = 0; e < elements.size(); e++) {
    if (!alive(e)) continue;
    Element &one = elements[e];
    one.change = 0.5 * dt_last * (one.power - now[e].work) / one.mass;
    one.e += one.change;
  }
}

/* ----------------------------------------------------------------------
   what output sees of particles in elements: velocity of the end of the step, and all of their state
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
  nodes.gather(
      4,
      [this](int i, double *b) {
        std::copy_n(atom->v[i], 3, b);
        b[3] = half_kick(i);
      },
      [this](int k, const double *b) {
        std::copy_n(b, 3, &node[NODE * k + W]);
        node[NODE * k + KICK] = dt_last * dt_last * b[3];
      });
  for (std::size_t e = 0; e < elements.size(); e++) {
    if (!alive(e)) continue;
    elements[e].mark = fingerprint(e);
    elements[e].step = dt_last;
    std::copy_n(now[e].L, 9, elements[e].L);
    elements[e].kick = 0.0;
    for (int a = 0; a < CORNERS; a++) elements[e].kick += at(e, a)[KICK] / CORNERS;
  }
  particles.scatter(
      3,
      [this](int k, double *b) {
        const Member &m = inside[k];
        std::fill_n(b, 3, 0.0);
        if (!alive(m.e)) {
          b[0] = NAN;
          return;
        }
        const auto &N = subcells[elements[m.e].n][m.p];
        for (int a = 0; a < CORNERS; a++)
          for (int d = 0; d < 3; d++) b[d] += N[a] * at(m.e, a)[W + d];
      },
      [this](int i, const double *b) {
        if (!std::isnan(b[0])) std::copy_n(b, 3, atom->v[i]);
      });
  show_states(true);
  read_probes();
}

// dt^2/8 f^2/m per mass, over dt^2: half kicks give that beyond the work on the velocity of the middle of a step

double FixHVIFEM::half_kick(int i) const
{
  const double *const f = atom->f[i], m = atom->rmass[i];
  return 0.125 * (f[0] * f[0] + f[1] * f[1] + f[2] * f[2]) / (m * m);
}

// of its nodes: an element that goes on has forces of its own at the start of a run

double FixHVIFEM::fingerprint(std::size_t e) const
{
  std::uint64_t mark = 0x9E3779B97F4A7C15ull;
  for (int a = 0; a < CORNERS; a++)
    for (int k = 0; k < 3; k++) {
      std::uint64_t bits;
      memcpy(&bits, at(e, a) + W + k, sizeof(bits));
      mark = (mark ^ bits) * 0xFF51AFD7ED558CCDull;
      mark ^= mark >> 32;
    }
  return (double) (mark >> 12) + 1.0;    // with all digits in data files
}

/* ---------------------------------------------------------------------- */

void FixHVIFEM::tighten(HVI::TimeStepBounds &bounds)
{
  if (!(options.courant * shortest >= bounds.stable)) bounds.stable = options.courant * shortest;
}

/* ---------------------------------------------------------------------- */
