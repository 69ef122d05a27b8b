/// The parts of a solid that are computed each by itself: all of it or, where it has rigid bodies beside
/// elastic regions, these and those. A load and an observer are of the part in which they lie.
#pragma once

#include <vector>

#include "solid_solver/body.hpp"

namespace toryu::solid {

struct Part {
  Parameters parameters;
  Body body;
};

/// The elastic part comes first. Tells as faults, besides those of `build_body`: elastic regions that touch a
/// rigid body, a clamp that holds one, a load that acts on both parts.
std::vector<Part> build_parts(const Parameters& parameters, const TellFault& tell_fault,
                              const std::vector<Vec>& shifts = {Vec::Zero()});

}  // namespace toryu::solid
