/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing author: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "hvi_restart.h"

#include "atom.h"
#include "atom_vec.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_property_atom.h"
#include "force.h"
#include "modify.h"
#include "neighbor.h"
#include "utils.h"

#include <algorithm>
#include <cstring>
#include <vector>

using namespace LAMMPS_NS;

namespace HVI {

static constexpr std::uint64_t MARK =
    0x4856490000000000u;    // "HVI": no form of files without it begins so

// FNV-1a, by words of eight bytes

std::uint64_t checksum(const void *data, std::size_t bytes)
{
  std::uint64_t hash = 0xcbf29ce484222325u;
  const char *const c = (const char *) data;
  for (std::size_t k = 0; k < bytes; k += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    memcpy(&word, c + k, MIN(sizeof(word), bytes - k));
    hash = (hash ^ word) * 0x100000001b3u;
    hash ^= hash >> 32;
  }
  return hash;
}

double checksum(const double *values, std::size_t n)
{
  const std::uint64_t hash =
      checksum((const void *) values, n * sizeof(double)) >> 12;    // a whole number: no NaN
  return hash;
}

/* ---------------------------------------------------------------------- */

double *stored_at(Atom *atom, int i, int nth)
{
  const double *const row = atom->extra[i];
  int m = 0;
  for (int k = 0; k < nth; k++) {
    if (m < 0 || m >= atom->nextra_store || !(row[m] >= 1.0 && row[m] <= atom->nextra_store))
      return nullptr;
    m += static_cast<int>(row[m]);
  }
  return m + 1 < atom->nextra_store ? &atom->extra[i][m] : nullptr;
}

/* ---------------------------------------------------------------------- */

void check_types(LAMMPS *lmp)
{
  const Atom *const atom = lmp->atom;
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->type[i] < 1 || atom->type[i] > atom->ntypes)
      lmp->error->one(FLERR,
                      "Particle {} is of type {}, but there are types 1 to {}: the restart file it "
                      "is from is damaged, take "
                      "another one",
                      atom->tag[i], atom->type[i], atom->ntypes);
}

/* ---------------------------------------------------------------------- */

// protected members of LAMMPS

struct Borders : Comm {
  static int group(Comm *comm) { return comm->*&Borders::bordergroup; }
};

struct Masses : FixPropertyAtom {
  static bool sent_by(FixPropertyAtom *fix)
  {
    return fix->*&Masses::rmass_flag && fix->*&Masses::border;
  }
};

void check_ghosts(LAMMPS *lmp)
{
  if (Borders::group(lmp->comm))
    lmp->error->all(FLERR,
                    "Pairs across ranks and periodic faces need ghosts of all particles: use "
                    "comm_modify group all");

  // these lists take a pair with a ghost by the sum of both IDs, which must not overflow

  const Atom *const atom = lmp->atom;
  if (lmp->force->newton_pair &&
      (lmp->domain->triclinic || lmp->neighbor->style == Neighbor::NSQ)) {
    tagint largest = 0, here = 0;
    for (int i = 0; i < atom->nlocal; i++) here = MAX(here, atom->tag[i]);
    MPI_Allreduce(&here, &largest, 1, MPI_LMP_TAGINT, MPI_MAX, lmp->world);
    if (largest > MAXTAGINT / 2)
      lmp->error->all(FLERR,
                      "IDs up to {} are too large for neighbor style nsq and tilted boxes: pairs "
                      "would be counted twice: use reset_atoms id, or newton off",
                      largest);
  }

  if (!atom->rmass) return;
  const std::vector<std::string> &sent = atom->avec->fields_border;
  if (std::find(sent.begin(), sent.end(), "rmass") != sent.end()) return;
  for (Fix *const fix : lmp->modify->get_fix_by_style("^property/atom"))
    if (auto *const one = dynamic_cast<FixPropertyAtom *>(fix); one && Masses::sent_by(one)) return;
  lmp->error->all(FLERR,
                  "Masses of particles are not those of their ghosts: use fix ID all "
                  "property/atom rmass ghost yes");
}

/* ---------------------------------------------------------------------- */

void RestartSection::append(const void *values, std::size_t n)
{
  bytes.append((const char *) values, n);
}

void RestartSection::put(const std::string &text)
{
  const std::uint64_t n = text.size();
  put(&n, 1);
  append(text.data(), n);
}

RestartSection::Header RestartSection::header() const
{
  Header made = {MARK + form, bytes.size(), checksum(bytes.data(), bytes.size()), 0};
  made.own = checksum(&made, 3 * sizeof(std::uint64_t));
  return made;
}

void RestartSection::write(FILE *fp) const
{
  const Header head = header();
  fwrite(&head, sizeof(head), 1, fp);
  fwrite(bytes.data(), 1, bytes.size(), fp);
}

void RestartSection::write_state(FILE *fp) const
{
  const int size = sizeof(Header) + bytes.size();
  fwrite(&size, sizeof(int), 1, fp);
  write(fp);
}

/* ---------------------------------------------------------------------- */

RestartSection::RestartSection(LAMMPS *lmp, const std::string &whose, int form, FILE *fp) :
    form(form), whose(whose), lmp(lmp)
{
  const bool reads = lmp->comm->me == 0;
  Header head;
  if (reads) utils::sfread(FLERR, &head, sizeof(head), 1, fp, nullptr, lmp->error);
  MPI_Bcast(&head, sizeof(head), MPI_BYTE, 0, lmp->world);
  check(head);
  bytes.resize(head.size);
  if (reads && head.size) utils::sfread(FLERR, &bytes[0], 1, head.size, fp, nullptr, lmp->error);
  MPI_Bcast(&bytes[0], head.size, MPI_BYTE, 0, lmp->world);
  check_sum(head);
}

RestartSection::RestartSection(LAMMPS *lmp, const std::string &whose, int form, const char *state) :
    form(form), whose(whose), lmp(lmp)
{
  Header head;
  memcpy(&head.form, state, sizeof(head.form));    // LAMMPS does not say how much there is
  if (head.form != MARK + form) refuse();
  memcpy(&head, state, sizeof(head));
  check(head);
  bytes.assign(state + sizeof(head), head.size);
  check_sum(head);
}

void RestartSection::check(const Header &head) const
{
  if (head.form != MARK + form) refuse();
  if (head.own != checksum(&head, 3 * sizeof(std::uint64_t))) check_sum(Header());
}

void RestartSection::check_sum(const Header &head) const
{
  if (head.own && head.sum == checksum(bytes.data(), bytes.size())) return;
  lmp->error->all(FLERR, "{}: the restart file is damaged, its checksum is wrong: take another one",
                  whose);
}

void RestartSection::refuse() const
{
  lmp->error->all(FLERR,
                  "{}: the restart file is of another version of the package, or damaged: begin "
                  "from a data file or "
                  "another restart file",
                  whose);
}

void RestartSection::take(void *values, std::size_t n)
{
  if (n > left()) refuse();
  memcpy(values, bytes.data() + at, n);
  at += n;
}

std::string RestartSection::text()
{
  const auto n = get<std::uint64_t>();
  if (n > left()) refuse();
  at += n;
  return bytes.substr(at - n, n);
}

}    // namespace HVI
