#include "common/run/progress.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <unistd.h>

namespace toryu {
namespace {

TEST(ProgressLine, SaysHowFarTheRunIs) {
  EXPECT_EQ(progress_line(0.123, 0.41, 12345, "window", 10),
            "t 0.1230 of 0.4100 s,  30 %, window 12345, 1234 windows/s, 23 s left");
  EXPECT_EQ(progress_line(1, 4, 100, "step", 100),
            "t 1.0000 of 4.0000 s,  25 %, step 100, 1 steps/s, 5 min 0 s left");
  EXPECT_EQ(progress_line(1, 4, 100, "step", 4000),
            "t 1.0000 of 4.0000 s,  25 %, step 100, 0 steps/s, 3 h 20 min left");
  EXPECT_EQ(progress_line(4, 4, 100, "step", 2),
            "t 4.0000 of 4.0000 s, 100 %, step 100, 50 steps/s, 0 s left");
  EXPECT_EQ(progress_line(0, 4, 0, "step", 0),
            "t 0.0000 of 4.0000 s,   0 %, step 0, 0 steps/s, unknown time left");
}

TEST(Progress, WritesOnlyItsLastLineInAShortRunToAFile) {
  testing::internal::CaptureStderr();
  {
    Progress progress(1, "step");
    for (int i = 1; i <= 1000; ++i) progress.update(i * 0.001, i);
  }
  const std::string text = testing::internal::GetCapturedStderr();
  EXPECT_THAT(text, testing::StartsWith("t 1.0000 of 1.0000 s, 100 %, step 1000,"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
}

TEST(Progress, RewritesItsLineOnATerminal) {
  int controller = 0, terminal = 0;
  ASSERT_EQ(openpty(&controller, &terminal, nullptr, nullptr, nullptr), 0);
  const int standard_error = dup(STDERR_FILENO);
  dup2(terminal, STDERR_FILENO);
  {
    Progress progress(1, "window");
    progress.update(0.1, 1);  // too early for a line, unless the machine is very busy
    usleep(250000);
    progress.update(0.5, 2);
    progress.update(1, 3);
  }
  dup2(standard_error, STDERR_FILENO);
  std::string shown;
  while (!shown.ends_with('\n')) {  // a busy machine hands the lines over one by one
    char buffer[1000];
    const ssize_t count = read(controller, buffer, sizeof buffer);
    ASSERT_GT(count, 0) << shown;
    shown.append(buffer, static_cast<std::size_t>(count));
  }
  EXPECT_THAT(shown, testing::MatchesRegex("(\rt 0.1.*)?\rt 0.5.*windows/s.*\x1b\\[K\rt 1.0.*\x1b\\[K\r\n"));
  for (const int descriptor : {controller, terminal, standard_error}) close(descriptor);
}

}  // namespace
}  // namespace toryu
