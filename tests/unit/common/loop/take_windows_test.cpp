/// The turns of a coupled run on a solver's side: when a window is written, what a checkpoint holds, and
/// where a restart goes on.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "common/loop/time_loop.hpp"
#include "common/state/serialize.hpp"

namespace toryu {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

/// A number that grows by the length of each window.
class GrowingSolver : public Solver {
 public:
  double time_step_limit() const override { return 1; }
  std::string_view time_step_rule() const override { return "given"; }
  void advance(double dt) override { x += dt; }
  void save() override { saved = x; }
  void restore() override { x = saved; }
  void write_state(std::ostream& stream) const override { write_states(stream, x); }
  void read_state(std::istream& stream) override { read_states(stream, x); }
  void check(double) const override {}
  Frame frame() const override { return {}; }
  std::vector<Observation> observe() const override { return {{"x", "1", x}}; }
  std::vector<ActiveTerm> active_terms() const override { return {}; }
  std::size_t particle_count() const override { return 0; }

  double x = 0, saved = 0;
};

/// Hands out turns that are given.
struct ScriptedLink {
  bool repeats = false;
  fs::path from = {};
  std::vector<Turn> turns = {};
  std::vector<std::string> failures = {};

  bool windows_repeat() const { return repeats; }
  fs::path restart() const { return from; }
  std::optional<Turn> next_turn() {
    if (next == turns.size()) return std::nullopt;
    return turns[next++];
  }
  void confirm_checkpoint(const std::function<void()>& write) {
    try {
      write();
      failures.emplace_back();
    } catch (const std::exception& failure) {
      failures.emplace_back(failure.what());
    }
  }
  std::size_t next = 0;
};

Turn window(std::uint64_t number, std::uint32_t iteration = 0) {
  return {{number, iteration, static_cast<double>(number - 1), 1.0}};
}

class TakeWindows : public testing::Test {
 protected:
  TakeWindows() { fs::create_directories(out_ / "there"); }
  ~TakeWindows() override { fs::remove_all(out_); }

  Turn checkpoint(std::uint64_t after, const char* folder = "there") const {
    return {window(after), Task::checkpoint, out_ / folder};
  }
  /// Takes the turns and returns the rows of the series.
  std::string rows_of(ScriptedLink& link) const {
    GrowingSolver solver;
    Timers timers;
    Options options;
    options.out = out_;
    {
      RunRecord record("fluid", options, Scene{}, solver, {}, timers);
      take_windows(link, solver, record, [&](const Turn& turn) { solver.advance(turn.dt); });
    }
    std::ostringstream text;
    text << std::ifstream(out_ / "fluid.csv").rdbuf();
    return text.str();
  }

  fs::path out_ =
      fs::temp_directory_path() /
      fmt::format("toryu_{}_{}", testing::UnitTest::GetInstance()->current_test_info()->name(), getpid());
};

TEST_F(TakeWindows, WritesEachWindowOnceWhenItStands) {
  ScriptedLink once{.turns = {window(1), checkpoint(1), window(2)}};
  EXPECT_EQ(rows_of(once), "time[s],x[1]\n0,0\n1,1\n2,2\n");
  ScriptedLink again{
      .repeats = true,
      .turns = {window(1), window(1, 1), window(1, 2), checkpoint(1), window(2), window(2, 1)}};
  EXPECT_EQ(rows_of(again), "time[s],x[1]\n0,0\n1,1\n2,2\n");
  EXPECT_THAT(again.failures, ElementsAre(""));
}

TEST_F(TakeWindows, GoOnFromACheckpointAsIfTheyHadNeverEnded) {
  for (const bool repeats : {false, true}) {
    ScriptedLink ended{.repeats = repeats, .turns = {window(1), window(2), checkpoint(2), window(3)}};
    rows_of(ended);
    ScriptedLink later{.repeats = repeats, .from = out_ / "there", .turns = {window(3), window(4)}};
    EXPECT_EQ(rows_of(later), "time[s],x[1]\n0,0\n1,1\n2,2\n3,3\n4,4\n");
  }
}

TEST_F(TakeWindows, GoOnWhenACheckpointCannotBeWritten) {
  ScriptedLink link{.turns = {window(1), checkpoint(1, "nowhere"), window(2)}};
  EXPECT_EQ(rows_of(link), "time[s],x[1]\n0,0\n1,1\n2,2\n");
  EXPECT_THAT(link.failures, ElementsAre(HasSubstr("nowhere")));
}

}  // namespace
}  // namespace toryu
