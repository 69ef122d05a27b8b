#include "coupler/schemes.hpp"

#include <algorithm>
#include <cmath>

#include "coupler/acceleration.hpp"
#include "coupler/extrapolation.hpp"

namespace toryu::coupling {

namespace {

/// A residual is judged against the interface's displacement in the window, but at least against this share
/// of its spacing: at rest there is nothing to converge to.
constexpr double least_displacement = 1e-6;

/// No iteration moves a particle by more than this share of the spacing: the load that answers a wilder
/// guess, which no window would keep, may be one that a solver cannot bear.
constexpr double longest_step = 0.05;

double root_mean_square(const Values& values) {
  return values.size() > 0 ? values.norm() / std::sqrt(static_cast<double>(values.size())) : 0.0;
}

/// The load that the case lets the solid feel.
InterfaceLoad felt_of(const InterfaceLoad& given, const Parameters& parameters) {
  InterfaceLoad load = given;
  if (!parameters.feels("pressure_and_viscous")) std::fill(load.force.begin(), load.force.end(), 0.0);
  if (!parameters.feels("friction")) load.friction_force.clear();
  return load;
}

class SerialExplicit final : public Scheme {
 public:
  SerialExplicit(const Parameters& parameters, CouplerLink& link, const CouplerLink::Start& start)
      : parameters_(parameters), link_(link), extrapolation_(parameters.extrapolation_order, start.motion) {}

  Exchange compute(Window& window) override {
    Exchange done;
    InterfaceMotion motion = extrapolation_.over(window.dt);
    done.fluid = link_.ask_fluid(window, motion);
    done.followed = std::move(motion.position);
    done.given = done.felt = felt_of(done.fluid.load, parameters_);
    done.solid = link_.ask_solid(window, done.felt);
    extrapolation_.note(done.solid.motion, window.dt);
    done.fluid_compute = done.fluid.health.compute_time;
    done.solid_compute = done.solid.health.compute_time;
    done.compute = done.fluid_compute + done.solid_compute;
    return done;
  }

 private:
  const Parameters& parameters_;
  CouplerLink& link_;
  Extrapolation extrapolation_;
};

class ParallelExplicit final : public Scheme {
 public:
  ParallelExplicit(const Parameters& parameters, CouplerLink& link, const CouplerLink::Start& start)
      : parameters_(parameters), link_(link), extrapolation_(parameters.extrapolation_order, start.motion) {
    past_.pressure.assign(start.interface.size(), 0.0);
    past_.force.assign(dim * start.interface.size(), 0.0);
  }

  Exchange compute(Window& window) override {
    Exchange done;
    done.felt = past_over(window.dt);
    link_.grant_solid(window, done.felt);
    InterfaceMotion motion = extrapolation_.over(window.dt);
    link_.grant_fluid(window, motion);
    done.followed = std::move(motion.position);
    done.fluid = link_.await_fluid(window);
    done.solid = link_.await_solid(window);
    extrapolation_.note(done.solid.motion, window.dt);
    done.given = past_ = felt_of(done.fluid.load, parameters_);
    past_dt_ = window.dt;
    done.fluid_compute = done.fluid.health.compute_time;
    done.solid_compute = done.solid.health.compute_time;
    done.compute = std::max(done.fluid_compute, done.solid_compute);
    return done;
  }

 private:
  /// The last window's load, such that its impulse over `dt` is what the fluid gave.
  InterfaceLoad past_over(double dt) const {
    InterfaceLoad load = past_;
    for (auto* forces : {&load.force, &load.friction_force})
      for (double& component : *forces) component *= past_dt_ / dt;
    return load;
  }

  const Parameters& parameters_;
  CouplerLink& link_;
  Extrapolation extrapolation_;
  InterfaceLoad past_;  // of the last window
  double past_dt_ = 0;  // [s]
};

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
  SerialImplicit(const Parameters& parameters, CouplerLink& link, const CouplerLink::Start& start)
      : parameters_(parameters),
        link_(link),
        extrapolation_(std::max(parameters.extrapolation_order, 1), start.motion),
        acceleration_(make_acceleration(*parameters.implicit)),
        spacing_(start.interface.spacing) {}

  Exchange compute(Window& window) override {
    Exchange done;
    const Values start = values(extrapolation_.now().position);
    InterfaceMotion guess = extrapolation_.over(window.dt);
    acceleration_->begin_window();
    for (;; ++window.iteration, ++done.iterations) {
      done.fluid = link_.ask_fluid(window, guess);
      done.felt = felt_of(done.fluid.load, parameters_);
      done.solid = link_.ask_solid(window, done.felt);
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
    done.given = done.felt;
    done.followed = std::move(guess.position);
    extrapolation_.note(done.solid.motion, window.dt);
    done.compute = done.fluid_compute + done.solid_compute;
    return done;
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
  CouplerLink& link_;
  Extrapolation extrapolation_;
  std::unique_ptr<Acceleration> acceleration_;
  double spacing_;  // of the interface's particles [m]
};

}  // namespace

std::unique_ptr<Scheme> make_scheme(const Parameters& parameters, CouplerLink& link,
                                    const CouplerLink::Start& start) {
  switch (parameters.scheme) {
    case SchemeKind::serial_explicit:
      return std::make_unique<SerialExplicit>(parameters, link, start);
    case SchemeKind::parallel_explicit:
      return std::make_unique<ParallelExplicit>(parameters, link, start);
    default:
      return std::make_unique<SerialImplicit>(parameters, link, start);
  }
}

}  // namespace toryu::coupling
