/// What a case says of consistent gradients; weakly_compressible/consistent_gradients.hpp has the formulas.
#pragma once

#include <fmt/format.h>

#include <optional>

#include "common/case/parameter_table.hpp"
#include "common/vector.hpp"
#include "fluid_solver/terms/medium.hpp"

namespace toryu::fluid {

/// Rates that are exact in linear fields, see consistent_gradients.hpp.
struct ConsistentGradients {
  static constexpr const char* section = "consistent_gradients";
  static constexpr const char* help =
      "divergence and pressure gradient exact in linear fields (Randles & Libersky 1996)";
};
inline void describe(ParameterTable&, ConsistentGradients&) {}

inline ActiveTerm text(const ConsistentGradients&, const Medium&) {
  return {"consistent gradients", "sum_j V_j (f_j - f_i) L_i gradW_ij of velocity and pressure",
          "Randles & Libersky 1996", ""};
}

}  // namespace toryu::fluid
