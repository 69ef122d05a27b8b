/// The motion of the solid's interface within a window, as fluid_solver has it: in a straight line from where
/// the last window left it, or with the impulses of a scheme from where the solid is, and with an
/// acceleration that is averaged over the time in which sound crosses a kernel.
#pragma once

#include <cstddef>
#include <vector>

namespace toryu::lammps_fluid {

class MovedInterface {
 public:
  MovedInterface() = default;
  MovedInterface(const std::vector<double>& position, double response_time)
      : response_time_(response_time),
        start_(position),
        velocity_(position.size(), 0.0),
        acceleration_(position.size(), 0.0) {}

  /// Where it is at the end of a window of `dt` [s] from `time` [s], how fast it comes there, and whether it
  /// begins where that velocity says.
  void begin_window(const double* position, const double* velocity, bool anew, double time, double dt) {
    const bool first = last_dt_ == 0;
    const double share = last_dt_ / (last_dt_ + response_time_);
    for (std::size_t n = 0; n < start_.size(); ++n) {
      const double last_end = start_[n] + velocity_[n] * last_dt_;
      start_[n] = first || anew ? position[n] - velocity[n] * dt : last_end;
      const double mean = (position[n] - start_[n]) / dt;
      if (!first) acceleration_[n] += share * ((mean - velocity_[n]) / last_dt_ - acceleration_[n]);
      velocity_[n] = mean;
    }
    time_ = time;
    last_dt_ = dt;
  }
  /// Component n, two a particle.
  double position(std::size_t n, double time) const { return start_[n] + velocity_[n] * (time - time_); }
  double velocity(std::size_t n) const { return velocity_[n]; }
  double acceleration(std::size_t n) const { return acceleration_[n]; }

  /// All of it, for what goes back to the start of a window, and for checkpoints.
  std::vector<double> state() const {
    std::vector<double> all{time_, last_dt_};
    for (const auto* values : {&start_, &velocity_, &acceleration_})
      all.insert(all.end(), values->begin(), values->end());
    return all;
  }
  void set_state(const double* all) {
    time_ = *all++;
    last_dt_ = *all++;
    for (auto* values : {&start_, &velocity_, &acceleration_})
      for (double& value : *values) value = *all++;
  }
  /// Of the window at hand, or the last one [s].
  double end_time() const { return time_ + last_dt_; }

 private:
  double response_time_ = 0, time_ = 0, last_dt_ = 0;  ///< [s]
  std::vector<double> start_, velocity_, acceleration_;
};

}  // namespace toryu::lammps_fluid
