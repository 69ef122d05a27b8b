/// How a coupling window is divided into sub-steps while the limit of the time step changes.

#include "common/loop/time_loop.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "common/run/options.hpp"

namespace toryu {
namespace {

/// A solver whose limit is given for each step in turn [s]; the last one stays.
class LimitedSolver : public Solver {
 public:
  explicit LimitedSolver(std::vector<double> limits) : limits_(std::move(limits)) {}

  double time_step_limit() const override { return limits_[std::min(steps.size(), limits_.size() - 1)]; }
  std::string_view time_step_rule() const override { return "given"; }
  void advance(double dt) override { steps.push_back(dt); }
  void save() override {}
  void restore() override {}
  void write_state(std::ostream&) const override {}
  void read_state(std::istream&) override {}
  void check(double) const override {}
  Frame frame() const override { return {}; }
  std::vector<Observation> observe() const override { return {}; }
  std::vector<ActiveTerm> active_terms() const override { return {}; }
  std::size_t particle_count() const override { return 0; }

  std::vector<double> steps;

 private:
  std::vector<double> limits_;
};

class AdvanceWindow : public testing::Test {
 protected:
  /// The steps that `solver` takes in a window of `length`, one between checks.
  static std::vector<double> steps_of(LimitedSolver solver, double length) {
    const auto out = std::filesystem::path(testing::TempDir()) / ("time_loop_" + std::to_string(getpid()));
    std::filesystem::create_directories(out);
    Options options;
    options.out = out;
    Timers timers;
    RunRecord record("fluid", options, Scene{}, solver, {}, timers);
    advance_window(solver, record, 0, length, 1, [](const SubSteps&) {});
    std::filesystem::remove_all(out);
    return solver.steps;
  }
};

TEST_F(AdvanceWindow, KeepsItsStepsWhileTheLimitFallsALittle) {
  EXPECT_EQ(steps_of(LimitedSolver({1.0, 0.97, 0.96, 0.955}), 4.0), std::vector<double>(4, 1.0));
}

TEST_F(AdvanceWindow, IsDividedAnewWhereTheLimitFallsByMore) {
  EXPECT_EQ(steps_of(LimitedSolver({1.0, 0.9}), 2.0), (std::vector<double>{1.0, 0.5, 0.5}));
}

TEST_F(AdvanceWindow, DoesNotCreepBeyondTheLimitByFallingALittleAtATime) {
  const auto steps = steps_of(LimitedSolver({1.0, 0.96, 0.94}), 3.0);
  EXPECT_EQ(steps, (std::vector<double>{1.0, 1.0, 0.5, 0.5}));
}

TEST_F(AdvanceWindow, TakesLongerStepsWhereTheLimitRises) {
  EXPECT_EQ(steps_of(LimitedSolver({1.0, 2.0}), 3.0), (std::vector<double>{1.0, 2.0}));
}

}  // namespace
}  // namespace toryu
