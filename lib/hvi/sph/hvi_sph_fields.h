/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_SPH_FIELDS_H
#define LMP_HVI_SPH_FIELDS_H

#include "hvi_mirror.h"
#include "hvi_sph.h"
#include "hvi_sph_touching.h"
#include "hvi_stress.h"

#include <memory>
#include <string>
#include <vector>

namespace HVI {

// what pair_style and pair_coeff hvi/sph say; written by that pair style, read by all

struct SphSettings {
  std::string kernel;    // empty: there was no pair_style hvi/sph yet
  std::string text;      // all of pair_style, for messages and restart files
  double support = 0.0;
  SphLaws laws = {};
  bool variable = false;             // h
  double hmin = 0.5, hmax = 1.25;    // its bounds, in units of the start value
  bool energy = true, density = false, riemann = false;
  bool solid = false;    // of a run: there is fix hvi/johnson-cook
  MirrorPlanes mirror;
  std::vector<double> h;    // by type, 0: not a particle of this style

  bool is_stock() const { return laws.stock; }

  // Zisis et al. eq 20, dh/dt = -(1/D) (h/rho) drho/dt, integrates to h rho^(1/D) = const:
  // only the constant, hscale, is kept for a particle

  double hscale(int itype, double rho) const;
  double smoothing_length(int itype, double rho, double hscale) const;
};

/* ----------------------------------------------------------------------
   The packed records of SPH particles, in one place.

   record     of                        written by, when                               read by
   place      owned, ghosts, images     HVIScheme::start()                             sweeps, time step
   state      owned, ghosts, images     HVIScheme::start()                             sweeps, time step, pressure()
   slopes     owned, ghosts             first sweep; reverse, then forward comm.       second sweep
   rates      owned, ghosts, images     second sweep; images folded back to owners     HVIScheme: f, drho, desph

   Of solids only, by HVISchemeSolid:
   gradv      owned, ghosts, images     first sweep; folded, reverse; then L H^-1      second sweep (riemann),
              owned                     and M^-1 in place of M                         velocity_gradient()
   traction   owned                     start(): p, rho, v; correct_gradients(),       second sweep, pressure(),
                                        advance(), find_tractions()                    density(), divergence()
   art        owned                     exchange()                                     second sweep
   of both    ghosts, images            forward communication; reflected
   touching   as gradv and traction, of what touches other bodies or, as rubble, rubble: see SphTouching
   rates      drho is written by advance() first, without pairs

   They hold from a force evaluation to the next exchange of particles, that is: through
   final_integrate and end_of_step, and through the initial_integrate that follows, unless a
   new run needs others.
   Nothing here migrates, nothing is in restart files: what must outlive a
   step is in the arrays of LAMMPS and of fixes.  What a scene has no use for is
   not allocated.
------------------------------------------------------------------------- */

class SphFields {
 public:
  SphSettings settings;    // of the present run

  // for the pair style

  void choose(int terms);    // bits of SphScene: which records the scene has
  bool grow(int n,
            int spare = 0);    // to hold n of each; true: they did not, and contents are lost
  const SphView &view() const { return records; }
  std::string arrays();    // those of this scene, with bytes per particle: for people
  double bytes_per_particle();
  double bytes() { return nmax * bytes_per_particle() + touching.bytes(); }

  // of the last forces, for fixes; owned particles, sums over this rank

  double pressure(int i) const;
  double density(int i) const { return traction ? traction[i].rho : state[i].rho; }

  // of solids: velocity gradient of the middle of the step, its trace with all neighbors, which changes density;
  // forces of SPH alone

  VelocityGradient velocity_gradient(int i) const { return gradv[i].gradient(); }
  double divergence(int i) const { return traction[i].div; }
  const double *own_force(int i) const { return &rates[i].fx; }
  bool asleep(int i) const { return (std::size_t) i < sleepers.size() && sleepers[i]; }

  static bool is_frozen(double rho) { return rho == 0.0; }    // takes no part: fix hvi/sph bad

  // of particles in elements, owned and ghosts: their type, else 0; whether nothing acts on them.  Empty:
  // there are no elements

  std::vector<int> embedded;
  std::vector<char> idle;
  bool is_idle(int i) const { return (std::size_t) i < idle.size() && idle[i]; }
  double cost(int i) const    // in a step, of an owned particle over an active one: bench/README.md
  {
    return asleep(i) || is_idle(i) ? 0.4 : 1.0;
  }
  std::vector<char> sleepers;    // owned particles that nothing happens to; empty: there are none
  double viscous_power = 0.0;    // heat of viscosity, of particles that fix hvi/sph integrates
  double plane_force[3] = {0, 0, 0};    // of mirror planes on the particles
  bool along[3] = {true, true,
                   true};    // the directions in which particles extend, laws.dim of them

 private:
  int nmax = 0;
  int terms = 0;    // bits of SphScene
  SphView records;

  std::unique_ptr<SphPlace[]> place;
  std::unique_ptr<SphState[]> state;
  std::unique_ptr<SphRates[]> rates;
  std::unique_ptr<SphSlopes[]> slopes;
  std::unique_ptr<SphStress[]> art;
  std::unique_ptr<SphGradV[]> gradv;
  std::unique_ptr<SphTraction[]> traction;
  SphTouching touching;

  template <class Each> void each_array(const Each &);
};

}    // namespace HVI

#endif
