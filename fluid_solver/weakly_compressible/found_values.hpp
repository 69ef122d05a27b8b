/// What the last evaluation has found, kept while another one looks at the same state.
#pragma once

#include <optional>

#include "fluid_solver/boundary.hpp"

namespace toryu::fluid {

/// Of the fluid all that an evaluation finds; of boundaries what it finds for particles with fluid near them,
/// for the others it leaves alone.
class FoundValues {
 public:
  FoundValues(Particles& fluid, std::vector<Boundary>& boundaries);
  void bring_back();

 private:
  /// Of one boundary.
  struct OfBoundary {
    std::vector<std::optional<Field>> values = {};  ///< of the fields that are there
    std::vector<Vec> force_by_cluster = {}, friction_by_cluster = {};
  };
  Particles& fluid_;
  std::vector<Boundary>& boundaries_;
  std::vector<Field> of_fluid_ = {};
  std::vector<OfBoundary> of_boundaries_ = {};
};

}  // namespace toryu::fluid
