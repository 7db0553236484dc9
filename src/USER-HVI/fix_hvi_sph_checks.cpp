/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

// what must be right before a run, or is unlikely to be meant; the rest of the class is in fix_hvi_sph.cpp

#include "fix_hvi_sph.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix_hvi_store.h"
#include "hvi_timestep.h"
#include "modify.h"
#include "update.h"

#include <string>

using namespace LAMMPS_NS;

/* ----------------------------------------------------------------------
   a run that goes on from a restart file has the settings and the materials it was written with
------------------------------------------------------------------------- */

void FixHVISPH::check_restart() const
{
  if (restored.empty()) return;
  const std::string &now = store->fields.settings.text;
  const size_t end = restored.find('\n');
  if (restored.substr(0, end) != now)
    error->all(FLERR,
               "Fix hvi/sph: the restart file was written with pair_style hvi/sph {}, this run "
               "uses {}",
               restored.substr(0, end), now);

  for (const std::string &word : utils::split_words(restored.substr(end + 1))) {
    const int itype = std::stoi(word);
    const HVI::Materials::Entry &entry = store->materials.entry(itype);
    const std::string checksum = word.substr(word.find(':') + 1);
    if (!entry.material || std::to_string(entry.material->checksum) == checksum) continue;
    static constexpr char SAYS[] =
        "Fix hvi/sph: numbers of material {} of type {} are not those the restart file was written "
        "with{}";
    if (entry.restored)
      error->all(FLERR, SAYS, entry.material->name, itype,
                 ": give pair_coeff again if the new ones are meant");
    else if (comm->me == 0)
      error->warning(FLERR, SAYS, entry.material->name, itype, "");
  }
}

/* ----------------------------------------------------------------------
   Energy that flows into particles whose density and energy nobody integrates is lost to the books;
   a piston that fix move or fix rigid moves is meant so
------------------------------------------------------------------------- */

void FixHVISPH::check_left_out() const
{
  int known = groupbit | wallbit;
  for (const Fix *const other : modify->get_fix_list())
    if (utils::strmatch(other->style, "^sph") || utils::strmatch(other->style, "^meso") ||
        utils::strmatch(other->style, "^move$") || utils::strmatch(other->style, "^rigid"))
      known |= other->groupbit;
  bigint here = 0, everywhere;
  for (int i = 0; i < atom->nlocal; i++)
    if (has_material(i) && !(atom->mask[i] & known)) here++;
  MPI_Allreduce(&here, &everywhere, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (everywhere && comm->me == 0)
    error->warning(
        FLERR,
        "Fix hvi/sph: {} particles with a material are integrated by no fix: their density "
        "and energy stay, and what flows into them is missing in compute hvi/energy (walls "
        "GROUP if that is meant)",
        everywhere);
}

// a fixed step that signals, or stiff pairs of other styles, outrun

void FixHVISPH::check_step() const
{
  if (!modify->get_fix_by_style("^hvi/dt$").empty()) return;
  const double stable = HVI::stable_step(lmp, 1.0);
  if (stable > 0.0 && update->dt > stable && comm->me == 0)
    error->warning(
        FLERR,
        "Fix hvi/sph: the time step {} is above the stable one, about {}: use fix hvi/dt, "
        "or a third of that",
        update->dt, stable);
}

/* ----------------------------------------------------------------------
   For the restart file: the settings of the pair style, and the checksums of the numbers of
   materials, which a run that goes on must not change unnoticed
------------------------------------------------------------------------- */

std::string FixHVISPH::settings() const
{
  const FixHVIStore *const now = store ? FixHVIStore::find(lmp) : nullptr;
  if (!now) return restored;
  std::string text = now->fields.settings.text + "\n";
  for (int itype = 1; itype <= atom->ntypes; itype++)
    if (const HVI::Material *const material = now->materials.of(itype))
      text += fmt::format("{}:{} ", itype, material->checksum);
  return text;
}
