/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

// elements that go to other ranks, into restart files and data files; the rest of the class is in
// fix_hvi_fem.cpp

#include "fix_hvi_fem.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "memory.h"
#include "tokenizer.h"
#include "update.h"

#include <algorithm>
#include <cstring>
#include <unordered_map>

using namespace LAMMPS_NS;
using HVI::CORNERS;

static constexpr int SIZE = HVI::Element::SIZE, IDS = HVI::Element::IDS;
static constexpr int COLUMNS =
    10;    // of a row of state: LAMMPS reads lines of less than 256 characters

/* ---------------------------------------------------------------------- */

void FixHVIFEM::grow_arrays(int n)
{
  memory->grow(head, n, "hvi/fem:head");
  memory->grow(users, n, "hvi/fem:users");
}

void FixHVIFEM::copy_arrays(int i, int j, int /*delflag*/)
{
  head[j] = head[i];
  users[j] = users[i];
}

// LAMMPS sets the arrays of new particles after it has read all sections, and may then send them to other ranks

void FixHVIFEM::set_arrays(int i)
{
  head[i] = -1;
  if (i < (int) read_head.size()) std::swap(head[i], read_head[i]);
  users[i] = 0;
}

/* ----------------------------------------------------------------------
   elements go with their first node; those that have gone are no more here
------------------------------------------------------------------------- */

int FixHVIFEM::pack_exchange(int i, double *buf)
{
  int m = 2;
  buf[0] = users[i];
  for (int e = head[i]; e >= 0; e = next[e]) {
    if (!alive(e)) continue;
    memcpy(buf + m, &elements[e], sizeof(Element));
    m += SIZE;
    elements[e].type = 0;
  }
  buf[1] = (m - 2) / SIZE;
  return m;
}

int FixHVIFEM::unpack_exchange(int i, double *buf)
{
  users[i] = buf[0];
  head[i] = -1;
  const int n = buf[1];
  for (int k = 0; k < n; k++) {
    Element one;
    memcpy(&one, buf + 2 + k * SIZE, sizeof(Element));
    next.push_back(head[i]);
    head[i] = elements.size();
    elements.push_back(one);
  }
  return 2 + n * SIZE;
}

int FixHVIFEM::size_restart(int i)
{
  int n = 2;
  for (int e = head[i]; e >= 0; e = next[e])
    if (alive(e)) n += SIZE;
  return n;
}

int FixHVIFEM::maxsize_restart()
{
  return maxexchange;
}

int FixHVIFEM::pack_restart(int i, double *buf)
{
  int m = 2;
  for (int e = head[i]; e >= 0; e = next[e]) {
    if (!alive(e)) continue;
    memcpy(buf + m, &elements[e], sizeof(Element));
    m += SIZE;
  }
  buf[0] = m;
  buf[1] = (m - 2) / SIZE;
  return m;
}

void FixHVIFEM::unpack_restart(int i, int nth)
{
  const double *stored = atom->extra[i];
  for (int k = 0; k < nth; k++) stored += static_cast<int>(*stored);
  const int n = stored[1];
  if (stored[0] != 2 + n * SIZE)
    error->one(FLERR, "Fix hvi/fem: the restart file is of another version");
  head[i] = -1;
  users[i] = 0;
  for (int k = 0; k < n; k++) {
    Element one;
    memcpy(&one, stored + 2 + k * SIZE, sizeof(Element));
    next.push_back(head[i]);
    head[i] = elements.size();
    elements.push_back(one);
  }
}

/* ----------------------------------------------------------------------
   what is of all: the last step, numbers of elements and what has become of others, and which of them probes
   have, for the nearest now may be another
------------------------------------------------------------------------- */

void FixHVIFEM::write_restart(FILE *fp)
{
  double sum[NCOUNT];
  MPI_Reduce(count, sum, NCOUNT, MPI_DOUBLE, MPI_SUM, 0, world);
  if (comm->me) return;
  std::vector<double> list = {(double) SIZE, dt_last, (double) total};
  list.insert(list.end(), sum, sum + NCOUNT);
  list.push_back(probes.size());
  for (const Probe &probe : probes) {
    list.insert(list.end(), probe.x, probe.x + 3);
    list.push_back(probe.id);
  }
  const int size = list.size() * sizeof(double);
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(list.data(), size, 1, fp);
}

void FixHVIFEM::restart(char *buf)
{
  const double *list = (const double *) buf;
  if (list[0] != SIZE) error->all(FLERR, "Fix hvi/fem: the restart file is of another version");
  dt_last = list[1];
  total = list[2];
  if (comm->me == 0) std::copy_n(list + 3, +NCOUNT, count);
  list += 3 + NCOUNT;
  const double *const end = list + 1 + 4 * (int) list[0];
  for (++list; list < end; list += 4)
    for (Probe &probe : probes)
      if (std::equal(probe.x, probe.x + 3, list)) probe.id = list[3];
}

/* ----------------------------------------------------------------------
   Data files: "N elements" in the header; the section Elements, of those that are left; and as many more
   sections as their state needs, with what restart files have, too.  Their titles end with numbers.
   IDs of elements of a further file come after those that are there.
------------------------------------------------------------------------- */

void FixHVIFEM::read_data_header(char *line)
{
  announced = utils::bnumeric(FLERR, utils::split_words(line)[0], false, lmp);
  if (announced < 1) error->all(FLERR, "Fix hvi/fem: no elements in the header of the data file");

  // fix property/atom would give to particles the mass of who was at their places before, ghosts perhaps

  if (atom->rmass) std::fill(atom->rmass + atom->nlocal, atom->rmass + atom->nmax, 0.0);
  std::int64_t here = 0;
  bigint alive_here = 0, alive_all;
  for (const Element &one : elements) {
    here = std::max(here, one.id);
    alive_here += one.type > 0;
  }
  MPI_Allreduce(&here, &id_before, 1, MPI_INT64_T, MPI_MAX, world);
  MPI_Allreduce(&alive_here, &alive_all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  expected = alive_all + announced;
  read_ids.clear();
}

void FixHVIFEM::read_data_section(char *keyword, int n, char *buf, tagint offset)
{
  const bool state = utils::strmatch(keyword, "_state_\\d+$");
  const int k = state ? atoi(strrchr(keyword, '_') + 1) : 0;
  const int ncolumn = state ? std::min(COLUMNS, SIZE - IDS - COLUMNS * k) : IDS - 1;
  if (state && read_ids.size() != elements.size()) {
    read_ids.clear();
    for (std::size_t e = 0; e < elements.size(); e++) read_ids[elements[e].id] = e;
  }
  for (int row = 0; row < n; row++) {
    char *const end = strchr(buf, '\n');
    *end = '\0';
    ValueTokenizer values(buf);
    buf = end + 1;
    if (!values.has_next()) continue;
    try {
      if ((int) values.count() != ncolumn + 1)
        throw TokenizerException("it has another number of columns", "");
      Element one = {};
      one.id = values.next_bigint();
      if (one.id < 1)
        throw TokenizerException("IDs of elements must be positive", std::to_string(one.id));
      one.id += id_before;
      if (state) {
        const auto found = read_ids.find(one.id);
        if (found == read_ids.end()) continue;    // of another rank
        double number[COLUMNS];
        for (int c = 0; c < ncolumn; c++) number[c] = values.next_double();
        memcpy((double *) &elements[found->second] + IDS + COLUMNS * k, number,
               ncolumn * sizeof(double));
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
      const int i = nodes.local(one.node[0]);
      if (i < 0 || i >= atom->nlocal) continue;
      if (i >= (int) read_head.size()) read_head.resize(i + 1, -1);
      next.push_back(read_head[i]);
      read_head[i] = elements.size();
      elements.push_back(one);
      int number = 0;
      for (int e = read_head[i]; e >= 0; e = next[e]) number++;
      maxexchange = std::max(maxexchange, 2 + number * SIZE);
    } catch (TokenizerException &wrong) {
      error->all(FLERR, "Fix hvi/fem: wrong row of section {} of the data file: {}", keyword,
                 wrong.what());
    }
  }
  total = -1;
}

void FixHVIFEM::write_data_header(FILE *fp, int /*mth*/)
{
  fmt::print(fp, "{} elements\n", total);
}

void FixHVIFEM::write_data_section_size(int mth, int &nx, int &ny)
{
  nx = std::count_if(elements.begin(), elements.end(), [](const Element &one) {
    return one.type > 0;
  });
  ny = mth == 0 ? IDS : 1 + std::min(COLUMNS, SIZE - IDS - COLUMNS * (mth - 1));
}

void FixHVIFEM::write_data_section_pack(int mth, double **buf)
{
  int row = 0, ny, nx;
  write_data_section_size(mth, nx, ny);
  for (const Element &one : elements) {
    if (one.type <= 0) continue;
    double *const b = buf[row++];
    b[0] = ubuf(one.id).d;
    if (mth == 0) {
      b[1] = ubuf(one.type).d;
      for (int a = 0; a < CORNERS; a++) b[2 + a] = ubuf(one.node[a]).d;
      b[2 + CORNERS] = ubuf(one.n).d;
      b[3 + CORNERS] = ubuf(one.first).d;
    } else
      memcpy(b + 1, (const double *) &one + IDS + COLUMNS * (mth - 1), (ny - 1) * sizeof(double));
  }
}

void FixHVIFEM::write_data_section_keyword(int mth, FILE *fp)
{
  if (mth == 0)
    fmt::print(fp, "\nElements\n\n");
  else
    fmt::print(fp, "\n{}_state_{}\n\n", id, mth - 1);
}

void FixHVIFEM::write_data_section(int mth, FILE *fp, int n, double **buf, int /*index*/)
{
  int nx, ny;
  write_data_section_size(mth, nx, ny);
  for (int row = 0; row < n; row++) {
    std::string line = std::to_string((bigint) ubuf(buf[row][0]).i);
    for (int c = 1; c < ny; c++)
      line += mth == 0 ? fmt::format(" {}", (bigint) ubuf(buf[row][c]).i)
                       : fmt::format(" {}", buf[row][c]);
    fmt::print(fp, "{}\n", line);
  }
}

double FixHVIFEM::memory_usage()
{
  return elements.capacity() * (double) (sizeof(Element) + sizeof(Now)) +
      atom->nmax * 2.0 * sizeof(int) + nodes.memory_usage() + particles.memory_usage() +
      near.memory_usage() + (node.capacity() + push.capacity() + rows.capacity()) * sizeof(double);
}
