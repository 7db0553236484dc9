/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

// Entries for LAMMPS's list of citations (-cite): the package, and the paper of a method where a run uses it

#ifndef LMP_HVI_CITE_H
#define LMP_HVI_CITE_H

#include "hvi_version.h"

#include "citeme.h"

#include <string>

namespace HVI {

static constexpr char CITE_WATSON[] =
    "Bonded discrete elements for impact, pair hvi/contact and bond hvi/spring: "
    "https://doi.org/10.3390/ma10040379\n\n"
    "@Article{Watson2017,\n"
    " author =  {E. Watson and M. O. Steinhauser},\n"
    " title =   {Discrete Particle Method for Simulating Hypervelocity Impact Phenomena},\n"
    " journal = {Materials},\n"
    " year =    2017,\n"
    " volume =  10,\n"
    " number =  4,\n"
    " pages =   {379},\n"
    " doi =     {10.3390/ma10040379}\n"
    "}\n\n";

static constexpr char CITE_ZISIS[] =
    "Equations of shocks in layered media, pair hvi/sph: CASA-report 13-09\n\n"
    "@Misc{Zisis2013,\n"
    " author =       {I. Zisis and B. van der Linden and C. Giannopapa},\n"
    " howpublished = {CASA-report 13-09, Eindhoven University of Technology},\n"
    " year =         2013\n"
    "}\n\n";

static constexpr char CITE_JOHNSON_COOK[] =
    "Failure by damage, fix hvi/johnson-cook: https://doi.org/10.1016/0013-7944(85)90052-9\n\n"
    "@Article{JohnsonCook1985,\n"
    " author =  {G. R. Johnson and W. H. Cook},\n"
    " title =   {Fracture Characteristics of Three Metals Subjected to Various Strains, Strain "
    "Rates, "
    "Temperatures and Pressures},\n"
    " journal = {Engineering Fracture Mechanics},\n"
    " year =    1985,\n"
    " volume =  21,\n"
    " pages =   {31--48},\n"
    " doi =     {10.1016/0013-7944(85)90052-9}\n"
    "}\n\n";

/// the package itself, and `method` (one of the above) where that is given; an entry shows once
inline void cite(LAMMPS_NS::CiteMe *citeme, const char *method = nullptr)
{
  if (!citeme) return;
  citeme->add(
      std::string("lammps-hvi, package USER-HVI: see its CITATION.cff\n\n@Misc{lammps-hvi,\n"
                  " author = {{The lammps-hvi developers}},\n"
                  " title =  {lammps-hvi: hypervelocity impact for LAMMPS},\n"
                  " note =   {version ") +
      HVI_VERSION + "}\n}\n\n");
  if (method) citeme->add(method);
}

}    // namespace HVI

#endif
