/// A fluid or a solid that is written in Python, as the loops of `common` see a solver. Each calls the
/// methods of a `toryu.participant.Checked`, which checks what the user's code answers and tells how an error
/// ends the run. All is called with Python's lock held.
#pragma once

#include <pybind11/pybind11.h>

#include <exception>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "common/link/participant.hpp"
#include "common/run/solver.hpp"
#include "common/run/timers.hpp"

namespace toryu::python {

namespace py = pybind11;

/// What fluids and solids have in common.
class PythonSide : public Solver {
 public:
  /// `program` names it; `make` takes what the case says, as JSON, and returns the object to be called.
  PythonSide(std::string program, const py::object& make, const std::string& case_as_json);

  /// From now on the object's `count_step` calls this. What it throws ends the Python code and comes out of
  /// the method that was called.
  void count_steps_by(std::function<void()> count);
  Health health() const;
  const Timers& timers() const { return timers_; }

  double time_step_limit() const override { return std::numeric_limits<double>::infinity(); }
  std::string_view time_step_rule() const override { return "its own"; }
  void save() override { ask("save"); }
  void restore() override { ask("restore"); }
  void write_state(std::ostream& stream) const override;
  void read_state(std::istream& stream) override;
  void check(double /*time*/) const override {}  // what Python answers is checked as it comes
  Frame frame() const override { return {}; }
  std::vector<Observation> observe() const override;
  std::vector<ActiveTerm> active_terms() const override { return {}; }
  std::size_t particle_count() const override { return interface_.size(); }

 protected:
  /// Calls a method; throws what `toryu.participant.ending_of` makes of an exception.
  template <class... Arguments>
  py::object ask(const char* method, Arguments&&... arguments) const {
    try {
      py::object answer = side_.attr(method)(std::forward<Arguments>(arguments)...);
      if (ending_) std::rethrow_exception(ending_);
      return answer;
    } catch (py::error_already_set& error) {
      rethrow(error);
    }
  }
  /// Asks for the answer to the window at hand.
  py::dict ask_window(double dt, const py::dict& given);

  Interface interface_;
  Window window_;

 private:
  [[noreturn]] void rethrow(py::error_already_set& error) const;

  std::string program_;
  py::object side_;
  mutable std::exception_ptr ending_;  // thrown by the link below the Python code
  Timers timers_;
};

class PythonFluid final : public PythonSide {
 public:
  using PythonSide::PythonSide;
  FluidTraits traits() const;
  void attach(const Interface& interface);
  void begin_window(const FluidLink::Turn& turn);
  void advance(double dt) override;
  const InterfaceLoad& load() const { return load_; }
  double time_step_limit() const override;
  std::string_view time_step_rule() const override { return "given"; }

 private:
  InterfaceMotion motion_;
  InterfaceLoad load_;
};

class PythonSolid final : public PythonSide {
 public:
  using PythonSide::PythonSide;
  /// The particles that a fluid can touch that sees `reach` [m] deep.
  const Interface& interface(double reach);
  void begin_window(const SolidLink::Turn& turn);
  void advance(double dt) override;
  const InterfaceMotion& motion() const { return motion_; }
  const Vec& impulse_taken() const { return impulse_taken_; }
  Frame frame() const override;

 private:
  InterfaceLoad load_;
  InterfaceMotion motion_;
  Vec impulse_taken_ = Vec::Zero();
};

}  // namespace toryu::python
