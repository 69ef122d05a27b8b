/// The section `[coupling]` of a case.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/case/parameter_table.hpp"

namespace toryu::coupling {

/// In which order both sides compute a window: see schemes.hpp.
enum class SchemeKind { serial_robin, serial_explicit, parallel_explicit, serial_implicit };

/// How an iteration gets to its next guess: see acceleration.hpp.
enum class AccelerationKind { fixed, aitken, quasi_newton };

/// `[coupling.implicit]`
struct ImplicitParameters {
  AccelerationKind relaxation = AccelerationKind::aitken;
  double relaxation_factor = 0.5;    ///< fixed: of each step, else of the first one of the run
  double tolerance = 1e-3;           ///< of the residual over the interface's displacement in a window
  int largest_iteration_count = 20;  ///< in a window
  int remembered_windows = 8;        ///< whose differences quasi-Newton uses beside those of the present one
  int unconverged_windows_to_stop = 5;  ///< in a row
};
void describe(ParameterTable& table, ImplicitParameters& p);

/// What is kept of the exchange: `interface.h5`, or `exchange.h5` beside it.
enum class Record { frames, every_window };

struct Parameters {
  SchemeKind scheme = SchemeKind::serial_robin;
  std::optional<ImplicitParameters> implicit;
  int extrapolation_order = 0;  ///< of the interface's motion: see extrapolation.hpp
  int fluid_steps_per_window = 1;
  double time_limit = 30;         ///< [s]
  double largest_false_work = 1;  ///< made by the exchange, over the largest work of the fluid
  Record record = Record::frames;
  std::vector<std::string> loads = {"pressure_and_viscous", "friction"};

  bool passes_on(const std::string& load) const;
  bool windows_repeat() const { return scheme == SchemeKind::serial_implicit; }
};
void describe(ParameterTable& table, Parameters& p);

}  // namespace toryu::coupling
