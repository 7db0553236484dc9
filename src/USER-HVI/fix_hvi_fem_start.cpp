/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

// what elements and their nodes must be when a run begins: new ones, and those of a run before

#include "fix_hvi_fem.h"

#include "atom.h"
#include "error.h"
#include "fix_hvi_johnson_cook.h"
#include "fix_hvi_store.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using HVI::CORNERS;

/* ----------------------------------------------------------------------
   of types, as pair styles and fixes have them for this run
------------------------------------------------------------------------- */

void FixHVIFEM::find_laws()
{
  mechanics.laws.assign(atom->ntypes + 1, {nullptr, nullptr});
  for (int itype = 1; itype <= atom->ntypes; itype++)
    if (const HVI::Material *const material = coupling.store->materials.of(itype))
      mechanics.laws[itype] = {material->eos.get(), coupling.strength->model(itype)};
  for (const Element &one : elements) {
    if (!mechanics.laws[one.type].eos || is_node(one.type))
      error->one(FLERR, "Fix hvi/fem: type {} of element {} has no material", one.type, one.id);
    if (!mechanics.laws[one.type].solid)
      error->one(FLERR,
                 "Fix hvi/fem: element {} has type {}, which is no solid for fix hvi/johnson-cook",
                 one.id, one.type);
  }
}

/* ----------------------------------------------------------------------
   Elements without a mass are new: at rest in their material.  So is a particle without one of its own.  Masses of
   nodes and embedded particles are those that elements give them, or momentum would not be that of the material.
------------------------------------------------------------------------- */

void FixHVIFEM::start_elements()
{
  struct Mass {
    double given, all;    // by new elements, by all
  };
  double *const rmass = atom->rmass;
  for (int i = 0; i < atom->nlocal; i++)
    if (rmass[i] == 0.0 && !nodal(i) && !(atom->mask[i] & coupling.store->embedded))
      rmass[i] = atom->mass[atom->type[i]];

  std::vector<Mass> node_mass(nodes.size(), {0.0, 0.0}), embedded_mass;
  double least = HUGE_VAL;
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
    for (int a = 0; a < CORNERS; a++) {
      Mass &node = node_mass[number(e, a)];
      node.given += is_new ? one.mass / CORNERS : 0.0;
      node.all += one.mass / CORNERS;
    }
    const double mass = one.mass / one.particles();
    embedded_mass.resize(embedded_mass.size() + one.particles(), {is_new ? mass : 0.0, mass});
    least = std::min(least, std::cbrt(one.V0));
  }
  std::vector<double> should(atom->nlocal, 0.0);
  of_nodes.scatter(node_mass, [&](int i, const Mass &mass) {
    coupling.check_group(i);
    rmass[i] += mass.given;
    should[i] += mass.all;
  });
  of_embedded.scatter(embedded_mass, [&](int i, const Mass &mass) {
    if (mass.given > 0.0) rmass[i] = mass.given;
    should[i] = mass.all;
  });
  bigint without = 0, everywhere;
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
    if (const auto *const begun =
            HVI::SolidModel::misread(mechanics.laws[one.type].solid, one.solid))
      error->one(FLERR,
                 "Fix hvi/fem: element {} of type {} has {}, by {}, which its type does not have "
                 "in this run: give fix hvi/johnson-cook the keywords, and the type the material "
                 "file, of the run that its state is from",
                 one.id, one.type, begun->what, begun->law);
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
  if (coupling.strayed()) here = 0;    // all ranks ask
  MPI_Allreduce(&here, &all, 1, MPI_INT, MPI_MIN, world);
  goes_on = all;
  double step = 0.0;
  if (goes_on)
    for (const Element &one : elements) step = std::max(step, one.step);
  MPI_Allreduce(&step, &dt_last, 1, MPI_DOUBLE, MPI_MAX, world);
  if (goes_on) return;
  for (Element &one : elements) {
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
  if (!modify->get_fix_by_style("^(hvi/dt|dt/reset)$").empty()) return;
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
