/// Checkpoints that are damaged, of another case, or cannot be made: what is said, and that nothing else
/// suffers.
#include "common/state/checkpoint.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <functional>
#include <iterator>

#include "common/error/failure.hpp"
#include "common/error/machine.hpp"

namespace toryu {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

constexpr const char* case_text = "[case]\nend_time = 0.1\n[fluid]\nspacing = 0.02\n";

class CheckpointFiles : public testing::Test {
 protected:
  CheckpointFiles() { fs::create_directories(out_); }
  ~CheckpointFiles() override { fs::remove_all(out_); }

  fs::path write_one() const {
    const fs::path folder = open_checkpoint(out_);
    write_part(folder, "fluid", {"fluid_solver"}, [](std::ostream& stream) { stream << "some state"; });
    complete_checkpoint(folder, 0.05, case_text, {"fluid"});
    return folder;
  }
  static void write(const fs::path& path, const std::string& text) {
    std::ofstream(path, std::ios::trunc) << text;
  }
  void read_newest() const {
    const Checkpoint checkpoint = checkpoint_to_restart(out_);
    check_same_case(checkpoint, case_text);
    read_part(checkpoint.folder, "fluid", {"fluid_solver"}, [](std::istream&) {});
  }

  fs::path out_ = fs::path(testing::TempDir()) / ("checkpoint_" + std::to_string(getpid()));
};

TEST_F(CheckpointFiles, ANumberThatWasBegunIsNotTakenAgain) {
  const fs::path first = open_checkpoint(out_);
  abandon_checkpoint(first);
  EXPECT_EQ(open_checkpoint(out_, first).filename(), "000002") << "a part of the first may come late";
}

TEST_F(CheckpointFiles, AManifestOfAnotherKindIsRefused) {
  const fs::path folder = write_one();
  for (const char* text :
       {"", "garbage {{", "time = 0.05\n", "time = 0.05\nparts = \"fluid\"\n", "time = 0.05\nparts = 3\n",
        "time = 0.05\nparts = [3]\n", "time = 1e400\n", "parts = [\"fluid\"]\n"}) {
    write(folder / "manifest.toml", text);
    EXPECT_THAT([&] { read_newest(); },
                ThrowsMessage<BadInput>(HasSubstr("manifest.toml: error: is damaged: ")))
        << text;
  }
}

TEST_F(CheckpointFiles, DamageIsToldOfWithTheWayAroundIt) {
  const fs::path first = write_one();
  std::string whole;
  {
    std::ifstream file(first / "fluid.state", std::ios::binary);
    whole.assign(std::istreambuf_iterator<char>(file), {});
  }
  const auto damage = [&](const fs::path& folder) {
    std::string flipped = whole;
    flipped.back() ^= 1;
    write(folder / "fluid.state", flipped);
  };
  damage(first);
  EXPECT_THAT([&] { read_newest(); },
              ThrowsMessage<BadInput>(AllOf(HasSubstr("checksum"), Not(HasSubstr("remove")))));
  write(first / "fluid.state", whole);
  const fs::path second = write_one();
  damage(second);
  const std::string way = "remove " + second.string() + " to go on from the checkpoint before it";
  EXPECT_THAT([&] { read_newest(); }, ThrowsMessage<BadInput>(HasSubstr(way)));
  write(second / "fluid.state", whole.substr(0, whole.size() - 3));
  EXPECT_THAT([&] { read_newest(); },
              ThrowsMessage<BadInput>(HasSubstr("is damaged: it holds 7 bytes of 10")));
  write(second / "case.toml", "[case");
  EXPECT_THAT([&] { read_newest(); }, ThrowsMessage<BadInput>(HasSubstr("case.toml: error: is damaged: ")));
  fs::remove(second / "case.toml");
  EXPECT_THAT([&] { read_newest(); }, ThrowsMessage<BadInput>(HasSubstr("case.toml: error: is damaged: ")));
  fs::remove_all(second);
  EXPECT_NO_THROW(read_newest());
}

/// As an archive does, which throws an exception of its own where its stream takes no more.
TEST_F(CheckpointFiles, APartOnAFullDiskNamesItAndTheReason) {
  const fs::path folder = open_checkpoint(out_);
  fs::create_symlink("/dev/full", folder / "fluid.state.part");
  const std::string state(100000, 'x');
  EXPECT_THAT(
      [&] {
        write_part(folder, "fluid", {"fluid_solver"}, [&](std::ostream& stream) {
          if (!stream.write(state.data(), static_cast<std::streamsize>(state.size())))
            throw std::logic_error("the stream takes no more");
        });
      },
      testing::ThrowsMessage<MachineFailure>(
          testing::AllOf(testing::HasSubstr("fluid.state"), testing::HasSubstr("No space left"))));
}

/// What of it has no bytes, as a list that is empty, adds nothing to the sum.
TEST_F(CheckpointFiles, APartMayHoldValuesOfNoBytes) {
  const fs::path folder = open_checkpoint(out_);
  write_part(folder, "fluid", {"fluid_solver"},
             [](std::ostream& stream) { stream.write("ab", 2).write(nullptr, 0).write("c", 1); });
  std::string found;
  read_part(folder, "fluid", {"fluid_solver"}, [&](std::istream& stream) { stream >> found; });
  EXPECT_EQ(found, "abc");
}

TEST_F(CheckpointFiles, APartOfAnotherTextOfAProgramIsRefused) {
  const fs::path folder = open_checkpoint(out_);
  write_part(folder, "fluid", {"my_fluid", "1f"}, [](std::ostream& stream) { stream << "some state"; });
  const auto read = [&](const Author& author) { read_part(folder, "fluid", author, [](std::istream&) {}); };
  EXPECT_NO_THROW(read({"my_fluid", "1f"}));
  EXPECT_THAT(
      [&] {
        read({"my_fluid", "2e"});
      },
      ThrowsMessage<BadInput>(AllOf(HasSubstr("cannot go on: its build is"), HasSubstr("with the sources 1f"),
                                    HasSubstr("with the sources 2e"))));
}

TEST_F(CheckpointFiles, ANumberOfAnotherCaseIsNamedAsItIsWritten) {
  write_one();
  EXPECT_THAT(
      [&] {
        check_same_case(checkpoint_to_restart(out_), "[case]\nend_time = 7.0\n[fluid]\nspacing = 0.1\n");
      },
      ThrowsMessage<BadInput>(HasSubstr("fluid.spacing: error: is 0.1, and was 0.02 in the checkpoint")));
}

TEST_F(CheckpointFiles, OneThatCouldNotBeMadeTakesNothingElseAway) {
  const fs::path before = fs::current_path();
  fs::current_path(out_);
  write("manifest.toml", "of something else");
  abandon_checkpoint({});
  EXPECT_TRUE(fs::exists(out_ / "manifest.toml"));
  fs::current_path(before);
}

}  // namespace
}  // namespace toryu
