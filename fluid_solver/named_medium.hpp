/// Media by name, with what was published of them: `[fluid.medium]`.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/case/parameter_table.hpp"
#include "common/scene/scene.hpp"
#include "fluid_solver/particles.hpp"
#include "fluid_solver/terms/laminar_viscosity.hpp"
#include "fluid_solver/terms/rheology.hpp"

namespace toryu::fluid {

struct Parameters;

/// A medium of the list in named_medium.cpp.
struct NamedMedium {
  std::string name;
};
void describe(ParameterTable& table, NamedMedium& medium);

/// What is known of it.
struct MediumRecord {
  std::string name;
  std::variant<LaminarViscosity, PowerLaw> law;
  double largest_shear_rate;  ///< up to which the law was measured [1/s]
  std::string source;
};
/// Throws std::logic_error where there is none of that name.
const MediumRecord& record_of(const NamedMedium& medium);

/// Gives `parameters` the law of the medium that they name. Returns what the log says.
std::string take_named_medium(Parameters& parameters);

/// A sentence where the passage of [fluid.similarity] shears the medium faster than was measured.
std::optional<std::string> beyond_measured(const Parameters& parameters, Geometry geometry = Geometry::plane);

/// A sentence where a hundredth of the fluid is sheared faster than was measured of the medium.
std::optional<std::string> beyond_measured(const MediumRecord& medium, const Particles& fluid, double time);

}  // namespace toryu::fluid
