/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#include "hvi_material_file.h"

#include "comm.h"
#include "error.h"
#include "lammps.h"
#include "platform.h"
#include "update.h"
#include "utils.h"

#include <cstdio>
#include <cstdlib>

using namespace LAMMPS_NS;

namespace {

constexpr size_t LARGEST = 100000000;    // bytes: more is no file of ours, or has no end

#ifdef HVI_POTENTIALS
constexpr char PACKAGE[] = HVI_POTENTIALS;    // folder of the source tree, as cmake has it
#else
constexpr char PACKAGE[] = "";
#endif

// as LAMMPS finds potentials, and then, by a name without folders, the files of the package;
// "" if there is none

std::string path_of(const std::string &filename)
{
  const std::string path = utils::get_potential_file_path(filename);
  if (!path.empty() || !*PACKAGE || platform::path_basename(filename) != filename) return path;
  const std::string own = platform::path_join(PACKAGE, filename);
  return platform::file_is_readable(own) ? own : "";
}

std::string places()
{
  const char *const given = std::getenv("LAMMPS_POTENTIALS");
  return std::string("LAMMPS_POTENTIALS (") + (given && *given ? given : "not set") + ")" +
      (*PACKAGE ? std::string(" or ") + PACKAGE : "");
}

// The text of a file on all ranks; returns what is wrong.

std::string read_text(LAMMPS *lmp, const std::string &what, const std::string &filename,
                      std::string &text)
{
  int length = -1;    // not found, -2: not readable
  if (lmp->comm->me == 0) {
    const std::string path = path_of(filename);
    FILE *fp = path.empty() ? nullptr : fopen(path.c_str(), "rb");
    if (fp) {
      char buffer[4096];
      size_t n;
      while (text.size() <= LARGEST && (n = fread(buffer, 1, sizeof(buffer), fp)) > 0)
        text.append(buffer, n);
      length = ferror(fp)             ? -2
          : text.size() > LARGEST     ? -3
          : text.find('\0') < LARGEST ? -4
                                      : (int) text.size();
      fclose(fp);
    }
  }
  MPI_Bcast(&length, 1, MPI_INT, 0, lmp->world);
  if (length == -1)
    return "Cannot find " + what + " file " + filename + ", neither here nor in " + places();
  if (length == -2) return "Cannot read " + what + " file " + filename + ": is it a folder?";
  if (length == -3)
    return "The " + what + " file " + filename + " is larger than " + std::to_string(LARGEST) +
        " bytes: is it the right one?";
  if (length == -4) return "The " + what + " file " + filename + " is no text: it has a byte of 0";
  text.resize(length);
  MPI_Bcast(&text[0], length, MPI_CHAR, 0, lmp->world);
  return "";
}

void log_date(LAMMPS *lmp, const std::string &what, const std::string &filename,
              const std::string &date)
{
  if (lmp->comm->me == 0 && !date.empty())
    utils::logmesg(lmp, "Reading {} file {} with DATE: {}\n", what, filename, date);
}
}    // namespace

/* ----------------------------------------------------------------------
   all ranks parse the same text, so all of them meet the same error
------------------------------------------------------------------------- */

HVI::Material HVI::read_material_file(LAMMPS *lmp, const std::string &filename)
{
  std::string text;
  std::string problem = read_text(lmp, "material", filename, text);
  if (!problem.empty()) lmp->error->all(FLERR, problem);

  auto read = [lmp](const std::string &name, std::string &table) {
    return read_text(lmp, "table", name, table);
  };
  Material material;
  problem = parse_material(text, filename, lmp->update->unit_style, material, read);
  if (!problem.empty()) lmp->error->all(FLERR, "Material file {}", problem);
  log_date(lmp, "material", filename, material.date);
  log_date(lmp, "table", material.table, material.table_date);
  return material;
}

/* ---------------------------------------------------------------------- */

std::unique_ptr<HVI::Eos> HVI::read_table_file(LAMMPS *lmp, const std::string &filename,
                                               std::uint64_t &checksum)
{
  std::string text;
  std::string problem = read_text(lmp, "table", filename, text);
  if (!problem.empty()) lmp->error->all(FLERR, problem);
  std::string date;
  auto eos = parse_table(text, filename, lmp->update->unit_style, problem, date);
  if (!eos) lmp->error->all(FLERR, "Table file {}", problem);
  checksum = checksum_of_table(text);
  log_date(lmp, "table", filename, date);
  return eos;
}
