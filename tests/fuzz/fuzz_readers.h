/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi: hypervelocity impact for LAMMPS, GNU GPL version 2, see LICENSE
   What must hold for any bytes that are taken for a material file or a table of an equation of state.
   Fed by libFuzzer (make fuzz), and with what was found once by tests/unit/test_fuzz.cpp.
------------------------------------------------------------------------- */

#ifndef HVI_FUZZ_READERS_H
#define HVI_FUZZ_READERS_H

#include "hvi_laws.h"
#include "hvi_material.h"
#include "hvi_solid_model.h"

#include <cmath>
#include <string>
#include <vector>

namespace Fuzz {

using namespace HVI;

// an answer is finite with a speed of sound, or there is none, and both numbers are NaN

inline std::string check_eos(const Eos &eos)
{
  const double rho0 = eos.rho0() > 0.0 ? eos.rho0() : 1.0, csq0 = eos.c0() * eos.c0();
  std::vector<double> densities = {0.0, -rho0, NO_LIMIT, NAN, 1e-300, 1e300};
  for (double x = 0.0625; x < 20.0; x *= 1.25) densities.push_back(x * rho0);
  densities.push_back(std::nextafter(eos.rho_max(), 0.0));
  for (const double rho : densities)
    for (const double x :
         {0.0, 1e-6, 0.1, 1.0, 100.0, -0.1, -100.0, 1e300, NO_LIMIT, double(NAN)}) {
      const double e = csq0 > 0.0 ? x * csq0 : x;
      double p = 7.0, csq = 7.0;
      const bool good = eos.evaluate(rho, e, p, csq);
      if (good ? !(std::isfinite(p) && std::isfinite(csq) && csq > 0.0)
               : !(std::isnan(p) && std::isnan(csq)))
        return "evaluate(" + std::to_string(rho) + ", " + std::to_string(e) + ") gives " +
            std::to_string(p) + ", " + std::to_string(csq);
      eos.temperature(rho, e);
    }
  return "";
}

// a solid that is sheared, compressed and pulled has a finite stress and a strain that grows, or says that it has none

inline std::string check_solid(const Material &material, const SolidOptions &options)
{
  std::string problem;
  const auto model = SolidModel::make(material, options, problem);
  if (!model) return problem.empty() ? "no model of a solid, and no reason" : "";
  const double rho0 = material.eos->rho0(), rate = 0.01 * material.eos->c0();
  SolidInput in = {rho0, 0.0, 0.0, {}, 7, 1.0};
  SolidState s = SolidModel::blank();
  model->start(s, in, true);
  SolidState *const list[] = {&s};
  for (int step = 0; step < 12 && !s.failed(); step++) {
    const double sign = step < 6 ? -1.0 : 1.0;    // pressed, then pulled
    in.rho = rho0 * (1.0 - sign * 0.02 * (step % 6));
    in.expansion = sign * rate;
    in.L = {};
    in.L.xx = sign * rate;
    in.L.xy = rate;
    double csq;
    if (!material.eos->evaluate(in.rho, in.e, in.p, csq)) return "";
    model->begin_step(s, in);
    const double eps = s.eps;
    if (model->advance(1, list, &in, 1.0 / material.eos->c0()) != -1) return "";
    const double all[] = {s.S.xx, s.S.yy, s.S.zz, s.S.xy, s.S.xz, s.S.yz, s.eps};
    for (const double x : all)
      if (!std::isfinite(x)) return "solid " + options.strength + ": stress or strain not finite";
    if (!(s.eps >= eps)) return "solid " + options.strength + ": plastic strain shrinks";
    if (std::isnan(s.damage) || std::isnan(s.voids.phi) || std::isnan(s.voids.D))
      return "solid " + options.strength + ": damage is not a number";
    if (std::isnan(model->pressure(s, in))) return "solid: pressure is not a number";
    model->temperature(s, in);
    model->fragments(s);
  }
  return "";
}

// a message begins with the name of the file, and is one line

inline std::string check_message(const std::string &problem)
{
  if (problem.rfind("x.hvi:", 0) != 0) return "message without the file: " + problem;
  if (problem.find('\n') != std::string::npos) return "message of two lines: " + problem;
  return "";
}

// text: a material file; what stands behind a line "---" is the table that it names

inline std::string check_material(std::string text)
{
  const size_t cut = text.find("\n---\n");
  const std::string table = cut == std::string::npos ? "" : text.substr(cut + 5);
  if (cut != std::string::npos) text.resize(cut + 1);
  const ReadText read = [&table](const std::string &, std::string &out) {
    out = table;
    return std::string(table.empty() ? "no table" : "");
  };
  for (const char *const units : {"si", "cgs", "micro", "lj"}) {
    Material material, again;
    const std::string problem = parse_material(text, "x.hvi", units, material, read);
    if (problem != parse_material(text, "x.hvi", units, again, read) ||
        material.checksum != again.checksum)
      return "two readings differ";
    if (!problem.empty()) {
      const std::string wrong = check_message(problem);
      if (!wrong.empty()) return wrong;
      continue;
    }
    if (!material.eos) return "no equation of state, and no message";
    const std::string wrong = check_eos(*material.eos);
    if (!wrong.empty()) return wrong;
    for (const Section &section : material.sections) {
      if (section.kind != "strength") continue;
      for (const SpallModel &spall : SPALL_MODELS)
        for (const bool damage : {false, true}) {
          SolidOptions options;
          options.strength = section.law;
          options.spall = spall.model;
          options.damage = damage;
          options.thermal = damage;
          const std::string said = check_solid(material, options);
          if (!said.empty()) return said + " (spall " + spall.name + ", units " + units + ")";
        }
    }
  }
  return "";
}

inline std::string check_table(std::string text)
{
  for (const char *const units : {"si", "cgs", "micro", "lj"}) {
    std::string problem, date;
    const auto eos = parse_table(text, "x.hvi", units, problem, date);
    if (eos ? !problem.empty() : problem.empty()) return "neither a table nor a message, or both";
    const std::string wrong = eos ? check_eos(*eos) : check_message(problem);
    if (!wrong.empty()) return wrong;
    checksum_of_table(text);
  }
  return "";
}

}    // namespace Fuzz

#endif
