/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

// particles in elements: which of them pairs see, where they are, and elements that become particles; the rest of
// the class is in fix_hvi_fem.cpp

#include "fix_hvi_fem.h"

#include "atom.h"
#include "atom_vec.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_hvi_johnson_cook.h"
#include "fix_hvi_ledger.h"
#include "fix_hvi_sph.h"
#include "fix_hvi_store.h"
#include "force.h"
#include "hvi_compat.h"
#include "neigh_list.h"
#include "pair.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using HVI::CORNERS;

/* ----------------------------------------------------------------------
   After lists have been made: an element is active if something in them acts on its particles, that is,
   what is free, or of another body; only then its particles have sums and forces.  So
   there are new lists whenever elements fail: those beside them are to become active.
------------------------------------------------------------------------- */

void FixHVIFEM::post_neighbor()
{
  HVI::SphFields &fields = store->fields;
  const int nall = atom->nlocal + atom->nghost;
  fields.embedded.assign(nall, 0);
  fields.idle.assign(nall, 0);
  for (int i = 0; i < nall; i++)
    if (atom->mask[i] & held) fields.embedded[i] = atom->type[i];

  flags.assign(nall, 0);
  const NeighList *const list = force->pair_match("^hvi/sph$", 0)->list;
  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii], itype = fields.embedded[i];
    for (int jj = 0; jj < list->numneigh[i]; jj++) {
      const int j = list->firstneigh[i][jj] & NEIGHMASK, jtype = fields.embedded[j];
      if (itype && itype == jtype) continue;
      if (itype) flags[i] = 1;
      if (jtype) flags[j] = 1;
    }
  }
  if (force->newton_pair) comm->reverse_comm(this);

  active.assign(elements.size(), 0);
  particles.gather(
      1,
      [&](int i, double *b) {
        b[0] = flags[i];
      },
      [this](int k, const double *b) {
        if (b[0] > 0.0) active[inside[k].e] = 1;
      });

  // others have none of what comes from pairs, until they are active

  now.assign(elements.size(), Now());
  for (std::size_t e = 0; e < elements.size(); e++) {
    if (active[e]) continue;
    elements[e].power = 0.0;
    std::fill_n(elements[e].pair_force, 3 * CORNERS, 0.0);
  }

  members.clear();
  std::vector<tagint> wanted;
  for (std::size_t e = 0; e < elements.size(); e++) {
    if (!active[e]) continue;
    for (int p = 0; p < elements[e].particles(); p++) {
      members.push_back({(int) e, p});
      wanted.push_back(elements[e].first + p);
    }
  }
  near.connect(wanted, [this](int i) {
    return (atom->mask[i] & held) != 0;
  });

  flags.assign(nall, 0);
  particles.scatter(
      1,
      [this](int k, double *b) {
        b[0] = active[inside[k].e];
      },
      [this](int i, const double *b) {
        flags[i] = b[0] == 0.0;
      });
  comm->forward_comm(this);
  fields.idle.assign(flags.begin(), flags.end());
}

/* ----------------------------------------------------------------------
   To their places, with velocity and what pairs and lists see of density and energy.  Who leaves an element
   keeps all that.
------------------------------------------------------------------------- */

void FixHVIFEM::place_particles(const std::vector<char> &freed)
{
  rows.resize(PLACE * inside.size());
  for (std::size_t e = 0; e < elements.size(); e++) {
    if (place[e] < 0) continue;
    const Element &one = elements[e];
    double y[CORNERS][RHO];    // x, v, w
    for (int a = 0; a < CORNERS; a++) memcpy(y[a], at(e, a), RHO * sizeof(double));
    if (wraps) {
      double x[CORNERS][3];
      corners(e, X, x);
      for (int a = 0; a < CORNERS; a++) std::copy_n(x[a], 3, y[a]);
    }
    const auto &weights = subcells[one.n];
    for (std::size_t p = 0; p < weights.size(); p++) {
      double *const row = &rows[PLACE * (place[e] + p)];
      double sum[RHO] = {};
      for (int a = 0; a < CORNERS; a++)
        for (int k = 0; k < RHO; k++) sum[k] += weights[p][a] * y[a][k];
      memcpy(row, sum, sizeof(sum));
      row[RHO] = one.rho;
      row[FLAG] = !freed.empty() && freed[e] ? IS_FREE : (alive(e) ? STAYS : IS_NO_MORE);
      row[ESPH] = one.ahead * one.mass / one.particles();
      row[AHEAD] = one.change * one.mass / one.particles();
    }
  }
  particles.scatter(
      PLACE,
      [this](int k, double *b) {
        memcpy(b, &rows[PLACE * k], PLACE * sizeof(double));
      },
      [this](int i, const double *b) {
        if (b[FLAG] == IS_NO_MORE) return;
        double *const x = atom->x[i];
        double way[3] = {b[X] - x[0], b[X + 1] - x[1], b[X + 2] - x[2]};
        if (wraps) HVI::minimum_image(domain, way[0], way[1], way[2]);
        for (int k = 0; k < 3; k++) {
          x[k] += way[k];
          atom->v[i][k] = atom->vest[i][k] = b[V + k];
        }
        atom->rho[i] = b[RHO];
        atom->esph[i] = b[ESPH];
        integrator->carry(i, b + W);
        if (b[FLAG] == IS_FREE) {    // this rank may have no element itself
          atom->mask[i] &= ~(held | inner[atom->type[i]]);
          integrator->let_go(i, b[AHEAD]);
          ledger->hand_over(i, atom->rmass[i]);
          if (i < (int) store->fields.embedded.size()) store->fields.embedded[i] = 0;
        }
      });
}

// how many corners other elements have, too

int FixHVIFEM::shared(std::size_t e) const
{
  int n = 0;
  for (int a = 0; a < CORNERS; a++) n += at(e, a)[USERS] > 1.0;
  return n;
}

/* ----------------------------------------------------------------------
   Why an element becomes particles: the material has failed, or the element's shape
------------------------------------------------------------------------- */

FixHVIFEM::Reason FixHVIFEM::reason(std::size_t e) const
{
  const Element &one = elements[e];
  if (options.damage && one.s.damage >= 1.0) return DAMAGE;
  if (options.spall && one.s.spalled != 0.0) return SPALL;
  if (options.strain > 0.0 && one.s.eps > options.strain) return STRAIN;
  if (one.stable < options.shrink * one.at_start) return STEP;
  const int others = shared(e);
  if (others < 4 && others < one.shared) return ORPHAN;    // a face has four
  if (one.s.eps > 0.0 || one.s.failed()) {
    double x[CORNERS][3];
    corners(e, X, x);
    const HVI::HexShape shape = HVI::hex_shape(x);
    if (shape.jacobian < options.jacobian || shape.edges > options.edges) return SHAPE;
  }
  return NONE;
}

/* ----------------------------------------------------------------------
   In the middle of a step, with the state of its begin: an element that has failed leaves its particles to
   themselves.  Nodes lose its part of their mass, particles have as much, and the same momentum; kinetic
   energy of what nodes did against each other is heat.
------------------------------------------------------------------------- */

void FixHVIFEM::release(std::vector<char> &freed)
{
  enum { FREED, STATES, N };
  int here[N] = {0, 0}, all[N];
  freed.assign(elements.size(), 0);
  for (std::size_t e = 0; e < elements.size(); e++) {
    Element &one = elements[e];
    if (!alive(e) || one.n == 0) continue;
    const Reason why = reason(e);
    if (why == NONE) continue;
    freed[e] = 1;
    here[FREED]++;
    if (!active[e]) here[STATES] = 1;
    double of_nodes = 0.0, of_particles = 0.0;
    for (int a = 0; a < CORNERS; a++)
      for (int k = 0; k < 3; k++) of_nodes += at(e, a)[V + k] * at(e, a)[V + k] / CORNERS;
    for (const auto &N_a : subcells[one.n])
      for (int k = 0; k < 3; k++) {
        double v = 0.0;
        for (int a = 0; a < CORNERS; a++) v += N_a[a] * at(e, a)[V + k];
        of_particles += v * v / one.particles();
      }
    const double heat = 0.5 * (of_nodes - of_particles);
    one.e += heat;
    one.ahead += heat;
    model(one).present(one.s, input(one));    // what forces see of it in this step
    count[why] += 1.0;
    count[HEAT] += one.mass * heat;
    count[HOURGLASS] += one.hourglass;
  }
  MPI_Allreduce(here, all, N, MPI_INT, MPI_SUM, world);
  if (!all[FREED]) {
    freed.clear();
    return;
  }
  total -= all[FREED];
  next_reneighbor = update->ntimestep;
  if (all[STATES]) show_states(true);
  let_go(freed);
}

// what of masses goes from nodes to particles

void FixHVIFEM::let_go(const std::vector<char> &freed)
{
  std::vector<double> lost(2 * nodes.size(), 0.0);
  for (std::size_t e = 0; e < elements.size(); e++) {
    if (!freed[e]) continue;
    for (int a = 0; a < CORNERS; a++) {
      lost[2 * corner[CORNERS * e + a]] += elements[e].mass / CORNERS;
      lost[2 * corner[CORNERS * e + a] + 1] += 1.0;
    }
    elements[e].type = 0;
  }
  nodes.scatter(
      2,
      [&](int k, double *b) {
        std::copy_n(&lost[2 * k], 2, b);
      },
      [this](int i, const double *b) {
        if (b[1] == 0.0) return;
        users[i] -= b[1];
        ledger->hand_over(i, -b[0]);
        if (users[i] > 0) {
          atom->rmass[i] -= b[0];
          return;
        }
        atom->rmass[i] *=
            1.0e-30;    // until it is taken out with the next lists: not 0, for others divide by it
        for (int k = 0; k < 3; k++) atom->v[i][k] = atom->vest[i][k] = 0.0;
      });
}

/* ----------------------------------------------------------------------
   Nodes that no element needs any more are taken out when particles are exchanged; as fix evaporate does, with
   ghosts forgotten and a new map: fix balance may migrate particles before LAMMPS does so itself
------------------------------------------------------------------------- */

void FixHVIFEM::pre_exchange()
{
  bigint here = 0, all;
  for (int i = 0; i < atom->nlocal; i++) here += is_node(atom->type[i]) && users[i] == 0;
  MPI_Allreduce(&here, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (!all) return;
  for (int i = atom->nlocal - 1; i >= 0; i--) {
    if (!is_node(atom->type[i]) || users[i] > 0) continue;
    atom->avec->copy(atom->nlocal - 1, i, 1);
    atom->nlocal--;
  }
  atom->natoms -= all;
  atom->nghost = 0;
  atom->map_init();
  atom->map_set();
}

/* ---------------------------------------------------------------------- */

int FixHVIFEM::pack_forward_comm(int n, int *list, double *buf, int /*pbc_flag*/, int * /*pbc*/)
{
  for (int k = 0; k < n; k++) buf[k] = flags[list[k]];
  return n;
}

void FixHVIFEM::unpack_forward_comm(int n, int first, double *buf)
{
  for (int k = 0; k < n; k++) flags[first + k] = buf[k];
}

int FixHVIFEM::pack_reverse_comm(int n, int first, double *buf)
{
  if (!beside.empty()) {
    memcpy(buf, &beside[first], n * sizeof(Beside));
    return n * sizeof(Beside) / sizeof(double);
  }
  for (int k = 0; k < n; k++) buf[k] = flags[first + k];
  return n;
}

void FixHVIFEM::unpack_reverse_comm(int n, int *list, double *buf)
{
  for (int k = 0; k < n; k++)
    if (!beside.empty()) {
      for (int d = 0; d < 3; d++) beside[list[k]].f[d] += buf[4 * k + d];
      beside[list[k]].power += buf[4 * k + 3];
    } else if (buf[k] != 0.0)
      flags[list[k]] = 1;
}
