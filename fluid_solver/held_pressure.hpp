/// The pressure at which a press holds an enclosed medium, and that the sums of the momentum do not know
/// (terms/enclosed_medium.hpp).
#pragma once

#include "fluid_solver/boundary.hpp"
#include "fluid_solver/ranks/ranks.hpp"
#include "fluid_solver/terms/enclosed_medium.hpp"
#include "fluid_solver/terms/equation_of_state.hpp"

namespace toryu::fluid {

/// What of their pressure pressed walls keep from the medium: q; 0 where it is not enclosed or none is
/// pressed [Pa].
double kept_pressure(const std::optional<EnclosedMedium>& medium, const std::vector<Boundary>& boundaries,
                     const EquationOfState& state);

/// What contact adds to the pressure of each particle; 0 if the medium is not enclosed [Pa]. To the last bit
/// the same over any number of ranks.
double pressure_offset(const std::optional<EnclosedMedium>& medium, const Particles& fluid,
                       const std::vector<Boundary>& boundaries, const EquationOfState& state,
                       const Ranks* ranks = nullptr);

}  // namespace toryu::fluid
