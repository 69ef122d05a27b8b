/// What a time loop, alone or coupled, needs of a solver. Virtual calls happen once a step, never per
/// particle.
#pragma once

#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/vector.hpp"

namespace toryu {

/// A number that a run reports over time; `name` becomes a column `name[unit]` of the series.
struct Observation {
  std::string name;
  std::string unit;
  double value;
};

/// A field of a frame: `components` values a particle, particle after particle.
struct FrameField {
  std::string name;  ///< full words: "pressure", "velocity"
  std::string unit;
  std::string description;
  int components = 1;  ///< 1, dim (written as 3, the last 0) or dim*dim
  std::vector<double> values;
};

/// All that is drawn of one body of particles at one time.
struct Frame {
  std::vector<double> positions;  ///< dim values a particle [m], particle after particle
  std::vector<FrameField> fields;
};

/// A physical term that is active in a run, for the log and the report.
struct ActiveTerm {
  std::string name;        ///< "artificial viscosity"
  std::string formula;     ///< plain text, the paper's symbols
  std::string source;      ///< "Monaghan 1992; thesis eq. 23-24"
  std::string parameters;  ///< "alpha 0.02, beta 0; effective kinematic viscosity 1.3e-6 m2/s"
};

class Solver {
 public:
  virtual ~Solver() = default;

  /// Largest stable time step from the present state [s].
  virtual double time_step_limit() const = 0;
  /// Which limit rules: "acoustic", "viscous", "force".
  virtual std::string_view time_step_rule() const = 0;
  /// Advances by `dt` [s], which exceeds the limit by a nineteenth at most.
  virtual void advance(double dt) = 0;
  /// Keeps the present state, and brings it back bit by bit, as often as asked: for a window that is
  /// repeated.
  virtual void save() = 0;
  virtual void restore() = 0;
  /// Writes all that the next step depends on, and takes it back: from there on every bit is as if the
  /// program had never ended. `read_state` is called once, before the first step, on a solver made from the
  /// same case and with the same interface.
  virtual void write_state(std::ostream& stream) const = 0;
  virtual void read_state(std::istream& stream) = 0;
  /// The present state is final: no window that led to it will be repeated.
  virtual void accept() {}
  /// Throws PhysicsFailure if a value has left physics at `time`.
  virtual void check(double time) const = 0;

  virtual Frame frame() const = 0;
  /// The rigid walls beside its particles; none if there are none. Where they stand still, one frame is
  /// enough.
  virtual std::optional<Frame> walls() const { return std::nullopt; }
  virtual bool walls_move() const { return false; }
  /// Energies, momentum, observers; the same names in the same order at each call.
  virtual std::vector<Observation> observe() const = 0;
  /// Adds rows to files of the solver's own, as often as the series, and before it asks for observations.
  virtual void record(double /*time*/) {}
  /// Looks, after a row was written, at what shows over a run alone: warns, and throws PhysicsFailure where
  /// the result is spoiled.
  virtual void watch(double /*time*/) {}
  /// Gives those files their final names: no row follows. Throws MachineFailure if that fails.
  virtual void complete_records() {}
  virtual std::vector<ActiveTerm> active_terms() const = 0;
  /// Numbers worth keeping of the run as a whole, for its summary.
  virtual std::vector<std::pair<std::string, double>> figures() const { return {}; }
  virtual std::size_t particle_count() const = 0;
};

}  // namespace toryu
