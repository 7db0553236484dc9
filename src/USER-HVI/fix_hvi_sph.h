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

#include "fix_hvi_records.h"
#include "hvi_energy_carrier.h"

#include <cstdint>
#include <string>

namespace LAMMPS_NS {

// of a particle, beyond what atom_style sph keeps

struct HVISPHExtra {
  double drho, de;     // second half of the step in progress, as extrapolated
  double rho, esph;    // values the last rates belong to
  uint64_t mark;       // fingerprint of the state at the end of the last run
  double hscale;       // h rho^(1/dim), 0: not known yet

  // after a step: by how much the rates and the acceleration have changed in it; in its middle: those
  // before it

  double trend_rho, trend_e, trend_v[3];

  // of solids with gradient corrected: velocity with which the last forces did work (of what others move
  // where it was then), density they belong to (else 0), and what L has in its rate (0 between steps)

  double working[3], settled, stretch;
  double step;    // that ended with the last forces; 0: none
};

class FixHVISPH : public FixHVIRecords<FixHVISPH, HVISPHExtra>, public HVI::EnergyCarrier {
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
  int pack_border(int, int *, double *) override;
  int unpack_border(int, int, double *) override;
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  double compute_scalar() override;
  double compute_vector(int) override;

  // for pair hvi/sph, solids with gradient corrected: the velocity of the end of the step, as
  // extrapolated; the step, also in the setup of a run that goes on; whether density and stress are
  // those of its begin; density with div v of its middle; stress, when all have density and trial stress

  const double *working_velocity(int i) const;
  double step() const { return last; }
  bool is_due() const { return due; }
  double settle_density(int i, double div);

  // for fix hvi/fem: a particle in an element is moved by it, with this velocity at the end of the step;
  // when it is free in the middle of a step, it goes on with density and energy as they are, the latter with de
  // beyond the middle

  void carry(int i, const double *working);
  void let_go(int i, double de);
  void settle_solids();

  double sleep() const { return quiet; }    // differences that count as none; 0: nothing sleeps
  bool relative_lists() const { return relative; }
  bool is_new(int i) const { return extra[i].hscale == 0.0; }    // in no run before
  double hscale(int i) const { return extra[i].hscale; }         // owned and ghost particles

  // in the middle of a step esph is ahead of the velocity

  double internal_energy(int i) const override { return -extra[i].de; }

 private:
  using Extra = HVISPHExtra;
  static const Field FIELDS[];

  class FixHVIStore *store;    // materials, and records of the last forces
  class FixHVILedger *ledger;
  class FixHVIJohnsonCook *strength;    // of solids, which it integrates when asked to
  double dtv, dtf;
  double power;      // viscous, of the last force evaluation
  double push[3];    // of mirror planes, likewise
  double last;       // step, of which forces are the end
  bool due;          // density and stress of solids are those of the begin of the step
  int stepping;      // in a run, so that the state is the one the last step left
  int wallbit;       // groups of particles that are meant to be integrated by nobody
  int follow;        // particles outside the group are moved by fixes that do not know vest
  int checked;       // warned of what may be wrong: once per run, not again with pre no
  double quiet;      // parts of the speed of sound
  bool relative;     // lists are made anew by relative motion

  bool moves(int) const;
  bool integrates(int) const;
  bool has_material(int) const;
  void check_restart() const;
  void check_left_out() const;
  void check_step() const;
  void reflect();
  bool remembers(int) const;
  void keep_places();
  double missed_work(int) const;
  double missed_kick(int) const;
  uint64_t fingerprint(int) const;
  const double *felt_velocity(int) const;
  bool goes_on(int i) const { return extra[i].mark == fingerprint(i); }
  std::string settings() const override;
  Extra stored(int) const override;
};

}    // namespace LAMMPS_NS

#endif
#endif
