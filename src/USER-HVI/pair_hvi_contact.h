/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifdef PAIR_CLASS
// clang-format off
PairStyle(hvi/contact,PairHVIContact);
// clang-format on
#else

#ifndef LMP_PAIR_HVI_CONTACT_H
#define LMP_PAIR_HVI_CONTACT_H

#include "hvi_contact_step.h"
#include "hvi_energy_carrier.h"
#include "hvi_timestep.h"
#include "pair.h"

#include <utility>
#include <vector>

namespace LAMMPS_NS {

class PairHVIContact : public Pair, public HVI::TimeStepSource, public HVI::EnergyCarrier {
 public:
  PairHVIContact(class LAMMPS *);
  ~PairHVIContact() override;

  void compute(int, int) override;
  void settings(int, char **) override;
  void coeff(int, char **) override;
  void init_style() override;
  double init_one(int, int) override;
  void setup() override;
  void write_restart(FILE *) override;
  void read_restart(FILE *) override;
  void write_restart_settings(FILE *) override;
  void read_restart_settings(FILE *) override;
  void write_data(FILE *) override;
  void write_data_all(FILE *) override;
  double single(int, int, int, int, double, double, double, double &) override;
  void born_matrix(int, int, int, int, double, double, double, double &, double &) override;
  void *extract(const char *, int &) override;
  void tighten(HVI::TimeStepBounds &) override;
  double pair_cutsq(int itype, int jtype) const override { return law[itype][jtype].cutsq; }
  double pair_energy(int, int, double, double &) const override;

 protected:
  double prefactor;
  int relative;                // 1 if lists are made anew by relative motion
  int uniform;                 // 1 if all pairs of types share one law,
  HVI::Contact common = {};    // and this is it
  double **epsilon, **sigma;
  double **widest;    // sigma of pair_coeff
  HVI::Contact **law;
  std::vector<std::pair<int, int>> made;    // pairs of types whose law is new since the last forces
  std::vector<double> reach;                // of pairs of types, in the lists of the run
  bool looked;                              // for pairs that are deep in each other

  // pairs in touch, a batch of them; NROW at most from a row of the list before there is a look at
  // whether the batch is full

  static constexpr int NROW = 64, NTOUCH = 256;
  struct Touching {
    double delx[NTOUCH], dely[NTOUCH], delz[NTOUCH], rsq[NTOUCH];
    int i[NTOUCH], j[NTOUCH];
  };

  void allocate();
  void check_reach();
  bool one_mass() const;
  void tighten_uniform(HVI::ContactTimes &) const;
  void tighten_each(HVI::ContactTimes &) const;
  template <int EVFLAG, int NEWTON_PAIR, int UNIFORM> void eval();
  template <int EVFLAG, int NEWTON_PAIR, int UNIFORM> void work_off(const Touching &, int);
};

}    // namespace LAMMPS_NS

#endif
#endif
