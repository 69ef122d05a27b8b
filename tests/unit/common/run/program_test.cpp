// The parts of a program's frame; whole programs are tested in tests/errors.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

#include "common/error/failure.hpp"
#include "common/error/machine.hpp"
#include "common/run/interruption.hpp"
#include "common/run/options.hpp"
#include "common/run/provenance.hpp"
#include "common/run/run_lock.hpp"
#include "common/run/standard_streams.hpp"

namespace toryu {
namespace {

TEST(Interruption, IsRequestedByAnyOfItsSignalsAndKillsNothing) {
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) {
    catch_interruptions();
    EXPECT_FALSE(interruption_requested());
    EXPECT_NO_THROW(throw_if_interrupted());
    std::raise(signal);
    std::raise(signal);
    EXPECT_TRUE(interruption_requested());
    EXPECT_THROW(throw_if_interrupted(), Interrupted);
  }
  for (const int each : {SIGINT, SIGTERM, SIGUSR1}) std::signal(each, SIG_DFL);
}

TEST(Interruption, LeavesASignalThatIsIgnored) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1}) {
    std::signal(signal, SIG_IGN);
    catch_interruptions();
    std::raise(signal);
    EXPECT_FALSE(interruption_requested()) << signal;
    for (const int each : {SIGINT, SIGTERM, SIGHUP, SIGUSR1}) std::signal(each, SIG_DFL);
  }
}

TEST(StandardStreams, AreGivenToNoFileWhereTheyAreClosed) {
  const pid_t child = fork();
  if (child == 0) {
    for (const int descriptor : {0, 1, 2}) close(descriptor);
    secure_standard_streams();
    _exit(open("/dev/null", O_RDONLY) > 2 ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
}

TEST(RunLock, IsHeldByOne) {
  const auto out = std::filesystem::temp_directory_path() / ("toryu_lock_" + std::to_string(getpid()));
  std::filesystem::create_directories(out);
  {
    const RunLock lock(out);
    EXPECT_THROW(RunLock{out}, BadInput);
  }
  EXPECT_NO_THROW(RunLock{out});
  std::filesystem::remove_all(out);
  EXPECT_THROW(RunLock{out}, BadInput) << "there is no such folder";
}

TEST(MachineFailure, NamesTheCauseAndARemedy) {
  EXPECT_STREQ(MachineFailure("cannot write 'a'", EROFS).what(),
               "cannot write 'a': Read-only file system; give --out a folder that you may write to");
  EXPECT_STREQ(MachineFailure("cannot do it", EDOM).what(), "cannot do it: Numerical argument out of domain");
}

TEST(Provenance, SaysWhatMadeTheNumbers) {
  const Provenance made = provenance(3);
  EXPECT_EQ(std::count(made.version.begin(), made.version.end(), '.'), 2);
  EXPECT_NE(made.compiler.find(' '), std::string::npos);
  EXPECT_NE(made.flags.find("-march="), std::string::npos);
  EXPECT_EQ(made.flags.find("-W"), std::string::npos) << made.flags;
  EXPECT_FALSE(made.commit.empty());
  EXPECT_FALSE(made.cpu.empty());
  EXPECT_EQ(made.threads, 3);
}

TEST(Options, HaveDefaults) {
  const Options options = parse_options("coupler", {"--describe"});
  EXPECT_TRUE(options.describe);
  EXPECT_FALSE(options.check);
  EXPECT_EQ(options.threads, 0);
  EXPECT_EQ(options.log_level, "info");
  EXPECT_TRUE(options.overrides.empty());
  EXPECT_TRUE(options.case_path.empty());
}

TEST(Options, TakeOverridesInTheirOrderAndTheEndTimeAsTheLast) {
  const Options options = parse_options("coupler", {"--describe", "--end-time=0.5", "--set", "a.b=[1,2]",
                                                    "--set=c.d=-1", "--set", "e.f={g=1}"});
  EXPECT_EQ(options.overrides,
            (std::vector<std::string>{"a.b=[1,2]", "c.d=-1", "e.f={g=1}", "case.end_time=0.5"}));
}

}  // namespace
}  // namespace toryu
