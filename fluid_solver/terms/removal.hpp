/// What a case says of wear; surface_record.hpp has the formulas.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <vector>

#include "common/case/parameter_table.hpp"
#include "common/vector.hpp"
#include "fluid_solver/terms/medium.hpp"

namespace toryu::fluid {

/// Wear by Archard (1953): depth = K/H times the integral of p v dt.
struct Archard {
  double wear_coefficient = 0;  ///< K
  double hardness = 0;          ///< H of the work piece [Pa]
};
inline void describe(ParameterTable& table, Archard& law) {
  table.number("wear_coefficient", law.wear_coefficient,
               {.minimum = 0, .required = true, .help = "K of dh/dt = (K/H) p v (Archard 1953)"});
  table.number(
      "hardness", law.hardness,
      {.unit = "Pa", .minimum = 0, .above_minimum = true, .required = true, .help = "H of the work piece"});
}

/// Decay of the roughness where material comes off: Ra = final + (initial - final) exp(-depth/decay_depth).
/// Where each cycle removes the same depth this is the Ra(n) = Ra_f + (Ra_0 - Ra_f) exp(-k n) that is fitted
/// to experiments, k = depth per cycle/decay_depth.
struct Roughness {
  double initial = 0, final = 0, decay_depth = 0;  ///< [m]
};
inline void describe(ParameterTable& table, Roughness& roughness) {
  table.number("initial", roughness.initial,
               {.unit = "m", .minimum = 0, .required = true, .help = "Ra at the start"});
  table.number("final", roughness.final,
               {.unit = "m", .minimum = 0, .required = true, .help = "Ra that the grain leaves in the end"});
  table.number("decay_depth", roughness.decay_depth,
               {.unit = "m",
                .minimum = 0,
                .above_minimum = true,
                .required = true,
                .help = "removed depth after which Ra - Ra_final has fallen to 1/e"});
}

/// What comes off the work pieces. The depth is that of the first law that is given, in this order; the
/// others have columns of their own.
struct Removal {
  static constexpr const char* section = "removal";
  static constexpr const char* help = "what comes off the work pieces; writes surface.h5";
  double preston_coefficient = 0;  ///< k of dh/dt = k p v (Preston 1927) [1/Pa]; 0: not used
  std::optional<Archard> archard;
  std::optional<Roughness> roughness;
  double shear_coefficient = 0;  ///< k of dh/dt = k tau v (Fouvry et al. 2003) [1/Pa]; 0: not used
  double grain_length = 1e-4;    ///< where the medium sticks, v is the wall's shear rate times this [m]
};
inline void describe(ParameterTable& table, Removal& removal) {
  table.number("preston_coefficient", removal.preston_coefficient,
               {.unit = "1/Pa", .minimum = 0, .help = "k of dh/dt = k p v (Preston 1927); 0: not used"});
  table.number(
      "shear_coefficient", removal.shear_coefficient,
      {.unit = "1/Pa",
       .minimum = 0,
       .help = "k of dh/dt = k tau v: the work of the surface's shear stress (Fouvry et al. 2003); 0: "
               "not used"});
  table.number("grain_length", removal.grain_length,
               {.unit = "m",
                .minimum = 0,
                .above_minimum = true,
                .help = "under no slip the sliding speed v is the shear rate at the wall times this, as of a "
                        "grain that stands off the wall by so much; free slip and [fluid.wall_slip] have a "
                        "speed of their own"});
  table.optional("archard", removal.archard, "Archard's law beside or instead of Preston's");
  table.optional("roughness", removal.roughness, "decay of the roughness with the removed depth");
  table.require(
      removal.preston_coefficient > 0 || removal.archard || removal.shear_coefficient > 0,
      "preston_coefficient",
      "[fluid.removal] needs a preston_coefficient, a shear_coefficient or [fluid.removal.archard]");
}

/// A law's depth: `rate` times the integral of p v dt, or of tau v dt.
struct DepthLaw {
  const char* column;  ///< of surface.h5
  double rate;         ///< [1/Pa]
  bool of_shear;
};
/// Those that are given; the first counts.
inline std::vector<DepthLaw> depth_laws(const Removal& removal) {
  std::vector<DepthLaw> laws;
  if (removal.preston_coefficient > 0) laws.push_back({"preston_depth", removal.preston_coefficient, false});
  if (const auto& law = removal.archard)
    laws.push_back({"archard_depth", law->wear_coefficient / law->hardness, false});
  if (removal.shear_coefficient > 0) laws.push_back({"shear_depth", removal.shear_coefficient, true});
  return laws;
}

}  // namespace toryu::fluid
