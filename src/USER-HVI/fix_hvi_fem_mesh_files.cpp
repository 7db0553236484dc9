/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

// elements that go along with their first nodes: to other ranks, into restart files and data files

#include "fix_hvi_fem_mesh.h"

#include "atom.h"
#include "error.h"
#include "tokenizer.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;
using HVI::CORNERS;
using HVI::ELEMENT_SIZE;

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
  if (buf) buf[1] = (m - 2) / ELEMENT_SIZE;
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

int FixHVIFEMMesh::size_restart(int i)
{
  return copy_all(i, nullptr);
}

int FixHVIFEMMesh::pack_restart(int i, double *buf)
{
  return buf[0] = copy_all(i, buf);
}

void FixHVIFEMMesh::unpack_restart(int i, int nth)
{
  double *stored = atom->extra[i];
  for (int k = 0; k < nth; k++) stored += static_cast<int>(*stored);
  if (stored[0] != 2 + stored[1] * ELEMENT_SIZE)
    error->one(FLERR, "Fix hvi/fem: the restart file is of another version");
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
  const int section = utils::strmatch(keyword, "_state_\\d+$") ? 1 + atoi(strrchr(keyword, '_') + 1)
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
        const auto found = by_id.find(one.id);
        if (found == by_id.end()) continue;    // of another rank
        double number[COLUMNS];
        for (int c = 0; c < columns(section); c++) number[c] = values.next_double();
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

void FixHVIFEMMesh::write_data_header(FILE *fp, int /*mth*/)
{
  fmt::print(fp, "{} elements\n", total);
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
  if (section)
    fmt::print(fp, "\n{}_state_{}\n\n", id, section - 1);
  else
    fmt::print(fp, "\nElements\n\n");
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
    fmt::print(fp, "{}\n", line);
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
