/// Creeping flow at a density that is not the medium's own.
///
/// A medium of abrasive flow machining (10 to 1e4 Pa s) flows at Reynolds numbers of 1e-5 to 1e-3: its
/// inertia is nothing beside its viscosity, and the flow in pascals, metres and seconds does not depend on
/// its density. The stable steps do: 0.125 h^2 rho/eta and h/c_0. So the density is chosen that makes
///
///     Re = rho U w/eta_w
///
/// a given number up to about 1, at the mean speed U, the width w and the wall's viscosity eta_w of the
/// narrowest passage, and the sound speed that changes the density by a given share under the pressure drop,
///
///     c_0^2 = dp/(share rho),   dp = 2 tau_w L/w.
///
/// Pressures, viscosities, speeds and forces are real; kinetic energies and momenta are those of the density
/// chosen. What is left of inertia is an error in proportion to Re (cases/abrasive_slit/README.md). eta_w and
/// tau_w are those of the developed flow (passage_flow.hpp); about an axis the passage is a tube of the
/// diameter w and dp = 4 tau_w L/w. What slides is not sheared: with slip Re is over the share 1 - u_s/U of
/// the viscosity, so that inertia stays as small beside the pressure drop.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/case/parameter_table.hpp"
#include "common/scene/scene.hpp"
#include "fluid_solver/passage_flow.hpp"
#include "fluid_solver/terms/equation_of_state.hpp"

namespace toryu::fluid {

struct Parameters;

struct Similarity {
  double mean_speed = 0;         ///< U in the narrowest passage [m/s]
  double passage_width = 0;      ///< w, of a tube the diameter [m]
  double passage_length = 0;     ///< L, what else the medium passes counted in [m]
  double reynolds_number = 1.0;  ///< that is computed
  double compression = 0.01;     ///< change of the density over the pressure drop
};
void describe(ParameterTable& table, Similarity& similarity);

/// What similarity makes of a case.
struct SimilarMedium {
  PassageFlow passage;
  double pressure_drop = 0;         ///< of the passage [Pa]
  double density = 0;               ///< that is computed [kg/m3]
  double sound_speed = 0;           ///< [m/s]
  double real_reynolds_number = 0;  ///< of the medium's own density
};
SimilarMedium similar_medium(const Parameters& parameters, Geometry geometry = Geometry::plane);

/// The background pressure that such a medium has unless the case says another.
BackgroundPressure similar_background(const SimilarMedium& similar);

/// What stands against similarity in a case: key and fault.
struct SimilarityFault {
  std::string key, message;
};
std::vector<SimilarityFault> similarity_faults(const Parameters& parameters, Geometry geometry,
                                               bool with_solid);

/// Puts the density that is computed, sound speed, background pressure and the friction's regularisation into
/// `parameters`, where the case does not say them, and keeps the weight rho g. Returns what the log says.
std::string make_similar(Parameters& parameters, Scene& scene);

/// What of the scene spoils a flow made similar: pistons that start sooner than sound crosses the medium, or
/// are faster than the passage; a sound speed that is too low; a kernel whose rows do not slide under the
/// pressure.
std::vector<std::string> similarity_warnings(const Parameters& parameters, const Scene& scene);

/// Where the case computes the inertia of a creeping flow: what would be cheaper.
std::optional<std::string> creeping(const Parameters& parameters, const Scene& scene);

}  // namespace toryu::fluid
