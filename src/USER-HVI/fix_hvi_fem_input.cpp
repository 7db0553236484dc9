/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

// keywords of fix hvi/fem; the rest of the class is in fix_hvi_fem.cpp

#include "fix_hvi_fem.h"

#include "atom.h"
#include "error.h"
#include "group.h"

#include <algorithm>
#include <map>

using namespace LAMMPS_NS;
using namespace FixConst;

/* ---------------------------------------------------------------------- */

FixHVIFEM::FixHVIFEM(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), announced(-1), id_before(0), probed(-1), every(0), total(-1), held(0),
    store(nullptr), integrator(nullptr), strength(nullptr), ledger(nullptr), head(nullptr),
    users(nullptr), nodes(lmp), particles(lmp), near(lmp), dt_last(0.0), shortest(HVI::NO_BOUND),
    smallest(0.0), others(false), going_on(false), wraps(false), nearby(0.0), count()
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
  held = group->bitmask[group->find_or_create((std::string(id) + "_embedded").c_str())];

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
  restart_global = restart_peratom = 1;
  create_attribute = 1;
  force_reneighbor = 1;
  next_reneighbor = -1;
  comm_forward = 1;
  comm_reverse = sizeof(Beside) / sizeof(double);
  maxexchange_dynamic = 1;
  maxexchange = 2 + 8 * Element::SIZE;
  wd_header = 1;
  wd_section = 1 + (Element::SIZE - Element::IDS + 9) / 10;
  nevery = 1;

  FixHVIFEM::grow_arrays(atom->nmax);
  for (int i = 0; i < atom->nlocal; i++) set_arrays(i);
  atom->add_callback(Atom::GROW);
  atom->add_callback(Atom::RESTART);
}

/* ---------------------------------------------------------------------- */

void FixHVIFEM::read_options(int narg, char **arg)
{
  nodal.assign(atom->ntypes + 1, 0);
  const std::map<std::string, std::pair<double *, double>> numbers = {
      {"hourglass/viscous", {&options.viscous, 1.0}},
      {"hourglass/stiffness", {&options.stiffness, 1.0}},
      {"courant", {&options.courant, 1.0}},
      {"strain", {&options.strain, 100.0}},
      {"jacobian", {&options.jacobian, 1.0}},
      {"edges", {&options.edges, 1000.0}},
      {"step", {&options.shrink, 1.0}}};
  const std::map<std::string, bool *> switches = {
      {"convert", &options.fails}, {"damage", &options.damage}, {"spall", &options.spall}};
  int iarg = 3;
  const auto needs = [&](int n) {
    if (iarg + n >= narg)
      utils::missing_cmd_args(FLERR, std::string("fix hvi/fem ") + arg[iarg], error);
  };
  while (iarg < narg) {
    const std::string key = arg[iarg];
    if (key == "nodes") {
      needs(1);
      int lo, hi;
      utils::bounds(FLERR, arg[iarg + 1], 1, atom->ntypes, lo, hi, error);
      std::fill(nodal.begin() + lo, nodal.begin() + hi + 1, 1);
      iarg += 2;
    } else if (key == "probe") {
      needs(3);
      Probe probe = {};
      for (int k = 0; k < 3; k++) probe.x[k] = utils::numeric(FLERR, arg[iarg + 1 + k], false, lmp);
      probes.push_back(probe);
      iarg += 4;
    } else if (key == "local") {
      needs(1);
      every = utils::inumeric(FLERR, arg[iarg + 1], false, lmp);
      if (every < 1) error->all(FLERR, "Fix hvi/fem local must be above 0, not {}", every);
      iarg += 2;
    } else if (key == "viscosity") {
      needs(2);
      options.q1 = utils::numeric(FLERR, arg[iarg + 1], false, lmp);
      options.q2 = utils::numeric(FLERR, arg[iarg + 2], false, lmp);
      if (!(options.q1 >= 0.0) || !(options.q2 >= 0.0))
        error->all(FLERR, "Fix hvi/fem viscosity must not be negative: {} {}", options.q1,
                   options.q2);
      iarg += 3;
    } else if (switches.count(key)) {
      needs(1);
      *switches.at(key) = utils::logical(FLERR, arg[iarg + 1], false, lmp);
      iarg += 2;
    } else if (numbers.count(key)) {
      needs(1);
      const auto &number = numbers.at(key);
      *number.first = utils::numeric(FLERR, arg[iarg + 1], false, lmp);
      const double least = key == "edges" ? 1.0 : 0.0;
      if (!(*number.first >= least && *number.first <= number.second))
        error->all(FLERR, "Fix hvi/fem {} must be from {} to {}, not {}", key, least, number.second,
                   arg[iarg + 1]);
      iarg += 2;
    } else
      error->all(FLERR, "Unknown fix hvi/fem keyword: {}", key);
  }
  if (std::count(nodal.begin(), nodal.end(), 1) == 0)
    error->all(FLERR, "Fix hvi/fem needs the types of its nodes: nodes TYPE");
  if (!(options.courant > 0.0)) error->all(FLERR, "Fix hvi/fem courant must be above 0");

  if (options.viscous * options.courant > MOST_DRAG)    // why: check_drag()
    error->all(FLERR,
               "Fix hvi/fem hourglass/viscous times courant must be at most {}, or the drag may be "
               "unstable, not {} times {}",
               MOST_DRAG, options.viscous, options.courant);
}
