/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(hvi/sph,FixHVISPH);
// clang-format on
#else

#ifndef LMP_FIX_HVI_SPH_H
#define LMP_FIX_HVI_SPH_H

#include "fix.h"
#include "hvi_data_rows.h"
#include "hvi_energy_carrier.h"

#include <cstdint>
#include <string>

namespace LAMMPS_NS {

class FixHVISPH : public Fix, public HVI::EnergyCarrier {
 public:
  FixHVISPH(class LAMMPS *, int, char **);
  ~FixHVISPH() override;
  int setmask() override;
  void init() override;
  void setup_pre_force(int) override;
  void pre_force(int) override {}
  void post_integrate() override;
  void setup(int) override;
  void initial_integrate(int) override;
  void final_integrate() override;
  void post_run() override;
  void reset_dt() override;
  void set_arrays(int) override;
  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  int pack_border(int, int *, double *) override;
  int unpack_border(int, int, double *) override;
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  int maxsize_restart() override;
  int size_restart(int) override;
  void write_restart(FILE *) override;
  void restart(char *) override;
  void write_data_section_size(int, int &, int &) override;
  void write_data_section_pack(int, double **) override;
  void write_data_section_keyword(int, FILE *) override;
  void write_data_section(int, FILE *, int, double **, int) override;
  bigint read_data_skip_lines(char *) override { return -1; }    // one per particle
  void read_data_section(char *, int, char *, tagint) override;
  double compute_vector(int) override;
  double memory_usage() override;

  bool is_new(int i) const { return extra[i].hscale == 0.0; }    // in no run before
  int bytes_per_particle() const { return sizeof(Extra); }
  double hscale(int i) const { return extra[i].hscale; }    // owned and ghost particles

  // in the middle of a step esph is ahead of the velocity

  double internal_energy(int i) const override { return -extra[i].de; }

 private:
  // of a particle, beyond what atom_style sph keeps

  struct Extra {
    double drho, de;     // second half of the step in progress, as extrapolated
    double rho, esph;    // values the last rates belong to
    uint64_t mark;       // fingerprint of the state at the end of the last run
    double hscale;       // h rho^(1/dim), 0: not known yet
  };
  static constexpr int NEXTRA = sizeof(Extra) / sizeof(double);

  Extra *extra;
  class FixHVIStore *store;    // materials, and records of the last forces
  class FixHVILedger *ledger;
  class FixHVIJohnsonCook *strength;    // of solids, which it integrates when asked to
  double dtv, dtf;
  double power;            // viscous, of the last force evaluation
  double push[3];          // of mirror planes, likewise
  int stepping;            // in a run, so that the state is the one the last step left
  int wallbit;             // groups of particles that are meant to be integrated by nobody
  int follow;              // particles outside the group are moved by fixes that do not know vest
  std::string restored;    // settings of the pair style in the restart file
  HVIDataRows rows;        // section of data files

  bool integrates(int) const;
  bool has_material(int) const;
  void check_left_out() const;
  void reflect();
  uint64_t fingerprint(int) const;
};

}    // namespace LAMMPS_NS

#endif
#endif
