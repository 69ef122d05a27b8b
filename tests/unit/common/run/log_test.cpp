#include "common/run/log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spdlog/spdlog.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <map>

namespace toryu {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;

class Log : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::remove_all(out_); }
  void TearDown() override {
    open_log("test", "", "info");
    std::filesystem::remove_all(out_);
  }
  std::vector<std::string> lines() const {
    std::vector<std::string> lines;
    std::ifstream file(out_ / "log.txt");
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
  }
  std::filesystem::path out_ =
      std::filesystem::temp_directory_path() / ("toryu_log_" + std::to_string(getpid()));
};

TEST_F(Log, TagsLinesWithTimeRoleAndLevel) {
  open_log("coupler", out_ / "deep", "info");
  spdlog::info("window {}", 7);
  std::filesystem::rename(out_ / "deep/log.txt", out_ / "log.txt");
  ASSERT_EQ(lines().size(), 1u);
  EXPECT_THAT(lines()[0], MatchesRegex("[0-9-]+ [0-9:]+\\.[0-9]+ coupler info: window 7"));
}

TEST_F(Log, KeepsToItsLevel) {
  open_log("coupler", out_, "warn");
  spdlog::info("too small");
  testing::internal::CaptureStderr();
  spdlog::warn("large enough");
  testing::internal::GetCapturedStderr();
  ASSERT_EQ(lines().size(), 1u);
  EXPECT_THAT(lines()[0], HasSubstr("large enough"));
}

TEST_F(Log, ShowsWarningsOnStandardErrorAndNothingLess) {
  open_log("coupler", out_, "debug");
  testing::internal::CaptureStderr();
  spdlog::info("quiet");
  spdlog::warn("loud");
  log_error_to_file("in the file");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "coupler: warning: loud\n");
  ASSERT_EQ(lines().size(), 3u);
  EXPECT_THAT(lines()[2], HasSubstr("coupler error: in the file"));
}

TEST_F(Log, IsAppendedTo) {
  for (int run = 0; run < 2; ++run) {
    open_log("coupler", out_, "info");
    spdlog::info("run {}", run);
  }
  EXPECT_EQ(lines().size(), 2u);
}

TEST_F(Log, KeepsLinesOfSeveralProcessesWhole) {
  constexpr int processes = 3, messages = 400, length = 9000;  // longer than any buffer of stdio
  std::vector<pid_t> children;
  for (int p = 0; p < processes; ++p) {
    children.push_back(fork());
    if (children.back() == 0) {
      open_log("writer", out_, "info");
      for (int i = 0; i < messages; ++i) spdlog::info(std::string(length, static_cast<char>('a' + p)));
      _exit(0);
    }
  }
  for (const pid_t child : children) waitpid(child, nullptr, 0);
  std::map<char, int> count;
  for (const auto& line : lines()) {
    const std::string message = line.substr(line.find(": ") + 2);
    ASSERT_EQ(message, std::string(length, message.front()));
    ++count[message.front()];
  }
  EXPECT_EQ(count, (std::map<char, int>{{'a', messages}, {'b', messages}, {'c', messages}}));
}

}  // namespace
}  // namespace toryu
