/// Coupled runs of analytic sides that are ended and go on: every bit is as if they had never ended.
#include "common/output/hdf5_file.hpp"
#include "tests/unit/coupler/coupled_run_fixture.hpp"

namespace toryu::coupling {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::ThrowsMessage;

constexpr double end_time = 0.5;  // [s]

class CheckpointTest : public CoupledRunTest {
 protected:
  CheckpointTest() {
    renew_sides();
    settings_.series_interval = 0.03;
    settings_.frame_interval = 0.07;
    checkpoints_.case_text = "[case]\n";
  }

  /// Fresh sides, of which the solid loses impulse in the first window: what is kept of the largest error,
  /// and that it was told of, must outlive a restart.
  void renew_sides() {
    sides_ = {};
    sides_.out = folder_.path;
    sides_.before_answer = [this](auto&, const Window& at) { lose_impulse_at_first(at); };
  }
  void lose_impulse_at_first(const Window& at) { sides_.impulse_lost = at.number == 1 ? 1e-3 : 0; }
  /// A run that somebody asks to stop after `window`.
  void run_until(std::uint64_t window, const Parameters& coupling) {
    sides_.before_answer = [this, window](auto&, const Window& at) {
      lose_impulse_at_first(at);
      sides_.asked_to_stop = at.number == window;
    };
    EXPECT_THROW(run(end_time, coupling, checkpoints_), Interrupted);
  }
  /// New programs go on from the newest checkpoint, as the options say.
  std::map<std::string, double> restart(double until, const Parameters& coupling) {
    renew_sides();
    Checkpoints from = checkpoints_;
    from.restart = checkpoint_to_restart(folder_.path);
    sides_.read_checkpoint(from.restart->folder);
    return run(until, coupling, from);
  }

  /// All that is left but wall times: the series as text, the interface's record value by value.
  std::string results() const {
    std::string text;
    std::istringstream lines(folder_.text_of("coupler.csv"));
    for (std::string line; std::getline(lines, line);) {
      std::istringstream cells(line);
      int column = 0;
      for (std::string cell; std::getline(cells, cell, ','); ++column)
        if (column != 3) text += cell + ",";  // the round trip
      text += "\n";
    }
    const HdfHandle file(H5Fopen((folder_.path / "interface.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT),
                         H5Fclose, "file");
    for (const char* name : {"time", "position", "velocity", "pressure", "force"}) {
      const HdfHandle dataset(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose, name);
      const HdfHandle space(H5Dget_space(dataset), H5Sclose, name);
      std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
      H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
      for (const double value : values) text += fmt::format("{} ", value);
      text += "\n";
    }
    return text;
  }
  std::vector<std::string> checkpoints_there() const {
    std::vector<std::string> names;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder_.path / "checkpoint", none))
      names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }

  Checkpoints checkpoints_{.every = 1000};
};

TEST_F(CheckpointTest, ARunThatGoesOnIsBitwiseThatWithoutAnEnd) {
  Parameters three_steps = explicit_scheme(SchemeKind::serial_explicit, 2);
  three_steps.fluid_steps_per_window = 3;
  for (const auto& coupling :
       {explicit_scheme(SchemeKind::serial_robin), explicit_scheme(SchemeKind::serial_explicit), three_steps,
        explicit_scheme(SchemeKind::parallel_explicit), implicit(AccelerationKind::fixed),
        implicit(AccelerationKind::aitken), implicit(AccelerationKind::quasi_newton)}) {
    SCOPED_TRACE(fmt::format("scheme {}, relaxation {}", static_cast<int>(coupling.scheme),
                             coupling.implicit ? static_cast<int>(coupling.implicit->relaxation) : -1));
    renew_sides();
    auto undisturbed = run(end_time, coupling);
    const std::string expected = results();
    fs::remove_all(folder_.path);
    fs::create_directories(folder_.path);
    renew_sides();
    run_until(7, coupling);
    auto figures = restart(end_time, coupling);
    EXPECT_EQ(results(), expected);
    EXPECT_THAT(said_, Not(HasSubstr("impulse given and taken differ"))) << "it was told of before";
    for (const char* figure : {"work_given", "work_taken", "largest_impulse_error", "lightest_layer",
                               "iterations", "fluid_compute_total"})
      EXPECT_EQ(figures[figure], undisturbed[figure]) << figure;
    fs::remove_all(folder_.path / "checkpoint");
    fs::remove(folder_.path / "coupler.csv");
  }
}

TEST_F(CheckpointTest, AnEndSaysWhatItLeaves) {
  sides_.before_answer = [this](auto&, const Window& window) { sides_.asked_to_stop = window.number == 3; };
  EXPECT_THAT(
      [&] { run(end_time, {}, checkpoints_); },
      ThrowsMessage<Interrupted>(testing::AllOf(HasSubstr("interrupted at t = 0.03 s; --restart goes on"),
                                                HasSubstr("checkpoint/000001"))));
}

TEST_F(CheckpointTest, TheFileStopEndsTheRunAndIsRemoved) {
  sides_.before_answer = [this](auto&, const Window& window) {
    if (window.number == 2) std::ofstream(folder_.path / "stop");
    std::this_thread::sleep_for(std::chrono::milliseconds(10));  // it is looked for now and then
  };
  EXPECT_THAT([&] { run(end_time, {}, checkpoints_); },
              ThrowsMessage<Interrupted>(HasSubstr("ended by the file 'stop' in " + folder_.path.string())));
  EXPECT_FALSE(fs::exists(folder_.path / "stop"));
  EXPECT_THAT(checkpoints_there(), testing::SizeIs(1));
}

TEST_F(CheckpointTest, WithoutCheckpointsThereIsNoneAtAnEndEither) {
  checkpoints_ = {};
  run(0.05, {}, checkpoints_);
  run_until(3, {});
  EXPECT_THAT(checkpoints_there(), IsEmpty());
}

TEST_F(CheckpointTest, TheyComeAtTheirIntervalAndTheNewestTwoStay) {
  checkpoints_ = {.interval = 0.1, .case_text = "[case]\n"};
  run(0.35, {}, checkpoints_);
  EXPECT_THAT(checkpoints_there(), testing::ElementsAre("000003", "000004"));  // at 0.3 s and at the end
}

TEST_F(CheckpointTest, AFinishedRunGoesOnToALaterEnd) {
  run(0.2, {}, checkpoints_);
  const std::string finished = results();
  restart(0.2, {});
  EXPECT_THAT(said_, HasSubstr("nothing to compute: the run is at t = 0.2 s"));
  EXPECT_EQ(results(), finished);
  EXPECT_THAT(checkpoints_there(), testing::ElementsAre("000001"));
  restart(0.3, {});
  EXPECT_THAT(results(), Not(finished));
  EXPECT_EQ(column("time[s]").back(), 0.3);
}

TEST_F(CheckpointTest, OneThatCannotBeWrittenIsToldOfAndTheRunGoesOn) {
  checkpoints_.interval = 0.1;
  sides_.failures = {"solid: no space left", "fluid: it too"};
  run(0.2, {}, checkpoints_);
  EXPECT_THAT(said_, HasSubstr("no checkpoint at t = 0.1 s: solid: no space left; fluid: it too"));
  EXPECT_THAT(checkpoints_there(), IsEmpty());
  EXPECT_DOUBLE_EQ(column("time[s]").back(), 0.18) << "the last row that is due";
}

TEST_F(CheckpointTest, AParticipantThatIsLostInOneEndsTheRun) {
  checkpoints_.interval = 0.1;
  sides_.before_answer = [](const std::string& task, auto&) {
    if (task == "checkpoint") throw PeerLost("solid is gone");
  };
  EXPECT_THAT([&] { run(end_time, {}, checkpoints_); }, ThrowsMessage<PeerLost>("solid is gone"));
  EXPECT_THAT(checkpoints_there(), IsEmpty());
}

}  // namespace
}  // namespace toryu::coupling
