// The parts of a program's frame; whole programs are tested in tests/errors.

#include <gtest/gtest.h>

#include <csignal>

#include "common/error/failure.hpp"
#include "common/run/interruption.hpp"
#include "common/run/options.hpp"
#include "common/run/provenance.hpp"

namespace toryu {
namespace {

TEST(Interruption, IsRequestedByEitherSignalAndKillsNothing) {
  for (const int signal : {SIGINT, SIGTERM}) {
    catch_interruptions();
    EXPECT_FALSE(interruption_requested());
    EXPECT_NO_THROW(throw_if_interrupted());
    std::raise(signal);
    std::raise(signal);
    EXPECT_TRUE(interruption_requested());
    EXPECT_THROW(throw_if_interrupted(), Interrupted);
  }
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
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
