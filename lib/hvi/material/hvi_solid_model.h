/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_SOLID_MODEL_H
#define LMP_HVI_SOLID_MODEL_H

#include "hvi_damage.h"
#include "hvi_material.h"
#include "hvi_spall.h"
#include "hvi_spall_grady.h"
#include "hvi_spall_tuler_butcher.h"
#include "hvi_spall_voids.h"
#include "hvi_strength.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>

namespace HVI {

/* ----------------------------------------------------------------------
   What a solid remembers, whoever it belongs to: a particle, an element.  Doubles only.
------------------------------------------------------------------------- */

struct SolidState {
  Deviator S;    // deviatoric stress, of the time of velocity, density and energy

  // at the begin of the step that has led here: by these forces tell rubble, and signals

  struct {
    double p_min, shear;
  } before;

  double p_min;         // least pressure borne at the end of that step, if it has not failed in it
  double eps;           // equivalent plastic strain
  double damage;        // failed from 1 on
  double initiation;    // 1: damage has begun, by a law with softening
  double spalled;       // 1: spalled for good
  double heat;          // plastic work per mass
  double shear;         // modulus
  double rate;          // of plastic strain
  double expansion;     // -rho'/rho when it began to fail
  double id;            // of the scatter of thresholds; 0: not known yet

  SpallVoids::State voids;    // with the impulse of Tuler & Butcher only D, the part of K used up

  bool failed() const { return damage >= 1.0 || spalled != 0.0; }
};

// where it is, and what its surroundings do to it

struct SolidInput {
  double rho, e, p;          // e per mass; p of the equation of state
  VelocityGradient L;        // of the middle of the step
  std::int64_t id;           // of the scatter of thresholds
  double size;               // spacing, for displacements at failure; see has_size()
  double expansion = 0.0;    // -rho'/rho
};

struct SolidOptions {
  std::string strength = "johnson-cook";    // law; none: of any material, without its section
  bool damage = true;
  std::string damage_law;    // empty: the one that the material has
  Spall spall = Spall::PRINCIPAL;
  bool thermal = true;       // strength depends on temperature
  bool from_work = false;    // which is that of the plastic work, not of the equation of state
  bool melt = false;         // a melt bears no tension; with voids
  double weibull = 0.0;      // modulus of the scatter of failure strains, 0: none
  int seed = 0;
  double reference =
      0.0;    // size of the volume of which thresholds are, of spall too; 0: of damage only,
              // of any size
  int dim = 3;
};

/* ----------------------------------------------------------------------
   Strength, damage, spall and temperature of one material over a step of the leapfrog:

     begin_step()     keeps the least pressure and the modulus of the begin of the step
     ... the velocity gradient of its middle; density, energy, pressure of its end ...
     advance()        stress t -> t + dt: trial stress, voids, radial return, damage, spall

   What has failed is rubble: it bears no shear and no tension, and keeps its state.

   Where damage has a displacement u_f at failure, the law's D = 1 is its initiation, and from then on

     damage' = size eps'/u_f,   yield stress times 1 - damage                      (1)

   so that a layer as thick as size takes up Y u_f/2 per area, whatever its size.  That is the
   softening by plastic displacement of Abaqus (DamageEvolution, type DISPLACEMENT, softening LINEAR) and
   of Radioss (/FAIL/INIEVO), after Hillerborg, Modeer & Petersson, Cem. Concr. Res. 6 (1976) 773.
------------------------------------------------------------------------- */

class SolidModel {
 public:
  // null, and in problem what is wrong, if the material does not go with the options

  static std::unique_ptr<SolidModel> make(const Material &, const SolidOptions &,
                                          std::string &problem);

  const Strength &strength() const { return *law; }
  const Damage *damage() const { return fracture.get(); }    // null: none
  bool spall_limited() const { return with_spall; }
  bool has_voids() const { return with_voids; }
  bool has_size() const
  {
    return (with_voids && voids.delta_c > 0.0) || u_f > 0.0 || reference > 0.0;
  }
  bool softens() const { return u_f > 0.0; }
  double softening_displacement() const { return u_f; }

  // Below that size, 3 G u_f/Y at rest, elastic strain can follow the stress of what softens

  double largest_size() const { return biggest; }

  // of something new, without stress; of something that has no model any more: a liquid

  static SolidState blank();
  static void liquefy(SolidState &);
  static bool started(const SolidState &s) { return s.before.shear != UNSEEN; }

  // Laws that take time share numbers of the state.  What one of them has begun there that this model, or a
  // liquid (nullptr), would ignore or misread; nullptr: nothing.  Rubble is rubble by any law.

  struct Begun {
    const char *what, *law;
  };
  static const Begun *misread(const SolidModel *, const SolidState &);
  static constexpr Begun BEGUN_BY[] = {
      {"voids", "spall voids"},
      {"impulse used up", "spall tuler-butcher"},
      {"damage that softens", "damage of a law with u_f"},
      {"damage that does not soften", "damage of a law without u_f"},
  };

  // anew: changed by others since it was last integrated.  There need be no p and L yet.

  void start(SolidState &, SolidInput, bool anew) const;

  void begin_step(SolidState &, const SolidInput &) const;

  // of n, not more than LANES, that have not failed.  Returns the first whose stress is not a number;
  // -1: all is well.

  int advance(int n, SolidState *const *, const SolidInput *, double dt) const;

  double temperature(const SolidState &, const SolidInput &) const;    // NaN: unknown

  // Has voids.  Whether anything of the input but p counts below.

  bool open(const SolidState &s) const { return with_voids && s.voids.phi > 0.0 && !s.failed(); }
  bool looks(const SolidState &s) const { return open(s) || (own_limit() && !s.failed()); }
  bool own_limit() const { return spall == Spall::PRESSURE && reference > 0.0; }

  // the least pressure borne, and what is left of p; see clip_tension()

  double p_min(const SolidState &s, const SolidInput &in) const
  {
    return open(s) ? SpallVoids::least(s.voids.phi, *eos, in.rho, in.e) : closed(s.failed(), in);
  }
  double pressure(const SolidState &s, const SolidInput &in) const
  {
    return clip_tension(in.p, p_min(s, in));
  }

  // of the matter around voids; rubble has no voids any more, but gaps

  double density(const SolidState &s, double rho) const
  {
    return with_voids && !s.failed() ? rho / (1.0 - s.voids.phi) : rho;
  }

  // of what has failed, into what it has: from the energy of its spall, whichever law it failed by; 0:
  // unknown, or it has not failed

  double fragments(const SolidState &s) const
  {
    return s.failed() ? fragment_size(fragment_energy, rho0, s.expansion) : 0.0;
  }

  // in the directions of op (see hvi_mirror.h)

  static void reflect(SolidState &, int op);

 private:
  static constexpr double UNSEEN = -1.0;    // before.shear, before the first forces
  static constexpr double BEGUN = 0.01;     // damage by voids from which on it fails

  std::unique_ptr<Strength> law;
  std::unique_ptr<Damage> fracture;
  double u_f = 0.0;    // of fracture
  double biggest = NO_LIMIT;
  std::shared_ptr<const Eos> eos;
  double rho0 = 0.0;
  Spall spall = Spall::NONE;
  double sigma_p = 0.0;    // limit of tension
  bool with_spall = false, with_voids = false;
  SpallVoids voids = {};
  SpallTulerButcher impulse = {};
  SpallGrady grady = {};
  double fragment_energy = 0.0;            // per volume, 0: unknown
  double T0 = 0.0, cp = 0.0, chi = 1.0;    // temperature from plastic work
  bool thermal = false, from_work = false, melt = false;
  double weibull = 0.0, reference = 0.0;
  int seed = 0, dim = 3;

  SolidModel() = default;
  std::string take_spall(const Material &);
  void take_energy(const Material &);
  bool parts(SolidState &, double rho, double p, double Y, double limit, double dt) const;
  double grow_voids(SolidState &, const SolidInput &, double limit, double dt) const;
  void grow_damage(SolidState &, const SolidInput &, const Conditions &, double yield, double d_eps,
                   double dt) const;

  // what voids and damage have left of the strength

  double intact(const SolidState &s) const
  {
    double left = with_voids && s.voids.D > 0.0 ? std::max(0.0, 1.0 - s.voids.D) : 1.0;
    if (softens() && s.damage > 0.0) left *= std::max(0.0, 1.0 - s.damage);
    return left;
  }

  // factors of its own, of all thresholds and of those of spall

  double scatter(const SolidInput &in) const
  {
    if (weibull == 0.0) return 1.0;
    const double factor = weibull_factor(seed, in.id, weibull);
    return reference > 0.0 ? factor * size_factor(in.size, reference, dim, weibull) : factor;
  }
  double threshold(const SolidInput &in) const { return reference > 0.0 ? scatter(in) : 1.0; }
  double closed(bool failed, const SolidInput &in) const    // p_min() without voids
  {
    return least_pressure(spall, failed,
                          own_limit() && !failed ? threshold(in) * sigma_p : sigma_p);
  }
  Conditions conditions(const SolidState &, const SolidInput &) const;
  bool molten(const SolidState &, const SolidInput &) const;
};

}    // namespace HVI

#endif
