/// Who may meet in a results folder, and what a message is sealed with.
#include "common/link/run_secret.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <functional>
#include <future>
#include <string>
#include <vector>

#include "common/link/dds.hpp"
#include "common/link/wire.hpp"

namespace toryu {
namespace {

class RunSecretTest : public testing::Test {
 protected:
  RunSecretTest() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    out_ = std::filesystem::temp_directory_path() / fmt::format("toryu_{}_{}", test->name(), getpid());
  }
  ~RunSecretTest() override { std::filesystem::remove_all(out_); }
  std::filesystem::path out_;
};

TEST_F(RunSecretTest, IsTheSameForAllWhoAskAtOnceAndForTheOwnerAlone) {
  std::vector<std::future<RunSecret>> asking;
  for (int k = 0; k < 8; ++k)
    asking.push_back(std::async(std::launch::async, [&] { return run_secret(out_ / "a/b"); }));
  const RunSecret secret = run_secret(out_ / "a/../a/./b");
  for (auto& asked : asking) {
    const RunSecret other = asked.get();
    EXPECT_EQ(other.name, secret.name);
    EXPECT_EQ(other.key, secret.key);
  }
  struct stat file {};
  ASSERT_EQ(stat((out_ / "a/b/run.secret").c_str(), &file), 0);
  EXPECT_EQ(file.st_mode & 0777, 0600u);
}

TEST_F(RunSecretTest, IsAnotherInEachFolderAndAfterEachRun) {
  const RunSecret here = run_secret(out_ / "a"), there = run_secret(out_ / "b");
  EXPECT_NE(here.name, there.name);
  EXPECT_NE(here.key, there.key);
  forget_run_secret(out_ / "a");
  EXPECT_NE(run_secret(out_ / "a").name, here.name);
}

TEST_F(RunSecretTest, IsMadeAnewWhereItsWriterDied) {
  std::filesystem::create_directories(out_);
  for (const char* left : {"", "123", "no hexadecimal digits, and as long as one"}) {
    std::ofstream(out_ / "run.secret") << left;
    EXPECT_NE(run_secret(out_).key, 0u);
  }
}

TEST_F(RunSecretTest, SetsPortsAndTag) {
  const auto a = dds::rendezvous(out_ / "a"), b = dds::rendezvous(out_ / "b");
  EXPECT_NE(a.tag, b.tag);
  EXPECT_EQ(a.tag, dds::rendezvous(out_ / "b/../a").tag);
  for (const auto& place : {a, b}) {
    EXPECT_GE(place.domain, 1u);
    EXPECT_LE(place.domain, 100u);
  }
}

TEST_F(RunSecretTest, LeavesTheDomainToWhoGivesOne) {
  const auto by_chance = dds::rendezvous(out_), given = dds::rendezvous(out_, {.domain = 7});
  EXPECT_EQ(given.domain, 7u);
  EXPECT_EQ(given.tag, by_chance.tag);
  EXPECT_EQ(given.key, by_chance.key);
}

TEST(Rendezvous, FollowsFromWhereTheFolderLiesNotFromItsPath) {
  const auto folder = std::filesystem::temp_directory_path() / ("toryu_place_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const auto first = dds::rendezvous(folder).tag;
  std::filesystem::create_symlink(folder, folder.string() + "_link");
  EXPECT_EQ(dds::rendezvous(folder.string() + "_link").tag, first);
  std::filesystem::remove(folder.string() + "_link");
  // another folder of the same path, as in another container
  std::filesystem::rename(folder, folder.string() + "_before");
  std::filesystem::create_directories(folder);
  EXPECT_NE(dds::rendezvous(folder).tag, first);
  EXPECT_EQ(dds::rendezvous(folder.string() + "_before").tag, first);
  std::filesystem::remove_all(folder);
  std::filesystem::remove_all(folder.string() + "_before");
}

/// A load over three particles.
struct Sample {
  InterfaceLoad load{{1, 2, 3}, {4, 5, 6, 7, 8, 9}, {}, Vec(10, 11), 12, {13, 14, 15, 16, 17, 18}, {}};
  toryu_Load message = wire::load({7, 3, 0, 0.5, 0.25}, load);
};

TEST(Seal, IsBrokenByAnyBitOfAField) {
  Sample sample;
  const auto seal = [&] { return dds::seal_of(sample.message, 42); };
  const std::uint64_t whole = seal();
  for (double* const value :
       {&sample.load.pressure[2], &sample.load.force[5], &sample.load.impedance[0],
        &sample.message.time_step_limit, &sample.message.health.momentum[2], &sample.message.window.dt})
    for (int bit = 0; bit < 64; ++bit) {
      auto& word = *reinterpret_cast<std::uint64_t*>(value);
      word ^= std::uint64_t{1} << bit;
      EXPECT_NE(seal(), whole);
      word ^= std::uint64_t{1} << bit;
    }
  EXPECT_EQ(seal(), whole);
}

TEST(Seal, KnowsWhereASequenceOrATextEnds) {
  Sample sample;
  std::swap(sample.message.friction_force, sample.message.velocity);
  EXPECT_EQ(dds::seal_of(sample.message, 42), dds::seal_of(Sample().message, 42)) << "both are empty";
  std::swap(sample.message.friction_force, sample.message.impedance);
  EXPECT_NE(dds::seal_of(sample.message, 42), dds::seal_of(Sample().message, 42));

  std::string ab = "ab", c = "c", a = "a", bc = "bc";
  toryu_Hello one{}, other{};
  one.program = ab.data(), one.version = c.data();
  other.program = a.data(), other.version = bc.data();
  EXPECT_NE(dds::seal_of(one, 42), dds::seal_of(other, 42));
}

/// Leaves `value` in one of each eight words of the stack, 0 in the others.
[[gnu::noinline]] void leave_on_the_stack(std::uint64_t value, int place) {
  alignas(64) std::array<volatile std::uint64_t, 1024> words;
  for (std::size_t k = 0; k < words.size(); ++k)
    words[k] = k % 8 == static_cast<std::size_t>(place) ? value : 0;
}

TEST(Seal, DoesNotDependOnWhatTheStackHeld) {
  const Sample sample;
  leave_on_the_stack(0, 0);
  const std::uint64_t seal = dds::seal_of(sample.message, 42);
  for (int place = 0; place < 8; ++place) {
    leave_on_the_stack(42, place);
    EXPECT_EQ(dds::seal_of(sample.message, 42), seal) << place;
  }
}

TEST(Seal, NeedsTheKeyAndTheSender) {
  Sample sample;
  const std::uint64_t seal = dds::seal_of(sample.message, 42);
  EXPECT_NE(dds::seal_of(sample.message, 43), seal);
  sample.message.seal = 1;
  EXPECT_EQ(dds::seal_of(sample.message, 42), seal) << "the seal is no part of what is sealed";
  sample.message.sender = 1;
  EXPECT_NE(dds::seal_of(sample.message, 42), seal);
}

}  // namespace
}  // namespace toryu
