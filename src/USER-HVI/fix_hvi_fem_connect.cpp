/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

// who is where: elements, their nodes and particles, at the start of a run and after each exchange of particles; the
// rest of the class is in fix_hvi_fem.cpp

#include "fix_hvi_fem.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_hvi_johnson_cook.h"
#include "fix_hvi_sph.h"
#include "fix_hvi_store.h"
#include "hvi_compat.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using HVI::CORNERS;

/* ----------------------------------------------------------------------
   who is where, after particles have been exchanged
------------------------------------------------------------------------- */

void FixHVIFEM::connect()
{
  link();
  std::vector<tagint> wanted, held_ids;
  inside.clear();
  corner.resize(CORNERS * elements.size());
  place.assign(elements.size(), -1);
  for (std::size_t e = 0; e < elements.size(); e++) {
    const Element &one = elements[e];
    wanted.insert(wanted.end(), one.node, one.node + CORNERS);
    if (one.n > 0) place[e] = inside.size();
    for (int p = 0; p < one.particles(); p++) {
      inside.push_back({(int) e, p});
      held_ids.push_back(one.first + p);
    }
    if (one.n >= (int) subcells.size()) subcells.resize(one.n + 1);
    if (one.n > 0 && subcells[one.n].empty()) subcells[one.n] = HVI::hex_subcells(one.n);
  }

  // each node once

  std::vector<tagint> unique = wanted;
  std::sort(unique.begin(), unique.end());
  unique.erase(std::unique(unique.begin(), unique.end()), unique.end());
  for (std::size_t k = 0; k < wanted.size(); k++)
    corner[k] = std::lower_bound(unique.begin(), unique.end(), wanted[k]) - unique.begin();

  const bigint here = elements.size();
  bigint all;
  MPI_Allreduce(&here, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  const tagint lost_node = nodes.connect(unique, [this](int i) {
    return is_node(atom->type[i]);
  });
  const tagint lost = particles.connect(held_ids, [this](int i) {
    return !is_node(atom->type[i]);
  });
  if (lost_node || lost || all != total)
    error->all(FLERR,
               "Fix hvi/fem: {} is not there at step {}: elements, their nodes and particles must "
               "not leave the box, nor be deleted, and nodes are of types that the fix names, "
               "particles of others",
               lost_node ? fmt::format("node {}", lost_node)
                         : (lost ? fmt::format("particle {}", lost) : "an element"),
               update->ntimestep);

  std::vector<double> uses(unique.size(), 0.0);
  for (const int k : corner) uses[k] += 1.0;
  std::fill_n(users, atom->nlocal, 0);
  nodes.scatter(
      1,
      [&](int k, double *b) {
        b[0] = uses[k];
      },
      [this](int i, const double *b) {
        users[i] += b[0];
      });
}

/* ----------------------------------------------------------------------
   elements by their first nodes, without those that are no more
------------------------------------------------------------------------- */

void FixHVIFEM::link()
{
  // chains hang on particles, whatever their IDs are

  for (int i = 0; i < atom->nlocal; i++)
    for (int e = head[i]; e >= 0; e = next[e])
      if (alive(e) && elements[e].node[0] != atom->tag[i]) ids_have_changed(atom->tag[i]);

  elements.erase(std::remove_if(elements.begin(), elements.end(),
                                [](const Element &one) {
                                  return one.type <= 0;
                                }),
                 elements.end());

  // in an order that does not depend on how they came here: sums are the same after a restart

  std::sort(elements.begin(), elements.end(), [](const Element &one, const Element &two) {
    return one.id < two.id;
  });
  const auto twice = std::adjacent_find(elements.begin(), elements.end(),
                                        [](const Element &one, const Element &two) {
                                          return one.id == two.id;
                                        });
  if (twice != elements.end())
    error->one(FLERR, "Fix hvi/fem: two elements have the ID {}", twice->id);
  next.assign(elements.size(), -1);
  read_head.clear();
  std::fill_n(head, atom->nlocal, -1);
  std::vector<int> number(atom->nlocal, 0);
  int most = 0;
  for (int e = elements.size() - 1; e >= 0; e--) {
    const int i = nodes.local(elements[e].node[0]);
    if (i < 0 || i >= atom->nlocal)
      error->one(FLERR,
                 "Fix hvi/fem: node {} of element {} is not there at step {}: elements must not "
                 "leave the box",
                 elements[e].node[0], elements[e].id, update->ntimestep);
    next[e] = head[i];
    head[i] = e;
    most = std::max(most, ++number[i]);
  }

  // the same on all ranks: one hands on what it has just got

  int most_of_all;
  MPI_Allreduce(&most, &most_of_all, 1, MPI_INT, MPI_MAX, world);
  maxexchange = 2 + std::max(most_of_all, 1) * Element::SIZE;
}

void FixHVIFEM::ids_have_changed(tagint id) const
{
  error->one(FLERR,
             "Fix hvi/fem: particle {} had another ID, or was in another group, in the last run: "
             "elements know nodes and particles by ID: use delete_atoms ... compress no, not "
             "reset_atoms id, and leave group {}_embedded alone",
             id, this->id);
}

/* ----------------------------------------------------------------------
   Groups say which particles are in elements, and which of those lists leave out.  Not in restarts of
   other fixes, nor in data files.
------------------------------------------------------------------------- */

void FixHVIFEM::mark_particles()
{
  connect();
  flags.assign(atom->nlocal, 0);
  int here = 0, known;    // a data file has no groups
  for (int i = 0; i < atom->nlocal; i++) here |= flags[i] = atom->mask[i] & held;
  MPI_Allreduce(&here, &known, 1, MPI_INT, MPI_MAX, world);
  unmark_particles();
  particles.scatter(
      2,
      [this](int k, double *b) {
        b[0] = elements[inside[k].e].type;
        b[1] = elements[inside[k].e].mark;
      },
      [this, known](int i, const double *b) {
        const int itype = b[0];
        if (atom->type[i] != itype)
          error->one(FLERR,
                     "Fix hvi/fem: particle {} in an element of type {} has type {}: have IDs "
                     "changed? Use delete_atoms with compress no",
                     atom->tag[i], itype, atom->type[i]);
        if (atom->mask[i] & held)
          error->one(FLERR, "Fix hvi/fem: particle {} is in two elements", atom->tag[i]);
        if (b[1] > 0.0 && known && !flags[i]) ids_have_changed(atom->tag[i]);
        check_group(i);
        atom->mask[i] |= held | inner[itype];
      });
}

void FixHVIFEM::unmark_particles()
{
  int bits = held;
  for (const int bit : inner) bits |= bit;
  for (int i = 0; i < atom->nlocal; i++) atom->mask[i] &= ~bits;
}

void FixHVIFEM::check_group(int i) const
{
  if (!(atom->mask[i] & integrator->groupbit))
    error->one(FLERR,
               "Fix hvi/fem: {} {} is not in the group of fix hvi/sph, which moves all nodes, and "
               "particles when their elements fail",
               is_node(atom->type[i]) ? "node" : "particle", atom->tag[i]);
}

/* ----------------------------------------------------------------------
   Elements without a mass are new: at rest in their material.  So is a particle without one of its own.
------------------------------------------------------------------------- */

void FixHVIFEM::start_elements()
{
  gather_nodes();
  double *const rmass = atom->rmass;
  for (int i = 0; i < atom->nlocal; i++)
    if (rmass[i] == 0.0 && !is_node(atom->type[i]) && !(atom->mask[i] & held))
      rmass[i] = atom->mass[atom->type[i]];

  std::vector<double> added(nodes.size(), 0.0), given(inside.size(), 0.0);
  for (std::size_t e = 0; e < elements.size(); e++) {
    Element &one = elements[e];
    if (one.mass > 0.0) continue;
    const HVI::Material *const material = store->materials.of(one.type);
    if (!material || is_node(one.type))
      error->one(FLERR, "Fix hvi/fem: type {} of element {} has no material", one.type, one.id);
    HVI::HexNodes x, B;
    load(e, 1, X, x);
    one.V = one.V0 = HVI::hex_gradient(x, B)[0];
    double places[CORNERS][3];
    corners(e, X, places);
    if (!(one.V > 0.0) || !(HVI::hex_shape(places).jacobian > 0.0))
      error->one(FLERR,
                 "Fix hvi/fem: element {} is turned inside out or has no volume: its nodes must be "
                 "numbered around the bottom and then above it, seen from inside against the clock",
                 one.id);
    one.rho = material->eos->rho0();
    one.mass = one.rho * one.V;
    one.s = HVI::SolidModel::blank();
    model(one).start(one.s, input(one), true);
    for (int a = 0; a < CORNERS; a++) added[corner[CORNERS * e + a]] += one.mass / CORNERS;
    for (int p = 0; p < one.particles(); p++) given[place[e] + p] = one.mass / one.particles();
  }
  nodes.scatter(
      1,
      [&](int k, double *b) {
        b[0] = added[k];
      },
      [&](int i, const double *b) {
        check_group(i);
        rmass[i] += b[0];
      });
  particles.scatter(
      1,
      [&](int k, double *b) {
        b[0] = given[k];
      },
      [&](int i, const double *b) {
        if (b[0] > 0.0) rmass[i] = b[0];
      });
  check_masses();

  // on mirror planes to the last digit

  const HVI::MirrorPlanes &mirror = store->fields.settings.mirror;
  double here = HUGE_VAL;
  for (const Element &one : elements) here = std::min(here, std::cbrt(one.V0));
  MPI_Allreduce(&here, &smallest, 1, MPI_DOUBLE, MPI_MIN, world);
  for (int i = 0; i < atom->nlocal; i++) {
    if (!is_node(atom->type[i])) continue;
    for (int k = 0; k < 3; k++) {
      if (!mirror.has(k)) continue;
      const double depth = mirror.depth(k, atom->x[i]);
      if (std::fabs(depth) <= 1.0e-6 * smallest)
        atom->x[i][k] = mirror.at[k];
      else if (depth < 0.0)
        error->one(FLERR, "Fix hvi/fem: node {} is beyond the mirror plane {}", atom->tag[i],
                   "xyz"[k]);
    }
  }
}

/* ----------------------------------------------------------------------
   Nodes on mirror planes stay on them to the last digit: balancing by shifts takes all places to
   fractions of the box and back, which rounds them
------------------------------------------------------------------------- */

void FixHVIFEM::keep_on_planes()
{
  const HVI::MirrorPlanes &mirror = store->fields.settings.mirror;
  if (!mirror.planes) return;
  for (int i = 0; i < atom->nlocal + atom->nghost; i++)
    for (int k = 0; k < 3; k++)
      if (is_node(atom->type[i]) && mirror.has(k) &&
          std::fabs(mirror.depth(k, atom->x[i])) <= 1.0e-9 * smallest)
        atom->x[i][k] = mirror.at[k];
}

/* ----------------------------------------------------------------------
   Masses of nodes and particles are those that elements gave them, or momentum would not be that of the
   material
------------------------------------------------------------------------- */

void FixHVIFEM::check_masses()
{
  std::vector<double> share(nodes.size(), 0.0), should(atom->nlocal, 0.0);
  for (std::size_t k = 0; k < corner.size(); k++)
    share[corner[k]] += elements[k / CORNERS].mass / CORNERS;
  nodes.scatter(
      1,
      [&](int k, double *b) {
        b[0] = share[k];
      },
      [&](int i, const double *b) {
        should[i] += b[0];
      });
  particles.scatter(
      1,
      [this](int k, double *b) {
        const Element &one = elements[inside[k].e];
        b[0] = one.mass / one.particles();
      },
      [&](int i, const double *b) {
        should[i] = b[0];
      });
  bigint without = 0, everywhere;
  for (int i = 0; i < atom->nlocal; i++) {
    if (is_node(atom->type[i]) && users[i] == 0 && total > 0 && !left_over(i)) without++;
    if (should[i] > 0.0 && std::fabs(atom->rmass[i] - should[i]) > 1.0e-9 * should[i])
      error->one(
          FLERR,
          "Fix hvi/fem: {} {} has mass {}, but its elements {}: they give masses to nodes and "
          "particles, which must not have others",
          is_node(atom->type[i]) ? "node" : "particle", atom->tag[i], atom->rmass[i], should[i]);
  }
  MPI_Allreduce(&without, &everywhere, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (everywhere) error->all(FLERR, "Fix hvi/fem: {} nodes belong to no element", everywhere);
}

/* ----------------------------------------------------------------------
   Elements of a run that goes on where the last one ended have the forces of its end; if a command has changed
   any node or particle since, all are made anew.  Then density goes by volume: what pairs have told stays.
------------------------------------------------------------------------- */

void FixHVIFEM::check_state()
{
  const HVI::MirrorPlanes &mirror = store->fields.settings.mirror;
  for (int i = 0; i < atom->nlocal; i++)
    for (int k = 0; k < 3; k++)
      if (is_node(atom->type[i]) && mirror.has(k) && atom->x[i][k] == mirror.at[k] &&
          atom->v[i][k] != 0.0)
        error->one(FLERR,
                   "Fix hvi/fem: node {} is on the mirror plane {} and moves across it: set its "
                   "velocity there to 0",
                   atom->tag[i], "xyz"[k]);
  int here = 1, all;
  for (std::size_t e = 0; e < elements.size(); e++) {
    Element &one = elements[e];
    HVI::HexNodes x, B;
    load(e, 1, X, x);
    const double volume = HVI::hex_gradient(x, B)[0];
    if (const auto *const begun = HVI::SolidModel::misread(&model(one), one.s))
      error->one(FLERR,
                 "Fix hvi/fem: element {} of type {} has {}, by {}, which its type does not have "
                 "in this run: give fix hvi/johnson-cook the keywords, and the type the material "
                 "file, of the run that its state is from",
                 one.id, one.type, begun->what, begun->law);
    if (one.mark != fingerprint(e)) here = 0;
    if (std::fabs(volume - one.V) > 1.0e-9 * one.V) {
      here = 0;
      if (!(volume > 0.0))
        error->one(FLERR, "Fix hvi/fem: element {} is turned inside out since the last run",
                   one.id);
      one.rho *= one.V / volume;
      one.V = volume;
    }
  }
  if (strayed()) here = 0;    // all ranks ask
  MPI_Allreduce(&here, &all, 1, MPI_INT, MPI_MIN, world);
  going_on = all;
  double step = 0.0;
  if (going_on)
    for (const Element &one : elements) step = std::max(step, one.step);
  MPI_Allreduce(&step, &dt_last, 1, MPI_DOUBLE, MPI_MAX, world);
  if (going_on) return;
  for (Element &one : elements) {
    one.ahead = one.e;
    one.power = one.q = 0.0;
    std::fill_n(one.force, 3 * CORNERS, 0.0);
    std::fill_n(one.pair_force, 3 * CORNERS, 0.0);
  }
}

// what is left of a node that no element needs any more, see let_go(); its type's mass says no more than its order

bool FixHVIFEM::left_over(int i) const
{
  return atom->rmass[i] > 0.0 && atom->rmass[i] < 1.0e-20 * atom->mass[atom->type[i]];
}

// has a command moved particles, or their nodes without them?

bool FixHVIFEM::strayed()
{
  bool found = false;
  particles.gather(
      6,
      [this](int i, double *b) {
        std::copy_n(atom->x[i], 3, b);
        std::copy_n(atom->v[i], 3, b + 3);
      },
      [&](int k, const double *b) {
        const Member &m = inside[k];
        double x[CORNERS][3], v[CORNERS][3], way[3], past[3] = {0.0, 0.0, 0.0}, speed = 0.0;
        corners(m.e, X, x);
        corners(m.e, W, v);
        const auto &N = subcells[elements[m.e].n][m.p];
        for (int d = 0; d < 3; d++) {
          way[d] = -b[d];
          for (int a = 0; a < CORNERS; a++) {
            way[d] += N[a] * x[a][d];
            past[d] += N[a] * v[a][d];
            speed = std::max(speed, std::fabs(v[a][d]));
          }
          past[d] -= b[3 + d];
        }
        HVI::minimum_image(domain, way[0], way[1], way[2]);
        const double size = std::cbrt(elements[m.e].V);
        for (int d = 0; d < 3; d++)
          if (std::fabs(way[d]) > 1.0e-9 * size || std::fabs(past[d]) > 1.0e-9 * speed)
            found = true;
      });
  return found;
}

/* ----------------------------------------------------------------------
   Of nodes, from their owners.  KICK: what half kicks leave in kinetic energy when the step changes
------------------------------------------------------------------------- */

void FixHVIFEM::gather_nodes()
{
  const double *const *const x = atom->x, *const *const v = atom->v;
  const double *const *const vest = atom->vest;
  const double factor = (update->dt * update->dt - dt_last * dt_last);
  node.resize(NODE * nodes.size());
  nodes.gather(
      NODE,
      [&](int i, double *b) {
        std::copy_n(x[i], 3, b + X);
        std::copy_n(v[i], 3, b + V);
        std::copy_n(vest[i], 3, b + W);
        b[KICK] = factor * half_kick(i);
        b[USERS] = users[i];
      },
      [this](int k, const double *b) {
        memcpy(&node[NODE * k], b, NODE * sizeof(double));
      });
}
