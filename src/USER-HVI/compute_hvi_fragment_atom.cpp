/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "compute_hvi_fragment_atom.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_hvi_johnson_cook.h"
#include "fix_hvi_store.h"
#include "force.h"
#include "group.h"
#include "hvi_excluded.h"
#include "memory.h"
#include "modify.h"
#include "neighbor.h"
#include "output.h"
#include "pair.h"
#include "region.h"
#include "thermo.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

using namespace LAMMPS_NS;

static constexpr char DAMAGE[] = "hvi_damage";
static constexpr double MOST_REACH =
    300.0;    // over that of the pair style: LAMMPS has no bins for more

// a node travels in the place of doubles

static constexpr int NODE_SIZE = sizeof(HVI::Components::Node) / sizeof(double);
static_assert(sizeof(HVI::Components::Node) == NODE_SIZE * sizeof(double));

/* ---------------------------------------------------------------------- */

ComputeHVIFragmentAtom::ComputeHVIFragmentAtom(LAMMPS *lmp, int narg, char **arg) :
    ComputeHVIFragmentAtom(lmp, narg, arg, 0)
{
  peratom_flag = 1;
  size_peratom_cols = 0;
}

/* ----------------------------------------------------------------------
   keywords: 1 if the derived class reads on at arg[iarg]
------------------------------------------------------------------------- */

ComputeHVIFragmentAtom::ComputeHVIFragmentAtom(LAMMPS *lmp, int narg, char **arg, int keywords) :
    ComputeHVIMatter(lmp, narg, arg), iarg(3), components(world), cutoff(0.0), mode(BONDS),
    damage(0), factor(0.0), nmax(0), fragment(nullptr), node(nullptr)
{
  comm_forward = NODE_SIZE;

  const std::string name = fmt::format("compute {}", style);
  if (narg < 4) utils::missing_cmd_args(FLERR, name, error);
  if (strcmp(arg[iarg], "bonds") == 0) {
    mode = BONDS;
    iarg++;
  } else if (strcmp(arg[iarg], "distance") == 0) {
    mode = DISTANCE;
    if (iarg + 2 > narg) utils::missing_cmd_args(FLERR, name + " distance", error);
    cutoff = utils::numeric(FLERR, arg[iarg + 1], false, lmp);
    if (!(cutoff > 0.0) || !std::isfinite(cutoff))
      error->all(FLERR, "Compute {} distance must be > 0, not {}", style, arg[iarg + 1]);
    iarg += 2;
    if (iarg < narg && strcmp(arg[iarg], "h") == 0) {
      factor = cutoff;
      iarg++;
    }
    if (iarg < narg && strcmp(arg[iarg], "damage") == 0) {
      if (iarg + 2 > narg) utils::missing_cmd_args(FLERR, name + " damage", error);
      damage = utils::logical(FLERR, arg[iarg + 1], false, lmp);
      iarg += 2;
    }
  } else
    error->all(FLERR, "Unknown compute {} mode: {} (must be bonds or distance)", style, arg[iarg]);

  if (!keywords && iarg < narg)
    error->all(FLERR, "Unknown compute {} keyword: {}", style, arg[iarg]);
}

/* ---------------------------------------------------------------------- */

ComputeHVIFragmentAtom::~ComputeHVIFragmentAtom()
{
  memory->destroy(fragment);
}

/* ---------------------------------------------------------------------- */

void ComputeHVIFragmentAtom::init()
{
  if (!atom->tag_enable) error->all(FLERR, "Compute {} requires atoms with IDs", style);
  if (mode == BONDS) {
    if (atom->molecular != Atom::MOLECULAR)
      error->all(FLERR, "Compute {} bonds requires an atom style with bonds stored per atom",
                 style);
    return;
  }

  if (damage && !FixHVIJohnsonCook::find(lmp)) find_damage();
  if (factor > 0.0) {
    auto *const store = force->pair_match("^hvi/sph$", 0) ? FixHVIStore::find(lmp) : nullptr;
    if (!store) error->all(FLERR, "Compute {} distance R h needs pair style hvi/sph", style);
    h = store->fields.settings.h;
    cutoff = factor * *std::max_element(h.begin(), h.end());
    const HVI::Mesh *const mesh = HVI::find_mesh(lmp);
    int mine = 0, none;
    for (int i = 0; i < atom->nlocal; i++)
      if ((atom->mask[i] & groupbit) && !(h[atom->type[i]] > 0.0) &&
          !(mesh && mesh->is_node(atom->type[i])))
        mine = atom->type[i];
    MPI_Allreduce(&mine, &none, 1, MPI_INT, MPI_MAX, world);
    if (none)
      error->all(FLERR,
                 "Compute {} distance R h: group {} has particles of type {}, which pair style "
                 "hvi/sph has no smoothing length for: use distance R",
                 style, group->names[igroup], none);
  }

  if (comm->mode != Comm::SINGLE)
    error->all(FLERR, "Compute {} distance requires comm_modify mode single", style);

  // ghosts must reach as far, for which communication is set up after init() of computes: between two lists particles
  // come nearer by a skin at most

  const double cutghost =
      MAX(force->pair ? force->pair->cutforce + neighbor->skin : 0.0, comm->cutghostuser);
  if (cutoff > MOST_REACH * (cutghost + neighbor->skin))
    error->all(
        FLERR,
        "Compute {} distance {:.6g} is more than {} times the reach {:.6g} of the pair style: "
        "is it in other units?",
        style, cutoff, MOST_REACH, cutghost);
  if (cutoff + neighbor->skin > cutghost) comm->cutghostuser = cutoff + neighbor->skin;
}

/* ----------------------------------------------------------------------
   damage of the particles where it is not kept by fix hvi/johnson-cook
------------------------------------------------------------------------- */

const double *ComputeHVIFragmentAtom::find_damage() const
{
  int isdouble, ncols;
  const int index = atom->find_custom(DAMAGE, isdouble, ncols);
  if (index < 0 || !isdouble || ncols)
    error->all(FLERR, "Compute {} damage yes: nothing here provides damage (property d_{})", style,
               DAMAGE);
  return atom->dvector[index];
}

/* ---------------------------------------------------------------------- */

void ComputeHVIFragmentAtom::compute_peratom()
{
  invoked_peratom = update->ntimestep;

  if (atom->nmax > nmax) {
    nmax = atom->nmax;
    memory->destroy(fragment);
    memory->create(fragment, nmax, "hvi/fragment/atom:fragment");
    vector_atom = fragment;
  }

  find_fragments(nullptr);
  std::vector<int64_t> lowest;
  name_found(lowest);
  std::copy(lowest.begin(), lowest.end(), fragment);
}

/* ----------------------------------------------------------------------
   among the particles of the group and the region: both ends must be in it
------------------------------------------------------------------------- */

void ComputeHVIFragmentAtom::find_fragments(Region *region)
{
  const int nlocal = atom->nlocal;

  id.assign(nlocal, 0);
  if (region) region->prematch();
  each([&](int i, double, const double *) {
    if (region) {
      double x[3] = {atom->x[i][0], atom->x[i][1], atom->x[i][2]};
      domain->remap(x);    // it may have left a periodic box since the last rebuild
      if (!region->match(x[0], x[1], x[2])) return;
    }
    id[i] = atom->tag[i];
  });

  if (damage) {
    const FixHVIJohnsonCook *const strength = FixHVIJohnsonCook::find(lmp);
    const double *const d = strength ? nullptr : find_damage();
    for (int i = 0; i < nlocal; i++)
      if (strength ? strength->failed(i) : !(d[i] < 1.0)) id[i] = -id[i];
  }

  check_ghosts();
  HVI::Mesh *const mesh = mode == BONDS ? nullptr : HVI::find_mesh(lmp);
  const int nall = nlocal + atom->nghost;
  std::vector<int64_t> vertex = id;
  for (int i = 0; mesh && i < nlocal; i++)
    if (mesh->is_node(atom->type[i])) vertex[i] = HVI::Mesh::node_id(atom->tag[i]);
  components.start(vertex, nall + (mesh ? mesh->copies() : 0));
  if (mode == BONDS)
    join_bonds();
  else
    join_close(mesh);
  if (mesh) mesh->join(components, id, nall, damage);
  components.finish([this, mesh, nall](HVI::Components::Node *n) {
    node = n;
    comm->forward_comm(this);
    if (mesh) mesh->copy(n, nall);
  });
}

/* ---------------------------------------------------------------------- */

void ComputeHVIFragmentAtom::choose(const std::vector<char> *set, int stay_alone)
{
  ComputeHVIMatter::choose(set);
  damage = stay_alone;
}

void ComputeHVIFragmentAtom::find_chosen(std::vector<int64_t> &lowest)
{
  find_fragments(nullptr);
  name_found(lowest);
}

void ComputeHVIFragmentAtom::name_found(std::vector<int64_t> &lowest) const
{
  lowest.assign(atom->nlocal, 0);
  for (int i = 0; i < atom->nlocal; i++)
    if (id[i] != 0) lowest[i] = std::abs(components.component(i).id);
}

/* ----------------------------------------------------------------------
   a bond is known to the owner of at least one end: no matter which
------------------------------------------------------------------------- */

void ComputeHVIFragmentAtom::join_bonds()
{
  const int *const num_bond = atom->num_bond;
  const int *const *const bond_type = atom->bond_type;
  const tagint *const *const bond_atom = atom->bond_atom;

  for (int i = 0; i < atom->nlocal; i++) {
    if (id[i] == 0) continue;
    for (int m = 0; m < num_bond[i]; m++) {
      if (bond_type[i][m] <= 0) continue;
      const int j = atom->map(bond_atom[i][m]);
      if (j >= 0)
        components.join(i, j);
      else if (output->thermo->lostbond == Thermo::ERROR)
        error->one(FLERR,
                   "Compute {}: atom {} is bonded to atom {}, which is neither on this rank nor "
                   "among its ghosts: use comm_modify cutoff",
                   style, atom->tag[i], bond_atom[i][m]);
    }
  }
}

/* ---------------------------------------------------------------------- */

double ComputeHVIFragmentAtom::reach(int itype, int jtype) const
{
  return (factor > 0.0) ? 0.5 * factor * (h[itype] + h[jtype]) : cutoff;
}

/* ----------------------------------------------------------------------
   nodes of elements are vertices, too, but hold nothing by distance
------------------------------------------------------------------------- */

void ComputeHVIFragmentAtom::join_close(const HVI::Mesh *mesh)
{
  comm->forward_comm();    // ghosts are behind if the box has changed since

  const int nlocal = atom->nlocal, *const type = atom->type;
  close.clear();
  for (int i = 0; i < nlocal + atom->nghost; i++)
    if ((i >= nlocal || id[i] != 0) && !(mesh && mesh->is_node(type[i]))) close.add(i, atom->x[i]);
  close.each(cutoff, [&](int i, int j, double rsq) {
    const double cut = reach(type[i], type[j]);
    if (rsq < cut * cut && (i < nlocal || j < nlocal) && !excluded(i, j)) components.join(i, j);
  });
}

/* ----------------------------------------------------------------------
   neigh_modify exclude: such pairs are in no list
------------------------------------------------------------------------- */

bool ComputeHVIFragmentAtom::excluded(int i, int j) const
{
  const auto of = [this](int k) {
    return HVI::ExcludedBy{atom->type[k], atom->mask[k], atom->molecule ? atom->molecule[k] : 0};
  };
  return neighbor->exclude && HVI::excluded(*neighbor, *group, of(i), of(j));
}

/* ---------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Commands between runs, or in them by run every, may take ghosts away (delete_atoms, balance) or what is known of them
   (comm_style), and leave LAMMPS's lists of what is sent
------------------------------------------------------------------------- */

void ComputeHVIFragmentAtom::check_ghosts()
{
  checking = true;
  received = 0;
  comm->forward_comm(this);
  checking = false;
  int here = received != atom->nghost, any;
  MPI_Allreduce(&here, &any, 1, MPI_INT, MPI_MAX, world);
  if (any)
    error->all(FLERR,
               "Compute {}: a command since the last run has moved, made or taken away particles, "
               "and ghosts are not there: use run 0 first",
               style);
}

int ComputeHVIFragmentAtom::pack_forward_comm(int n, int *list, double *buf, int /*pbc_flag*/,
                                              int * /*pbc*/)
{
  if (checking) {
    std::fill_n(buf, NODE_SIZE * n, 0.0);
    return NODE_SIZE * n;
  }
  for (int i = 0; i < n; i++) memcpy(&buf[NODE_SIZE * i], &node[list[i]], sizeof(node[0]));
  return NODE_SIZE * n;
}

/* ---------------------------------------------------------------------- */

void ComputeHVIFragmentAtom::unpack_forward_comm(int n, int first, double *buf)
{
  if (checking) {
    received += n;
    return;
  }
  memcpy(&node[first], buf, n * sizeof(node[0]));
}

/* ---------------------------------------------------------------------- */

double ComputeHVIFragmentAtom::memory_usage()
{
  return (double) nmax * sizeof(double) + (double) id.capacity() * sizeof(int64_t) +
      components.memory_usage() + close.bytes();
}
