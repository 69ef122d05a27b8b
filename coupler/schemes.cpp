#include "coupler/schemes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/link/serialize.hpp"
#include "common/state/serialize.hpp"
#include "coupler/acceleration.hpp"
#include "coupler/extrapolation.hpp"
#include "coupler/prediction.hpp"

namespace toryu::coupling {

namespace {

/// A residual is judged against the interface's displacement in the window, but at least against this share
/// of its spacing: at rest there is nothing to converge to.
constexpr double least_displacement = 1e-6;

/// No iteration moves a particle by more than this share of the spacing: the load that answers a wilder
/// guess, which no window would keep, may be one that a solver cannot bear.
constexpr double longest_step = 0.05;

/// The impedance that the solid feels in `serial_robin`, over the fluid's. The fluid answers a change within
/// a window, and what the impedance lets the solid feel of it there is what the load of the next window does
/// not feed back. Any factor is consistent, since its impulse returns. Measured (pushed column, 20 to 300
/// kg/m3, windows of 1, 2, 4 fluid steps, 0.15 s): 1 bears windows of 1, and of 2 at 300 kg/m3; 1.4 all but
/// windows of 2 below 300 kg/m3; 2 all. 0.5 fails with windows of 4 within 0.02 s; 3 is not nearer to theory.
constexpr double impedance_factor = 2.0;

double root_mean_square(const Values& values) {
  return values.size() > 0 ? values.norm() / std::sqrt(static_cast<double>(values.size())) : 0.0;
}

/// What of the fluid's load the case passes on to the solid.
InterfaceLoad passed_on(const InterfaceLoad& of_fluid, const Parameters& parameters) {
  InterfaceLoad load = of_fluid;
  if (!parameters.passes_on("pressure_and_viscous")) {
    std::fill(load.force.begin(), load.force.end(), 0.0);
    std::fill(load.impedance.begin(), load.impedance.end(), 0.0);
  }
  if (!parameters.passes_on("friction")) load.friction_force.clear();
  return load;
}

class SerialExplicit final : public Scheme {
 public:
  SerialExplicit(const Parameters& parameters, CouplingPort& port, const CouplingStart& start)
      : parameters_(parameters), port_(port), extrapolation_(parameters.extrapolation_order, start.motion) {}

  Exchange compute(Window& window) override {
    Exchange done;
    InterfaceMotion motion = extrapolation_.over(window.dt);
    done.fluid = port_.ask_fluid(window, motion);
    done.interface_position = std::move(motion.position);
    done.sent = done.applied = passed_on(done.fluid.load, parameters_);
    done.solid = port_.ask_solid(window, done.applied);
    extrapolation_.note(done.solid.motion, window.dt);
    done.fluid_compute = done.fluid.health.compute_time;
    done.solid_compute = done.solid.health.compute_time;
    done.compute = done.fluid_compute + done.solid_compute;
    return done;
  }

  void write_state(std::ostream& stream) const override { write_states(stream, extrapolation_.state()); }
  void read_state(std::istream& stream) override {
    Extrapolation::State state;
    read_states(stream, state);
    extrapolation_.resume(state);
  }

 private:
  const Parameters& parameters_;
  CouplingPort& port_;
  Extrapolation extrapolation_;
};

/// The time in which sound crosses the fluid's kernel [s]; without end if the fluid knows no sound.
double response_time(const FluidTraits& fluid) {
  return fluid.sound_speed > 0 ? fluid.reach / fluid.sound_speed : std::numeric_limits<double>::infinity();
}

class SerialRobin final : public Scheme {
 public:
  SerialRobin(const Parameters& parameters, CouplingPort& port, const CouplingStart& start)
      : parameters_(parameters), port_(port), prediction_(start.motion, response_time(start.traits)) {}

  Exchange compute(Window& window) override {
    Exchange done;
    InterfaceMotion motion = prediction_.over(window.dt);
    done.fluid = port_.ask_fluid(window, motion);
    done.sent = passed_on(done.fluid.load, parameters_);
    done.applied = done.sent;
    for (double& z : done.applied.impedance) z *= impedance_factor;
    if (!done.applied.impedance.empty()) done.applied.velocity = motion.velocity;
    done.solid = port_.ask_solid(window, done.applied);
    done.interface_start = prediction_.now().position;
    done.interface_position = std::move(motion.position);
    done.returned = std::move(motion.impulse);
    prediction_.note(done.solid.motion, window.dt);
    done.fluid_compute = done.fluid.health.compute_time;
    done.solid_compute = done.solid.health.compute_time;
    done.compute = done.fluid_compute + done.solid_compute;
    return done;
  }

  void write_state(std::ostream& stream) const override { write_states(stream, prediction_.state()); }
  void read_state(std::istream& stream) override {
    Prediction::State state;
    read_states(stream, state);
    prediction_.resume(state);
  }

 private:
  const Parameters& parameters_;
  CouplingPort& port_;
  Prediction prediction_;
};

class ParallelExplicit final : public Scheme {
 public:
  struct State {
    InterfaceLoad load;  ///< of the last window
    double dt = 0;       ///< its length [s]
  };

  ParallelExplicit(const Parameters& parameters, CouplingPort& port, const CouplingStart& start)
      : parameters_(parameters), port_(port), extrapolation_(parameters.extrapolation_order, start.motion) {
    past_.load.pressure.assign(start.interface.size(), 0.0);
    past_.load.force.assign(dim * start.interface.size(), 0.0);
  }

  Exchange compute(Window& window) override {
    Exchange done;
    done.applied = past_over(window.dt);
    port_.grant_solid(window, done.applied);
    InterfaceMotion motion = extrapolation_.over(window.dt);
    port_.grant_fluid(window, motion);
    done.interface_position = std::move(motion.position);
    done.fluid = port_.await_fluid(window);
    done.solid = port_.await_solid(window);
    extrapolation_.note(done.solid.motion, window.dt);
    done.sent = past_.load = passed_on(done.fluid.load, parameters_);
    past_.dt = window.dt;
    done.fluid_compute = done.fluid.health.compute_time;
    done.solid_compute = done.solid.health.compute_time;
    done.compute = std::max(done.fluid_compute, done.solid_compute);
    return done;
  }

  void write_state(std::ostream& stream) const override {
    write_states(stream, extrapolation_.state(), past_);
  }
  void read_state(std::istream& stream) override {
    Extrapolation::State state;
    read_states(stream, state, past_);
    extrapolation_.resume(state);
  }

 private:
  /// The last window's load, such that its impulse over `dt` is what the fluid gave.
  InterfaceLoad past_over(double dt) const {
    InterfaceLoad load = past_.load;
    for (auto* forces : {&load.force, &load.friction_force})
      for (double& component : *forces) component *= past_.dt / dt;
    return load;
  }

  const Parameters& parameters_;
  CouplingPort& port_;
  Extrapolation extrapolation_;
  State past_;
};

template <class Archive>
void serialize(Archive& archive, ParallelExplicit::State& state) {
  auto& [load, dt] = state;
  archive(load, dt);
}

std::unique_ptr<Acceleration> make_acceleration(const ImplicitParameters& p) {
  switch (p.relaxation) {
    case AccelerationKind::fixed:
      return std::make_unique<FixedRelaxation>(p.relaxation_factor);
    case AccelerationKind::aitken:
      return std::make_unique<AitkenRelaxation>(p.relaxation_factor);
    default:
      return std::make_unique<QuasiNewton>(p.relaxation_factor, p.remembered_windows);
  }
}

class SerialImplicit final : public Scheme {
 public:
  SerialImplicit(const Parameters& parameters, CouplingPort& port, const CouplingStart& start)
      : parameters_(parameters),
        port_(port),
        extrapolation_(std::max(parameters.extrapolation_order, 1), start.motion),
        acceleration_(make_acceleration(*parameters.implicit)),
        spacing_(start.interface.spacing) {}

  Exchange compute(Window& window) override {
    Exchange done;
    const Values start = values(extrapolation_.now().position);
    InterfaceMotion guess = extrapolation_.over(window.dt);
    acceleration_->begin_window();
    for (;; ++window.iteration, ++done.iterations) {
      done.fluid = port_.ask_fluid(window, guess);
      done.applied = passed_on(done.fluid.load, parameters_);
      done.solid = port_.ask_solid(window, done.applied);
      done.fluid_compute += done.fluid.health.compute_time;
      done.solid_compute += done.solid.health.compute_time;

      const Values x = values(guess.position), answer = values(done.solid.motion.position);
      const double displacement = std::max(root_mean_square(answer - start), least_displacement * spacing_);
      done.residual = root_mean_square(answer - x) / displacement;
      done.converged = done.residual <= parameters_.implicit->tolerance;
      if (done.converged || done.iterations == parameters_.implicit->largest_iteration_count) break;
      const Values next = x + bounded(acceleration_->next(x, answer - x) - x);
      Eigen::Map<Values>(guess.position.data(), next.size()) = next;
      Eigen::Map<Values>(guess.velocity.data(), next.size()) = (next - start) / window.dt;
    }
    done.sent = done.applied;
    done.interface_position = std::move(guess.position);
    extrapolation_.note(done.solid.motion, window.dt);
    done.compute = done.fluid_compute + done.solid_compute;
    return done;
  }

  void write_state(std::ostream& stream) const override {
    write_states(stream, extrapolation_.state());
    acceleration_->write_state(stream);
  }
  void read_state(std::istream& stream) override {
    Extrapolation::State state;
    read_states(stream, state);
    extrapolation_.resume(state);
    acceleration_->read_state(stream);
  }

 private:
  static Values values(const std::vector<double>& components) {
    return Eigen::Map<const Values>(components.data(), static_cast<Eigen::Index>(components.size()));
  }

  Values bounded(const Values& step) const {
    const double longest = step.size() > 0 ? step.lpNorm<Eigen::Infinity>() : 0.0;
    return step * std::min(1.0, longest_step * spacing_ / longest);
  }

  const Parameters& parameters_;
  CouplingPort& port_;
  Extrapolation extrapolation_;
  std::unique_ptr<Acceleration> acceleration_;
  double spacing_;  // of the interface's particles [m]
};

}  // namespace

std::unique_ptr<Scheme> make_scheme(const Parameters& parameters, CouplingPort& port,
                                    const CouplingStart& start) {
  switch (parameters.scheme) {
    case SchemeKind::serial_robin:
      return std::make_unique<SerialRobin>(parameters, port, start);
    case SchemeKind::serial_explicit:
      return std::make_unique<SerialExplicit>(parameters, port, start);
    case SchemeKind::parallel_explicit:
      return std::make_unique<ParallelExplicit>(parameters, port, start);
    default:
      return std::make_unique<SerialImplicit>(parameters, port, start);
  }
}

}  // namespace toryu::coupling
