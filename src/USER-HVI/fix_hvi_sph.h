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
#include "hvi_sph_records.h"
#include "hvi_sph_step.h"
#include "hvi_timestep.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace LAMMPS_NS {

// of a particle, beyond what atom_style sph keeps

struct HVISPHExtra {
  // what is extrapolated of rho and esph: the second half of the step in progress; 0 between steps

  double drho = 0.0, de = 0.0;
  double rates_rho = 0.0,
         rates_esph = 0.0;    // values of rho and esph that the last rates belong to
  uint64_t mark = 0;          // fingerprint of the state at the end of the last run
  double hscale = 0.0;        // h rho^(1/dim); 0: not known yet

  // of solids: rates of density and energy, and acceleration, at the begin of the last step; NaN: there were none.
  // Of nodes: old_a is velocity_change(), old_drho is NaN until there is a step whose end v_work tells

  double old_drho = NAN, old_de = 0.0, old_a[3] = {0.0, 0.0, 0.0};

  // velocity with which the last forces did work; of nodes, at the end of the step

  double v_work[3] = {0.0, 0.0, 0.0};

  // missed_work() at the end of the last step: other fixes may have changed the velocity since

  double beyond = 0.0;

  // place at the end of the last run; of particles that other fixes move, of the last step

  double x_before[3] = {NAN, NAN, NAN};
  double frozen = 0.0;    // 1: takes no part any more
  double body =
      -1.0;    // of solids: label of what hangs together, and in eighths planes: see body(); -1: none yet
  double new_rho =
      0.0;    // density at the end of the step that led to the last forces; 0: of a fluid

  // that ended with the last forces; 0: none; below 0, in a run: the particle is still, see FixHVISPH::is_still()

  double step = 0.0;

  // of solids, in sums over neighbors: that of the middle of this step over that of its end

  double weight = 1.0;
};

class FixHVISPH :
    public FixHVIRecords<FixHVISPH, HVISPHExtra>,
    public HVI::EnergyCarrier,
    public HVI::TimeStepSource {
 public:
  FixHVISPH(class LAMMPS *, int, char **);
  ~FixHVISPH() override;
  int setmask() override;
  void init() override;
  void setup_pre_force(int) override;
  void set_arrays(int) override;
  void pre_neighbor() override;
  void pre_force(int) override;
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

  // for the scheme of solids: velocity of the end of the step, as extrapolated, with which forces do work; the step,
  // also in the setup of a run that goes on; whether density and stress are to be advanced by it, or are those of
  // its end; the density of its end, with the divergence of velocity in its middle

  const double *work_velocity(int i) const;
  double step() const { return last; }
  double middle_weight(int i) const    // of those in elements rho is that of its begin: not known
  {
    return integrates(i) ? extra[i].weight : 1.0;
  }
  bool is_due() const { return due; }
  double advance_density(int i, double div);
  void advanced() { due = false; }

  // for fix hvi/fem: a particle in an element is moved by it, with this velocity at the end of the step;
  // when it is free in the middle of a step, it goes on with density and energy as they are, the latter with de
  // beyond the middle

  void set_work_velocity(int i, const double *v);
  void let_go(int i, double de);

  // for fix hvi/debris, in the middle of a step: one of n equal parts of a particle that has lost energy, all of it
  // given; a part that moves away by v; what is beyond mirror planes goes where its image is

  void share(int i, int n, double lost);
  void hasten(int i, const double *v);
  void reflect();

  // Keyword bad: a particle that no equation of state answers for takes no part from now on: its density is 0, its
  // momentum and energy stay.  False: that is an error.

  bool freeze(int i, double rho);
  bool may_send_away() const override { return deletes_frozen; }
  bool is_to_go(int i) const override { return has_frozen(i); }
  bool has_frozen(int i) const { return extra[i].frozen != 0.0; }

  // density changes by half in a step at most

  void tighten(HVI::TimeStepBounds &bounds) override;
  bool at_hand() const override { return true; }

  // of a node: by how much other fixes, such as fix momentum, have changed its velocity since the end of the last step

  const double *velocity_change(int i) const { return extra[i].old_a; }
  bool knows_node(int i) const { return !std::isnan(extra[i].old_drho); }

  double sleep() const { return quiet; }    // differences that count as none; 0: nothing sleeps
  bool relative_lists() const { return relative; }
  bool is_new(int i) const { return extra[i].hscale == 0.0; }    // in no run before

  // owned and ghost particles: constant of variable h; label of its body, which the scheme of solids makes, and mirror
  // planes (bits by direction) whose images are other bodies; both in one, for SphState

  static constexpr int ALL_PLANES = HVI::SphState::PLANES;

  double hscale(int i) const { return extra[i].hscale; }
  bool has_body(int i) const { return extra[i].body >= 0.0; }
  int64_t body_code(int i) const { return has_body(i) ? (ALL_PLANES + 1) * extra[i].body : 0; }
  int64_t body(int i) const { return body_code(i) / (ALL_PLANES + 1); }
  int apart_from(int i) const { return body_code(i) & ALL_PLANES; }
  void set_body(int i, int64_t label, int planes)
  {
    extra[i].body = label + planes / (ALL_PLANES + 1.0);
  }
  void tell_ghosts() { comm->forward_comm(this); }

  // in the middle of a step esph is ahead of the velocity; in a setup it waits while forces are asked for

  double internal_energy(int i) const override
  {
    const double waiting = in_setup && integrates(i) ? extra[i].rates_esph - atom->esph[i] : 0.0;
    return waiting - extra[i].de;
  }

 private:
  using Extra = HVISPHExtra;
  static const Field FIELDS[];

  class FixHVIStore *store;    // materials, and records of the last forces
  class FixHVILedger *ledger;
  class FixHVIJohnsonCook *strength;    // of solids; null: there are none
  HVI::SphStep *evaluation;             // of the pair style
  double dtv, dtf;
  std::vector<double> weight_power;    // by type: with which weights of solids go with 1/rho
  double power;                        // viscous, of the last force evaluation
  double push[3];                      // of mirror planes, likewise
  double last;                         // step, of which forces are the end
  bool due;                            // density and stress of solids are those of its begin
  std::vector<double> setup_rho;       // in a setup: of the rates that forces are asked for
  bool in_setup = false;               // in it: rho and esph of particles are these
  int stepping;                        // in a run, so that the state is the one the last step left
  int wallbit;                         // groups of particles that no fix is meant to integrate
  int follow;     // particles outside the group are moved by fixes that do not know vest
  int checked;    // warned of what may be wrong: once per run, not again with pre no
  std::vector<char> told_turned;    // by type, likewise: once
  double quiet;                     // parts of the speed of sound
  bool relative;                    // lists are made anew by relative motion

  bigint most_frozen;    // particles that may be; 0: none
  bool deletes_frozen;
  double swiftest;    // of the last forces: largest |drho/dt|/rho

  void note_change(int);
  void count_frozen() const;
  bool moves(int) const;
  bool integrates(int) const;
  double step_of(int) const;
  bool has_material(int) const;
  void check_restart() const;
  void check_left_out() const;
  void check_turned();
  void check_step() const;
  bool remembers(int) const;
  void give_density(int);
  void keep_places();
  double first_half_solid(int, double dtfm);
  bool is_still(int) const;
  bool may_be_still(int) const;
  bool is_left_alone(int) const;
  double missed_work(int) const;
  double missed_kick(int) const;
  uint64_t fingerprint(int) const;
  std::vector<double> last_at_rest;    // by type: density at rest of its material in the last run
  int moved_by_others = 0;             // bits of groups that other fixes integrate
  bool stands(int) const;
  void check_materials();
  const double *felt_velocity(int) const;
  bool goes_on(int) const;
  std::string settings() const override;
  Extra stored(int) const override;
};

}    // namespace LAMMPS_NS

#endif
#endif
