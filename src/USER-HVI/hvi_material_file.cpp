/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#include "hvi_material.h"

#include "comm.h"
#include "error.h"
#include "lammps.h"
#include "update.h"
#include "utils.h"

#include <cstdio>

using namespace LAMMPS_NS;

/* ----------------------------------------------------------------------
   all ranks parse the same text, so all of them meet the same error
------------------------------------------------------------------------- */

HVI::Material HVI::read_material_file(LAMMPS *lmp, const std::string &filename)
{
  Error *error = lmp->error;
  std::string text;
  int length = -1;    // not found, -2: not readable
  if (lmp->comm->me == 0) {
    const std::string path = utils::get_potential_file_path(filename);
    FILE *fp = path.empty() ? nullptr : fopen(path.c_str(), "rb");
    if (fp) {
      char buffer[4096];
      size_t n;
      while ((n = fread(buffer, 1, sizeof(buffer), fp)) > 0) text.append(buffer, n);
      length = ferror(fp) ? -2 : (int) text.size();
      fclose(fp);
    }
  }
  MPI_Bcast(&length, 1, MPI_INT, 0, lmp->world);
  if (length == -1)
    error->all(FLERR, "Cannot find material file {}, neither here nor in LAMMPS_POTENTIALS",
               filename);
  if (length == -2) error->all(FLERR, "Cannot read material file {}", filename);
  text.resize(length);
  MPI_Bcast(&text[0], length, MPI_CHAR, 0, lmp->world);

  Material material;
  const std::string problem = parse_material(text, filename, lmp->update->unit_style, material);
  if (!problem.empty()) error->all(FLERR, "Material file {}", problem);
  if (lmp->comm->me == 0 && !material.date.empty())
    utils::logmesg(lmp, "Reading material file {} with DATE: {}\n", filename, material.date);
  return material;
}
