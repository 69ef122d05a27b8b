/// Whether a process runs, as its machine sees it.
#include "common/link/process.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

namespace toryu {
namespace {

/// A process that waits for a signal, and its name.
struct Child {
  pid_t id;
  std::string name;

  Child() {
    int ends[2];
    EXPECT_EQ(pipe(ends), 0);
    id = fork();
    if (id == 0) {
      const std::string mine = own_process();
      if (write(ends[1], mine.data(), mine.size()) > 0) pause();
      _exit(0);
    }
    char text[256];
    const auto length = read(ends[0], text, sizeof text);
    name.assign(text, length > 0 ? static_cast<std::size_t>(length) : 0);
    close(ends[0]);
    close(ends[1]);
  }
};

using enum ProcessState;

TEST(Process, RunsUntilItIsStoppedOrGone) {
  const Child child;
  int status = 0;
  EXPECT_EQ(state_of(child.name), runs);
  kill(child.id, SIGSTOP);
  waitpid(child.id, &status, WUNTRACED);
  EXPECT_EQ(state_of(child.name), stopped);
  kill(child.id, SIGCONT);
  waitpid(child.id, &status, WCONTINUED);
  EXPECT_EQ(state_of(child.name), runs);
  kill(child.id, SIGKILL);
  siginfo_t info;
  waitid(P_PID, static_cast<id_t>(child.id), &info, WEXITED | WNOWAIT);
  EXPECT_EQ(state_of(child.name), gone) << "gone, but not yet fetched by its parent";
  waitpid(child.id, &status, 0);
  EXPECT_EQ(state_of(child.name), gone);
}

TEST(Process, OfAnotherMachineOrTimeIsNotThisOne) {
  const std::string mine = own_process();
  EXPECT_EQ(state_of(mine), runs);
  EXPECT_EQ(state_of("x" + mine), unknown);
  EXPECT_EQ(state_of(mine + "1"), gone) << "another process had this number before";
  EXPECT_EQ(state_of(""), unknown);
  EXPECT_EQ(state_of("a b c"), unknown);
}

}  // namespace
}  // namespace toryu
