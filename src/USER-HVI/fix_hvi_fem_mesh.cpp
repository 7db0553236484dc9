/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "fix_hvi_fem_mesh.h"

#include "atom.h"
#include "atom_vec.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "hvi_anew.h"
#include "hvi_compat.h"
#include "hvi_deliver.h"
#include "hvi_restart.h"
#include "tokenizer.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using HVI::CORNERS;
using HVI::ELEMENT_SIZE;
using HVI::LANES;

/* ----------------------------------------------------------------------
   A run begins: periodic faces, and whether all elements of data files and restart files are there
------------------------------------------------------------------------- */

void FixHVIFEMMesh::init()
{
  wraps = domain->xperiodic || domain->yperiodic || domain->zperiodic;
  const bigint all = count();
  if (all == 0 && total < 0)
    error->all(FLERR, "Fix hvi/fem has no elements: use read_data FILE fix {} elements Elements",
               id);
  if (total < 0 && expected >= 0 && all != expected)
    error->all(
        FLERR,
        "Fix hvi/fem: {} of {} elements have a first node that is not there: the section Elements "
        "must come after Atoms, with IDs of nodes as there",
        expected - all, expected);
  if (total < 0) check_ids();
  if (total < 0) total = all;
  expected = -1;
}

// equal IDs meet on one rank

void FixHVIFEMMesh::check_ids() const
{
  std::vector<std::int64_t> ids;
  std::vector<int> ranks;
  for (int i = 0; i < atom->nlocal; i++)
    each_of(i, [&](const Element &one) {
      ids.push_back(one.id);
      ranks.push_back((int) (one.id % comm->nprocs));
    });
  ids = HVI::deliver(world, ids, ranks);
  std::sort(ids.begin(), ids.end());
  const auto twice = std::adjacent_find(ids.begin(), ids.end());
  if (twice != ids.end()) error->one(FLERR, "Fix hvi/fem: two elements have the ID {}", *twice);
}

// those that have gone with their nodes when data files were read are not alive here

bigint FixHVIFEMMesh::count() const
{
  bigint here = 0, all;
  for (const Element &one : elements) here += one.alive();
  MPI_Allreduce(&here, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  return all;
}

/* ----------------------------------------------------------------------
   After particles have been exchanged: which elements are here, and which ranks own their nodes and embedded particles
------------------------------------------------------------------------- */

void FixHVIFEMMesh::connect()
{
  link();
  steps.assign(elements.size(), HVI::ElementStep());
  embedded.clear();
  std::vector<tagint> nodes_wanted, embedded_wanted;
  for (std::size_t e = 0; e < elements.size(); e++) {
    const Element &one = elements[e];
    nodes_wanted.insert(nodes_wanted.end(), one.node, one.node + CORNERS);
    for (int p = 0; p < one.particles(); p++) {
      embedded.push_back({(int) e, p});
      embedded_wanted.push_back(one.first + p);
    }
    if (one.n >= (int) subcells.size()) subcells.resize(one.n + 1);
    if (one.n > 0 && subcells[one.n].empty()) subcells[one.n] = HVI::hex_subcells(one.n);
  }

  std::vector<tagint> unique = nodes_wanted;
  std::sort(unique.begin(), unique.end());
  unique.erase(std::unique(unique.begin(), unique.end()), unique.end());
  nodes.resize(unique.size());
  corner.resize(nodes_wanted.size());
  for (std::size_t k = 0; k < corner.size(); k++)
    corner[k] = std::lower_bound(unique.begin(), unique.end(), nodes_wanted[k]) - unique.begin();

  const bigint all = count();
  const tagint lost_node = of_nodes.connect(unique, node_types, true);
  const tagint lost = of_embedded.connect(embedded_wanted, node_types, false);
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
  std::fill_n(valence.begin(), atom->nlocal, 0);
  of_nodes.scatter(uses, [this](int i, double n) {
    valence[i] += n;
  });
}

/* ----------------------------------------------------------------------
   elements by their first nodes, without those that are no more
------------------------------------------------------------------------- */

void FixHVIFEMMesh::link()
{
  // chains hang on particles, whatever their IDs are

  for (int i = 0; i < atom->nlocal; i++)
    each_of(i, [&](const Element &one) {
      if (one.node[0] != atom->tag[i]) ids_have_changed(atom->tag[i]);
    });

  elements.erase(std::remove_if(elements.begin(), elements.end(),
                                [](const Element &one) {
                                  return !one.alive();
                                }),
                 elements.end());

  // in an order that does not depend on how they came here: sums are the same after a restart

  std::sort(elements.begin(), elements.end(), [](const Element &one, const Element &two) {
    return one.id < two.id;
  });
  next.assign(elements.size(), -1);
  read_head.clear();
  std::fill_n(head.begin(), atom->nlocal, -1);
  std::vector<int> number(atom->nlocal, 0);
  int most = 1, most_of_all;
  for (int e = elements.size() - 1; e >= 0; e--) {
    const int i = of_nodes.local(elements[e].node[0]);
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

  MPI_Allreduce(&most, &most_of_all, 1, MPI_INT, MPI_MAX, world);
  maxexchange = 2 + most_of_all * HVI::ELEMENT_SIZE;
}

void FixHVIFEMMesh::ids_have_changed(tagint tag) const
{
  error->one(FLERR,
             "Fix hvi/fem: particle {} had another ID, or was in another group, in the last run: "
             "elements know nodes and particles by ID: use delete_atoms ... compress no, not "
             "reset_atoms id, and leave group {}_embedded alone",
             tag, id);
}

/* ----------------------------------------------------------------------
   Half kicks give dt^2/8 f^2/m beyond the work on the velocity of the middle of a step
------------------------------------------------------------------------- */

void FixHVIFEMMesh::gather_nodes(double factor, bool at_end)
{
  moved = -1;
  of_nodes.gather(
      [&](int i) {
        const double *const x = atom->x[i], *const v = atom->v[i], *const f = atom->f[i];
        const double *const w = at_end ? v : atom->vest[i], m = atom->rmass[i];
        const double kick = 0.125 * (f[0] * f[0] + f[1] * f[1] + f[2] * f[2]) / (m * m);
        return HVI::Node{{{x[0], x[1], x[2]}, {v[0], v[1], v[2]}, {w[0], w[1], w[2]}},
                         factor * kick,
                         (double) valence[i]};
      },
      [this](int k, const HVI::Node &node) {
        nodes[k] = node;
      });
}

void FixHVIFEMMesh::places(std::size_t e, HVI::Corners &x) const
{
  for (int a = 0; a < CORNERS; a++) std::copy_n(nodes[number(e, a)].x, 3, x[a]);
  if (!wraps) return;
  for (int a = 1; a < CORNERS; a++) {
    const double d[3] = {x[a][0] - x[0][0], x[a][1] - x[0][1], x[a][2] - x[0][2]};
    double image[3] = {d[0], d[1], d[2]};
    HVI::minimum_image(domain, image[0], image[1], image[2]);
    for (int k = 0; k < 3; k++)
      if (image[k] != d[k]) x[a][k] = x[0][k] + image[k];
  }
}

HVI::Motion FixHVIFEMMesh::motion(int k)
{
  const std::size_t e = embedded[k].element;
  if (e != moved) {
    HVI::Corners x;
    places(e, x);
    for (int a = 0; a < CORNERS; a++) {
      corner_motion[a] = nodes[number(e, a)];
      std::copy_n(x[a], 3, corner_motion[a].x);
    }
    moved = e;
  }
  const HVI::Weights &N = weights(k);
  HVI::Motion sum = {};
  for (int a = 0; a < CORNERS; a++)
    for (int d = 0; d < 3; d++) {
      sum.x[d] += N[a] * corner_motion[a].x[d];
      sum.v[d] += N[a] * corner_motion[a].v[d];
      sum.predicted[d] += N[a] * corner_motion[a].predicted[d];
    }
  return sum;
}

HVI::ElementBatch FixHVIFEMMesh::load(std::size_t first)
{
  HVI::ElementBatch batch;
  batch.n = std::min<std::size_t>(LANES, elements.size() - first);
  batch.element = &elements[first];
  batch.step = &steps[first];
  for (int lane = 0; lane < LANES; lane++) {
    const std::size_t e = first + std::min(lane, batch.n - 1);
    HVI::Corners x;
    places(e, x);
    for (int a = 0; a < CORNERS; a++)
      for (int k = 0; k < 3; k++) {
        batch.x[k][a][lane] = x[a][k];
        batch.v[k][a][lane] = nodes[number(e, a)].v[k];
      }
  }
  batch.V = HVI::hex_gradient(batch.x, batch.B);
  return batch;
}

bool FixHVIFEMMesh::paired(std::size_t first) const
{
  bool any = false;
  for (std::size_t e = first; e < first + LANES && e < steps.size(); e++) any |= steps[e].paired;
  return any;
}

/* ----------------------------------------------------------------------
   As fix evaporate does, with ghosts forgotten and a new map: fix balance may migrate particles before LAMMPS
   does so itself
------------------------------------------------------------------------- */

void FixHVIFEMMesh::remove_nodes()
{
  bigint here = 0, all;
  for (int i = 0; i < atom->nlocal; i++) here += nodal(i) && valence[i] == 0;
  MPI_Allreduce(&here, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (!all) return;
  for (int i = atom->nlocal - 1; i >= 0; i--) {
    if (!nodal(i) || valence[i] > 0) continue;
    atom->avec->copy(atom->nlocal - 1, i, 1);
    atom->nlocal--;
  }
  atom->natoms -= all;
  atom->nghost = 0;
  atom->map_init();
  atom->map_set();
}

/* ----------------------------------------------------------------------
   rows to ghosts, or added up at owners
------------------------------------------------------------------------- */

int FixHVIFEMMesh::pack_forward_comm(int n, int *list, double *buf, int /*pbc_flag*/, int * /*pbc*/)
{
  for (int k = 0; k < n; k++) std::copy_n(halo.data() + width * list[k], width, buf + width * k);
  return n * width;
}

void FixHVIFEMMesh::unpack_forward_comm(int n, int first, double *buf)
{
  std::copy_n(buf, n * width, halo.data() + width * first);
}

int FixHVIFEMMesh::pack_reverse_comm(int n, int first, double *buf)
{
  std::copy_n(halo.data() + width * first, n * width, buf);
  return n * width;
}

void FixHVIFEMMesh::unpack_reverse_comm(int n, int *list, double *buf)
{
  for (int k = 0; k < n; k++)
    for (int d = 0; d < width; d++) halo[width * list[k] + d] += buf[width * k + d];
}

/* ======================================================================
   elements that go along with their first nodes: to other ranks, into restart files and data files
====================================================================== */

static constexpr int IDS = HVI::Element::IDS;
static constexpr int COLUMNS =
    10;    // of state in a row: LAMMPS reads lines of less than 256 characters

/* ---------------------------------------------------------------------- */

FixHVIFEMMesh::FixHVIFEMMesh(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), of_nodes(lmp), of_embedded(lmp), of_paired(lmp)
{
  restart_peratom = 1;
  create_attribute = 1;
  maxexchange_dynamic = 1;
  maxexchange = 2 + 8 * ELEMENT_SIZE;
  wd_header = 1;
  wd_section = 1 + (ELEMENT_SIZE - IDS + COLUMNS - 1) / COLUMNS;
  comm_forward = comm_reverse = WIDEST;
}

// when the constructor has found nothing wrong: LAMMPS gets to know it

void FixHVIFEMMesh::begin()
{
  begun = true;
  grow_arrays(atom->nmax);
  for (int i = 0; i < atom->nlocal; i++) set_arrays(i);
  atom->add_callback(Atom::GROW);
  atom->add_callback(Atom::RESTART);
}

FixHVIFEMMesh::~FixHVIFEMMesh()
{
  HVI::run_anew(update);
  if (!begun) return;
  atom->delete_callback(id, Atom::GROW);
  atom->delete_callback(id, Atom::RESTART);
}

/* ---------------------------------------------------------------------- */

void FixHVIFEMMesh::grow_arrays(int nmax)
{
  head.resize(nmax, -1);
  valence.resize(nmax, 0);
}

void FixHVIFEMMesh::copy_arrays(int i, int j, int /*delflag*/)
{
  head[j] = head[i];
  valence[j] = valence[i];
}

// LAMMPS sets the arrays of new particles after it has read all sections, and may then send them to other ranks

void FixHVIFEMMesh::set_arrays(int i)
{
  head[i] = -1;
  if (i < (int) read_head.size()) std::swap(head[i], read_head[i]);
  valence[i] = 0;
}

void FixHVIFEMMesh::hang(std::vector<int> &heads, int i, const Element &one)
{
  next.push_back(heads[i]);
  heads[i] = elements.size();
  elements.push_back(one);
}

/* ----------------------------------------------------------------------
   The number of elements, after a number that is up to the caller, then these.  Those that have gone are no more here.
------------------------------------------------------------------------- */

int FixHVIFEMMesh::copy_all(int i, double *buf) const
{
  int m = 2;
  each_of(i, [&](const Element &one) {
    if (buf) memcpy(buf + m, &one, sizeof(Element));
    m += ELEMENT_SIZE;
  });
  const int number = (m - 2) / ELEMENT_SIZE;
  if (buf) buf[1] = number;
  return m;
}

int FixHVIFEMMesh::pack_exchange(int i, double *buf)
{
  const int m = copy_all(i, buf);
  buf[0] = valence[i];
  for (int e = head[i]; e >= 0; e = next[e]) elements[e].type = 0;
  return m;
}

int FixHVIFEMMesh::unpack_exchange(int i, double *buf)
{
  valence[i] = buf[0];
  head[i] = -1;
  const int n = buf[1];
  for (int k = 0; k < n; k++) {
    Element one;
    memcpy(&one, buf + 2 + k * ELEMENT_SIZE, sizeof(Element));
    hang(head, i, one);
  }
  return 2 + n * ELEMENT_SIZE;
}

// and their checksum

int FixHVIFEMMesh::size_restart(int i)
{
  return copy_all(i, nullptr) + 1;
}

int FixHVIFEMMesh::pack_restart(int i, double *buf)
{
  const int m = copy_all(i, buf);
  buf[0] = m + 1;
  buf[m] = HVI::checksum(buf, m);
  return m + 1;
}

void FixHVIFEMMesh::unpack_restart(int i, int nth)
{
  double *const stored = HVI::stored_at(atom, i, nth);
  const int m = 2 + (stored ? stored[1] : 0) * ELEMENT_SIZE;
  if (!stored || stored[0] != m + 1 || stored + m >= atom->extra[i] + atom->nextra_store ||
      stored[m] != HVI::checksum(stored, m))
    error->one(FLERR,
               "Fix hvi/fem: elements of node {} in the restart file are damaged, or of another "
               "version of the package: "
               "take another one",
               atom->tag[i]);
  unpack_exchange(i, stored);
  valence[i] = 0;    // not known before the next connect()
}

/* ----------------------------------------------------------------------
   Data files: "N elements" in the header; the section Elements, of those that are left; and as many more
   sections as their state needs, with what restart files have, too.  Their titles end with numbers.
   IDs of elements of a further file come after those that are there.
------------------------------------------------------------------------- */

void FixHVIFEMMesh::read_data_header(char *line)
{
  announced = utils::bnumeric(FLERR, utils::split_words(line)[0], false, lmp);
  if (announced < 1) error->all(FLERR, "Fix hvi/fem: no elements in the header of the data file");

  // fix property/atom would give to particles the mass of what was at their places before, ghosts perhaps

  if (atom->rmass) std::fill(atom->rmass + atom->nlocal, atom->rmass + atom->nmax, 0.0);
  std::int64_t largest = 0;
  for (const Element &one : elements) largest = std::max(largest, one.id);
  MPI_Allreduce(&largest, &id_before, 1, MPI_INT64_T, MPI_MAX, world);
  expected = count() + announced;
  by_id.clear();
}

// numbers in a row of a section, besides the ID: the first is Elements

static int columns(int section)
{
  return section == 0 ? IDS - 1 : std::min(COLUMNS, ELEMENT_SIZE - IDS - COLUMNS * (section - 1));
}

void FixHVIFEMMesh::read_data_section(char *keyword, int n, char *buf, tagint offset)
{
  const int section = utils::strmatch(keyword, "_state_\\d+$")
      ? 1 + utils::inumeric(FLERR, strrchr(keyword, '_') + 1, false, lmp)
      : 0;
  if (section && by_id.size() != elements.size()) {
    by_id.clear();
    for (std::size_t e = 0; e < elements.size(); e++) by_id[elements[e].id] = e;
  }
  for (int row = 0; row < n; row++) {
    char *const end = strchr(buf, '\n');
    *end = '\0';
    ValueTokenizer values(buf);
    buf = end + 1;
    if (!values.has_next()) continue;
    try {
      if ((int) values.count() != columns(section) + 1)
        throw TokenizerException("it has another number of columns", "");
      Element one = {};
      one.id = values.next_bigint();
      if (one.id < 1)
        throw TokenizerException("IDs of elements must be positive", std::to_string(one.id));
      one.id += id_before;
      if (section) {
        double number[COLUMNS] = {};    // all ranks see what is wrong
        for (int c = 0; c < columns(section); c++) number[c] = values.next_double();
        const auto found = by_id.find(one.id);
        if (found == by_id.end()) continue;    // of another rank
        memcpy((double *) &elements[found->second] + IDS + COLUMNS * (section - 1), number,
               columns(section) * sizeof(double));
        continue;
      }
      one.type = values.next_int();
      for (auto &node_id : one.node) node_id = values.next_tagint() + offset;
      one.n = values.next_int();
      one.first = values.next_tagint() + (one.n > 0 ? offset : 0);
      if (one.type < 1 || one.type > atom->ntypes)
        throw TokenizerException("there is no such type", std::to_string(one.type));
      if (one.n < 0 || one.n > 8)
        throw TokenizerException("n must be from 0 to 8", std::to_string(one.n));
      if (*std::min_element(one.node, one.node + CORNERS) <= offset ||
          (one.n > 0 && one.first <= offset))
        throw TokenizerException("IDs of nodes and particles must be positive", "");
      const int i = of_nodes.local(one.node[0]);
      if (i < 0 || i >= atom->nlocal) continue;
      if (i >= (int) read_head.size()) read_head.resize(i + 1, -1);
      hang(read_head, i, one);
      int number = 0;
      for (int e = read_head[i]; e >= 0; e = next[e]) number++;
      maxexchange = std::max(maxexchange, 2 + number * ELEMENT_SIZE);
    } catch (TokenizerException &wrong) {
      error->all(FLERR, "Fix hvi/fem: wrong row of section {} of the data file: {}", keyword,
                 wrong.what());
    }
  }
  total = -1;
}

// no run may have counted them yet

void FixHVIFEMMesh::write_data_header(FILE *fp, int /*mth*/)
{
  utils::print(fp, "{} elements\n", total < 0 ? expected : total);
}

void FixHVIFEMMesh::write_data_section_size(int section, int &nx, int &ny)
{
  nx = std::count_if(elements.begin(), elements.end(), [](const Element &one) {
    return one.alive();
  });
  ny = 1 + columns(section);
}

void FixHVIFEMMesh::write_data_section_keyword(int section, FILE *fp)
{
  const std::string name = section ? fmt::format("{}_state_{}", id, section - 1) : "Elements";
  utils::logmesg(lmp, "  section {1}: for read_data, fix {0} {2} {1}\n", id, name,
                 section ? "NULL" : "elements");
  utils::print(fp, "\n{}\n\n", name);
}

void FixHVIFEMMesh::write_data_section_pack(int section, double **buf)
{
  int row = 0;
  for (const Element &one : elements) {
    if (!one.alive()) continue;
    double *const b = buf[row++];
    memcpy(b, &one, (section ? 1 : IDS) * sizeof(double));
    if (section)
      std::copy_n((const double *) &one + IDS + COLUMNS * (section - 1), columns(section), b + 1);
  }
}

void FixHVIFEMMesh::write_data_section(int section, FILE *fp, int n, double **buf, int /*index*/)
{
  for (int row = 0; row < n; row++) {
    std::string line = std::to_string((bigint) ubuf(buf[row][0]).i);
    for (int c = 1; c <= columns(section); c++)
      line += section ? fmt::format(" {}", buf[row][c])
                      : fmt::format(" {}", (bigint) ubuf(buf[row][c]).i);
    utils::print(fp, "{}\n", line);
  }
}

/* ---------------------------------------------------------------------- */

double FixHVIFEMMesh::memory_usage()
{
  return elements.capacity() * (double) (sizeof(Element) + sizeof(HVI::ElementStep)) +
      nodes.capacity() * sizeof(HVI::Node) + embedded.capacity() * sizeof(Embedded) +
      2.0 * atom->nmax * sizeof(int) + of_nodes.memory_usage() + of_embedded.memory_usage() +
      of_paired.memory_usage();
}
