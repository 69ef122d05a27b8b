/// Chooses the formulation of the solid, or of each of its parts, that the case asks for.
#pragma once

#include <memory>

#include "solid_solver/parts.hpp"
#include "solid_solver/solid_model.hpp"

namespace toryu::solid {

std::unique_ptr<SolidModel> make_model(const Parameters& parameters, const Body& body, const Scene& scene);
std::unique_ptr<Solid> make_solid(const std::vector<Part>& parts, const Scene& scene);

}  // namespace toryu::solid
