/// Chooses the formulation of the solid that the case asks for.
#pragma once

#include <memory>

#include "solid_solver/solid_model.hpp"

namespace toryu::solid {

std::unique_ptr<SolidModel> make_model(const Parameters& parameters, const Body& body, const Scene& scene);

}  // namespace toryu::solid
