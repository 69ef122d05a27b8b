/// How a coupling window is divided into sub-steps while the limit of the time step changes.

#include "common/loop/time_loop.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

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

enum class Fails { never, check, watch };
/// A solver whose check fails at its fifth step of 0.1 s, its watch at the sixth or after, or nothing ever;
/// it shows the number of its steps.
class CountingSolver : public LimitedSolver {
 public:
  explicit CountingSolver(Fails fails) : LimitedSolver({0.1}), fails_(fails) {}
  void check(double time) const override {
    if (fails_ == Fails::check && steps.size() == 5)
      throw PhysicsFailure("body", -1, time, "steps", "5", "4");
  }
  void watch(double time) override {
    if (fails_ == Fails::watch && steps.size() >= 6)
      throw PhysicsFailure("body", -1, time, "steps", "6", "5");
  }
  std::vector<Observation> observe() const override {
    return {{"steps", "1", static_cast<double>(steps.size())}};
  }

 private:
  Fails fails_;
};

/// The series of a run to 0.9 s with rows every `interval` [s].
std::string series_of(Fails fails, double interval = 0.4, bool* failed = nullptr) {
  const auto out = std::filesystem::path(testing::TempDir()) / ("last_state_" + std::to_string(getpid()));
  std::filesystem::create_directories(out);
  Options options;
  options.out = out;
  Scene scene;
  scene.end_time = 0.9;
  scene.series_interval = interval;
  scene.checkpoint_every = 0;
  CountingSolver solver(fails);
  {
    Timers timers;
    RunRecord record("body", options, scene, solver, {}, timers);
    CheckpointsAlone checkpoints(options, scene, "");
    try {
      run_recorded(record, [&] { run_alone(scene, solver, record, 1, checkpoints); });
    } catch (const PhysicsFailure&) {
      if (failed) *failed = true;
    }
  }
  for (const char* name : {"body.csv", "body.csv.part"})
    if (std::ifstream file(out / name); file) {
      const std::string text{std::istreambuf_iterator<char>(file), {}};
      std::filesystem::remove_all(out);
      return text;
    }
  return "";
}

TEST(LastState, IsInTheSeriesAtTheEnd) {
  EXPECT_EQ(series_of(Fails::never), "time[s],steps[1]\n0,0\n0.4,4\n0.8,8\n0.9,9\n");
}

TEST(Watch, EndsTheRunOnceTheRowIsWritten) {
  bool failed = false;
  EXPECT_EQ(series_of(Fails::watch, 0.4, &failed), "time[s],steps[1]\n0,0\n0.4,4\n0.8,8\n");
  EXPECT_TRUE(failed);
}

TEST(Watch, LooksAtTheLastRowToo) {
  bool failed = false;
  EXPECT_EQ(series_of(Fails::watch, 5, &failed), "time[s],steps[1]\n0,0\n0.9,9\n");
  EXPECT_TRUE(failed);
}

TEST(LastState, IsInTheSeriesWhereTheRunFailed) {
  EXPECT_EQ(series_of(Fails::check), "time[s],steps[1]\n0,0\n0.4,4\n0.5,5\n");
}

}  // namespace
}  // namespace toryu
