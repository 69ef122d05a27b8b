/// How a coupling window is divided into sub-steps while the limit of the time step changes.

#include "common/loop/time_loop.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "common/error/failure.hpp"
#include "common/loop/outlook.hpp"
#include "common/loop/series_columns.hpp"
#include "common/run/options.hpp"
#include "tests/errors/case_text.hpp"

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

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Of the frames in a list [s].
std::vector<double> times_in(const std::string& list) {
  const std::string key = "\"time\":";
  std::vector<double> times;
  for (auto at = list.find(key); at != list.npos; at = list.find(key, at + 1))
    times.push_back(std::stod(list.substr(at + key.size())));
  return times;
}

struct Left {
  std::string series;
  std::vector<double> frames;  ///< their times [s]
  bool failed = false;
};

/// What a run to `end_time` leaves, with rows and frames every `interval` [s].
Left left_by(Fails fails, double end_time, double interval = 0.4) {
  const auto out = std::filesystem::path(testing::TempDir()) / ("last_state_" + std::to_string(getpid()));
  std::filesystem::create_directories(out);
  Options options;
  options.out = out;
  Scene scene;
  scene.end_time = end_time;
  scene.series_interval = scene.frame_interval = interval;
  scene.checkpoint_every = 0;
  CountingSolver solver(fails);
  bool failed = false;
  {
    Timers timers;
    RunRecord record("body", options, scene, solver, {}, timers);
    CheckpointsAlone checkpoints(options, scene, "");
    try {
      run_recorded(record, [&] { run_alone(scene, solver, record, 1, checkpoints); });
    } catch (const PhysicsFailure&) {
      failed = true;
    }
  }
  Left left{text_of(out / "body.csv") + text_of(out / "body.csv.part"), {}, failed};
  left.frames = times_in(text_of(out / "body.hdf.series"));
  std::filesystem::remove_all(out);
  return left;
}

/// A solver between walls, which move or not.
class WalledSolver : public CountingSolver {
 public:
  explicit WalledSolver(bool walls_move) : CountingSolver(Fails::never), walls_move_(walls_move) {}
  std::optional<Frame> walls() const override {
    return Frame{{0.1 * static_cast<double>(steps.size()), 0.0}, {}};
  }
  bool walls_move() const override { return walls_move_; }

 private:
  bool walls_move_;
};

/// The times of the frames of walls that a run to 0.8 s leaves, which goes on from its checkpoint at 0.4 s,
/// with a solid beside it that does likewise.
std::vector<double> frames_of_walls(bool walls_move, bool with_solid) {
  const auto out = std::filesystem::path(testing::TempDir()) / ("walls_" + std::to_string(getpid()));
  std::filesystem::create_directories(out / "checkpoint");
  Options options;
  options.out = out;
  Scene scene;
  scene.frame_interval = 0.4;
  Timers timers;
  WalledSolver solver(walls_move);
  CountingSolver solid(Fails::never);
  {
    RunRecord record("fluid", options, scene, solver, {}, timers),
        other("solid", options, scene, solid, {}, timers);
    for (const double time : {0.0, 0.4}) {
      record.check_and_write(time);
      other.check_and_write(time);
    }
    record.write_checkpoint(out / "checkpoint");
    other.write_checkpoint(out / "checkpoint");
    record.check_and_write(0.8);
  }
  options.restart = true;
  RunRecord record("fluid", options, scene, solver, {}, timers),
      other("solid", options, scene, solid, {}, timers);
  record.read_checkpoint(out / "checkpoint");
  if (with_solid) other.read_checkpoint(out / "checkpoint");
  record.check_and_write(0.8);
  record.complete();
  const auto times = times_in(text_of(out / "walls.hdf.series"));
  const auto count = std::distance(std::filesystem::directory_iterator(out / "frames"), {});
  EXPECT_EQ(static_cast<std::size_t>(count), times.size() + 3 + 2)
      << "with those of the fluid and of the solid";
  std::filesystem::remove_all(out);
  return times;
}

using testing::ElementsAre;

TEST(Walls, AreDrawnOnceWhereTheyStandStillAndEachTimeWhereTheyMove) {
  EXPECT_THAT(frames_of_walls(false, false), ElementsAre(0));
  EXPECT_THAT(frames_of_walls(true, false), ElementsAre(0, 0.4, 0.8));
}

TEST(Walls, OfAFluidAreLeftAloneByASolidThatGoesOn) {
  EXPECT_THAT(frames_of_walls(false, true), ElementsAre(0));
  EXPECT_THAT(frames_of_walls(true, true), ElementsAre(0, 0.4, 0.8));
}

TEST(LastState, IsInSeriesAndFramesAtTheEnd) {
  const Left left = left_by(Fails::never, 0.9);
  EXPECT_EQ(left.series, "time[s],steps[1]\n0,0\n0.4,4\n0.8,8\n0.9,9\n");
  EXPECT_THAT(left.frames, ElementsAre(0, 0.4, 0.8, 0.9));
}

TEST(Watch, EndsTheRunOnceRowAndFrameAreWritten) {
  const Left left = left_by(Fails::watch, 1.5);
  EXPECT_TRUE(left.failed);
  EXPECT_EQ(left.series, "time[s],steps[1]\n0,0\n0.4,4\n0.8,8\n");
  EXPECT_THAT(left.frames, ElementsAre(0, 0.4, 0.8));
}

TEST(Watch, LooksAtTheLastRowToo) {
  const Left left = left_by(Fails::watch, 0.9, 5);
  EXPECT_TRUE(left.failed);
  EXPECT_EQ(left.series, "time[s],steps[1]\n0,0\n0.9,9\n");
}

TEST(LastState, IsInSeriesAndFramesWhereTheRunFailed) {
  const Left left = left_by(Fails::check, 0.9);
  EXPECT_EQ(left.series, "time[s],steps[1]\n0,0\n0.4,4\n0.5,5\n");
  EXPECT_THAT(left.frames, ElementsAre(0, 0.4, 0.5));
}

TEST(LastState, IsWrittenOnceWhereItIsDueAnyway) {
  const Left left = left_by(Fails::never, 0.8);
  EXPECT_EQ(left.series, "time[s],steps[1]\n0,0\n0.4,4\n0.8,8\n");
  EXPECT_THAT(left.frames, ElementsAre(0, 0.4, 0.8));
}

/// A solver that reports numbers of given names.
class NamedSolver : public LimitedSolver {
 public:
  explicit NamedSolver(std::vector<std::string> names) : LimitedSolver({1}), names_(std::move(names)) {}
  std::vector<Observation> observe() const override {
    std::vector<Observation> row;
    for (const auto& name : names_) row.push_back({name, "1", 0.0});
    return row;
  }

 private:
  std::vector<std::string> names_;
};

TEST(Columns, NeedNamesOfTheirOwn) {
  const CaseText text(
      "[[wall]]\nname = 'a'\n[[body.observer]]\nname = 'tip'\n[[body.region]]\nname = 'tip'\n"
      "[[body.region]]\nname = 'tip_of_a'\n");
  const auto fault = [&](const std::vector<std::string>& names) -> std::string {
    CaseFile file(text.folder(), {});
    file.ignore_sections({"wall", "body"});
    check_columns(file, NamedSolver(names).observe(), "body");
    try {
      file.throw_if_faulty();
    } catch (const BadInput& error) {
      const InputError& first = error.errors()[0];
      return fmt::format("{}: {}", first.line, first.message);
    }
    return "";
  };
  const std::string what =
      "two columns of the results would be named '{}': an observer, a region or a wall needs another name";
  EXPECT_EQ(fault({"tip_x", "tip_y", "tip"}), "");
  EXPECT_EQ(fault({"tip_x", "tip_y", "tip_x"}),
            fmt::format("4: {}", fmt::format(fmt::runtime(what), "tip_x")));
  EXPECT_EQ(fault({"force_from_a_x", "force_from_a_x"}),
            fmt::format("2: {}", fmt::format(fmt::runtime(what), "force_from_a_x")));
  EXPECT_EQ(fault({"tip_of_a_x", "tip_of_a_x"}),
            fmt::format("8: {}", fmt::format(fmt::runtime(what), "tip_of_a_x")));
  EXPECT_EQ(fault({"energy", "energy"}), fmt::format("3: {}", fmt::format(fmt::runtime(what), "energy")))
      << "of nobody's item: the section's";
}

TEST(Outlook, TellsStepsAndTakesThem) {
  LimitedSolver solver({1e-3});
  const std::string said = outlook("[fluid]", solver, 2.5).text;
  EXPECT_EQ(
      said.find("[fluid]: time step 0.001 s (given limit) at the start, 2500 steps to t = 2.5 s, about "), 0u)
      << said;
  EXPECT_GE(solver.steps.size(), 2u) << "nothing was timed";
  EXPECT_EQ(solver.steps.front(), 1e-3);
  for (const double none : {0.0, std::nan("")}) {
    LimitedSolver still({none});
    EXPECT_THROW(outlook("[fluid]", still, 2.5), BadInput) << none;
  }
}

}  // namespace
}  // namespace toryu
